"""Voronoi cells in three dimensions, cut off at the sides of a box.

The cells of the nodes and of four points far outside (they own no point of the box) come from Qhull, which makes one vertex
of cospherical nodes; the facets are then cut at one side of the box after the other.
"""

import numpy as np
from scipy.spatial import Voronoi

from rkverify.errors import CoincidentNodes
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import shown
from rkverify.solid.coincident_vertices import ROUNDING, representatives
from rkverify.solid.cut_facets import Facets, cut
from rkverify.solid.domain import Box
from rkverify.solid.kernel_values import Array

FAR = 4.0 / np.sqrt(3)
"""The far points' coordinates in half-diagonals of the box: at distance 4 from its middle every point of it is nearer to a node."""


def space_cells(positions: Array, domain: Box) -> Cells:
    """The Voronoi cells of nodes at positions (N, 3) in the box; nodes are inside it and not coincident."""
    middle, half = (domain.low + domain.high) / 2, np.linalg.norm(domain.high - domain.low) / 2
    count = len(positions)
    far = FAR * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    found = Voronoi(np.concatenate([(positions - middle) / half, far]))
    _refuse_left_out(positions, found)
    pairs = np.sort(found.ridge_points, axis=1)
    near = pairs[:, 0] < count
    loops = [loop for loop, chosen in zip(found.ridge_vertices, near.tolist(), strict=True) if chosen]
    sides = np.where(pairs[near] < count, pairs[near], OUTSIDE)
    facets = Facets.of(middle + half * found.vertices, loops, sides)
    for axis in range(3):
        facets = cut(facets, axis, float(domain.low[axis]), -1)
        facets = cut(facets, axis, float(domain.high[axis]), 1)
    vertices = _polished(facets, positions, domain)
    return _assembled(_without_short_edges(facets, vertices, domain), positions)


def _refuse_left_out(positions: Array, found: Voronoi) -> None:
    seen = np.zeros(len(positions) + 4, dtype=bool)
    seen[found.ridge_points] = True
    left_out = np.flatnonzero(~seen)
    if len(left_out):
        node = int(left_out[0])
        distance = ((positions - positions[node]) ** 2).sum(axis=1)
        distance[node] = np.inf
        first, second = sorted([node, int(np.argmin(distance))])
        raise CoincidentNodes(
            f"nodes {first} and {second} are both at ({shown(positions[node])}), to rounding: remove or move one of them"
        )


def _polished(facets: Facets, positions: Array, domain: Box) -> Array:
    """The vertices (V, 3) moved onto the bisector planes of their facets, in the sides of the box that they are on.

    One least-squares correction: Qhull's vertices carry the rounding of far points and of the lifting.
    """
    vertices = facets.vertices
    fixed = (vertices == domain.low) | (vertices == domain.high)
    inner = facets.sides[:, 1] != OUTSIDE
    of_facet = np.repeat(np.arange(len(inner)), np.diff(facets.starts))
    seen = inner[of_facet]
    corner, pair = facets.corners[seen], facets.sides[of_facet[seen]]
    apart = positions[pair[:, 1]] - positions[pair[:, 0]]
    normal = apart / np.linalg.norm(apart, axis=1)[:, None]
    v = vertices[corner]
    miss = (normal * ((positions[pair[:, 0]] - v) + (positions[pair[:, 1]] - v))).sum(axis=1) / 2
    normal = np.where(fixed[corner], 0.0, normal)
    matrix, right = np.zeros((len(vertices), 3, 3)), np.zeros((len(vertices), 3))
    for a in range(3):
        right[:, a] = np.bincount(corner, normal[:, a] * miss, len(vertices))
        for b in range(3):
            matrix[:, a, b] = np.bincount(corner, normal[:, a] * normal[:, b], len(vertices))
    # A direction that the planes do not determine stays as it is.
    matrix += np.where(fixed, 1.0, 1e-13)[:, :, None] * np.eye(3)
    moved: Array = vertices + np.linalg.solve(matrix, right[:, :, None])[:, :, 0]
    return moved


def _without_short_edges(facets: Facets, vertices: Array, domain: Box) -> Facets:
    """Coincident vertices are one, corners of the box first; facets that have fewer than three are none."""
    following = facets.following()
    tolerance = ROUNDING * max(abs(bound).max() for bound in domain.bounds)
    short = (abs(vertices[facets.corners] - vertices[following]) <= tolerance).all(axis=1)
    stands_for = np.arange(len(vertices))
    if short.any():
        on_sides = ((vertices == domain.low) | (vertices == domain.high)).sum(axis=1)
        rank = np.empty(len(vertices), dtype=np.int64)
        order = np.argsort(on_sides, kind="stable")
        rank[order] = np.arange(len(vertices))
        joined = np.stack([facets.corners[short], following[short]], axis=1)
        stands_for = order[representatives(rank[joined], len(vertices))[rank]]
    return facets.relabelled(vertices, stands_for)


def _assembled(facets: Facets, positions: Array) -> Cells:
    """Areas (1/2) sum (v_k - v_0) x (v_(k+1) - v_0), turned out of the first cell, and measures (1/3) sum (v_0 - x_L) . A."""
    v, starts = facets.vertices, facets.starts[:-1]
    first = np.repeat(facets.corners[starts], np.diff(facets.starts))
    origin = v[first]
    parts = np.cross(v[facets.corners] - origin, v[facets.following()] - origin) / 2
    areas = np.add.reduceat(parts, starts, axis=0)
    i, j = facets.sides.T
    inner = j != OUTSIDE
    place = v[facets.corners[starts]]
    onto = np.where(inner[:, None], positions[j] - positions[i], place - positions[i])
    flux = np.stack([(areas * onto).sum(axis=1), (areas * facets.outward).sum(axis=1)])
    turn = np.where(inner, flux[0], flux[1]) < 0
    areas[turn] *= -1
    corners = facets.turned(turn)
    shares = ((place - positions[i]) * areas).sum(axis=1) / 3
    measures = np.bincount(i, shares, len(positions))
    j, place, areas_in = j[inner], place[inner], areas[inner]
    measures -= np.bincount(j, ((place - positions[j]) * areas_in).sum(axis=1) / 3, len(positions))
    return Cells(v, facets.starts, corners, facets.sides, areas, measures)
