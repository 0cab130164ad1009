"""Section 2.2: the semi-discrete Lagrangian equations (18)-(22) in two dimensions; mass and loads in any.

Gradients b_iI^L, smoothed (23) or direct, come by cell as one dict of nodes for every axis, cells by their measures A_L.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput, UnknownName
from rkverify.paper.approximation import Vector
from rkverify.paper.constitutive import transpose
from rkverify.paper.moment import Matrix
from rkverify.paper.numbered import equation
from rkverify.paper.shape import Values
from rkverify.paper.smoothing import deformation_from_boundary, displacement_gradient

StressOrder = Literal["nominal", "first"]
STRESS_ORDERS: tuple[StressOrder, ...] = get_args(StressOrder)
"""What P in (22) is: the nominal stress of (7) and (24), or the first Piola-Kirchhoff stress, its transpose."""

Load = tuple[Values, Vector, Scalar]
"""Psi_I at a boundary point, the traction h there, the weight W of the point."""


@dataclass(frozen=True)
class LagrangianSolid:
    """Gradients b_iI^L, measures A_L and shape functions Psi_I(X_L) by cell, density rho_0, F -> P nominal as in (7)."""

    gradients: Sequence[tuple[Values, ...]]
    measures: Sequence[Scalar]
    shapes: Sequence[Values]
    rho_0: Scalar
    nominal: Callable[[Matrix], Matrix]
    K: Arithmetic

    def deformation_gradient(self, L: int, d: Sequence[Vector]) -> Matrix:
        """F_ij(X_L) = sum_I b_jI^L d_iI + delta_ij, (14) with (16), from displacement coefficients d (NP, d)."""
        return deformation_from_boundary(displacement_gradient(self.gradients[L], d, self.K), self.K)

    @equation(19)
    def mass(self, node: int) -> Values:
        """M_IJ = sum_L rho0 Psi_I(X_L) Psi_J(X_L) A_L for all J, the factor of I   (19)."""
        row: Values = {}
        for Psi, A_L in zip(self.shapes, self.measures, strict=True):
            for J, value in Psi.items() if node in Psi else ():
                row[J] = row.get(J, self.K.zero()) + self.rho_0 * Psi[node] * value * A_L
        return row

    @equation(20)
    def external_force(self, node: int, tractions: Sequence[Load], b0: Sequence[Vector]) -> Vector:
        """f_I = sum_K Psi_I(X_K) h0(X_K) W_K + sum_L Psi_I(X_L) b0(X_L) A_L   (20)."""
        return force_of_loads(node, tractions, zip(self.shapes, b0, self.measures, strict=True), self.K)

    @equation(22)
    def b_bar(self, node: int, L: int) -> Matrix:
        """B_I(X_L) = [b_1I 0; 0 b_2I; b_2I 0; 0 b_1I]   (22); raises BadInput outside two dimensions."""
        b_1, b_2 = plane_gradient(self.gradients[L], node, self.K)
        zero = self.K.zero()
        return [[b_1, zero], [zero, b_2], [b_2, zero], [zero, b_1]]

    @staticmethod
    @equation(22)
    def stress_vector(P: Matrix) -> list[Scalar]:
        """P = [P_11, P_22, P_12, P_21]   (22)."""
        return [P[0][0], P[1][1], P[0][1], P[1][0]]

    @equation(21)
    def internal_force(self, node: int, d: Sequence[Vector], order: StressOrder) -> Vector:
        """f_I = sum_L B_I^T(X_L) P(X_L) A_L   (21), with (22) and P taken in the given order."""
        if order not in STRESS_ORDERS:
            raise UnknownName("order of the stress", order, STRESS_ORDERS)
        total = (self.K.zero(), self.K.zero())
        for L, A_L in enumerate(self.measures):
            if node in self.gradients[L][0]:
                P = self.nominal(self.deformation_gradient(L, d))
                P_L = self.stress_vector(P if order == "nominal" else transpose(P))
                total = plus(total, times_transposed(self.b_bar(node, L), P_L), A_L)
        return total

    @equation(18)
    def residual(
        self, node: int, d: Sequence[Vector], accelerations: Sequence[Vector], external: Vector, order: StressOrder
    ) -> Vector:
        """sum_J M_IJ u_J'' - f_ext_I + f_int_I   (18), zero where it holds."""
        inertia = carried(self.mass(node), accelerations, self.K)
        left = plus(inertia, self.internal_force(node, d, order), 1)
        return plus(left, external, -1)

    def stored_energy(self, d: Sequence[Vector], energy: Callable[[Matrix], Scalar]) -> Scalar:
        """sum_L W(F(X_L)) A_L."""
        total = self.K.zero()
        for L, A_L in enumerate(self.measures):
            total = total + energy(self.deformation_gradient(L, d)) * A_L
        return total


def plane_gradient(b: tuple[Values, ...], node: int, K: Arithmetic) -> tuple[Scalar, Scalar]:
    """b_1I, b_2I; raises BadInput outside two dimensions."""
    if len(b) != 2:
        raise BadInput(f"the matrices (22), (46) are printed for 2 dimensions, not for {len(b)}: give plane gradients")
    return b[0].get(node, K.zero()), b[1].get(node, K.zero())


def times_transposed(B: Matrix, column: Sequence[Scalar]) -> Vector:
    """B^T c."""
    each = [[row[i] * c for row, c in zip(B, column, strict=True)] for i in range(len(B[0]))]
    return tuple(sum(terms[1:], terms[0]) for terms in each)


def plus(u: Vector, w: Vector, factor: Scalar) -> Vector:
    """u + factor w."""
    return tuple(p + factor * q for p, q in zip(u, w, strict=True))


def carried(row: Values, vectors: Sequence[Vector], K: Arithmetic) -> Vector:
    """sum_J M_IJ v_J of a row of a matrix and vectors (NP, d)."""
    axes = range(len(vectors[0]))
    return tuple(sum((M * vectors[J][i] for J, M in row.items()), K.zero()) for i in axes)


def force_of_loads(node: int, tractions: Sequence[Load], bodies: Iterable[Load], K: Arithmetic) -> Vector:
    """sum Psi_I h W over boundary points plus sum Psi_I b A over cells, each as (Psi, load, weight)."""
    loads = [*tractions, *bodies]
    total = tuple(K.zero() for _ in loads[0][1])
    for Psi, load, weight in loads:
        if node in Psi:
            total = plus(total, load, Psi[node] * weight)
    return total
