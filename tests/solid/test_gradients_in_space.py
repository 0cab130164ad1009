"""Gradient operators: linear sums, the integration constraint, and what edge rules share and where they part.

sum_I b_iI^L = 0 and sum_I b_iI^L x_jI = delta_ij make the gradient of a linear field exact; sum_L A_L b_iI^L = integral of
Psi_I n_i over the boundary makes the patch test pass. An operator may have one without the other, so each has a twin.
"""

import itertools

import numpy as np
import pytest
import shapely

from rkverify.errors import BadInput, TooFewNodes, UnknownName
from rkverify.readings import DERIVATIVES
from rkverify.solid.boxes import boxes
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import cloud
from rkverify.solid.domain import box, polygon_domain
from rkverify.solid.edge_rules import facet_rule
from rkverify.solid.gradients import boundary_integrals, constraint_residual, dni, scni, snni, sums
from rkverify.solid.shape import condition_numbers, shape
from rkverify.solid.voronoi import moved, rings, topology, voronoi

EPS = 2.0**-52
RULES = ("trapezoid", "midpoint", "gauss:1", "gauss:2", "gauss:5")
L_WITH_HOLE = [
    [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)],
    [(0.6, 0.6), (1.4, 0.6), (1.4, 1.4), (0.6, 1.4)],
]
DOMAINS = {1: box([0], [6]), 2: polygon_domain(L_WITH_HOLE), 3: box([0, 0, 0], [3, 3, 3])}
SPACING = {1: 1.0, 2: 0.5, 3: 1.0}


def nodes(d, seed=5):
    """Jittered by up to 0.3 of a spacing; those that leave the domain are dropped."""
    domain, h = DOMAINS[d], SPACING[d]
    low, high = domain.bounds
    axes = [np.arange(low[j] + h / 2, high[j], h) for j in range(d)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, d)
    x = x + np.random.default_rng(seed).uniform(-0.3, 0.3, x.shape) * h
    return x[domain.contains(x)]


def approximation(d, order=1, window="radial", seed=5):
    x = nodes(d, seed)
    own = np.random.default_rng(seed + 1).uniform(1.0, 1.2, len(x))
    return cloud(x, (2.0 + order) * own * SPACING[d] * (1.2 if d == 3 else 1), "cubic", order, window), voronoi(
        x, DOMAINS[d]
    )


def rounding(C, points, cells):
    """What rounding leaves of sum_I b_iI x_jI: perimeter over measure, times coordinates, times that of Psi at the points.

    A sum over the neighbours of Psi is off by its condition number times EPS times some tens of operations.
    """
    perimeter = np.zeros(len(cells))
    sizes = np.sqrt((cells.areas**2).sum(axis=1))
    for side in cells.sides.T:
        np.add.at(perimeter, side[side >= 0], sizes[side >= 0])
    reach = abs(C.positions).max()
    return 30 * EPS * condition_numbers(C, points).max() * (perimeter / cells.measures).max() * (1 + reach)


@pytest.mark.parametrize("window", ["radial", "tensor"])
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("d", [1, 2, 3])
def test_linear_fields_have_their_gradient_with_any_rule(d, order, window):
    C, cells = approximation(d, order, window)
    for rule in RULES:
        points = facet_rule(cells, rule).points
        for part in sums(scni(C, cells, rule), C.positions):
            assert abs(part).max() <= rounding(C, points, cells)
    for operator in (snni(C, cells.measures), dni(C, cells.measures)):
        for part in sums(operator, C.positions):
            assert abs(part).max() <= 4 * rounding(C, points, cells)  # boxes leave the domain, and see fewer nodes


@pytest.mark.parametrize("d", [1, 2, 3])
def test_without_a_linear_basis_linear_fields_have_another_gradient(d):
    C, cells = approximation(d, order=0)
    constant, linear = sums(scni(C, cells), C.positions)
    assert abs(constant).max() <= rounding(C, facet_rule(cells).points, cells)
    assert abs(linear).max() > 0.05


def centroids(cells):
    """Of plane cells, by the library that clips polygons; it knows nothing of facets and rules."""
    found = []
    for L in range(len(cells)):
        outer, *holes = rings(cells, L)
        found.append(shapely.get_coordinates(shapely.centroid(shapely.Polygon(outer, holes)))[0])
    return np.array(found)


def quadratic_error(C, cells, rule):
    """sum_I b_iI x_jI x_kI against the mean of the gradient of x_j x_k, over all i, j, k, L."""
    x, c = C.positions, centroids(cells)
    operator = scni(C, cells, rule)
    worst = 0.0
    for j, k in itertools.combinations_with_replacement(range(2), 2):
        exact = np.zeros((len(cells), 2))
        exact[:, j] += c[:, k]
        exact[:, k] += c[:, j]
        worst = max(worst, abs(operator.apply((x[:, j] * x[:, k])[:, None])[:, 0] - exact).max())
    return worst


def test_quadratic_fields_need_a_quadratic_basis_and_a_rule_of_degree_two():
    """Only both together give the mean gradient of a quadratic field: a linear test sees neither."""
    exact = approximation(2, order=2)
    allowed = rounding(exact[0], facet_rule(exact[1], "gauss:2").points, exact[1]) * abs(exact[0].positions).max()
    assert quadratic_error(*exact, "gauss:2") <= allowed
    assert quadratic_error(*exact, "trapezoid") > 1e-3
    assert quadratic_error(*exact, "midpoint") > 1e-3
    assert quadratic_error(*approximation(2, order=1), "gauss:2") > 1e-3


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_integration_constraint_holds_for_scni(d):
    """What a facet gives to one cell it takes from the other, whatever is evaluated there."""
    C, cells = approximation(d)
    for rule in RULES:
        operator = scni(C, cells, rule)
        # Each of some hundred facets of size one under a kernel is added and taken away, divided and multiplied by A_L.
        assert (
            abs(constraint_residual(operator)).max()
            <= 1000 * EPS * abs(shape(C, facet_rule(cells).points).values).max()
        )
        assert abs(operator.boundary).max() > 0.1
        assert np.array_equal(operator.boundary, boundary_integrals(C, cells, rule))


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_integration_constraint_fails_for_direct_integration_and_for_boxes(d):
    C, cells = approximation(d)
    boundary = boundary_integrals(C, cells, "gauss:8")
    for operator in (dni(C, cells.measures, boundary=boundary), snni(C, cells.measures, boundary=boundary)):
        assert abs(constraint_residual(operator)).max() > 1e-2 * abs(boundary).max()


def test_boundary_integrals_are_those_of_the_domain():
    """The sum over all nodes is the integral of n, zero; with coordinates it is the domain's measure."""
    for d in (1, 2, 3):
        C, cells = approximation(d)
        boundary = boundary_integrals(C, cells, "gauss:3")
        allowed = rounding(C, facet_rule(cells).points, cells) * DOMAINS[d].measure
        assert abs(boundary.sum(axis=1)).max() <= allowed
        assert abs(boundary @ C.positions - DOMAINS[d].measure * np.eye(d)).max() <= allowed


def test_rules_part_where_functions_bend():
    C, cells = approximation(2)
    dense = [
        np.stack([p.toarray() for p in scni(C, cells, rule).parts]) for rule in ("trapezoid", "midpoint", "gauss:8")
    ]
    for one, other in itertools.combinations(dense, 2):
        assert abs(one - other).max() > 1e-3 * abs(other).max()


def test_in_one_dimension_all_rules_are_one():
    C, cells = approximation(1)
    one, other = (scni(C, cells, rule).parts[0].toarray() for rule in ("trapezoid", "gauss:4"))
    assert np.array_equal(one, other)


def test_gauss_points_converge_to_the_mean_of_the_gradient_over_the_cell():
    """An integral over the cell's area, with full derivatives, knows nothing of edges.

    The cubic kernel's third derivative jumps at its joints, so that N points leave an error of order N^-4 at best: from 4
    to 16 points it falls by 4^4 = 256, of which at least 16 must be seen whatever the joints do.
    """
    x = nodes(2)
    C, cells = cloud(x, 1.1), voronoi(x, DOMAINS[2])
    inner = [L for L in range(len(cells)) if not (cells.sides[cells.sides[:, 0] == L, 1] < 0).any()][:6]
    s, w = np.polynomial.legendre.leggauss(40)
    s, w = (1 + s) / 2, w / 2
    errors = {}
    means = {}
    for L in inner:
        (ring,) = rings(cells, L)
        total = np.zeros((2, len(x)))
        for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):  # convex: a fan of triangles about the node
            r, t = (g.ravel() for g in np.meshgrid(s, s))
            points = x[L] + r[:, None] * (a + t[:, None] * (b - a) - x[L])
            weights = np.outer(w, w).ravel() * r * np.linalg.det([a - x[L], b - x[L]])
            there = shape(C, points, 1)
            total += np.stack([weights @ there.gradient_matrix(axis) for axis in range(2)])
        means[L] = total / cells.measures[L]
    for count in (1, 2, 4, 8, 16):
        operator = scni(C, cells, f"gauss:{count}")
        errors[count] = max(
            abs(np.stack([p[[L]].toarray()[0] for p in operator.parts]) - means[L]).max() for L in inner
        )
    assert errors[1] > errors[2] > errors[4] > errors[8] > errors[16]
    assert errors[16] <= errors[4] / 16
    assert errors[16] <= 1e-4


@pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:2"])
@pytest.mark.parametrize("d", [1, 2])
def test_operators_on_moving_nodes_by_complex_step(d, rule):
    """Cells are formulas of the nodes' positions: the rate of b as nodes move, against a central difference."""
    C, _ = approximation(d)
    x = C.positions
    velocity = np.random.default_rng(8).uniform(-1, 1, x.shape)
    found = topology(x, DOMAINS[d])

    def b(step):
        now = C.at(x + step * velocity)
        return np.stack([part.toarray() for part in scni(now, moved(found, now.positions), rule).parts])

    rate, h = b(1e-30j).imag / 1e-30, 1e-5
    largest = abs(rate).max()
    # h^2 times the third derivative, some 100 per cubed spacing, and rounding over h.
    assert abs(rate - (b(h) - b(-h)) / (2 * h)).max() <= 1e-6 * largest
    assert largest > 0.1


@pytest.mark.parametrize("reading", DERIVATIVES)
@pytest.mark.parametrize("d", [1, 2, 3])
def test_dni_is_the_derivative_at_the_node_in_its_reading(d, reading):
    C, cells = approximation(d)
    operator = dni(C, cells.measures, reading)
    there = shape(C, C.positions, 1, reading)
    for axis, part in enumerate(operator.parts):
        assert np.array_equal(part.toarray(), there.gradient_matrix(axis).toarray())


def test_apply_gives_gradients_of_several_fields():
    C, cells = approximation(2)
    u = np.random.default_rng(3).normal(size=(len(C), 2))
    gradients = scni(C, cells).apply(u)
    assert gradients.shape == (len(cells), 2, 2)
    for c, axis in itertools.product(range(2), repeat=2):
        assert np.array_equal(gradients[:, c, axis], scni(C, cells).parts[axis] @ u[:, c])


@pytest.mark.parametrize("d", [1, 2, 3])
def test_boxes_have_their_measure_and_their_node_in_the_middle(d):
    """The integral of x_j n_i over a box is A delta_ij, that of n_i is zero, its vertices have the node as mean."""
    rng = np.random.default_rng(d)
    x, measures = rng.normal(size=(4, d)), rng.uniform(0.5, 2, 4)
    cells = boxes(x, measures)
    means = facet_rule(cells, "midpoint")
    moment = np.zeros((4, d, d))
    np.add.at(moment, cells.sides[:, 0], (means.matrix() @ means.points)[:, :, None] * cells.areas[:, None, :])
    assert abs(moment / measures[:, None, None] - np.eye(d)).max() <= 32 * EPS
    assert abs(cells.vertices.reshape(4, -1, d).mean(axis=1) - x).max() <= 8 * EPS
    edges = np.ptp(cells.vertices.reshape(4, -1, d), axis=1)
    assert abs(edges - measures[:, None] ** (1 / d)).max() <= 8 * EPS


def test_what_cannot_be_used_is_refused():
    C, cells = approximation(2)
    with pytest.raises(UnknownName, match="'simpson'"):
        scni(C, cells, "simpson")
    with pytest.raises(UnknownName, match="'half'"):
        dni(C, cells.measures, "half")
    with pytest.raises(BadInput, match="the cells have 1 dimensions, the nodes 2"):
        scni(C, approximation(1)[1])
    flat = Cells(
        cells.vertices,
        cells.starts,
        cells.corners,
        cells.sides,
        cells.areas,
        np.where(np.isin(np.arange(len(C)), [7, 12]), 0, cells.measures),  # the first is named
    )
    for make in (lambda: scni(C, flat), lambda: dni(C, flat.measures), lambda: snni(C, flat.measures)):
        with pytest.raises(BadInput, match=r"the cell of node 7 at \(.*\) has measure 0: it must be positive"):
            make()
    with pytest.raises(BadInput, match=f"{len(C) - 1} measures for {len(C)} nodes"):
        dni(C, cells.measures[:-1])
    with pytest.raises(TooFewNodes, match="order 1 needs 3"):
        scni(cloud(C.positions, 0.3), cells)


def test_boxes_on_a_line_are_differences_over_their_own_length():
    """b_I^L = (Psi_I(x_L + A_L/2) - Psi_I(x_L - A_L/2))/A_L with the node's own A_L: linear sums hold for boxes of any length."""
    C, cells = approximation(1)
    ends = [shape(C, C.positions + side * cells.measures[:, None] / 2).matrix() for side in (1, -1)]
    expected = (ends[0] - ends[1]).toarray() / cells.measures[:, None]
    found = snni(C, cells.measures).parts[0].toarray()
    assert abs(found - expected).max() <= 100 * EPS * condition_numbers(C, C.positions).max() / cells.measures.min()
