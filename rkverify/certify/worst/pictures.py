"""What is drawn of a worst case: nodes, the supports whose edges come nearest to the point, the point, cells; in a plane."""

from dataclasses import dataclass

import numpy as np

from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.file import read_cases
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import voronoi

NEAREST = 3
MARGIN = 0.05
STEP = 0.25
"""Between the segments that are supports on a line, in lengths of it."""


@dataclass(frozen=True, eq=False)
class Outline:
    """nodes, point (2, n) and (2, 0 or 1); supports: centres and radii, of squares or circles; lines (2, 2 or more) of cells' edges,

    or of supports on a line, and of the one cell that is measured; window: the ranges of the two axes. Lengths in the case's own unit.
    """

    nodes: Array
    point: Array
    supports: list[tuple[tuple[float, float], float]]
    square: bool
    edges: list[Array]
    cell: list[Array]
    window: tuple[tuple[float, float], tuple[float, float]]


def outline(name: str) -> Outline:
    """Of the committed case of that name; space is seen along the third axis, a line as one of ordinate 0."""
    case = next(case for case in read_cases() if case.name == name)
    nodes = _flat(case.nodes)
    point = _flat(case.array("point")[None]) if case.point is not None else np.zeros((2, 0))
    cell = [_closed(_flat(case.array("cell")))] if case.cell is not None else []
    edges = _cells(case)
    supports = _supports(case)
    on_line = case.dimension == 1
    if on_line:
        below = float(np.ptp(nodes[0]))
        edges = [np.array([[x - a, x + a], [-STEP * (k + 1) * below] * 2]) for k, ((x, _), a) in enumerate(supports)]
    reach = [np.array([[x - a, x + a], [y - a, y + a]]) for (x, y), a in ([] if on_line else supports)]
    everything = np.hstack([nodes, point, *cell, *edges, *reach])
    low, high = everything.min(axis=1), everything.max(axis=1)
    middle, half = (low + high) / 2, (0.5 + MARGIN) * float((high - low).max())
    window = tuple((float(m - half), float(m + half)) for m in middle)
    return Outline(
        nodes, point, [] if on_line else supports, case.window == "tensor", edges, cell, (window[0], window[1])
    )


def _flat(x: Array) -> Array:
    return np.vstack([x.T, np.zeros((1, len(x)))])[:2]


def _closed(ring: Array) -> Array:
    return np.hstack([ring, ring[:, :1]])


def _cells(case: WorstCase) -> list[Array]:
    if case.low is None or case.dimension != 2:
        return []
    cells = voronoi(case.nodes, case.box())
    ends = cells.corners.reshape(-1, 2)
    return [_flat(cells.vertices[pair]) for pair in ends]


def _supports(case: WorstCase) -> list[tuple[tuple[float, float], float]]:
    if case.point is None or case.supports is None:
        return []
    apart = abs(case.nodes - case.point)
    length = apart.max(axis=1) if case.window == "tensor" else np.sqrt((apart**2).sum(axis=1))
    chosen = np.argsort(abs(length / case.supports - 1))[:NEAREST]
    places = _flat(case.nodes[chosen])
    return [((float(x), float(y)), float(case.supports[J])) for (x, y), J in zip(places.T, chosen, strict=True)]
