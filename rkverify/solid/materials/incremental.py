"""Laws that add up stress increments: the step from one deformation gradient to the next, and its derivative.

A step is seen at its middle: with H = F F_old^-1 and positions half-way between, the displacement gradient of the step is
G = 2 (H - 1)(H + 1)^-1. It is skew exactly where H is a rotation (T. J. R. Hughes, J. Winget, Int. J. Numer. Meth. Engng. 15
(1980) 1862-1867).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import (
    checked_gradients,
    determinant,
    embedded,
    first_piola_kirchhoff,
    inverse,
    refuse_inverted,
    trace,
    transposed,
)
from rkverify.solid.materials.law import State, undeformed
from rkverify.solid.materials.moduli import Moduli

HALF_TURN = 1e-10
"""det(H + 1) below which (H + 1)^-1 has lost more than half the digits of a double; it is at most 8 for a rotation."""


@dataclass(frozen=True)
class Step:
    """The step from state.F to F, everything (n, 3, 3): H = F F_old^-1, (H + 1)^-1, G = 2 (H - 1)(H + 1)^-1."""

    H: Array
    half: Array
    G: Array

    def slope(self, dH: Array) -> Array:
        """dG = (2 - G) dH (H + 1)^-1 for changes dH (n, m, 3, 3)."""
        return (2 * np.eye(3) - self.G)[:, None] @ dH @ self.half[:, None]


def step(F: Array, state: State) -> Step:
    """The step to F (n, d, d).

    Raises BadInput, naming the point, where det F is not positive or the step turns by half a turn.
    """
    refuse_inverted(F)
    H = embedded(F @ inverse(state.F))
    sum_of = H + np.eye(3)
    size = determinant(sum_of).real
    bad = np.flatnonzero(~(size > HALF_TURN))
    if len(bad):
        raise BadInput(
            f"point {bad[0]} turns by half a turn in one step, det(H + 1) = {size[bad[0]]:.3g}: take smaller steps"
        )
    half = inverse(sum_of)
    return Step(H, half, 2 * (H - np.eye(3)) @ half)


def unit_changes(F: Array, state: State) -> Array:
    """dH (n, d d, 3, 3) for a unit change of each F_kl, k before l."""
    d = F.shape[-1]
    units = np.eye(d * d).reshape(1, d * d, d, d)
    changes = np.zeros((len(F), d * d, 3, 3), dtype=F.dtype)
    changes[..., :d, :d] = units @ inverse(state.F)[:, None]
    return changes


class Incremental(ABC):
    """A law that predicts sigma (n, 3, 3) at F from the state before."""

    moduli: Moduli

    @abstractmethod
    def predicted(self, F: Array, state: State) -> Array:
        """The Cauchy stress sigma (n, 3, 3) at F."""

    @abstractmethod
    def predicted_slopes(self, F: Array, state: State) -> Array:
        """dsigma (n, d d, 3, 3) for a unit change of each F_kl, k before l."""

    def start(self, count: int, dimension: int, stress: Any = None) -> State:
        """The state of `count` points without deformation, under a Cauchy stress (3, 3) or (n, 3, 3) if one is given."""
        F = undeformed(count, dimension)
        sigma = np.zeros((count, 3, 3)) if stress is None else np.array(np.broadcast_to(stress, (count, 3, 3)))
        return State(F, self.first_piola(sigma, F), sigma, np.zeros(count))

    @staticmethod
    def of_state(F: Any, state: State) -> Array:
        """F as an array; raises BadInput where it has another shape than the state's."""
        value = checked_gradients(F)
        if value.shape != state.F.shape:
            raise BadInput(f"deformation gradients of shape {value.shape}: the state has {state.F.shape}; give as many")
        return value

    def advance(self, F: Any, state: State) -> State:
        """The state at F (n, d, d), in one step."""
        F = self.of_state(F, state)
        sigma = self.predicted(F, state)
        return State(F, self.first_piola(sigma, F), sigma, state.alpha)

    def tangent(self, F: Any, state: State) -> Array:
        """dP_ij/dF_kl (n, d, d, d, d) of `advance`."""
        F = self.of_state(F, state)
        return self.first_piola_slopes(self.predicted(F, state), self.predicted_slopes(F, state), F)

    def first_piola(self, sigma: Array, F: Array) -> Array:
        """P = J sigma F^-T (n, d, d)."""
        d = F.shape[-1]
        return first_piola_kirchhoff(sigma[:, :d, :d], F)

    def first_piola_slopes(self, sigma: Array, slopes: Array, F: Array) -> Array:
        """dP = P tr(F^-1 dF) + J dsigma F^-T - P dF^T F^-T, as (n, d, d, d, d)."""
        n, d, _ = F.shape
        G, P = transposed(inverse(F))[:, None], self.first_piola(sigma, F)[:, None]
        units = np.eye(d * d).reshape(1, d * d, d, d)
        changes = P * trace(transposed(G) @ units) - P @ transposed(units) @ G
        changes = changes + determinant(F)[:, None, None, None] * slopes[..., :d, :d] @ G
        return np.moveaxis(changes.reshape(n, d, d, d, d), (1, 2), (3, 4))
