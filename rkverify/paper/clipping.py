"""A polytope cut by a half-space, in any arithmetic.

New corners lie on the sides that the cut crosses, by formulas that carry derivatives; which sides these are is decided
on witnesses, once for each corner. A corner whose distance from the cut rounding explains lies on it; but where positions
carry a change, as duals do, it counts as inside and may be met by a new corner: a side without length whose ends part,
as they must for the derivative of a cell where more than d + 1 meet in one point.
"""

from collections.abc import Sequence
from itertools import pairwise

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput
from rkverify.paper.approximation import Vector
from rkverify.paper.kernel_rates import dot, minus
from rkverify.paper.polytopes import Facet, Polytope

ROUNDINGS = 64
"""Units of rounding in the height of a corner: d differences and products, of corners from some cuts one after the other."""

NOT_CLOSED = (
    "rounding leaves no closed cell: more cells than there should be meet in one point, so move the nodes a little or "
    "choose arithmetic 'exact'"
)


def clip(P: Polytope, point: Vector, normal: Vector, beyond: int | None, K: Arithmetic) -> Polytope:
    """The part of P where (X - point) . normal <= 0; `beyond` lies on the other side of the new facet.

    Raises BadInput where nothing is left inside, or where rounding leaves no closed polyhedron.
    """
    cut = _Cut(P, point, normal, K)
    if max(cut.signs) <= 0:
        return P
    if min(cut.signs) >= 0:
        raise BadInput("a half-space leaves nothing of the polytope: take one that keeps a part of its inside")
    kept = {1: cut.interval, 2: cut.edges, 3: cut.polygons}[P.dimension](beyond)
    used = sorted({c for facet, _ in kept for c in facet})
    number = {c: k for k, c in enumerate(used)}
    return Polytope(
        tuple(cut.corners[c] for c in used),
        tuple(tuple(number[c] for c in facet) for facet, _ in kept),
        tuple(label for _, label in kept),
    )


def rounding_of_heights(corners: Sequence[Vector], point: Vector, normal: Vector, K: Arithmetic) -> float:
    """What rounding may make of (X - point) . normal = 0 at these corners."""
    reach = max(abs(K.witness(c)) for X in (*corners, point) for c in X)
    return ROUNDINGS * K.epsilon * float(reach) * sum(abs(float(K.witness(c))) for c in normal)


def changes(x: Scalar, K: Arithmetic) -> bool:
    """Whether x carries more than its witness."""
    return not K.is_zero(x - K.number(K.witness(x)))


class _Cut:
    """Corners with their heights over the cut; those that the cut makes have the sign 0."""

    def __init__(self, P: Polytope, point: Vector, normal: Vector, K: Arithmetic) -> None:
        self.P, self.corners = P, list(P.corners)
        self.heights = [dot(minus(X, point), normal) for X in P.corners]
        noise = rounding_of_heights(P.corners, point, normal, K)
        self.signs = [K.sign(h) if noise == 0 or abs(K.witness(h)) > noise else 0 for h in self.heights]
        if 0 in self.signs and any(changes(c, K) for X in (*P.corners, point, normal) for c in X):
            # The cut moved outwards by less than anything: that closes, whatever corners fall together.
            self.signs = [sign or -1 for sign in self.signs]
        self.made: dict[Facet, int] = {}

    def crossing(self, i: int, j: int) -> int:
        """The corner where the cut crosses the side between i and j, one for all facets that have this side."""
        p, q = sorted((i, j))
        if (p, q) not in self.made:
            share = self.heights[p] / (self.heights[p] - self.heights[q])
            start, end = self.corners[p], self.corners[q]
            self.corners.append(tuple(a + share * (b - a) for a, b in zip(start, end, strict=True)))
            self.signs.append(0)
            self.made[p, q] = len(self.corners) - 1
        return self.made[p, q]

    def left_of(self, i: int, j: int) -> Facet:
        """What the cut leaves of the side from corner i to corner j, as corners."""
        if self.signs[i] * self.signs[j] < 0:
            return (i, self.crossing(i, j)) if self.signs[i] < 0 else (self.crossing(i, j), j)
        return tuple(c for c in (i, j) if self.signs[c] <= 0)

    def interval(self, beyond: int | None) -> list[tuple[Facet, int | None]]:
        """The two ends, of which the one outside moves to the cut."""
        (i,), (j,) = self.P.facets
        left, right = self.left_of(i, j)
        labels = (beyond if self.signs[i] > 0 else self.P.beyond[0], beyond if self.signs[j] > 0 else self.P.beyond[1])
        return [((left,), labels[0]), ((right,), labels[1])]

    def inside(self) -> list[tuple[Facet, int | None]]:
        """The facets that have a corner strictly inside."""
        both = zip(self.P.facets, self.P.beyond, strict=True)
        return [(facet, label) for facet, label in both if any(self.signs[c] < 0 for c in facet)]

    def edges(self, beyond: int | None) -> list[tuple[Facet, int | None]]:
        """What is left of the edges, and one from where they leave the half-plane to where they enter it."""
        kept = [(self.left_of(*edge), label) for edge, label in self.inside()]
        leaves = [end for (_, end), _ in kept if self.signs[end] == 0]
        enters = [start for (start, _), _ in kept if self.signs[start] == 0]
        if len(leaves) != 1 or len(enters) != 1:
            raise BadInput(NOT_CLOSED)
        return [*kept, ((*leaves, *enters), beyond)]

    def polygons(self, beyond: int | None) -> list[tuple[Facet, int | None]]:
        """What is left of the polygons, and the one that their sides on the cut go around, the other way."""
        kept, rim = [], {}
        for facet, label in self.inside():
            way = [c for side in pairwise((*facet, facet[0])) for c in self.left_of(*side)]
            polygon = tuple(dict.fromkeys(way))
            kept.append((polygon, label))
            for i, j in pairwise((*polygon, polygon[0])):
                if self.signs[i] == 0 and self.signs[j] == 0:
                    rim[j] = i
        ring = list(rim)[:1]
        while ring and len(ring) < len(rim) and rim.get(ring[-1], ring[0]) != ring[0]:
            ring.append(rim[ring[-1]])
        if not ring or len(ring) < len(rim) or rim.get(ring[-1]) != ring[0]:
            raise BadInput(NOT_CLOSED)
        return [*kept, (tuple(ring), beyond)]
