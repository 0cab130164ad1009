"""Facets of cells in the plane that touch a corner of the domain: in their middle, where they are made two, or at an end.

Where a bisector runs through a corner that points into the domain, the cell on the one side consists of two pieces that
touch there. Its loop would touch itself, and be no polygon to other programs. Rates of measures do not want the corner,
which stays where it is, on the bisector, which moves: a topology leaves such facets whole.
"""

import numpy as np

from rkverify.solid.cells import OUTSIDE
from rkverify.solid.kernel_values import Array


def split_at_corners(
    vertices: Array, ends: Array, sides: Array, first_corner: int, tolerance: float
) -> tuple[Array, Array, Array]:
    """Ends and sides (F, 2) of facets, split where a vertex of number first_corner or more of one of their cells is on them.

    The third result are pairs (P, 2) of a facet's end and a corner that are at the same place.
    """
    outer = sides[:, 1] == OUTSIDE
    at_corner = ends[outer] >= first_corner
    corner = ends[outer][at_corner]
    owner = np.broadcast_to(sides[outer, :1], at_corner.shape)[at_corner]
    order = np.argsort(owner)
    corner, owner = corner[order], owner[order]
    cornered = np.zeros(sides.max() + 1, dtype=bool)
    cornered[owner] = True
    near = np.flatnonzero(cornered[sides[:, 0]] & ~outer), np.flatnonzero(cornered[sides[:, 1]] & ~outer)
    pairs = [_joined(facets, sides[facets, side], corner, owner) for side, facets in enumerate(near)]
    facet, c = np.unique(np.concatenate(pairs), axis=0).T
    a, b, p = vertices[ends[facet, 0]], vertices[ends[facet, 1]], vertices[c]
    along, apart = b - a, p - a
    length = np.maximum(np.hypot(*along.T), tolerance)
    off = abs(along[:, 0] * apart[:, 1] - along[:, 1] * apart[:, 0]) / length
    t = (along * apart).sum(axis=1) / length
    same = [np.stack([ends[facet, k], c], axis=1)[np.hypot(*(p - v).T) <= tolerance] for k, v in enumerate((a, b))]
    joined = np.concatenate(same)
    joined = joined[joined[:, 0] != joined[:, 1]]
    on = np.flatnonzero((off <= tolerance) & (t > tolerance) & (t < length - tolerance))
    if not len(on):
        return ends, sides, joined
    on = on[np.lexsort((t[on], facet[on]))]
    kept = np.ones(len(ends), dtype=bool)
    kept[facet[on]] = False
    parts, cells = [], []
    for f in np.unique(facet[on]):
        chain = np.concatenate([ends[f, :1], c[on[facet[on] == f]], ends[f, 1:]])
        parts.append(np.stack([chain[:-1], chain[1:]], axis=1))
        cells.append(np.repeat(sides[f : f + 1], len(chain) - 1, axis=0))
    return np.concatenate([ends[kept], *parts]), np.concatenate([sides[kept], *cells]), joined


def _joined(facets: Array, cells: Array, corner: Array, owner: Array) -> Array:
    """All pairs (facet, corner) with the same cell; owner is sorted."""
    low, high = np.searchsorted(owner, cells, "left"), np.searchsorted(owner, cells, "right")
    count = high - low
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    return np.stack([np.repeat(facets, count), corner[np.repeat(low, count) + within]], axis=1)
