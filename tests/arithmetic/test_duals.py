"""First derivatives by duals: against the product rule's exact value, series, exact differences and complex steps."""

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given, target
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.series import Series

Interval = tuple[Fraction, Fraction]
Function = Callable[[Scalar], Scalar]
FRACTIONS = st.fractions(-10, 10, max_denominator=20)
RATIONAL: dict[str, Function] = {
    "polynomial": lambda x: (x - 3) * (2 + x * x) - x**3 * 5 + 7,
    "quotient": lambda x: (1 - x) / (x**2 + 1),
    "reciprocal": lambda x: 3 / (x * x + 2) - 1 / (4 + x**4),
    "negated": lambda x: -(+x) * (1 - x**1) + x**0,
}
BASES = [Exact(), Ball(25), Multiprecision(25), Float()]


@pytest.mark.parametrize("name", RATIONAL)
@pytest.mark.parametrize("base", BASES, ids=lambda K: K.name)
@given(q=FRACTIONS)
def test_slopes_are_the_second_coefficients_of_series(
    interval: Callable[..., Interval], base: Arithmetic, name: str, q: Fraction
) -> None:
    """Two unrelated routes, exact: t-coefficients by power series algebra, slopes by the product rule.

    Rounding bases: f and its slope stay below 10^5 on |x| <= 10 with fewer than 40 operations, and the denominators
    are at least 1, so that no cancellation magnifies: 40 epsilon 10^5 bounds both.
    """
    S, D = Series(2), Duals(base, 1)
    value, slope = S.coefficients(RATIONAL[name](S.variable(q)))
    dual = RATIONAL[name](D.variable(q, 0))
    allowed = 40 * Fraction(base.epsilon) * 10**5
    for computed, exact in ((dual.value, value), (dual.partials[0], slope)):
        low, high = interval(computed)
        assert low - allowed <= exact <= high + allowed
    if allowed:
        target(float(abs(interval(dual.partials[0])[0] - slope) / allowed), label=f"{name} in {base.name}")


@given(q=FRACTIONS)
def test_slopes_are_exact_differences_of_polynomials(q: Fraction) -> None:
    """The five-point central difference is exact for degree 4 and lower, whatever the step, in exact arithmetic."""
    f, step = RATIONAL["polynomial"], Fraction(1, 7)
    difference = (f(q - 2 * step) - 8 * f(q - step) + 8 * f(q + step) - f(q + 2 * step)) / (12 * step)
    K = Duals(Exact(), 1)
    assert f(K.variable(q, 0)).partials[0] == difference


def test_the_difference_stops_being_exact_beyond_its_degree() -> None:
    """The twin: for x^5 the five-point difference is off by -4 step^4, so that its agreement above means something."""
    step, at = Fraction(1, 7), Fraction(1, 3)
    f: Function = lambda x: x**5  # noqa: E731
    difference = (f(at - 2 * step) - 8 * f(at - step) + 8 * f(at + step) - f(at + 2 * step)) / (12 * step)
    K = Duals(Exact(), 1)
    assert difference - f(K.variable(at, 0)).partials[0] == -4 * step**4


FUNCTIONS: dict[str, Callable[[Scalar, Arithmetic], Scalar]] = {
    "sin": lambda x, K: K.sin(x * x),
    "cos": lambda x, K: K.cos(3 - x) * x,
    "sqrt": lambda x, K: K.sqrt(x * x + 1) / 2,
    "norm": lambda x, K: K.norm([x, 1 + x, x * x]),
    "pi": lambda x, K: K.pi() * x / (2 + K.cos(x)),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@given(x=st.floats(-3, 3))
def test_slopes_of_functions_are_complex_steps(name: str, x: float) -> None:
    """Im f(x + i e)/e is f'(x) with an error e^2: with e = 2^-100 only rounding is left.

    Fewer than 20 operations on values below 200 in either route: 2 * 20 * 200 epsilon.
    """
    step = 2.0**-100
    D = Duals(Float(), 1)
    dual = FUNCTIONS[name](D.variable(x, 0), D).partials[0]
    stepped = FUNCTIONS[name](complex(x, step), Complex()).imag / step
    target(abs(dual - stepped), label=name)
    assert abs(dual - stepped) <= 2 * 20 * 200 * Float.epsilon


@pytest.mark.parametrize("name", FUNCTIONS)
def test_slopes_of_functions_are_the_limits_of_differences(name: str) -> None:
    """Central differences in 60 digits: the error falls by four when the step is halved, as order 2 demands.

    The next term of the expansion is smaller by step^2 = 10^-16 times a ratio of derivatives, taken as below 10^6.
    """
    K = Multiprecision(60)
    f: Function = lambda x: FUNCTIONS[name](x, K)  # noqa: E731
    D, at = Duals(K, 1), K.ratio(7, 5)
    slope = FUNCTIONS[name](D.variable(at, 0), D).partials[0]
    errors = [(f(at + h) - f(at - h)) / (2 * h) - slope for h in (K.number("1e-8"), K.number("0.5e-8"))]
    assert abs(errors[0]) < 1e-13  # step^2 times a third derivative below 10^3
    assert abs(errors[0] / errors[1] - 4) < 1e-9


@given(x=FRACTIONS, y=FRACTIONS)
def test_several_variables_do_not_mix(x: Fraction, y: Fraction) -> None:
    """Decides that each partial is that of its own variable: the gradient of x y^2 / (1 + x^2), written out."""
    K = Duals(Exact(), 2)
    a, b = K.variable(x, 0), K.variable(y, 1)
    found = a * b**2 / (1 + a * a)
    assert found.value == x * y**2 / (1 + x * x)
    assert found.partials == (y**2 * (1 - x * x) / (1 + x * x) ** 2, 2 * x * y / (1 + x * x))


@given(q=FRACTIONS)
def test_duals_of_duals_carry_the_second_derivative(q: Fraction) -> None:
    inner = Duals(Exact(), 1)
    K = Duals(inner, 1)
    f, S = RATIONAL["quotient"], Series(3)
    twice = f(K.variable(inner.variable(q, 0), 0)).partials[0].partials[0]
    assert twice == 2 * S.coefficients(f(S.variable(q)))[2]


@pytest.mark.parametrize("base", [Exact(), Ball(25)], ids=lambda K: K.name)
def test_negative_powers(base: Arithmetic) -> None:
    """x^-2 has the slope -2 x^-3: whatever the base, and whatever the base's own numbers offer."""
    K = Duals(base, 1)
    power = K.variable(2, 0) ** -2
    assert base.is_zero(power.value - base.ratio(1, 4))
    assert base.is_zero(power.partials[0] - base.ratio(-1, 4))


def test_text_shows_value_and_slopes() -> None:
    K = Duals(Exact(), 2)
    assert K.text(K.along("1/2", [3, "-1/4"])) == "1/2 [3, -1/4]"
