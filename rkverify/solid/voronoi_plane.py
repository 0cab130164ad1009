"""Voronoi cells in the plane, cut off at the rings of a domain, as a topology: edges first, no cell is ever clipped by itself.

A Delaunay triangulation with three points more, far outside, makes every cell bounded; those points own no point of the
domain. The edge between the cells of two neighbours goes from one circumcentre to another along their bisector. It enters
and leaves the domain where the walk along the boundary steps from one of the two nodes to the other, and its ends are
inside or outside as their winding numbers say: as many beginnings as ends, paired in order.
"""

from dataclasses import dataclass, replace

import numpy as np

from rkverify.errors import CoincidentNodes
from rkverify.solid.boundary_walk import Walk, walk, winding
from rkverify.solid.cell_topology import Topology, bisected
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.cloud import shown
from rkverify.solid.domain import Box, Domain
from rkverify.solid.kernel_values import Array
from rkverify.solid.triangulation import triangulated

FAR = 4.0
"""The far points' distance from the middle, in half-diagonals r of the domain: every point of it is nearer to a node (2 r)."""


def plane_topology(positions: Array, domain: Box | Domain) -> Topology:
    """The topology of the Voronoi cells of nodes at positions (N, 2) in the domain; nodes are inside it and not coincident."""
    low, high = domain.bounds
    middle, half = (low + high) / 2, np.hypot(*(high - low)) / 2
    count = len(positions)
    angle = np.array([0.5, 0.5 + 2 / 3 * np.pi, 0.5 + 4 / 3 * np.pi])
    far = FAR * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    x = np.concatenate([(positions - middle) / half, far])
    triangles, neighbours, doubled = triangulated(x)
    if doubled >= 0:
        _refuse_doubled(positions, doubled)
    rings = tuple((ring - middle) / half for ring in domain.rings)
    met = walk(x, triangles, neighbours, count, rings)
    return _topology(x, triangles, neighbours, met, domain.rings, np.concatenate(rings))


def _refuse_doubled(positions: Array, node: int) -> None:
    distance = ((positions - positions[node]) ** 2).sum(axis=1)
    distance[node] = np.inf
    first, second = sorted([node, int(np.argmin(distance))])
    raise CoincidentNodes(
        f"nodes {first} and {second} are both at ({shown(positions[node])}), to rounding: remove or move one of them"
    )


@dataclass(frozen=True)
class _Edges:
    """Edges between the cells of two nodes, each known by its triangle of lower number and the edge there; T triangles.

    inside: the winding numbers (T,); key: 3 t + k.
    """

    triangles: Array
    neighbours: Array
    inside: Array

    def cells(self, key: Array) -> Array:
        """The two nodes (E, 2); triangle t is on the left from the first to the second, beyond the end of the cells' edge."""
        t, k = np.divmod(key, 3)
        return np.stack([self.triangles[t, (k + 1) % 3], self.triangles[t, (k + 2) % 3]], axis=1)

    def ends(self, key: Array) -> Array:
        """The two triangles (E, 2) from whose circumcentre and to whose the cells' edge goes, with the first cell on its left."""
        t, k = np.divmod(key, 3)
        return np.stack([self.neighbours[t, k], t], axis=1)


def _topology(
    x: Array, triangles: Array, neighbours: Array, met: Walk, rings: tuple[Array, ...], corners: Array
) -> Topology:
    step = met.corner < 0
    t, k = met.triangle[step], met.side[step]
    s = neighbours[t, k]
    twin = np.argmax(neighbours[s] == t[:, None], axis=1)
    # The walk steps from triangles[t, k + 1] to triangles[t, k + 2], with t on its left.
    net = np.zeros(triangles.shape, dtype=np.int8)
    np.add.at(net, (t, k), 1)
    np.add.at(net, (s, twin), -1)
    outer = int(np.flatnonzero((neighbours < 0).any(axis=1))[0])
    inside, closed = winding(neighbours, net, outer)
    if not closed:
        raise AssertionError("the owners of the boundary are no closed walk")
    edges = _Edges(triangles, neighbours, inside)
    enters = t < s
    key = np.where(enters, 3 * t + k, 3 * s + twin)

    points = np.concatenate(rings)
    along = np.concatenate([np.roll(ring, -1, axis=0) - ring for ring in rings])
    formula = met.corner == -1
    lines = met.edge[formula]
    pairs = np.stack([met.before[formula], met.owner[formula]], axis=1)
    t = bisected(x[pairs[:, 0]], x[pairs[:, 1]], corners[lines], along[lines])
    place = corners[met.corner]
    place[formula] = corners[lines] + t[:, None] * along[lines]
    vertex = np.where(formula, len(triangles) + np.cumsum(formula) - 1, len(triangles) + len(pairs) + met.corner)
    had = np.maximum.accumulate(np.where(met.corner == -2, 0, np.arange(len(vertex))))
    place, vertex = place[had][step], vertex[had]
    first, second = edges.cells(key).T
    turned = x[second] - x[first]
    depth = place[:, 1] * turned[:, 0] - place[:, 0] * turned[:, 1]

    whole, parted = _whole_and_parted(edges, key)
    parts, of_edge = _parts(edges, parted, (key, enters, vertex[step], depth))
    after = np.arange(1, len(vertex) + 1)
    after[met.turn[1:] - 1] = met.turn[:-1]
    outer_ends = np.stack([vertex, vertex[after]], axis=1)
    outer_sides = np.stack([met.owner, np.full(len(vertex), OUTSIDE)], axis=1)
    there = vertex != vertex[after]
    ends = [edges.ends(whole), parts, outer_ends[there]]
    sides = [edges.cells(whole), edges.cells(of_edge), outer_sides[there]]
    return _without_unused(
        Topology(
            triangles,
            pairs,
            points[lines],
            along[lines],
            points,
            np.concatenate(ends),
            np.concatenate(sides),
            np.empty(0),
        )
    )


def _without_unused(found: Topology) -> Topology:
    """Without the circumcentres that are outside the domain; all other vertices are the end of a facet."""
    count = len(found.simplices)
    used = np.ones(count + len(found.pairs) + len(found.fixed), dtype=bool)
    used[:count] = False
    used[found.ends] = True
    return replace(found, simplices=found.simplices[used[:count]], ends=(np.cumsum(used) - 1)[found.ends])


def _whole_and_parted(edges: _Edges, crossed: Array) -> tuple[Array, Array]:
    """The edges that are inside from end to end, and those that the walk crosses."""
    count = len(edges.triangles)
    once = (edges.neighbours > np.arange(count, dtype=edges.neighbours.dtype)[:, None]).ravel()
    once &= np.repeat(edges.inside != 0, 3)
    parted = np.unique(crossed)
    once[parted] = False
    whole = np.flatnonzero(once)
    more = whole[edges.inside[whole // 3] != 1]
    return (whole, parted) if not len(more) else (np.setdiff1d(whole, more), np.union1d(parted, more))


def _parts(edges: _Edges, parted: Array, steps: tuple[Array, Array, Array, Array]) -> tuple[Array, Array]:
    """The parts (P, 2) of edges that are inside: what enters the domain, in order along each edge, with what leaves it, and their edges.

    The edge's own ends enter and leave as often as they are wound about; where rounding has put two crossings in the wrong
    order their part is turned round, with a length of rounding.
    """
    key, enters, vertex, depth = steps
    ends = edges.ends(parted)
    begin, end = edges.inside[ends[:, 0]].astype(np.int64), edges.inside[ends[:, 1]].astype(np.int64)
    chosen = []
    for enter in (True, False):
        here = enters == enter
        first, last = (begin, -end) if enter else (-begin, end)
        first, last = np.maximum(first, 0), np.maximum(last, 0)
        of = np.concatenate([np.repeat(parted, first), key[here], np.repeat(parted, last)])
        v = np.concatenate([np.repeat(ends[:, 0], first), vertex[here], np.repeat(ends[:, 1], last)])
        at = np.concatenate([np.full(first.sum(), -np.inf), depth[here], np.full(last.sum(), np.inf)])
        order = np.lexsort((at, of))
        chosen.append((v[order], of[order]))
    (start, of_edge), (stop, _) = chosen
    return np.stack([start, stop], axis=1), of_edge
