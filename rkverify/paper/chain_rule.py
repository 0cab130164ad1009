"""Spatial gradients of Lagrangian shape functions (25), with F^-1 by cofactors."""

from collections.abc import Sequence

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput
from rkverify.paper.moment import Matrix
from rkverify.paper.numbered import equation
from rkverify.paper.shape import Values


def determinant(F: Sequence[Sequence[Scalar]]) -> Scalar:
    """J = det F, by its first row."""
    if len(F) == 1:
        return F[0][0]
    parts = [(-1) ** j * F[0][j] * determinant(_minor(F, 0, j)) for j in range(len(F))]
    return sum(parts[1:], parts[0])


def _minor(F: Sequence[Sequence[Scalar]], i: int, j: int) -> Matrix:
    return [[entry for c, entry in enumerate(row) if c != j] for r, row in enumerate(F) if r != i]


def inverse(F: Sequence[Sequence[Scalar]], K: Arithmetic) -> Matrix:
    """F^-1_ji = (-1)^(i+j) det(minor_ij) / det F.

    Raises BadInput where F has no inverse: the map is not regular there.
    """
    J, axes = determinant(F), range(len(F))
    if K.sign(J) == 0:
        raise BadInput("the deformation gradient has determinant 0: the chain rule (25) needs a regular map")
    if len(F) == 1:
        return [[1 / J]]
    return [[(-1) ** (i + j) * determinant(_minor(F, i, j)) / J for i in axes] for j in axes]


@equation(25)
def spatial_gradients(slopes: Sequence[Values], F: Sequence[Sequence[Scalar]], K: Arithmetic) -> tuple[Values, ...]:
    """dPsi_I/dx_i = dPsi_I/dX_j F^-1_ji for every axis i   (25), from the gradients for every axis j; 1/length."""
    back, axes = inverse(F, K), range(len(F))
    return tuple(
        {I: sum((slopes[j][I] * back[j][i] for j in axes), K.zero()) for I in slopes[0]} for i in axes
    )  # fmt: skip
