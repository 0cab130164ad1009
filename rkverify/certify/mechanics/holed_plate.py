"""A plastic plate with a hole, pulled at its ends: its force, its plastic strain, and Newton's residuals with two tangents."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rkverify.certify.mechanics.cyclic import EDGE, LAW, SUPPORT_RATIO, Plate, Row
from rkverify.certify.mechanics.patch import MODULI
from rkverify.solid.cell_rings import all_rings
from rkverify.solid.cloud import cloud
from rkverify.solid.domain import polygon_domain
from rkverify.solid.gradients import scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.j2 import J2
from rkverify.solid.materials.law import Law, State
from rkverify.solid.mechanics.body import body
from rkverify.solid.mechanics.boundary import boundary
from rkverify.solid.mechanics.statics import Equilibrium, equilibrium, residual, solve, tangent
from rkverify.solid.mechanics.vectors import flat, nodal
from rkverify.solid.voronoi import voronoi


@dataclass(frozen=True)
class ElasticTangent:
    """The control: the law with dP/dF of its elastic part, which is not the derivative of the return to the yield surface."""

    law: J2

    def start(self, count: int, dimension: int) -> State:
        """As the law's."""
        return self.law.start(count, dimension)

    def advance(self, F: Any, state: State) -> State:
        """As the law's."""
        return self.law.advance(F, state)

    def tangent(self, F: Any, state: State) -> Array:
        """dP/dF of the elastic prediction."""
        return self.law.elastic.tangent(F, state)


def plate_with_hole(divisions: int, law: Law, radius: float = 0.4) -> Plate:
    """[-1, 1]^2 with a polygonal hole in the middle, nodes on a lattice and on the boundary; held at top and bottom."""
    h = 2 / divisions
    axis = np.linspace(-1, 1, divisions + 1)
    lattice = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    count = 4 * round(np.pi * radius / (2 * h))
    angle = 2 * np.pi * np.arange(count) / count
    ring = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    X = np.concatenate([lattice[np.linalg.norm(lattice, axis=1) > radius + 0.5 * h], ring])
    cells = voronoi(X, polygon_domain([[(-1, -1), (1, -1), (1, 1), (-1, 1)], ring]))
    near = cloud(X, SUPPORT_RATIO * h)
    held = boundary(near, cells, where=lambda x: abs(abs(x[:, 1]) - 1) < EDGE)
    return Plate(body(near, scni(near, cells), law), cells, held)


def pulled(plate: Plate, elongations: Sequence[float]) -> list[tuple[float, Equilibrium]]:
    """Top and bottom moved apart by each elongation in turn; the force on the top with each equilibrium, over mu times the width."""
    found, all_found = plate.start, []
    for value in elongations:
        problem = plate.led(found, _ends_apart(plate, value))
        found = equilibrium(found.body, problem, found.displacements)
        all_found.append((_on_top(plate, found), found))
    return all_found


def _ends_apart(plate: Plate, elongation: float) -> Array:
    """Displacements (Q, 2) of top and bottom."""
    along = elongation * np.sign(plate.held.points[:, 1]) / 2
    return np.stack([np.zeros_like(along), along], axis=1)


def _on_top(plate: Plate, found: Equilibrium) -> float:
    """sum_q w_q P_22 N_2 over the top, the traction of its cells."""
    edge, P = plate.held, found.body.state.P
    top = edge.points[:, 1] > 0
    force = (edge.weights[top] * P[edge.cells[top], 1, 1]).sum()
    return float(force / (MODULI.shear * edge.weights[top].sum()))


def cell_corners(plate: Plate, found: Equilibrium) -> list[Row]:
    """The corners of every cell in order, with the plastic strain of its node."""
    alpha = found.body.state.alpha
    return [
        {"cell": L, "x": float(x), "y": float(y), "plastic_strain": float(alpha[L])}
        for L, rings in enumerate(all_rings(plate.cells))
        for x, y in rings[0]
    ]


def tangents_compared(plate: Plate, found: Equilibrium, elongation: float, count: int) -> list[Row]:
    """Newton's residuals from an equilibrium of `pulled` to a further elongation, with the consistent and with the elastic tangent."""
    given = _ends_apart(plate, elongation)
    rows = []
    for name, law in (("consistent", LAW), ("elastic", ElasticTangent(LAW))):
        start = replace(found, body=replace(found.body, law=law))
        history = newton(replace(plate, body=start.body), given, start, count)
        rows += [{"tangent": name, "step": step, "residual": value} for step, value in enumerate(history)]
    return rows


def newton(plate: Plate, given: Array, from_state: Equilibrium, count: int) -> list[float]:
    """The largest residual force over its first value in each of at most `count` steps, none after rounding is reached."""
    d, problem = from_state.displacements, plate.led(from_state, given)
    found: list[float] = []
    for _ in range(count):
        force, size = residual(from_state.body, problem, d)
        found.append(float(abs(force).max()))
        if found[-1] <= 1e-15 * float(size.max()):
            break
        d = d - nodal(solve(tangent(from_state.body, problem, d), flat(force)), 2)
    return [value / found[0] for value in found]
