"""Section 4.1: the semi-discrete Lagrangian equations in one dimension, (48)-(58), with SCNI or DNI."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.approximation import Approximation
from rkverify.paper.cells import Cell
from rkverify.paper.gradients import direct_gradient, smoothed_gradient
from rkverify.paper.numbered import equation
from rkverify.paper.printed_lagrangian import first_piola_kirchhoff, green_strain
from rkverify.paper.shape import Values
from rkverify.readings import Derivative, Integration


@dataclass(frozen=True)
class LagrangianChain:
    """A bar: gradients b_I^L and cells Omega_L by their number L, density rho_0 (mass per length), modulus C^SE.

    prestress: the S that the bar carries where F = stretch, so that S = prestress + C^SE (E(F) - E(stretch)) (54).
    """

    gradients: Mapping[int, Values]
    cells: Mapping[int, Cell]
    rho_0: Scalar
    modulus: Scalar
    prestress: Scalar
    stretch: Scalar
    K: Arithmetic

    def deformation_gradient(self, L: int, positions: Sequence[Scalar]) -> Scalar:
        """F at a cell: sum_I b_I^L x_I, which is 1 + sum_I b_I^L u_I (14), (16)."""
        return sum((b * positions[I] for I, b in self.gradients[L].items()), self.K.zero())

    def stress(self, F: Scalar) -> Scalar:
        """P = S F with Delta S = C^SE Delta E (53)-(55)."""
        S = self.prestress + self.modulus * (green_strain(F) - green_strain(self.stretch))
        return first_piola_kirchhoff(S, F)

    @equation(49, 51)
    def internal_force(self, node: int, positions: Sequence[Scalar]) -> Scalar:
        """f_I = sum_L b_I^L P(X_L) A_L   (49), integrated at the nodes (51)."""
        total = self.K.zero()
        for L, cell in self.cells.items():
            b = self.gradients[L]
            if node in b and not self.K.is_zero(b[node]):
                total = total + b[node] * self.stress(self.deformation_gradient(L, positions)) * cell.measure
        return total

    @equation(48, 56)
    def acceleration(self, node: int, positions: Sequence[Scalar]) -> Scalar:
        """u_I'' = -f_I / m_I with the lumped mass m_I = rho_0 A_I and no external force   (48), (56)."""
        return -self.internal_force(node, positions) / (self.rho_0 * self.cells[node].measure)


def gradient(A: Approximation, L: int, cell: Cell, integration: Integration, derivative: Derivative) -> Values:
    """b_I^L of one cell: smoothed (52), or the derivative at the node in a reading."""
    return smoothed_gradient(A, cell) if integration == "scni" else direct_gradient(A, A.nodes[L], derivative)
