"""Hypoelasticity with the Jaumann rate: sigma' = C : D + W sigma - sigma W with D = sym L, W = skew L.

There is no energy behind it: work on closed paths is not zero, and simple shear oscillates, sigma_12 = mu sin(gamma) (J. K. Dienes,
Acta Mechanica 32 (1979) 217-232). In one dimension sigma' = C L, the reading `cauchy-rate`.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.incremental import Incremental, step, unit_changes
from rkverify.solid.materials.kinematics import inverse, skew, transposed
from rkverify.solid.materials.law import State
from rkverify.solid.materials.moduli import Moduli


@dataclass(frozen=True)
class Jaumann(Incremental):
    """sigma = Q (sigma_old + C : G/2) Q^T + C : G/2 with Q = (1 - w/2)^-1 (1 + w/2), w = skew G (Q of Hughes and Winget, see `incremental`).

    Q is the rotation itself where the step is one, whatever its angle below half a turn. Half of the increment, which
    belongs to the middle of the step, is turned along: the error of a step is of third order in it, and would be of second
    order if nothing or all of it were turned.
    """

    moduli: Moduli

    def predicted(self, F: Array, state: State) -> Array:
        """Q (sigma_old + C : G/2) Q^T + C : G/2 (n, 3, 3)."""
        G = step(F, state).G
        Q, half = rotation(skew(G)), self.moduli.of(G) / 2
        return Q @ (state.sigma + half) @ transposed(Q) + half

    def predicted_slopes(self, F: Array, state: State) -> Array:
        """The product rule, with dQ = (1 - w/2)^-1 dw/2 (1 + Q)."""
        seen = step(F, state)
        w = skew(seen.G)
        Q = rotation(w)
        dG = seen.slope(unit_changes(F, state))
        dQ = (inverse(np.eye(3) - w / 2))[:, None] @ skew(dG) @ (np.eye(3) + Q)[:, None] / 2
        turned = dQ @ ((state.sigma + self.moduli.of(seen.G) / 2) @ transposed(Q))[:, None]
        half = self.moduli.of(dG) / 2
        return turned + transposed(turned) + Q[:, None] @ half @ transposed(Q)[:, None] + half


def rotation(w: Array) -> Array:
    """Q = (1 - w/2)^-1 (1 + w/2) for skew w (n, 3, 3): orthogonal, by Cayley."""
    return inverse(np.eye(3) - w / 2) @ (np.eye(3) + w / 2)
