"""Voronoi cells in a box in space, against the half-spaces of the definition."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull, HalfspaceIntersection

from rkverify.errors import BadInput, CoincidentNodes
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cut_facets import Facets, cut
from rkverify.solid.domain import Box, box, polygon_domain
from rkverify.solid.voronoi import voronoi
from rkverify.solid.voronoi_space import _without_short_edges

CUBE = box([0, 0, 0], [1, 1, 1])
EPS = np.finfo(float).eps


def _lattice(n: int, offset: float) -> np.ndarray:
    side = (np.arange(n) + offset) / (n - 1 + 2 * offset)
    return np.stack(np.meshgrid(side, side, side), axis=-1).reshape(-1, 3)


def _tiles(cells: Cells, b: Box) -> None:
    """Measures sum to the box's, cells are closed, the boundary's facets cover every side: to the rounding of the coordinates."""
    size = max(abs(b.low).max(), abs(b.high).max())
    area = np.linalg.norm(cells.areas, axis=1).sum()
    assert abs(cells.measures.sum() - b.measure) <= 8 * EPS * size * area
    net = np.zeros((len(cells), 3))
    np.add.at(net, cells.sides[:, 0], cells.areas)
    inner = cells.sides[:, 1] != OUTSIDE
    np.add.at(net, cells.sides[inner, 1], -cells.areas[inner])
    assert abs(net).max() <= 8 * EPS * size * (b.high - b.low).max() * np.bincount(cells.sides[:, 0]).max()
    assert (cells.measures > 0).all()
    outer = cells.areas[cells.boundary]
    corner = cells.vertices[cells.corners[cells.starts[cells.boundary]]]
    for axis in range(3):
        side = b.measure / (b.high - b.low)[axis]
        for sign, place in ((-1, b.low[axis]), (1, b.high[axis])):
            here = (corner[:, axis] == place) & (sign * outer[:, axis] > 0.5 * np.linalg.norm(outer, axis=1))
            assert sign * outer[here, axis].sum() == pytest.approx(side, rel=64 * EPS * size / (b.high - b.low).min())


def _by_halfspaces(x: np.ndarray, b: Box) -> np.ndarray:
    """The volume of the convex hull of the vertices of the half-spaces nearer to each node, and of the box."""
    sides = np.concatenate([np.c_[np.eye(3), -b.high], np.c_[-np.eye(3), b.low]])
    volumes = []
    for L, centre in enumerate(x):
        others = np.delete(x, L, axis=0)
        n = others - centre
        planes = np.c_[n, -(n * (others + centre)).sum(axis=1) / 2]
        inward = 1e-4 * ((b.low + b.high) / 2 - centre)  # a node may be on the boundary, or on a corner
        while (
            np.concatenate([sides, planes])[:, :3] @ (centre + inward) + np.concatenate([sides, planes])[:, 3]
        ).max() >= 0:
            inward = inward / 2
        volumes.append(
            ConvexHull(HalfspaceIntersection(np.concatenate([sides, planes]), centre + inward).intersections).volume
        )
    return np.array(volumes)


@pytest.mark.parametrize(
    ("x", "b"),
    [
        (np.array([[0.3, 0.2, 0.9]]), CUBE),
        (np.random.default_rng(0).random((2, 3)), CUBE),
        (np.random.default_rng(1).random((60, 3)), CUBE),
        (np.random.default_rng(2).random((40, 3)) * [1, 2, 0.1] - [0, 1, 0], box([0, -1, 0], [1, 1, 0.1])),
        (_lattice(4, 0.0), CUBE),
        (_lattice(4, 0.5), CUBE),
        (np.concatenate([_lattice(3, 0.5), _lattice(2, 1.0)]), CUBE),
        (np.c_[np.random.default_rng(3).random((20, 2)), np.zeros(20)], CUBE),
        (np.linspace(0, 1, 7)[:, None] * np.ones(3), CUBE),
    ],
    ids=["one", "two", "random", "flat", "on the boundary", "centred", "bcc", "on a side", "on a line"],
)
def test_cells_are_those_of_the_half_spaces(x: np.ndarray, b: Box) -> None:
    """Volumes by another route, on sets where eight cells meet in a point, and nodes are on sides, edges and corners.

    Qhull's half-spaces are dual points 1/distance from an inner point, here as near as 1e-4 to the boundary: eleven digits are left.
    """
    cells = voronoi(x, b)
    _tiles(cells, b)
    np.testing.assert_allclose(cells.measures, _by_halfspaces(x, b), rtol=1e-10, atol=1e-12 * b.measure)


def test_every_vertex_is_as_far_from_its_nodes() -> None:
    """Facets are where two nodes are equally near, to the last digits; a rotated lattice has eight in a point, but for rounding."""
    c, s = np.cos(0.5), np.sin(0.5)
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, s, c], [0, -c, s]])
    for x in (np.random.default_rng(4).random((400, 3)) - 0.5, (_lattice(5, 0.5) - 0.5) @ turn * 0.5):
        cells = voronoi(x, box([-0.5] * 3, [0.5] * 3))
        _tiles(cells, box([-0.5] * 3, [0.5] * 3))
        facet = np.repeat(np.arange(len(cells.sides)), np.diff(cells.starts))
        inner = cells.sides[facet, 1] != OUTSIDE
        v, pair = cells.vertices[cells.corners[inner]], cells.sides[facet[inner]]
        distances = [np.linalg.norm(v - x[pair[:, side]], axis=1) for side in (0, 1)]
        np.testing.assert_allclose(distances[0], distances[1], rtol=0, atol=16 * EPS)


def test_facets_are_plane_polygons_around_their_area_vector() -> None:
    """What rules of quadrature rely on: corners in order, the area vector right-handed about them, out of the first cell."""
    x = np.random.default_rng(5).random((80, 3))
    cells = voronoi(x, CUBE)
    for f, (i, j) in enumerate(cells.sides):
        p = cells.vertices[cells.corners[cells.starts[f] : cells.starts[f + 1]]]
        middle = p.mean(axis=0)
        parts = np.cross(p - middle, np.roll(p, -1, axis=0) - middle) / 2
        np.testing.assert_allclose(parts.sum(axis=0), cells.areas[f], rtol=0, atol=32 * EPS)
        normal = cells.areas[f] / np.linalg.norm(cells.areas[f])
        assert (parts @ normal > -32 * EPS).all()  # convex, one way round
        assert (x[j] - x[i] if j != OUTSIDE else middle - x[i]) @ normal > 0


def test_a_lattice_has_square_facets_alone() -> None:
    """Six for each cell; where the triangulation has flat tetrahedra there is no facet. The twin, moved by 1e-9, has more."""
    x = _lattice(4, 0.5)
    cells = voronoi(x, CUBE)
    assert len(cells.sides) == 3 * 4 * 4 * 3 + 6 * 16
    assert (np.diff(cells.starts) == 4).all()
    moved = x + 1e-9 * np.random.default_rng(6).normal(size=x.shape)
    assert len(voronoi(moved, CUBE).sides) > len(cells.sides)


@pytest.mark.parametrize(
    ("positions", "error", "message"),
    [
        ([[0.1, 0.1, 0.1], [0.5, 0.5, 1.5]], BadInput, r"node 1 at \(0.5, 0.5, 1.5\) is outside the domain"),
        ([[0.1, 0.1, 0.1]] * 2, CoincidentNodes, "nodes 0 and 1 are both at"),
        ([[0.1, 0.1, 0.1], [0.5, 0.5, 0.5], [0.1, 0.1, 0.1 + 3e-17]], CoincidentNodes, "nodes 0 and 2 are both at"),
        ([[0.5, 0.5, 0.5], [0.1, 0.1, 0.1], [0.5, 0.5, 0.5 + 2e-16]], CoincidentNodes, "nodes 0 and 2 are both at"),
        ([[0.1, 0.1, np.inf]], BadInput, "node 0 is at"),
    ],
)
def test_bad_nodes_are_refused(positions: list, error: type, message: str) -> None:
    """The same errors as in the plane."""
    with pytest.raises(error, match=message):
        voronoi(positions, CUBE)


def test_the_domain_has_the_nodes_dimension() -> None:
    """A polygon is no domain for nodes in space."""
    with pytest.raises(BadInput, match="the nodes have 3 coordinates and the domain 2"):
        voronoi([[0.5, 0.5, 0.5]], polygon_domain([[(0, 0), (1, 0), (1, 1)]]))


def _prism(turn: int) -> Facets:
    """A U with legs of width 1 and height 2 on a foot 3 wide and 1 high, from z = 0 to 1; its facets begin at corner `turn`."""
    plan = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
    v = np.array([(x, y, z) for z in (0.0, 1.0) for x, y in plan])
    loops = [list(range(7, -1, -1)), list(range(8, 16))]
    loops += [[k, (k + 1) % 8, (k + 1) % 8 + 8, k + 8] for k in range(8)]
    loops = [loop[turn % len(loop) :] + loop[: turn % len(loop)] for loop in loops]
    facets = Facets.of(v, loops, np.array([[0, OUTSIDE]] * 10))
    return Facets(facets.vertices, facets.starts, facets.corners, facets.sides, np.ones((10, 3)))


@pytest.mark.parametrize("turn", range(8))
@pytest.mark.parametrize(
    ("place", "sign", "volume", "caps"), [(1.5, 1, 4.0, 2), (0.25, 1, 0.75, 1), (-1.0, -1, 5.0, 0)]
)
def test_a_cut_through_two_legs_closes_each(turn: int, place: float, sign: int, volume: float, caps: int) -> None:
    """Facets that are crossed four times leave two pieces, whichever corner they are named from: rounding can make such cells.

    Volume by the divergence theorem, which is wrong for a cell that is not closed; new facets have the outward normal.
    """
    found = cut(_prism(turn), 1, place, sign)
    whole = np.zeros(3)
    measured, flat = 0.0, 0
    for f in range(len(found.sides)):
        p = found.vertices[found.corners[found.starts[f] : found.starts[f + 1]]]
        assert (sign * (p[:, 1] - place) <= 0).all()
        area = np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(axis=0) / 2
        if len(p) == 4 and (p[:, 1] == place).all():
            flat += 1
            assert found.outward[f].tolist() == [0, sign, 0]
            assert abs(np.linalg.norm(area) - (3 if place == 0.25 else 1)) < 1e-14
            area = abs(area) * sign
        whole += area
        measured += p[0] @ area / 3
    assert flat == caps
    assert abs(whole).max() < 1e-14
    assert abs(measured - volume) < 1e-14


@pytest.mark.parametrize(("apart", "vertices"), [(0.0, 8), (1e-15, 8), (1e-12, 9)])
@pytest.mark.parametrize("corner_last", [False, True])
def test_an_edge_of_rounding_s_length_is_none_and_the_corner_stays(
    apart: float, vertices: int, corner_last: bool
) -> None:
    """A cube whose corner is there twice: the one that is the box's is kept, to the last digit. The twin, 1e-12 away, is an edge."""
    v = np.array([(x, y, z) for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0)] + [(1.0 - apart, 1.0, 1.0)])
    loops = [[0, 2, 3, 1], [4, 5, 7, 8, 6], [0, 1, 5, 4], [2, 6, 8, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    if corner_last:
        v[[7, 8]] = v[[8, 7]]
        loops = [[{7: 8, 8: 7}.get(k, k) for k in loop] for loop in loops]
    found = _without_short_edges(Facets.of(v, loops, np.array([[0, OUTSIDE]] * 6)), v, CUBE)
    assert len(found.vertices) == vertices
    assert sorted(np.diff(found.starts).tolist()) == ([4] * 6 if vertices == 8 else [4] * 4 + [5] * 2)
    assert [1.0, 1.0, 1.0] in found.vertices.tolist()


def test_beside_a_plane_through_the_origin_a_vertex_stays_to_its_last_digit() -> None:
    """Rounding is that of the coordinates, and beside 0 they have more digits: 1e-16 inside is inside, 1e-19 is on the plane."""
    for inside, wanted in ((1e-16, 1e-16), (1e-19, 0.0)):
        prism = _prism(0)
        prism.vertices[0, 1] = inside
        found = cut(prism, 1, 0.0, -1)
        assert found.vertices[0, 1] == wanted
