"""A square block led through a fold, and a plate led through a stretch: what exists in either configuration, and up to where."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rkverify.certify.mechanics.lost_digits import fold
from rkverify.certify.mechanics.patch import MODULI
from rkverify.certify.mechanics.separation import condition
from rkverify.errors import RkverifyError
from rkverify.readings import NodalIntegration
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import box
from rkverify.solid.gradients import dni, scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import determinant
from rkverify.solid.materials.law import Law
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.body import Body, body
from rkverify.solid.mechanics.moving import Matter, Motion, forces
from rkverify.solid.neighbours import neighbours
from rkverify.solid.voronoi import voronoi

Row = dict[str, Any]
JITTER = 0.2
BISECTIONS = 40


@dataclass(frozen=True)
class Block:
    """Nodes X (N, 2) in [-1, 1]^2 with their cloud, the nodes around it in order, and the body with SCNI."""

    cloud: Cloud
    outline: Array
    body: Body

    def at(self, s: float) -> Array:
        """x = X + s u with the u that folds along an oblique line at s = 1."""
        X = self.cloud.positions
        return X + s * fold(X)


def block(divisions: int, radius: float, seed: int) -> Block:
    """`divisions` spacings along each side, nodes inside off the lattice; supports of radius times the spacing."""
    axis = np.linspace(-1, 1, divisions + 1)
    X = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    inner = (abs(X) < 1).all(axis=1)
    h = 2 / divisions
    X[inner] += JITTER * h * np.random.default_rng(seed).uniform(-1, 1, (int(inner.sum()), 2))
    near = cloud(X, radius * h)
    edge = np.flatnonzero(~inner)
    around = np.arctan2(X[edge, 1], X[edge, 0])
    operator = scni(near, voronoi(X, box([-1, -1], [1, 1])))
    return Block(near, edge[np.argsort(around)], body(near, operator, NeoHookean(MODULI)))


def lagrangian_fold(b: Block, values: Sequence[float]) -> list[Row]:
    """F over the cells at each s, and whether the force exists by a law that needs F^-1 (neo-Hookean) and by one that does not.

    entered, left: pairs of nodes under each other's support that are new at s, or no longer there, over the number in X.
    """
    X = b.cloud.positions
    before = neighbours(b.cloud, X)
    pairs = set(zip(before.points.tolist(), before.nodes.tolist(), strict=True))
    rows = []
    for s in values:
        x = b.at(s)
        F = b.body.deformation(x - X)
        singular = np.linalg.svd(F, compute_uv=False)
        after = neighbours(b.cloud, x)
        now = set(zip(after.points.tolist(), after.nodes.tolist(), strict=True))
        rows.append(
            {
                "s": s,
                "least_det_F": float(determinant(F).min()),
                "condition_F": float((singular[:, 0] / singular[:, 1]).max()),
                "neo_hookean": _exists(NeoHookean(MODULI), F),
                "st_venant_kirchhoff": _exists(SaintVenantKirchhoff(MODULI), F),
                "condition_M": condition(b.cloud.at(x), x),
                "entered": len(now - pairs) / len(pairs),
                "left": len(pairs - now) / len(pairs),
            }
        )
    return rows


def _exists(law: NeoHookean | SaintVenantKirchhoff, F: Array) -> bool:
    """Whether the first Piola-Kirchhoff stress is defined at every cell."""
    try:
        return bool(np.isfinite(law.stress(F)).all())
    except RkverifyError:
        return False


def fold_starts(b: Block) -> float:
    """The s at which F is singular in the first cell, from the eigenvalues of its gradients of u, linear in s."""
    G = b.body.operator.apply(fold(b.cloud.positions))
    return float(-1 / np.linalg.eigvals(G).real.min())


def semi_lagrangian_fold(b: Block, integration: NodalIntegration, last: float, steps: int) -> Row:
    """The block led from s = 0 to `last`, the Truesdell law carried along: how far forces and stresses exist, and the error that ends them."""
    law: Law = Truesdell(MODULI)
    X = b.cloud.positions
    measures = b.body.operator.measures
    outline = (b.outline,) if integration == "scni" else None
    matter = Matter(b.cloud, law, measures, integration, outline=outline)
    motion, ds = Motion(X, np.zeros_like(X), law.start(len(X), 2), measures), last / steps
    velocity, stopped, reached, largest = ds * fold(X), "", 0.0, 0.0
    for n in range(steps + 1):
        try:
            now = forces(matter, replace(motion, v=velocity / ds))
            reached, largest = n * ds, float(abs(now.internal).max())
            H = np.eye(2) + now.operator.apply(velocity)
            state = law.advance(H @ motion.state.F, motion.state)
        except RkverifyError as error:
            stopped = type(error).__name__
            break
        motion = replace(motion, x=motion.x + velocity, state=state, measures=motion.measures * determinant(H))
    return {"integration": integration, "reached": reached, "largest_force": largest, "stopped": stopped}


def stretch(side: int, radius: float, stretches: Sequence[float]) -> list[Row]:
    """cond M over the nodes of a square lattice stretched along x_1, with supports that stay, and that grow with the larger spacing.

    The stretches are in units of the support ratio: at 1 the next column leaves the supports.
    """
    X = _lattice(side)
    near = cloud(X, radius)
    rows = []
    for value in stretches:
        factor = value * radius
        x = X * [factor, 1.0]
        fixed, grown = condition(near.at(x), x), condition(near.at(x, factor * near.supports), x)
        rows.append({"stretch": value, "fixed": fixed, "grown": grown})
    return rows


def _lattice(side: int) -> Array:
    axis = np.arange(side, dtype=float)
    return np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)


def largest_stretch(side: int, radius: float, integration: NodalIntegration) -> float:
    """The stretch over the support ratio up to which the gradient operator of a lattice with fixed supports exists, by bisection."""
    X = _lattice(side)
    near = cloud(X, radius)

    def works(value: float) -> bool:
        x = X * [value, 1.0]
        try:
            if integration == "scni":
                scni(near.at(x), voronoi(x, box(x.min(axis=0), x.max(axis=0))))
            else:
                dni(near.at(x), np.ones(len(x)))
        except RkverifyError:
            return False
        return True

    return _bisected(works, 1.0, 4 * radius) / radius


def _bisected(works: Callable[[float], bool], low: float, high: float) -> float:
    """The last value that works between one that does and one that does not."""
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if works(middle) else (low, middle)
    return low
