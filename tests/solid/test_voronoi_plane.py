"""Voronoi cells in the plane against cells made another way: the domain cut at one bisector after the other by shapely."""

import numpy as np
import pytest
import shapely

from rkverify.errors import BadInput, CoincidentNodes
from rkverify.solid.cell_rings import all_rings
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.domain import Box, Domain, box, polygon_domain
from rkverify.solid.voronoi import voronoi

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
DOMAINS = {
    "square": [SQUARE],
    "L": [[(0, 0), (1, 0), (1, 0.5), (0.5, 0.5), (0.5, 1), (0, 1)]],
    "hole": [SQUARE, [(0.3, 0.3), (0.7, 0.3), (0.7, 0.7), (0.3, 0.7)]],
    "notch": [[(0, 0), (1, 0), (1, 1), (0.525, 1), (0.525, 0.5), (0.475, 0.5), (0.475, 1), (0, 1)]],
    "comb": [[(0, 0), (1, 0), (1, 1), *[(0.95 - 0.1 * k, 0.1 if k % 2 == 0 else 0.9) for k in range(9)], (0, 1)]],
    "islands": [SQUARE, [(0.1, 0.1), (0.9, 0.1), (0.5, 0.3)], [(0.1, 0.6), (0.9, 0.6), (0.5, 0.9)]],
}
EPS = np.finfo(float).eps


def _turned(points: object, angle: float, shift: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]]) + shift


def _by_cutting(x: np.ndarray, rings: tuple[np.ndarray, ...]) -> list[shapely.Geometry]:
    """The definition, cell by cell: the domain without the half-planes in which another node is nearer."""
    domain = shapely.Polygon(rings[0], rings[1:])
    size = 8 * np.ptp(rings[0], axis=0).max()
    cells = []
    for L, centre in enumerate(x):
        cell = domain
        for J in np.argsort(((x - centre) ** 2).sum(axis=1)):
            if J != L:
                n = (x[J] - centre) / np.linalg.norm(x[J] - centre)
                t, middle = np.array([-n[1], n[0]]), (x[J] + centre) / 2
                half = [middle + size * t, middle + size * (t + n), middle + size * (n - t), middle - size * t]
                cell = cell.difference(shapely.Polygon(half))
        cells.append(cell)
    return cells


def _net_areas(cells: Cells) -> np.ndarray:
    """The sum of every cell's area vectors, which is zero for a closed cell."""
    total = np.zeros((len(cells), 2))
    np.add.at(total, cells.sides[:, 0], cells.areas)
    inner = cells.sides[:, 1] != OUTSIDE
    np.add.at(total, cells.sides[inner, 1], -cells.areas[inner])
    return total


def _tiles(cells: Cells, domain: Domain | Box) -> None:
    """Measures sum to the domain's, cells are closed, no facet is between a cell and itself: to the rounding of the coordinates."""
    size = max(abs(bound).max() for bound in domain.bounds)
    facets = np.bincount(cells.sides[cells.sides >= 0]).max()
    length = np.abs(cells.areas).sum()
    assert abs(cells.measures.sum() - domain.measure) <= 4 * EPS * size * length
    assert abs(_net_areas(cells)).max() <= 4 * EPS * size * facets
    assert (cells.sides[:, 0] != cells.sides[:, 1]).all()
    assert (cells.measures > 0).all()


@pytest.mark.parametrize("name", DOMAINS)
@pytest.mark.parametrize(("angle", "shift"), [(0.0, 0.0), (0.4, 3.0)])
@pytest.mark.parametrize("nodes", ["one", "two", "random", "lattice", "centred lattice"])
def test_cells_are_those_of_the_definition(name: str, angle: float, shift: float, nodes: str) -> None:
    """On lattices four cells meet in a point, nodes are on edges and corners, bisectors run along edges and through corners.

    Two polygons with vertices within an error e of each other differ by at most e times their perimeter; e is taken as
    1e-12 of the size, for shapely cuts up to 80 times at bisectors whose far ends are 8 sizes away.
    """
    rings = [_turned(ring, angle, shift) for ring in DOMAINS[name]]
    domain = polygon_domain(rings)
    lattice = np.stack(np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 1, 9)), axis=-1).reshape(-1, 2)
    rng = np.random.default_rng(len(name))
    places = {
        "one": rng.random((40, 2)),
        "two": rng.random((40, 2)),
        "random": rng.random((80, 2)),
        "lattice": lattice,
        "centred lattice": 0.0625 + lattice[(lattice < 1).all(axis=1)],
    }[nodes]
    x = _turned(places, angle, shift)
    x = x[domain.contains(x)][: {"one": 1, "two": 2}.get(nodes)]
    cells = voronoi(x, domain)
    _tiles(cells, domain)
    for own, loops in zip(_by_cutting(x, domain.rings), all_rings(cells), strict=True):
        ours = shapely.Point(0, 0).buffer(0)
        for ring in loops:
            ours = shapely.symmetric_difference(ours, shapely.Polygon(ring))
        assert shapely.symmetric_difference(own, ours).area <= 1e-12 * own.length * 4


def test_one_node_owns_the_domain() -> None:
    """No neighbour, no bisector: the cell is the domain, hole and all."""
    domain = polygon_domain(DOMAINS["hole"])
    cells = voronoi([[0.1, 0.2]], domain)
    assert cells.measures == pytest.approx([domain.measure], rel=4 * EPS)
    assert (cells.sides == [0, OUTSIDE]).all()
    outline, hole = all_rings(cells)[0]
    assert {*map(tuple, outline.tolist())} == {*map(tuple, domain.rings[0].tolist())}
    assert {*map(tuple, hole.tolist())} == {*map(tuple, domain.rings[1].tolist())}


def test_a_cell_keeps_its_pieces() -> None:
    """Behind the notch the node on the left is the nearest to a part of the right side: two loops, one node, and it tiles."""
    domain = polygon_domain([[(0, 0), (4, 0), (4, 4), (2.2, 4), (2.2, 1), (2, 1), (2, 4), (0, 4)]])
    cells = voronoi([[1.9, 3.5], [3.9, 3.5], [2, 0.1]], domain)
    loops = all_rings(cells)
    assert [len(rings) for rings in loops] == [2, 1, 1]
    _tiles(cells, domain)


@pytest.mark.parametrize("angle", np.arange(8) * np.pi / 4 + 0.1)
def test_an_edge_is_parted_in_order_from_the_circumcentre_on(angle: float) -> None:
    """An edge that begins inside and is hidden by three holes in a row is four facets, whichever way it goes."""
    places = [[-0.3, 0], [0.3, 0], [0, 1.2]]
    holes = [np.array(SQUARE) * 0.1 + [-0.05, y] for y in (0.2, -0.2, -0.6)]
    domain = polygon_domain([_turned(ring, angle, 0.0) for ring in ([(-1, -1), (1, -1), (1, 1.5), (-1, 1.5)], *holes)])
    cells = voronoi(_turned(places, angle, 0.0), domain)
    _tiles(cells, domain)
    lengths = np.linalg.norm(cells.areas[(np.sort(cells.sides, axis=1) == [0, 1]).all(axis=1)], axis=1)
    # from y = 0.5625, where the circle through the nodes has its middle
    np.testing.assert_allclose(np.sort(lengths), [0.2625, 0.3, 0.3, 0.4], rtol=0, atol=16 * EPS)


def test_pieces_that_touch_at_a_corner_of_the_domain_are_two_rings() -> None:
    """The bisector runs through the corner that points in: on its far side two triangles, which no other program takes as one ring.

    The twin: with the one node nearer to the corner by 1e-10 there are two, with the other one nearer, one around the corner.
    """
    domain = polygon_domain(DOMAINS["L"])
    cells = voronoi([[0, 0.5], [0.5, 1]], domain)
    assert [len(loops) for loops in all_rings(cells)] == [1, 2]
    assert (cells.sides[:, 1] != OUTSIDE).sum() == 2
    _tiles(cells, domain)
    for first, second, pieces, facets in ((1e-10, 0, 2, 2), (0, 1e-10, 1, 1)):
        cells = voronoi([[first, 0.5], [0.5, 1 - second]], domain)
        assert [len(loops) for loops in all_rings(cells)] == [1, pieces]
        assert (cells.sides[:, 1] != OUTSIDE).sum() == facets


def test_along_a_bisector_the_node_inside_owns_the_boundary() -> None:
    """Both nodes are as near to the hole's upper edge, but one has the domain above it, the other would have a strip without area."""
    domain = polygon_domain([SQUARE, [(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)]])
    for turn in (0.0, 0.3):
        rings = [_turned(ring, turn, 0.0) for ring in domain.rings]
        cells = voronoi(_turned([[0.875, 0.5], [0.875, 1]], turn, 0.0), polygon_domain(rings))
        np.testing.assert_allclose(cells.measures, [0.5, 0.25], rtol=0, atol=16 * EPS)
        perimeters = [np.linalg.norm(cells.areas[(cells.sides == L).any(axis=1)], axis=1).sum() for L in (0, 1)]
        np.testing.assert_allclose(perimeters, [4.5, 2.5], rtol=0, atol=64 * EPS)


def test_a_lattice_has_no_facets_without_length() -> None:
    """Where four cells meet in a point the triangulation has a diagonal, whose facet would be between cells that only touch."""
    g = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0)), axis=-1).reshape(-1, 2)
    for angle in (0.0, 0.3):
        x = _turned(g, angle, 0.0)
        cells = voronoi(x, polygon_domain([_turned([(-0.5, -0.5), (4.5, -0.5), (4.5, 4.5), (-0.5, 4.5)], angle, 0.0)]))
        assert len(cells.sides) == 2 * 5 * 4 + 4 * 5
        assert len(cells.vertices) == 36
        apart = np.linalg.norm(x[cells.sides[:, 0]] - x[cells.sides[:, 1]], axis=1)[cells.sides[:, 1] != OUTSIDE]
        np.testing.assert_allclose(apart, 1.0, rtol=16 * EPS)


def test_a_lattice_moved_by_more_than_rounding_has_them() -> None:
    """The twin: moved by 1e-10 the diagonal is a facet, as short as that, and is kept."""
    g = np.stack(np.meshgrid(np.arange(3.0), np.arange(3.0)), axis=-1).reshape(-1, 2)
    g[4] += [3e-10, 1e-10]
    cells = voronoi(g, box([-0.5, -0.5], [2.5, 2.5]))
    lengths = np.linalg.norm(cells.areas, axis=1)
    assert len(cells.sides) == 12 + 12 + 4
    assert 1e-11 < lengths.min() < 1e-9


def test_normals_point_from_the_first_cell_to_the_second() -> None:
    """The sign of every later boundary term: along the line between the nodes, or out of the domain."""
    x = np.random.default_rng(2).random((200, 2))
    cells = voronoi(x, box([0, 0], [1, 1]))
    i, j = cells.sides.T
    inner = j != OUTSIDE
    apart = x[j[inner]] - x[i[inner]]
    A = cells.areas[inner]
    cosine = (A * apart).sum(axis=1) / np.linalg.norm(A, axis=1) / np.linalg.norm(apart, axis=1)
    # A facet's ends are rounded, so that a short one may be turned by eps over its length.
    assert (1 - cosine <= (8 * EPS / np.linalg.norm(A, axis=1)) ** 2 + 4 * EPS).all()
    middle = cells.vertices[cells.corners.reshape(-1, 2)].mean(axis=1)[cells.boundary]
    assert ((cells.areas[cells.boundary] * (middle - 0.5)).sum(axis=1) > 0).all()


def test_the_box_and_its_polygon_have_the_same_cells() -> None:
    """One way to cut, whatever type the domain has."""
    x = np.random.default_rng(3).random((30, 2))
    b = box([0, 0], [1, 1])
    p, q = voronoi(x, b), voronoi(x, polygon_domain(b.rings))
    assert p.measures.tolist() == q.measures.tolist()
    assert p.sides.tolist() == q.sides.tolist()


@pytest.mark.parametrize(
    ("positions", "error", "message"),
    [
        ([[0.1, 0.1], [0.5, 1.5]], BadInput, r"node 1 at \(0.5, 1.5\) is outside the domain"),
        ([[0.1, 0.1], [0.5, 0.5]], BadInput, r"node 1 at \(0.5, 0.5\) is outside the domain"),
        ([[0.1, 0.1], [0.5, np.nan]], BadInput, r"node 1 is at \(0.5, nan\)"),
        ([[0.1], [0.5]], BadInput, "the nodes have 1 coordinates and the domain 2"),
        ([[0.1, 0.1], [0.2, 0.2], [0.1, 0.1]], CoincidentNodes, r"nodes 0 and 2 are both at \(0.1, 0.1\)"),
        ([[0.1, 0.1], [0.2, 0.2], [0.1, 0.1 + 2e-17]], CoincidentNodes, r"nodes 0 and 2 are both at \(0.1, 0.1\)"),
    ],
)
def test_bad_nodes_are_refused_in_one_line(positions: list, error: type, message: str) -> None:
    """The node and its place are named; on the boundary is normal and tested above."""
    with pytest.raises(error, match=message) as raised:
        voronoi(positions, polygon_domain(DOMAINS["hole"]))
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("apart", [1e-13, 4e-15])
def test_nodes_a_little_apart_are_no_coincident_nodes(apart: float) -> None:
    """The twin: a distance of 1e-13 of the domain still has a bisector, and so has any of some units of the grid, 2^-50 of it."""
    cells = voronoi([[0.5, 0.5], [0.5 + apart, 0.5]], box([0, 0], [1, 1]))
    np.testing.assert_allclose(cells.measures, 0.5, rtol=0, atol=1e-12)
