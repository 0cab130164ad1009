"""Derivatives of the Voronoi cells' areas or volumes with respect to a node's position.

A facet between x_L and x_J moves with x_J so that dA_L/dx_J = (facet/distance) (x_J - facet's centroid): the points of the
facet go towards x_L where x_J comes nearer, and turn about the point below x_J. In the plane this is what a complex step
of the vertices gives; in space the cells' vertices are real, and the formula is taken.
"""

import numpy as np

from rkverify.solid.cell_topology import Topology
from rkverify.solid.cells import Cells
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import moved, topology, voronoi
from rkverify.stability.bloch.cell_integrals import facets_of, room

STEP = 1e-30
"""Imaginary step: no difference is formed, so that it may be far below rounding."""


def cells_of(x: Array) -> Topology | Cells:
    """What `measure_slopes` needs of the cells of nodes (P, d) in a box about them."""
    return voronoi(x, room(x)) if x.shape[1] == 3 else topology(x, room(x))


def measure_slopes(x: Array, cells: Topology | Cells, J: int) -> Array:
    """d(measure of cell L)/dx_J (P, d) for a node J whose cell does not reach the boundary; length^(d-1)."""
    return _by_formula(x, cells, J) if isinstance(cells, Cells) else _by_steps(x, cells, J)


def _by_steps(x: Array, cells: Topology, J: int) -> Array:
    slopes = np.zeros(x.shape)
    for axis in range(x.shape[1]):
        there = x.astype(complex)
        there[J, axis] += 1j * STEP
        slopes[:, axis] = moved(cells, there).measures.imag / STEP
    return slopes


def _by_formula(x: Array, cells: Cells, J: int) -> Array:
    slopes = np.zeros(x.shape)
    for f in facets_of(cells, np.array([J])).tolist():
        first, second = cells.sides[f].tolist()
        L = second if first == J else first
        corners = cells.vertices[cells.corners[cells.starts[f] : cells.starts[f + 1]]]
        size = np.linalg.norm(cells.areas[f])
        slopes[L] += size / np.linalg.norm(x[L] - x[J]) * (x[J] - centroid(corners))
    slopes[J] = -slopes.sum(axis=0)  # the cells fill the box
    return slopes


def centroid(corners: Array) -> Array:
    """The centroid (3,) of a plane convex polygon with corners (C, 3) in order around it.

    >>> centroid(np.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0]])).tolist()
    [1.0, 1.0, 0.0]
    """
    first, then = corners[1:-1] - corners[0], corners[2:] - corners[0]
    weights = np.linalg.norm(np.cross(first, then), axis=1)
    return np.asarray(corners[0] + weights @ (first + then) / (3 * weights.sum()))
