"""Nodal gradient operators b_iI^L in one, two or three dimensions: smoothed over cells, over boxes, or direct at nodes.

The rule on a cell's facets is a choice, and every rule passes the linear patch test. The default is the trapezoid at the
cell's vertices: shape functions are evaluated once for each vertex (about 2 for each node in two dimensions, where there
are 3 edges), and each vertex then counts with half the l n of the two edges that meet there. As far as we remember, the
paper's reference for SCNI (Chen, Wu, Yoon and You, Int. J. Numer. Meth. Engng 50 (2001) 435-466) writes this form; its text was
not at hand to confirm it. Later code differs: the MATLAB function getSmoothedDerivative of a published RKPM code takes the
midpoint of each edge. So the rule has to be said with every number that is compared.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from rkverify.errors import BadInput, SingularMomentMatrix, TooFewNodes
from rkverify.readings import Derivative
from rkverify.solid.boxes import boxes
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import Cloud, shown
from rkverify.solid.edge_rules import facet_rule
from rkverify.solid.kernel_values import Array
from rkverify.solid.shape import shape


@dataclass(frozen=True)
class GradientOperator:
    """b_iI^L as d sparse matrices (L, N) in 1/length, the cells' measures A_L (L,), and the integrals over the boundary.

    boundary (d, N): the integral of Psi_I n_i over the boundary of the domain, the right-hand side of the integration
    constraint sum_L A_L b_iI^L = integral of Psi_I n_i; zeros where no domain is known. Units: length^(d-1).
    """

    parts: tuple[sp.csr_array, ...]
    measures: Array
    boundary: Array

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return len(self.parts)

    def apply(self, coefficients: Array) -> Array:
        """The gradients sum_I b_iI^L u_cI (L, c, d) of the fields with coefficients u (N, c)."""
        return np.stack([part @ coefficients for part in self.parts], axis=-1)


def scni(cloud: Cloud, cells: Cells, rule: str = "trapezoid") -> GradientOperator:
    """b_iI^L = (1 / A_L) integral of Psi_I n_i over the boundary of Omega_L   (17), (23), (47), (52), (72)

    with facets averaged by the rule. Each facet is evaluated once and counts with opposite signs in its two cells, so that
    the integration constraint holds for any cells, and sum_I b_iI^L x_jI = delta_ij for a basis of order 1 or more.

    Raises BadInput for cells of another dimension or without measure; UnknownName for the rule; what `shape` raises
    where a point on a facet is not covered.
    """
    return _smoothed(cloud, cells, rule, "a cell's facet")


def _smoothed(cloud: Cloud, cells: Cells, rule: str, where: str) -> GradientOperator:
    refuse_without_measure(cells.measures, cloud)
    weights, values = _facet_weights(cloud, cells, rule, where)
    outwards = _signs(cells)
    means = [sp.diags_array(1 / cells.measures) @ outwards @ sp.diags_array(a) @ weights for a in cells.areas.T]
    parts = tuple(_ordered(mean @ values) for mean in means)
    return GradientOperator(parts, cells.measures, _over_boundary(cells, weights, values))


def dni(cloud: Cloud, measures: Array, reading: Derivative = "full", boundary: Array | None = None) -> GradientOperator:
    """b_iI^L = dPsi_I/dx_i (x_L)   (80), with the measures (N,) of the nodes' cells in a reading of the derivative.

    Raises BadInput for measures that are not positive, UnknownName for the reading, and what `shape` raises.
    """
    _refuse_uncounted(measures, cloud)
    refuse_without_measure(measures, cloud)
    there = shape(cloud, cloud.positions, 1, reading)
    parts = tuple(_ordered(there.gradient_matrix(axis)) for axis in range(cloud.dimension))
    return GradientOperator(parts, measures, _given(boundary, cloud))


def snni(cloud: Cloud, measures: Array, rule: str = "midpoint", boundary: Array | None = None) -> GradientOperator:
    """b_iI^L = (1 / A_L) integral of Psi_I n_i over the boundary of a box of measure A_L about x_L, along the axes.

    Boxes overlap and leave gaps: the linear sums hold as for SCNI, the integration constraint does not. This is the
    practice in semi-Lagrangian computations. Raises as `scni` does; a box may leave the domain, and the covered region.
    """
    _refuse_uncounted(measures, cloud)
    refuse_without_measure(measures, cloud)
    alone = _smoothed(cloud, boxes(cloud.positions, measures), rule, "the side of a box about a node")
    return GradientOperator(alone.parts, measures, _given(boundary, cloud))


def boundary_integrals(cloud: Cloud, cells: Cells, rule: str = "trapezoid") -> Array:
    """The integrals of Psi_I n_i over the boundary of the domain that the cells tile, by the rule, (d, N)."""
    outer = facets_alone(cells, cells.boundary)
    return _over_boundary(outer, *_facet_weights(cloud, outer, rule, "the boundary"))


def constraint_residual(operator: GradientOperator) -> Array:
    """sum_L A_L b_iI^L - integral of Psi_I n_i over the boundary, (d, N): zero where the integration constraint holds."""
    return np.stack([part.T @ operator.measures for part in operator.parts]) - operator.boundary


def sums(operator: GradientOperator, positions: Array) -> tuple[Array, Array]:
    """sum_I b_iI^L (L, d) and sum_I b_iI^L x_jI - delta_ij (L, j, i): zero where linear fields have their gradient."""
    constant = operator.apply(np.ones((len(positions), 1)))[:, 0]
    return constant, operator.apply(positions) - np.eye(operator.dimension)


def _refuse_uncounted(measures: Array, cloud: Cloud) -> None:
    if np.shape(measures) != (len(cloud),):
        raise BadInput(f"{np.size(measures)} measures for {len(cloud)} nodes: give one for each node")


def refuse_without_measure(measures: Array, cloud: Cloud) -> None:
    """Raise BadInput, naming the cell, where a measure is not positive and finite."""
    bad = np.flatnonzero(~(np.isfinite(measures) & (measures.real > 0)))
    if len(bad):
        place = (
            f" of node {bad[0]} at ({shown(cloud.positions[bad[0]])})" if len(measures) == len(cloud) else f" {bad[0]}"
        )
        raise BadInput(f"the cell{place} has measure {measures[bad[0]].real:.6g}: it must be positive and finite")


def _facet_weights(cloud: Cloud, cells: Cells, rule: str, where: str) -> tuple[sp.csr_array, sp.csr_array]:
    if cells.dimension != cloud.dimension:
        raise BadInput(f"the cells have {cells.dimension} dimensions, the nodes {cloud.dimension}: give both alike")
    means = facet_rule(cells, rule)
    try:
        return _short(means.matrix()), _short(shape(cloud, means.points).matrix())
    except (TooFewNodes, SingularMomentMatrix) as error:
        raise type(error)(f"on {where}, {error}") from None


def facets_alone(cells: Cells, chosen: Array) -> Cells:
    """The same cells with the chosen facets alone."""
    counts = np.diff(cells.starts)[chosen]
    corners = [cells.corners[cells.starts[f] : cells.starts[f + 1]] for f in chosen]
    starts = np.concatenate([[0], np.cumsum(counts)])
    together = np.concatenate(corners) if corners else cells.corners[:0]
    return Cells(cells.vertices, starts, together, cells.sides[chosen], cells.areas[chosen], cells.measures)


def _short(matrix: sp.csr_array) -> sp.csr_array:
    """The matrix with indices of four bytes where these suffice: products of a million nodes then need half the memory."""
    if max(matrix.nnz, *matrix.shape) < 2**31:
        matrix.indices, matrix.indptr = matrix.indices.astype(np.int32), matrix.indptr.astype(np.int32)
    return matrix


def _signs(cells: Cells) -> sp.csr_array:
    """+1 where a facet's area vector points out of a cell, -1 where it points in, (L, F)."""
    facets = np.arange(len(cells.sides))
    inner = cells.sides[:, 1] != OUTSIDE
    rows = np.concatenate([cells.sides[:, 0], cells.sides[inner, 1]])
    signs = np.concatenate([np.ones(len(facets)), -np.ones(inner.sum())])
    columns = np.concatenate([facets, facets[inner]])
    return _short(sp.csr_array(sp.coo_array((signs, (rows, columns)), shape=(len(cells), len(facets)))))


def _over_boundary(cells: Cells, weights: sp.csr_array, values: sp.csr_array) -> Array:
    outer = cells.boundary
    at_points = cells.areas[outer].T @ weights[outer]
    return np.asarray(at_points @ values)


def _given(boundary: Array | None, cloud: Cloud) -> Array:
    return np.zeros((cloud.dimension, len(cloud))) if boundary is None else boundary


def _ordered(matrix: sp.csr_array) -> sp.csr_array:
    matrix = sp.csr_array(matrix)
    matrix.sort_indices()
    return matrix
