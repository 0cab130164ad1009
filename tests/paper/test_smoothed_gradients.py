"""Smoothed gradients over cells in one to three dimensions: sums, constraint, rules, and what they are the average of."""

from fractions import Fraction
from itertools import product

import pytest

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.certify.samples import jittered_grid
from rkverify.errors import BadInput, NotDifferentiable, NotRepresentable, UnknownName
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.cells import Cell
from rkverify.paper.chain_rule import determinant, inverse, spatial_gradients
from rkverify.paper.gauss import gauss_points
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.nodal_polytopes import nodal_polytopes
from rkverify.paper.polytopes import Polytope, box, polygon
from rkverify.paper.quadrature import cell_points, facet_points
from rkverify.paper.shape import shape_functions
from rkverify.paper.smoothing import (
    approximated,
    approximated_gradient,
    boundary_average,
    deformation_from_boundary,
    deformation_from_cell,
    direct_gradients,
    displacement_gradient,
    integration_constraint,
    over_the_boundary,
    smoothed_gradients,
)

K, F, MP = Exact(), Float(), Multiprecision(20)
SIDES = {1: 5, 2: 3, 3: 2}
RULES = ("trapezoid", "midpoint")
SPACES = pytest.mark.parametrize("d", [1, 2, 3])


def setting(
    d: int, order: int = 1, arithmetic: Arithmetic = K, supports: str = "5/2"
) -> tuple[Approximation, list[Polytope]]:
    A = approximation(jittered_grid(d, SIDES[d], 3), supports, arithmetic, order=order, window="tensor")
    half = Fraction(1, 2)
    return A, nodal_polytopes(A.nodes, box([-half] * d, [SIDES[d] - half] * d, arithmetic), arithmetic)


@pytest.mark.decides("E17", "E23", "E47")
@pytest.mark.parametrize("rule", RULES)
@SPACES
def test_sums_are_exact_with_every_rule(d: int, rule: str) -> None:
    """sum_I b_iI = 0 and sum_I b_iI X_jI = delta_ij in every cell: Psi reproduces 1 and X at the points, and a rule that is
    exact for linear functions integrates N and X N. Rationals leave nothing for rounding to explain.

    The twin: the sums with X_j X_k are the rule's own, not those of the cell.
    """
    A, cells = setting(d)
    beyond = []
    for cell in cells:
        b = smoothed_gradients(A, cell, rule)
        for i in range(d):
            assert sum(b[i].values()) == 0
            for j in range(d):
                assert sum(value * A.nodes[I][j] for I, value in b[i].items()) == int(i == j)
        exact = sum(w * 2 * x[0] for x, w in cell_points(cell, 1, K)) / cell.measure
        beyond.append(sum(value * A.nodes[I][0] ** 2 for I, value in b[0].items()) - exact)
    assert any(beyond)


@pytest.mark.parametrize("d", [2, 3])
def test_the_trapezoid_is_at_the_corners_and_the_midpoint_is_one_point(d: int) -> None:
    """Both are exact for linear functions and no further, so that nothing else tells one rule from the other."""
    P = setting(d)[1][0]
    for f in range(len(P.facets)):
        assert [x for x, _ in facet_points(P, f, "trapezoid", K)] == P.places(f)
        ((middle, weight),) = facet_points(P, f, "midpoint", K)
        assert weight == 1
        assert middle not in P.places(f)


def test_order_zero_keeps_constants_and_not_linear_fields() -> None:
    """The twin in the order: without completeness of first order sum_I b_iI X_jI is not delta_ij."""
    A, cells = setting(2, 0)
    linear = [smoothed_gradients(A, cell)[0] for cell in cells]
    assert all(sum(b.values()) == 0 for b in linear)
    assert any(sum(value * A.nodes[I][0] for I, value in b.items()) != 1 for b in linear)


@pytest.mark.decides("C17")
@pytest.mark.parametrize("rule", RULES)
@SPACES
def test_the_integration_constraint(d: int, rule: str) -> None:
    """sum_L b_iI A_L = int_Gamma Psi_I N_i: what one cell adds on a facet its neighbour takes away; exact for every rule.

    The twin: the direct gradients, with the same weights, miss it.
    """
    A, cells = setting(d)
    smooth = integration_constraint([smoothed_gradients(A, cell, rule) for cell in cells], cells, K)
    assert smooth == over_the_boundary(A, cells, rule)
    assert integration_constraint([direct_gradients(A, x) for x in A.nodes], cells, K) != smooth


@pytest.mark.parametrize("order", [0, 1, 2])
def test_on_a_line_it_is_the_difference_of_the_ends(order: int) -> None:
    """(52) is (17) in one dimension, whatever the rule."""
    A, cells = setting(1, order, supports="7/2")
    for cell in cells:
        ends = Cell(cell.places(0)[0][0], cell.places(1)[0][0])
        for rule in (*RULES, "gauss:1"):
            assert smoothed_gradients(A, cell, rule) == (smoothed_gradient(A, ends),)


@pytest.mark.decides("E14", "E15", "E16")
@SPACES
def test_three_ways_to_the_smoothed_deformation(d: int) -> None:
    """(15) + delta of u^h, and (16) + delta from the operator: the same sum in another order, exactly; coefficients arbitrary."""
    A, cells = setting(d)
    coefficients = [tuple(Fraction((7 * I + 3 * i) % 11 - 5, 4) for i in range(d)) for I in range(len(A.nodes))]
    for cell in cells[:3]:
        for rule in RULES:
            e = boundary_average(cell, approximated(A, coefficients), rule, K)
            assert displacement_gradient(smoothed_gradients(A, cell, rule), coefficients, K) == e
            bar = deformation_from_boundary(e, K)
            assert [[bar[i][j] - e[i][j] for j in range(d)] for i in range(d)] == [
                [int(i == j) for j in range(d)] for i in range(d)
            ]


@pytest.mark.decides("E13", "E14", "C18")
@SPACES
def test_the_divergence_theorem_on_polynomial_fields(d: int) -> None:
    """(13) is (14) for linear u with every rule; for quadratic u with (13) taken exactly and the edges by a rule that is
    exact for squares, which trapezoid and midpoint are not: the twin.
    """
    axes = range(d)

    def linear(X: tuple) -> tuple:
        return tuple(sum(((i + 2) * (j + 1) * X[j] for j in axes), 3) for i in axes)

    def square(X: tuple) -> tuple:
        return tuple(sum(((i + j + 1) * X[i] * X[j] for j in axes), 0) for i in axes)

    def slope(X: tuple) -> list:
        return [[(i + k + 1) * X[i] + int(i == k) * sum((i + j + 1) * X[j] for j in axes) for k in axes] for i in axes]

    for cell in setting(d)[1][:3]:
        inside = cell_points(cell, 1, K)
        flat = deformation_from_cell(cell, lambda _: [[(i + 2) * (j + 1) for j in axes] for i in axes], inside, K)
        for rule in RULES:
            assert deformation_from_boundary(boundary_average(cell, linear, rule, K), K) == flat
        average = deformation_from_cell(cell, slope, inside, K)
        trapezoid, midpoint = (deformation_from_boundary(boundary_average(cell, square, rule, K), K) for rule in RULES)
        if d == 1:
            assert trapezoid == midpoint == average
        if d == 2:  # two midpoints and a trapezoid are Simpson's rule
            assert trapezoid != average != midpoint
            assert [
                [(2 * m + t) / 3 for m, t in zip(*rows, strict=True)] for rows in zip(midpoint, trapezoid, strict=True)
            ] == average
    cell = setting(d, 1, MP)[1][0]
    exact = deformation_from_cell(cell, slope, cell_points(cell, 1, MP), MP)
    gauss = deformation_from_boundary(boundary_average(cell, square, "gauss:2", MP), MP)
    assert max(abs(gauss[i][j] - exact[i][j]) for i in axes for j in axes) < 100 * MP.epsilon


@SPACES
def test_the_gradient_of_the_field_is_its_slope(d: int) -> None:
    """In full, against duals; a diffuse one of order 1 gives the same for linear fields alone, so the field is not linear."""
    D = Duals(F, d)
    A, moving = setting(d, 1, F)[0], setting(d, 1, D)[0]
    u = [tuple(1.0 + (i + 1) * x[0] ** 2 - x[-1] for i in range(d)) for x in A.nodes]
    place = [1.0 + axis / 8 for axis in range(d)]
    slopes = approximated(moving, u)(tuple(D.variable(c, axis) for axis, c in enumerate(place)))
    found = approximated_gradient(A, u)(tuple(place))
    for i in range(d):
        for j in range(d):
            # values up to 30, condition numbers of some hundreds
            assert abs(found[i][j] - slopes[i].partials[j]) < 1e-11


@SPACES
def test_rules_are_exact_to_their_degree_and_no_further(d: int) -> None:
    """Monomials over a facet and over the cell, against more Gauss points; degree 2N for N points is the twin."""
    P = setting(d, 1, F)[1][0]
    rounding = 1000 * F.epsilon  # sums of up to 500 weights of one sign, of terms below 2
    f = next(k for k, label in enumerate(P.beyond) if label is not None)

    def mean(points: list, alpha: tuple) -> object:
        total = F.zero()
        for x, w in points:
            term = w
            for c, power in zip(x, alpha, strict=True):
                term = term * c**power
            total = total + term
        return total

    def worst(coarse: list, fine: list, degree: int) -> float:
        alphas = [alpha for alpha in product(range(degree + 1), repeat=d) if sum(alpha) == degree]
        return max(abs(float(mean(coarse, alpha) - mean(fine, alpha))) for alpha in alphas)

    fine, whole = facet_points(P, f, "gauss:4", F), cell_points(P, 4, F)
    for rule, degree in (("trapezoid", 1), ("midpoint", 1), ("gauss:1", 1), ("gauss:2", 3), ("gauss:3", 5)):
        points = facet_points(P, f, rule, F)
        assert max(worst(points, fine, k) for k in range(degree + 1)) < rounding
        assert d == 1 or worst(points, fine, degree + 1) > 1e-8
    for count in (1, 2, 3):
        points = cell_points(P, count, F)
        assert max(worst(points, whole, k) for k in range(2 * count)) < rounding
        assert worst(points, whole, 2 * count) > 1e-8


def test_gauss_points_are_known_ones() -> None:
    """N = 2 on [0, 1]: 1/2 -+ sqrt(3)/6, weights 1/2; the N = 1 point for the density 2 t is at 2/3, a rational."""
    (low, half), (high, other) = gauss_points(2, 0, MP)
    assert max(abs(v) for v in (low + high - 1, high - low - MP.sqrt(MP.ratio(1, 3)), half - other)) < 4 * MP.epsilon
    assert gauss_points(1, 1, K) == [(Fraction(2, 3), 1)]
    with pytest.raises(NotRepresentable, match="Gauss points are irrational and arithmetic 'exact' does not round"):
        gauss_points(2, 0, K)
    with pytest.raises(BadInput, match="0 Gauss points are not offered"):
        gauss_points(0, 0, F)
    with pytest.raises(UnknownName, match="unknown edge rule 'simpson'"):
        facet_points(box([0, 0], [1, 1], F), 0, "simpson", F)


def test_smoothed_gradients_differentiate_with_the_nodes() -> None:
    """Cells and shape functions move together: duals, in rationals, against a complex step of 1e-100, which does not cancel.

    Some 1000 operations on numbers below 10.
    """
    D, C = Duals(K, 1), Complex()
    places = jittered_grid(2, 3, 3)

    def built(arithmetic: Arithmetic, by: object) -> dict:
        nodes = [[arithmetic.number(c) for c in place] for place in places]
        nodes[4][1] = nodes[4][1] + by
        A = approximation(nodes, "5/2", arithmetic, window="tensor")
        whole = box(["-1/2"] * 2, ["5/2"] * 2, arithmetic)
        return smoothed_gradients(A, nodal_polytopes(A.nodes, whole, arithmetic)[3])[0]

    slopes, stepped = built(D, D.variable(0, 0)), built(C, 1e-100j)
    assert max(abs(float(s.partials[0])) for s in slopes.values()) > 0.01
    assert sum(s.partials[0] for s in slopes.values()) == 0
    assert max(abs(float(s.partials[0]) - stepped[I].imag / 1e-100) for I, s in slopes.items()) < 1e4 * F.epsilon


def test_a_lattice_is_a_kink_of_the_rule() -> None:
    """Where four cells meet and part, the trapezoidal rule over two pieces of a side is not that over the whole: one-sided
    differences have different limits, and the derivative is refused, naming the corner; measures have theirs.

    The twin: with the moved node off the lattice, so that three meet, duals agree with the differences.
    """
    D, up, half = Duals(K, 1), Fraction(1, 1000), Fraction(1, 2)

    def built(arithmetic: Arithmetic, by: object, off: Fraction) -> dict:
        nodes = [[arithmetic.number(c) for c in place] for place in product(range(3), repeat=2)]
        nodes[4] = [nodes[4][0] + off + by, nodes[4][1] + off / 3 + by / 3]
        A = approximation(nodes, "5/2", arithmetic, window="tensor")
        cells = nodal_polytopes(A.nodes, box([-half] * 2, [2 + half] * 2, arithmetic), arithmetic)
        return smoothed_gradients(A, cells[4])[0]

    def one_sided(off: Fraction, step: Fraction) -> dict:
        at_rest, ahead = built(K, Fraction(0), off), built(K, step, off)
        return {I: (ahead[I] - at_rest[I]) / step for I in ahead}

    with pytest.raises(NotDifferentiable, match=r"more cells than 3 meet at \(.*1/2.*move a node a little"):
        built(D, D.variable(0, 0), Fraction(0))
    jump = [max(abs(p - q) for p, q in zip(one_sided(Fraction(0), s).values(), one_sided(Fraction(0), -s).values(), strict=True))
            for s in (up, up / 2)]  # fmt: skip
    assert min(jump) > Fraction(1, 100)
    slopes = built(D, D.variable(0, 0), Fraction(1, 9))
    errors = [
        max(abs(d - slopes[I].partials[0]) for I, d in one_sided(Fraction(1, 9), s).items()) for s in (up, up / 2)
    ]
    assert abs(errors[0] / errors[1] - 2) < Fraction(1, 20)


def test_a_moved_cell_has_moved_gradients() -> None:
    """Translation leaves b, a quarter turn exchanges its axes, a doubled unit halves it: exactly, for a polygonal domain."""
    corners = [(-1, -1), (3, -1), (4, 2), (2, 4), (-1, 3)]
    places = jittered_grid(2, 3, 5)

    def built(place: object, unit: int = 1) -> tuple:
        A = approximation([place(*p) for p in places], Fraction(5 * unit, 2), K, window="tensor")
        return smoothed_gradients(A, nodal_polytopes(A.nodes, polygon([place(*c) for c in corners], K), K)[4])

    here = built(lambda x, y: (x, y))
    assert built(lambda x, y: (x + 7, y - Fraction(1, 3))) == here
    turned = built(lambda x, y: (-y, x))
    assert (turned[1], {I: -v for I, v in turned[0].items()}) == here
    assert built(lambda x, y: (2 * x, 2 * y), 2) == tuple({I: v / 2 for I, v in b.items()} for b in here)


@pytest.mark.decides("E25")
@SPACES
def test_the_chain_rule_on_an_affine_map(d: int) -> None:
    """x = F X + c: the shape function as a function of x, differentiated by duals through X = F^-1 (x - c), exactly."""
    rows = [[Fraction(3 * i + 5 * j + 1 + 6 * int(i == j), 7) for j in range(d)] for i in range(d)]
    A, D = setting(d)[0], Duals(K, d)
    X = tuple(Fraction(4 + j, 9) for j in range(d))
    back = inverse(rows, K)
    assert [[sum(rows[i][k] * back[k][j] for k in range(d)) for j in range(d)] for i in range(d)] == [
        [int(i == j) for j in range(d)] for i in range(d)
    ]
    assert determinant(rows) * determinant(back) == 1
    dx = [D.variable(0, i) for i in range(d)]
    mapped = tuple(X[j] + sum((back[j][i] * dx[i] for i in range(d)), D.zero()) for j in range(d))
    B = approximation(jittered_grid(d, SIDES[d], 3), "5/2", D, window="tensor")
    found = spatial_gradients(direct_gradients(A, X), rows, K)
    for I, Psi in shape_functions(B, mapped).items():
        assert tuple(found[i][I] for i in range(d)) == Psi.partials
    with pytest.raises(BadInput, match="determinant 0"):
        inverse([[1, 2], [2, 4]], K)
