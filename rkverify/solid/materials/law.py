"""What a constitutive law is: it carries a state at every point to the next deformation gradient.

Stress is the first Piola-Kirchhoff stress P_iJ = dW/dF_iJ: space first, material second. The P_ji of (7) and the P_ki of (24) are the
nominal stress, its transpose.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import cauchy_stress, checked_gradients, refuse_inverted


@dataclass(frozen=True)
class State:
    """What a law knows at n points: F (n, d, d), P (n, d, d), sigma (n, 3, 3), alpha (n,).

    P: first Piola-Kirchhoff stress; sigma: the whole Cauchy stress, with what acts across the plane; alpha: accumulated
    plastic strain, 0 where there is no plasticity.
    """

    F: Array
    P: Array
    sigma: Array
    alpha: Array

    @property
    def cauchy(self) -> Array:
        """The Cauchy stress within the d dimensions (n, d, d)."""
        d = self.F.shape[-1]
        return self.sigma[:, :d, :d]


class Law(Protocol):
    """A constitutive law. The state that `advance` returns is new; the one given stays as it is."""

    def start(self, count: int, dimension: int) -> State:
        """The state of `count` points without deformation."""
        ...

    def advance(self, F: Any, state: State) -> State:
        """The state at F (n, d, d), reached from the given one in one step."""
        ...

    def tangent(self, F: Any, state: State) -> Array:
        """dP_ij/dF_kl (n, d, d, d, d) of `advance`, at F and from the given state."""
        ...


def undeformed(count: int, dimension: int) -> Array:
    """F = 1 at `count` points; raises BadInput for a dimension other than 1, 2, 3."""
    if dimension not in (1, 2, 3):
        raise BadInput(f"{dimension} dimensions are not offered: choose 1, 2 or 3")
    return np.tile(np.eye(dimension), (count, 1, 1))


class Hyperelastic(ABC):
    """P = dW/dF of a stored energy W(F): a law without memory, so that a state before is not asked for."""

    @abstractmethod
    def energy(self, F: Any) -> Array:
        """W(F) (n,), per undeformed volume."""

    @abstractmethod
    def stress(self, F: Any) -> Array:
        """P = dW/dF (n, d, d)."""

    @abstractmethod
    def tangent(self, F: Any, state: State | None = None) -> Array:
        """dP_ij/dF_kl (n, d, d, d, d)."""

    @abstractmethod
    def across(self, F: Array) -> Array:
        """The Cauchy stress (n,) on the directions that are not in F (n, d, d), the same on each."""

    def start(self, count: int, dimension: int) -> State:
        """The state of `count` points without deformation."""
        return self.advance(undeformed(count, dimension))

    def advance(self, F: Any, state: State | None = None) -> State:
        """The state at F (n, d, d); raises BadInput where a Cauchy stress is not defined, as det F is not positive."""
        F = checked_gradients(F)
        P = self.stress(F)
        return State(F, P, self.whole(F, self.cauchy(F, P)), np.zeros(len(F)))

    def cauchy(self, F: Array, P: Array) -> Array:
        """The Cauchy stress (n, d, d) of P; raises BadInput where det F is not positive."""
        refuse_inverted(F)
        return cauchy_stress(P, F)

    def whole(self, F: Array, cauchy: Array) -> Array:
        """The Cauchy stress (n, 3, 3) from its part within the d dimensions."""
        d = F.shape[-1]
        sigma = np.zeros((len(F), 3, 3), dtype=F.dtype)
        sigma[:, :d, :d] = cauchy
        for axis in range(d, 3):
            sigma[:, axis, axis] = self.across(F)
        return sigma

    def stored_energy(self, state: State) -> Array:
        """W (n,) of a state, per undeformed volume."""
        return self.energy(state.F)
