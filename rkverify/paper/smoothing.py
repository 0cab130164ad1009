"""The smoothed deformation gradient of a cell, (13)-(17), (23), (47), in one to three dimensions, with a rule on its boundary.

Fields are functions of a point: u gives its components (d,), their gradient du the matrix du_i/dX_j. In the current
configuration the same lines are taken on current positions and cells (47).
"""

from collections.abc import Callable, Sequence

from rkverify.arithmetic.base import Arithmetic
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.moment import Matrix
from rkverify.paper.numbered import equation
from rkverify.paper.polytopes import Polytope
from rkverify.paper.quadrature import Points, boundary_points
from rkverify.paper.shape import Values, shape_functions, shape_gradient
from rkverify.readings import Derivative


@equation(17, 23, 47)
def smoothed_gradients(A: Approximation, cell: Polytope, rule: str = "trapezoid") -> tuple[Values, ...]:
    """b_iI^L = (1/A_L) int_Gamma_L Psi_I N_i dGamma for every axis i   (17), (23), (47); 1/length."""
    total: tuple[Values, ...] = tuple({} for _ in range(A.dimension))
    for X, NdGamma in boundary_points(cell, rule, A.K):
        for I, Psi in shape_functions(A, X).items():
            for b, N_i in zip(total, NdGamma, strict=True):
                b[I] = b.get(I, A.K.zero()) + Psi * N_i
    A_L = cell.measure
    return tuple({I: integral / A_L for I, integral in b.items()} for b in total)


def direct_gradients(A: Approximation, x: Vector, reading: Derivative = "full") -> tuple[Values, ...]:
    """Psi_I,i(x_L) for every axis i: the direct gradient at the node, (80) in space; 1/length."""
    return tuple(shape_gradient(A, x, axis, reading) for axis in range(A.dimension))


@equation(16)
def displacement_gradient(b: tuple[Values, ...], d: Sequence[Vector], K: Arithmetic) -> Matrix:
    """e_ij(X_L) = sum_I b_jI^L d_iI   (16), from coefficients d (NP, d)."""
    axes = range(len(b))
    return [[sum((b_jI * d[I][i] for I, b_jI in b[j].items()), K.zero()) for j in axes] for i in axes]


@equation(15)
def boundary_average(cell: Polytope, u: Callable[[Vector], Vector], rule: str, K: Arithmetic) -> Matrix:
    """e_ij(X_L) = (1/A_L) int_Gamma_L u_i N_j dGamma   (15)."""
    axes = range(cell.dimension)
    total = [[K.zero() for _ in axes] for _ in axes]
    for X, NdGamma in boundary_points(cell, rule, K):
        u_X = u(X)
        total = [[total[i][j] + u_X[i] * NdGamma[j] for j in axes] for i in axes]
    return [[integral / cell.measure for integral in row] for row in total]


@equation(14)
def deformation_from_boundary(e: Matrix, K: Arithmetic) -> Matrix:
    """F_ij(X_L) = e_ij(X_L) + delta_ij   (14)."""
    return [[e_ij + K.number(int(i == j)) for j, e_ij in enumerate(row)] for i, row in enumerate(e)]


@equation(13)
def deformation_from_cell(cell: Polytope, du: Callable[[Vector], Matrix], points: Points, K: Arithmetic) -> Matrix:
    """F_ij(X_L) = (1/A_L) int_Omega_L du_i/dX_j dOmega + delta_ij   (13), over points with weights in the cell."""
    axes = range(cell.dimension)
    total = [[K.zero() for _ in axes] for _ in axes]
    for X, weight in points:
        slope = du(X)
        total = [[total[i][j] + weight * slope[i][j] for j in axes] for i in axes]
    return [[total[i][j] / cell.measure + K.number(int(i == j)) for j in axes] for i in axes]


def approximated(A: Approximation, d: Sequence[Vector]) -> Callable[[Vector], Vector]:
    """u^h_i(X) = sum_I Psi_I(X) d_iI   (8), as a function of X."""

    def u(X: Vector) -> Vector:
        Psi = shape_functions(A, X)
        return tuple(sum((value * d[I][i] for I, value in Psi.items()), A.K.zero()) for i in range(A.dimension))

    return u


def approximated_gradient(A: Approximation, d: Sequence[Vector]) -> Callable[[Vector], Matrix]:
    """du^h_i/dX_j = sum_I Psi_I,j(X) d_iI, as a function of X."""
    return lambda X: displacement_gradient(direct_gradients(A, X), d, A.K)


def integration_constraint(gradients: Sequence[tuple[Values, ...]], cells: Sequence[Polytope], K: Arithmetic) -> Matrix:
    """sum_L b_iI^L A_L by node I and axis i, (NP, d): the left side of the integration constraint."""
    axes = range(cells[0].dimension)
    return [
        [sum((b[i].get(I, K.zero()) * cell.measure for b, cell in zip(gradients, cells, strict=True)), K.zero()) for i in axes]
        for I in range(len(cells))
    ]  # fmt: skip


def over_the_boundary(A: Approximation, cells: Sequence[Polytope], rule: str) -> Matrix:
    """int_Gamma Psi_I N_i dGamma over the domain's boundary by the same rule on the cells' facets there, (NP, d)."""
    axes = range(A.dimension)
    total = [[A.K.zero() for _ in axes] for _ in A.nodes]
    for cell in cells:
        outer = [f for f, label in enumerate(cell.beyond) if label is None]
        for X, NdGamma in boundary_points(cell, rule, A.K, outer):
            for I, Psi in shape_functions(A, X).items():
                total[I] = [t + Psi * N for t, N in zip(total[I], NdGamma, strict=True)]
    return total
