"""The linearised equations of one node through `paper/`, by duals: in double precision, at many digits, as enclosures."""

from dataclasses import dataclass, replace

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Dual, Duals
from rkverify.paper.approximation import approximation
from rkverify.paper.semi_lagrangian_equations import ChainState, SemiLagrangianChain
from rkverify.stability.lattice_state import Base

Stencil = dict[tuple[str, str], dict[int, Scalar]]
"""(rate, variable) -> shift n -> derivative of the rate at node I with respect to the variable at node I + n.

With the consistent mass the row of v holds forces over the lumped mass, and ("mass", "v") what multiplies v'."""


@dataclass(frozen=True)
class Linearised:
    """The rates of the base state at the node where the equation is written, and their derivatives."""

    base_rates: dict[str, Scalar]
    stencil: Stencil


def linearise(base: Base, K: Arithmetic) -> Linearised:
    """Exact derivatives of every rate at node 0 with respect to the state of its neighbours."""
    cells, reach = base.reach(K)
    shifts = list(range(-reach, reach + 1))
    D = Duals(K, len(base.kinds) * len(shifts))
    state, chain = patch(base, D, shifts)
    middle = reach
    around = [middle + n for n in range(-cells, cells + 1)]
    rates = {"x": chain.material_velocity(middle, state), "v": chain.acceleration(middle, state, around)}
    mass: dict[int, Scalar] = {}
    if base.readings.mass == "consistent":
        beyond = _accelerations(base, K, shifts, rates["v"].value)
        residual = chain.residual(middle, state, around, [D.number(a) for a in beyond])
        lumped = K.number(base.density) * K.number(base.spacing)
        # The base is affine and M reproduces what is linear: v' of the base is the same with either mass.
        rates["v"] = rates["v"].value - residual / lumped
        inertia = chain.consistent_mass(middle, state, around)
        mass = {J - middle: M.value / lumped for J, M in inertia.items() if not K.is_zero(M.value)}
    if "stress" in base.kinds:
        rates["stress"] = chain.stress_rate(middle, state)
    if "edge" in base.kinds:
        rates["edge"] = chain.edge_rate(middle, state)
    if "measure" in base.kinds:
        rates["measure"] = chain.measure_rate(middle, state)
    stencil = {
        (row, column): {
            n: rates[row].partials[place * len(shifts) + n + reach]
            for n in shifts
            if not K.is_zero(rates[row].partials[place * len(shifts) + n + reach])
        }
        for row in rates
        for place, column in enumerate(base.kinds)
    }
    if mass:
        stencil["mass", "v"] = mass
    return Linearised({kind: rate.value for kind, rate in rates.items()}, stencil)


def _accelerations(base: Base, K: Arithmetic, shifts: list[int], own: Scalar) -> list[Scalar]:
    """v_J' of the base around a node with v' = own: affine, from the base as the next node sees it."""
    if base.is_at_rest(K) or base.readings.convection != "psi-star":
        return [K.zero() for _ in shifts]
    h, Q, V = K.number(base.spacing), K.number(base.velocity_gradient), K.number(base.frame_velocity)
    beside = replace(base, frame_velocity=V + Q * h, readings=replace(base.readings, mass="lumped"))
    following = linearise(beside, K).base_rates["v"]
    return [own + (following - own) * n for n in shifts]


def patch(base: Base, D: Duals, shifts: list[int]) -> tuple[ChainState, SemiLagrangianChain]:
    """The base state on nodes at shifts times h, every part of `base.kinds` a variable of D, and the chain on it."""
    K = D.base
    h, S = K.number(base.spacing), K.number(base.stress_ratio)
    Q, V = K.number(base.velocity_gradient), K.number(base.frame_velocity)

    def part(kind: str, values: list[Scalar]) -> list[Dual]:
        if kind not in base.kinds:
            return [D.number(value) for value in values]
        offset = base.kinds.index(kind) * len(shifts)
        return [D.variable(value, offset + j) for j, value in enumerate(values)]

    places = [K.number(n) * h for n in shifts]
    state = ChainState(
        positions=part("x", places),
        velocities=part("v", [V + Q * x for x in places]),
        stresses=part("stress", [S for _ in shifts]),
        edges=part("edge", [x + h / 2 for x in places]),
        measures=part("measure", [h for _ in shifts]),
    )
    A = approximation([[x] for x in state.positions], K.number(base.support_ratio) * h, D, base.kernel, base.order)
    # (69) has the stress sigma = C^sigma (1 - X'), so that the base's origin is X = (1 - sigma/C^sigma) x.
    origin = [D.number((1 - S) * x) for x in places]
    masses = [D.number(K.number(base.density) * h) for _ in shifts]
    chain = SemiLagrangianChain(A, D.number(1), masses, base.readings, origin, D.number(base.support_ratio))
    return state, chain
