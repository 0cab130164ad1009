"""Polygons of somebody else: shared edges are found, orientation is made right, and what cannot be a cell is named."""

import numpy as np
import pytest

from rkverify.errors import BadInput
from rkverify.solid.cell_rings import all_rings, rings
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.domain import box, polygon_domain
from rkverify.solid.given_cells import polygon_cells
from rkverify.solid.voronoi import voronoi

LEFT, RIGHT = [(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 0), (2, 0), (2, 1), (1, 1)]
HOLE = [(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]


@pytest.mark.parametrize("first", [LEFT, LEFT[::-1]])
@pytest.mark.parametrize("second", [RIGHT, RIGHT[::-1], [*RIGHT, RIGHT[0]]])
def test_two_squares_share_an_edge(first: list, second: list) -> None:
    """Whatever their orientation: one facet with the normal out of the first, six outside."""
    cells = polygon_cells([[first], [second]])
    shared = np.flatnonzero(cells.sides[:, 1] != OUTSIDE)
    assert cells.sides[shared].tolist() == [[0, 1]]
    assert cells.areas[shared].tolist() == [[1.0, 0.0]]
    assert len(cells.boundary) == 6
    assert cells.starts.tolist() == list(range(0, 15, 2))  # two corners for each of seven facets, and no more
    assert cells.measures.tolist() == [1.0, 1.0]


@pytest.mark.parametrize("noise", [1e-11, 1e-6])
def test_vertices_from_text_coincide_to_their_digits(noise: float) -> None:
    """Rounded to eleven digits they are the same edge; a gap of a millionth (the twin) is a gap, which is somebody's own."""
    moved = np.add(RIGHT, (noise, 0))
    assert len(polygon_cells([[LEFT], [moved]]).boundary) == (6 if noise < 1e-9 else 8)


def test_a_hole_and_two_pieces() -> None:
    """A ring inside the first is a hole, any other a piece; a cell may fill another's hole."""
    cells = polygon_cells([[LEFT, HOLE, [(5, 0), (5, 1), (6, 0)]], [HOLE]])
    assert cells.measures == pytest.approx([1 - 0.36 + 0.5, 0.36], rel=1e-15)
    assert (cells.sides[:, 1] != OUTSIDE).sum() == 4
    assert [len(ring) for ring in rings(cells, 0)] == [4, 3, 4]


def test_an_island_in_a_hole_is_a_piece() -> None:
    """Inside two other rings: rings alternate with their depth, in any order after the first."""
    island = [(0.4, 0.4), (0.6, 0.4), (0.6, 0.6)]
    for order in ([LEFT, HOLE, island], [LEFT, island, HOLE]):
        assert polygon_cells([order]).measures == pytest.approx([1 - 0.36 + 0.02], rel=1e-14)


def test_an_edge_with_a_vertex_of_another_in_its_middle_is_not_shared() -> None:
    """The twin of sharing: with a hanging vertex nothing is shared, so that nobody takes a gap for a facet."""
    cells = polygon_cells([[LEFT], [[(1, 0), (2, 0), (2, 1), (1, 1), (1, 0.5)]]])
    assert (cells.sides[:, 1] == OUTSIDE).all()


def test_voronoi_cells_written_and_read_are_the_same_cells() -> None:
    """The round trip of a table: in a domain with a hole, with cells in several pieces."""
    slit = [(0.45, -1), (0.5, 0.9), (0.55, -1)]
    outline = [(0, -1), slit[0], slit[1], slit[2], (1, -1), (1, 1), (0, 1)]
    domain = polygon_domain([outline, [(0.2, 0.2), (0.4, 0.2), (0.3, 0.5)]])
    x = np.random.default_rng(5).random((60, 2)) * [1, 2] - [0, 1]
    x = x[domain.contains(x)]
    made = voronoi(x, domain)
    read = polygon_cells(all_rings(made))
    assert max(len(loops) for loops in all_rings(made)) > 1
    # Vertices are the same doubles; only the order of summation over at most 20 edges differs.
    np.testing.assert_allclose(read.measures, made.measures, rtol=0, atol=40 * np.finfo(float).eps)
    assert sorted(map(tuple, np.sort(read.sides, axis=1).tolist())) == sorted(
        map(tuple, np.sort(made.sides, axis=1).tolist())
    )


def test_rings_go_round_in_order_from_the_lowest_vertex() -> None:
    """One way to write a cell, so that tables can be compared: counter-clockwise outside, clockwise around a hole."""
    frame = polygon_domain([[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 3), (1, 3)]])
    cells = voronoi([[0.5, 2]], frame)
    outside, inside = rings(cells, 0)
    assert outside.tolist() == [[0, 0], [4, 0], [4, 4], [0, 4]]
    assert inside.tolist() == [[1, 1], [1, 3], [3, 3], [3, 1]]
    x = np.random.default_rng(1).random((50, 2))
    many = voronoi(x, box([0, 0], [1, 1]))
    for L, loops in enumerate(all_rings(many)):
        assert [loop.tolist() for loop in loops] == [loop.tolist() for loop in rings(many, L)]


def test_pieces_that_touch_in_a_point_stay_two_rings() -> None:
    """A figure of eight would be self-intersecting for whoever reads the table."""
    bow = polygon_cells([[[(0, 0), (1, 0), (1, 1)], [(1, 1), (2, 1), (2, 2)]]])
    assert [len(ring) for ring in rings(bow, 0)] == [3, 3]


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ([], "there are no cells"),
        ([[LEFT], []], "cell 1 has no rings"),
        ([[LEFT], [[(0, 0), (1, 1)]]], "ring 0 of cell 1 has 2 different vertices"),
        ([[LEFT], [[(0, 0), (1, 1), (2, 2)]]], "ring 0 of cell 1 has no area"),
        ([[LEFT], [[(2, 0), (3, 1), (3, 0), (2, 1)]]], r"ring 0 of cell 1 is not simple: .* at \(2.5, 0.5\)"),
        ([[LEFT, [(0.1, 0.1), (0.2, 0.2), (0.2, float("nan"))]]], r"ring 1 of cell 0 has vertex 2 at \(0.2, nan\)"),
        ([[LEFT, [(0.5, 0.5), (3, 0.5), (3, 0.6)]]], "ring 0 of cell 0 is not simple: its edge from vertex 1 meets"),
        ([[LEFT], [LEFT]], r"cells 0 and 1 are on the same side of the edge from \(0, 0\) to \(1, 0\)"),
        ([[LEFT], [[(2, 0), (2 + 1e-11, 0), (3, 1)]]], r"cell 1 has an edge of no length but rounding at \(2, 0\)"),
    ],
)
def test_what_cannot_be_a_cell_is_refused_in_one_line(cells: list, message: str) -> None:
    """Cell and ring are named."""
    with pytest.raises(BadInput, match=message) as raised:
        polygon_cells(cells)
    assert "\n" not in str(raised.value)
