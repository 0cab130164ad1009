"""Section 4.1: the semi-discrete Lagrangian equations in one dimension, integrated by SCNI, (48)-(58)."""

from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Scalar
from rkverify.paper.approximation import Approximation
from rkverify.paper.cells import Cell
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.numbered import equation
from rkverify.paper.printed_lagrangian import first_piola_kirchhoff, green_strain


@dataclass(frozen=True)
class LagrangianChain:
    """A bar: approximation on X_I (8)-(11), cells Omega_L, density rho_0 (mass per length), modulus C^SE.

    prestress: the S that the bar carries where F = stretch, so that S = prestress + C^SE (E(F) - E(stretch)) (54).
    """

    A: Approximation
    cells: tuple[Cell, ...]
    rho_0: Scalar
    modulus: Scalar
    prestress: Scalar
    stretch: Scalar

    def deformation_gradient(self, cell: int, positions: Sequence[Scalar]) -> Scalar:
        """F at a cell: sum_I b_I^L x_I, which is 1 + sum_I b_I^L u_I (14), (16)."""
        b = smoothed_gradient(self.A, self.cells[cell])
        return sum((value * positions[I] for I, value in b.items()), self.A.K.zero())

    def stress(self, F: Scalar) -> Scalar:
        """P = S F with Delta S = C^SE Delta E (53)-(55)."""
        S = self.prestress + self.modulus * (green_strain(F) - green_strain(self.stretch))
        return first_piola_kirchhoff(S, F)

    @equation(49, 51)
    def internal_force(self, node: int, positions: Sequence[Scalar]) -> Scalar:
        """f_I = sum_L b_I^L P(X_L) A_L   (49) integrated by SCNI (51)."""
        total = self.A.K.zero()
        for L, cell in enumerate(self.cells):
            b = smoothed_gradient(self.A, cell)
            if node in b and not self.A.K.is_zero(b[node]):
                total = total + b[node] * self.stress(self.deformation_gradient(L, positions)) * cell.measure
        return total

    def lumped_mass(self, node: int) -> Scalar:
        """m_I = rho_0 A_I, the mass of the node's own cell (56)."""
        return self.rho_0 * self.cells[node].measure

    @equation(48, 56)
    def acceleration(self, node: int, positions: Sequence[Scalar]) -> Scalar:
        """u_I'' = -f_I / m_I without external force   (48), (56)."""
        return -self.internal_force(node, positions) / self.lumped_mass(node)
