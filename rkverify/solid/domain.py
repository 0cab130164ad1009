"""Domains Omega that nodal cells tile: a box in one, two or three dimensions, or a polygon that may have holes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from rkverify.errors import BadInput
from rkverify.solid.cloud import shown
from rkverify.solid.kernel_values import Array
from rkverify.solid.polygon_rings import checked_ring, refuse_crossings, ring_area

ON_BOUNDARY = 1e-9
"""A node this far outside, relative to the domain's size, counts as on the boundary: coordinates come from text, too."""


@dataclass(frozen=True)
class Box:
    """low_j <= x_j <= high_j, of d = 1, 2 or 3 dimensions; low, high (d,) in units of length."""

    low: Array
    high: Array

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return len(self.low)

    @property
    def measure(self) -> float:
        """prod_j (high_j - low_j)."""
        return float(np.prod(self.high - self.low))

    @property
    def bounds(self) -> tuple[Array, Array]:
        """The lowest and the highest coordinates (d,)."""
        return self.low, self.high

    @property
    def rings(self) -> tuple[Array, ...]:
        """The outline of a box in the plane, counter-clockwise."""
        (x0, y0), (x1, y1) = self.low, self.high
        return (np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]),)

    def contains(self, points: Array) -> Array:
        """Whether points (P, d) are in the box or, to ON_BOUNDARY, on its boundary."""
        slack = ON_BOUNDARY * (self.high - self.low).max()
        inside: Array = ((points.real >= self.low - slack) & (points.real <= self.high + slack)).all(axis=1)
        return inside


@dataclass(frozen=True)
class Domain:
    """A polygon: rings (n, 2), the outline first and counter-clockwise, holes after it and clockwise."""

    rings: tuple[Array, ...]

    @property
    def dimension(self) -> int:
        """2."""
        return 2

    @property
    def measure(self) -> float:
        """The outline's area without the holes'."""
        return float(sum(ring_area(ring) for ring in self.rings))

    @property
    def bounds(self) -> tuple[Array, Array]:
        """The lowest and the highest coordinates (2,)."""
        return self.rings[0].min(axis=0), self.rings[0].max(axis=0)

    def contains(self, points: Array) -> Array:
        """Whether points (P, 2) are in the domain or, to ON_BOUNDARY, on its boundary."""
        polygon = shapely.Polygon(self.rings[0], self.rings[1:])
        shapely.prepare(polygon)
        x = np.ascontiguousarray(points.real)
        inside: Array = shapely.contains_xy(polygon, x)
        rest = np.flatnonzero(~inside)
        low, high = self.bounds
        inside[rest] = shapely.distance(polygon, shapely.points(x[rest])) <= ON_BOUNDARY * (high - low).max()
        return inside


def box(low: Any, high: Any) -> Box:
    """The box between two opposite corners (d,), d = 1, 2, 3.

    Raises BadInput for another shape, a value that is not finite or high_j <= low_j.

    >>> box([0, 0], [2, 1]).measure
    2.0
    """
    a, b = (np.atleast_1d(np.asarray(corner, dtype=float)) for corner in (low, high))
    if a.shape != b.shape or a.ndim != 1 or len(a) not in (1, 2, 3):
        raise BadInput(
            f"the box's corners have the shapes {a.shape} and {b.shape}: give 1, 2 or 3 coordinates for each"
        )
    bad = np.flatnonzero(~(np.isfinite(a) & np.isfinite(b) & (b > a)))
    if len(bad):
        j = bad[0]
        raise BadInput(
            f"the box goes from {a[j]:.12g} to {b[j]:.12g} along axis {j}: give finite values, the lower first"
        )
    return Box(a, b)


def polygon_domain(rings: Sequence[Any]) -> Domain:
    """The domain inside its outline and outside its holes; rings (n, 2), outline first, in any orientation.

    A last vertex that repeats the first is dropped. Raises BadInput, naming ring and vertex, for fewer than three
    vertices, a value that is not finite, a repeated vertex, no area, edges that cross, a hole that is not inside the outline.

    >>> square, hole = [(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (2, 1), (2, 2), (1, 2)]
    >>> polygon_domain([square, hole]).measure
    15.0
    """
    if len(rings) == 0:
        raise BadInput("the domain has no ring: give its outline")
    checked = [checked_ring(ring, f"ring {r} of the domain") for r, ring in enumerate(rings)]
    turned = tuple(ring if (ring_area(ring) > 0) == (r == 0) else ring[::-1].copy() for r, ring in enumerate(checked))
    refuse_crossings(turned, "of the domain")
    outline = shapely.Polygon(turned[0])
    for r, ring in enumerate(turned[1:], start=1):
        out = np.flatnonzero(~shapely.intersects_xy(outline, ring))
        if len(out):
            place = f"vertex {out[0]} of ring {r} of the domain, at ({shown(ring[out[0]])}),"
            raise BadInput(f"{place} is outside the outline: a hole is inside it")
    for r, ring in enumerate(turned[1:], start=1):
        for other in range(1, r):
            if shapely.Polygon(ring).intersection(shapely.Polygon(turned[other])).area > 0:
                raise BadInput(f"rings {other} and {r} of the domain overlap: leave out a hole that is in another hole")
    return Domain(turned)


def checked_domain(domain: Domain | Box, dimension: int) -> None:
    """Raise BadInput where the domain has another number of dimensions than the nodes."""
    if domain.dimension != dimension:
        raise BadInput(
            f"the nodes have {dimension} coordinates and the domain {domain.dimension}: give both the same number"
        )


def refuse_outside(positions: Array, domain: Domain | Box) -> None:
    """Raise BadInput naming the first node (N, d) outside the domain; on the boundary is fine."""
    out = np.flatnonzero(~domain.contains(positions))
    if len(out):
        place = shown(positions[out[0]])
        raise BadInput(f"node {out[0]} at ({place}) is outside the domain: move it inside or onto the boundary")
