"""Zero-energy modes: motions other than rigid translations that no cell sees as a strain."""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.lattices import Lattice
from rkverify.stability.bloch.linearised import Linearised
from rkverify.stability.bloch.symbol import strain_waves
from rkverify.stability.bloch.zones import commensurate


@dataclass(frozen=True)
class ZeroModes:
    """For wave vectors k (M, 2): how many modes have no strain (M,), translations left out; the least and the largest
    singular value of the strains of the others (1/length); and what rounding leaves of one that is zero.
    """

    k: Array
    counts: Array
    least: float
    largest: float
    rounding: float

    @property
    def count(self) -> int:
        """The number of zero-energy modes."""
        return int(self.counts.sum())


def strains(of: Linearised, k: Array) -> Array:
    """sqrt(a_L/a) times the strains of cell L, (M, 3n, 2n), e_xx, e_yy and 2^(1/2) e_xy; 1/length.

    Its squared singular values are twice the energy over mu = 1, with lambda = 0, which no motion with a strain escapes.
    """
    n, b = len(of), strain_waves(of, k) * np.sqrt(of.measures / of.measures.mean())[None, :, None, None]
    E = np.zeros((len(k), n, 3, n, 2), complex)
    E[:, :, 0, :, 0], E[:, :, 1, :, 1] = b[..., 0], b[..., 1]
    E[:, :, 2, :, 0], E[:, :, 2, :, 1] = b[..., 1] / 2**0.5, b[..., 0] / 2**0.5
    return E.reshape(len(k), 3 * n, 2 * n)


def zero_modes(of: Linearised, lattice: Lattice, count: int) -> ZeroModes:
    """Modes without strain among all that fit into count by count periods.

    A singular value is known to 2^-52 times the terms of a sum of b, twice for the moment matrices, times their sizes.
    """
    k = commensurate(lattice, count)
    values = np.linalg.svd(strains(of, k), compute_uv=False)
    sizes = np.zeros(len(of))
    np.add.at(sizes, of.gradients.rows, abs(of.gradients.values).sum(axis=1))
    noise = float(2 * 2.0**-52 * len(of.gradients.rows) * sizes.max())
    zero = values <= noise
    counts = zero.sum(axis=1)
    counts[0] -= 2  # rigid translations
    others = values[~zero]
    return ZeroModes(k, counts, float(others.min()), float(others.max()), noise)
