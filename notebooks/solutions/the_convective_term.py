"""Solutions to the exercises of `the_convective_term`."""

from fractions import Fraction

from rkverify.arithmetic.native import Exact
from rkverify.certify import base_state
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.material_rates import psi_star
from rkverify.paper.shape import Values


def exercise_1() -> dict[str, tuple[Fraction, Fraction]]:
    """The two sums for other kernels: none mends that of (40), which leaves out the rate of C whatever the kernel."""
    return {name: base_state.rate_sums(Fraction(7, 4), name) for name in ("cubic", "quartic", "quintic")}


def star(extra: int, order: int = 1) -> Values:
    """Psi* at a node of the stretching lattice with R = 7/4, and an extra velocity of everything."""
    A = lattice(1, Fraction(7, 4), 2, Exact(), "cubic", order)
    x = A.nodes[middle(A)]
    velocities = [(node[0] + extra,) for node in A.nodes]
    return psi_star(A, x, (x[0] + extra,), velocities)


def exercise_2() -> tuple[Values, Values]:
    """Psi* without and with the velocity: the same, since (35) sees differences of velocities alone."""
    return star(0), star(5)


def exercise_3() -> Fraction:
    """The sum with order 0: C = 1/M, so that it is the rate of M over M, and not zero."""
    return sum(star(0, order=0).values(), Fraction(0))
