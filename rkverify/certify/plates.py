"""Small plates on jittered nodes with everything rational: shape functions, cells, gradients, states, loads, for exact checks in the plane.

The tensor window keeps shape functions rational; cells are the nodes' Voronoi cells, smoothed gradients take the trapezoid rule.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from rkverify.arithmetic.native import Exact
from rkverify.certify.samples import jittered_grid
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.constitutive import Moduli
from rkverify.paper.lagrangian_solid import Load
from rkverify.paper.moment import Matrix
from rkverify.paper.nodal_polytopes import nodal_polytopes
from rkverify.paper.polytopes import Polytope, box
from rkverify.paper.shape import Values, shape_functions
from rkverify.paper.smoothing import direct_gradients, smoothed_gradients
from rkverify.readings import Integration

K = Exact()
MODULI = Moduli(Fraction(5, 4), Fraction(3, 4))
RHO_0 = Fraction(3, 2)


@dataclass(frozen=True)
class Plate:
    """Nodes per side and seed of a jittered grid with spacing 1 in the square around it."""

    per_side: int
    seed: int

    @cached_property
    def A(self) -> Approximation:
        """Order 1, cubic kernel, tensor window, support 5/2."""
        return approximation(jittered_grid(2, self.per_side, self.seed), Fraction(5, 2), K, window="tensor")

    @cached_property
    def domain(self) -> Polytope:
        """The square that ends half a spacing beyond the grid."""
        ends = Fraction(-1, 2), self.per_side - Fraction(1, 2)
        return box([ends[0]] * 2, [ends[1]] * 2, K)

    @cached_property
    def cells(self) -> list[Polytope]:
        """The nodes' Voronoi cells in the square."""
        return nodal_polytopes(self.A.nodes, self.domain, K)

    @cached_property
    def measures(self) -> list[Fraction]:
        """A_L."""
        return [cell.measure for cell in self.cells]

    @cached_property
    def shapes(self) -> list[Values]:
        """Psi_I(X_L) by L."""
        return [shape_functions(self.A, X) for X in self.A.nodes]

    def gradients(self, integration: Integration) -> list[tuple[Values, ...]]:
        """b_iI^L by L: smoothed over the cells, or direct at the nodes."""
        if integration == "dni":
            return [direct_gradients(self.A, X) for X in self.A.nodes]
        return [smoothed_gradients(self.A, cell) for cell in self.cells]

    def vectors(self, salt: int, size: Fraction) -> list[Vector]:
        """A random rational vector for every node, components up to `size`."""
        rng = np.random.default_rng((self.seed, salt))
        return [
            tuple(size * Fraction(int(q), 12) for q in row) for row in rng.integers(-12, 13, (len(self.A.nodes), 2))
        ]

    def symmetric(self, salt: int) -> list[Matrix]:
        """A random rational symmetric matrix for every node, entries up to 1."""
        rng = np.random.default_rng((self.seed, salt))
        entries = [[Fraction(int(q), 7) for q in row] for row in rng.integers(-7, 8, (len(self.A.nodes), 3))]
        return [[[a, c], [c, b]] for a, b, c in entries]

    def tractions(self, salt: int) -> list[Load]:
        """Random tractions at the ends of the domain's edges, with half an edge's length as the weight."""
        rng = np.random.default_rng((self.seed, salt))
        corners, side = self.domain.corners, Fraction(self.per_side, 2)
        return [
            (shape_functions(self.A, X), tuple(Fraction(int(q), 5) for q in rng.integers(-5, 6, 2)), side)
            for X in corners
        ]


def homogeneous(nodes: Sequence[Vector], F: Matrix) -> list[Vector]:
    """The displacement coefficients (F - 1) X_I."""
    return [tuple(sum((F[i][j] - int(i == j)) * X[j] for j in range(len(X))) for i in range(len(X))) for X in nodes]
