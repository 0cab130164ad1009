"""K(k) of a linearised periodic node set, and the modes of K(k) u = m omega^2 u."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from rkverify.errors import UnknownName
from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.linearised import Coupling, Linearised
from rkverify.stability.bloch.loading import Loading

Part = Literal["total", "geometric", "material"]
PARTS: tuple[Part, ...] = get_args(Part)


def known_part(name: str) -> Part:
    """The part of that name; raises UnknownName."""
    for part in PARTS:
        if part == name:
            return part
    raise UnknownName("part", name, PARTS)


@dataclass(frozen=True)
class Modes:
    """omega^2 (M, d n) in 1/time^2, complex where a pair grows and decays while it oscillates, and growth (M, d n), 1/time.

    The growth is the largest real part of (-omega^2)^(1/2). Modes are in ascending order of the real part of omega^2, then
    of the imaginary part. What is within rounding of zero, `rounding` (M,), is zero.
    """

    omega_squared: Array
    growth: Array
    rounding: Array


def waves(coupling: Coupling, count: int, k: Array) -> Array:
    """sum over offsets r of values e^{i k . r}: (M, count, count, …) for wave vectors k (M, d)."""
    flat = coupling.values.reshape(len(coupling.values), -1)
    place = np.zeros((len(flat), count * count, flat.shape[1]))
    place[np.arange(len(flat)), coupling.rows * count + coupling.columns] = flat
    phases = np.exp(1j * k @ coupling.offsets.T)
    summed = phases @ place.reshape(len(flat), -1)
    return summed.reshape(len(k), count, count, *coupling.values.shape[1:])


def strain_waves(of: Linearised, k: Array) -> Array:
    """b_jI^L(k) = sum over the copies of I of b_jI^L e^{i k . (x_I - x_L)}, (M, L, I, j); 1/length."""
    return waves(of.gradients, len(of), k)


def stiffness(of: Linearised, loading: Loading, k: Array, part: Part = "total") -> Array:
    """K(k) (M, n, d, n, d) = sum_L a_L conj(b_jI^L) T_iplq b_qJ^L (material) + sigma_ij sum_L d(a_L b_jI^L)/dx_lJ (geometric).

    Force over length; raises UnknownName for another part.
    """
    known_part(part)
    n, d = len(of), len(loading.sigma)
    K = np.zeros((len(k), n, d, n, d), complex)
    if part != "geometric":
        b = strain_waves(of, k)
        stressed = np.einsum("ijkl,mLJl->mLijJk", loading.tangent, b)
        K += np.einsum("L,mLIj,mLijJk->mIiJk", of.measures, b.conj(), stressed)
    if part != "material" and len(of.geometric.rows):
        K += np.einsum("ij,mIJjl->mIiJl", loading.sigma, waves(of.geometric, n, k))
    return K


def modes(of: Linearised, loading: Loading, k: Array, part: Part = "total") -> Modes:
    """The modes at wave vectors k (M, d), rad/length."""
    d = len(loading.sigma)
    K, size = stiffness(of, loading, k, part), d * len(of)
    root = np.repeat(of.masses, d) ** -0.5
    A = K.reshape(len(k), size, size) * root[:, None] * root
    bound = rounding(of, loading, part)
    hermitian = abs(A - A.conj().transpose(0, 2, 1)).max(axis=(1, 2)) <= bound
    values = np.zeros((len(k), size), complex)
    values[hermitian] = np.linalg.eigvalsh(A[hermitian])
    values[~hermitian] = np.linalg.eigvals(A[~hermitian])
    re = np.where(abs(values.real) <= bound, 0.0, values.real)
    im = np.where(abs(values.imag) <= bound, 0.0, values.imag)
    values = np.take_along_axis(re + 1j * im, np.lexsort((im, re), axis=1), axis=1)
    return Modes(values, np.sqrt(-values).real + 0.0, np.full(len(k), bound))


def rounding(of: Linearised, loading: Loading, part: Part = "total") -> float:
    """What rounding leaves of an omega^2 that is zero: 2^-52, times the terms of a sum, times the sum of their sizes, over m.

    The sum over b enters twice, and each b carries the rounding of a moment matrix, whose solution is as many terms.
    """
    n, g, G = len(of), of.gradients, of.geometric
    size = 0.0
    if part != "geometric":
        each = np.zeros(n)
        np.add.at(each, g.rows, abs(g.values).sum(axis=1))
        size += float((of.measures * each**2).max() * abs(loading.tangent).max())
    if part != "material" and len(G.rows):
        each = np.zeros(n)
        np.add.at(each, G.rows, abs(G.values).sum(axis=(1, 2)))
        size += float(each.max() * abs(loading.sigma).max())
    terms = max(len(g.rows), len(G.rows)) / n
    return float(2.0**-52 * terms * size / of.masses.min())
