"""Somebody's polygons as nodal cells, as they are: nothing is moved, and gaps or overlaps stay."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from rkverify.errors import BadInput
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import shown
from rkverify.solid.kernel_values import Array
from rkverify.solid.polygon_rings import checked_ring, on_one_line, refuse_crossings, ring_area

COINCIDENT = 1e-9
"""Vertices closer than this, relative to the size of all, are one: coordinates come from text."""


def polygon_cells(rings_of_cells: Sequence[Sequence[Any]]) -> Cells:
    """Cells from their rings (n, 2), for each cell the outline first; facets are edges that two cells share, or are OUTSIDE.

    Rings may have any orientation: one that is inside an odd number of the cell's other rings is a hole, any other is a
    piece. Two cells share an edge if its end points coincide (COINCIDENT); an edge that has a vertex of another cell in its
    middle is not shared. Raises BadInput, naming cell and ring, for fewer than three vertices, a value that is not finite,
    edges that cross, a cell without area, an edge that two cells have on the same side (they overlap) or no cells.

    >>> polygon_cells([[[(0, 0), (1, 0), (1, 1), (0, 1)]], [[(1, 0), (2, 0), (2, 1), (1, 1)]]]).sides[:, 1].tolist()
    [-1, 1, -1, -1, -1, -1, -1]
    """
    if len(rings_of_cells) == 0:
        raise BadInput("there are no cells: give the rings of at least one")
    empty = [L for L, rings in enumerate(rings_of_cells) if len(rings) == 0]
    if empty:
        raise BadInput(f"cell {empty[0]} has no rings: give its outline")
    checked = [
        [checked_ring(ring, f"ring {r} of cell {L}") for r, ring in enumerate(rings)]
        for L, rings in enumerate(rings_of_cells)
    ]
    turned = _turned(checked)
    rings = [ring for cell in turned for ring in cell]
    cell = np.repeat(np.arange(len(turned)), [sum(map(len, cell)) for cell in turned])
    points = np.concatenate(rings)
    sizes = np.array([len(ring) for ring in rings])
    following = np.arange(1, len(points) + 1)
    following[np.cumsum(sizes) - 1] -= sizes
    vertices, label = _merged(points)
    a, b = label, label[following]
    collapsed = np.flatnonzero(a == b)
    if len(collapsed):
        e = collapsed[0]
        raise BadInput(f"cell {cell[e]} has an edge of no length but rounding at ({shown(points[e])}): remove it")
    from_first = vertices[label] - vertices[label[np.searchsorted(cell, cell)]]
    onward = vertices[b] - vertices[a]
    measures = np.bincount(cell, from_first[:, 0] * onward[:, 1] - from_first[:, 1] * onward[:, 0]) / 2
    kept, second = _shared(a, b, cell, vertices)
    areas = np.stack([onward[kept, 1], -onward[kept, 0]], axis=1)
    ends, sides = np.stack([a[kept], b[kept]], axis=1), np.stack([cell[kept], second], axis=1)
    return Cells(vertices, 2 * np.arange(len(ends) + 1), ends.ravel(), sides, areas, measures)


def _turned(cells: list[list[Array]]) -> list[list[Array]]:
    """The rings of every cell, pieces counter-clockwise and holes clockwise, after a look for what cannot be."""
    rings = [ring for cell in cells for ring in cell]
    simple = shapely.is_simple(
        shapely.linearrings(
            np.concatenate(rings), indices=np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
        )
    )
    ring_number = 0
    found = []
    for L, rings in enumerate(cells):
        area = [ring_area(ring) for ring in rings]
        ok = simple[ring_number : ring_number + len(rings)].all()
        ring_number += len(rings)
        if len(rings) > 1 or not ok or on_one_line(rings[0]):
            refuse_crossings(rings, f"of cell {L}")
        hole = _holes(rings) if len(rings) > 1 else [False]
        found.append([ring if (A > 0) != h else ring[::-1] for ring, A, h in zip(rings, area, hole, strict=True)])
    return found


def _holes(rings: list[Array]) -> list[bool]:
    """Whether a ring is inside an odd number of the others; they do not cross."""
    polygons = [shapely.Polygon(ring) for ring in rings]
    return [sum(other.contains(own) for other in polygons if other is not own) % 2 == 1 for own in polygons]


def _merged(points: Array) -> tuple[Array, Array]:
    """Different vertices (V, 2), and which of them each point (P, 2) is."""
    near = cKDTree(points).query_pairs(COINCIDENT * np.ptp(points, axis=0).max(), output_type="ndarray")
    graph = coo_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(points), len(points)))
    count, label = connected_components(graph, directed=False)
    first = np.empty(count, dtype=np.int64)
    first[label[::-1]] = np.arange(len(points))[::-1]
    return points[first], label


def _shared(a: Array, b: Array, cell: Array, vertices: Array) -> tuple[Array, Array]:
    """The edges that are facets, and the cell on their other side; what a cell shares with itself is none."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    order = np.lexsort((high, low))
    new = np.ones(len(a), dtype=bool)
    new[1:] = (np.diff(low[order]) != 0) | (np.diff(high[order]) != 0)
    first = np.flatnonzero(new)
    times = np.diff(np.append(first, len(a)))
    e = order[first]
    f = order[np.minimum(first + 1, len(a) - 1)]
    bad = np.flatnonzero((times > 2) | ((times == 2) & (a[e] == a[f])))
    if len(bad):
        g = bad[0]
        place = f"from ({shown(vertices[a[e[g]]])}) to ({shown(vertices[b[e[g]]])})"
        raise BadInput(f"cells {cell[e[g]]} and {cell[f[g]]} are on the same side of the edge {place}: they overlap")
    second = np.where(times == 2, cell[f], OUTSIDE)
    kept = np.flatnonzero(second != cell[e])
    kept = kept[np.argsort(e[kept])]
    return e[kept], second[kept]
