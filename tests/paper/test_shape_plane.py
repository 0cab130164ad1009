"""Two dimensions: the same lines with distances that are rarely rational."""

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.errors import NotRepresentable, SingularMomentMatrix
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.basis import exponents, monomial
from rkverify.paper.shape import (
    DERIVATIVES,
    diffuse_gradient_slope,
    reproducing_residual,
    shape_functions,
    shape_gradient,
    shape_second,
)

Rounding = Callable[[Approximation, Vector], dict[int, float]]
DIGITS = 25
MP = Multiprecision(DIGITS)
GRID = 5
_jitter = np.random.default_rng(5).integers(-12, 13, size=(GRID * GRID, 2))
# A jittered grid of spacing 1 whose coordinates are 64ths: every arithmetic holds them.
NODES = [[i + Fraction(int(p), 64), j + Fraction(int(q), 64)]
         for (i, j), (p, q) in zip(np.ndindex(GRID, GRID), _jitter, strict=True)]  # fmt: skip
POINTS = [(Fraction(9, 4), Fraction(7, 4)), (Fraction(21, 16), Fraction(45, 16)), tuple(NODES[12])]
PYTHAGOREAN = [
    (0, 0),
    (3, 4),
    (-3, 4),
    (4, -3),
    (-5, 0),
    (0, 5),
    (5, 12),
    (-8, 6),
    (6, -8),
    (12, 5),
    (-12, -5),
    (8, -6),
]


def plane(K: Arithmetic, order: int, kernel: str = "cubic") -> Approximation:
    return approximation(NODES, "11/4", K, kernel, order)


def largest(values: dict[int, object]) -> float:
    return max(abs(float(v)) for v in values.values())


@pytest.mark.decides("E3", "E29")
@pytest.mark.parametrize("K", [Float(), MP], ids=lambda K: K.name)
def test_reproduction_in_the_plane(rounding: Rounding, order: int, K: Arithmetic) -> None:
    """All monomials up to the order, and for the next degree a residual that no rounding explains.

    sum_I Psi_I x_I^alpha with |x_I^alpha| <= 5^degree sums the rounding of Psi, and 25 products and sums more.
    """
    A = plane(K, order)
    for place in POINTS:
        x = A.point(*place)
        Psi = shape_functions(A, x)
        allowed = (sum(rounding(A, x).values()) + 27 * sum(map(abs, map(float, Psi.values())))) * K.epsilon / 2
        residuals = {alpha: abs(float(reproducing_residual(A, x, alpha))) for alpha in exponents(2, order + 1)}
        for alpha, residual in residuals.items():
            if sum(alpha) <= order:
                assert residual <= allowed * 5 ** sum(alpha)
        assert max(r for alpha, r in residuals.items() if sum(alpha) == order + 1) > 1e6 * allowed * 5 ** (order + 1)


def test_exact_numbers_say_where_distances_are_not_rational(order: int) -> None:
    with pytest.raises(NotRepresentable, match="mp:DIGITS"):
        shape_functions(plane(Exact(), order), POINTS[0])


def test_exact_numbers_work_where_distances_are_rational(order: int) -> None:
    """The twin: around the origin of Pythagorean points every residual is the rational 0, the next degree's is not.

    Decides (3), (29) in two dimensions without a tolerance.
    """
    A = approximation(PYTHAGOREAN, 17, Exact(), order=order)
    origin = A.point(0, 0)
    residuals = {alpha: reproducing_residual(A, origin, alpha) for alpha in exponents(2, order + 1)}
    assert all(r == 0 for alpha, r in residuals.items() if sum(alpha) <= order)
    assert any(r != 0 for alpha, r in residuals.items() if sum(alpha) == order + 1)


def test_gradients_are_slopes_of_duals(order: int) -> None:
    """Both partials at once, at points and at a node: the square root of duals is another way than g(z) = phi'(z)/z."""
    D = Duals(MP, 2)
    for place in POINTS:
        A, x = plane(MP, order), tuple(D.variable(c, axis) for axis, c in enumerate(place))
        moving = shape_functions(plane(D, order), x)
        for axis in (0, 1):
            for I, slope in shape_gradient(A, A.point(*place), axis).items():
                assert abs(slope - moving[I].partials[axis]) < 10.0**-DIGITS


@pytest.mark.parametrize("reading", DERIVATIVES)
def test_the_gradient_of_linear_fields(order: int, reading: str) -> None:
    """sum_I dPsi_I/dx_j x_I^alpha = d x^alpha/dx_j for |alpha| <= n with full and diffuse, and not with the frozen ones."""
    if reading == "diffuse" and order == 0:
        return
    A, x, nodes = plane(MP, order), POINTS[1], plane(MP, order).nodes
    for axis in (0, 1):
        slope = shape_gradient(A, A.point(*x), axis, reading)
        residuals = []
        for alpha in exponents(2, order):
            lowered = tuple(power - (j == axis) for j, power in enumerate(alpha))
            true = alpha[axis] * monomial(x, lowered, Exact()) if alpha[axis] else Fraction(0)
            found = sum((s * monomial(nodes[I], alpha, MP) for I, s in slope.items()), MP.zero())
            residuals.append(abs(found - MP.number(true)))
        assert (max(residuals) < 10.0**-DIGITS * 25) == (reading in ("full", "diffuse"))


def test_second_derivatives_are_slopes_of_gradients(order: int) -> None:
    """d2Psi/dx_j dx_k against duals of dPsi/dx_j, for all four pairs: the mixed ones agree, as they must."""
    D, place = Duals(MP, 2), POINTS[1]
    A, x = plane(MP, order), tuple(D.variable(c, axis) for axis, c in enumerate(place))
    for j in (0, 1):
        moving = shape_gradient(plane(D, order), x, j)
        for k in (0, 1):
            for I, second in shape_second(A, A.point(*place), (j, k)).items():
                assert abs(second - moving[I].partials[k]) < 10.0**-DIGITS * 10


def test_the_diffuse_gradient_has_a_slope_of_its_own() -> None:
    """Along the other axis as well, against duals: the diffuse derivative differentiated in full, which (81) needs."""
    D, place = Duals(MP, 2), POINTS[1]
    A, x = plane(MP, 1), tuple(D.variable(c, axis) for axis, c in enumerate(place))
    for j in (0, 1):
        moving = shape_gradient(plane(D, 1), x, j, "diffuse")
        for k in (0, 1):
            for I, slope in diffuse_gradient_slope(A, A.point(*place), (j, k)).items():
                assert abs(slope - moving[I].partials[k]) < 10.0**-DIGITS * 10


def test_second_derivatives_of_quadratic_fields() -> None:
    """sum Psi,jk x_I^alpha for alpha of degree 2: 2 on the diagonal, 1 mixed, 0 else; full and diffuse, also at a node."""
    A = plane(MP, 2)
    for reading in ("full", "diffuse"):
        for place in POINTS[1:]:
            for axes in ((0, 0), (0, 1), (1, 1)):
                second = shape_second(A, A.point(*place), axes, reading)
                wanted = tuple(axes.count(axis) for axis in (0, 1))
                for alpha in exponents(2, 2):
                    found = sum((s * monomial(A.nodes[I], alpha, MP) for I, s in second.items()), MP.zero())
                    expected = (2 if axes[0] == axes[1] else 1) if alpha == wanted else 0
                    assert abs(found - expected) < 10.0**-DIGITS * 25 * largest(second)


def test_a_gradient_is_the_limit_of_differences(order: int) -> None:
    """Central differences in y: the error falls by four for half the step, whatever the transcription thinks g(z) is."""
    A, (p, q) = plane(MP, order), POINTS[1]
    exact, errors = shape_gradient(A, A.point(p, q), 1), []
    for step in (Fraction(1, 10**6), Fraction(1, 2 * 10**6)):
        right, left = (shape_functions(A, A.point(p, q + s * step)) for s in (1, -1))
        errors.append({I: (right[I] - left[I]) / (2 * MP.number(step)) - exact[I] for I in exact if abs(exact[I]) > 0})
    # The next term is step^2 = 1e-12 times a ratio of derivatives below 1e6; rounding is 1e-35/1e-6 against errors above 1e-18.
    ratios = [errors[0][I] / errors[1][I] for I in errors[0] if abs(errors[0][I]) > 1e-18]
    assert len(ratios) >= 6
    assert max(abs(r - 4) for r in ratios) < 1e-6


LINE = [(-1, 0), (0, 0), (1, 0), (Fraction(1, 2), 0), (Fraction(-1, 3), 0)]
CIRCLE = [(Fraction(3, 5), Fraction(4, 5)), (Fraction(4, 5), Fraction(-3, 5)), (Fraction(-5, 13), Fraction(12, 13)),
          (-1, 0), (0, 1), (Fraction(-3, 5), Fraction(-4, 5)), (1, 0)]  # fmt: skip


@pytest.mark.parametrize(("nodes", "order", "off"), [(LINE, 1, (0, Fraction(1, 2))), (CIRCLE, 2, (0, 0))])
def test_nodes_on_a_curve_of_the_basis_are_refused(nodes: list, order: int, off: tuple) -> None:
    """Enough nodes, all on a line (order 1) or on a conic (order 2): a basis function vanishes on all, M is singular.

    Decides that counting nodes is not enough in the plane; one node off the curve and it is exact again.
    """
    for K in (Exact(), Float(), MP):
        A = approximation(nodes, 2, K, order=order)
        with pytest.raises(SingularMomentMatrix):
            shape_functions(A, A.point(0, 0))
    cured = approximation([*nodes, off], 2, Exact(), order=order)
    assert all(reproducing_residual(cured, cured.point(0, 0), alpha) == 0 for alpha in exponents(2, order))


def test_nodes_on_a_slanted_line_are_refused_in_doubles() -> None:
    """Rounding moves nodes off the line by an epsilon; the pivot that is left is rounding, and no answer may be built on it.

    A pivot is a difference of sums of N terms, off by (N + 2 size) epsilon/2 of the diagonal entry: a rule that accepts
    what is less than that accepts noise.
    """
    rng, accepted = np.random.default_rng(11), []
    for _ in range(300):
        slope, shift, x = rng.uniform(-2, 2), rng.uniform(-1, 1), rng.uniform(-1, 1)
        places = np.sort(rng.uniform(-1, 1, size=6))
        A = approximation([[float(t), float(slope * t + shift)] for t in places], 3.0, Float())
        try:
            shape_functions(A, (float(x), float(slope * x + shift)))
        except SingularMomentMatrix:
            continue
        accepted.append((slope, shift))
    assert accepted == []
