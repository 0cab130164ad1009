"""Convex polytopes in one, two and three dimensions: corners, facets with area vectors, measure."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, product

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput
from rkverify.paper.approximation import Vector
from rkverify.paper.kernel_rates import dot, minus

Facet = tuple[int, ...]


@dataclass(frozen=True)
class Polytope:
    """Corners (d,) in units of length, facets as numbers of corners, and for each facet what lies beyond it.

    A facet is a point, left before right, in one dimension; the start and the end of an edge, counter-clockwise about the
    polygon, in two; the corners of a polygon, counter-clockwise seen from outside, in three. beyond: the number of the
    node on its other side, None on the boundary of the domain. parting: corners where more facets meet than must, and
    that move: a side without length may come or go there.
    """

    corners: tuple[Vector, ...]
    facets: tuple[Facet, ...]
    beyond: tuple[int | None, ...]
    parting: tuple[Vector, ...] = ()

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return len(self.corners[0])

    def places(self, f: int) -> list[Vector]:
        """The corners of facet f, in order."""
        return [self.corners[c] for c in self.facets[f]]

    def area(self, f: int) -> Vector:
        """N dGamma integrated over facet f: its outward normal times its area, its length, or 1 in one dimension."""
        places = self.places(f)
        if self.dimension == 1:
            one = 1 + 0 * places[0][0]
            return (one,) if f else (-one,)
        if self.dimension == 2:
            along = minus(places[1], places[0])
            return (along[1], -along[0])
        return area_of_polygon(places)

    def cone(self, f: int, apex: Vector) -> Scalar:
        """The measure of the cone from the apex over facet f: (X - apex).N over d times its area, for any X on it."""
        return dot(minus(self.places(f)[0], apex), self.area(f)) / self.dimension

    @property
    def measure(self) -> Scalar:
        """A_L = int dOmega = (1/d) int X.N dGamma, by the divergence theorem, X counted from a corner."""
        cones = [self.cone(f, self.corners[0]) for f in range(len(self.facets))]
        return sum(cones[1:], cones[0])


def cross(u: Vector, w: Vector) -> Vector:
    """u x w in three dimensions."""
    return (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])


def area_of_polygon(places: Sequence[Vector]) -> Vector:
    """The area vector of a plane polygon in space: half the sum of (p_k - p_0) x (p_k+1 - p_0)."""
    first = places[0]
    parts = [cross(minus(p, first), minus(q, first)) for p, q in pairwise(places[1:])]
    return tuple(sum((part[j] for part in parts[1:]), parts[0][j]) / 2 for j in range(3))


def box(low: Sequence[Scalar], high: Sequence[Scalar], K: Arithmetic) -> Polytope:
    """The interval, rectangle or box between two corners.

    Raises BadInput where it is empty.
    """
    ends = [(K.number(p), K.number(q)) for p, q in zip(low, high, strict=True)]
    if any(K.sign(q - p) <= 0 for p, q in ends):
        raise BadInput(f"the box from {tuple(low)} to {tuple(high)} is empty: give low below high on every axis")
    corners = tuple(product(*ends))
    # Numbered by the binary digits of their sides: 0 low, 1 high, the first axis first.
    facets: dict[int, tuple[Facet, ...]] = {
        1: ((0,), (1,)),
        2: ((0, 2), (2, 3), (3, 1), (1, 0)),
        3: ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)),
    }
    if len(ends) not in facets:
        raise BadInput(f"a box in {len(ends)} dimensions is not offered: choose 1, 2 or 3")
    found = facets[len(ends)]
    return Polytope(corners, found, (None,) * len(found))


def polygon(places: Sequence[Sequence[Scalar]], K: Arithmetic) -> Polytope:
    """The convex polygon with these corners (n, 2), counter-clockwise.

    Raises BadInput where a corner does not turn left.
    """
    corners = tuple(tuple(K.number(c) for c in place) for place in places)
    n = len(corners)
    for k, q in enumerate(corners):
        u, w = minus(q, corners[k - 1]), minus(corners[(k + 1) % n], q)
        if n < 3 or K.sign(u[0] * w[1] - u[1] * w[0]) <= 0:
            raise BadInput(
                f"corner {k} of the polygon at ({', '.join(map(K.text, q))}) does not turn left: give the corners of a "
                "convex polygon counter-clockwise"
            )
    return Polytope(corners, tuple((k, (k + 1) % n) for k in range(n)), (None,) * n)
