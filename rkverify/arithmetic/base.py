"""What every arithmetic offers to the literal transcription, so that its lines run unchanged in all of them.

Generic code writes numbers as Python integers or makes them with `ratio` and `number`; a Python float or
Fraction never meets a number of another arithmetic. Every branch goes through `sign`, `surely_positive`
or `pos`, which decide on a witness value.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rkverify.errors import NotDifferentiable, NotRepresentable

Scalar = Any
"""A number of some arithmetic: float, complex, mpf, Fraction, enclosure, dual, series or expression."""


def not_negative(x: Scalar, K: "Arithmetic") -> Scalar:
    """x itself; raises NotRepresentable where it has no real square root."""
    if x < 0:
        raise NotRepresentable(f"{K.text(x)} has no real square root: check the sign of what is under the root")
    return x


class Arithmetic(ABC):
    """A field of scalars with its constants, its elementary functions and its decisions."""

    name: str
    epsilon: float
    """Unit of relative rounding; 0 where operations are exact."""

    @abstractmethod
    def number(self, value: Scalar) -> Scalar:
        """The scalar for an int, a Fraction, a decimal or p/q string, a float (its binary value) or a scalar."""

    def ratio(self, numerator: int, denominator: int = 1) -> Scalar:
        """The constant numerator/denominator, rounded (if at all) once and by this arithmetic."""
        return self.number(Fraction(numerator, denominator))

    @abstractmethod
    def witness(self, x: Scalar) -> Any:
        """The real value on which decisions about x are taken."""

    def sign(self, x: Scalar) -> int:
        """-1, 0 or 1: the sign of the witness of x."""
        w = self.witness(x)
        return int(bool(w > 0)) - int(bool(w < 0))

    def surely_positive(self, x: Scalar) -> bool:
        """Whether x > 0 for every value that x may stand for."""
        return self.sign(x) > 0

    def pos(self, x: Scalar, power: int) -> Scalar:
        """The truncated power (x)_+^power, the one branch that kernels take.

        Raises NotDifferentiable for power 0 at x = 0, where the step has no value.
        """
        sign = self.sign(x)
        if sign > 0:
            return x**power
        if sign == 0 and power == 0:
            raise NotDifferentiable(
                "a kernel's joint lies exactly at the point where the derivative jumps: "
                "move the point or take a smoother kernel"
            )
        return self.number(0)

    def absolute(self, x: Scalar) -> Scalar:
        """|x|; at x = 0 the derivative is taken as that of x (used only inside functions even in x)."""
        return -x if self.sign(x) < 0 else x

    def norm(self, vector: Sequence[Scalar]) -> Scalar:
        """|y| = sqrt(y.y); the absolute value in one dimension, and exactly 0 at the origin.

        No square root is differentiated at 0: what is built on |y| is smooth in y, so that the derivative
        of |y| there is multiplied by zero and may be taken as zero.
        """
        if len(vector) == 1:
            return self.absolute(vector[0])
        if all(self.sign(component) == 0 for component in vector):
            return self.number(0)
        return self.sqrt(sum((c * c for c in vector[1:]), vector[0] * vector[0]))

    def sqrt(self, x: Scalar) -> Scalar:
        """The non-negative square root."""
        raise NotRepresentable(f"arithmetic {self.name!r} has no square roots: choose float or mp:DIGITS")

    def cos(self, x: Scalar) -> Scalar:
        """The cosine."""
        raise NotRepresentable(f"arithmetic {self.name!r} has no cosine: choose float or mp:DIGITS")

    def sin(self, x: Scalar) -> Scalar:
        """The sine."""
        raise NotRepresentable(f"arithmetic {self.name!r} has no sine: choose float or mp:DIGITS")

    def pi(self) -> Scalar:
        """The number pi."""
        raise NotRepresentable(f"arithmetic {self.name!r} has no pi: choose float or mp:DIGITS")

    @abstractmethod
    def text(self, x: Scalar) -> str:
        """x as text that loses nothing of it: p/q, or as many decimals as the arithmetic carries."""

    def known_below(self, x: Scalar, order: int) -> Scalar:
        """x, where of its change with an infinitesimal t only the part below t^order exists.

        A function of |y| at y = 0 is as smooth as the kernel is at its node: arithmetics that carry derivatives cut theirs
        off, or raise NotDifferentiable where the first one is missing.
        """
        return x

    def zero(self) -> Scalar:
        """The scalar 0."""
        return self.number(0)

    def is_zero(self, x: Scalar) -> bool:
        """Whether x is exactly zero, whatever it stands for."""
        return bool(x == 0)
