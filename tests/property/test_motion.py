"""Random motions: the true rate is the series in time, rigid motions change nothing, sums are exactly zero."""

from fractions import Fraction

from hypothesis import example, given
from hypothesis import strategies as st

from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.series import Series
from rkverify.certify.samples import NodeSet, rational_node_sets
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.material_rates import psi_star, true_rate
from rkverify.paper.shape import shape_functions, shape_gradient

NODES = st.from_type(NodeSet)
ORDERS = st.integers(0, 2)
SMOOTH = st.sampled_from(sorted(set(KERNELS) - {"tent"}))
SPEEDS = st.fractions(-3, 3, max_denominator=7)
JITTERED = rational_node_sets(9, 2)[2]
S = Series(2)


def at_rest(nodes: NodeSet, order: int, kernel: str) -> Approximation:
    return approximation([[x] for x in nodes.nodes], list(nodes.supports), Exact(), kernel, order)


def moving(nodes: NodeSet, order: int, kernel: str) -> Approximation:
    places = [[S.variable(x, v)] for x, v in zip(nodes.nodes, nodes.velocities, strict=True)]
    return approximation(places, list(nodes.supports), S, kernel, order)


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH, v=SPEEDS)
@example(nodes=JITTERED, order=2, kernel="cubic", v=Fraction(0))
def test_the_true_rate_is_the_series_in_time(nodes: NodeSet, order: int, kernel: str, v: Fraction) -> None:
    """Everything that moves, moves: x, every x_I and through them M, b and H. The sum over the nodes is exactly 0."""
    A, later, velocities = at_rest(nodes, order, kernel), moving(nodes, order, kernel), [(w,) for w in nodes.velocities]
    for x in nodes.points:
        true = true_rate(A, (x,), (v,), velocities)
        series = {I: S.coefficients(Psi)[1] for I, Psi in shape_functions(later, (S.variable(x, v),)).items()}
        assert all(true.get(I, 0) == series.get(I, 0) for I in true.keys() | series.keys())
        assert sum(true.values()) == 0


@given(nodes=NODES, order=st.integers(1, 2), v=SPEEDS)
def test_the_true_rate_keeps_linear_fields(nodes: NodeSet, order: int, v: Fraction) -> None:
    """sum Psi_I x_I = x differentiated in time: sum dPsi_I x_I = v - sum Psi_I v_I, exactly."""
    A = at_rest(nodes, order, "cubic")
    for x in nodes.points:
        true = true_rate(A, (x,), (v,), [(w,) for w in nodes.velocities])
        carried = sum(Psi * nodes.velocities[I] for I, Psi in shape_functions(A, (x,)).items())
        assert sum(rate * nodes.nodes[I] for I, rate in true.items()) == v - carried


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH, v=SPEEDS)
def test_rigid_motion_changes_nothing(nodes: NodeSet, order: int, kernel: str, v: Fraction) -> None:
    A, together = at_rest(nodes, order, kernel), [(v,)] * len(nodes.nodes)
    for x in nodes.points:
        assert not any(psi_star(A, (x,), (v,), together).values())
        assert not any(true_rate(A, (x,), (v,), together).values())


@given(nodes=NODES, order=ORDERS, v=SPEEDS, boost=SPEEDS)
def test_rates_do_not_see_the_observers_velocity(nodes: NodeSet, order: int, v: Fraction, boost: Fraction) -> None:
    """Only v - v_I enters (35): adding one velocity to everything leaves Psi* and the true rate as they are."""
    A, x = at_rest(nodes, order, "cubic"), nodes.points[0]
    for rate in (psi_star, true_rate):
        resting = rate(A, (x,), (v,), [(w,) for w in nodes.velocities])
        assert rate(A, (x,), (v + boost,), [(w + boost,) for w in nodes.velocities]) == resting


@given(nodes=NODES, order=ORDERS, Q=SPEEDS.filter(bool))
def test_a_homothety_about_the_point(nodes: NodeSet, order: int, Q: Fraction) -> None:
    """v_I = Q (x_I - x) with supports fixed: the true rate is that of supports shrinking at the rate Q, and Psi* is not.

    The twin of rigid motion: every distance changes, so that some rate is not zero.
    """
    A, x = at_rest(nodes, order, "cubic"), nodes.points[0]
    velocities = [(Q * (n - x),) for n in nodes.nodes]
    shrinking = approximation(
        [[n] for n in nodes.nodes], [a / S.variable(1, Q) for a in map(S.number, nodes.supports)], S, "cubic", order
    )
    series = {I: S.coefficients(Psi)[1] for I, Psi in shape_functions(shrinking, (S.number(x),)).items()}
    true = true_rate(A, (x,), (Fraction(0),), velocities)
    assert all(true[I] == series.get(I, 0) for I in true)
    assert any(true.values())


@given(nodes=NODES, order=ORDERS)
def test_with_nodes_at_rest_the_rate_is_convection(nodes: NodeSet, order: int) -> None:
    """v Psi,x for the true rate; for Psi* v times the frozen derivative, which drops the slope of C."""
    A, rest, v = at_rest(nodes, order, "cubic"), [(Fraction(0),)] * len(nodes.nodes), Fraction(5, 3)
    for x in nodes.points:
        for rate, reading in ((true_rate, "full"), (psi_star, "frozen")):
            slope = shape_gradient(A, (x,), 0, reading)
            assert rate(A, (x,), (v,), rest) == {I: v * s for I, s in slope.items()}
