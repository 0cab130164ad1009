"""The boundary of a body with the cells' own rule: points, lengths (areas), normals, the cell that each facet closes."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from rkverify.errors import BadInput
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud
from rkverify.solid.edge_rules import facet_rule
from rkverify.solid.gradients import facets_alone
from rkverify.solid.kernel_values import Array
from rkverify.solid.shape import shape

Where = Callable[[Array], Array]
"""Midpoints of facets (F, d) -> which of them are meant (F,), true or false."""


@dataclass(frozen=True)
class Boundary:
    """Q points (Q, d) with weights (Q,) in length^(d-1), outward normals (Q, d), cells (Q,), Psi_I at the points (Q, N)."""

    points: Array
    weights: Array
    normals: Array
    cells: Array
    values: sp.csr_array

    def traction(self, h: Array) -> Array:
        """sum_K Psi_I(X_K) h0(X_K) W_K of (20), (N, d), from tractions h0 (Q, d) per undeformed length or area."""
        force: Array = self.values.T @ (self.weights[:, None] * h)
        return force

    def cell_sums(self, values: Array, cells: int) -> Array:
        """Sums (L, …) over the points of each cell of weighted values (Q, …)."""
        shape = (cells, *values.shape[1:])
        total = np.zeros(shape, dtype=values.dtype)
        np.add.at(total, self.cells, values * self.weights.reshape(-1, *[1] * (values.ndim - 1)))
        return total


def boundary(cloud: Cloud, cells: Cells, rule: str = "trapezoid", where: Where | None = None) -> Boundary:
    """The part of the boundary whose facets' midpoints `where` chooses, all of it by default.

    With the rule of the gradient operator, what the cells take from the boundary and what is given there cancel exactly.
    Raises BadInput where no facet is chosen.
    """
    outer = cells.boundary
    if where is not None:
        midpoints = facet_rule(facets_alone(cells, outer), "midpoint").points
        outer = outer[np.asarray(where(midpoints), dtype=bool)]
    if not len(outer):
        raise BadInput("no facet on the boundary is chosen: let the condition hold at some midpoint of a facet")
    alone = facets_alone(cells, outer)
    means = facet_rule(alone, rule)
    size = np.linalg.norm(alone.areas, axis=1)
    facet = means.facet
    points = means.points[means.point]
    return Boundary(
        points,
        means.weights * size[facet],
        (alone.areas / size[:, None])[facet],
        alone.sides[facet, 0],
        shape(cloud, points).matrix(),
    )
