"""Cells as topology, found in real arithmetic, and vertex formulas, which accept complex node positions.

In d = 1 or 2 dimensions a vertex of a cell is the point at equal distances of k + 1 nodes on d - k lines of the
boundary: a circumcentre (k = d), the point of a bisector on an edge of the domain, or a corner of the domain. So the
cells of nodes that have moved a little are a formula, and can be differentiated by complex steps.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Topology:
    """Which nodes and which parts of the domain's boundary make every vertex, and which vertices every facet.

    Vertices are numbered through: equidistant ones of `simplices` (T, d + 1) nodes, in two dimensions those of `pairs`
    (C, 2) of nodes on the lines through `line_points` (C, 2) along `line_directions` (C, 2), then `fixed` (K, d). Facets
    have the vertices `ends` (F, d), d = 1 or 2, and the cells `sides` (F, 2); in two dimensions the first cell is on the
    left from the first end to the second. `signs` (F,) are the area vectors in one dimension.
    """

    simplices: Array
    pairs: Array
    line_points: Array
    line_directions: Array
    fixed: Array
    ends: Array
    sides: Array
    signs: Array

    def vertices(self, positions: Array) -> Array:
        """The vertices (V, d) for nodes at positions (N, d), real or complex."""
        if positions.shape[1] == 1:
            middles = (positions[self.simplices[:, 0]] + positions[self.simplices[:, 1]]) / 2
            return np.concatenate([middles, self.fixed])
        centres = circumcentres(positions, self.simplices)
        i, j = positions[self.pairs[:, 0]], positions[self.pairs[:, 1]]
        t = bisected(i, j, self.line_points, self.line_directions)
        return np.concatenate([centres, self.line_points + t[:, None] * self.line_directions, self.fixed])


def moved(topology: Topology, positions: Array) -> Cells:
    """The cells with the same topology for nodes at positions (N, d), d = 1 or 2, real or complex.

    They tile the domain for any positions (measures may become negative); they are the Voronoi cells as long as no edge
    has turned round.
    """
    return assembled(positions, topology.vertices(positions), topology.ends, topology.sides, topology.signs)


def assembled(positions: Array, vertices: Array, ends: Array, sides: Array, signs: Array) -> Cells:
    """Cells from facets with ends (F, d) that have their first cell on the left; every vertex is the end of a facet."""
    areas, measures = (
        _plane(positions, vertices, ends, sides)
        if ends.shape[1] == 2
        else _line(positions, vertices, ends, sides, signs)
    )
    return Cells(vertices, np.arange(len(ends) + 1) * ends.shape[1], ends.ravel(), sides, areas, measures)


def _line(positions: Array, vertices: Array, ends: Array, sides: Array, signs: Array) -> tuple[Array, Array]:
    areas = signs[:, None].astype(vertices.dtype)
    place = vertices[ends[:, 0], 0]
    inner = sides[:, 1] != OUTSIDE
    measures = np.zeros(len(positions), dtype=vertices.dtype)
    np.add.at(measures, sides[:, 0], areas[:, 0] * (place - positions[sides[:, 0], 0]))
    other = sides[inner, 1]
    np.add.at(measures, other, -areas[inner, 0] * (place[inner] - positions[other, 0]))
    return areas, measures


def _plane(positions: Array, vertices: Array, ends: Array, sides: Array) -> tuple[Array, Array]:
    """Area vectors and (1/2) sum (v_1 - x_L) x (v_2 - x_L) over the edges of every cell."""
    x, y = np.ascontiguousarray(vertices[:, 0]), np.ascontiguousarray(vertices[:, 1])
    nx, ny = np.ascontiguousarray(positions[:, 0]), np.ascontiguousarray(positions[:, 1])
    a, b = ends[:, 0], ends[:, 1]
    xa, ya = x[a], y[a]
    dx, dy = x[b] - xa, y[b] - ya
    first, second = sides[:, 0], sides[:, 1]
    inner = np.flatnonzero(second != OUTSIDE)
    n = len(positions)
    share = ((xa - nx[first]) * dy - (ya - ny[first]) * dx) / 2
    measures = _summed(first, share, n)
    second, xa, ya = second[inner], xa[inner], ya[inner]
    share = ((xa - nx[second]) * dy[inner] - (ya - ny[second]) * dx[inner]) / 2
    return np.stack([dy, -dx], axis=1), measures - _summed(second, share, n)


def _summed(rows: Array, values: Array, count: int) -> Array:
    if np.iscomplexobj(values):
        return np.bincount(rows, values.real, count) + 1j * np.bincount(rows, values.imag, count)
    return np.bincount(rows, values, count)


def circumcentres(positions: Array, triangles: Array) -> Array:
    """The points at equal distances of three nodes (T, 2), from differences so that only they are rounded."""
    x, y = np.ascontiguousarray(positions[:, 0]), np.ascontiguousarray(positions[:, 1])
    i, j, k = triangles.T
    xi, yi = x[i], y[i]
    ax, ay, bx, by = x[j] - xi, y[j] - yi, x[k] - xi, y[k] - yi
    a, b = ax * ax + ay * ay, bx * bx + by * by
    twice = 2 * (ax * by - ay * bx)
    return np.stack([xi + (by * a - ay * b) / twice, yi + (ax * b - bx * a) / twice], axis=1)


def bisected(first: Array, second: Array, points: Array, directions: Array) -> Array:
    """t with point + t direction at equal distances of two nodes, all (C, 2): (C,)."""
    apart = second - first
    above: Array = (apart * ((second - points) + (first - points))).sum(axis=1)
    return above / (2 * (apart * directions).sum(axis=1))
