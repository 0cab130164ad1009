"""Every arithmetic in turn, and the exact rationals that a number of any of them stands for."""

from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy
from sympy.polys.fields import FracElement

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Dual, Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.arithmetic.series import Series
from rkverify.arithmetic.symbolic import Symbolic

Interval = tuple[Fraction, Fraction]
ROUNDING = [Float(), Complex(), Multiprecision(5), Multiprecision(40), Duals(Float(), 1), Duals(Multiprecision(20), 2)]
FUNCTIONS = RationalFunctions({"R": "3/2"})
SHARP = [Exact(), Series(3), Symbolic(), FUNCTIONS, Duals(Exact(), 1), Duals(Series(2), 1)]
ENCLOSING = [Ball(20), Duals(Ball(20), 2)]


def name(K: Arithmetic) -> str:
    return K.name


@pytest.fixture(scope="session", params=ROUNDING + SHARP + ENCLOSING, ids=name)
def K(request: pytest.FixtureRequest) -> Arithmetic:
    """Each arithmetic; scope session, so that hypothesis may use it."""
    return request.param


@pytest.fixture(scope="session", params=[Float(), Multiprecision(5), Multiprecision(40), Ball(20)], ids=name)
def with_functions(request: pytest.FixtureRequest) -> Arithmetic:
    """Each real arithmetic that has square roots, sines and cosines."""
    return request.param


@pytest.fixture(scope="session")
def interval() -> Callable[[Scalar], Interval]:
    """x -> the least and the largest rational that x may stand for, read from the number's own representation."""
    return _interval


def _interval(x: Scalar) -> Interval:
    if isinstance(x, Dual):
        return _interval(x.value)
    if hasattr(x, "home"):
        return _of_flint(x)
    if isinstance(x, FracElement):
        assert x.numer.is_ground
        assert x.denom.is_ground
        x = FUNCTIONS.witness(x)
    if isinstance(x, complex):
        assert x.imag == 0
        x = x.real
    if isinstance(x, sympy.Rational):
        x = Fraction(int(x.p), int(x.q))
    if hasattr(x, "_mpf_"):
        sign, mantissa, exponent, _ = x._mpf_
        x = (-1) ** sign * int(mantissa) * Fraction(2) ** exponent
    return Fraction(x), Fraction(x)


def _of_flint(x: Scalar) -> Interval:
    if isinstance(x.home, Series):
        first, *rest = x.home.coefficients(x)
        assert not any(rest)
        return first, first
    middle, radius = (_dyadic(part) for part in (x.value.mid(), x.value.rad()))
    return middle - radius, middle + radius


def _dyadic(x: Scalar) -> Fraction:
    mantissa, exponent = x.man_exp()
    return int(mantissa) * Fraction(2) ** int(exponent)
