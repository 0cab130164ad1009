"""Linear elasticity: sigma = lambda tr(eps) 1 + 2 mu eps with eps = sym(F) - 1, in plane strain, plane stress or 3-D."""

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import checked_gradients, symmetric, trace
from rkverify.solid.materials.law import Hyperelastic, State
from rkverify.solid.materials.moduli import Moduli

Plane = Literal["strain", "stress"]
PLANES: tuple[Plane, ...] = get_args(Plane)
"""What is zero in the directions that are not in F: the strain, or the stress."""


@dataclass(frozen=True)
class LinearElastic(Hyperelastic):
    """P = sigma = C : (sym F - 1), where small strains make no difference between stresses; not objective.

    plane `stress` takes lambda' = 2 lambda mu/(lambda + 2 mu) in 2-D and lambda mu/(lambda + mu) in 1-D, which leave the
    other directions without stress. Raises UnknownName for the plane, BadInput for plane stress in 3-D.
    """

    moduli: Moduli
    plane: Plane = "strain"

    def __post_init__(self) -> None:
        if self.plane not in PLANES:
            raise UnknownName("plane", self.plane, PLANES)

    def lame(self, dimension: int) -> float:
        """lambda, or lambda' of plane stress."""
        lame, shear = self.moduli.lame, self.moduli.shear
        if self.plane == "strain":
            return lame
        if dimension == 3:
            raise BadInput("plane stress in 3 dimensions: there is no direction left; choose 'strain'")
        return 2 * lame * shear / (lame + 2 * shear) if dimension == 2 else lame * shear / (lame + shear)

    def energy(self, F: Any) -> Array:
        """W = lambda (tr eps)^2/2 + mu eps : eps (n,)."""
        eps = self._strain(F)
        energy: Array = self.lame(eps.shape[-1]) * trace(eps)[:, 0, 0] ** 2 / 2
        return energy + self.moduli.shear * (eps * eps).sum(axis=(1, 2))

    def stress(self, F: Any) -> Array:
        """P = sigma (n, d, d)."""
        eps = self._strain(F)
        d = eps.shape[-1]
        return self.lame(d) * trace(eps) * np.eye(d) + 2 * self.moduli.shear * eps

    def tangent(self, F: Any, state: State | None = None) -> Array:
        """dP_ij/dF_kl = lambda d_ij d_kl + mu (d_ik d_jl + d_il d_jk), the same at every point."""
        count, d, _ = checked_gradients(F).shape
        one = np.eye(d)
        C = self.lame(d) * np.einsum("ij,kl->ijkl", one, one)
        C += self.moduli.shear * (np.einsum("ik,jl->ijkl", one, one) + np.einsum("il,jk->ijkl", one, one))
        return np.tile(C, (count, 1, 1, 1, 1))

    def cauchy(self, F: Array, P: Array) -> Array:
        """sigma, which is P, whatever det F."""
        return P

    def across(self, F: Array) -> Array:
        """sigma_33 = lambda tr(eps), or 0 in plane stress."""
        return trace(self._strain(F))[:, 0, 0] * (self.moduli.lame if self.plane == "strain" else 0.0)

    @staticmethod
    def _strain(F: Any) -> Array:
        """eps = sym(F) - 1."""
        F = checked_gradients(F)
        return symmetric(F) - np.eye(F.shape[-1])
