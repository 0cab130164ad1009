"""Random nodes, supports, orders and kernels: shape functions reproduce, exactly, and so do their derivatives."""

from fractions import Fraction
from math import factorial

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.series import Series
from rkverify.certify.independent import shape_functions_by_minimisation
from rkverify.certify.samples import NodeSet, rational_node_sets
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.shape import reproducing_residual, shape_functions, shape_gradient, shape_second

K = Exact()
NODES = st.from_type(NodeSet)
ORDERS = st.integers(0, 2)
NAMES = st.sampled_from(sorted(KERNELS))
SMOOTH = st.sampled_from(sorted(set(KERNELS) - {"tent"}))
JITTERED = rational_node_sets(9, 1)[2]  # points on a node, a joint and an edge


def made(nodes: NodeSet, order: int, kernel: str = "cubic", arithmetic: Arithmetic = K) -> Approximation:
    return approximation([[x] for x in nodes.nodes], list(nodes.supports), arithmetic, kernel, order)


@pytest.mark.decides("E3", "E29")
@given(nodes=NODES, order=ORDERS, kernel=NAMES)
@example(nodes=JITTERED, order=2, kernel="cubic")
def test_reproduction_is_exact(nodes: NodeSet, order: int, kernel: str) -> None:
    """(3): sum_I Psi_I x_I^k = x^k for k <= n is the rational 0 less the rational 0, for every kernel.

    Decides reproduction away from any hand-picked set: also with supports that differ, also on joints and edges.
    """
    A = made(nodes, order, kernel)
    for x in nodes.points:
        assert [reproducing_residual(A, (x,), (k,)) for k in range(order + 1)] == [0] * (order + 1)


@given(nodes=NODES, order=ORDERS)
def test_the_next_degree_is_missed_by_the_weighted_squares(nodes: NodeSet, order: int) -> None:
    """The twin, for orders 0 and 1 with a sign: of order 1 with values >= 0, sum Psi x_I^2 - x^2 = sum Psi (x_I - x)^2 > 0.

    In general the residual of degree n + 1 is (-1)^(n+1) sum Psi_I (x - x_I)^(n+1): computed apart, it is the same number.
    """
    A = made(nodes, order)
    for x in nodes.points:
        Psi = shape_functions(A, (x,))
        shifted = sum(v * (nodes.nodes[I] - x) ** (order + 1) for I, v in Psi.items())
        assert reproducing_residual(A, (x,), (order + 1,)) == shifted
        if order == 1 and min(Psi.values()) >= 0:
            assert shifted > 0


@pytest.mark.decides("E4", "E28", "C15")
@given(nodes=NODES, order=ORDERS)
@example(nodes=JITTERED, order=2)
def test_the_closed_form_is_the_constrained_minimum(nodes: NodeSet, order: int) -> None:
    """Another algebra (multipliers, monomials of x itself) gives the same rationals."""
    for x in nodes.points:
        other = shape_functions_by_minimisation(nodes.nodes, nodes.supports, x, order)
        found = shape_functions(made(nodes, order), (x,))
        assert all(Psi == other.get(I, 0) for I, Psi in found.items())


@given(nodes=NODES, order=ORDERS, kernel=SMOOTH)
@example(nodes=JITTERED, order=2, kernel="cubic")
@example(nodes=JITTERED, order=1, kernel="quintic")
def test_derivatives_are_the_coefficients_of_series(nodes: NodeSet, order: int, kernel: str) -> None:
    """Psi,x and Psi,xx against Psi(x + t) expanded exactly: product rule against power series, on joints as well."""
    A, S = made(nodes, order, kernel), Series(3)
    for x in nodes.points:
        terms = {
            I: S.coefficients(v) for I, v in shape_functions(made(nodes, order, kernel, S), (S.variable(x),)).items()
        }
        for n, found in enumerate((shape_functions(A, (x,)), shape_gradient(A, (x,)), shape_second(A, (x,)))):
            assert all(value == factorial(n) * terms[I][n] for I, value in found.items())


@given(nodes=NODES, order=ORDERS)
def test_derivatives_of_reproduced_fields(nodes: NodeSet, order: int) -> None:
    """sum Psi,x x_I^k = k x^(k-1) and sum Psi,xx x_I^k = k (k-1) x^(k-2), with all conditions differentiated."""
    A = made(nodes, order)
    for x in nodes.points:
        first, second = shape_gradient(A, (x,)), shape_second(A, (x,))
        for k in range(order + 1):
            assert sum(v * nodes.nodes[I] ** k for I, v in first.items()) == (k * x ** (k - 1) if k else 0)
            assert sum(v * nodes.nodes[I] ** k for I, v in second.items()) == (2 if k == 2 else 0)


@given(nodes=NODES, kernel=NAMES)
def test_order_zero_is_between_zero_and_one(nodes: NodeSet, kernel: str) -> None:
    """Shepard's functions are weights over their sum; from order 1 on values may leave [0, 1] and often do at ends."""
    for x in nodes.points:
        assert all(0 <= Psi <= 1 for Psi in shape_functions(made(nodes, 0, kernel), (x,)).values())


@given(
    nodes=NODES,
    order=ORDERS,
    further=st.fractions(0, 3, max_denominator=20),
    support=st.fractions(1, 9, max_denominator=4),
)
def test_a_node_out_of_reach_does_not_matter(nodes: NodeSet, order: int, further: Fraction, support: Fraction) -> None:
    """Locality: a node more, whose support ends at x or before, changes nothing at all."""
    x = nodes.points[0]
    extra = max(x + support, nodes.nodes[-1] + Fraction(1, 9)) + further
    other = approximation([[n] for n in (*nodes.nodes, extra)], [*nodes.supports, support], K, "cubic", order)
    for values in (shape_functions, shape_gradient, shape_second):
        one, two = values(made(nodes, order), (x,)), values(other, (x,))
        assert all(one.get(I, 0) == value for I, value in two.items())


@given(nodes=NODES, order=ORDERS)
def test_the_twin_of_a_node_within_reach(nodes: NodeSet, order: int) -> None:
    """A support that reaches a little beyond x changes the values there."""
    x = nodes.points[0]
    extra = nodes.nodes[-1] + Fraction(1, 9)
    supports = [*nodes.supports, (extra - x) * Fraction(3, 2)]
    other = approximation([[n] for n in (*nodes.nodes, extra)], supports, K, "cubic", order)
    assert shape_functions(other, (x,))[len(nodes.nodes)] != 0
