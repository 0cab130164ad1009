"""Readings of the print: where they differ, where they agree, and what the agreement rests on."""

from dataclasses import asdict
from fractions import Fraction

import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.errors import BadInput, NotDifferentiable, TooFewNodes, UnknownName
from rkverify.paper.notation import HALF_POINTS, lattice_values
from rkverify.paper.printed_lagrangian import b_hat, omega_squared
from rkverify.paper.printed_semi_lagrangian import State, scni_omega_squared
from rkverify.paper.shape import DERIVATIVES

K = Exact()
RATIOS = ["11/10", "3/2", "7/4", "19/10"]


def differing(one: dict[str, Fraction], other: dict[str, Fraction]) -> set[str]:
    return {name for name in one if one[name] != other[name]}


@pytest.mark.parametrize("R", RATIOS)
def test_the_readings_of_the_half_point_differ_in_one_number(R: str) -> None:
    """C(h/2) alone, and by more than rounding: decides that the choice is a reading of (72) and of nothing else."""
    literal, edge = (asdict(lattice_values(1, R, K, half_point)) for half_point in ("literal", "edge"))
    assert differing(literal, edge) == {"C_half"}


@pytest.mark.parametrize("R", RATIOS)
@pytest.mark.parametrize("reading", DERIVATIVES)
def test_the_readings_of_the_derivative_differ_in_two(R: str, reading: str) -> None:
    full, other = (asdict(lattice_values(1, R, K, derivative=d)) for d in ("full", reading))
    assert differing(full, other) <= {"Psi_x_h", "Psi_xx_h"}
    assert (full["Psi_xx_h"] != other["Psi_xx_h"]) == (reading != "full")


@pytest.mark.decides("C37")
@pytest.mark.parametrize(("R", "complete"), [("11/10", True), ("3/2", True), ("7/4", False), ("19/10", False)])
def test_two_values_make_the_smoothed_gradient_only_up_to_three_halves(R: str, complete: bool) -> None:
    """(75) has the gradients ± C(h/2) phi(h/2)/h alone: those of (72) for R <= 3/2; beyond, Psi at 3h/2 is missing.

    Compared as omega^2 without Q, where (86) and (63) are the same physics on the same lattice; the edge reading.
    """
    M, kh = Multiprecision(30), Multiprecision(30).ratio(4, 5)
    s = lattice_values(1, R, M, "edge")
    state = State(M.number(1), M.zero(), M.number(1), M.zero())
    short, whole = scni_omega_squared(s, state, kh, M), omega_squared(b_hat(1, R, M), M.number(1), kh, M)
    # Values below 1, fewer than 1000 operations and a condition below 100: 1e5 epsilon.
    assert (abs(short - whole) < 1e5 * M.epsilon) == complete
    literal = lattice_values(1, R, M, "literal")
    assert abs(scni_omega_squared(literal, state, kh, M) - whole) > 1e-4


def test_the_first_derivatives_that_agree() -> None:
    """Up to R = 2 three nodes reach a node: full and diffuse keep both sums there and so agree; further out they do not."""
    for R, agree in (("3/2", True), ("19/10", True), ("5/2", False)):
        full, diffuse = (lattice_values(1, R, K, derivative=d).Psi_x_h for d in ("full", "diffuse"))
        assert (full == diffuse == -Fraction(1, 2)) == agree
        assert (full == diffuse) == agree


def test_unknown_readings_list_the_known_ones() -> None:
    with pytest.raises(UnknownName, match="choose one of edge, literal"):
        lattice_values(1, "3/2", K, "middle")
    with pytest.raises(UnknownName, match="choose one of diffuse, frozen, frozen-b, full"):
        lattice_values(1, "3/2", K, "edge", "exact")
    assert HALF_POINTS == ("literal", "edge")


def test_what_a_lattice_does_not_have_is_refused() -> None:
    """R = 1 reaches no neighbour; the tent has no slope at a node; a constant basis has no diffuse derivative."""
    with pytest.raises(TooFewNodes):
        lattice_values(1, 1, K)
    with pytest.raises(NotDifferentiable):
        lattice_values(1, "3/2", K, kernel_name="tent")
    with pytest.raises(BadInput):
        lattice_values(1, "3/2", K, derivative="diffuse", order=0)
