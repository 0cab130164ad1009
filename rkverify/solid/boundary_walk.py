"""The nodes to which the points of a domain's boundary are nearest, found by walking along it from cell to cell.

Along an edge A + t d the squared distance to node i less that to node j is linear in t, so that the owners of the edge
are the lower envelope of lines; with a Delaunay triangulation the next owner is among the neighbours of the present one.
The owners around a ring are a closed walk on the triangulation. Its winding number about every triangle, 1 or 0, says
whether the triangle's circumcentre is inside; it is a whole number by construction, so that no rounding can make the
cells of two nodes contradict each other.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.solid.compiling import compiled
from rkverify.solid.kernel_values import Array

PARALLEL = 1e-12
"""A bisector that leaves an edge by less than this, in radians, is parallel to it: along the edge the two cells tie."""


@dataclass(frozen=True)
class Walk:
    """What is met along the rings, in order: corners (k >= 0 in `corner`) and steps (below 0) across edge `side` of `triangle`.

    A step of corner -1 is where the nodes' bisector meets the domain's edge; one of corner -2, onto the node inside where
    that bisector runs along the edge, is at the place met before.
    owner: the node that owns the boundary from there on; before: the one up to there; edge: the first corner of the
    domain's edge; turn: where in its ring a ring starts anew (R + 1,).
    """

    corner: Array
    triangle: Array
    side: Array
    before: Array
    owner: Array
    edge: Array
    turn: Array


@compiled
def _nearest(
    x: Array, triangles: Array, neighbours: Array, one_triangle: Array, start: int, px: float, py: float
) -> int:
    """The node nearest to a point: the one of which no neighbour is nearer."""
    best = start
    least = (x[best, 0] - px) ** 2 + (x[best, 1] - py) ** 2
    while True:
        here, first = best, one_triangle[best]
        t = first
        while True:
            k = 0 if triangles[t, 0] == here else (1 if triangles[t, 1] == here else 2)
            j = triangles[t, (k + 1) % 3]
            distance = (x[j, 0] - px) ** 2 + (x[j, 1] - py) ** 2
            if distance < least:
                best, least = j, distance
            t = neighbours[t, (k + 1) % 3]
            if t == first:
                break
        if best == here:
            return best


@compiled
def _next_owner(
    x: Array,
    triangles: Array,
    neighbours: Array,
    first: int,
    i: int,
    count: int,
    px: float,
    py: float,
    dx: float,
    dy: float,
) -> tuple[int, int, bool]:
    """The triangle and its edge to the neighbour that is the first to be as near to A + t d, t <= 1, as node i; or -1.

    Of two nodes that are as near all along, the one inside owns the edge, or the other one would have a piece without
    area there: the third result says that it takes over at once.
    """
    least, at, side = 2.0, -1, -1
    long = np.hypot(dx, dy)
    t = first
    while True:
        k = 0 if triangles[t, 0] == i else (1 if triangles[t, 1] == i else 2)
        j = triangles[t, (k + 1) % 3]
        if j < count:
            ax, ay = x[j, 0] - x[i, 0], x[j, 1] - x[i, 1]
            slope, apart = ax * dx + ay * dy, np.hypot(ax, ay)
            above = ax * ((x[j, 0] - px) + (x[i, 0] - px)) + ay * ((x[j, 1] - py) + (x[i, 1] - py))
            if abs(slope) <= PARALLEL * long * apart:
                if abs(above) <= PARALLEL * apart and dx * ay - dy * ax > 0:
                    return t, (k + 2) % 3, True
            elif slope > 0:
                where = above / (2 * slope)
                if where <= 1 and where < least:
                    least, at, side = where, t, (k + 2) % 3
        t = neighbours[t, (k + 1) % 3]
        if t == first:
            return at, side, False


@compiled
def _walk(
    x: Array, triangles: Array, neighbours: Array, one_triangle: Array, count: int, corners: Array, starts: Array
) -> tuple[Array, Array]:
    room = 8 * len(corners) + 64
    met = np.empty((room, 6), dtype=np.int64)
    turn = np.zeros(len(starts), dtype=np.int64)
    n = 0
    owner = 0
    for r in range(len(starts) - 1):
        a, b = starts[r], starts[r + 1]
        owner = _nearest(x, triangles, neighbours, one_triangle, owner, corners[a, 0], corners[a, 1])
        for _ in range(3):
            # Where several nodes are as near to the first corner, the ring may come back to another one: begin with that.
            n, began = turn[r], owner
            for c in range(a, b):
                after = c + 1 if c + 1 < b else a
                px, py = corners[c, 0], corners[c, 1]
                dx, dy = corners[after, 0] - px, corners[after, 1] - py
                at, side, before, corner = -1, -1, owner, c
                while True:
                    if n == room:
                        room *= 2
                        more = np.empty((room, 6), dtype=np.int64)
                        more[:n] = met
                        met = more
                    met[n, 0], met[n, 1], met[n, 2] = corner, at, side
                    met[n, 3], met[n, 4], met[n, 5] = before, owner, c
                    n += 1
                    at, side, at_once = _next_owner(
                        x, triangles, neighbours, one_triangle[owner], owner, count, px, py, dx, dy
                    )
                    if at < 0:
                        break
                    corner, before = -2 if at_once else -1, owner
                    owner = triangles[at, (side + 2) % 3]
            if owner == began:
                break
        if owner != began:
            turn[r + 1] = -1
            return met[:n], turn
        turn[r + 1] = n
    return met[:n], turn


def walk(x: Array, triangles: Array, neighbours: Array, count: int, rings: tuple[Array, ...]) -> Walk:
    """Walk along rings (n, 2) among the first `count` of the points x (P, 2) of a triangulation; the others are too far to own anything."""
    one_triangle = np.empty(len(x), dtype=triangles.dtype)
    for k in range(3):
        one_triangle[triangles[:, k]] = np.arange(len(triangles), dtype=triangles.dtype)
    starts = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])])
    met, turn = _walk(x, triangles, neighbours, one_triangle, count, np.concatenate(rings), starts)
    if (turn < 0).any():
        raise AssertionError("the owners of a ring do not close")
    corner, triangle, side, before, owner, edge = np.ascontiguousarray(met.T)
    return Walk(corner, triangle, side, before, owner, edge, turn)


@compiled
def winding(neighbours: Array, net: Array, outer: int) -> Any:
    """The winding number of the walk about every triangle (T,): zero about `outer`, and changed by `net` (T, 3) across each edge.

    The second result says whether the numbers are the same all ways round. net[t, k] is how often the walk crosses edge k of triangle t with t on its left, less how often with t on its right.
    """
    number = np.zeros(len(neighbours), dtype=np.int8)
    seen = np.zeros(len(neighbours), dtype=np.bool_)
    stack = np.empty(len(neighbours), dtype=np.int64)
    stack[0], n = outer, 1
    seen[outer] = True
    while n:
        n -= 1
        t = stack[n]
        for k in range(3):
            s = neighbours[t, k]
            if s < 0:
                continue
            value = number[t] - net[t, k]
            if not seen[s]:
                number[s], seen[s] = value, True
                stack[n] = s
                n += 1
            elif number[s] != value:
                return number, False
    return number, True
