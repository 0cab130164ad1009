"""Closed rings of vertices in the plane: area, and what makes a ring unusable."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely

from rkverify.errors import BadInput
from rkverify.solid.cloud import shown
from rkverify.solid.kernel_values import Array

ON_ONE_LINE = 1e-12
"""A ring whose vertices are nearer to a line than this, relative to its length, has no area but rounding."""


def ring_area(ring: Array) -> Any:
    """(1/2) sum_k x_k x x_(k+1), positive counter-clockwise, of a ring (n, 2), real or complex."""
    x, y = (ring - ring[0]).T
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


def on_one_line(ring: Array) -> bool:
    """Whether all vertices of a ring (n, 2) are on one line, but for rounding."""
    x, y = (ring - ring[0]).T
    far = np.argmax(np.hypot(x, y))
    return bool(abs(x * y[far] - y * x[far]).max() <= ON_ONE_LINE * (x[far] ** 2 + y[far] ** 2))


def checked_ring(ring: Any, name: str) -> Array:
    """A ring (n, 2) of doubles without the repeated last vertex; raises BadInput that begins with its name."""
    try:
        points = np.array(ring, dtype=float)
    except (ValueError, TypeError):
        raise BadInput(f"{name} is no table of numbers: give x and y for each vertex") from None
    if points.ndim != 2 or points.shape[1] != 2:
        raise BadInput(f"{name} has shape {points.shape}: give (n, 2), x and y for each vertex")
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(bad):
        raise BadInput(f"{name} has vertex {bad[0]} at ({shown(points[bad[0]])}): every coordinate must be finite")
    if len(points) > 1 and (points[0] == points[-1]).all():
        points = points[:-1]
    if len(points) < 3:
        raise BadInput(f"{name} has {len(points)} different vertices: give three or more")
    same = np.flatnonzero((points == np.roll(points, -1, axis=0)).all(axis=1))
    if len(same):
        raise BadInput(f"{name} has vertex {same[0]} at ({shown(points[same[0]])}) twice in a row: remove one of them")
    return points


def refuse_crossings(rings: Sequence[Array], name: str) -> None:
    """Raise BadInput, naming rings and vertices, where edges of rings cross, or a ring has no area; touching is fine between rings."""
    for r, ring in enumerate(rings):
        if on_one_line(ring):
            raise BadInput(f"ring {r} {name} has no area: its vertices are on one line, from ({shown(ring[0])}) on")
    starts = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])])
    ends = np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])
    of_ring = np.repeat(np.arange(len(rings)), np.diff(starts))
    segments = shapely.linestrings(ends)
    first, second = shapely.STRtree(segments).query(segments, predicate="intersects")
    first, second = first[first < second], second[first < second]
    size = np.diff(starts)[of_ring[first]]
    alike = of_ring[first] == of_ring[second]
    neighbours = alike & ((second - first == 1) | (second - first == size - 1))
    shared = shapely.intersection(segments[first], segments[second])
    # Neighbouring edges share a vertex and no more; edges of two rings may touch but not cross or run along each other.
    along = shapely.length(shared) > 0
    crossing = shapely.crosses(segments[first], segments[second])
    bad = np.flatnonzero(along | (alike & ~neighbours) | (~alike & crossing))
    if len(bad):
        f, s = first[bad[0]], second[bad[0]]
        r, q = of_ring[f], of_ring[s]
        place = shown(shapely.get_coordinates(shared[bad[0]])[0])
        met = (
            f"the edge from its vertex {s - starts[q]}"
            if r == q
            else f"the edge from vertex {s - starts[q]} of ring {q}"
        )
        raise BadInput(
            f"ring {r} {name} is not simple: its edge from vertex {f - starts[r]} meets {met} at ({place}): separate them"
        )
