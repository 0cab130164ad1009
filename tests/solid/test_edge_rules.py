"""Rules on facets: a rule of degree p integrates every polynomial of degree p exactly and some of degree p + 1 not.

Linear exactness is what the sums of smoothed gradients rest on; what a rule does beyond tells the rules apart.
"""

import itertools

import numpy as np
import pytest

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.edge_rules import facet_rule

DEGREES = {"trapezoid": 1, "midpoint": 1, "gauss:1": 1, "gauss:2": 3, "gauss:3": 5, "gauss:8": 15}
EPS = 2.0**-52


def edges(rng, count=7):
    """A closed chain of edges in the plane, each vertex in two of them."""
    vertices = rng.normal(size=(count, 2))
    corners = np.column_stack([np.arange(count), np.roll(np.arange(count), -1)])
    along = vertices[corners[:, 1]] - vertices[corners[:, 0]]
    areas = np.column_stack([along[:, 1], -along[:, 0]])
    sides = np.column_stack([np.zeros(count, int), np.full(count, OUTSIDE)])
    return Cells(vertices, 2 * np.arange(count + 1), corners.ravel(), sides, areas, np.ones(1))


def polygon(angles, rng):
    """A plane polygon in space, in a plane of no special direction, with its coordinates in that plane."""
    flat = np.column_stack([np.cos(angles) * 1.3, np.sin(angles) * 0.7])
    frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    vertices = flat @ frame[:2] + rng.normal(size=3)
    area = np.sum([np.cross(p, q) for p, q in zip(vertices, np.roll(vertices, -1, axis=0), strict=True)], axis=0) / 2
    n = len(flat)
    cells = Cells(vertices, np.array([0, n]), np.arange(n), np.array([[0, OUTSIDE]]), area[None], np.ones(1))
    return cells, flat


POLYGONS = {
    "triangle": [0.3, 2.1, 4.4],
    "square": [0, np.pi / 2, np.pi, 3 * np.pi / 2],
    "pentagon": [0.1, 0.9, 2.6, 3.3, 5.0],
    "with a short side": [0.1, 0.1001, 2.6, 3.3, 5.0],
}


def mean_of_monomial(flat, p, q):
    """The mean of s^p t^q over a polygon, by integration along its sides of s^(p+1) t^q / (p+1), exact for polynomials."""
    z, w = np.polynomial.legendre.leggauss(p + q + 2)

    def along_sides(p, q):
        total = 0.0
        for a, b in zip(flat, np.roll(flat, -1, axis=0), strict=True):
            s, t = (a + np.outer((1 + z) / 2, b - a)).T
            total += (w / 2 * s ** (p + 1) * t**q).sum() * (b[1] - a[1]) / (p + 1)
        return total

    return along_sides(p, q) / along_sides(0, 0)


def powers(degree):
    return [(p, degree - p) for p in range(degree + 1)]


@pytest.mark.parametrize("rule", DEGREES)
def test_on_edges_a_rule_is_exact_to_its_degree_and_no_further(rule, rng):
    cells = edges(rng)
    means = facet_rule(cells, rule)
    start, end = (cells.vertices[cells.corners[i::2]] for i in (0, 1))
    x = means.points[:, 0] - start[:, 0].mean()
    degree = DEGREES[rule]

    def error(power):
        # The mean of x^k over an edge from a to b is sum_j a^j b^(k-j) / (k + 1).
        a, b = start[:, 0] - start[:, 0].mean(), end[:, 0] - start[:, 0].mean()
        exact = sum(a**j * b ** (power - j) for j in range(power + 1)) / (power + 1)
        return np.abs(means.matrix() @ x**power - exact) / np.maximum(abs(a), abs(b)) ** power

    for power in range(degree + 1):
        # Each of at most 8 products of a weight and a power is off by (power + 2) roundings; the points by 2 more each.
        assert error(power).max() <= 8 * (3 * power + 4) * EPS
    # The error of N points is an edge's length to the 2 N, over a number that grows like 4^(2 N): 1e-10 still shows at N = 8.
    assert error(degree + 1).max() > 1e-10


@pytest.mark.parametrize("shape", POLYGONS)
@pytest.mark.parametrize("rule", DEGREES)
def test_on_polygons_a_rule_is_exact_to_its_degree(rule, shape, rng):
    cells, flat = polygon(np.array(POLYGONS[shape]), rng)
    means = facet_rule(cells, rule)
    frame = np.linalg.lstsq(np.column_stack([flat, np.ones(len(flat))]), cells.vertices, rcond=None)[0]
    s, t = np.linalg.lstsq(frame[:2].T, (means.points - frame[2]).T, rcond=None)[0]
    for degree in range(DEGREES[rule] + 1):
        for p, q in powers(degree):
            # A few hundred terms of size one, each off by some roundings for every factor; the frame by 1e-14.
            assert abs((means.matrix() @ (s**p * t**q))[0] - mean_of_monomial(flat, p, q)) <= 1e-14 * (1 + degree) * 20


@pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:1", "gauss:2"])
def test_on_polygons_a_rule_stops_at_its_degree(rule, rng):
    cells, flat = polygon(np.array(POLYGONS["pentagon"]), rng)
    means = facet_rule(cells, rule)
    frame = np.linalg.lstsq(np.column_stack([flat, np.ones(len(flat))]), cells.vertices, rcond=None)[0]
    s, t = np.linalg.lstsq(frame[:2].T, (means.points - frame[2]).T, rcond=None)[0]
    worst = max(
        abs((means.matrix() @ (s**p * t**q))[0] - mean_of_monomial(flat, p, q)) for p, q in powers(DEGREES[rule] + 1)
    )
    assert worst > 1e-5


@pytest.mark.parametrize("rule", DEGREES)
def test_weights_of_a_facet_have_sum_one(rule, rng):
    for cells in (edges(rng), polygon(np.array(POLYGONS["pentagon"]), rng)[0]):
        assert np.abs(facet_rule(cells, rule).matrix().sum(axis=1) - 1).max() <= 64 * EPS


def test_vertices_are_visited_once_and_no_other_point_is(rng):
    """The trapezoid's cost is one evaluation for each vertex; an unused vertex is none."""
    cells = edges(rng)
    more = Cells(
        np.vstack([[[1e9, 1e9]], cells.vertices]), cells.starts, cells.corners + 1, cells.sides, cells.areas, np.ones(1)
    )
    for given in (cells, more):
        assert np.array_equal(facet_rule(given, "trapezoid").points, cells.vertices)
    assert len(facet_rule(cells, "trapezoid").weights) == 2 * len(cells.vertices)


def test_a_polygon_that_is_not_convex_keeps_its_centroid(rng):
    """Triangles of the fan that lie outside count negatively, so that an L is an L."""
    flat = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 3], [0, 3.0]])
    vertices = np.column_stack([flat, np.zeros(6)])
    cells = Cells(vertices, np.array([0, 6]), np.arange(6), np.array([[0, -1]]), np.array([[0, 0, 4.0]]), np.ones(1))
    centroid = np.array([2 * 1 + 2 * 0.5, 2 * 0.5 + 2 * 2]) / 4
    for rule in ("midpoint", "gauss:2"):
        means = facet_rule(cells, rule)
        assert np.abs((means.matrix() @ means.points)[0, :2] - centroid).max() <= 16 * EPS


@pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:3"])
def test_a_facet_without_area_has_finite_weights(rule):
    """Three corners on a line happen where four cells meet nearly in a point: its area is zero, and its mean no NaN."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0.0]])
    cells = Cells(vertices, np.array([0, 3]), np.arange(3), np.array([[0, -1]]), np.zeros((1, 3)), np.ones(1))
    assert facet_rule(cells, rule).matrix().sum() == pytest.approx(1, abs=16 * EPS)


@pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:2"])
def test_complex_vertices_carry_a_derivative(rule, rng):
    """The derivative of the mean of a cubic over a polygon whose corners move in its plane: complex step and difference."""
    cells, _ = polygon(np.array(POLYGONS["pentagon"]), rng)
    in_plane = cells.vertices[1:3] - cells.vertices[0]
    motion = rng.normal(size=(5, 2)) @ in_plane

    def mean(step):
        moved = Cells(
            cells.vertices + step * motion, cells.starts, cells.corners, cells.sides, cells.areas, cells.measures
        )
        means = facet_rule(moved, rule)
        x, y, z = means.points.T
        return (means.matrix() @ (x * y * z + x * x))[0]

    slope = mean(1e-30j).imag / 1e-30
    # A central difference of step h is off by h^2 times the third derivative, and by rounding over h.
    assert abs(slope - (mean(1e-5) - mean(-1e-5)) / 2e-5) <= 1e-8 * (1 + abs(slope))
    assert abs(slope) > 1e-3


def test_in_one_dimension_every_rule_is_the_value():
    cells = Cells(
        np.array([[0.0], [1.0], [3.0]]),
        np.arange(4),
        np.arange(3),
        np.array([[0, -1], [0, 1], [1, -1]]),
        np.array([[-1.0], [1.0], [1.0]]),
        np.array([1.0, 2.0]),
    )
    for rule in DEGREES:
        means = facet_rule(cells, rule)
        assert np.array_equal((means.matrix() @ means.points).ravel(), [0, 1, 3])


@pytest.mark.parametrize(
    "rule", ["simpson", "gauss", "gauss:", "gauss:x", "gauss:-1", "gauss:1.5", "gauss:²", "Gauss:2", ""]
)
def test_an_unknown_rule_is_refused(rule, rng):
    with pytest.raises(UnknownName, match=r"edge rule.*gauss:N, midpoint, trapezoid"):
        facet_rule(edges(rng), rule)


@pytest.mark.parametrize("count", ["0", "101", "9" * 30])
def test_a_number_of_points_that_is_not_offered_is_refused(count, rng):
    with pytest.raises(BadInput, match="N is from 1 to 100"):
        facet_rule(edges(rng), f"gauss:{count}")


def test_no_two_rules_are_one(rng):
    """Only the midpoint and one Gauss point agree on an edge."""
    cells = edges(rng)

    def cubes(rule):
        means = facet_rule(cells, rule)
        return means.matrix() @ means.points[:, 0] ** 4

    same = [
        (a, b) for a, b in itertools.combinations(DEGREES, 2) if np.allclose(cubes(a), cubes(b), rtol=1e-12, atol=0)
    ]
    assert same == [("midpoint", "gauss:1"), ("gauss:3", "gauss:8")]


@pytest.fixture
def rng():
    return np.random.default_rng(20063)
