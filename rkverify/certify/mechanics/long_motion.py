"""A free block that turns and vibrates: what is kept over thousands of steps, in the reference configuration and in the current one."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rkverify.certify.mechanics.patch import MODULI
from rkverify.certify.mechanics.specimens import Specimen, square
from rkverify.errors import RkverifyError
from rkverify.readings import Convection, NodalIntegration
from rkverify.solid.domain import polygon_domain
from rkverify.solid.gradients import scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.accounts import Account
from rkverify.solid.mechanics.body import Body, body
from rkverify.solid.mechanics.moving import Matter, Motion, forces, step
from rkverify.solid.mechanics.vibration import Swing, central_differences, critical_step
from rkverify.solid.voronoi import voronoi

Row = dict[str, Any]
SUPPORT_RATIO = 2.3
SPIN, SWING = 0.4, 0.01
"""Angular velocity and amplitude of the velocities that vibrate, in units of the wave speed and the block's side."""


@dataclass(frozen=True)
class Block:
    """The specimen with its middle at the origin, the nodes in order around it, and the initial velocities."""

    specimen: Specimen
    positions: Array
    outline: Array
    velocities: Array

    @property
    def corners(self) -> Array:
        """The ring of the domain through the boundary nodes."""
        return self.positions[self.outline]


def block(divisions: int, seed: int) -> Block:
    """Jittered nodes in a unit square that turns and vibrates."""
    specimen = square("jittered", divisions, seed)
    x = specimen.positions - 0.5
    held = specimen.on_boundary
    angle = np.arctan2(x[held, 1], x[held, 0])
    spin = SPIN * np.stack([-x[:, 1], x[:, 0]], axis=1)
    return Block(specimen, x, held[np.argsort(angle)], spin + SWING * np.sin(3 * x[:, ::-1] + [0.3, 0.7]))


def reference_body(b: Block) -> Body:
    """The block as a neo-Hookean body with SCNI."""
    near = b.specimen.cloud(SUPPORT_RATIO).at(b.positions)
    cells = voronoi(b.positions, polygon_domain([b.corners]))
    return body(near, scni(near, cells), NeoHookean(MODULI))


def lagrangian(b: Block, share: float, steps: int) -> list[Account]:
    """Accounts of the neo-Hookean block over steps of a share of the critical one."""
    made = reference_body(b)
    start = Swing(np.zeros_like(b.positions), b.velocities, made)
    return [a for _, a in central_differences(start, share * critical_step(made), steps)]


def semi_lagrangian(
    b: Block, integration: NodalIntegration, convection: Convection, share: float, steps: int
) -> list[Account]:
    """Accounts of the block with the Truesdell law; fewer where the motion broke down on the way.

    SCNI rebuilds its cells in every step; DNI and SNNI let their measures grow with the volume.
    """
    made = reference_body(b)
    law = Truesdell(MODULI)
    outline = (b.outline,) if integration == "scni" else None
    matter = Matter(made.cloud, law, made.operator.measures, integration, convection, outline=outline)
    motion = Motion(b.positions, b.velocities, law.start(len(b.positions), 2), made.operator.measures)
    dt = share * critical_step(made)
    accounts: list[Account] = []
    try:
        for n in range(steps):
            motion, entry = step(matter, motion, dt, n == 0)
            accounts.append(entry)
    except RkverifyError:
        pass
    return accounts


def drifts(accounts: Sequence[Account]) -> Row:
    """The largest changes since the start, over what the start has: energy, momentum (over mass times speed), angular momentum, mass."""
    first = accounts[0]
    speed = np.sqrt(2 * first.kinetic / first.mass)

    def largest(values: Iterable[Any]) -> float:
        return float(np.max(np.abs(np.array(list(values)))))

    return {
        "steps": len(accounts),
        "time": accounts[-1].time,
        "energy": largest(a.energy / first.energy - 1 for a in accounts),
        "momentum": largest((a.momentum - first.momentum) / (first.mass * speed) for a in accounts),
        "angular": largest((a.angular - first.angular) / first.angular for a in accounts),
        "mass": largest(a.mass / first.mass - 1 for a in accounts),
    }


def course(accounts: Sequence[Account], count: int) -> list[Row]:
    """Energy, momentum and angular momentum at `count` times on the way, as changes over what the start has."""
    first = accounts[0]
    speed = np.sqrt(2 * first.kinetic / first.mass)
    chosen = np.unique(np.linspace(0, len(accounts) - 1, count).astype(int))
    return [
        {
            "time": accounts[n].time,
            "energy": accounts[n].energy / first.energy - 1,
            "momentum": float(np.linalg.norm(accounts[n].momentum - first.momentum)) / (first.mass * speed),
            "angular": float(accounts[n].angular[0] / first.angular[0]) - 1,
        }
        for n in chosen
    ]


def galilean(b: Block, integration: NodalIntegration, convection: Convection, speed: float) -> float:
    """How much a velocity added to all nodes changes the accelerations, over their largest without it."""
    made = reference_body(b)
    law = Truesdell(MODULI)
    stress = np.diag([0.2, -0.1, 0.05])
    matter = Matter(made.cloud, law, made.operator.measures, integration, convection, outline=(b.outline,))
    rest = Motion(b.positions, b.velocities, law.start(len(b.positions), 2, stress), made.operator.measures)
    own, seen = (
        forces(matter, replace(rest, v=rest.v + shift)).acceleration()
        for shift in (np.zeros(2), np.array([speed, -speed / 2]))
    )
    return float(abs(seen - own).max() / abs(own).max())


def turned(b: Block, angle: float) -> float:
    """The largest stress, over the shear modulus, after the block was turned rigidly in ten steps by an angle each: objectivity."""
    made = reference_body(b)
    law = Truesdell(MODULI)
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    state, x = law.start(len(b.positions), 2), b.positions
    for _ in range(10):
        cells = voronoi(x, polygon_domain([x[b.outline]]))
        H = np.eye(2) + scni(made.cloud.at(x), cells).apply(x @ turn.T - x)
        state, x = law.advance(H @ state.F, state), x @ turn.T
    return float(abs(state.sigma).max() / MODULI.shear)
