"""a_L b_iI^L = int_Gamma_L Psi_I n_i (47) over cells or boxes, or a_L Psi_I,i(x_L), for some cells of a patch of nodes."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_array, diags_array

from rkverify.solid.boxes import boxes
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud
from rkverify.solid.domain import Box, box
from rkverify.solid.gradients import facets_alone, scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours
from rkverify.solid.shape import shape
from rkverify.solid.voronoi import voronoi
from rkverify.stability.bloch.lattices import Lattice
from rkverify.stability.bloch.scheme import Scheme

Integrals = Callable[[Array, Array], tuple[csr_array, ...]]
"""Positions (P, d) and measures (P,), real or complex, to a_L b_iI^L for every axis (cells, P)."""


def room(positions: Array) -> Box:
    """A box about the nodes, with a margin of 1."""
    return box(positions.real.min(axis=0) - 1, positions.real.max(axis=0) + 1)


def areas(lattice: Lattice) -> tuple[Array, float]:
    """The areas or volumes of the Voronoi cells of a period (n,), and how far a vertex is from the node of its cell at most."""
    # No cell's vertex is farther from its node than the largest empty circle's radius, at most half a period's diagonals.
    patch = lattice.around(1.01 * float(np.linalg.norm(lattice.periods, axis=1).sum()))
    cells = voronoi(patch.positions, room(patch.positions))
    own = facets_alone(cells, facets_of(cells, np.arange(len(lattice))))
    which = np.repeat(own.sides, np.diff(own.starts), axis=0)
    apart = [
        np.linalg.norm(cells.vertices[own.corners] - patch.positions[side], axis=1)[(side >= 0) & (side < len(lattice))]
        for side in which.T
    ]
    return cells.measures[: len(lattice)], float(np.concatenate(apart).max())


def facets_of(cells: Cells, chosen: Array) -> Array:
    """The facets of the chosen cells."""
    return np.flatnonzero(np.isin(cells.sides, chosen).any(axis=1))


def conforming(scheme: Scheme, positions: Array, cells: Cells, chosen: Array) -> Array:
    """a_L b_iI^L (cells, P, d) of the chosen cells, whose other cells may lie where nothing is defined."""
    alone = facets_alone(cells, facets_of(cells, chosen))
    whole = scni(scheme.cloud(positions), alone, scheme.rule)
    return np.stack([part[chosen].toarray() for part in whole.parts], axis=2) * cells.measures[chosen, None, None]


def moving(scheme: Scheme, positions: Array, chosen: Array) -> Integrals:
    """a_L b_iI^L of DNI and SNNI for the chosen cells, as functions of positions and measures near the given ones."""
    known = neighbours(scheme.cloud(positions), positions[chosen])

    def direct(x: Array, a: Array) -> tuple[csr_array, ...]:
        Psi = shape(scheme.cloud(x), x[chosen], 1, scheme.derivative, known)
        return tuple(diags_array(a[chosen]) @ Psi.gradient_matrix(axis) for axis in range(x.shape[1]))

    def boxed(x: Array, a: Array) -> tuple[csr_array, ...]:
        whole = scni(scheme.cloud(x), boxes(x[chosen], a[chosen]), scheme.rule)
        return tuple(diags_array(a[chosen]) @ part for part in whole.parts)

    return direct if scheme.integration == "dni" else boxed


def dense(cloud: Cloud, points: Array) -> Array:
    """Psi_I at points as a dense matrix (points, P)."""
    values: Array = shape(cloud, points).matrix().toarray()
    return values
