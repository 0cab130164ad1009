"""Voronoi cells on a line: the only ones that can be written down by hand."""

import numpy as np
import pytest

from rkverify.errors import BadInput, CoincidentNodes
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.domain import box
from rkverify.solid.voronoi import moved, topology, voronoi


def test_from_half_way_to_half_way() -> None:
    """Nodes in any order, one of them on the boundary: measures, facets and signs are those of the drawing."""
    cells = voronoi([[3.0], [0.0], [1.0]], box([0], [4]))
    assert cells.measures.tolist() == [2.0, 0.5, 1.5]
    assert cells.vertices[:, 0].tolist() == [0.5, 2.0, 0.0, 4.0]
    assert cells.sides.tolist() == [[1, 2], [2, 0], [1, OUTSIDE], [0, OUTSIDE]]
    assert cells.areas[:, 0].tolist() == [1.0, 1.0, -1.0, 1.0]
    assert cells.starts.tolist() == [0, 1, 2, 3, 4]


def test_one_node_owns_the_interval() -> None:
    """Two facets, both outside."""
    assert voronoi([[0.3]], box([0], [1])).measures.tolist() == [1.0]


def test_moved_nodes_move_their_facets_by_half() -> None:
    """Measures are linear in the positions, so that a complex step has no error; and the twin: past each other they are not Voronoi's."""
    x = np.array([[0.1], [0.4], [0.8]])
    t = topology(x, box([0], [1]))
    step = np.array([[0.0], [1e-30j], [0.0]])
    assert (moved(t, x + step).measures.imag / 1e-30).tolist() == [0.5, 0.0, -0.5]
    assert moved(t, x + step).measures.real.tolist() == voronoi(x, box([0], [1])).measures.tolist()
    swapped = moved(t, x[[1, 0, 2]])
    assert swapped.measures.sum() == pytest.approx(1.0, rel=1e-15)
    assert swapped.measures.tolist() != voronoi(x[[1, 0, 2]], box([0], [1])).measures.tolist()


@pytest.mark.parametrize(
    ("nodes", "error", "message"),
    [
        ([[0.1], [1.1]], BadInput, r"node 1 at \(1.1\) is outside"),
        ([[0.1], [0.1]], CoincidentNodes, "nodes 0 and 1 are both at"),
    ],
)
def test_bad_nodes_are_refused(nodes: list, error: type, message: str) -> None:
    """The same errors as in the plane."""
    with pytest.raises(error, match=message):
        voronoi(nodes, box([0], [1]))
