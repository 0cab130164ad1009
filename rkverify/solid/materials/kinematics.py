"""Tensors at n points: determinant, inverse, Green strain, parts, all for real or complex (n, d, d) with d = 1, 2, 3."""

from typing import Any

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array


def determinant(F: Array) -> Array:
    """J = det F (n,), by expansion, so that a complex step passes through.

    >>> import numpy as np
    >>> determinant(np.array([[[2.0, 1.0], [0.0, 3.0]]])).item()
    6.0
    """
    d = F.shape[-1]
    if d == 1:
        return F[..., 0, 0]
    if d == 2:
        return F[..., 0, 0] * F[..., 1, 1] - F[..., 0, 1] * F[..., 1, 0]
    value: Array = (F[..., 0, :] * np.cross(F[..., 1, :], F[..., 2, :])).sum(axis=-1)
    return value


def inverse(F: Array) -> Array:
    """F^-1 (n, d, d), the adjugate over the determinant; whoever calls sees to det F != 0."""
    d, J = F.shape[-1], determinant(F)[..., None, None]
    if d == 1:
        return 1 / F
    if d == 2:
        adjugate = np.stack([F[..., 1, 1], -F[..., 0, 1], -F[..., 1, 0], F[..., 0, 0]], axis=-1).reshape(F.shape)
    else:
        a, b, c = (F[..., i, :] for i in range(3))
        adjugate = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-1)
    return adjugate / J


def transposed(A: Array) -> Array:
    """A^T (n, d, d)."""
    return np.swapaxes(A, -1, -2)


def symmetric(A: Array) -> Array:
    """(A + A^T)/2."""
    return (A + transposed(A)) / 2


def skew(A: Array) -> Array:
    """(A - A^T)/2."""
    return (A - transposed(A)) / 2


def trace(A: Array) -> Array:
    """tr A (n, 1, 1), shaped to multiply tensors."""
    return np.trace(A, axis1=-2, axis2=-1)[..., None, None]


def green_strain(F: Array) -> Array:
    """E = (F^T F - 1)/2 (n, d, d)."""
    return (transposed(F) @ F - np.eye(F.shape[-1])) / 2


def embedded(F: Array) -> Array:
    """F (n, d, d) as a deformation gradient (n, 3, 3) that leaves the other directions as they are."""
    d = F.shape[-1]
    if d == 3:
        return F
    full = np.zeros((*F.shape[:-2], 3, 3), dtype=F.dtype)
    full[..., :d, :d] = F
    for axis in range(d, 3):
        full[..., axis, axis] = 1
    return full


def cauchy_stress(P: Array, F: Array) -> Array:
    """sigma = P F^T / J from the first Piola-Kirchhoff stress (n, d, d); a stress."""
    return P @ transposed(F) / determinant(F)[..., None, None]


def first_piola_kirchhoff(sigma: Array, F: Array) -> Array:
    """P = J sigma F^-T from the Cauchy stress (n, d, d), the transpose of (24)'s nominal stress; a stress."""
    return determinant(F)[..., None, None] * sigma @ transposed(inverse(F))


def checked_gradients(F: Any) -> Array:
    """Deformation gradients as an array (n, d, d), real or complex.

    Raises BadInput for another shape or a value that is not finite.
    """
    value = np.asarray(F)
    value = value.astype(complex if np.iscomplexobj(value) else float, copy=False)
    if value.ndim != 3 or value.shape[1] != value.shape[2] or value.shape[1] not in (1, 2, 3):
        raise BadInput(f"the deformation gradients have shape {value.shape}: give (n, d, d) with d of 1, 2 or 3")
    bad = np.flatnonzero(~np.isfinite(value).all(axis=(1, 2)))
    if len(bad):
        raise BadInput(f"point {bad[0]} has a deformation gradient that is not finite: look at the step before")
    return value


def refuse_inverted(F: Array) -> None:
    """Raise BadInput, naming the first point, where det F is not positive."""
    J = determinant(F).real
    bad = np.flatnonzero(~(J > 0))
    if len(bad):
        raise BadInput(f"point {bad[0]} has det F = {J[bad[0]]:.6g}, not positive: take a smaller step or load")
