"""Cells in the plane as closed loops of vertices, in order: what is written to tables and drawn."""

import numpy as np

from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.kernel_values import Array
from rkverify.solid.polygon_rings import ring_area


def rings(cells: Cells, L: int) -> list[Array]:
    """The closed loops (n, 2) of cell L: pieces counter-clockwise, then holes clockwise, each from its lowest vertex in x, then y, on.

    The last vertex is not repeated. Loops are in the order of their first vertices. Pieces that touch in a point are loops
    of their own. For many cells at once `all_rings` is faster.
    """
    first, second = np.flatnonzero(cells.sides[:, 0] == L), np.flatnonzero(cells.sides[:, 1] == L)
    ends = cells.corners.reshape(-1, 2)
    return _loops(cells.vertices, np.concatenate([ends[first], ends[second][:, ::-1]]))


def all_rings(cells: Cells) -> list[list[Array]]:
    """`rings` of every cell."""
    ends = cells.corners.reshape(-1, 2)
    inner = cells.sides[:, 1] != OUTSIDE
    directed = np.concatenate([ends, ends[inner][:, ::-1]])
    cell = np.concatenate([cells.sides[:, 0], cells.sides[inner, 1]])
    order = np.argsort(cell, kind="stable")
    parts = np.split(directed[order], np.cumsum(np.bincount(cell, minlength=len(cells)))[:-1])
    return [_loops(cells.vertices, part) for part in parts]


def _loops(vertices: Array, edges: Array) -> list[Array]:
    onward: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        onward.setdefault(a, []).append(b)
    found = []
    while onward:
        start = next(iter(onward))
        loop = [start]
        before, here = start, _taken(onward, start, None, vertices)
        while here != start:
            loop.append(here)
            before, here = here, _taken(onward, here, before, vertices)
        found.append(vertices[loop])
    turned = [np.roll(ring, -int(np.lexsort(ring.real.T[::-1])[0]), axis=0) for ring in found]
    return sorted(turned, key=lambda ring: (ring_area(ring).real < 0, *ring[0].real))


def _taken(onward: dict[int, list[int]], here: int, before: int | None, vertices: Array) -> int:
    """The next vertex; where loops touch, the one that keeps to the piece on the left: first clockwise from where we came."""
    choices = onward[here]
    at = 0
    if len(choices) > 1 and before is not None:
        direction = [np.arctan2(*(vertices[v] - vertices[here]).real[::-1]) for v in [before, *choices]]
        at = int(np.argmin([(direction[0] - other) % (2 * np.pi) or 2 * np.pi for other in direction[1:]]))
    chosen = choices.pop(at)
    if not choices:
        del onward[here]
    return chosen
