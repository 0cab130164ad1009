"""Nodal vectors (N, d) and the flat vectors (d N,) on which matrices act, component after component."""

import numpy as np

from rkverify.solid.kernel_values import Array


def flat(values: Array) -> Array:
    """(N, d) -> (d N,)."""
    return np.ravel(values.T)


def nodal(vector: Array, dimension: int) -> Array:
    """(d N,) -> (N, d)."""
    return np.reshape(vector, (dimension, -1)).T
