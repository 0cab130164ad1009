"""Shape functions do not see the origin, the orientation, the unit or the numbering: exactly, on random node sets."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from rkverify.arithmetic.native import Exact
from rkverify.certify.samples import NodeSet
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.cells import Cell
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.material_rates import psi_star, true_rate
from rkverify.paper.shape import Values, shape_functions, shape_gradient, shape_second

NODES = st.from_type(NodeSet)
ORDERS = st.integers(0, 2)
SMOOTH = st.sampled_from(sorted(set(KERNELS) - {"tent"}))
SHIFTS = st.fractions(-1000, 1000, max_denominator=100)
UNITS = st.fractions(Fraction(1, 10**6), 10**6).filter(bool)
READINGS = ("full", "frozen-b")


def mapped(nodes: NodeSet, order: int, kernel: str, factor: Fraction, shift: Fraction) -> Approximation:
    """The nodes at factor x + shift with supports |factor| a."""
    places = [[factor * x + shift] for x in nodes.nodes]
    return approximation(places, [abs(factor) * a for a in nodes.supports], Exact(), kernel, order)


def times(values: Values, factor: Fraction) -> Values:
    return {I: factor * value for I, value in values.items()}


def everything(A: Approximation, x: Fraction, nodes: NodeSet, factor: Fraction = Fraction(1)) -> list[Values]:
    """Values, derivatives (the frozen one stands in Psi*), rates and smoothed gradients in units of the unmapped set: derivatives times factor."""
    velocities = [(factor * v,) for v in nodes.velocities]
    width = factor * Fraction(1, 8)
    return [
        shape_functions(A, (x,)),
        *(times(shape_gradient(A, (x,), 0, reading), factor) for reading in READINGS),
        times(shape_second(A, (x,)), factor**2),
        psi_star(A, (x,), (factor * Fraction(2, 3),), velocities),
        true_rate(A, (x,), (factor * Fraction(2, 3),), velocities),
        times(smoothed_gradient(A, Cell(x - width, x + width)), factor),
    ]


def inside(nodes: NodeSet) -> Fraction:
    """A point whose cell of half-width 1/8 lies within the hull."""
    low, high = nodes.nodes[0] + Fraction(1, 8), nodes.nodes[-1] - Fraction(1, 8)
    return min(max(nodes.points[0], low), high)


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH, shift=SHIFTS)
def test_translation(nodes: NodeSet, order: int, kernel: str, shift: Fraction) -> None:
    """Decides that only differences x - x_I enter, as (4) is written; a basis in x itself would do it in exact numbers too,
    but then not to the last digit of every derivative reading and rate, which hold b fixed.
    """
    x = inside(nodes)
    here = everything(mapped(nodes, order, kernel, Fraction(1), Fraction(0)), x, nodes)
    assert everything(mapped(nodes, order, kernel, Fraction(1), shift), x + shift, nodes) == here


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH)
def test_reflection(nodes: NodeSet, order: int, kernel: str) -> None:
    """x -> -x: values and second derivatives keep, first derivatives and smoothed gradients change sign, rates keep."""
    x, mirror = inside(nodes), Fraction(-1)
    here = everything(mapped(nodes, order, kernel, Fraction(1), Fraction(0)), x, nodes)
    assert everything(mapped(nodes, order, kernel, mirror, Fraction(0)), -x, nodes, mirror) == here


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH, unit=UNITS)
def test_units(nodes: NodeSet, order: int, kernel: str, unit: Fraction) -> None:
    """x -> unit x: Psi keeps, each derivative carries one 1/length, rates none when velocities are scaled as well."""
    x = inside(nodes)
    here = everything(mapped(nodes, order, kernel, Fraction(1), Fraction(0)), x, nodes)
    assert everything(mapped(nodes, order, kernel, unit, Fraction(0)), unit * x, nodes, unit) == here


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH, data=st.data())
def test_numbering(nodes: NodeSet, order: int, kernel: str, data: st.DataObject) -> None:
    """Nodes in another order carry the same values: decides that nothing depends on neighbours being neighbours in a list."""
    x, ranks = inside(nodes), data.draw(st.permutations(range(len(nodes.nodes))))
    shuffled = NodeSet("shuffled", *(tuple(values[I] for I in ranks) for values in (nodes.nodes, nodes.supports)),
                       nodes.points, tuple(nodes.velocities[I] for I in ranks))  # fmt: skip
    A, B = (mapped(n, order, kernel, Fraction(1), Fraction(0)) for n in (nodes, shuffled))
    for values in (shape_functions, shape_gradient):
        assert {ranks[I]: value for I, value in values(B, (x,)).items()} == values(A, (x,))
    one, other = (
        true_rate(C, (x,), (Fraction(2, 3),), [(v,) for v in n.velocities]) for C, n in ((A, nodes), (B, shuffled))
    )
    assert {ranks[I]: value for I, value in other.items()} == one


@given(nodes=NODES, order=ORDERS, factor=st.fractions(Fraction(11, 10), 2, max_denominator=50))
def test_the_twin_where_supports_stay(nodes: NodeSet, order: int, factor: Fraction) -> None:
    """Stretching the nodes and not the supports is no change of unit: some value changes, as it must."""
    stretched = [[factor * x] for x in nodes.nodes]
    other = approximation(stretched, [factor**2 * a for a in nodes.supports], Exact(), "cubic", order)
    one = mapped(nodes, order, "cubic", Fraction(1), Fraction(0))
    x = (nodes.nodes[1] + nodes.nodes[2]) / 2 + Fraction(1, 37)
    assert shape_functions(one, (x,)) != shape_functions(other, (factor * x,))
