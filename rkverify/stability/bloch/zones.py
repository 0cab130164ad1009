"""Wave vectors: Brillouin zones, grids that fit a periodic cell, and the largest growth over them."""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.lattices import Lattice
from rkverify.stability.bloch.linearised import Linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.symbol import Part, modes


def commensurate(lattice: Lattice, count: int) -> Array:
    """The wave vectors (count^d, d) of waves that fit into count periods along each axis, k = 0 first."""
    steps = _grid(np.arange(count), lattice.dimension)
    return steps / count @ lattice.reciprocal


def into_zone(lattice: Lattice, k: Array) -> Array:
    """The equivalent wave vectors (M, d) nearest to k = 0."""
    shifts = _grid(np.arange(-2, 3), lattice.dimension) @ lattice.reciprocal
    k = k - np.round(k @ lattice.periods.T / (2 * np.pi)) @ lattice.reciprocal
    all_of = k[:, None] + shifts
    lengths = np.round((all_of**2).sum(axis=2), 9)
    return np.asarray(all_of[np.arange(len(k)), lengths.argmin(axis=1)])


def _grid(values: Array, dimension: int) -> Array:
    return np.stack(np.meshgrid(*[values] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension)


@dataclass(frozen=True)
class Worst:
    """The largest growth (1/time) over wave vectors, and where it is (d,), rad/length."""

    growth: float
    k: Array


def worst(of: Linearised, loading: Loading, k: Array, part: Part = "total") -> Worst:
    """The fastest growing wave among those with wave vectors k (M, d)."""
    found = modes(of, loading, k, part).growth.max(axis=1)
    # equally fast ones differ by rounding: the first of them is named
    at = int(np.argmax(found >= found.max() * (1 - 1e-9)))
    return Worst(float(found.max()), k[at])
