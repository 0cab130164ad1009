"""Nodal representative cells Omega_L in one, two and three dimensions, by their definition."""

from collections.abc import Sequence
from dataclasses import replace

from rkverify.arithmetic.base import Arithmetic
from rkverify.errors import BadInput, CoincidentNodes
from rkverify.paper.approximation import Vector
from rkverify.paper.clipping import changes, clip, rounding_of_heights
from rkverify.paper.kernel_rates import dot, minus
from rkverify.paper.polytopes import Polytope


def nodal_polytopes(nodes: Sequence[Vector], domain: Polytope, K: Arithmetic) -> list[Polytope]:
    """The Voronoi cells of the nodes (NP, d): what of the convex domain is nearer to a node than to all others.

    Raises BadInput for a node outside the domain, CoincidentNodes.
    """
    for node, x in enumerate(nodes):
        for f in range(len(domain.facets)):
            if K.sign(dot(minus(x, domain.places(f)[0]), domain.area(f))) > 0:
                raise BadInput(
                    f"node {node} at ({', '.join(map(K.text, x))}) lies outside the domain: move it or widen the domain"
                )
    return [nodal_polytope(nodes, I, domain, K) for I in range(len(nodes))]


def nodal_polytope(nodes: Sequence[Vector], I: int, domain: Polytope, K: Arithmetic) -> Polytope:
    """The cell of node I: the domain cut by the half-spaces (X - (X_I + X_J)/2) . (X_J - X_I) <= 0 of all other J.

    Raises CoincidentNodes.
    """
    cell = domain
    for J in range(len(nodes)):
        if J == I:
            continue
        middle, towards = _bisector(nodes, I, J)
        if all(K.sign(c) == 0 for c in towards):
            where = ", ".join(map(K.text, nodes[I]))
            raise CoincidentNodes(
                f"nodes {min(I, J)} and {max(I, J)} are both at ({where}): remove or move one of them"
            )
        cell = clip(cell, middle, towards, J, K)
    return replace(cell, parting=_parting(nodes, I, cell, domain, K))


def _parting(nodes: Sequence[Vector], I: int, cell: Polytope, domain: Polytope, K: Arithmetic) -> tuple[Vector, ...]:
    """Corners of the cell on more than d bisectors and facets of the domain, of which one carries a change."""
    moving = [any(changes(c, K) for c in x) for x in nodes]
    if not any(moving):
        return ()
    found = []
    for X in cell.corners:
        met = [J for J in range(len(nodes)) if J != I and _on(X, *_bisector(nodes, I, J), K)]
        walls = sum(_on(X, domain.places(f)[0], domain.area(f), K) for f in range(len(domain.facets)))
        if len(met) + walls > cell.dimension and any(moving[J] for J in (I, *met)):
            found.append(X)
    return tuple(found)


def _bisector(nodes: Sequence[Vector], I: int, J: int) -> tuple[Vector, Vector]:
    """The middle between two nodes, and the way from the one to the other."""
    middle = tuple((p + q) / 2 for p, q in zip(nodes[I], nodes[J], strict=True))
    return middle, minus(nodes[J], nodes[I])


def _on(X: Vector, point: Vector, normal: Vector, K: Arithmetic) -> bool:
    height = dot(minus(X, point), normal)
    return bool(abs(K.witness(height)) <= rounding_of_heights((X,), point, normal, K))
