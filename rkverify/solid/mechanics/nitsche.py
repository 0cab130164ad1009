"""Essential conditions u = g in the sense of Nitsche, with the cells' own boundary rule.

RK coefficients are not nodal values, so that a condition on coefficients or at nodes is not the condition on the boundary. Added to
the virtual work are, over the points q of the boundary with weights w_q,

    - sum_q w_q du . P N  -  sum_q w_q (u - g) . (dP/dF : dF) N  +  sum_q w_q beta_q du . (u - g)

with P and F of the cell that the facet closes. A homogeneous deformation that satisfies the condition is then in equilibrium
exactly, for any nodes and any edge rule: the first sum is what the integration constraint leaves.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.mechanics.body import Body
from rkverify.solid.mechanics.boundary import Boundary

STEP = 1e-100
"""Of the complex step: its square is below any rounding."""

FACTOR = 4.0
"""gamma in beta = gamma |C| |Gamma_L|/A_L, |C| the largest eigenvalue of dP/dF. The gradient is constant in a cell, so that by Cauchy,
Schwarz and Young 2 |sum_q w_q (u - g) . dP N| is at most half of the cell's energy and half of the penalty for gamma = 4; gamma > 1
is needed."""


@dataclass(frozen=True)
class Nitsche:
    """u = g (Q, d) at the boundary's points, with penalties beta (Q,) in stress per length; symmetric: with the middle sum."""

    boundary: Boundary
    given: Array
    penalties: Array
    symmetric: bool = True

    def gap(self, displacements: Array) -> Array:
        """u - g at the points (Q, d)."""
        return self.boundary.values @ displacements - self.given

    def cell_gap(self, displacements: Array, cells: int) -> Array:
        """T_mn = sum_q w_q (u - g)_m N_n of every cell (L, d, d)."""
        gap = self.gap(displacements)
        return self.boundary.cell_sums(gap[:, :, None] * self.boundary.normals[:, None, :], cells)

    def force(self, body: Body, displacements: Array, P: Array, moduli: Array) -> Array:
        """What the condition adds to the internal force (N, d)."""
        B = self.boundary
        traction = np.einsum("qij,qj->qi", P[B.cells], B.normals)
        total = B.traction(self.penalties[:, None] * self.gap(displacements) - traction)
        if self.symmetric:
            T = self.cell_gap(displacements, len(P))
            total = total - body.spread(np.einsum("nmoij,nmo->nij", moduli, T))
        return total

    def stiffness(self, body: Body, displacements: Array, F: Array, moduli: Array, bent: bool = True) -> sp.csr_array:
        """The derivative (d N, d N) of `force`, with dP/dF (L, d, d, d, d) at F.

        bent: with the change of dP/dF, a third derivative of the energy taken by a complex step along T. It vanishes where the
        condition is met; while it is not, as just after a step of the given values, the derivative without it is the better guide.
        """
        B, d = self.boundary, body.dimension
        at_points = sp.csr_array(sp.vstack([part[B.cells] for part in body.operator.parts]))  # rows (l, q)
        work = np.einsum("qmjkl,qj->qmkl", moduli[B.cells], B.normals) * B.weights[:, None, None, None]
        blocks = [
            [B.values.T @ sp.hstack([sp.diags_array(work[:, m, k, j]) for j in range(d)]) @ at_points for k in range(d)]
            for m in range(d)
        ]
        consistency = sp.csr_array(sp.block_array(blocks))
        penalty = B.values.T @ sp.diags_array(B.weights * self.penalties) @ B.values
        total = sp.block_diag([penalty] * d, format="csr") - consistency
        if not self.symmetric:
            return sp.csr_array(total)
        total = total - consistency.T
        if not bent:
            return sp.csr_array(total)
        T = self.cell_gap(displacements, len(F))
        change = body.law.tangent(F + 1j * STEP * T, body.state).imag / STEP
        return sp.csr_array(total - body.stiffness(change))


def nitsche(body: Body, boundary: Boundary, given: Array, factor: float = FACTOR, symmetric: bool = True) -> Nitsche:
    """The condition with beta = gamma |C| |Gamma_L|/A_L for each cell, |C| the norm of dP/dF in the body's present state.

    symmetric needs dP/dF of an energy: leave it out for laws with memory. Raises BadInput for a factor of 1 or less, or for given
    values of another shape than the points (Q, d).
    """
    if not factor > 1:
        raise BadInput(f"Nitsche's factor {factor:g}: it must be above 1, or stiffness is lost at the boundary")
    if np.shape(given) != boundary.points.shape:
        raise BadInput(
            f"given values of shape {np.shape(given)}: the boundary has {boundary.points.shape}; give as many"
        )
    d = body.dimension
    moduli = body.law.tangent(body.state.F, body.state).reshape(-1, d * d, d * d)
    C = np.linalg.norm(moduli[boundary.cells], 2, axis=(1, 2))
    length = boundary.cell_sums(np.ones(len(boundary.points)), len(body.operator.measures))
    return Nitsche(
        boundary, np.asarray(given), factor * C * (length / body.operator.measures)[boundary.cells], symmetric
    )
