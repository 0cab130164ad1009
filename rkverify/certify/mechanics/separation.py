"""A plate in two halves that part or meet, in the reference configuration and in the current one: what acts across the gap.

Lengths are in units of the spacing h, stresses in units of mu; the halves keep their shape, and the right one is moved by a gap along x_1.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rkverify.certify.mechanics.patch import MODULI
from rkverify.errors import RkverifyError
from rkverify.readings import NodalIntegration
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import box
from rkverify.solid.gradients import dni, scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import determinant
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.body import body
from rkverify.solid.mechanics.moving import Matter, Motion, operator_now
from rkverify.solid.neighbours import neighbours
from rkverify.solid.shape import condition_numbers
from rkverify.solid.voronoi import voronoi

Row = dict[str, Any]
JITTER = 0.1
"""Largest distance of an inner node from its place, in spacings."""


@dataclass(frozen=True)
class Halves:
    """Nodes X (N, 2) of a plate with spacing 1, those of its right half, the support radius R; `width`: its extent along x_2."""

    positions: Array
    right: Array
    radius: float
    width: float
    outline: Array

    @property
    def cloud(self) -> Cloud:
        """Linear basis, cubic kernel."""
        return cloud(self.positions, self.radius)

    def apart(self, gap: float) -> Array:
        """Positions (N, 2) with the right half moved by the gap along x_1."""
        return self.positions + gap * np.outer(self.right, [1.0, 0.0])

    def across(self, x: Array) -> int:
        """How many pairs of a node and a node of the other half under whose support it is there are at positions x."""
        near = neighbours(self.cloud.at(x), x)
        return int((self.right[near.points] != self.right[near.nodes]).sum())

    @property
    def middle(self) -> Array:
        """The points (8 (rows - 1) + 1, 2) half-way between the innermost columns as they lie in X."""
        return np.stack(
            [np.zeros(8 * round(self.width) + 1), np.linspace(0, self.width, 8 * round(self.width) + 1)], axis=1
        )


def halves(columns: int, rows: int, radius: float, seed: int) -> Halves:
    """`columns` columns of `rows` nodes on each side of x_1 = 0, nodes of the boundary and of the two columns there on the lattice."""
    axes = np.arange(2 * columns) - columns + 0.5, np.arange(rows, dtype=float)
    X = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    inner = (abs(X[:, 0]) > 1) & (abs(X[:, 0]) < columns - 1) & (X[:, 1] > 0) & (X[:, 1] < rows - 1)
    X[inner] += JITTER * np.random.default_rng(seed).uniform(-1, 1, (int(inner.sum()), 2))
    last = 2 * columns - 1
    around = [(i, 0) for i in range(last)] + [(last, j) for j in range(rows - 1)]
    around += [(i, rows - 1) for i in range(last, 0, -1)] + [(0, j) for j in range(rows - 1, 0, -1)]
    return Halves(X, X[:, 0] > 0, radius, rows - 1.0, np.array([i * rows + j for i, j in around]))


def _joined(h: Halves) -> Cells:
    x, y = h.positions.T
    return voronoi(h.positions, box([x.min(), y.min()], [x.max(), y.max()]))


def lagrangian_gap(h: Halves, first: float, gaps: Sequence[float]) -> list[Row]:
    """F at the nodes, and the force across the gap by two hyperelastic laws, in the reference configuration with the gap `first`.

    SCNI where the halves are one plate there, DNI otherwise. pairs: of nodes across in the reference configuration. force: sum of f_int over the
    nodes of the right half along x_1, over mu times the width; positive where the halves push each other away. overlap: nodes of
    one half that lie inside the other.
    """
    X, cells = h.apart(first), _joined(h)
    near = h.cloud.at(X)
    operator = scni(near, cells) if first == 0 else dni(near, cells.measures)
    laws = {"st_venant_kirchhoff": SaintVenantKirchhoff(MODULI), "neo_hookean": NeoHookean(MODULI)}
    bodies = {name: body(near, operator, law) for name, law in laws.items()}
    edge = abs(h.positions[:, 0]).min()
    rows = []
    for gap in gaps:
        x = h.apart(gap)
        row: Row = {"gap": gap / h.radius, "pairs": h.across(X)}
        for name, b in bodies.items():
            F = b.deformation(x - X)
            force = b.internal_force(b.law.advance(F, b.state).P)[h.right, 0].sum()
            row[name] = -float(force) / (MODULI.shear * h.width)
        singular = np.linalg.svd(F, compute_uv=False)
        row["least_det_F"] = float(determinant(F).min())
        row["condition_F"] = float((singular[:, 0] / singular[:, 1]).max())
        row["overlap"] = int((x[h.right, 0] < -edge).sum())
        rows.append(row)
    return rows


def semi_lagrangian_gap(
    h: Halves, integration: NodalIntegration, first: float, last: float, steps: int, every: int
) -> list[Row]:
    """The same in the current configuration, the Truesdell law carried along while the gap goes from `first`, without
    stress there, to `last`.

    pairs: of nodes across; force: as `lagrangian_gap`; condition_nodes, condition_middle: of M at the nodes and half-way in the gap, infinite where it is
    singular; stopped: the error that ends it. Cells of SCNI are those of the whole outline, the gap included.
    """
    law, X = Truesdell(MODULI), h.apart(first)
    measures = _joined(h).measures
    outline = (h.outline,) if integration == "scni" else None
    matter = Matter(h.cloud, law, measures, integration, outline=outline)
    motion = Motion(X, np.zeros_like(X), law.start(len(X), 2), measures)
    ds = (last - first) / steps
    velocity = ds * np.outer(h.right, [1.0, 0.0])
    rows, stopped = [], ""
    for n in range(steps + 1):
        gap = first + n * ds
        force = np.nan
        try:
            operator = operator_now(matter, motion)
            stress = motion.state.cauchy * operator.measures[:, None, None]
            internal = sum((part.T @ stress[:, :, j] for j, part in enumerate(operator.parts)), 0.0 * X)
            force = -float(internal[h.right, 0].sum()) / (MODULI.shear * h.width)
            H = np.eye(2) + operator.apply(velocity)
            state = law.advance(H @ motion.state.F, motion.state)
            ahead = replace(motion, x=motion.x + velocity, state=state, measures=motion.measures * determinant(H))
        except RkverifyError as error:
            stopped = type(error).__name__
        if n % every == 0 or stopped:
            rows.append(_gap_row(h, integration, gap, motion.x, force, stopped))
        if stopped:
            break
        motion = ahead
    return rows


def _gap_row(h: Halves, integration: str, gap: float, x: Array, force: float, stopped: str) -> Row:
    now = h.cloud.at(x)
    return {
        "integration": integration,
        "gap": gap / h.radius,
        "pairs": h.across(x),
        "force": force,
        "condition_nodes": condition(now, x),
        "condition_middle": condition(now, h.middle + np.array([gap / 2, 0.0])),
        "stopped": stopped,
    }


def condition(now: Cloud, points: Array) -> float:
    """The largest condition number of M over the points, infinite where one of them has too few nodes."""
    try:
        return float(condition_numbers(now, points).max())
    except RkverifyError:
        return float("inf")
