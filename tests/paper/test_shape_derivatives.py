"""Every reading of "the derivative of a shape function" against its own definition, computed another way."""

from collections.abc import Callable
from fractions import Fraction
from math import factorial

import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.series import Series
from rkverify.certify.independent import cubic_kernel_as_printed
from rkverify.certify.samples import NodeSet
from rkverify.errors import BadInput, UnknownName
from rkverify.paper.approximation import Approximation
from rkverify.paper.moment import coefficients
from rkverify.paper.shape import (
    DERIVATIVES,
    diffuse_gradient_slope,
    shape_functions,
    shape_gradient,
    shape_second,
)

Build = Callable[..., Approximation]
Points = Callable[[NodeSet], list[Fraction]]
STEP = Fraction(1, 10**7)
# Nine-point central differences: exact for polynomials up to degree 8 (first) and 9 (second), whatever the step.
FIRST = {1: Fraction(4, 5), 2: Fraction(-1, 5), 3: Fraction(4, 105), 4: Fraction(-1, 280)}
SECOND = {0: Fraction(-205, 72), 1: Fraction(8, 5), 2: Fraction(-1, 5), 3: Fraction(8, 315), 4: Fraction(-1, 560)}


def difference(f: Callable[[Fraction], Fraction], x: Fraction, derivative: int) -> Fraction:
    """f' or f'' at x: exactly, where f is one polynomial of degree 8 at most around x."""
    if derivative == 1:
        return sum((c * (f(x + n * STEP) - f(x - n * STEP)) for n, c in FIRST.items()), Fraction(0)) / STEP
    pairs = (c * (f(x + n * STEP) + f(x - n * STEP)) / (2 if n == 0 else 1) for n, c in SECOND.items())
    return sum(pairs, Fraction(0)) / STEP**2


def of(A: Approximation, x: Fraction, derivative: int, reading: str) -> dict[int, Fraction]:
    found = shape_gradient(A, (x,), 0, reading) if derivative == 1 else shape_second(A, (x,), (0, 0), reading)
    return {I: value for I, value in found.items() if A.distance((x,), I) < 1}


@pytest.mark.parametrize("derivative", [1, 2])
def test_full_is_the_coefficient_of_the_series(build: Build, nodes: NodeSet, order: int, derivative: int) -> None:
    """Psi(x + t) expanded exactly: at nodes, joints and edges as well, where the cubic kernel is C2."""
    A, S = build(nodes, order), Series(derivative + 1)
    for x in nodes.points:
        series = shape_functions(build(nodes, order, S), (S.variable(x),))
        expected = {I: factorial(derivative) * S.coefficients(Psi)[derivative] for I, Psi in series.items()}
        assert {I: v for I, v in of(A, x, derivative, "full").items() if v} == {I: v for I, v in expected.items() if v}


@pytest.mark.parametrize("derivative", [1, 2])
def test_full_is_the_limit_of_differences(
    build: Build, generic: Points, nodes: NodeSet, order: int, derivative: int
) -> None:
    """Central differences of Psi at 60 digits: the error falls by four for half the step, as order 2 demands.

    The next term is step^2 = 1e-20 times a ratio of derivatives, bounded by 1e12 for spacings of 1/8.
    """
    K, x = Multiprecision(60), generic(nodes)[1]
    A = build(nodes, order, K)

    def psi(at: object) -> dict[int, object]:
        return shape_functions(A, (at,))

    exact, at, middle = of(build(nodes, order), x, derivative, "full"), K.number(x), psi(K.number(x))
    errors = []
    for step in (K.number("1e-10"), K.number("5e-11")):
        right, left = psi(at + step), psi(at - step)
        quotient = {
            I: (right[I] - left[I]) / (2 * step) if derivative == 1 else (right[I] - 2 * middle[I] + left[I]) / step**2
            for I in exact
        }
        errors.append({I: quotient[I] - K.number(exact[I]) for I in exact})
    for I in exact:
        assert abs(errors[0][I] / errors[1][I] - 4) < 1e-8


@pytest.mark.parametrize("derivative", [1, 2])
def test_frozen_b_is_the_difference_with_b_held(
    build: Build, generic: Points, nodes: NodeSet, order: int, derivative: int
) -> None:
    """Polynomial times kernel with the coefficients b of the point x: a polynomial beside x, differenced exactly."""
    A = build(nodes, order)
    for x in generic(nodes):
        b = coefficients(A, (x,))
        for I, found in of(A, x, derivative, "frozen-b").items():

            def held(s: Fraction, I: int = I, b: list[Fraction] = b) -> Fraction:
                y = s - nodes.nodes[I]
                return sum(c * y**k for k, c in enumerate(b)) * cubic_kernel_as_printed(abs(y) / nodes.supports[I])

            assert found == difference(held, x, derivative)


@pytest.mark.parametrize("derivative", [1, 2])
def test_frozen_is_the_difference_of_the_kernel_alone(
    build: Build, generic: Points, nodes: NodeSet, order: int, derivative: int
) -> None:
    A = build(nodes, order)
    for x in generic(nodes):
        Psi = shape_functions(A, (x,))
        for I, found in of(A, x, derivative, "frozen").items():

            def kernel(s: Fraction, I: int = I) -> Fraction:
                return cubic_kernel_as_printed(abs(s - nodes.nodes[I]) / nodes.supports[I])

            assert found == Psi[I] / kernel(x) * difference(kernel, x, derivative)


def fit(nodes: NodeSet, x: Fraction, order: int, solver: Callable[..., list[Fraction]]) -> list[dict[int, Fraction]]:
    """Moving least squares: the Taylor coefficients at x of the best local polynomial, as weights of the nodal data."""
    weights = [cubic_kernel_as_printed(abs(x - n) / a) for n, a in zip(nodes.nodes, nodes.supports, strict=True)]
    normal = [
        [sum((w * (n - x) ** (i + j) for w, n in zip(weights, nodes.nodes, strict=True)), Fraction(0))
         for j in range(order + 1)]
        for i in range(order + 1)
    ]  # fmt: skip
    columns = {
        I: solver(normal, [weights[I] * (n - x) ** i for i in range(order + 1)])
        for I, n in enumerate(nodes.nodes)
        if weights[I]
    }
    return [{I: column[k] for I, column in columns.items()} for k in range(order + 1)]


def test_diffuse_is_the_derivative_of_the_local_fit(
    build: Build, nodes: NodeSet, solve_exactly: Callable[..., list[Fraction]]
) -> None:
    """The polynomial of best fit at x, differentiated with its coefficients held: decides the sign and the factorial."""
    for order in (1, 2):
        A = build(nodes, order)
        for x in nodes.points:
            taylor = fit(nodes, x, order, solve_exactly)
            assert of(A, x, 1, "diffuse") == taylor[1]
            assert order == 1 or of(A, x, 2, "diffuse") == {I: 2 * c for I, c in taylor[2].items()}


def test_the_slope_of_the_diffuse_derivative_is_its_series(build: Build, nodes: NodeSet) -> None:
    """The reading of Psi,xx(h) that goes with a diffuse Psi,x: everything in it differentiated once more."""
    S = Series(2)
    for order in (1, 2):
        for x in nodes.points:
            series = shape_gradient(build(nodes, order, S), (S.variable(x),), 0, "diffuse")
            expected = {I: S.coefficients(value)[1] for I, value in series.items()}
            assert diffuse_gradient_slope(build(nodes, order), (x,)) == expected


@pytest.mark.parametrize("reading", DERIVATIVES)
def test_which_readings_differentiate_polynomials(
    build: Build, generic: Points, nodes: NodeSet, order: int, reading: str
) -> None:
    """sum dPsi x_I^k = k x^(k-1) for k <= n holds for full and diffuse exactly, and for the frozen readings not.

    Decides which readings may stand in the weak form: a gradient that does not see a uniform strain is not one.
    """
    if reading == "diffuse" and order == 0:
        with pytest.raises(BadInput, match="raise the order"):
            shape_gradient(build(nodes, order), (nodes.points[0],), 0, reading)
        return
    A = build(nodes, order)
    residuals = []
    for x in generic(nodes):
        slope = of(A, x, 1, reading)
        moments = [sum(s * nodes.nodes[I] ** k for I, s in slope.items()) for k in range(order + 2)]
        residuals.append([m - (k * x ** (k - 1) if k else 0) for k, m in enumerate(moments)])
    for k, column in enumerate(zip(*residuals, strict=True)):
        assert (not any(column)) == (k <= order and reading in ("full", "diffuse"))


@pytest.mark.parametrize("reading", ["full", "diffuse"])
def test_second_derivatives_of_polynomials(build: Build, generic: Points, nodes: NodeSet, reading: str) -> None:
    A, x = build(nodes, 2), generic(nodes)[0]
    second = of(A, x, 2, reading)
    moments = [sum(s * nodes.nodes[I] ** k for I, s in second.items()) for k in range(4)]
    assert moments[:3] == [0, 0, 2]
    assert moments[3] != 6 * x


@pytest.mark.parametrize("call", [shape_gradient, shape_second])
def test_an_unknown_reading_lists_the_known_ones(build: Build, nodes: NodeSet, call: Callable[..., object]) -> None:
    axes = 0 if call is shape_gradient else (0, 0)
    with pytest.raises(UnknownName, match="choose one of diffuse, frozen, frozen-b, full"):
        call(build(nodes, 1), (nodes.points[0],), axes, "exact")
    if call is shape_second:
        with pytest.raises(BadInput, match="raise the order"):
            call(build(nodes, 1), (nodes.points[0],), axes, "diffuse")
