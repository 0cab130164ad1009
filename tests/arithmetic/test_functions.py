"""Square roots, sines, cosines and distances: right to rounding, enclosed, or refused."""

import math
from collections.abc import Callable
from fractions import Fraction

import mpmath
import pytest
from hypothesis import example, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.series import Series
from rkverify.errors import NotRepresentable, RkverifyError

Interval = tuple[Fraction, Fraction]
POSITIVE = st.fractions(Fraction(1, 100), 100, max_denominator=100)
DYADIC = st.integers(-(2**20), 2**20).map(lambda n: Fraction(n, 2**12))  # numbers that every arithmetic holds exactly
REFERENCE_DIGITS = 90


def reference(name: str, q: Fraction) -> Fraction:
    """The function at q from mpmath's own global context, far beyond any precision tested here."""
    with mpmath.workdps(REFERENCE_DIGITS):
        value = getattr(mpmath, name)(mpmath.mpf(q.numerator) / q.denominator)
        sign, mantissa, exponent, _ = value._mpf_
    return (-1) ** sign * int(mantissa) * Fraction(2) ** exponent


@pytest.mark.parametrize("name", ["sqrt", "sin", "cos"])
@given(q=DYADIC)
@example(q=Fraction(2))
@example(q=Fraction(355, 1))  # 113 pi to seven digits: a sine with cancelled leading digits
def test_functions_are_right_to_a_unit_in_the_last_place(
    with_functions: Arithmetic, interval: Callable[..., Interval], name: str, q: Fraction
) -> None:
    """The mathematical libraries promise less than one unit in the last place, an epsilon; balls enclose."""
    K, argument = with_functions, abs(q) if name == "sqrt" else q
    low, high = interval(getattr(K, name)(K.number(argument)))
    exact = reference(name, argument)
    allowed = Fraction(K.epsilon) * abs(exact) + Fraction(1, 10 ** (REFERENCE_DIGITS - 5))
    target(float(abs(low - exact)) / max(float(allowed), 1e-80), label=f"error of {name} in {K.name}")
    assert low - allowed <= exact <= high + allowed
    assert high - low <= Fraction(1, 10**19) * max(abs(exact), 1)


def test_pi(with_functions: Arithmetic, interval: Callable[..., Interval]) -> None:
    K = with_functions
    low, high = interval(K.pi())
    exact = 4 * reference("atan", Fraction(1))
    assert low - Fraction(K.epsilon) * exact <= exact <= high + Fraction(K.epsilon) * exact
    assert (low < high) == isinstance(K, Ball)  # no number of finite length is pi


@given(q=POSITIVE)
def test_exact_roots_are_those_of_squares(q: Fraction) -> None:
    """Decides that `exact` never rounds: the root of a square is the number, and of anything else there is none."""
    K = Exact()
    assert K.sqrt(q * q) == q
    for no_square in (2 * q * q, -q * q, q * q / 3):
        with pytest.raises(NotRepresentable, match="mp:DIGITS"):
            K.sqrt(no_square)


@pytest.mark.parametrize("K", [Exact(), Series(3), Duals(Exact(), 1), Duals(Series(3), 1)], ids=lambda K: K.name)
@pytest.mark.parametrize("name", ["sin", "cos", "pi"])
def test_what_has_no_exact_value_is_refused(K: Arithmetic, name: str) -> None:
    with pytest.raises(NotRepresentable, match="choose float or mp:DIGITS"):
        getattr(K, name)(*[] if name == "pi" else [K.number(1)])


@pytest.mark.parametrize(
    "K", [Float(), Multiprecision(20), Exact(), Ball(20), Duals(Float(), 1), Duals(Multiprecision(20), 1)],
    ids=lambda K: K.name,
)  # fmt: skip
def test_no_real_arithmetic_has_the_root_of_a_negative_number(K: Arithmetic) -> None:
    """`sqrt` is the non-negative square root: of -1 there is none, and a complex one must not pass for it."""
    with pytest.raises(RkverifyError):
        K.sqrt(K.number(-1))


def test_a_ball_across_zero_has_the_roots_of_its_non_negative_part(interval: Callable[..., Interval]) -> None:
    K = Ball(20)
    low, high = interval(K.sqrt(K.between(-1, 4)))
    assert low <= 0
    assert 2 <= high <= 2 + Fraction(1, 10**8)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_distance_at_the_origin_is_exactly_zero(K: Arithmetic, dimension: int) -> None:
    """Decides that z = 0 at a node is decided exactly, and that no square root is differentiated there."""
    assert K.is_zero(K.norm([K.zero()] * dimension))


@given(m=st.integers(1, 30), n=st.integers(1, 30), scale=POSITIVE)
def test_distances_of_pythagorean_points_are_rational(
    interval: Callable[..., Interval], m: int, n: int, scale: Fraction
) -> None:
    """m^2 - n^2, 2 m n and m^2 + n^2 are the sides of a right triangle: `exact` must find the third."""
    sides = [side * scale for side in (m * m - n * n, 2 * m * n)]
    hypotenuse = (m * m + n * n) * scale
    assert Exact().norm(sides) == hypotenuse
    assert Exact().norm([3 * hypotenuse, *(4 * side for side in sides)]) == 5 * hypotenuse
    ball = Ball(20)
    low, high = interval(ball.norm([ball.number(side) for side in sides]))
    assert low <= hypotenuse <= high


def test_the_twin_where_the_distance_is_not_rational() -> None:
    with pytest.raises(NotRepresentable):
        Exact().norm([Fraction(1), Fraction(1)])
    # Two squares, their sum and its root: four roundings of half an epsilon, halved by the root but for its own.
    assert abs(Float().norm([1.0, 1.0]) - math.sqrt(2)) <= 2 * Float.epsilon * math.sqrt(2)


def test_the_gradient_of_the_distance_is_the_direction() -> None:
    """Decides the derivative of |y| away from the origin: n of (36); and that it is taken as 0 at the origin."""
    K = Duals(Exact(), 2)
    y = [K.variable(3, 0), K.variable(4, 1)]
    assert K.norm(y).partials == (Fraction(3, 5), Fraction(4, 5))
    assert K.norm([K.variable(0, 0), K.variable(0, 1)]).partials == (0, 0)
    step = 2.0**-80
    assert Complex().norm([3 + step * 1j, 4 + 0j]).imag / step == pytest.approx(0.6, rel=4 * Complex.epsilon)
