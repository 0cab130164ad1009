"""Vertices of cells that are one point but for rounding, as where four cells of a square lattice meet, made one."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from rkverify.solid.kernel_values import Array
from rkverify.solid.touched_facets import split_at_corners

ROUNDING = 64 * np.finfo(float).eps
"""Vertices of well-shaped cells are rounded by a few units of the coordinates' size; more only where triangles are thin."""


def without_coincident(
    vertices: Array, ends: Array, sides: Array, first_corner: int, size: float
) -> tuple[Array, Array, Array]:
    """Vertices, ends (F, 2) and sides of facets in the plane, without those that have no length, for coordinates of some size.

    Of coincident vertices the last one stays, so that corners of the domain, from number first_corner on, are not moved.
    """
    tolerance = ROUNDING * size
    ends, sides, joined = split_at_corners(vertices, ends, sides, first_corner, tolerance)
    a, b = ends[:, 0], ends[:, 1]
    x, y = np.ascontiguousarray(vertices[:, 0]), np.ascontiguousarray(vertices[:, 1])
    short = (abs(x[a] - x[b]) <= tolerance) & (abs(y[a] - y[b]) <= tolerance)
    if not short.any() and not len(joined):
        return vertices, ends, sides
    stands_for = representatives(np.concatenate([ends[short], joined]), len(vertices))
    ends = stands_for[ends]
    kept = ends[:, 0] != ends[:, 1]
    ends, sides = ends[kept], sides[kept]
    used = np.zeros(len(vertices), dtype=bool)
    used[ends] = True
    return vertices[used], (np.cumsum(used) - 1)[ends], sides


def representatives(joined: Array, count: int) -> Array:
    """For each of `count` vertices the last of those that pairs (P, 2) join to it."""
    touched, pairs = np.unique(joined, return_inverse=True)
    pairs = pairs.reshape(joined.shape)
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(touched), len(touched)))
    groups, label = connected_components(graph, directed=False)
    last = np.zeros(groups, dtype=np.int64)
    np.maximum.at(last, label, touched)
    stands_for = np.arange(count)
    stands_for[touched] = last[label]
    return stands_for
