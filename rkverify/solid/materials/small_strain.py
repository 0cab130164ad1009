"""Stress increments of small strain: sigma = sigma_old + C : sym(F - F_old), with no difference between stresses."""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.incremental import Incremental
from rkverify.solid.materials.law import State
from rkverify.solid.materials.moduli import Moduli


@dataclass(frozen=True)
class SmallStrain(Incremental):
    """The elastic part of plasticity at small strain; not objective. In the plane, plane strain."""

    moduli: Moduli

    def predicted(self, F: Array, state: State) -> Array:
        """sigma_old + C : sym(F - F_old) (n, 3, 3)."""
        return state.sigma + self.moduli.of(_whole((F - state.F)[:, None])[:, 0])

    def predicted_slopes(self, F: Array, state: State) -> Array:
        """C : sym(dF), the same at every point."""
        n, d, _ = F.shape
        units = np.broadcast_to(np.eye(d * d).reshape(1, d * d, d, d), (n, d * d, d, d))
        return self.moduli.of(_whole(units))

    def first_piola(self, sigma: Array, F: Array) -> Array:
        """P = sigma."""
        d = F.shape[-1]
        return sigma[:, :d, :d]

    def first_piola_slopes(self, sigma: Array, slopes: Array, F: Array) -> Array:
        """dP = dsigma, as (n, d, d, d, d)."""
        n, d, _ = F.shape
        return np.moveaxis(slopes[..., :d, :d].reshape(n, d, d, d, d), (1, 2), (3, 4))


def _whole(changes: Array) -> Array:
    """Changes (n, m, d, d) as (n, m, 3, 3), with nothing in the other directions."""
    d = changes.shape[-1]
    return np.pad(changes, ((0, 0), (0, 0), (0, 3 - d), (0, 3 - d)))
