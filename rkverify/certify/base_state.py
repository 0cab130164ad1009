"""What N does to a motion by itself: sums of its rates, the force that it puts on a base, what (73) neglects.

All of it in exact rationals, on the uniform lattice or on uneven nodes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import cast

from rkverify.arithmetic.dual import Dual, Duals
from rkverify.arithmetic.native import Exact
from rkverify.certify.derivation import defined_stencil
from rkverify.paper.approximation import approximation, lattice, middle
from rkverify.paper.material_rates import psi_star, true_rate
from rkverify.paper.perturbed_equation import perturbed_force
from rkverify.paper.semi_lagrangian_equations import ChainState, SemiLagrangianChain
from rkverify.readings import Convection, Integration, Readings, StressLaw
from rkverify.stability.jacobian_paper import Stencil, linearise, patch
from rkverify.stability.lattice_state import Base

K = Exact()
ZERO = Fraction(0)


def rate_sums(R: Fraction, kernel: str = "cubic") -> tuple[Fraction, Fraction]:
    """sum_J Psi*_J / Q and sum_J dPsi_J/dt / Q at a node of the lattice with the base v = Q x."""
    A = lattice(1, R, 2, K, kernel)
    x = A.nodes[middle(A)]
    velocities = [(node[0],) for node in A.nodes]
    star, true = (sum(rate(A, x, x, velocities).values(), ZERO) for rate in (psi_star, true_rate))
    return star, true


@dataclass(frozen=True)
class Convected:
    """N's work on the lattice with v = V + Q x: v' of the base over Q V, and v' of a common extra velocity over Q times it."""

    base_acceleration: Fraction
    common_velocity: Fraction


def convected(R: Fraction, convection: Convection) -> Convected:
    """The two for SCNI, where without N both are zero: a uniform stress leaves no force, and nothing else acts."""
    found = linearise(Base(R, Readings("scni", convection), 0, 1, frame_velocity=1), K)
    still = linearise(Base(R, Readings("scni", convection), 0, 1), K)
    return Convected(found.base_rates["v"], sum(still.stencil["v", "v"].values(), ZERO))


def largest(stencil: Stencil, row: str = "v") -> Fraction:
    """The largest coefficient in a row of a stencil."""
    return max((abs(c) for (rate, _), part in stencil.items() for c in part.values() if rate == row), default=ZERO)


def neglected_mass(R: Fraction, s: Fraction, Q: Fraction, V: Fraction, convection: Convection) -> Fraction:
    """The largest coefficient of m~_I v_I' / m_I, which (73) leaves out, over the largest of the whole equation.

    The difference of the linearised (65) and of (73), coefficient by coefficient.
    """
    base = Base(R, Readings("scni", convection), s, Q, frame_velocity=V)
    whole = linearise(base, K).stencil
    cells, reach = base.reach(K)
    shifts = list(range(-reach, reach + 1))
    D = Duals(K, len(base.kinds) * len(shifts))
    state, chain = patch(base, D, shifts)
    around = [reach + n for n in range(-cells, cells + 1)]
    N = cast(dict[int, Dual], chain.convective_matrix(reach, state, around))
    force = cast(Dual, chain.internal_force(reach, state, around))
    left = perturbed_force(N, cast(Sequence[Dual], state.velocities), force)
    gap = ZERO
    for place, kind in enumerate(base.kinds):
        for n in shifts:
            there = -left.slopes.get(place * len(shifts) + n + reach, ZERO)
            gap = max(gap, abs(there - whole["v", kind].get(n, ZERO)))
    return gap / largest(whole)


def uneven_nodes() -> list[Fraction]:
    """Nodes at uneven rational distances, none under fewer than three kernels of support 7/4."""
    places, steps = [ZERO], (10, 9, 11, 8, 12, 10, 9, 11, 10, 12, 9, 10)
    for step in steps:
        places.append(places[-1] + Fraction(step, 10))
    return places


def _chain(readings: Readings, velocities: Sequence[Fraction]) -> tuple[SemiLagrangianChain, ChainState]:
    x = uneven_nodes()
    A = approximation([[p] for p in x], Fraction(7, 4), K)
    ones = [Fraction(1) for _ in x]
    state = ChainState(x, velocities, ones, ones, ones)
    return SemiLagrangianChain(A, Fraction(1), ones, readings), state


def uniform_stress_force(integration: Integration) -> Fraction:
    """The largest internal force on inner uneven nodes under a uniform unit stress, (67) with (72) or (80)."""
    chain, state = _chain(Readings(integration, "none"), [ZERO for _ in uneven_nodes()])
    inner = range(4, len(state.positions) - 4)
    return max(abs(chain.internal_force(I, state, range(I - 3, I + 4))) for I in inner)


MOTIONS: dict[str, Callable[[Fraction], Fraction]] = {
    "rigid translation": lambda x: Fraction(1),
    "stretching v = x": lambda x: x,
    "stretching v = x - 5": lambda x: x - 5,
    "bending v = x^2": lambda x: x * x,
}


def convective_forces(motion: str, convection: Convection) -> Fraction:
    """The largest component of N v on inner uneven nodes in a motion; masses one."""
    x = uneven_nodes()
    chain, state = _chain(Readings("scni", convection), [MOTIONS[motion](p) for p in x])
    inner = range(4, len(x) - 4)
    return max(abs(chain.convective_force(I, state, range(I - 3, I + 4))) for I in inner)


def long_wave_modulus(R: Fraction, s: Fraction, law: StressLaw, integration: Integration) -> Fraction:
    """lim omega^2 rho / k^2 over C^sigma for long waves at rest: minus half the second moment of the stencil."""
    stencil = defined_stencil(Readings(integration, "none", stress_law=law), R, s, ZERO).displacement
    return -sum((c * n * n for n, c in stencil.items()), ZERO) / 2
