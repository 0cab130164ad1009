"""The Lagrangian bar as one matrix: gradients B (cells, nodes), F = 1 + B u (14), (16), force B^T (P A)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rkverify.kernels import Kernel
from rkverify.readings import Derivative, Integration, Mass
from rkverify.solid.kernel_values import Array
from rkverify.solid.line import line


@dataclass(frozen=True)
class Bar:
    """A periodic bar of evenly spaced nodes, stretched by u = (stretch - 1) X; prestress is S where F = stretch; rho_0 = 1.

    mass (nodes, nodes): the consistent mass over the lumped one; None for the lumped mass itself.
    """

    gradients: Array
    spacing: float
    modulus: float
    prestress: float
    stretch: float
    mass: Array | None = None

    @cached_property
    def slope_of_places(self) -> Array:
        """B X (N,), with the nearest copy of each node: 1 where the gradients reproduce linear fields; dimensionless."""
        # Rows of B sum to zero by symmetry, so that places count from the cell's own node.
        count = len(self.gradients)
        apart = np.arange(count)[None, :] - np.arange(count)[:, None]
        return np.asarray((self.gradients * (apart - np.round(apart / count) * count)).sum(axis=1) * self.spacing)

    def acceleration(self, displacements: Array) -> Array:
        """u'' of every node for displacements from the stretched state (N,), real or complex."""
        F = 1 + (self.stretch - 1) * self.slope_of_places + self.gradients @ displacements
        S = self.prestress + self.modulus * (F * F - self.stretch**2) / 2
        force = -(self.gradients.T @ (S * F))
        return force if self.mass is None else np.linalg.solve(self.mass, force)


def periodic_bar(
    count: int,
    spacing: float,
    support_ratio: float,
    integration: Integration,
    derivative: Derivative,
    kernel: Kernel,
    order: int,
    state: tuple[float, float, float],
    mass: Mass = "lumped",
) -> Bar:
    """A bar of `count` nodes; state is (modulus, prestress, stretch)."""
    X = np.arange(count) * spacing
    period = count * spacing

    def at(points: Array) -> Array:
        y = points[:, None] - X[None, :]
        return y - np.round(y / period) * period

    supports = np.full(count, support_ratio * spacing)
    if integration == "scni":
        ends = [line(at(X + side * spacing / 2), supports, kernel, order).shape() for side in (1, -1)]
        B = (ends[0] - ends[1]) / spacing
    else:
        B = line(at(X), supports, kernel, order).gradient(derivative)
    Psi = line(at(X), supports, kernel, order).shape()
    return Bar(B, spacing, *state, Psi.T @ Psi if mass == "consistent" else None)
