"""RK shape functions (2)-(4), (9), (28)-(31) and their derivatives at many points, in one to three dimensions."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from rkverify.errors import BadInput, UnknownName
from rkverify.readings import DERIVATIVES, Derivative
from rkverify.solid.bases import axis_pairs, basis_tables
from rkverify.solid.blocks import blocks, numbers
from rkverify.solid.cloud import Cloud
from rkverify.solid.compiled_shape import derivative_stage
from rkverify.solid.kernel_values import Array
from rkverify.solid.kinks import refuse_kinks
from rkverify.solid.neighbours import Neighbours, checked_points
from rkverify.solid.neighbours import neighbours as neighbours_of


@dataclass(frozen=True)
class Shape:
    """Psi_J at P points, entry by entry of the neighbours: values (nnz,), gradients (nnz, d), seconds (nnz, d (d + 1)/2).

    Dimensionless, 1/length and 1/length^2; pairs of axes as `axis_pairs` lists them; None where not asked for. size: N.
    """

    neighbours: Neighbours
    values: Array
    gradients: Array | None
    seconds: Array | None
    size: int

    def sparse(self, entries: Array) -> csr_array:
        """Entries (nnz,) as a matrix (P, N)."""
        pattern = self.neighbours
        return csr_array((entries, pattern.nodes, pattern.starts), shape=(len(pattern), self.size))

    def matrix(self) -> csr_array:
        """Psi_J(x_p) as a matrix (P, N)."""
        return self.sparse(self.values)

    def gradient_matrix(self, axis: int) -> csr_array:
        """dPsi_J/dx_k (x_p) as a matrix (P, N); raises BadInput where gradients or the axis are not there."""
        if self.gradients is None:
            raise BadInput("these shape functions were made without gradients: ask for derivatives=1")
        return self.sparse(self.gradients[:, _known_axis(axis, self.gradients.shape[1])])

    def second_matrix(self, k: int, l: int) -> csr_array:
        """d2Psi_J/dx_k dx_l (x_p) as a matrix (P, N); raises BadInput where seconds or an axis are not there."""
        if self.seconds is None or self.gradients is None:
            raise BadInput("these shape functions were made without second derivatives: ask for derivatives=2")
        d = self.gradients.shape[1]
        pair = tuple(sorted((_known_axis(k, d), _known_axis(l, d))))
        return self.sparse(self.seconds[:, axis_pairs(d).index((pair[0], pair[1]))])


def _known_axis(axis: int, d: int) -> int:
    if axis not in range(d):
        raise BadInput(f"there is no axis {axis} in {d} dimensions: choose one from 0 to {d - 1}")
    return axis


def shape(
    cloud: Cloud,
    points: Array,
    derivatives: int = 0,
    reading: Derivative = "full",
    neighbours: Neighbours | None = None,
) -> Shape:
    """Psi_J(x) = H^T(0) M^-1(x) H(x - x_J) phi_a(x - x_J) at points (P, d), with derivatives up to 0, 1 or 2   (4), (30).

    The derivatives are of one of the readings `DERIVATIVES`. Complex nodes or points carry a complex step through.
    neighbours: where they are known already.

    Raises BadInput for points of another shape or dimension and for a diffuse derivative above the order, UnknownName for
    the reading, TooFewNodes, SingularMomentMatrix, and NotDifferentiable where the kernel is not smooth enough.

    >>> from rkverify.solid.cloud import cloud
    >>> Psi = shape(cloud([[0], [1], [2]], 1.5), np.array([[1.0]]), derivatives=1)
    >>> Psi.matrix().toarray().round(12).tolist(), Psi.neighbours.nodes.tolist()
    ([[0.064516129032, 0.870967741935, 0.064516129032]], [0, 1, 2])
    """
    if reading not in DERIVATIVES:
        raise UnknownName("derivative", reading, DERIVATIVES)
    if derivatives not in (0, 1, 2):
        raise BadInput(f"derivatives of order {derivatives} are not offered: choose 0, 1 or 2")
    if reading == "diffuse" and derivatives > cloud.order:
        raise BadInput(
            f"a diffuse derivative of order {derivatives} needs a basis of that order, not {cloud.order}: raise the order or "
            "choose another reading"
        )
    x, d = numbers(cloud, checked_points(cloud, points)), cloud.dimension
    known = neighbours_of(cloud, x) if neighbours is None else neighbours
    of_the_kernel = 0 if reading == "diffuse" else derivatives
    refuse_kinks(cloud, x, of_the_kernel)
    nnz = len(known.nodes)
    values = np.empty(nnz, x.dtype)
    gradients = np.empty((nnz if derivatives else 0, d), x.dtype)
    seconds = np.empty((nnz if derivatives > 1 else 0, d * (d + 1) // 2), x.dtype)
    run, how = derivative_stage(d, cloud.order), DERIVATIVES.index(reading)
    for block in blocks(cloud, x, known, of_the_kernel):
        run(*block.of_shape, derivatives, how, values, gradients, seconds)
    return Shape(known, values, gradients if derivatives else None, seconds if derivatives > 1 else None, len(cloud))


def condition_numbers(cloud: Cloud, points: Array, neighbours: Neighbours | None = None) -> Array:
    """The 2-norm condition number of M(x), (6), with lengths in units of the largest support over the point (P,).

    Raises BadInput and TooFewNodes as `shape` does; infinite where M is singular in double precision.
    """
    x = numbers(cloud, checked_points(cloud, points))
    known = neighbours_of(cloud, x) if neighbours is None else neighbours
    m = basis_tables(cloud.dimension, cloud.order).size
    conditions = np.empty(len(x))
    for block in blocks(cloud, x, known, 0, factorise=False):
        M = np.zeros((block.last - block.first, m, m))
        M[(slice(None), *np.tril_indices(m))] = block.factors.real
        sizes = abs(np.linalg.eigvalsh(M))  # the lower triangle is all that it reads
        with np.errstate(divide="ignore"):
            conditions[block.first : block.last] = sizes.max(axis=1) / sizes.min(axis=1)
    return conditions
