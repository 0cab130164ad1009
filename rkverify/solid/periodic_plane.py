"""The semi-discrete semi-Lagrangian equations (41)-(47), without N, on nodes in the plane that repeat with two periods.

Images of the nodes stand around one period; what they receive is folded back. Hypoelastic in plane strain:
sigma' = C : D + L sigma + sigma L^T - tr(L) sigma, or with Jaumann's rate; x_I' = v_I; density is what is left of a cell's mass.
"""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from scipy.sparse import csr_array, diags_array

from rkverify.readings import CellMeasure, Derivative, NodalIntegration
from rkverify.solid.boxes import boxes
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud
from rkverify.solid.domain import Box, box
from rkverify.solid.gradients import facets_alone, scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import trace, transposed
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.shape import Shape, shape
from rkverify.solid.voronoi import voronoi


@dataclass(frozen=True)
class PeriodicPlane:
    """Periods (2, 2) in rows, the approximation on the nodes at rest, cell masses (N,), images: owners (P,), shifts (P, 2).

    The first N images are the nodes themselves. external (N, 2): nodal forces. law: truesdell or jaumann.
    """

    periods: Array
    cloud: Cloud
    masses: Array
    owners: Array
    shifts: Array
    integration: NodalIntegration
    rule: str
    derivative: Derivative
    cell_measure: CellMeasure
    moduli: Moduli
    law: str
    external: Array | float = 0.0

    def images(self, x: Array) -> Array:
        """The positions of all images (P, 2)."""
        return np.asarray(x[self.owners] + self.shifts)

    def folded(self, values: Array) -> Array:
        """Sums over the images of every node, (P, …) -> (N, …)."""
        total = np.zeros((len(self.masses), *values.shape[1:]), values.dtype)
        np.add.at(total, self.owners, values)
        return total


@dataclass(frozen=True)
class PlaneMotion:
    """Positions and velocities (N, 2), Cauchy stresses (N, 2, 2), cell measures (N,), or their rates."""

    x: Array
    v: Array
    stress: Array
    measures: Array

    def packed(self) -> Array:
        """All in one row (9 N,)."""
        return np.concatenate([part.ravel() for part in (self.x, self.v, self.stress, self.measures)])

    def like(self, row: Array) -> "PlaneMotion":
        """A row (9 N,) in parts."""
        n = len(self.x)
        x, v, stress, measures = np.split(row, [2 * n, 4 * n, 8 * n])
        return PlaneMotion(x.reshape(n, 2), v.reshape(n, 2), stress.reshape(n, 2, 2), measures)


def surroundings(x: Array, periods: Array, radius: float) -> tuple[Array, Array]:
    """Owners (P,) and shifts (P, 2) of all images closer than the radius to one of the nodes (N, 2), which come first."""
    heights = abs(np.linalg.det(periods)) / np.linalg.norm(periods[::-1], axis=1)
    reach = np.ceil((radius + np.linalg.norm(np.ptp(x, axis=0))) / heights).astype(int)
    steps = np.array(list(product(*(range(-m, m + 1) for m in reach))))
    shifts = steps[np.argsort(abs(steps).sum(axis=1), kind="stable")] @ periods
    apart = (x[None, :] + shifts[:, None])[:, :, None] - x[None, None]
    near = (np.linalg.norm(apart, axis=3) < radius).any(axis=2)
    near[0] = True
    which, owners = np.nonzero(near)
    return owners, shifts[which]


def voronoi_measures(plane: PeriodicPlane, x: Array) -> tuple[Array, Cells]:
    """The areas of the nodes' Voronoi cells (N,), and the cells of all images, of which the outer ones are not whole."""
    images = plane.images(x)
    cells = voronoi(images, _room(images))
    return cells.measures[: len(x)], cells


def _room(images: Array) -> Box:
    return box(images.min(axis=0) - 1, images.max(axis=0) + 1)


def _smoothed(
    plane: PeriodicPlane, motion: PlaneMotion, cloud: Cloud
) -> tuple[Array, tuple[csr_array, ...], Shape | None]:
    """Cell measures a_L, the integrals a_L b_iI^L (N, P) for both axes, and Psi at the nodes where DNI has it already."""
    N, x = len(motion.x), motion.x
    a, cells = motion.measures, None
    if plane.cell_measure == "edges" or plane.integration == "scni":
        areas, cells = voronoi_measures(plane, x)
        a = areas if plane.cell_measure == "edges" else a
    if plane.integration == "scni" and cells is not None:
        mine = np.flatnonzero(((cells.sides >= 0) & (cells.sides < N)).any(axis=1))
        whole = scni(cloud, facets_alone(cells, mine), plane.rule)
        return a, tuple(diags_array(cells.measures[:N]) @ part[:N] for part in whole.parts), None
    if plane.integration == "snni":
        whole = scni(cloud, boxes(x, a), plane.rule)
        return a, tuple(diags_array(a) @ part for part in whole.parts), None
    Psi = shape(cloud, x, 1, plane.derivative)
    return a, tuple(diags_array(a) @ Psi.gradient_matrix(axis) for axis in range(2)), Psi


def rates(plane: PeriodicPlane, motion: PlaneMotion) -> PlaneMotion:
    """The rates of positions, velocities, stresses and measures."""
    x, v = motion.x, motion.v
    cloud = plane.cloud.at(plane.images(x), np.full(len(plane.owners), plane.cloud.supports[0]))
    a, B, Psi = _smoothed(plane, motion, cloud)
    L = np.stack([part @ v[plane.owners] for part in B], axis=2) / a[:, None, None]
    forces = sum(part.T @ motion.stress[:, :, axis] for axis, part in enumerate(B))
    values = (shape(cloud, x) if Psi is None else Psi).matrix()
    masses = plane.folded(values.T @ plane.masses)
    return PlaneMotion(
        v,
        (plane.external - plane.folded(np.asarray(forces))) / masses[:, None],
        stress_rate(plane, motion.stress, L),
        motion.measures * trace(L)[:, 0, 0] if plane.cell_measure == "material" else np.zeros_like(motion.measures),
    )


def stress_rate(plane: PeriodicPlane, sigma: Array, L: Array) -> Array:
    """sigma' (N, 2, 2) of the law."""
    elastic = plane.moduli.of(L)
    if plane.law == "truesdell":
        return np.asarray(elastic + L @ sigma + sigma @ transposed(L) - trace(L) * sigma)
    W = (L - transposed(L)) / 2
    return np.asarray(elastic + W @ sigma - sigma @ W)


def held(plane: PeriodicPlane, motion: PlaneMotion) -> PeriodicPlane:
    """The plane under the dead loads that hold this motion at rest, whatever forces a uniform stress leaves."""
    still = replace(plane, external=0.0)
    cloud = plane.cloud.at(plane.images(motion.x), np.full(len(plane.owners), plane.cloud.supports[0]))
    _, B, _ = _smoothed(still, motion, cloud)
    forces = sum(part.T @ motion.stress[:, :, axis] for axis, part in enumerate(B))
    return replace(plane, external=plane.folded(np.asarray(forces)))
