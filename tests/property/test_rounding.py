"""How many digits of a shape function doubles get right: hypothesis climbs towards the worst ratio of error and bound."""

from fractions import Fraction

import numpy as np
from hypothesis import example, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.samples import NodeSet, rational_node_sets
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.basis import basis
from rkverify.paper.kernel_rates import phi
from rkverify.paper.moment import coefficients, moment_matrix
from rkverify.paper.shape import shape_functions

NODES = st.from_type(NodeSet)
ORDERS = st.integers(0, 2)
EXACT = Exact()


def in_doubles(nodes: NodeSet) -> NodeSet:
    """Coordinates and supports rounded to doubles first, so that both arithmetics get the same numbers."""
    rounded = (tuple(Fraction(float(q)) for q in values) for values in (nodes.nodes, nodes.supports, nodes.points))
    return NodeSet(nodes.name, *rounded, nodes.velocities)


def made(nodes: NodeSet, order: int, K: Exact | Float | Multiprecision) -> Approximation:
    return approximation([[x] for x in nodes.nodes], list(nodes.supports), K, "cubic", order)


def bounds(A: Approximation, x: Fraction) -> dict[int, float]:
    """For each node a bound on the error of Psi_I, in units of half an epsilon, component by component (Skeel).

    z is off by 2 u of itself, so a kernel term by c b^p (2 p + p + 4) u, for (12) by 13 * (4/3 + 2/3) u = 26 u, with its
    constants and the sum 30 u; an entry of M by 30 u + (11 + N) u phi per node; L D L^T solves a matrix off by
    (3 size + 1) u d d^T with d^2 = diag M (Higham, ch. 10); b.H phi by 30 u + (8 + size) u phi of |b|.|H|.
    A perturbation dM moves Psi_I by phi_I |H_I| |M^-1| dM |b|.
    """
    reached = A.neighbours((x,))
    H = np.array([[float(h) for h in basis(A.offset((x,), I), A.order, A.K)] for I in reached])
    weight = np.array([float(phi(A, (x,), I)) for I in reached])
    M = np.array([[float(m) for m in row] for row in moment_matrix(A, (x,))])
    b = np.array([float(c) for c in coefficients(A, (x,))])
    size, d = len(M), np.sqrt(np.diag(M))
    Hs, bs = abs(H / d), abs(b * d)
    inverse = abs(np.linalg.inv(M / np.outer(d, d)))
    moved = np.einsum("Ii,Ij,I->ij", Hs, Hs, 30 + (11 + len(reached)) * weight) + (3 * size + 1)
    spread = (Hs @ inverse @ moved @ bs) * weight
    own = (Hs @ bs) * (30 + (8 + size) * weight)
    # First order only: with |M^-1| dM below 1 % two percent cover the rest.
    assert np.linalg.norm(inverse @ moved) * Float.epsilon < 0.01
    return dict(zip(reached, 1.02 * (spread + own), strict=True))


@given(nodes=NODES, order=ORDERS)
@example(nodes=rational_node_sets(9, 1)[0], order=2)
@example(nodes=rational_node_sets(9, 4)[2], order=2)
def test_doubles_are_right_to_their_condition(nodes: NodeSet, order: int) -> None:
    """Every constant of the bound is counted, none tuned: decides what a double's digits are worth, node set by node set."""
    doubles = in_doubles(nodes)
    A, F = made(doubles, order, EXACT), made(doubles, order, Float())
    for number, x in enumerate(doubles.points):
        exact, found, bound = shape_functions(A, (x,)), shape_functions(F, (float(x),)), bounds(A, x)
        worst = 0.0
        for I in exact.keys() | found.keys():
            error = abs(Fraction(found.get(I, 0.0)) - exact.get(I, 0))
            # A node that only rounding brings into reach has a kernel below 1e-45 and no bound of its own.
            allowed = Fraction(bound.get(I, 1e-20) * Float.epsilon / 2)
            worst = max(worst, float(error / allowed))
        target(worst, label=f"error over bound, point {number}")
        assert worst <= 1


@given(nodes=NODES, order=ORDERS)
def test_more_digits_are_right_to_the_digits_promised(nodes: NodeSet, order: int) -> None:
    """mp:D carries ten digits in hand for a condition up to 10^10: at 15 and at 30 digits all of D are right."""
    for digits in (15, 30):
        K, wide = Multiprecision(digits), Multiprecision(60)
        A = made(nodes, order, K)
        for x in nodes.points:
            exact, found = shape_functions(made(nodes, order, EXACT), (x,)), shape_functions(A, A.point(x))
            for I, value in exact.items():
                error = abs(wide.number(found.get(I, 0)) - wide.number(value))
                assert error <= wide.number(1) / 10**digits
