"""Section 4.1: the semi-discrete Lagrangian equations in one dimension, (48)-(58), with SCNI or DNI."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

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

    Its unknowns are the displacement coefficients u_I of (8), from the reference configuration: of a homogeneous stretch
    u_I = (stretch - 1) X_I. Gradients that do not reproduce linear fields have another F in the cells then.
    prestress: the S that the bar carries where F = stretch, so that S = prestress + C^SE (E(F) - E(stretch)) (54).
    shapes: Psi_I(X_L) by L, where the consistent mass or loads are wanted.
    """

    gradients: Mapping[int, Values]
    cells: Mapping[int, Cell]
    rho_0: Scalar
    modulus: Scalar
    prestress: Scalar
    stretch: Scalar
    K: Arithmetic
    shapes: Mapping[int, Values] = field(default_factory=dict)

    def deformation_gradient(self, L: int, u: Sequence[Scalar]) -> Scalar:
        """F at a cell, e + 1 with e = sum_I b_I^L u_I, (14) and (16) in one dimension."""
        return sum((b * u[I] for I, b in self.gradients[L].items()), self.K.number(1))

    def stress(self, F: Scalar) -> Scalar:
        """P = S F with Delta S = C^SE Delta E (53)-(55)."""
        S = self.prestress + self.modulus * (green_strain(F) - green_strain(self.stretch))
        return first_piola_kirchhoff(S, F)

    @equation(49, 51)
    def internal_force(self, node: int, u: Sequence[Scalar]) -> Scalar:
        """f_I = sum_L b_I^L P(X_L) A_L   (49), integrated at the nodes (51)."""
        total = self.K.zero()
        for L, cell in self.cells.items():
            b = self.gradients[L]
            if node in b and not self.K.is_zero(b[node]):
                total = total + b[node] * self.stress(self.deformation_gradient(L, u)) * cell.measure
        return total

    def stored_energy(self, u: Sequence[Scalar]) -> Scalar:
        """sum_L w(F_L) A_L with dw/dF = P: w = (prestress - C^SE E(stretch)) E + C^SE E^2 / 2."""
        total = self.K.zero()
        for L, cell in self.cells.items():
            E = green_strain(self.deformation_gradient(L, u))
            held = self.prestress - self.modulus * green_strain(self.stretch)
            total = total + (held * E + self.modulus * E * E / 2) * cell.measure
        return total

    @equation(50)
    def external_force(self, node: int, b0: Scalar, h0: Scalar, at_boundary: Values) -> Scalar:
        """f_I = sum_L Psi_I(X_L) b0 A_L + Psi_I(X_h) h0   (50), integrated at the nodes; at_boundary: Psi_I(X_h)."""
        total = at_boundary.get(node, self.K.zero()) * h0
        for L, cell in self.cells.items():
            total = total + self.shapes[L].get(node, self.K.zero()) * b0 * cell.measure
        return total

    @equation(48)
    def residual(self, node: int, u: Sequence[Scalar], accelerations: Sequence[Scalar], external: Scalar) -> Scalar:
        """sum_J M_IJ u_J'' + f_int - f_ext   (48), with M_IJ = sum_L rho_0 Psi_I(X_L) Psi_J(X_L) A_L."""
        total = self.internal_force(node, u) - external
        for L, cell in self.cells.items():
            Psi = self.shapes[L]
            if node in Psi:
                carried = sum((value * accelerations[J] for J, value in Psi.items()), self.K.zero())
                total = total + self.rho_0 * Psi[node] * carried * cell.measure
        return total

    @equation(56)
    def acceleration(self, node: int, u: Sequence[Scalar]) -> Scalar:
        """u_I'' = -f_I / m_I with the lumped mass m_I = rho_0 A_I and no external force   (56)."""
        return -self.internal_force(node, u) / (self.rho_0 * self.cells[node].measure)


def gradient(A: Approximation, L: int, cell: Cell, integration: Integration, derivative: Derivative) -> Values:
    """b_I^L of one cell: smoothed (52), or the derivative at the node in a reading."""
    return smoothed_gradient(A, cell) if integration == "scni" else direct_gradient(A, A.nodes[L], derivative)
