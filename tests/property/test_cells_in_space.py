"""Random nodes in one to three dimensions, often cocircular, collinear or on the boundary: what their cells must be, whatever they are.

Nodes are drawn from a coarse grid, so that ties are the rule and not the exception, or anywhere.
"""

import numpy as np
from hypothesis import assume, event, example, given, target
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from rkverify.solid.cell_rings import all_rings
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.domain import Box, Domain, box, polygon_domain
from rkverify.solid.given_cells import polygon_cells
from rkverify.solid.voronoi import moved, topology, voronoi

EPS = np.finfo(float).eps
UNITS = {d: box([0.0] * d, [1.0] * d) for d in (1, 2, 3)}
POLYGONS = {
    "L": [[(0, 0), (1, 0), (1, 0.5), (0.5, 0.5), (0.5, 1), (0, 1)]],
    "hole": [[(0, 0), (1, 0), (1, 1), (0, 1)], [(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)]],
    "slit": [[(0, 0), (1, 0), (1, 1), (0.625, 1), (0.5, 0.125), (0.375, 1), (0, 1)]],
}


@st.composite
def node_arrays(draw: st.DrawFn, d: int, most: int = 30) -> np.ndarray:
    """Different nodes (N, d) in the unit box, on a grid of 8, on one of 64, or anywhere but 1e-3 apart."""
    cells = draw(st.sampled_from([8, 64, 10**3]))
    rows = draw(st.lists(st.tuples(*[st.integers(0, cells)] * d), min_size=1, max_size=most, unique=True))
    return np.array(rows, dtype=float) / cells


@st.composite
def nodes_in_polygons(draw: st.DrawFn) -> tuple[np.ndarray, Domain]:
    """Nodes in a polygon that is not convex."""
    domain = polygon_domain(POLYGONS[draw(st.sampled_from(sorted(POLYGONS)))])
    x = draw(node_arrays(2))
    x = x[domain.contains(x)]
    assume(len(x) > 0)
    return x, domain


def _gap(cells: Cells, domain: Box | Domain) -> float:
    """How far the cells are from tiling, in rounding units of what is summed: the domain's measure, and each cell's closure."""
    d = cells.dimension
    size = max(abs(bound).max() for bound in domain.bounds)
    areas = np.linalg.norm(cells.areas, axis=1)
    net = np.zeros((len(cells), d))
    np.add.at(net, cells.sides[:, 0], cells.areas)
    inner = cells.sides[:, 1] != OUTSIDE
    np.add.at(net, cells.sides[inner, 1], -cells.areas[inner])
    of_cell = np.bincount(cells.sides[:, 0], minlength=len(cells)) + np.bincount(
        cells.sides[inner, 1], minlength=len(cells)
    )
    closure = (np.linalg.norm(net, axis=1) / (of_cell * size ** (d - 1))).max()
    return float(max(abs(cells.measures.sum() - domain.measure) / (size * areas.sum()), closure) / EPS)


def _tile(cells: Cells, domain: Box | Domain) -> None:
    gap = _gap(cells, domain)
    target(gap, label="gap in rounding units")
    assert gap <= 8
    assert (cells.sides[:, 0] != cells.sides[:, 1]).all()
    assert (cells.measures > 0).all()


def _inside(points: np.ndarray, rings: list[np.ndarray]) -> np.ndarray:
    """Whether points are inside rings: crossings of a ray, odd."""
    crossings = np.zeros(len(points), dtype=int)
    for ring in rings:
        for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            between = (y0 > points[:, 1]) != (y1 > points[:, 1])
            at = x0 + (points[between, 1] - y0) / (y1 - y0) * (x1 - x0) if y1 != y0 else np.zeros(0)
            crossings[between] += at > points[between, 0]
    return crossings % 2 == 1


@given(x=node_arrays(1))
def test_cells_tile_on_a_line(x: np.ndarray) -> None:
    """Every place between a cell's ends is nearest to its node: sorted nodes, half-way points."""
    cells = voronoi(x, UNITS[1])
    _tile(cells, UNITS[1])
    order = np.argsort(x[:, 0])
    ends = np.concatenate([[0.0], (x[order[1:], 0] + x[order[:-1], 0]) / 2, [1.0]])
    np.testing.assert_allclose(cells.measures[order], np.diff(ends), rtol=0, atol=4 * EPS)


@given(x=node_arrays(2), seed=st.integers(0, 2**32 - 1))
@example(x=np.array([[0.0, 0.0], [1.0, 1.0]]), seed=0)
@example(x=np.array([[0.5, 0.0], [0.5, 0.5], [0.5, 1.0]]), seed=0)
def test_cells_tile_the_square_and_each_point_is_nearest_to_its_own(x: np.ndarray, seed: int) -> None:
    """The definition by sampling: a tree that knows no cells says whose each point is; those within 1e-9 of a tie are left out."""
    cells = voronoi(x, UNITS[2])
    _tile(cells, UNITS[2])
    _nearest(x, cells, UNITS[2], seed)


@given(nodes=nodes_in_polygons(), seed=st.integers(0, 2**32 - 1))
@example(nodes=(np.array([[0, 0.25], [0.875, 0.5], [0.875, 1]]), polygon_domain(POLYGONS["hole"])), seed=0)
@example(nodes=(np.array([[0, 0.5], [0.5, 1]]), polygon_domain(POLYGONS["L"])), seed=0)
@example(nodes=(np.array([[0.25, 0.75], [0.25, 0.25], [0.75, 0.25]]), polygon_domain(POLYGONS["L"])), seed=0)
def test_cells_tile_a_polygon_that_is_not_convex(nodes: tuple[np.ndarray, Domain], seed: int) -> None:
    """The same around holes and behind slits, where cells have pieces; and as polygons read back they are the same."""
    x, domain = nodes
    cells = voronoi(x, domain)
    _tile(cells, domain)
    event(f"most rings of a cell: {_nearest(x, cells, domain, seed)}")
    read = polygon_cells(all_rings(cells))
    np.testing.assert_allclose(read.measures, cells.measures, rtol=0, atol=64 * EPS)
    assert len(read.boundary) == len(cells.boundary)


def _nearest(x: np.ndarray, cells: Cells, domain: Box | Domain, seed: int) -> int:
    points = np.random.default_rng(seed).random((100, 2))
    points = points[domain.contains(points)]
    distance, owner = (
        found.reshape(len(points), -1) for found in cKDTree(x).query(points, k=range(1, min(len(x), 2) + 1))
    )
    clear = np.ones(len(points), dtype=bool) if len(x) == 1 else distance[:, 1] - distance[:, 0] > 1e-9
    loops = all_rings(cells)
    for L in np.unique(owner[clear, 0]):
        assert _inside(points[clear & (owner[:, 0] == L)], loops[L]).all()
    return max(map(len, loops))


@given(x=node_arrays(3, most=15), seed=st.integers(0, 2**32 - 1))
def test_cells_tile_the_cube_and_their_points_are_nearest_to_their_own(x: np.ndarray, seed: int) -> None:
    """Corners of a cell are in the box and no node is nearer to them than its own; with tiling no cell can be larger or smaller."""
    cells = voronoi(x, UNITS[3])
    _tile(cells, UNITS[3])
    facet = np.repeat(np.arange(len(cells.sides)), np.diff(cells.starts))
    v = cells.vertices[cells.corners]
    assert ((v >= -8 * EPS) & (v <= 1 + 8 * EPS)).all()
    nearest = cKDTree(x).query(v)[0]
    for side in (0, 1):
        has = cells.sides[facet, side] != OUTSIDE
        own = np.linalg.norm(v[has] - x[cells.sides[facet[has], side]], axis=1)
        # Least squares over planes that meet at small angles: half of the digits are asked for.
        assert (own - nearest[has] <= 1e-8).all()


@given(
    x=node_arrays(2),
    power=st.integers(-20, 20),
    shift=st.tuples(st.integers(-8, 8), st.integers(-8, 8)),
    turns=st.integers(0, 3),
)
def test_cells_follow_exact_motions_to_rounding(x: np.ndarray, power: int, shift: tuple[int, int], turns: int) -> None:
    """Translations by whole numbers, quarter turns and powers of two round nothing of a node on a grid of powers of two.

    What changes is the triangulation of ties and the rounding of vertices: coordinates up to 9 and distances up to 1.5, a
    few units of 9 EPS along the edges of a cell, which are shorter than 6 in all.
    """
    x = np.round(x * 64) / 64
    assume(len(np.unique(x, axis=0)) == len(x))
    turn = np.linalg.matrix_power(np.array([[0.0, 1.0], [-1.0, 0.0]]), turns)
    scale = 2.0**power
    there = (x @ turn + shift) * scale
    corners = (np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]) @ turn + shift) * scale
    one, other = voronoi(x, UNITS[2]), voronoi(there, polygon_domain([corners]))
    np.testing.assert_allclose(other.measures / scale**2, one.measures, rtol=0, atol=8 * 9 * EPS * 6)


@given(x=node_arrays(2), angle=st.floats(0, 6.3), shift=st.floats(-10, 10))
def test_cells_follow_rotations_as_their_conditioning_allows(x: np.ndarray, angle: float, shift: float) -> None:
    """Rounded positions of nodes move bisectors by that over the nodes' distance times the cell's size: the transport theorem's bound.

    A facet of area A between nodes r apart, with vertices within D of them, sweeps at most A (2 D / r) e where nodes move by e;
    vertices of thin triangles are rounded by (R / s)^2 e on their own, R the circumradius and s the shortest side.
    """
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, s], [-s, c]])
    domain = polygon_domain([np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]) @ turn + shift])
    one, other = voronoi(x, UNITS[2]), voronoi(x @ turn + shift, domain)
    e = 8 * EPS * (2 + abs(shift))
    bound = 4 * e * np.ones(len(x))
    inner = one.sides[:, 1] != OUTSIDE
    i, j = one.sides[inner].T
    apart = np.linalg.norm(x[i] - x[j], axis=1)
    worst = _thinnest(x) if len(x) > 2 else 1.0
    share = np.linalg.norm(one.areas[inner], axis=1) * (2 * np.sqrt(2) / apart) * e + 4 * worst * e
    np.add.at(bound, i, share)
    np.add.at(bound, j, share)
    error = abs(other.measures - one.measures) / bound
    target(float(error.max()), label="error over bound")
    assert error.max() <= 1


def _thinnest(x: np.ndarray) -> float:
    p = x[topology(x, UNITS[2]).simplices]
    if len(p) == 0:
        return 1.0
    sides = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2)
    u, w = (p[:, 1] - p[:, 0]).T, (p[:, 2] - p[:, 0]).T
    return float(((sides.prod(axis=1) / (2 * abs(u[0] * w[1] - u[1] * w[0])) / sides.min(axis=1)) ** 2).max())


@given(nodes=nodes_in_polygons(), seed=st.integers(0, 2**32 - 1))
def test_rates_of_measures_are_what_facets_sweep(nodes: tuple[np.ndarray, Domain], seed: int) -> None:
    """Complex steps against the transport theorem, ties and all: a facet about to grow has an area of second order."""
    x, domain = nodes
    velocity = np.random.default_rng(seed).normal(size=x.shape)
    t = topology(x, domain)
    rates = moved(t, x + 1e-30j * velocity).measures.imag / 1e-30
    cells = voronoi(x, domain)
    inner = cells.sides[:, 1] != OUTSIDE
    i, j = cells.sides[inner].T
    p = cells.vertices[cells.corners.reshape(-1, 2)[inner]].mean(axis=1)
    speed = ((p - x[i]) * velocity[i]).sum(axis=1) - ((p - x[j]) * velocity[j]).sum(axis=1)
    flow = (cells.areas[inner] * (x[j] - x[i])).sum(axis=1) / ((x[j] - x[i]) ** 2).sum(axis=1) * speed
    swept = np.bincount(i, flow, len(x)) - np.bincount(j, flow, len(x))
    corners = t.simplices
    worst = 1.0
    if len(corners):
        q = x[corners]
        worst = float((1 / np.linalg.norm(q - np.roll(q, 1, axis=1), axis=2).min()) ** 2)
    np.testing.assert_allclose(rates, swept, rtol=0, atol=64 * worst * EPS * max(1.0, abs(velocity).max()) ** 2)
