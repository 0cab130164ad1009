"""Ball arithmetic (python-flint): every number is an enclosure, so a computed sign is a proved sign."""

import math

import flint

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.guarded import FlintArithmetic, Guarded
from rkverify.arithmetic.native import rational
from rkverify.errors import BadInput, NotDifferentiable, Undecided


class Ball(FlintArithmetic):
    """Real enclosures of about the given count of decimal digits.

    >>> K = Ball(20)
    >>> K.surely_positive(K.cos(K.number(1)))
    True
    """

    def __init__(self, digits: int) -> None:
        if digits < 1:
            raise BadInput(f"ball:{digits}: ask for at least one digit")
        self.digits = digits
        self.bits = math.ceil(digits * math.log2(10)) + 8
        self.name = f"ball:{digits}"
        self.epsilon = 0.0

    def number(self, value: Scalar) -> Guarded:
        if isinstance(value, Guarded):
            return value
        exact = rational(value)
        return self.guard(lambda: flint.arb(flint.fmpq(exact.numerator, exact.denominator)))

    def between(self, lower: Scalar, upper: Scalar) -> Guarded:
        """The enclosure of every number from lower to upper."""
        low, high = self.number(lower), self.number(upper)
        return self.guard(lambda: low.value.union(high.value))

    def witness(self, x: Guarded) -> float:
        return float(x.value.mid())

    def sign(self, x: Guarded) -> int:
        if x.value > 0:
            return 1
        if x.value < 0:
            return -1
        if x.value == 0:
            return 0
        raise Undecided(f"the enclosure {x} does not decide its sign: use more digits or a smaller box")

    def surely_positive(self, x: Guarded) -> bool:
        return bool(x.value > 0)

    def pos(self, x: Guarded, power: int) -> Guarded:
        if x.value > 0:
            return x**power
        if x.value < 0:
            return self.number(0)
        if power == 0:
            if x.value == 0:
                raise NotDifferentiable("a kernel's joint lies exactly where the derivative jumps: move the point")
            return self.between(0, 1)
        return self.guard(lambda: flint.arb.max(x.value, flint.arb(0))) ** power

    def absolute(self, x: Guarded) -> Guarded:
        return self.guard(lambda: abs(x.value))

    def norm(self, vector):  # type: ignore[no-untyped-def]
        if len(vector) == 1:
            return self.absolute(vector[0])
        return self.sqrt(sum((c**2 for c in vector[1:]), vector[0] ** 2))

    def sqrt(self, x: Guarded) -> Guarded:
        """The square roots of the part of the enclosure that is not negative; Undecided where there is none."""
        if x.value < 0:
            raise Undecided(f"the enclosure {x} is negative and has no real square root")
        if x.value > 0:
            return self.guard(lambda: x.value.sqrt())
        return self.guard(lambda: flint.arb(0).union(x.value.upper().sqrt()))

    def cos(self, x: Guarded) -> Guarded:
        return self.guard(lambda: x.value.cos())

    def sin(self, x: Guarded) -> Guarded:
        return self.guard(lambda: x.value.sin())

    def pi(self) -> Guarded:
        return self.guard(flint.arb.pi)

    def text(self, x: Guarded) -> str:
        with self.settings():
            return str(x.value.str(self.digits))

    def is_zero(self, x: Guarded) -> bool:
        return bool(x.value == 0)
