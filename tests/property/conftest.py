"""Random node sets in one dimension, as hypothesis makes them for every test that asks for a NodeSet."""

from fractions import Fraction
from itertools import accumulate, pairwise

from hypothesis import strategies as st

from rkverify.certify.samples import NodeSet

GAPS = st.integers(4, 20).map(lambda n: Fraction(n, 16))  # no gap below 1/4 of a unit: nodes stay apart
SPEEDS = st.fractions(-3, 3, max_denominator=6)


@st.composite
def node_sets(draw: st.DrawFn) -> NodeSet:
    """5 or 6 nodes, supports of their own above twice the widest gap, so that three nodes at least cover every point.

    The points: anywhere in the hull, and one on a node, a kernel's joint or the edge of a support where it is inside.
    """
    start = draw(st.fractions(-5, 5, max_denominator=8))
    gaps = draw(st.lists(GAPS, min_size=4, max_size=5))
    nodes = tuple(accumulate(gaps, initial=start))
    widest = max(q - p for p, q in pairwise(nodes))
    supports = tuple(widest * (2 + Fraction(draw(st.integers(2, 12)), 8)) for _ in nodes)
    share = draw(st.fractions(0, 1, max_denominator=97))
    J, side, part = (
        draw(st.integers(0, len(nodes) - 1)),
        draw(st.sampled_from([-1, 1])),
        draw(st.sampled_from([0, 1, 2])),
    )
    corner = nodes[J] + side * supports[J] * Fraction(part, 2)
    points = [nodes[0] + share * (nodes[-1] - nodes[0])]
    if nodes[0] <= corner <= nodes[-1]:
        points.append(corner)
    velocities = tuple(draw(SPEEDS) for _ in nodes)
    return NodeSet("random", nodes, supports, tuple(points), velocities)


st.register_type_strategy(NodeSet, node_sets())
