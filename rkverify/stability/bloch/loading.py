"""The stress that is there and what a small motion adds to it: sigma' = C : D + a corotation, in plane strain or in space."""

from dataclasses import dataclass
from math import isfinite
from typing import Literal, get_args

import numpy as np

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.moduli import Moduli

PlaneStressLaw = Literal["truesdell", "jaumann"]
PLANE_STRESS_LAWS: tuple[PlaneStressLaw, ...] = get_args(PlaneStressLaw)
UNIT = Moduli(1.0, 1.0)
"""lambda = mu = 1: Poisson's ratio is 1/4, speeds of waves without stress are 3^(1/2) and 1."""


@dataclass(frozen=True)
class Loading:
    """A uniform Cauchy stress, (xx, yy, xy) in the plane and (xx, yy, zz, xy, xz, yz) in space, moduli, and the rate that the law is written in. Raises BadInput, UnknownName.

    truesdell: sigma' = C : D + L sigma + sigma L^T - tr(L) sigma; jaumann: sigma' = C : D + W sigma + sigma W^T.
    """

    stress: tuple[float, ...]
    moduli: Moduli = UNIT
    law: PlaneStressLaw = "truesdell"

    def __post_init__(self) -> None:
        if self.law not in PLANE_STRESS_LAWS:
            raise UnknownName("stress law", self.law, PLANE_STRESS_LAWS)
        if len(self.stress) not in (3, 6):
            raise BadInput(f"{len(self.stress)} components of stress: give 3 in the plane, 6 in space")
        if not all(isfinite(part) for part in self.stress):
            raise BadInput(f"the stress {self.stress} is not finite: give finite numbers")

    @property
    def sigma(self) -> Array:
        """The stress (d, d)."""
        if len(self.stress) == 6:
            xx, yy, zz, xy, xz, yz = self.stress
            return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        xx, yy, xy = self.stress
        return np.array([[xx, xy], [xy, yy]])

    @property
    def tangent(self) -> Array:
        """T (d, d, d, d) with sigma'_ij = T_ijkl L_kl, L_kl = dv_k/dx_l; units of stress."""
        s = self.sigma
        one = np.eye(len(s))
        T = self.moduli.lame * np.einsum("ij,kl->ijkl", one, one) + self.moduli.shear * (
            np.einsum("ik,jl->ijkl", one, one) + np.einsum("il,jk->ijkl", one, one)
        )
        carried = np.einsum("ik,lj->ijkl", one, s)
        if self.law == "jaumann":
            carried = (carried - np.einsum("il,kj->ijkl", one, s)) / 2
        T = T + carried + carried.transpose(1, 0, 2, 3)
        return T - np.einsum("ij,kl->ijkl", s, one) if self.law == "truesdell" else T
