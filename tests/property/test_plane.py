"""Random rational nodes in two and three dimensions, in exact numbers: cells, sums, derivatives and rates without a tolerance."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.series import Series
from rkverify.certify.motions import bending, shear, stretch, turn
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.basis import exponents
from rkverify.paper.chain_rule import determinant, inverse
from rkverify.paper.material_rates import psi_star, true_rate
from rkverify.paper.nodal_polytopes import nodal_polytopes
from rkverify.paper.polytopes import Polytope, box
from rkverify.paper.shape import Values, reproducing_residual, shape_functions, shape_gradient, shape_second
from rkverify.paper.smoothing import integration_constraint, over_the_boundary, smoothed_gradients

K = Exact()
SMOOTH = sorted(name for name, kernel in KERNELS.items() if kernel.continuity >= 2)
SIDES = {2: 3, 3: 2}
ORDERS = st.integers(0, 2)
RULES = st.sampled_from(["trapezoid", "midpoint"])
MOTIONS = st.sampled_from([stretch, turn, shear, bending])
SPEEDS = st.integers(-6, 6).map(lambda n: Fraction(n, 4))


@dataclass(frozen=True)
class Nodes:
    """Nodes (N, d) about a grid, supports (N,), a point in the box, velocities of the point and the nodes, a kernel."""

    places: list[tuple]
    supports: list[Fraction]
    point: tuple
    velocity: tuple
    velocities: list[tuple]
    kernel: str

    @property
    def d(self) -> int:
        return len(self.point)

    def built(self, order: int, arithmetic: Arithmetic = K, places: list | None = None) -> Approximation:
        return approximation(places or self.places, self.supports, arithmetic, self.kernel, order, "tensor")

    def domain(self, arithmetic: Arithmetic = K) -> Polytope:
        return box([Fraction(-1, 2)] * self.d, [SIDES[self.d] - Fraction(1, 2)] * self.d, arithmetic)


@st.composite
def nodes(draw: st.DrawFn, dimensions: tuple[int, ...] = (2, 2, 2, 3)) -> Nodes:
    """Steps of eighths, at most three of them: small denominators, and often nodes in a row. Supports over the whole box,
    each its own, with the point anywhere or on the coordinates of a node.
    """
    d = draw(st.sampled_from(dimensions))
    grid = list(product(range(SIDES[d]), repeat=d))
    step, speeds = st.integers(-3, 3).map(lambda n: Fraction(n, 8)), st.tuples(*[SPEEDS] * d)
    places = [tuple(c + draw(step) for c in place) for place in grid]
    free = tuple(Fraction(draw(st.integers(-4, 8 * SIDES[d] - 4)), 8) for _ in range(d))
    near = draw(st.sampled_from(places))
    point = tuple(draw(st.sampled_from(pair)) for pair in zip(free, near, strict=True))
    return Nodes(
        places,
        [Fraction(draw(st.integers(14, 18)) + 4 * (d == 2), 4) for _ in places],
        point,
        draw(speeds),
        [draw(speeds) for _ in places],
        draw(st.sampled_from(SMOOTH)),
    )


def gap(one: Values, other: Values) -> Fraction:
    return max(abs(one.get(I, 0) - other.get(I, 0)) for I in one.keys() | other.keys())


def possible(at: Nodes, order: int) -> bool:
    """Eight nodes in space are too few for ten functions, and a jittered cube may lie on a quadric: orders below 2 there."""
    return at.d == 2 or order < 2


@pytest.mark.decides("E3", "E29")
@given(at=nodes(), order=ORDERS, motion=MOTIONS, t=st.sampled_from([Fraction(1, 8), Fraction(1, 4)]))
def test_reproduction_before_and_after_a_motion(at: Nodes, order: int, motion: Callable, t: Fraction) -> None:
    """Every monomial up to the order, on the nodes and on what a motion makes of them, with the point going along."""
    assume(possible(at, order))
    moved = motion(t)
    for A, x in (
        (at.built(order), at.point),
        (at.built(order, places=[moved.forth(place) for place in at.places]), moved.forth(at.point)),
    ):
        assert all(reproducing_residual(A, x, alpha) == 0 for alpha in exponents(at.d, order))


@given(at=nodes(), order=ORDERS)
def test_the_twin_where_reproduction_stops(at: Nodes, order: int) -> None:
    """Of the next degree something is left, unless the point is one that its neighbours single out: at two points it is not both."""
    assume(possible(at, order))
    A = at.built(order)
    points = [at.point, tuple(c + Fraction(j + 1, 37) for j, c in enumerate(at.point))]
    higher = [alpha for alpha in exponents(at.d, order + 1) if sum(alpha) == order + 1]
    assert any(reproducing_residual(A, x, alpha) != 0 for x in points for alpha in higher)


@given(at=nodes((2,)), order=st.integers(0, 1), u=st.tuples(SPEEDS, SPEEDS))
def test_derivatives_along_a_line_are_series(at: Nodes, order: int, u: tuple) -> None:
    """Psi(x + t u) to t^2: u.grad and u.(grad grad).u / 2 of the formulas, all pairs of axes at once; coordinates of nodes,
    where |y_j| has no slope, among the points.
    """
    S = Series(3)
    A = at.built(order)
    line = shape_functions(at.built(order, S), tuple(S.variable(c, v) for c, v in zip(at.point, u, strict=True)))
    terms = {I: S.coefficients(Psi) for I, Psi in line.items()}
    first = [shape_gradient(A, at.point, j) for j in range(2)]
    assert (
        gap(
            {I: sum(v * g[I] for v, g in zip(u, first, strict=True)) for I in first[0]},
            {I: c[1] for I, c in terms.items()},
        )
        == 0
    )
    if all(len(c) == 3 for c in terms.values()):  # a C2 kernel has no more where a joint is met
        pairs = {(j, k): shape_second(A, at.point, (j, k)) for j, k in product(range(2), repeat=2)}
        along = {I: sum(u[j] * u[k] * s[I] for (j, k), s in pairs.items()) for I in pairs[0, 0]}
        assert gap(along, {I: 2 * c[2] for I, c in terms.items()}) == 0


@given(at=nodes(), order=st.integers(0, 1))
def test_material_rates_are_series_in_time(at: Nodes, order: int) -> None:
    """Point and nodes move: the true rate is the series' first term, and sums to 0; Psi* does where the correction is constant in time."""
    S = Series(2)
    moving = at.built(
        order,
        S,
        [[S.variable(*c) for c in zip(x, v, strict=True)] for x, v in zip(at.places, at.velocities, strict=True)],
    )
    y = tuple(S.variable(*c) for c in zip(at.point, at.velocity, strict=True))
    series = {I: S.coefficients(Psi)[1] for I, Psi in shape_functions(moving, y).items()}
    true = true_rate(at.built(order), at.point, at.velocity, at.velocities)
    assert gap(true, series) == 0
    assert sum(true.values()) == 0
    together = [at.velocity] * len(at.places)
    for rate in (true_rate, psi_star):
        assert not any(rate(at.built(order), at.point, at.velocity, together).values())


@given(at=nodes(), boost=st.integers(-5, 5), unit=st.sampled_from([Fraction(1, 3), Fraction(7)]))
def test_cells_do_not_see_origin_unit_axes_or_numbering(at: Nodes, boost: int, unit: Fraction) -> None:
    """They tile, and measures go as unit^d; the numbering turned back, axes exchanged: the same cells, exactly."""
    here = [cell.measure for cell in nodal_polytopes(at.places, at.domain(), K)]
    assert sum(here) == at.domain().measure
    assert min(here) > 0

    def mapped(place: tuple) -> tuple:
        return tuple(unit * (c + boost) for c in place[::-1])

    low, high = (mapped(corner) for corner in (at.domain().corners[0], at.domain().corners[-1]))
    there = nodal_polytopes([mapped(place) for place in at.places[::-1]], box(low, high, K), K)
    assert [cell.measure for cell in there[::-1]] == [unit**at.d * measure for measure in here]


@pytest.mark.decides("E17", "E23", "C17")
@given(at=nodes((2,)), order=st.integers(0, 1), rule=RULES)
def test_sums_of_smoothed_gradients_in_the_plane(at: Nodes, order: int, rule: str) -> None:
    """sum_I b_iI = 0, with order 1 sum_I b_iI X_jI = delta_ij, and over the cells the integration constraint for any order."""
    A = replace(at, kernel="cubic").built(order)  # of the lowest degree: its rationals are the shortest
    same: dict[tuple, tuple] = {}
    cells = [
        Polytope(tuple(same.setdefault(x, x) for x in cell.corners), cell.facets, cell.beyond)
        for cell in nodal_polytopes(at.places, at.domain(), K)
    ]
    gradients = [smoothed_gradients(A, cell, rule) for cell in cells]
    for b, i, j in product(gradients, range(2), range(2)):
        assert sum(b[i].values()) == 0
        linear = sum(value * at.places[I][j] for I, value in b[i].items())
        assert order == 0 or linear == int(i == j)
    assert integration_constraint(gradients, cells, K) == over_the_boundary(A, cells, rule)


@given(at=nodes((2,)), node=st.integers(0, 8), axis=st.integers(0, 1))
def test_cells_change_with_their_nodes(at: Nodes, node: int, axis: int) -> None:
    """dA_L/dx by duals is the integral of the facets' shift: int (x - x_J).e / |x_I - x_J| over the facet of the moved node.

    For a facet between the moved node I and J the flux is its length times (m - x_I).e / |x_J - x_I| with its middle m;
    the length over |x_J - x_I| is the ratio of parallel vectors, a rational. Where four cells meet it is still right.
    """
    D = Duals(K, 1)
    moved = [
        tuple(D.variable(c, 0) if (J, j) == (node, axis) else D.number(c) for j, c in enumerate(x))
        for J, x in enumerate(at.places)
    ]
    slopes = [cell.measure.partials[0] for cell in nodal_polytopes(moved, at.domain(D), D)]
    cell = nodal_polytopes(at.places, at.domain(), K)[node]
    flux = dict.fromkeys(range(len(at.places)), Fraction(0))
    for f, J in enumerate(cell.beyond):
        if J is not None:
            start, end = cell.places(f)
            towards = tuple(q - p for p, q in zip(at.places[node], at.places[J], strict=True))
            ratio = sum(a * t for a, t in zip(cell.area(f), towards, strict=True)) / sum(t * t for t in towards)
            shift = ratio * ((start[axis] + end[axis]) / 2 - at.places[node][axis])
            flux[node] += shift
            flux[J] -= shift
    assert slopes == [flux[J] for J in range(len(at.places))]


@given(entries=st.lists(st.fractions(-3, 3, max_denominator=9), min_size=9, max_size=9), d=st.sampled_from([1, 2, 3]))
def test_cofactors_invert(entries: list, d: int) -> None:
    """F F^-1 = 1 and det F det F^-1 = 1, for any matrix that has an inverse."""
    F = [entries[3 * i : 3 * i + d] for i in range(d)]
    assume(determinant(F) != 0)
    back = inverse(F, K)
    assert [[sum(F[i][k] * back[k][j] for k in range(d)) for j in range(d)] for i in range(d)] == [
        [int(i == j) for j in range(d)] for i in range(d)
    ]
    assert determinant(F) * determinant(back) == 1
