"""Accounts of a body in motion: mass, momentum, angular momentum about the origin, energy."""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Account:
    """What a body has at one time. momentum (d,); angular: one number in the plane, (3,) in space, nothing on a line."""

    time: float
    mass: float
    momentum: Array
    angular: Array
    kinetic: float
    stored: float

    @property
    def energy(self) -> float:
        """Kinetic and stored energy."""
        return self.kinetic + self.stored


def account(time: float, mass: Array, positions: Array, velocities: Array, stored: float) -> Account:
    """sum m_I, sum m_I v_I, sum x_I x m_I v_I, sum m_I |v_I|^2/2 with lumped masses m_I (N,) and coefficients (N, d)."""
    p = mass[:, None] * velocities
    return Account(
        time,
        float(mass.sum()),
        p.sum(axis=0),
        cross(positions, p).sum(axis=0),
        float((p * velocities).sum() / 2),
        stored,
    )


def cross(x: Array, p: Array) -> Array:
    """x cross p (N, c): c = 0, 1, 3 in one, two, three dimensions."""
    if x.shape[1] == 1:
        return np.zeros((len(x), 0))
    if x.shape[1] == 2:
        return (x[:, 0] * p[:, 1] - x[:, 1] * p[:, 0])[:, None]
    return np.cross(x, p)
