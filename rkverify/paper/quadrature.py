"""Integrals over facets and cells as sums over points: the rules on Gamma_L that (14)-(17), (23), (47) leave open."""

from collections.abc import Iterable

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import NotDifferentiable, UnknownName
from rkverify.paper.approximation import Vector
from rkverify.paper.gauss import gauss_points
from rkverify.paper.kernel_rates import dot
from rkverify.paper.polytopes import Polytope, area_of_polygon

EDGE_RULES = ("trapezoid", "midpoint", "gauss:N")
Points = list[tuple[Vector, Scalar]]
"""Points with their weights."""


def mean_of(places: Iterable[Vector], weights: Iterable[Scalar]) -> Vector:
    """sum_k w_k x_k"""
    parts = [tuple(w * c for c in place) for place, w in zip(places, weights, strict=True)]
    return tuple(sum(c[1:], c[0]) for c in zip(*parts, strict=True))


def facet_points(P: Polytope, f: int, rule: str, K: Arithmetic) -> Points:
    """The mean over facet f: points and weights of sum 1, exact for linear functions.

    trapezoid: half of each end of an edge; on a polygon the triangles between the mean of its corners and its sides, the
    function at that mean being the mean of its values at the corners. midpoint: the middle, or centroid. gauss:N: N Gauss
    points on an edge, N by N on each of these triangles. On a point, all of them are the value there.

    Raises UnknownName for another rule, and as `gauss_points` does.
    """
    name, _, count = rule.partition(":")
    if not (rule in EDGE_RULES[:2] or (name == "gauss" and count.isascii() and count.isdigit())):
        raise UnknownName("edge rule", rule, EDGE_RULES)
    places = P.places(f)
    if P.dimension == 1:
        return [(places[0], K.number(1))]
    if P.dimension == 2:
        return _on_edge(places, name, int(count or 0), K)
    return _on_polygon(places, name, int(count or 0), K)


def _on_edge(places: list[Vector], name: str, count: int, K: Arithmetic) -> Points:
    half = K.ratio(1, 2)
    if name == "trapezoid":
        return [(place, half) for place in places]
    if name == "midpoint":
        return [(mean_of(places, (half, half)), K.number(1))]
    return [(mean_of(places, (1 - t, t)), w) for t, w in gauss_points(count, 0, K)]


def _on_polygon(places: list[Vector], name: str, count: int, K: Arithmetic) -> Points:
    n, third = len(places), K.ratio(1, 3)
    centre = mean_of(places, [K.ratio(1, n)] * n)
    area = area_of_polygon(places)
    whole = dot(area, area)
    sides = list(zip(places, [*places[1:], places[0]], strict=True))
    shares = [dot(area_of_polygon((centre, p, q)), area) / whole for p, q in sides]
    if name == "trapezoid":
        weights = [(shares[k - 1] + shares[k] + K.ratio(1, n)) * third for k in range(n)]
        return list(zip(places, weights, strict=True))
    if name == "midpoint":
        middles = [mean_of((centre, p, q), (third, third, third)) for p, q in sides]
        return [(mean_of(middles, shares), K.number(1))]
    points = []
    for (p, q), share in zip(sides, shares, strict=True):
        for r, outwards in gauss_points(count, 1, K):
            for t, along in gauss_points(count, 0, K):
                on_side = mean_of((p, q), (1 - t, t))
                points.append((mean_of((centre, on_side), (1 - r, r)), share * outwards * along))
    return points


def cell_points(P: Polytope, count: int, K: Arithmetic) -> Points:
    """int_Omega_L dOmega by cones from the mean of the corners: count Gauss points outwards, and gauss:count on the facets.

    Weights of sum A_L; exact for polynomials of degree 2 count - 1; with one point for linear functions, in rationals.
    """
    n = len(P.corners)
    apex = mean_of(P.corners, [K.ratio(1, n)] * n)
    outwards = gauss_points(count, P.dimension - 1, K)
    points = []
    for f in range(len(P.facets)):
        cone = P.cone(f, apex)
        for x, weight in facet_points(P, f, f"gauss:{count}", K):
            for r, w in outwards:
                points.append((mean_of((apex, x), (1 - r, r)), cone * weight * w))
    return points


def boundary_points(
    P: Polytope, rule: str, K: Arithmetic, facets: Iterable[int] | None = None
) -> list[tuple[Vector, Vector]]:
    """int f N dGamma over Gamma_L, or over some of its facets: points with their weighted area vectors.

    Raises NotDifferentiable where corners part: the integral has a derivative there, its sum over points has a kink, since
    a rule over two parts of a side is not the rule over the whole.
    """
    if P.parting:
        where = ", ".join(K.text(c) for c in P.parting[0])
        raise NotDifferentiable(
            f"more cells than {P.dimension + 1} meet at ({where}), and a rule on their sides has a kink where they part: "
            "move a node a little, or hold the cells fixed"
        )
    return [
        (x, tuple(weight * c for c in P.area(f)))
        for f in (range(len(P.facets)) if facets is None else facets)
        for x, weight in facet_points(P, f, rule, K)
    ]
