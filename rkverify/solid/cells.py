"""Nodal representative cells Omega_L in one, two or three dimensions, as facets between them.

A facet is a point, a straight edge or a plane polygon with an area vector that points out of its first cell and into its
second. What is integrated over a facet is added to the one cell and taken from the other, so that the integration
constraint over all cells holds by construction.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array

OUTSIDE = -1
"""The second cell of a facet on the boundary of the domain."""


@dataclass(frozen=True)
class Cells:
    """The cells of N nodes: vertices (V, d), facets as corners in CSR form, their two cells (F, 2), measures A_L (N,).

    Facet f has the corners vertices[corners[starts[f] : starts[f + 1]]], in order around it; its area vector (a length,
    an area, or +-1 in one dimension, times the unit normal) points out of cell sides[f, 0]; sides[f, 1] is OUTSIDE on the
    boundary of the domain. Units: length, length^(d-1), length^d.
    """

    vertices: Array
    starts: Array
    corners: Array
    sides: Array
    areas: Array
    measures: Array

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return int(self.vertices.shape[1])

    def __len__(self) -> int:
        """The number N of cells."""
        return len(self.measures)

    @property
    def boundary(self) -> Array:
        """The facets on the boundary of the domain."""
        return np.flatnonzero(self.sides[:, 1] == OUTSIDE)
