"""Expressions with symbols (sympy); decisions are taken at a rational sample and recorded as inequalities."""

from fractions import Fraction

import sympy

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import rational
from rkverify.errors import Undecided


class Symbolic(Arithmetic):
    """Symbolic expressions; `conditions` collects the inequalities under which the branches taken are right.

    sample: a rational value for each symbol, at which every decision is made.

    >>> R = sympy.Symbol("R", positive=True)
    >>> K = Symbolic({R: "3/2"})
    >>> K.pos(2 - R, 3), K.conditions
    ((2 - R)**3, {R < 2})
    """

    name = "symbolic"
    epsilon = 0.0

    def __init__(self, sample: dict[sympy.Symbol, Scalar] | None = None) -> None:
        self.sample = {symbol: self._rational(value) for symbol, value in (sample or {}).items()}
        self.conditions: set[sympy.Basic] = set()

    @staticmethod
    def _rational(value: Scalar) -> sympy.Rational:
        exact: Fraction = rational(value)
        return sympy.Rational(exact.numerator, exact.denominator)

    def number(self, value: Scalar) -> sympy.Expr:
        return value if isinstance(value, sympy.Basic) else self._rational(value)

    def witness(self, x: Scalar) -> sympy.Expr:
        return sympy.sympify(x).subs(self.sample)

    def sign(self, x: Scalar) -> int:
        try:
            sign = super().sign(x)
        except TypeError:
            raise Undecided(f"the sign of {x} is not known: give each of its symbols a sample") from None
        expression = sympy.sympify(x)
        if expression.free_symbols:
            relation = {1: sympy.Gt, 0: sympy.Eq, -1: sympy.Lt}[sign](sympy.cancel(expression), 0)
            if relation not in (sympy.true, sympy.false):
                self.conditions.add(relation.simplify())
        return sign

    def is_zero(self, x: Scalar) -> bool:
        return bool(sympy.cancel(x) == 0)

    def sqrt(self, x: Scalar) -> sympy.Expr:
        return sympy.sqrt(x)

    def cos(self, x: Scalar) -> sympy.Expr:
        return sympy.cos(x)

    def sin(self, x: Scalar) -> sympy.Expr:
        return sympy.sin(x)

    def pi(self) -> sympy.Expr:
        return sympy.pi

    def text(self, x: Scalar) -> str:
        return str(x)
