"""St. Venant-Kirchhoff: W = lambda (tr E)^2/2 + mu E : E with the Green strain E.

In one dimension P = S F with S = C^SE E and C^SE = lambda + 2 mu, which is (53)-(55).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import checked_gradients, determinant, green_strain, trace, transposed
from rkverify.solid.materials.law import Hyperelastic, State
from rkverify.solid.materials.moduli import Moduli


@dataclass(frozen=True)
class SaintVenantKirchhoff(Hyperelastic):
    """S = lambda tr(E) 1 + 2 mu E, P = F S. Defined for every F, but soft in compression: P = 0 again at F = 0.

    >>> import numpy as np
    >>> SaintVenantKirchhoff(Moduli(1.0, 1.0)).stress(np.array([[[2.0]]])).item()
    9.0
    """

    moduli: Moduli

    def energy(self, F: Any) -> Array:
        """W = lambda (tr E)^2/2 + mu E : E (n,)."""
        E = green_strain(checked_gradients(F))
        energy: Array = self.moduli.lame * trace(E)[:, 0, 0] ** 2 / 2 + self.moduli.shear * (E * E).sum(axis=(1, 2))
        return energy

    def stress(self, F: Any) -> Array:
        """P = F S (n, d, d)."""
        F = checked_gradients(F)
        return F @ self.moduli.of(green_strain(F))

    def tangent(self, F: Any, state: State | None = None) -> Array:
        """dP_ij/dF_kl = d_ik S_lj + lambda F_ij F_kl + mu (F_il F_kj + (F F^T)_ik d_jl)."""
        F = checked_gradients(F)
        one, S = np.eye(F.shape[-1]), self.moduli.of(green_strain(F))
        B = F @ transposed(F)
        return (
            np.einsum("ik,nlj->nijkl", one, S)
            + self.moduli.lame * np.einsum("nij,nkl->nijkl", F, F)
            + self.moduli.shear * (np.einsum("nil,nkj->nijkl", F, F) + np.einsum("nik,jl->nijkl", B, one))
        )

    def across(self, F: Array) -> Array:
        """sigma_33 = lambda tr(E)/J."""
        return self.moduli.lame * trace(green_strain(F))[:, 0, 0] / determinant(F)
