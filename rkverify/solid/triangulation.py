"""Delaunay triangulations of points in the plane."""

import numpy as np
from scipy.spatial import Delaunay

from rkverify.solid.kernel_values import Array


def triangulated(x: Array) -> tuple[Array, Array]:
    """Triangles (T, 3), counter-clockwise, and their neighbours (T, 3) opposite to each vertex, -1 for none."""
    done = Delaunay(x)
    return done.simplices.astype(np.int64), done.neighbors.astype(np.int64)
