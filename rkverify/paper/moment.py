"""The moment matrix M(x) of (6), (11), (32), its rates, and b(x) = M^-1(x) H(0)."""

from collections.abc import Callable
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import SingularMomentMatrix, TooFewNodes
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.basis import basis, basis_rate, basis_second_rate
from rkverify.paper.kernel_rates import phi, phi_rate, phi_second_rate
from rkverify.paper.numbered import equation

Matrix = list[list[Scalar]]
Rates = Callable[[int], Vector]
"""node -> the rate at which x - x_I changes."""


def _sum_of_outer_products(A: Approximation, terms: list[tuple[list[Scalar], list[Scalar], Scalar]]) -> Matrix:
    size = len(basis(A.nodes[0], A.order, A.K))
    total = [[A.K.zero()] * size for _ in range(size)]
    for left, right, weight in terms:
        for row in range(size):
            for column in range(size):
                total[row][column] = total[row][column] + left[row] * right[column] * weight
    return total


@equation(6, 11, 32)
def moment_matrix(A: Approximation, x: Vector) -> Matrix:
    """M(x) = sum_I H(x - x_I) H^T(x - x_I) phi_a(x - x_I)   (6), (11), (32).

    Raises TooFewNodes where fewer kernels reach x than the basis has functions.
    """
    terms = []
    for node in A.neighbours(x):
        H = basis(A.offset(x, node), A.order, A.K)
        terms.append((H, H, phi(A, x, node)))
    covering = sum(A.covers(x, node) for node in A.neighbours(x))
    needed = len(basis(x, A.order, A.K))
    if covering < needed:
        raise TooFewNodes(
            f"at x = ({', '.join(map(A.K.text, x))}) {covering} of the nodes' supports cover the point, order {A.order} needs "
            f"{needed}: enlarge the support or add nodes"
        )
    return _sum_of_outer_products(A, terms)


def moment_rate(A: Approximation, x: Vector, w: Rates, w_kernel: Rates | None = None) -> Matrix:
    """dM/dt where each x - x_I changes at the rate w(I), by the product rule.

    w_kernel: the rate that the kernel sees where it is not w (`kernel_rates.seen_by_the_kernel`).
    """
    terms = []
    for node in A.neighbours(x):
        y = A.offset(x, node)
        H, dH = basis(y, A.order, A.K), basis_rate(y, w(node), A.order, A.K)
        weight = phi(A, x, node)
        terms += [(dH, H, weight), (H, dH, weight), (H, H, phi_rate(A, x, node, (w_kernel or w)(node)))]
    return _sum_of_outer_products(A, terms)


def moment_second_rate(A: Approximation, x: Vector, u: Vector, w: Vector) -> Matrix:
    """The second derivative of M(x) along u and w, by the product rule."""
    terms = []
    for node in A.neighbours(x):
        y = A.offset(x, node)
        H, uH, wH = basis(y, A.order, A.K), basis_rate(y, u, A.order, A.K), basis_rate(y, w, A.order, A.K)
        ddH = basis_second_rate(y, u, w, A.order, A.K)
        weight, u_weight, w_weight = phi(A, x, node), phi_rate(A, x, node, u), phi_rate(A, x, node, w)
        terms += [
            (ddH, H, weight), (uH, wH, weight), (wH, uH, weight), (H, ddH, weight),
            (uH, H, w_weight), (H, uH, w_weight), (wH, H, u_weight), (H, wH, u_weight),
            (H, H, phi_second_rate(A, x, node, u, w)),
        ]  # fmt: skip
    return _sum_of_outer_products(A, terms)


def solve(A: Approximation, x: Vector, M: Matrix, right: list[Scalar]) -> list[Scalar]:
    """M^-1 times a vector, by the factors L D L^T of the symmetric matrix M.

    Raises SingularMomentMatrix where a pivot is not above what rounding may have left of it. With row v of L^-1 pivot j is
    v^T M v. Each entry of M is a sum over N nodes, and the factors are those of M + E with |E_ij| <= (N + m) epsilon
    (M_ii M_jj)^(1/2): the pivot is off by |v^T E v| <= m (N + m) epsilon sum_i v_i^2 M_ii. Both change with the unit of
    length alike. For M scaled to a unit diagonal sum_i v_i^2 M_ii <= D_j / lambda_min: a matrix whose scaled condition
    number is below 1/(m (N + m) epsilon) passes, whatever its pivots are.
    """
    K, size = A.K, len(right)
    rounding = size * (len(A.neighbours(x)) + size) * K.epsilon
    L: Matrix = [[K.zero()] * size for _ in range(size)]
    D: list[Scalar] = []
    for j in range(size):
        pivot = M[j][j]
        for k in range(j):
            pivot = pivot - L[j][k] * L[j][k] * D[k]
        # Exact numbers, which rounding leaves alone, may be beyond any double.
        lost = rounding * _uncertainty(K, L, M, j) if rounding else 0
        if not (K.surely_positive(pivot) and K.witness(pivot) > lost):
            left = K.witness(pivot) / K.witness(M[j][j]) if K.witness(M[j][j]) != 0 else 0
            raise SingularMomentMatrix(
                f"the moment matrix at x = ({', '.join(map(K.text, x))}) is singular (pivot {j} keeps {float(left):.1e} of its "
                f"diagonal entry) with {len(A.neighbours(x))} nodes in reach: enlarge the support, move nodes or lower the order"
            )
        D.append(pivot)
        for i in range(j + 1, size):
            entry = M[i][j]
            for k in range(j):
                entry = entry - L[i][k] * L[j][k] * D[k]
            L[i][j] = entry / pivot
    forward = list(right)
    for i in range(size):
        for k in range(i):
            forward[i] = forward[i] - L[i][k] * forward[k]
    backward = [value / pivot for value, pivot in zip(forward, D, strict=True)]
    for i in reversed(range(size)):
        for k in range(i + 1, size):
            backward[i] = backward[i] - L[k][i] * backward[k]
    return backward


def _uncertainty(K: Arithmetic, L: Matrix, M: Matrix, j: int) -> Any:
    """sum_i v_i^2 M_ii with row j of L^-1, v_j = 1 and v_i = - sum_k v_k L_ki over i < k <= j, of witness values."""
    v: dict[int, Any] = {j: 1}
    for i in reversed(range(j)):
        v[i] = -sum(v[k] * K.witness(L[k][i]) for k in range(i + 1, j + 1))
    return sum(v[i] * v[i] * K.witness(M[i][i]) for i in range(j + 1))


def times(M: Matrix, vector: list[Scalar]) -> list[Scalar]:
    """M times a vector."""
    return [sum((m * v for m, v in zip(row[1:], vector[1:], strict=True)), row[0] * vector[0]) for row in M]


def at_origin(A: Approximation) -> list[Scalar]:
    """H(0) = [1, 0, …, 0]."""
    return basis(tuple(A.K.zero() for _ in range(A.dimension)), A.order, A.K)


def coefficients(A: Approximation, x: Vector, right: list[Scalar] | None = None) -> list[Scalar]:
    """b(x) = M^-1(x) H(0), the coefficients of the correction polynomial in (2) and (28); or M^-1 times `right`."""
    if right is None:
        return A.once("b", x, lambda: solve(A, x, moment_matrix(A, x), at_origin(A)))
    return solve(A, x, moment_matrix(A, x), right)


def coefficients_rate(
    A: Approximation, x: Vector, w: Rates, right: list[Scalar] | None = None, w_kernel: Rates | None = None
) -> list[Scalar]:
    """db/dt where each x - x_I changes at the rate w(I): M db/dt = -dM/dt b."""
    known = times(moment_rate(A, x, w, w_kernel), coefficients(A, x, right))
    return solve(A, x, moment_matrix(A, x), [-k for k in known])


def coefficients_second_rate(A: Approximation, x: Vector, u: Vector, w: Vector) -> list[Scalar]:
    """The second derivative of b along u and w: M b_uw = -(M_uw b + M_u b_w + M_w b_u)."""
    parts = [
        times(moment_second_rate(A, x, u, w), coefficients(A, x)),
        times(moment_rate(A, x, lambda _: u), coefficients_rate(A, x, lambda _: w)),
        times(moment_rate(A, x, lambda _: w), coefficients_rate(A, x, lambda _: u)),
    ]
    return solve(A, x, moment_matrix(A, x), [-(p + q + r) for p, q, r in zip(*parts, strict=True)])
