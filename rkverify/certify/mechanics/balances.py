"""The reasons for drifts: rates of momentum, angular momentum and kinetic energy that the semi-discrete equations (41) themselves have.

Nothing is integrated in time. The rate of a nodal mass is m_I' = sum_L m_L Psi_I'(x_L) with the true rate of Psi_I; stress does work at the rate
sum_L a_L sigma : L. What is left over belongs to the equations, whatever the time step.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

from rkverify.certify.mechanics.long_motion import Block, reference_body
from rkverify.certify.mechanics.patch import MODULI
from rkverify.readings import CONVECTIONS, MASSES, Convection, Mass, NodalIntegration
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.accounts import cross
from rkverify.solid.mechanics.moving import Matter, Motion, forces
from rkverify.solid.neighbours import neighbours
from rkverify.solid.rates import true_rate
from rkverify.solid.shape import shape

Row = dict[str, Any]
STRESS = np.array([[0.2, 0.05, 0.0], [0.05, -0.1, 0.0], [0.0, 0.0, 0.05]])


@dataclass(frozen=True)
class _Mass:
    """Matrices (N, N): the mass in a reading, and its rate; and Psi_I(x_L) (L, N)."""

    now: sp.csr_array
    rate: sp.csr_array
    values: sp.csr_array


def _mass(matter: Matter, motion: Motion, reading: Mass) -> _Mass:
    cloud = matter.cloud.at(motion.x)
    near = neighbours(cloud, motion.x)
    Psi = shape(cloud, motion.x, neighbours=near).matrix()
    rate = Psi.copy()
    rate.data = true_rate(cloud, motion.x, motion.v, motion.v, near)
    m = sp.diags_array(matter.masses)
    if reading == "lumped":
        now, change = (sp.csr_array(sp.diags_array(part.T @ matter.masses)) for part in (Psi, rate))
        return _Mass(now, change, Psi)
    return _Mass(sp.csr_array(Psi.T @ m @ Psi), sp.csr_array(rate.T @ m @ Psi + Psi.T @ m @ rate), Psi)


def rates(b: Block, integration: NodalIntegration, convection: Convection, reading: Mass) -> Row:
    """Rates of momentum sum_I (M v)_I, of angular momentum sum_I x_I x (M v)_I and of v.M v/2 with the work of stress, in the first moment.

    Each over what has the same unit: mass times speed, angular momentum, kinetic energy, all per time of a side over a wave speed.
    angular_left: what is left of the second after sum_L m_L v_L x v^h(x_L), nodes that move otherwise than the matter at them.
    """
    made = reference_body(b)
    law = Truesdell(MODULI)
    matter = Matter(made.cloud, law, made.operator.measures, integration, convection, outline=(b.outline,))
    # A stress that varies over the block and vanishes nowhere, so that no balance holds by symmetry.
    state = law.start(len(b.positions), 2, STRESS * (1 + 0.5 * np.sin(4 * b.positions[:, 0]))[:, None, None])
    motion = Motion(b.positions, b.velocities + np.array([0.1, -0.05]), state, made.operator.measures)
    now = forces(matter, motion)
    mass = _mass(matter, motion, reading)
    force = -(now.internal + now.convective)
    v, x = motion.v, motion.x
    acceleration = spsolve(sp.csc_matrix(mass.now), force)
    p, change = mass.now @ v, mass.rate @ v + mass.now @ acceleration
    L = now.operator.apply(v)
    work = float((state.cauchy * L * now.operator.measures[:, None, None]).sum())
    kinetic = float((v * p).sum() / 2)
    power = float((v * (mass.now @ acceleration)).sum() + (v * (mass.rate @ v)).sum() / 2)
    total, speed = float(matter.masses.sum()), np.sqrt(2 * kinetic / matter.masses.sum())
    turning, turned = float(cross(x, p).sum()), float((cross(x, change) + cross(v, p)).sum())
    # Nodes move with their coefficients v_L where matter at x_L moves with the field v^h(x_L).
    carried = float((matter.masses[:, None] * cross(v, mass.values @ v)).sum())
    return {
        "integration": integration,
        "convection": convection,
        "mass": reading,
        "momentum": float(abs(change.sum(axis=0)).max() / (total * speed)),
        "angular": float(abs(turned) / abs(turning)),
        "angular_left": float(abs(turned - carried) / abs(turning)),
        "energy": float(abs(power + work) / kinetic),
        "galilean": _galilean(matter, motion),
    }


def _galilean(matter: Matter, motion: Motion) -> float:
    """The change of all forces with a velocity of 10 added to every node, over the largest force."""
    own, seen = (forces(matter, replace(motion, v=motion.v + shift)) for shift in (np.zeros(2), np.array([10.0, -5.0])))
    return float(abs(_force(own) - _force(seen)).max() / abs(_force(own)).max())


def _force(now: Any) -> Array:
    total: Array = now.internal + now.convective
    return total


def table_of_rates(b: Block, integrations: tuple[NodalIntegration, ...]) -> list[Row]:
    """`rates` for every integration, convective term and mass."""
    return [rates(b, i, c, m) for i in integrations for c in CONVECTIONS for m in MASSES]
