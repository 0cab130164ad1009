"""Shape functions in one dimension, exact: what they reproduce, what they do not, and two other ways to them."""

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

import pytest

from rkverify.arithmetic.native import Exact
from rkverify.certify.independent import (
    cubic_kernel_as_printed,
    linear_shape_functions_in_closed_form,
    shape_functions_by_minimisation,
)
from rkverify.certify.samples import NodeSet
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import Approximation, lattice, middle
from rkverify.paper.moment import at_origin, coefficients, moment_matrix, solve
from rkverify.paper.shape import correction, field, reproducing_residual, shape_functions

Build = Callable[..., Approximation]
Points = Callable[[NodeSet], list[Fraction]]


@pytest.mark.decides("E3", "E29")
def test_reproduction_up_to_the_order_and_not_one_further(
    build: Build, all_edges_and_joints: Points, nodes: NodeSet, order: int
) -> None:
    """(3), (29): the residual is the rational 0 at every edge, joint and node; for degree n + 1 it is not.

    Decides the order of the approximation: with rationals there is no tolerance behind which a wrong one could hide.
    """
    A = build(nodes, order)
    points = [
        x for x in all_edges_and_joints(nodes) if sum(abs(x - n) < a for n, a in zip(nodes.nodes, nodes.supports)) > 2
    ]
    assert len(points) > 2 * len(nodes.nodes)
    for x in points:
        assert [reproducing_residual(A, (x,), (degree,)) for degree in range(order + 1)] == [0] * (order + 1)
    assert any(reproducing_residual(A, (x,), (order + 1,)) != 0 for x in points)


@pytest.mark.parametrize("kernel", KERNELS)
def test_every_kernel_reproduces(build: Build, nodes: NodeSet, order: int, kernel: str) -> None:
    A = build(nodes, order, kernel=kernel)
    for x in nodes.points:
        assert [reproducing_residual(A, (x,), (degree,)) for degree in range(order + 1)] == [0] * (order + 1)
    assert reproducing_residual(A, (nodes.points[-1],), (order + 1,)) != 0


@pytest.mark.decides("E4", "E28", "C15")
def test_the_closed_form_is_the_constrained_minimum(
    build: Build, all_edges_and_joints: Points, nodes: NodeSet, order: int
) -> None:
    """Least sum of Psi^2/phi under (3), in the monomials of x itself: no moment matrix, no shifted basis, same rationals."""
    A = build(nodes, order)
    for x in (*nodes.points, *all_edges_and_joints(nodes)[4:-4:5]):
        other = shape_functions_by_minimisation(nodes.nodes, nodes.supports, x, order)
        found = shape_functions(A, (x,))
        assert {I: Psi for I, Psi in found.items() if I in other} == other
        assert all(Psi == 0 for I, Psi in found.items() if I not in other)


def test_order_one_is_cramers_rule(build: Build, nodes: NodeSet) -> None:
    for x in nodes.points:
        other = linear_shape_functions_in_closed_form(nodes.nodes, nodes.supports, x)
        found = shape_functions(build(nodes, 1), (x,))
        assert all(Psi == other.get(I, 0) for I, Psi in found.items())


@pytest.mark.decides("E6", "E11", "E32")
def test_the_moment_matrix_is_the_sum_of_powers(build: Build, nodes: NodeSet, order: int) -> None:
    """M_ij = sum_I (x - x_I)^(i+j) phi with the kernel from its printed pieces, and M b = H(0)."""
    A = build(nodes, order)
    for x in nodes.points:
        weights = [cubic_kernel_as_printed(abs(x - n) / a) for n, a in zip(nodes.nodes, nodes.supports, strict=True)]
        M = moment_matrix(A, (x,))
        for i in range(order + 1):
            for j in range(order + 1):
                total = sum((w * (x - n) ** (i + j) for w, n in zip(weights, nodes.nodes, strict=True)), Fraction(0))
                assert M[i][j] == total
        b = coefficients(A, (x,))
        assert [sum(m * c for m, c in zip(row, b, strict=True)) for row in M] == at_origin(A)


def test_the_solver_is_gauss_jordan(build: Build, nodes: NodeSet, solve_exactly: Callable[..., list[Fraction]]) -> None:
    """L D L^T without pivoting against elimination with it, on moment matrices and another right-hand side."""
    A, right = build(nodes, 2), [Fraction(2), Fraction(-1, 3), Fraction(5)]
    for x in nodes.points:
        M = moment_matrix(A, (x,))
        assert solve(A, (x,), M, right) == solve_exactly(M, right)


@pytest.mark.decides("E1")
def test_coefficients_are_not_nodal_values(build: Build, nodes: NodeSet) -> None:
    """u^h(x_J) is not d_J: a shape function is below 1 at its own node and above 0 at the next."""
    A = build(nodes, 1)
    J = len(nodes.nodes) // 2
    Psi = shape_functions(A, A.nodes[J])
    assert 0 < Psi[J + 1] < Psi[J] < 1
    assert field(A, A.nodes[J], [Fraction(int(I == J)) for I in range(len(nodes.nodes))]) == Psi[J] != 1


def test_the_twin_where_they_are_nodal_values() -> None:
    """The tent with R = 1 reaches no other node: there, and only there, a coefficient is a nodal value."""
    A = lattice(1, 1, 2, Exact(), "tent", 0)
    assert shape_functions(A, A.point(0))[middle(A)] == 1


@pytest.mark.decides("E31", "E30")
def test_the_correction_times_the_kernel_is_the_shape_function(build: Build, nodes: NodeSet, order: int) -> None:
    """(30): Psi_I = C(x; x - x_I) phi_a(x - x_I), with C a polynomial of degree n in its second argument."""
    A = build(nodes, order)
    for x in nodes.points:
        for I, Psi in shape_functions(A, (x,)).items():
            weight = cubic_kernel_as_printed(abs(x - nodes.nodes[I]) / nodes.supports[I])
            assert correction(A, (x,), (x - nodes.nodes[I],)) * weight == Psi
        values = [correction(A, (x,), (Fraction(n),)) for n in range(5)]
        for _ in range(order + 1):
            values = [q - p for p, q in pairwise(values)]
        assert not any(values)  # the differences of order n + 1 of a polynomial of degree n


def test_a_lattice_looks_the_same_from_both_sides(order: int) -> None:
    """Psi_{I+n}(x_I + t) = Psi_{I-n}(x_I - t) in an infinite lattice: the part that is kept is wide enough."""
    A = lattice("1/20", "5/2", 2, Exact(), order=order)
    I, t = middle(A), Fraction(1, 60)
    right, left = shape_functions(A, (t,)), shape_functions(A, (-t,))
    assert {J - I: Psi for J, Psi in right.items()} == {I - J: Psi for J, Psi in left.items()}


@pytest.mark.parametrize("reach", [0, 1, 3])
def test_a_wider_lattice_changes_nothing_within_reach(reach: int, order: int) -> None:
    """Decides that `reach` means what it says: adding nodes leaves every value within it, exactly."""
    small, large = (lattice(1, "5/2", r, Exact(), order=order) for r in (reach, reach + 4))
    for place in {Fraction(0), Fraction(reach), Fraction(2 * reach, 3)}:
        values = {J - middle(small): Psi for J, Psi in shape_functions(small, (place,)).items()}
        assert values == {J - middle(large): Psi for J, Psi in shape_functions(large, (place,)).items()}
