"""Figure 2: which nodes are under a kernel before and after a motion, by both distance measures of (26)."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import pi
from typing import Any

import numpy as np
import shapely

from rkverify.arithmetic.base import Scalar
from rkverify.certify.motions import Motion, Path
from rkverify.certify.pictures.block import Block, squared
from rkverify.paper.approximation import Vector
from rkverify.solid.kernel_values import Array

Row = dict[str, Any]
CORNERS = 2400
"""Of the polygon that stands for a circle of radius a: off it by at most a (pi/2400)^2/2 = 1e-6 a."""


def members(places: Sequence[Vector], centre: Vector, support: Fraction) -> set[int]:
    """The nodes J with |x_J - x_I| < a, decided on exact squares."""
    return {J for J, place in enumerate(places) if squared(place, centre) < support**2}


@dataclass(frozen=True)
class Places:
    """Exact places of the nodes before a motion, after it, and found back from there."""

    X: list[Vector]
    x: list[Vector]
    back: list[Vector]

    def members(self, I: int, support: Fraction) -> tuple[set[int], set[int], set[int]]:
        """The nodes under the kernel of node I before, and after: Lagrangian, by back(x), and semi-Lagrangian, by x   (26)."""
        before, lagrangian, semi = (members(places, places[I], support) for places in (self.X, self.back, self.x))
        return before, lagrangian, semi


def moved(block: Block, at: Motion) -> Places:
    """The places of the block's nodes in a motion."""
    x = [at.forth(X) for X in block.nodes]
    return Places(block.nodes, x, [at.back(place) for place in x])


def word(node: int, before: set[int], after: set[int]) -> str:
    """What became of a node: kept, lost, gained, or outside before and after."""
    if node in before:
        return "kept" if node in after else "lost"
    return "gained" if node in after else "outside"


def memberships(block: Block, centre: int, at: Motion) -> list[Row]:
    """For each node its places before and after, and what became of it in both supports of the node `centre`."""
    places = moved(block, at)
    before, lagrangian, semi = places.members(centre, block.support)
    return [
        {
            "node": J,
            **_coordinates((*X, *x)),
            "lagrangian": word(J, before, lagrangian),
            "semi_lagrangian": word(J, before, semi),
        }
        for J, (X, x) in enumerate(zip(places.X, places.x, strict=True))
    ]


def _coordinates(places: Sequence[Scalar]) -> Row:
    return dict(zip(("X1", "X2", "x1", "x2"), map(float, places), strict=True))


def counts(block: Block, centre: int, paths: Sequence[Path], times: Sequence[Fraction]) -> list[Row]:
    """Kept, lost and gained nodes in every motion and at every time, of one node's supports and of all nodes' together.

    image_differs counts the nodes for which the image of the circle about X_I, as a polygon, says otherwise than X = back(x).
    """
    rows = []
    for path in paths:
        for t in times:
            places = moved(block, path(t))
            each = [_count(block, I, path, t, places) for I in range(len(block.nodes))]
            everyone = {key: sum(row[key] for row in each) for key in each[0]}
            for name, row in (("one", each[centre]), ("all", everyone)):
                rows.append({"motion": path(t).name, "time": str(t), "centres": name, **row})
    return rows


def _count(block: Block, I: int, path: Path, t: Fraction, places: Places) -> Row:
    before, *after = places.members(I, block.support)
    row = {"before": len(before)}
    for kind, now in zip(("lagrangian", "semi"), after, strict=True):
        row |= {f"{kind}_{change}": len(part) for change, part in _changes(before, now).items()}
    polygon = shapely.Polygon(image(block, I, path, t))
    shapely.prepare(polygon)
    inside = shapely.contains_xy(polygon, np.array(places.x, dtype=float))
    return row | {"image_differs": len(set(np.flatnonzero(inside).tolist()) ^ after[0])}


def _changes(before: set[int], now: set[int]) -> dict[str, set[int]]:
    return {"kept": before & now, "lost": before - now, "gained": now - before}


def image(block: Block, centre: int, path: Path, t: Fraction, corners: int = CORNERS) -> Array:
    """The image (n, 2) of points of the circle |X - X_I| = a under the motion, in double precision."""
    angle = 2 * pi * np.arange(corners) / corners
    X = [float(c) for c in block.nodes[centre]]
    a = float(block.support)
    return np.stack(path(float(t)).forth((X[0] + a * np.cos(angle), X[1] + a * np.sin(angle))), axis=1)


def shapes(block: Block, centre: int, path: Path, times: Sequence[Fraction]) -> list[Row]:
    """The Lagrangian support in the deformed plane: largest and smallest distance of its edge from x_I over a, area over pi a^2."""
    rows = []
    for t in times:
        edge = image(block, centre, path, t)
        x = np.array(path(t).forth(block.nodes[centre]), dtype=float)
        distance = np.linalg.norm(edge - x, axis=1) / float(block.support)
        area = shapely.Polygon(edge).area / (pi * float(block.support) ** 2)
        rows.append({"time": str(t), "longest": distance.max(), "shortest": distance.min(), "area": area})
    return rows


def outlines(block: Block, centre: int, path: Path, t: Fraction, corners: int, lines: int) -> list[Row]:
    """Curves to draw, before and after: the edge of the Lagrangian support, the block's edge, material lines across it."""
    end = float(block.half)
    along = np.linspace(-end, end, corners)
    curves: list[tuple[str, Array, Array]] = []
    for k, c in enumerate(np.linspace(-end, end, lines)):
        kind = "edge" if k in (0, lines - 1) else "line"
        curves += [(kind, along, np.full(corners, c)), (kind, np.full(corners, c), along)]
    ring = image(block, centre, path, Fraction(0), 2 * corners)
    curves.append(("support", *np.vstack([ring, ring[:1]]).T))
    rows = []
    for number, (kind, X1, X2) in enumerate(curves):
        x1, x2 = path(float(t)).forth((X1, X2))
        for places in zip(X1, X2, x1, x2, strict=True):
            rows.append({"curve": number, "kind": kind, **_coordinates(places)})
    return rows
