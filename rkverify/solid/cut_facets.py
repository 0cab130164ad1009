"""Facets of cells in space, and all of them cut off at a plane at once.

What lies outside is left out; an edge that crosses the plane gets one vertex there, whichever facets it belongs to; and the
new edges of each cell close to its facets in the plane. So cells stay closed whatever rounding does.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rkverify.solid.cells import OUTSIDE
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Facets:
    """Vertices (V, 3), loops of them in CSR form, cells (F, 2) and, for facets on the boundary, the outward normals (F, 3), else 0."""

    vertices: Array
    starts: Array
    corners: Array
    sides: Array
    outward: Array

    @staticmethod
    def of(vertices: Array, loops: Sequence[Sequence[int]], sides: Array) -> "Facets":
        """Facets inside, from lists of vertices in order around them."""
        corners = np.array([v for loop in loops for v in loop], dtype=np.int64)
        starts = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])])
        return Facets(vertices, starts, corners, sides, np.zeros((len(loops), 3)))

    def following(self) -> Array:
        """For every corner the next one around its facet."""
        after = np.arange(1, len(self.corners) + 1)
        after[self.starts[1:] - 1] = self.starts[:-1]
        return self.corners[after]

    def turned(self, turn: Array) -> Array:
        """The corners where the chosen facets (F,) go around the other way."""
        sizes = np.diff(self.starts)
        place = np.arange(len(self.corners))
        back = np.repeat(self.starts[:-1] + self.starts[1:] - 1, sizes) - place
        return self.corners[np.where(np.repeat(turn, sizes), back, place)]

    def chosen(self, keep: Array) -> "Facets":
        """Some facets (F,) of bool, all vertices."""
        sizes = np.diff(self.starts)
        starts = np.concatenate([[0], np.cumsum(sizes[keep])])
        return replace(
            self,
            starts=starts,
            corners=self.corners[np.repeat(keep, sizes)],
            sides=self.sides[keep],
            outward=self.outward[keep],
        )

    def relabelled(self, vertices: Array, stands_for: Array) -> "Facets":
        """The facets at other vertices, some of which (V,) stand for others; unused vertices and facets of fewer than three are left out."""
        renamed = replace(self, vertices=vertices, corners=stands_for[self.corners])
        kept = renamed.corners != renamed.following()
        starts = np.concatenate([[0], np.cumsum(np.add.reduceat(kept.astype(np.int64), self.starts[:-1]))])
        renamed = replace(renamed, starts=starts, corners=renamed.corners[kept])
        renamed = renamed.chosen(np.diff(starts) > 2)
        used = np.zeros(len(vertices), dtype=bool)
        used[renamed.corners] = True
        return replace(renamed, vertices=vertices[used], corners=(np.cumsum(used) - 1)[renamed.corners])

    def joined(self, loops: Sequence[Sequence[int]], sides: Sequence[tuple[int, int]], outward: Array) -> "Facets":
        """With more facets (M,)."""
        if not loops:
            return self
        more = Facets.of(self.vertices, loops, np.array(sides))
        return Facets(
            self.vertices,
            np.concatenate([self.starts, self.starts[-1] + more.starts[1:]]),
            np.concatenate([self.corners, more.corners]),
            np.concatenate([self.sides, more.sides]),
            np.concatenate([self.outward, outward]),
        )


def cut(facets: Facets, axis: int, place: float, sign: int) -> Facets:
    """The facets where sign (x_axis - place) <= 0, with those that close the cells in the plane."""
    vertices = facets.vertices.copy()
    beyond = sign * (vertices[:, axis] - place)
    # On the plane but for rounding is on it.
    on = abs(beyond) <= 16 * np.finfo(float).eps * max(abs(place), np.ptp(facets.vertices[:, axis]) * 1e-3)
    vertices[on, axis] = place
    out = (beyond > 0) & ~on
    outside = np.add.reduceat(out[facets.corners].astype(np.int64), facets.starts[:-1])
    crossing = (outside > 0) & (outside < np.diff(facets.starts))
    crossed = facets.chosen(crossing)
    new: dict[tuple[int, int], int] = {}
    loops = []
    edges: dict[int, list[tuple[int, int]]] = {}
    flags = out.tolist()
    corners, starts = crossed.corners.tolist(), crossed.starts.tolist()
    for f, (i, j) in enumerate(crossed.sides.tolist()):
        loop = corners[starts[f] : starts[f + 1]]
        kept, met = [], []
        for a, b in zip(loop, loop[1:] + loop[:1], strict=True):
            if not flags[a]:
                kept.append(a)
            if flags[a] != flags[b]:
                v = new.setdefault((min(a, b), max(a, b)), len(vertices) + len(new))
                kept.append(v)
                met.append((v, flags[b]))
        loops.append(kept)
        if not met[0][1]:
            met = met[1:] + met[:1]
        for leaves, enters in zip(met[::2], met[1::2], strict=True):
            for cell in (i, j):
                if cell != OUTSIDE:
                    edges.setdefault(cell, []).append((leaves[0], enters[0]))
    whole = replace(facets.chosen(outside == 0), vertices=_with_crossings(vertices, new, axis, place))
    done = whole.joined(loops, crossed.sides.tolist(), crossed.outward)
    caps = [(cell, loop) for cell, segments in edges.items() for loop in _closed(segments)]
    normal = np.zeros((len(caps), 3))
    normal[:, axis] = sign
    return done.joined([loop for _, loop in caps], [(cell, OUTSIDE) for cell, _ in caps], normal)


def _with_crossings(vertices: Array, new: dict[tuple[int, int], int], axis: int, place: float) -> Array:
    if not new:
        return vertices
    a, b = np.array(list(new)).T
    u, v = vertices[a], vertices[b]
    t = (place - u[:, axis]) / (v[:, axis] - u[:, axis])
    points = u + t[:, None] * (v - u)
    points[:, axis] = place
    return np.concatenate([vertices, points])


def _closed(segments: list[tuple[int, int]]) -> list[list[int]]:
    """The closed loops of edges (a, b) of either direction; in each vertex two edges meet."""
    at: dict[int, list[int]] = {}
    for a, b in segments:
        at.setdefault(a, []).append(b)
        at.setdefault(b, []).append(a)
    loops = []
    while at:
        start, choices = next(iter(at.items()))
        loop, here = [start], choices.pop()
        at[here].remove(start)
        while here != start:
            loop.append(here)
            before, here = here, at[here].pop()
            at[here].remove(before)
        loops.append(loop)
        at = {v: others for v, others in at.items() if others}
    return loops
