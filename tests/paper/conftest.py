"""Rational node sets, orders, and how much rounding a shape function may show."""

from collections.abc import Callable, Sequence
from fractions import Fraction

import numpy as np
import pytest

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.native import Exact
from rkverify.certify.samples import NodeSet, rational_node_sets
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.basis import basis
from rkverify.paper.kernel_rates import phi
from rkverify.paper.moment import coefficients, moment_matrix

Build = Callable[..., Approximation]


@pytest.fixture(scope="session", params=rational_node_sets(9, 3), ids=lambda nodes: nodes.name)
def nodes(request: pytest.FixtureRequest) -> NodeSet:
    """Uniform, graded and jittered nodes; their points lie on a node, a joint and the edge of a support as well."""
    return request.param


@pytest.fixture(scope="session", params=[0, 1, 2], ids=lambda n: f"order {n}")
def order(request: pytest.FixtureRequest) -> int:
    return request.param


@pytest.fixture(scope="session")
def build() -> Build:
    """(nodes, order, K, kernel) -> the approximation on a node set in one dimension."""

    def made(nodes: NodeSet, order: int, K: Arithmetic | None = None, kernel: str = "cubic") -> Approximation:
        return approximation([[x] for x in nodes.nodes], list(nodes.supports), K or Exact(), kernel, order)

    return made


@pytest.fixture(scope="session")
def generic() -> Callable[[NodeSet], list[Fraction]]:
    """Points of a node set away from nodes, joints and edges, so that every kernel is one polynomial around them."""

    def points(nodes: NodeSet) -> list[Fraction]:
        wanted = [x + (y - x) * Fraction(37, 101) for x, y in zip(nodes.nodes, nodes.nodes[1:], strict=False)]
        corners = [x + s * q * a for x, a in zip(nodes.nodes, nodes.supports, strict=True)
                   for s in (-1, 1) for q in (0, Fraction(1, 2), 1)]  # fmt: skip
        found = [x for x in wanted if min(abs(x - corner) for corner in corners) > Fraction(1, 10**5)]
        assert len(found) >= 4
        return found[1:4]

    return points


@pytest.fixture(scope="session")
def all_edges_and_joints() -> Callable[[NodeSet], list[Fraction]]:
    """Every edge of a support, joint of a kernel and node inside the hull of the nodes."""

    def points(nodes: NodeSet) -> list[Fraction]:
        corners = {x + s * q * a for x, a in zip(nodes.nodes, nodes.supports, strict=True)
                   for s in (-1, 1) for q in (0, Fraction(1, 2), 1)}  # fmt: skip
        return sorted(c for c in corners if nodes.nodes[0] <= c <= nodes.nodes[-1])

    return points


@pytest.fixture(scope="session")
def rounding() -> Callable[[Approximation, Vector], dict[int, float]]:
    """(A, x) -> for each node a bound, in units of half an epsilon, on the rounding error of Psi_I(x).

    To first order, for the cubic kernel and coordinates that the arithmetic holds exactly. With d^2 the diagonal of M:

    * z is off by 5 u of itself (differences, squares, sums, root, quotient), so that a kernel term c (b - z)^p is off by
      c b^p (5 p + p + 4) u, for (12) by 22 * (4/3 + 2/3) u = 44 u; sums and constants make it 50 u: absolute, not relative;
    * H H^T phi and the sum over N nodes: each power 4 u, two products, N sums: (12 + N) u of each term;
    * L D L^T solves (M + dM) b = H(0) with |dM| <= (3 size + 1) u d d^T (Higham, Accuracy and Stability, ch. 10);
    * b.H phi: size products and sums more, (8 + size) u phi + 50 u of |b|.|H|.

    The perturbation dM of M moves Psi_I by phi_I H_I M^-1 dM b: bounded in the norm of d^-1 M d^-1, whose condition
    number is the least up to a factor `size` that any choice of units gives (van der Sluis).
    """

    def bound(A: Approximation, x: Vector) -> dict[int, float]:
        reached = A.neighbours(x)
        H = np.array([[float(h) for h in basis(A.offset(x, I), A.order, A.K)] for I in reached])
        weight = np.array([float(phi(A, x, I)) for I in reached])
        M = np.array([[float(m) for m in row] for row in moment_matrix(A, x)])
        size, d = len(M), np.sqrt(np.diag(M))
        b = np.array([float(c) for c in coefficients(A, x)])
        Hs, b = H / d, b * d
        inverse = np.linalg.norm(np.linalg.inv(M / np.outer(d, d)), 2)
        per_node = 50 + (12 + len(reached)) * weight
        moved = np.einsum("Ii,Ij,I->ij", abs(Hs), abs(Hs), per_node) + (3 * size + 1)
        lengths = np.linalg.norm(Hs, axis=1)
        spread = inverse * np.linalg.norm(moved) * np.linalg.norm(b) * lengths * weight
        own = (abs(Hs) @ abs(b)) * (50 + (8 + size) * weight)
        # First order: inverse * moved * u must be small; 2 % are added for what is left out.
        assert inverse * np.linalg.norm(moved) * A.K.epsilon < 0.02
        return dict(zip(reached, 1.02 * (spread + own), strict=True))

    return bound


@pytest.fixture(scope="session")
def solve_exactly() -> Callable[[Sequence[Sequence[Fraction]], Sequence[Fraction]], list[Fraction]]:
    """(matrix, right) -> the solution by Gauss-Jordan with exchange of rows, in rationals."""

    def solution(matrix: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
        rows = [[*row, r] for row, r in zip(matrix, right, strict=True)]
        for j in range(len(rows)):
            pivot = next(i for i in range(j, len(rows)) if rows[i][j] != 0)
            rows[j], rows[pivot] = rows[pivot], rows[j]
            rows[j] = [v / rows[j][j] for v in rows[j]]
            for i in range(len(rows)):
                if i != j:
                    rows[i] = [v - rows[i][j] * w for v, w in zip(rows[i], rows[j], strict=True)]
        return [row[-1] for row in rows]

    return solution
