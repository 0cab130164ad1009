"""First-order duals over any arithmetic: a value and its partial derivatives, multiplied by the product rule."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import NotDifferentiable


@dataclass(frozen=True, eq=False)
class Dual:
    """value + sum_j slopes[j] e_j with e_i e_j = 0; only slopes that may differ from zero are kept."""

    value: Scalar
    slopes: dict[int, Scalar]
    size: int

    @property
    def partials(self) -> tuple[Scalar, ...]:
        """All partial derivatives, the zeros as well."""
        zero = self.value * 0
        return tuple(self.slopes.get(j, zero) for j in range(self.size))

    def scaled(self, value: Scalar, slope: Scalar) -> "Dual":
        """The dual of a function of this one, from its value and its derivative (chain rule)."""
        return Dual(value, {j: slope * s for j, s in self.slopes.items()}, self.size)

    def __neg__(self) -> "Dual":
        return self.scaled(-self.value, -1)

    def __pos__(self) -> "Dual":
        return self

    def __add__(self, other: Scalar) -> "Dual":
        if not isinstance(other, Dual):
            return Dual(self.value + other, self.slopes, self.size)
        slopes = dict(self.slopes)
        for j, s in other.slopes.items():
            slopes[j] = slopes[j] + s if j in slopes else s
        return Dual(self.value + other.value, slopes, self.size)

    __radd__ = __add__

    def __sub__(self, other: Scalar) -> "Dual":
        return self + (-other)

    def __rsub__(self, other: Scalar) -> "Dual":
        return -self + other

    def __mul__(self, other: Scalar) -> "Dual":
        if not isinstance(other, Dual):
            return self.scaled(self.value * other, other)
        slopes = {j: s * other.value for j, s in self.slopes.items()}
        for j, s in other.slopes.items():
            more = self.value * s
            slopes[j] = slopes[j] + more if j in slopes else more
        return Dual(self.value * other.value, slopes, self.size)

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> "Dual":
        if not isinstance(other, Dual):
            return Dual(self.value / other, {j: s / other for j, s in self.slopes.items()}, self.size)
        return self * (1 / other)

    def __rtruediv__(self, other: Scalar) -> "Dual":
        quotient = other / self.value
        return self.scaled(quotient, -quotient / self.value)

    def __pow__(self, power: int) -> "Dual":
        if power == 0:
            return Dual(self.value**0, {}, self.size)
        # 0^0 never arises: not every arithmetic has it.
        return self.scaled(self.value**power, 1 if power == 1 else power * self.value ** (power - 1))


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
        return Dual(self.base.number(value), {}, self.size)

    def variable(self, value: Scalar, index: int) -> Dual:
        """The independent variable number `index` at the given value."""
        return Dual(self.base.number(value), {index: self.base.number(1)}, self.size)

    def along(self, value: Scalar, rates: Sequence[Scalar]) -> Dual:
        """The number value + sum_j rates[j] e_j."""
        return Dual(self.base.number(value), {j: self.base.number(rate) for j, rate in enumerate(rates)}, self.size)

    def witness(self, x: Dual) -> Scalar:
        return self.base.witness(x.value)

    def sign(self, x: Dual) -> int:
        return self.base.sign(x.value)

    def surely_positive(self, x: Dual) -> bool:
        return self.base.surely_positive(x.value)

    def pos(self, x: Dual, power: int) -> Dual:
        value = self.base.pos(x.value, power)
        if power == 0:
            if x.slopes:
                self.base.sign(x.value)  # a step that the value may sit on has no slope: an enclosure says so here
            return self.number(value)
        if self.base.is_zero(x.value):
            if power == 1 and not all(map(self.base.is_zero, x.slopes.values())):
                raise NotDifferentiable(
                    "a kernel's kink lies exactly at the point: move the point or take a kernel of class C1"
                )
            return self.zero()
        return x.scaled(value, power * self.base.pos(x.value, power - 1))

    def known_below(self, x: Dual, order: int) -> Dual:
        if order < 2 and not all(map(self.base.is_zero, x.slopes.values())):
            raise NotDifferentiable("the kernel has a peak at its node: move the point or take a smoother kernel")
        return x

    def _chain(self, x: Dual, f: Callable[[Scalar], Scalar], slope: Callable[[Scalar], Scalar]) -> Dual:
        return x.scaled(f(x.value), slope(x.value))

    def sqrt(self, x: Dual) -> Dual:
        root = self.base.sqrt(x.value)
        return x.scaled(root, 1 / (2 * root))

    def cos(self, x: Dual) -> Dual:
        return self._chain(x, self.base.cos, lambda v: -self.base.sin(v))

    def sin(self, x: Dual) -> Dual:
        return self._chain(x, self.base.sin, self.base.cos)

    def pi(self) -> Dual:
        return Dual(self.base.pi(), {}, self.size)

    def text(self, x: Dual) -> str:
        slopes = ", ".join(map(self.base.text, x.partials))
        return f"{self.base.text(x.value)} [{slopes}]"

    def is_zero(self, x: Dual) -> bool:
        return self.base.is_zero(x.value) and all(map(self.base.is_zero, x.slopes.values()))
