"""What small wave numbers should give: the acoustic tensor of a continuum under initial stress."""

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.lattices import Lattice
from rkverify.stability.bloch.linearised import Linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.symbol import stiffness


def acoustic_tensor(loading: Loading, k: Array) -> Array:
    """A_ip(k) = T_ijpq k_j k_q, (M, d, d), with T of sigma' = T : L; density times 1/time^2 for density 1.

    The nominal stress adds sigma tr L - sigma L^T, whose divergence is zero where sigma is uniform. With Truesdell's rate
    A = (lambda + mu) k k + (mu |k|^2 + k.sigma.k) 1: the initial stress only adds k.sigma.k to both speeds squared.
    """
    return np.einsum("ijkl,mj,ml->mik", loading.tangent, k, k)


def long_wave_defect(of: Linearised, lattice: Lattice, loading: Loading, direction: Array, step: float = 0.02) -> Array:
    """lim (K(k)/a - A(k))/|k|^2 along a direction (d,), for one node in a period, (d, d): stress.

    From |k| = step and step/2: the limit's error is of order step^4.
    """
    k = np.outer([step, step / 2], direction / np.linalg.norm(direction))
    off = stiffness(of, loading, k)[:, 0, :, 0].real / lattice.measure - acoustic_tensor(loading, k)
    at, at_half = off / (k**2).sum(axis=1)[:, None, None]
    return np.asarray((4 * at_half - at) / 3)
