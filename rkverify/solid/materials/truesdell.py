"""Hypoelasticity with the Truesdell rate: sigma' = C : D + L sigma + sigma L^T - tr(L) sigma.

The push-forward J^-1 F (.) F^T of a rate of the second Piola-Kirchhoff stress. Simple shear does not oscillate: sigma_12 = mu gamma, sigma_11 =
mu gamma^2. In one dimension sigma' = (C + sigma) L, the reading `truesdell`, whose C^sigma + sigma the paper calls the tangent modulus.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.incremental import Incremental, step, unit_changes
from rkverify.solid.materials.kinematics import determinant, inverse, trace, transposed
from rkverify.solid.materials.law import State
from rkverify.solid.materials.moduli import Moduli


@dataclass(frozen=True)
class Truesdell(Incremental):
    """sigma = H sigma_old H^T/det H + K (C : sym G) K^T/det K with K = 2 H (H + 1)^-1, from the middle of the step to its end.

    The stress before is pushed forward exactly, whatever the step; the increment, which belongs to the middle, likewise. In
    simple shear the closed form comes out without error, in rotations the rotated stress.
    """

    moduli: Moduli

    def predicted(self, F: Array, state: State) -> Array:
        """H sigma_old H^T/det H + K (C : sym G) K^T/det K (n, 3, 3)."""
        seen = step(F, state)
        return _pushed(state.sigma, seen.H) + _pushed(self.moduli.of(seen.G), 2 * seen.H @ seen.half)

    def predicted_slopes(self, F: Array, state: State) -> Array:
        """The product rule, with dK = (2 - K) dH (H + 1)^-1."""
        seen, dH = step(F, state), unit_changes(F, state)
        K = 2 * seen.H @ seen.half
        dK = (2 * np.eye(3) - K)[:, None] @ dH @ seen.half[:, None]
        increment, slopes = self.moduli.of(seen.G), self.moduli.of(seen.slope(dH))
        return _pushed_slope(state.sigma, seen.H, dH) + _pushed_slope(increment, K, dK) + _pushed(slopes, K[:, None])


def _pushed(tau: Array, H: Array) -> Array:
    """H tau H^T/det H."""
    return H @ tau @ transposed(H) / determinant(H)[..., None, None]


def _pushed_slope(tau: Array, H: Array, dH: Array) -> Array:
    """The change of H tau H^T/det H with H, symmetric tau, for changes dH (n, m, 3, 3)."""
    J = determinant(H)[:, None, None, None]
    one = dH @ (tau @ transposed(H))[:, None] / J
    return one + transposed(one) - _pushed(tau, H)[:, None] * trace(inverse(H)[:, None] @ dH)
