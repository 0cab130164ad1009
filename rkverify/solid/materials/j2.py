"""J2 plasticity with linear isotropic hardening, by radial return from what an incremental elastic law predicts.

Yield function f = q - (sigma_y + H alpha) with q = sqrt(3/2 s : s), s = dev sigma; associated flow. Small strain with `SmallStrain`, finite strain
with `Jaumann` (or `Truesdell`) as the elastic law. Source: J. C. Simo, T. J. R. Hughes, Computational Inelasticity (Springer, 1998), box 3.2 (there
with sqrt(2/3) q) and section 8.3.
"""

from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.incremental import Incremental
from rkverify.solid.materials.kinematics import trace
from rkverify.solid.materials.law import State


@dataclass(frozen=True)
class J2:
    """s = (1 - 3 mu dalpha/q) s_trial with dalpha = f_trial/(3 mu + H) where f_trial > 0; the pressure is elastic.

    yield_stress: sigma_y in uniaxial tension; hardening: H = dsigma_y/dalpha, which may be negative. Raises BadInput for a
    yield stress that is not positive or a hardening of -3 mu or less.
    """

    elastic: Incremental
    yield_stress: float
    hardening: float = 0.0

    def __post_init__(self) -> None:
        if not (isfinite(self.yield_stress) and self.yield_stress > 0):
            raise BadInput(f"yield stress {self.yield_stress:g}: it must be positive and finite")
        if not (isfinite(self.hardening) and self._stiffness > 0):
            raise BadInput(f"hardening {self.hardening:g}: it must be above -3 mu = {-3 * self.elastic.moduli.shear:g}")

    @property
    def _stiffness(self) -> float:
        """3 mu + H."""
        return 3 * self.elastic.moduli.shear + self.hardening

    def start(self, count: int, dimension: int, stress: Any = None) -> State:
        """The state of `count` points without deformation, under a Cauchy stress if one is given."""
        return self.elastic.start(count, dimension, stress)

    def strength(self, alpha: Array) -> Array:
        """sigma_y + H alpha (n,); a stress."""
        return self.yield_stress + self.hardening * alpha

    def yield_function(self, state: State) -> Array:
        """f = q - (sigma_y + H alpha) (n,), not positive where the state is admissible; a stress."""
        return mises_stress(state.sigma) - self.strength(state.alpha)

    def advance(self, F: Any, state: State) -> State:
        """The state at F (n, d, d), in one step."""
        F = self.elastic.of_state(F, state)
        trial = self.elastic.predicted(F, state)
        q, strength = mises_stress(trial), self.strength(state.alpha)
        flows = (q - strength).real > 0
        more = np.where(flows, (q - strength) / self._stiffness, 0.0)
        kept = 1 - 3 * self.elastic.moduli.shear * more / np.where(flows, q, 1.0)
        sigma = trial - (1 - kept)[:, None, None] * deviator(trial)
        return State(F, self.elastic.first_piola(sigma, F), sigma, state.alpha + more)

    def tangent(self, F: Any, state: State) -> Array:
        """dP_ij/dF_kl (n, d, d, d, d) of `advance`, consistent with the return.

        ds = kept ds_trial - 3 mu sigma_y'/((3 mu + H) q^2) dq s_trial with dq = 3/2 s_trial : ds_trial/q, sigma_y' the strength before.
        """
        F = self.elastic.of_state(F, state)
        trial, slopes = self.elastic.predicted(F, state), self.elastic.predicted_slopes(F, state)
        s, q, strength = deviator(trial), mises_stress(trial), self.strength(state.alpha)
        flows = (q - strength).real > 0
        safe = np.where(flows, q, 1.0)
        lost = np.where(flows, 3 * self.elastic.moduli.shear * (1 - strength / safe) / self._stiffness, 0.0)
        dq = 1.5 * (s[:, None] * slopes).sum(axis=(2, 3)) / safe[:, None]
        bend = np.where(flows, 3 * self.elastic.moduli.shear * strength / (self._stiffness * safe**2), 0.0)
        changes = slopes - lost[:, None, None, None] * deviator(slopes)
        changes = changes - (bend[:, None] * dq)[..., None, None] * s[:, None]
        sigma = trial - lost[:, None, None] * s
        return self.elastic.first_piola_slopes(sigma, changes, F)

    def stored_energy(self, state: State) -> Array:
        """sigma : C^-1 : sigma/2 + H alpha^2/2 (n,), elastic energy and energy of hardening; at small strain."""
        return self.elastic.moduli.energy_of_stress(state.sigma) + self.hardening * state.alpha**2 / 2


def deviator(sigma: Array) -> Array:
    """s = sigma - tr(sigma)/3 1 for (…, 3, 3)."""
    return sigma - trace(sigma) / 3 * np.eye(3)


def mises_stress(sigma: Array) -> Array:
    """q = sqrt(3/2 s : s) (n,) for stresses (n, 3, 3)."""
    s = deviator(sigma)
    return np.sqrt(1.5 * (s * s).sum(axis=(-2, -1)))
