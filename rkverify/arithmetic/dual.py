"""First-order duals over any arithmetic: a value and its partial derivatives, multiplied by the product rule."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import NotDifferentiable


@dataclass(frozen=True, eq=False)
class Dual:
    """value + sum_j partials[j] e_j with e_i e_j = 0."""

    value: Scalar
    partials: tuple[Scalar, ...]

    def _with(self, value: Scalar, slope: Scalar) -> "Dual":
        return Dual(value, tuple(slope * p for p in self.partials))

    def __neg__(self) -> "Dual":
        return self._with(-self.value, -1)

    def __pos__(self) -> "Dual":
        return self

    def __add__(self, other: Scalar) -> "Dual":
        if isinstance(other, Dual):
            return Dual(
                self.value + other.value,
                tuple(p + q for p, q in zip(self.partials, other.partials, strict=True)),
            )
        return Dual(self.value + other, self.partials)

    __radd__ = __add__

    def __sub__(self, other: Scalar) -> "Dual":
        return self + (-other)

    def __rsub__(self, other: Scalar) -> "Dual":
        return -self + other

    def __mul__(self, other: Scalar) -> "Dual":
        if isinstance(other, Dual):
            return Dual(
                self.value * other.value,
                tuple(p * other.value + self.value * q for p, q in zip(self.partials, other.partials, strict=True)),
            )
        return self._with(self.value * other, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> "Dual":
        if isinstance(other, Dual):
            quotient = self.value / other.value
            return Dual(
                quotient,
                tuple((p - quotient * q) / other.value for p, q in zip(self.partials, other.partials, strict=True)),
            )
        return Dual(self.value / other, tuple(p / other for p in self.partials))

    def __rtruediv__(self, other: Scalar) -> "Dual":
        quotient = other / self.value
        return self._with(quotient, -quotient / self.value)

    def __pow__(self, power: int) -> "Dual":
        if power == 0:
            return Dual(self.value**0, tuple(0 * p for p in self.partials))
        # 0^0 never arises: not every arithmetic has it.
        return self._with(self.value**power, power * self.value ** (power - 1) if power > 1 else 1)


class Duals(Arithmetic):
    """Dual numbers with `size` independent variables over a base arithmetic.

    >>> from rkverify.arithmetic.native import Exact
    >>> K = Duals(Exact(), 1)
    >>> (K.variable(3, 0) ** 2).partials
    (Fraction(6, 1),)
    """

    def __init__(self, base: Arithmetic, size: int) -> None:
        self.base = base
        self.size = size
        self.name = f"dual({base.name})"
        self.epsilon = base.epsilon

    def number(self, value: Scalar) -> Dual:
        if isinstance(value, Dual):
            return value
        return Dual(self.base.number(value), (self.base.zero(),) * self.size)

    def variable(self, value: Scalar, index: int) -> Dual:
        """The independent variable number `index` at the given value."""
        return self.along(value, [int(j == index) for j in range(self.size)])

    def along(self, value: Scalar, rates: Sequence[Scalar]) -> Dual:
        """The number value + sum_j rates[j] e_j."""
        return Dual(self.base.number(value), tuple(self.base.number(rate) for rate in rates))

    def witness(self, x: Dual) -> Scalar:
        return self.base.witness(x.value)

    def sign(self, x: Dual) -> int:
        return self.base.sign(x.value)

    def surely_positive(self, x: Dual) -> bool:
        return self.base.surely_positive(x.value)

    def pos(self, x: Dual, power: int) -> Dual:
        value = self.base.pos(x.value, power)
        if power == 0:
            return self.number(value)
        if self.base.is_zero(x.value):
            if power == 1 and not all(map(self.base.is_zero, x.partials)):
                raise NotDifferentiable(
                    "a kernel's kink lies exactly at the point: move the point or take a kernel of class C1"
                )
            return self.zero()
        return x._with(value, power * self.base.pos(x.value, power - 1))

    def _chain(self, x: Dual, f: Callable[[Scalar], Scalar], slope: Callable[[Scalar], Scalar]) -> Dual:
        return x._with(f(x.value), slope(x.value))

    def sqrt(self, x: Dual) -> Dual:
        root = self.base.sqrt(x.value)
        return x._with(root, 1 / (2 * root))

    def cos(self, x: Dual) -> Dual:
        return self._chain(x, self.base.cos, lambda v: -self.base.sin(v))

    def sin(self, x: Dual) -> Dual:
        return self._chain(x, self.base.sin, self.base.cos)

    def pi(self) -> Dual:
        return Dual(self.base.pi(), (self.base.zero(),) * self.size)

    def text(self, x: Dual) -> str:
        slopes = ", ".join(map(self.base.text, x.partials))
        return f"{self.base.text(x.value)} [{slopes}]"

    def is_zero(self, x: Dual) -> bool:
        return self.base.is_zero(x.value) and all(map(self.base.is_zero, x.partials))
