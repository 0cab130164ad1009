"""Binary floating point with as many digits as asked for (mpmath), each arithmetic with a context of its own."""

from fractions import Fraction

import mpmath
from mpmath.libmp import from_rational

from rkverify.arithmetic.base import Arithmetic, Scalar, not_negative
from rkverify.arithmetic.native import rational
from rkverify.errors import BadInput

GUARD_DIGITS = 10


class Multiprecision(Arithmetic):
    """Real numbers of a given count of decimal digits and ten more in hand, no global precision involved.

    The digits in hand take the rounding of a computation with a condition number up to 10^10, so that what is
    printed is right to its last digit but one.

    >>> K = Multiprecision(30)
    >>> K.text(K.ratio(1, 3))
    '0.333333333333333333333333333333'
    """

    def __init__(self, digits: int) -> None:
        if digits < 1:
            raise BadInput(f"mp:{digits}: ask for at least one digit")
        self.context = mpmath.MPContext()
        self.context.dps = digits + GUARD_DIGITS
        self.digits = digits
        self.name = f"mp:{digits}"
        self.epsilon = float(self.context.eps)

    def number(self, value: Scalar) -> Scalar:
        if hasattr(value, "_mpf_"):
            return self.context.mpf(value)
        exact: Fraction = rational(value)
        return self.context.make_mpf(from_rational(exact.numerator, exact.denominator, self.context.prec, "n"))

    def witness(self, x: Scalar) -> Scalar:
        return x

    def sqrt(self, x: Scalar) -> Scalar:
        return self.context.sqrt(not_negative(x, self))

    def cos(self, x: Scalar) -> Scalar:
        return self.context.cos(x)

    def sin(self, x: Scalar) -> Scalar:
        return self.context.sin(x)

    def pi(self) -> Scalar:
        return +self.context.pi

    def text(self, x: Scalar) -> str:
        return str(self.context.nstr(x, self.digits, strip_zeros=False, min_fixed=-5, max_fixed=self.digits))
