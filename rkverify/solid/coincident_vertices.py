"""Vertices of cells that are one point but for rounding, as where four cells of a square lattice meet, made one."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from rkverify.solid.domain import Box, Domain
from rkverify.solid.kernel_values import Array

ROUNDING = 64 * np.finfo(float).eps
"""Vertices of well-shaped cells are rounded by a few units of the coordinates' size; more only where triangles are thin."""


def without_coincident(vertices: Array, ends: Array, sides: Array, domain: Box | Domain) -> tuple[Array, Array, Array]:
    """Vertices, ends (F, d) and sides of facets without those in the plane that have no length.

    Of coincident vertices the last one stays, so that corners of the domain are not moved.
    """
    if ends.shape[1] == 1:
        return vertices, ends, sides
    size = max(abs(bound).max() for bound in domain.bounds)
    a, b = ends[:, 0], ends[:, 1]
    x, y = np.ascontiguousarray(vertices[:, 0]), np.ascontiguousarray(vertices[:, 1])
    short = (abs(x[a] - x[b]) <= ROUNDING * size) & (abs(y[a] - y[b]) <= ROUNDING * size)
    if not short.any():
        return vertices, ends, sides
    stands_for = representatives(ends[short], len(vertices))
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
