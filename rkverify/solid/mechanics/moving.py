"""A body in its current configuration: the semi-Lagrangian equations (41)-(47), explicit in time.

Nodes move with their own coefficients, x_I' = v_I. The mass m_L of a cell never changes; the lumped mass m_I = sum_L m_L Psi_I(x_L)
of a node does.
"""

from dataclasses import dataclass, replace

import numpy as np

from rkverify.errors import BadInput, UnknownName
from rkverify.readings import CONVECTIONS, NODAL_INTEGRATIONS, Convection, Derivative, NodalIntegration
from rkverify.solid.cloud import Cloud
from rkverify.solid.domain import polygon_domain
from rkverify.solid.gradients import GradientOperator, dni, scni, snni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import determinant
from rkverify.solid.materials.law import Law, State
from rkverify.solid.mechanics.accounts import Account, account
from rkverify.solid.neighbours import neighbours
from rkverify.solid.rates import psi_star, true_rate
from rkverify.solid.shape import shape
from rkverify.solid.voronoi import voronoi


@dataclass(frozen=True)
class Matter:
    """What does not change: kernel, order and supports (the cloud), law, masses m_L (L,) of the cells, and how it is integrated.

    outline: nodes in order around the domain, then around each hole; with it cells are Voronoi cells of the moved domain (SCNI needs it),
    without it measures grow as a_L' = a_L tr L_L. convection: N with Psi* (40), with the true material rate, or none.
    """

    cloud: Cloud
    law: Law
    masses: Array
    integration: NodalIntegration
    convection: Convection = "psi-star"
    derivative: Derivative = "full"
    rule: str = "trapezoid"
    outline: tuple[Array, ...] | None = None

    def __post_init__(self) -> None:
        """Raises UnknownName for an option that does not exist, BadInput for SCNI without an outline."""
        for kind, value, known in (
            ("integration", self.integration, NODAL_INTEGRATIONS),
            ("convection", self.convection, CONVECTIONS),
        ):
            if value not in known:
                raise UnknownName(kind, value, known)
        if self.integration == "scni" and self.outline is None:
            raise BadInput("SCNI in a moving body needs its outline: name the nodes around it, or choose dni or snni")


@dataclass(frozen=True)
class Motion:
    """Positions x (N, d), velocities v (N, d), state of the law, measures a_L (L,), work done on the material, time.

    On the way the velocities are those half a step before.
    """

    x: Array
    v: Array
    state: State
    measures: Array
    worked: float = 0.0
    time: float = 0.0


@dataclass(frozen=True)
class Now:
    """The gradient operator, Psi_I(x_L) m_L as row sums, f_int (N, d) of (45), N v (N, d) of (43), lumped mass (N,) of (42)."""

    operator: GradientOperator
    internal: Array
    convective: Array
    mass: Array

    def acceleration(self) -> Array:
        """(f_ext - f_int - N v)/m without external force (N, d)   (41)."""
        return -(self.internal + self.convective) / self.mass[:, None]


def operator_now(matter: Matter, motion: Motion) -> GradientOperator:
    """b_iI^L (47) in the current configuration."""
    cloud = matter.cloud.at(motion.x)
    if matter.outline is None:
        measures = motion.measures
    else:
        cells = voronoi(motion.x, polygon_domain([motion.x[ring] for ring in matter.outline]))
        if matter.integration == "scni":
            return scni(cloud, cells, matter.rule)
        measures = cells.measures
    if matter.integration == "dni":
        return dni(cloud, measures, matter.derivative)
    return snni(cloud, measures)


def forces(matter: Matter, motion: Motion, operator: GradientOperator | None = None) -> Now:
    """Everything that stands in (41) at one time; operator: that of `operator_now`, where it is known already."""
    cloud = matter.cloud.at(motion.x)
    operator = operator_now(matter, motion) if operator is None else operator
    stress = motion.state.cauchy * operator.measures[:, None, None]
    internal = sum((part.T @ stress[:, :, j] for j, part in enumerate(operator.parts)), 0.0 * motion.x)
    near = neighbours(cloud, motion.x)
    Psi = shape(cloud, motion.x, neighbours=near).matrix()
    mass = Psi.T @ matter.masses
    convective = np.zeros_like(motion.x)
    if matter.convection != "none":
        rate = psi_star if matter.convection == "psi-star" else true_rate
        rates = Psi.copy()
        rates.data = rate(cloud, motion.x, motion.v, motion.v, near)
        convective = Psi.T @ (matter.masses[:, None] * (rates @ motion.v))
    return Now(operator, internal, convective, mass)


def step(matter: Matter, motion: Motion, dt: float, first: bool = False) -> tuple[Motion, Account]:
    """The motion after one step of central differences, and the account at the step's beginning.

    N v takes the velocities half a step before. first: the velocities are those at the step's beginning.
    """
    return advanced(matter, motion, forces(matter, motion), dt, first)


def advanced(matter: Matter, motion: Motion, now: Now, dt: float, first: bool = False) -> tuple[Motion, Account]:
    """`step`, from forces that are known."""
    push = dt * now.acceleration()
    at_start, after = (motion.v, motion.v + push / 2) if first else (motion.v + push / 2, motion.v + push)
    entry = account(motion.time, now.mass, motion.x, at_start, motion.worked)
    H = np.eye(motion.x.shape[1]) + now.operator.apply(dt * after)
    state = matter.law.advance(H @ motion.state.F, motion.state)
    # G is seen from the middle of the step, with no strain where H is a rotation.
    one, stress = np.eye(H.shape[-1]), (motion.state.cauchy + state.cauchy) / 2
    G = 2 * (H - one) @ np.linalg.inv(H + one)
    moved = replace(
        motion,
        x=motion.x + dt * after,
        v=after,
        state=state,
        measures=motion.measures * determinant(H),
        worked=motion.worked + float((stress * G * now.operator.measures[:, None, None]).sum()),
        time=motion.time + dt,
    )
    return moved, entry
