"""Random nodes: their cells tile, and smoothed gradients over the cells sum to what they must."""

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rkverify.arithmetic.native import Exact
from rkverify.certify.samples import NodeSet
from rkverify.errors import BadInput
from rkverify.paper.approximation import approximation
from rkverify.paper.cells import nodal_cells
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.shape import shape_functions

NODES = st.from_type(NodeSet)
MARGINS = st.fractions(0, 2, max_denominator=10)
K = Exact()


@given(nodes=NODES, left=MARGINS, right=MARGINS, data=st.data())
def test_cells_tile_exactly(nodes: NodeSet, left: Fraction, right: Fraction, data: st.DataObject) -> None:
    """Whatever the numbering: no gap, no overlap, the whole domain, and every place in the cell of its nearest node."""
    ranks = data.draw(st.permutations(range(len(nodes.nodes))))
    places = [nodes.nodes[I] for I in ranks]
    ends = nodes.nodes[0] - left, nodes.nodes[-1] + right
    cells = nodal_cells(places, *ends, K)
    ordered = sorted(cells, key=lambda cell: cell.left)
    assert all(p.right == q.left for p, q in pairwise(ordered))
    assert (ordered[0].left, ordered[-1].right) == ends
    assert sum(cell.measure for cell in cells) == ends[1] - ends[0]
    place = ends[0] + data.draw(st.fractions(0, 1, max_denominator=97)) * (ends[1] - ends[0])
    nearest = min(abs(place - x) for x in places)
    assert any(c.left <= place <= c.right and abs(place - x) == nearest for x, c in zip(places, cells, strict=True))


@given(nodes=NODES, beyond=st.fractions(Fraction(1, 100), 1))
def test_a_node_outside_its_domain_is_refused(nodes: NodeSet, beyond: Fraction) -> None:
    """The twin of the margins: the first node lies outside a domain that begins a little later."""
    with pytest.raises(BadInput, match=r"node 0 at .* lies outside the domain"):
        nodal_cells(nodes.nodes, nodes.nodes[0] + beyond, nodes.nodes[-1] + 2, K)


@pytest.mark.decides("E52", "E72", "C17")
@given(nodes=NODES, order=st.integers(0, 2))
def test_smoothed_gradients_sum_exactly(nodes: NodeSet, order: int) -> None:
    """Over the nodes: sum b_I^L x_I^k = (x^k at the right end less at the left)/a_L for k <= n, in every cell.

    Over the cells: sum_L b_I^L a_L telescopes to Psi_I at the domain's ends, the integration constraint of SCNI.
    """
    A = approximation([[x] for x in nodes.nodes], list(nodes.supports), K, "cubic", order)
    ends = nodes.nodes[0], nodes.nodes[-1]
    cells = nodal_cells(nodes.nodes, *ends, K)
    gradients = [smoothed_gradient(A, cell) for cell in cells]
    for cell, b in zip(cells, gradients, strict=True):
        for k in range(order + 1):
            exact = (cell.right**k - cell.left**k) / cell.measure
            assert sum(value * nodes.nodes[I] ** k for I, value in b.items()) == exact
    left, right = (shape_functions(A, (end,)) for end in ends)
    for I in range(len(nodes.nodes)):
        total = sum(b.get(I, Fraction(0)) * cell.measure for b, cell in zip(gradients, cells, strict=True))
        assert total == right.get(I, 0) - left.get(I, 0)
