"""Rational functions with rational coefficients, in lowest terms (sympy's fraction fields): exact closed forms.

Decisions are taken at a rational sample of the generators, and the inequalities used are recorded: between two
neighbouring real zeros of all of them the result is the same function.
"""

from fractions import Fraction
from typing import Any

from sympy import QQ
from sympy.polys.fields import FracElement, field

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import rational


class RationalFunctions(Arithmetic):
    """The field Q(g_1, g_2, …); `decisions` holds every element whose sign at the sample was used, with that sign.

    sample: generator name -> rational value.

    >>> K = RationalFunctions({"R": "3/2"})
    >>> K.sign(2 - K.generator("R")), K.text((K.generator("R") ** 2 - 1) / (K.generator("R") - 1))
    (1, 'R + 1')
    """

    name = "rational functions"
    epsilon = 0.0

    def __init__(self, sample: dict[str, Scalar]) -> None:
        self.sample = {name: rational(value) for name, value in sample.items()}
        self.field, *generators = field(",".join(sample), QQ)
        self.generators: dict[str, Any] = dict(zip(sample, generators, strict=True))
        self.decisions: dict[FracElement, int] = {}

    def generator(self, name: str) -> FracElement:
        """The generator of that name."""
        return self.generators[name]

    def number(self, value: Scalar) -> FracElement:
        if isinstance(value, FracElement):
            return value
        exact = rational(value)
        return self.field(QQ(exact.numerator, exact.denominator))

    def witness(self, x: Scalar) -> Fraction:
        if isinstance(x, int):
            return Fraction(x)
        point = [QQ(q.numerator, q.denominator) for q in self.sample.values()]
        value = x.numer.evaluate(list(zip(x.numer.ring.gens, point, strict=True))) / x.denom.evaluate(
            list(zip(x.denom.ring.gens, point, strict=True))
        )
        return Fraction(int(value.numerator), int(value.denominator))

    def sign(self, x: Scalar) -> int:
        sign = super().sign(x)
        if not isinstance(x, int) and not (x.numer.is_ground and x.denom.is_ground):
            self.decisions[x] = sign
        return sign

    def text(self, x: Scalar) -> str:
        return str(x.as_expr() if isinstance(x, FracElement) else x)
