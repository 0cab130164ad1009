"""Section 3.3: the semi-discrete semi-Lagrangian equations (41)-(46) in two dimensions; mass, N and loads in any."""

from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.lagrangian_solid import Load, carried, force_of_loads, plane_gradient, plus, times_transposed
from rkverify.paper.material_rates import psi_star, true_rate
from rkverify.paper.moment import Matrix
from rkverify.paper.numbered import equation
from rkverify.paper.shape import Values, shape_functions


@dataclass(frozen=True)
class SemiLagrangianSolid:
    """Everything by cell L, at x_L = x(X_L, t): gradients b_iI^L (47) or direct, measures a_L, Psi_I(x_L), rates, rho, sigma.

    rates: Psi*_I(x_L) (40), or the true material rates of Psi_I there. gradients: one dict of nodes for every axis.
    """

    gradients: Sequence[tuple[Values, ...]]
    measures: Sequence[Scalar]
    shapes: Sequence[Values]
    rates: Sequence[Values]
    densities: Sequence[Scalar]
    stresses: Sequence[Matrix]
    K: Arithmetic

    def _masses(self, node: int, columns: Sequence[Values]) -> Values:
        """sum_L rho(x_L) Psi_I(x_L) c_J(x_L) a_L for all J."""
        row: Values = {}
        for Psi, c, rho, a_L in zip(self.shapes, columns, self.densities, self.measures, strict=True):
            for J, value in c.items() if node in Psi else ():
                row[J] = row.get(J, self.K.zero()) + rho * Psi[node] * value * a_L
        return row

    @equation(42)
    def mass(self, node: int) -> Values:
        """M_IJ = sum_L rho(x_L) Psi_I(x_L) Psi_J(x_L) a_L for all J, the factor of I   (42)."""
        return self._masses(node, self.shapes)

    @equation(43)
    def convective(self, node: int) -> Values:
        """N_IJ = sum_L rho(x_L) Psi_I(x_L) Psi*_J(x_L) a_L for all J, the factor of I   (43)."""
        return self._masses(node, self.rates)

    @equation(44)
    def external_force(self, node: int, tractions: Sequence[Load], b: Sequence[Vector]) -> Vector:
        """f_I = sum_K Psi_I(x_K) h(x_K) w_K + sum_L Psi_I(x_L) b(x_L) a_L   (44)."""
        return force_of_loads(node, tractions, zip(self.shapes, b, self.measures, strict=True), self.K)

    @equation(46)
    def b_bar(self, node: int, L: int) -> Matrix:
        """B_I(x_L) = [b_1I 0; 0 b_2I; b_2I b_1I]   (46); raises BadInput outside two dimensions."""
        b_1, b_2 = plane_gradient(self.gradients[L], node, self.K)
        zero = self.K.zero()
        return [[b_1, zero], [zero, b_2], [b_2, b_1]]

    @staticmethod
    @equation(46)
    def stress_vector(sigma: Matrix) -> list[Scalar]:
        """Xi = [sigma_11, sigma_22, sigma_12]   (46)."""
        return [sigma[0][0], sigma[1][1], sigma[0][1]]

    @equation(45)
    def internal_force(self, node: int) -> Vector:
        """f_I = sum_L B_I^T(x_L) Xi(x_L) a_L   (45)."""
        total = (self.K.zero(), self.K.zero())
        for L, (sigma, a_L) in enumerate(zip(self.stresses, self.measures, strict=True)):
            if node in self.gradients[L][0]:
                total = plus(total, times_transposed(self.b_bar(node, L), self.stress_vector(sigma)), a_L)
        return total

    @equation(41)
    def residual(
        self, node: int, velocities: Sequence[Vector], velocity_rates: Sequence[Vector], external: Vector
    ) -> Vector:
        """sum_J M_IJ v_J' + sum_J N_IJ v_J - f_ext_I + f_int_I   (41), zero where it holds."""
        inertia = carried(self.mass(node), velocity_rates, self.K)
        convection = carried(self.convective(node), velocities, self.K)
        left = plus(plus(inertia, convection, 1), self.internal_force(node), 1)
        return plus(left, external, -1)


def rates_at_nodes(A: Approximation, node_velocities: Sequence[Vector], true: bool) -> list[Values]:
    """Psi*_I(x_L) (40), or the true rates, at every node, where the material moves with the node's own v_L; 1/time."""
    rate = true_rate if true else psi_star
    return [rate(A, x, v, node_velocities) for x, v in zip(A.nodes, node_velocities, strict=True)]


def shapes_at_nodes(A: Approximation) -> list[Values]:
    """Psi_I(x_L) at every node (30)."""
    return [shape_functions(A, x) for x in A.nodes]
