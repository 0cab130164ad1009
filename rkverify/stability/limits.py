"""Long waves and kh = pi on the uniform lattice: what is left of a relation at both ends of the axis of kh.

Near kh = 0 every relation is omega^2/(kh)^2 -> material (C + sigma) + geometric sigma; the continuum has 1 and 0. At
kh = pi it is omega^2 = material (C + sigma) + geometric sigma again. Spacing, density and modulus are 1. Both ends come
from the stencil itself: its second moment and its alternating sum; no small kh is put in.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import rational
from rkverify.errors import BadInput
from rkverify.paper.approximation import approximation
from rkverify.paper.cells import Cell
from rkverify.paper.gradients import direct_gradient, smoothed_gradient
from rkverify.paper.notation import lattice_values
from rkverify.paper.printed_lagrangian import b_hat
from rkverify.paper.semi_lagrangian_equations import ChainState, SemiLagrangianChain
from rkverify.readings import Derivative, HalfPoint, Integration
from rkverify.stability.lagrangian import StretchedBar, stencil
from rkverify.stability.lattice_state import Base

Pattern = Callable[[int], Any]
"""J -> displacement of node J, an integer or an exact rational."""


@dataclass(frozen=True)
class Ends:
    """Factors of C + sigma and of sigma in lim omega^2/(kh)^2 (1/time^2) and in omega^2 at kh = pi (1/time^2)."""

    material: Scalar
    geometric: Scalar
    material_at_pi: Scalar
    geometric_at_pi: Scalar


@dataclass(frozen=True)
class NodalForces:
    """B_I(x_K) a_K at the node K = 0 of the lattice for I = n, and its change under each of some patterns."""

    values: dict[int, Scalar]
    changes: dict[int, tuple[Scalar, ...]]


def nodal_forces(
    support_ratio: Scalar,
    K: Arithmetic,
    patterns: Sequence[Pattern],
    integration: Integration = "dni",
    derivative: Derivative = "full",
    kernel: str = "cubic",
) -> NodalForces:
    """B_I(x_0) a_0 where node J is at J + sum_p e_p u_p(J), to first order in the e_p; cells end half-way between nodes."""
    reach = int(K.witness(K.number(support_ratio))) + 2
    D = Duals(K, len(patterns))
    places = [D.along(K.number(J), [K.number(u(J)) for u in patterns]) for J in range(-reach, reach + 1)]
    A = approximation([[x] for x in places], K.number(support_ratio), D, kernel, 1)
    cell = Cell((places[reach - 1] + places[reach]) / 2, (places[reach] + places[reach + 1]) / 2)
    if integration == "scni":
        b = smoothed_gradient(A, cell)
    else:
        b = direct_gradient(A, A.nodes[reach], derivative)
    forces = {I - reach: value * cell.measure for I, value in b.items()}
    return NodalForces(
        {n: force.value for n, force in forces.items()}, {n: force.partials for n, force in forces.items()}
    )


def geometric_stencil(forces: NodalForces, reach: int, K: Arithmetic) -> dict[int, Scalar]:
    """Coefficients of u_{I+n} in u_I'' for sigma = 1 held uniform, from the changes under unit displacements of -reach…reach.

    u_0'' = -sum_K (change of B_0(x_K) a_K), and what node 0 is to cell K, node -K is to cell 0.
    """
    total: dict[int, Scalar] = {}
    for I, change in forces.changes.items():
        for m, value in zip(range(-reach, reach + 1), change, strict=True):
            total[m - I] = total.get(m - I, K.zero()) - value
    return {n: c for n, c in sorted(total.items()) if not K.is_zero(c)}


def unit(m: int) -> Pattern:
    """The displacement 1 of node m alone."""
    return lambda J: int(m == J)


def alternating(J: int) -> int:
    """The wave kh = pi: (-1)^J."""
    return 1 - 2 * (J % 2)


def method_ends(
    support_ratio: Scalar,
    K: Arithmetic,
    integration: Integration,
    derivative: Derivative = "full",
    kernel: str = "cubic",
) -> Ends:
    """Both ends of the linearised semi-Lagrangian equations at rest, as defined: Truesdell rate, cells between nodes.

    Under u = J^2/2 the acceleration of node 0 is half the second moment of its stencil. Seen from cell K that
    displacement is a constant, K times a stretch, and the same parabola: `nodal_forces` of one cell are enough.
    """
    forces = nodal_forces(
        support_ratio, K, (lambda J: J, lambda J: rational(J * J) / 2, alternating), integration, derivative, kernel
    )
    stretch, parabola, pi = ({n: c[p] for n, c in forces.changes.items()} for p in range(3))
    return Ends(
        material=_sum(K, (n * b for n, b in forces.values.items())) ** 2,
        geometric=_sum(K, (n * stretch[n] - parabola[n] for n in stretch)),
        material_at_pi=_sum(K, (alternating(n) * b for n, b in forces.values.items())) ** 2,
        geometric_at_pi=_sum(K, (alternating(n) * value for n, value in pi.items())),
    )


def _sum(K: Arithmetic, terms: Any) -> Scalar:
    total = K.zero()
    for term in terms:
        total = total + term
    return total


def lagrangian_ends(
    support_ratio: Scalar,
    K: Arithmetic,
    integration: Integration,
    derivative: Derivative = "full",
    kernel: str = "cubic",
) -> Ends:
    """Both ends of the linearised Lagrangian bar, whose modulus C^SE F^2 + S stands for C + sigma."""
    c = stencil(StretchedBar(support_ratio, integration, derivative=derivative, kernel=kernel), K)
    zero = K.zero()
    pi = -_sum(K, (alternating(n) * value for n, value in c.items()))
    return Ends(_sum(K, (n * n * value for n, value in c.items())) / 2, zero, pi, zero)


def printed_lagrangian_ends(support_ratio: Scalar, K: Arithmetic, kernel: str = "cubic") -> Ends:
    """Both ends of (63): omega^2 = c^2 |sum_K b^_K e^{i K kh}|^2."""
    b = b_hat(1, support_ratio, K, kernel)
    m = len(b) // 2
    slope = _sum(K, ((j - m) * value for j, value in enumerate(b)))
    pi = _sum(K, (alternating(j - m) * value for j, value in enumerate(b)))
    return Ends(slope**2, K.zero(), pi**2, K.zero())


def printed_scni_ends(support_ratio: Scalar, K: Arithmetic, half_point: HalfPoint, kernel: str = "cubic") -> Ends:
    """Both ends of (86): 4 [C(h/2) phi(h/2)]^2 (C + sigma), and 0 at kh = pi."""
    v = lattice_values(1, support_ratio, K, half_point, kernel_name=kernel)
    return Ends(4 * (v.C_half * v.phi_half) ** 2, K.zero(), K.zero(), K.zero())


def printed_dni_ends(support_ratio: Scalar, K: Arithmetic, derivative: Derivative, kernel: str = "cubic") -> Ends:
    """Both ends of (87): 4 Psi,x(h)^2 (C + sigma) - Psi,xx(h) sigma, and -4 Psi,xx(h) sigma at kh = pi."""
    v = lattice_values(1, support_ratio, K, derivative=derivative, kernel_name=kernel)
    return Ends(4 * v.Psi_x_h**2, -v.Psi_xx_h, K.zero(), -4 * v.Psi_xx_h)


def response(base: Base, displacement: Pattern, K: Arithmetic) -> Scalar:
    """v' of node 0 to first order where node J of a base at rest is displaced by u(J); every force summed cell by cell.

    Stresses, edges and measures are displaced as their rates follow velocities u(J). Takes every reading; with
    u = J^2/2 it is lim omega^2/(kh)^2, with u = (-1)^J it is -omega^2(pi). Raises BadInput for a base that moves.
    """
    if not base.is_at_rest(K) or base.readings.mass != "lumped":
        raise BadInput("the response is that of a base at rest with the lumped mass: leave velocities and the mass out")
    cells, reach = base.reach(K)
    D = Duals(K, 1)
    h, S = K.number(base.spacing), K.number(base.stress_ratio)
    shifts = range(-reach, reach + 1)
    places, u = [n * h for n in shifts], [K.number(displacement(n)) for n in shifts]
    still = ChainState(*([D.number(value) for value in part] for part in (
        places, u, [S for _ in shifts], [x + h / 2 for x in places], [h for _ in shifts]
    )))  # fmt: skip
    A = approximation([[x] for x in still.positions], K.number(base.support_ratio) * h, D, base.kernel, base.order)
    masses = [D.number(K.number(base.density) * h) for _ in shifts]
    origin = [D.number((1 - S) * x) for x in places]
    chain = SemiLagrangianChain(A, D.number(1), masses, base.readings, origin, D.number(base.support_ratio))

    def moved(kind: str, values: Sequence[Any], rate: Callable[[int, ChainState], Any]) -> list[Any]:
        if kind not in base.kinds:
            return list(values)
        known = range(reach - cells - 1, reach + cells + 1)
        return [D.along(value.value, [rate(j, still).value]) if j in known else value for j, value in enumerate(values)]

    displaced = ChainState(
        [D.along(x, [w]) for x, w in zip(places, u, strict=True)],
        [D.zero() for _ in shifts],
        moved("stress", still.stresses, chain.stress_rate),
        moved("edge", still.edges, chain.edge_rate),
        moved("measure", still.measures, chain.measure_rate),
    )
    around = range(reach - cells, reach + cells + 1)
    return chain.acceleration(reach, displaced, list(around)).partials[0]
