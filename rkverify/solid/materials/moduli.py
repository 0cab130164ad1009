"""Isotropic elastic moduli and what they make of a strain."""

from dataclasses import dataclass
from math import isfinite

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import symmetric, trace


@dataclass(frozen=True)
class Moduli:
    """Lame's lambda and the shear modulus mu, in units of stress.

    Raises BadInput where the energy is not positive: mu > 0 and lambda > -2 mu/3 are asked for.
    """

    lame: float
    shear: float

    def __post_init__(self) -> None:
        if not (isfinite(self.lame) and isfinite(self.shear) and self.shear > 0 and self.bulk > 0):
            raise BadInput(
                f"lambda = {self.lame:g}, mu = {self.shear:g}: give a positive mu and a lambda above -2 mu/3"
            )

    @property
    def bulk(self) -> float:
        """kappa = lambda + 2 mu/3."""
        return self.lame + 2 * self.shear / 3

    @property
    def young(self) -> float:
        """E = mu (3 lambda + 2 mu)/(lambda + mu)."""
        return self.shear * (3 * self.lame + 2 * self.shear) / (self.lame + self.shear)

    def of(self, strain: Array) -> Array:
        """C : strain = lambda tr(strain) 1 + 2 mu sym(strain) for tensors (…, d, d)."""
        return self.lame * trace(strain) * np.eye(strain.shape[-1]) + 2 * self.shear * symmetric(strain)

    def energy_of_stress(self, sigma: Array) -> Array:
        """sigma : C^-1 : sigma / 2 (n,) for stresses (n, 3, 3)."""
        pressure = trace(sigma) / 3
        s = sigma - pressure * np.eye(3)
        energy: Array = (s * s).sum(axis=(-2, -1)) / (4 * self.shear) + pressure[..., 0, 0] ** 2 / (2 * self.bulk)
        return energy


def from_young(young: float, poisson: float) -> Moduli:
    """The moduli of Young's modulus E and Poisson's ratio nu.

    Raises BadInput outside -1 < nu < 1/2 or for E that is not positive.

    >>> from_young(2.5, 0.25)
    Moduli(lame=1.0, shear=1.0)
    """
    if not (isfinite(young) and young > 0 and -1 < poisson < 0.5):
        raise BadInput(f"E = {young:g}, nu = {poisson:g}: give a positive E and a nu between -1 and 1/2")
    return Moduli(young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)))
