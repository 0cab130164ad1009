"""Truncated power series with rational coefficients (python-flint): all derivatives at a point at once, exactly."""

from fractions import Fraction

import flint

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.guarded import FlintArithmetic, Guarded
from rkverify.arithmetic.native import rational
from rkverify.errors import NotDifferentiable


class Series(FlintArithmetic):
    """Power series in one variable t, known up to a remainder O(t^length), over the rationals.

    >>> K = Series(4)
    >>> K.coefficients(1 / K.variable("1/2"))
    (Fraction(2, 1), Fraction(-4, 1), Fraction(8, 1), Fraction(-16, 1))
    """

    epsilon = 0.0

    def __init__(self, length: int) -> None:
        self.length = length
        self.name = f"series:{length}"

    def number(self, value: Scalar) -> Guarded:
        if isinstance(value, Guarded):
            return value
        exact = rational(value)
        return self.guard(lambda: flint.fmpq_series([flint.fmpq(exact.numerator, exact.denominator)], prec=self.length))

    def variable(self, base: Scalar, rate: Scalar = 1) -> Guarded:
        """The series base + rate t."""
        exact = [rational(base), rational(rate)]
        terms = [flint.fmpq(q.numerator, q.denominator) for q in exact]
        return self.guard(lambda: flint.fmpq_series(terms, prec=self.length))

    def coefficients(self, x: Guarded) -> tuple[Fraction, ...]:
        """The known coefficients of 1, t, t^2, …: fewer than `length` where a joint cut the series short."""
        known = min(x.value.prec, self.length)
        return tuple(Fraction(int(x.value[j].p), int(x.value[j].q)) for j in range(known))

    def witness(self, x: Guarded) -> Fraction:
        return self.coefficients(x)[0]

    def pos(self, x: Guarded, power: int) -> Guarded:
        known = self.coefficients(x)
        if any(known[:1]) or (len(known) == self.length and not any(known)):
            return super().pos(x, power)
        if power == 0:
            raise NotDifferentiable("a kernel's joint lies exactly where the derivative jumps: move the point")
        # Left and right of the joint the truncated power of O(t^k) agrees below t^(k power) and nowhere further.
        first = next((k for k, c in enumerate(known) if c), len(known))
        return self.guard(lambda: flint.fmpq_series([], prec=min(first * power, self.length)))

    def known_below(self, x: Guarded, order: int) -> Guarded:
        known = self.coefficients(x)
        if order >= self.length or not any(known[1:]):
            return x
        kept = [flint.fmpq(c.numerator, c.denominator) for c in known[:order]]
        return self.guard(lambda: flint.fmpq_series(kept, prec=min(order, len(known))))

    def text(self, x: Guarded) -> str:
        return str(x.value)

    def is_zero(self, x: Guarded) -> bool:
        known = self.coefficients(x)
        return len(known) == self.length and not any(known)
