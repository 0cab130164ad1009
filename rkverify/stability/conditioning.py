"""How well the stiffness B^T A B of smoothed gradients is conditioned: its eigenvalues are A times squared singular values.

The bar is linear with unit modulus; B (cells, nodes) are the smoothed gradients (52), A the lengths of the cells.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.kernels import kernel
from rkverify.solid.kernel_values import Array
from rkverify.solid.line import line
from rkverify.stability.lagrangian import StretchedBar, bar

NO_MODE = 1e-12
"""Singular values below are zeros: rounding leaves about the number of nodes times 1e-16 of them."""


@dataclass(frozen=True)
class Spectrum:
    """Eigenvalues of the stiffness, ascending, without its zeros; and how many zeros there are."""

    eigenvalues: Array
    zeros: int

    @property
    def condition(self) -> float:
        """The largest over the smallest nonzero eigenvalue."""
        return float(self.eigenvalues[-1] / self.eigenvalues[0])


def _spectrum(B: Array, lengths: Array) -> Spectrum:
    # Singular values of sqrt(A) B keep twice the digits that eigenvalues of B^T A B would.
    values = np.sort(np.linalg.svd(np.sqrt(lengths)[:, None] * B, compute_uv=False))
    kept = values[values > NO_MODE * values[-1]]
    return Spectrum(kept**2, len(values) - len(kept))


def periodic_spectrum(support_ratio: str, count: int, kernel_name: str = "cubic") -> Spectrum:
    """The Lagrangian bar with SCNI on a periodic lattice of `count` nodes with spacing 1."""
    one = bar(StretchedBar(support_ratio, "scni", kernel=kernel_name), count)
    return _spectrum(one.gradients, np.ones(count))


def irregular_spectrum(support: float, count: int, shift: float, seed: int, kernel_name: str = "cubic") -> Spectrum:
    """A free bar of `count` nodes with spacing 1, each moved by up to `shift`; cells end half-way between nodes."""
    x = np.arange(count) + shift * np.random.default_rng(seed).uniform(-1, 1, count)
    edges = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    Psi = line(edges[:, None] - x[None, :], np.full(count, support), kernel(kernel_name), 1).shape()
    lengths = np.diff(edges)
    return _spectrum((Psi[1:] - Psi[:-1]) / lengths[:, None], lengths)
