"""A body in its reference configuration: deformation gradients (14)-(16), mass (19), internal force (21), tangent.

The stress is the first Piola-Kirchhoff stress P_ij = dW/dF_ij, so that the force on node I is sum_L A_L P_ij b_jI^L: B^T P of
(21), (22) with P_12 and P_21 in the places that the energy gives them.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from rkverify.errors import BadInput
from rkverify.solid.cloud import Cloud, shown
from rkverify.solid.gradients import GradientOperator
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.law import Law, State
from rkverify.solid.shape import shape


@dataclass(frozen=True)
class Body:
    """Nodes, gradient operator, Psi_I(X_L) as a matrix (L, N), a constitutive law, density rho0 (mass/length^d) and state.

    state is what the law knows at the L nodes before the step that is looked for.
    """

    cloud: Cloud
    operator: GradientOperator
    values: sp.csr_array
    law: Law
    density: float
    state: State

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return self.cloud.dimension

    def deformation(self, displacements: Array) -> Array:
        """F_ij(X_L) = delta_ij + sum_I b_jI^L d_iI   (14)-(16), (L, d, d), from coefficients d (N, d)."""
        return np.eye(self.dimension) + self.operator.apply(displacements)

    def spread(self, cell_values: Array) -> Array:
        """sum_L b_jI^L S_ij(L) (N, d), from S (L, d, d)."""
        parts = self.operator.parts
        total: Array = sum(part.T @ cell_values[:, :, j] for j, part in enumerate(parts))
        return total

    def internal_force(self, P: Array) -> Array:
        """f_int_I = sum_L B_I^T P A_L   (21), (N, d), from P (L, d, d)."""
        return self.spread(P * self.operator.measures[:, None, None])

    def stiffness(self, moduli: Array) -> sp.csr_array:
        """sum_L b_jI^L S_ijkl b_lJ^L (d N, d N), from S (L, d, d, d, d); the tangent where S is A dP/dF."""
        d, L = self.dimension, len(moduli)
        B = sp.csr_array(sp.vstack(self.operator.parts))  # rows (j, L)
        blocks = [[B.T @ _cellwise(moduli[:, i, :, k, :], d, L) @ B for k in range(d)] for i in range(d)]
        return sp.csr_array(sp.block_array(blocks))

    def mass(self) -> sp.csr_array:
        """M_IJ = sum_L rho0 Psi_I(X_L) Psi_J(X_L) A_L   (19), (N, N); the same for every component."""
        return sp.csr_array(self.values.T @ sp.diags_array(self.density * self.operator.measures) @ self.values)

    def lumped_mass(self) -> Array:
        """The row sums sum_L rho0 Psi_I(X_L) A_L of (19), (N,).

        Raises BadInput, naming the node, where one is not positive.
        """
        mass: Array = self.values.T @ (self.density * self.operator.measures)
        bad = np.flatnonzero(~(mass > 0))
        if len(bad):
            raise BadInput(
                f"node {bad[0]} at ({shown(self.cloud.positions[bad[0]])}) has lumped mass {mass[bad[0]]:.3g}: take smaller "
                "supports, or the consistent mass"
            )
        return mass

    def body_force(self, b: Array) -> Array:
        """sum_L Psi_I(X_L) b0(X_L) A_L of (20), (N, d), from b0 (L, d) in force per undeformed volume."""
        force: Array = self.values.T @ (self.operator.measures[:, None] * b)
        return force

    def advanced(self, displacements: Array) -> "Body":
        """The same body with the state that it has at the given displacements."""
        return replace(self, state=self.law.advance(self.deformation(displacements), self.state))


def _cellwise(moduli: Array, d: int, L: int) -> sp.csr_array:
    """The matrix (d L, d L) that multiplies values (j, L) at every cell by S_jl (L, d, d)."""
    return sp.csr_array(sp.block_array([[sp.diags_array(moduli[:, j, m]) for m in range(d)] for j in range(d)]))


def body(cloud: Cloud, operator: GradientOperator, law: Law, density: float = 1.0) -> Body:
    """An undeformed body. Raises BadInput for a density that is not positive, and what `shape` raises."""
    if not (np.isfinite(density) and density > 0):
        raise BadInput(f"density {density:g}: it must be positive and finite")
    values = shape(cloud, cloud.positions).matrix()
    return Body(cloud, operator, values, law, density, law.start(len(operator.measures), cloud.dimension))
