"""Compressible neo-Hookean: W = mu/2 (tr F^T F - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J).

Source: the energy of P. Wriggers, Nonlinear Finite Element Methods (Springer, 2008), section 3.3.1, whose volumetric part is that of
P. G. Ciarlet, Mathematical Elasticity I (North-Holland, 1988), section 4.10: polyconvex, infinite at J = 0, and with a stress that is rational
in F. Linearised at F = 1 it has the moduli lambda and mu.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import checked_gradients, determinant, inverse, refuse_inverted, transposed
from rkverify.solid.materials.law import Hyperelastic, State
from rkverify.solid.materials.moduli import Moduli


@dataclass(frozen=True)
class NeoHookean(Hyperelastic):
    """P = mu (F - F^-T) + lambda/2 (J^2 - 1) F^-T. Raises BadInput where det F is not positive."""

    moduli: Moduli

    def energy(self, F: Any) -> Array:
        """W (n,); the directions that are not in F contribute to tr F^T F what they have undeformed."""
        F = _regular(F)
        J = determinant(F)
        stretch = (F * F).sum(axis=(1, 2)) - F.shape[-1]
        energy: Array = self.moduli.shear * (stretch / 2 - np.log(J)) + self.moduli.lame / 4 * (
            J * J - 1 - 2 * np.log(J)
        )
        return energy

    def stress(self, F: Any) -> Array:
        """P (n, d, d)."""
        F = _regular(F)
        G = transposed(inverse(F))
        return self.moduli.shear * (F - G) + self._volumetric(F)[:, None, None] * G

    def _volumetric(self, F: Array) -> Array:
        """lambda/2 (J^2 - 1)."""
        return self.moduli.lame / 2 * (determinant(F) ** 2 - 1)

    def tangent(self, F: Any, state: State | None = None) -> Array:
        """dP_ij/dF_kl = mu d_ik d_jl + (mu - lambda/2 (J^2 - 1)) G_il G_kj + lambda J^2 G_ij G_kl with G = F^-T."""
        F = _regular(F)
        one, G = np.eye(F.shape[-1]), transposed(inverse(F))
        mixed = self.moduli.shear - self._volumetric(F)
        squared = self.moduli.lame * determinant(F) ** 2
        return (
            self.moduli.shear * np.einsum("ik,jl->ijkl", one, one)
            + np.einsum("n,nil,nkj->nijkl", mixed, G, G)
            + np.einsum("n,nij,nkl->nijkl", squared, G, G)
        )

    def across(self, F: Array) -> Array:
        """sigma_33 = lambda/2 (J^2 - 1)/J."""
        return self._volumetric(F) / determinant(F)


def _regular(F: Any) -> Array:
    F = checked_gradients(F)
    refuse_inverted(F)
    return F
