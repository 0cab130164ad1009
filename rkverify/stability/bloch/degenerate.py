"""Four cells that meet in a point: which derivatives exist there, and why the analysis needs none that does not.

On the square lattice a diagonal pair of nodes comes to share an edge as soon as a node moves: which pair depends on the
direction. Along each direction the cells are the Voronoi cells of one of the two triangulations of the four nodes.

Areas are C1: a new edge's length grows from zero, dA_L/dx_J = (edge/distance) (x_J - edge's middle). So are the integrals of
grad Psi over cells, and single b_I^L by an exact rule. By a rule on edges they are not: the trapezoid of an edge does not
change by Psi at its end times what the edge grows, and which edges grow is another matter in the two triangulations; the two
one-sided derivatives of a single b_I^L differ, by less the better the rule. Their sum over the cells is zero in either
triangulation, before and after the motion, with any rule: each facet counts with opposite signs in its two cells. That sum
is all that a uniform stress feels. The material part holds the cells. So K(k) of SCNI exists, and needs none of these derivatives.
"""

from dataclasses import dataclass, replace

import numpy as np

from rkverify.solid.cell_topology import Topology
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import moved, topology, voronoi
from rkverify.stability.bloch.cell_integrals import conforming, facets_of, room
from rkverify.stability.bloch.lattices import Lattice, Patch
from rkverify.stability.bloch.measure_slopes import STEP
from rkverify.stability.bloch.scheme import Scheme


@dataclass(frozen=True)
class Moved:
    """Derivatives with respect to one coordinate of a node: of a_L b_jI^L (cells, nodes, 2) and of the areas (cells,)."""

    integrals: Array
    areas: Array

    @property
    def resultant(self) -> Array:
        """sum_L d(a_L b_jI^L)/dx (nodes, 2): what a uniform stress feels."""
        return np.asarray(self.integrals.sum(axis=0))


def patch_of(lattice: Lattice, scheme: Scheme) -> tuple[Patch, Array]:
    """A patch around node 0 and those of its cells that are whole and where every Psi that node 0 changes is known."""
    patch = lattice.around(2 * scheme.reach + 5)
    distances = np.linalg.norm(patch.positions - patch.positions[0], axis=1)
    return patch, np.flatnonzero(distances < scheme.reach + 2)


def by_complex_step(scheme: Scheme, patch: Patch, cells: Array, axis: int, tilt: float) -> Moved:
    """With the cells' topology held: that of the patch's nodes sheared by `tilt`, whose sign chooses the triangulation."""
    x = patch.positions
    held = topology(x @ np.array([[1.0, 0.0], [tilt, 1.0]]), room(x * (1 + abs(tilt))))
    step = x.astype(complex)
    step[0, axis] += 1j * STEP
    after = moved(_inner(held), step)
    return Moved(conforming(scheme, step, after, cells).imag / STEP, after.measures[cells].imag / STEP)


def _inner(held: Topology) -> Topology:
    """Without the facets on the boundary, which belongs to other positions."""
    keep = (held.sides[:, 1] != OUTSIDE) & (held.ends < len(held.simplices)).all(axis=1)
    return replace(held, ends=held.ends[keep], sides=held.sides[keep])


def by_difference(scheme: Scheme, patch: Patch, cells: Array, axis: int, step: float) -> Moved:
    """One-sided, with the Voronoi cells as they are at rest and after a step, forwards where it is positive."""
    x = patch.positions
    there = x.copy()
    there[0, axis] += step
    before, after = voronoi(x, room(x)), voronoi(there, room(x))
    change = conforming(scheme, there, after, cells) - conforming(scheme, x, before, cells)
    return Moved(change / step, (after.measures - before.measures)[cells] / step)


def area_slopes(patch: Patch, cells: Array) -> Array:
    """dA_L/dx_0 (cells, 2) in closed form: (edge/distance)(x_0 - edge's middle), and minus the others' sum for L = 0."""
    x = patch.positions
    voronoi_cells = voronoi(x, room(x))
    slopes = np.zeros((len(x), 2))
    for f in facets_of(voronoi_cells, np.array([0])):
        first, second = voronoi_cells.sides[f]
        L = second if first == 0 else first
        middle = voronoi_cells.vertices[voronoi_cells.corners[2 * f : 2 * f + 2]].mean(axis=0)
        length = np.linalg.norm(voronoi_cells.areas[f])
        slopes[L] += length / np.linalg.norm(x[L] - x[0]) * (x[0] - middle)
    slopes[0] = -slopes.sum(axis=0)
    return slopes[cells]
