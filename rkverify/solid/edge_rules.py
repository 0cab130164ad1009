"""Rules by which a function is averaged over facets of cells: points, straight edges, plane polygons.

The mean of f over facet F is sum_q w_q f(x_q) with sum_q w_q = 1. Every rule is exact for linear f, which is all that the
sums of smoothed gradients need; the rules differ for everything else.

    trapezoid   half of each end of an edge. On a polygon: the triangles between the mean of its corners and its sides, f at
                that mean being the mean of f at the corners, so that no point but the corners is visited.
    midpoint    the middle of an edge, the centroid of a polygon.
    gauss:N     N Gauss points on an edge, N by N on each of the same triangles; exact for polynomials of degree 2 N - 1.

On a point, the facet of a cell in one dimension, all of them are the value there.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.special import roots_jacobi, roots_legendre

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.cells import Cells
from rkverify.solid.kernel_values import Array

EDGE_RULES = ("trapezoid", "midpoint", "gauss:N")
MOST_POINTS = 100
"""Up to this N are the Gauss points of the libraries in use tested by their authors."""


@dataclass(frozen=True)
class FacetRule:
    """Means over F facets: points (Q, d), and entries (E,) of point, facet and weight, the weights of a facet having sum 1.

    A point that several facets share, such as a vertex, is listed once. Units: length; weights are numbers.
    """

    points: Array
    point: Array
    facet: Array
    weights: Array
    facets: int

    def matrix(self) -> sp.csr_array:
        """The means of all facets from values at the points, (F, Q)."""
        shape = (self.facets, len(self.points))
        return sp.csr_array(sp.coo_array((self.weights, (self.facet, self.point)), shape=shape))


def facet_rule(cells: Cells, rule: str = "trapezoid") -> FacetRule:
    """The rule of that name on all facets of the cells; vertices may be complex.

    Raises UnknownName for another rule than trapezoid, midpoint or gauss:N, BadInput for an N that is not offered.
    """
    means, count = _known(rule)
    return means(_Facets(cells), count)


class _Facets:
    """Corners of all facets in one row (C,), and for each the next one around its facet."""

    def __init__(self, cells: Cells) -> None:
        self.dimension = cells.dimension
        used, self.corners = np.unique(cells.corners, return_inverse=True)
        self.vertices = cells.vertices[used]  # a vertex that no facet has might lie where nothing is defined
        self.counts = np.diff(cells.starts)
        self.facets = len(self.counts)
        self.facet = np.repeat(np.arange(self.facets), self.counts)
        self.first, self.last = cells.starts[:-1], cells.starts[1:] - 1
        following = np.arange(1, len(self.corners) + 1)
        following[self.last] = self.first
        self.following = following

    @property
    def places(self) -> Array:
        return self.vertices[self.corners]

    def sums(self, values: Array) -> Array:
        """Sums over the corners of each facet, (C, …) -> (F, …)."""
        return np.add.reduceat(values, self.first, axis=0) if self.facets else values[:0]

    def fan(self) -> tuple[Array, Array]:
        """The mean of the corners (F, 3), and the share of each triangle mean, corner, next corner in the area (C,).

        Shares are signed, so that they have sum 1 on any plane polygon. A facet without area counts its triangles alike.
        """
        mean = self.sums(self.places) / self.counts[:, None]
        spoke = self.places - mean[self.facet]
        parts = np.cross(spoke, spoke[self.following])
        area = self.sums(parts)
        squared = (area * area).sum(axis=1)
        flat = squared.real <= 0
        shares = (parts * area[self.facet]).sum(axis=1) / np.where(flat, 1.0, squared)[self.facet]
        return mean, np.where(flat[self.facet], 1 / self.counts[self.facet], shares)


def _trapezoid(f: _Facets, _: int) -> FacetRule:
    if f.dimension < 3:
        return FacetRule(f.vertices, f.corners, f.facet, 1 / f.counts[f.facet], f.facets)
    shares = f.fan()[1]
    at_next = np.empty_like(shares)
    at_next[f.following] = shares
    weights = (shares + at_next) / 3 + 1 / (3 * f.counts[f.facet])
    return FacetRule(f.vertices, f.corners, f.facet, weights, f.facets)


def _midpoint(f: _Facets, _: int) -> FacetRule:
    if f.dimension < 3:
        points = f.sums(f.places) / f.counts[:, None]
    else:
        mean, shares = f.fan()
        thirds = (mean[f.facet] + f.places + f.places[f.following]) / 3
        points = f.sums(shares[:, None] * thirds)
    each = np.arange(f.facets)
    return FacetRule(points, each, each, np.ones(f.facets), f.facets)


def _gauss(f: _Facets, count: int) -> FacetRule:
    if f.dimension == 1:
        return _trapezoid(f, count)
    t, along = _unit_interval(count, 0)
    if f.dimension == 2:
        start, end = f.places[f.first][:, None], f.places[f.last][:, None]
        points = start + t[:, None] * (end - start)
        weights = np.tile(along, f.facets)
        facet = np.repeat(np.arange(f.facets), count)
    else:
        mean, shares = f.fan()
        r, outwards = _unit_interval(
            count, 1
        )  # the area of a strip of a triangle grows with the distance from the mean
        apex = mean[f.facet][:, None, None]
        side = f.places[:, None] + t[:, None] * (f.places[f.following] - f.places)[:, None]
        points = apex + r[:, None, None] * (side[:, None] - apex)
        weights = (shares[:, None, None] * outwards[:, None] * along).ravel()
        facet = np.repeat(f.facet, count * count)
    points = points.reshape(-1, f.dimension)
    return FacetRule(points, np.arange(len(points)), facet, weights, f.facets)


def _unit_interval(count: int, power: int) -> tuple[Array, Array]:
    """Gauss points and weights on [0, 1] for the density (power + 1) t^power, which has integral 1."""
    s, w = roots_jacobi(count, 0, power) if power else roots_legendre(count)
    return (1 + s) / 2, w / w.sum()


_RULES: dict[str, Callable[[_Facets, int], FacetRule]] = {"trapezoid": _trapezoid, "midpoint": _midpoint}


def _known(rule: str) -> tuple[Callable[[_Facets, int], FacetRule], int]:
    if rule in _RULES:
        return _RULES[rule], 0
    name, colon, count = rule.partition(":")
    if name != "gauss" or not colon or not (count.isascii() and count.isdigit()):
        raise UnknownName("edge rule", rule, EDGE_RULES)
    if not 1 <= int(count[:9]) <= MOST_POINTS:
        raise BadInput(f"edge rule {rule!r}: N is from 1 to {MOST_POINTS}")
    return _gauss, int(count)
