"""Where searches for worst cases start: a few nodes about a lattice, flattened or in one plane, and all that the quantity takes."""

from dataclasses import dataclass

import numpy as np

from rkverify.certify.worst.case import KINDS, WorstCase
from rkverify.solid.kernel_values import Array

PER_SIDE = {(1, 0): 4, (1, 1): 5, (1, 2): 6, (2, 0): 3, (2, 1): 3, (2, 2): 4, (3, 0): 2, (3, 1): 2, (3, 2): 3}
"""(dimension, order) -> nodes along each axis of the lattice."""
JITTER = 0.3
TURNED = ("value", "first", "second", "eigenvalue", "psi_star", "true_rate")
GRAIN = 2.0**-10
"""Nodes that must be in one plane exactly are whole multiples of it."""


@dataclass(frozen=True)
class Search:
    """What is searched for, among nodes flattened to a share 10^-flat of their height, and how long: from a seed, always the same.

    aim: ratio of error and bound; condition, the largest at which `solid/` answers; margin, how near a singular matrix comes
    to an answer.
    """

    quantity: str
    dimension: int
    order: int = 1
    window: str = "radial"
    kernel: str = "cubic"
    reading: str = "full"
    flat: float = 0.0
    seed: int = 0
    steps: int = 300
    aim: str = "ratio"

    @property
    def words(self) -> str:
        """The search in words, from which it can be done again."""
        return f"Search({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"

    def start(self, rng: np.random.Generator) -> WorstCase:
        """A random case."""
        d, side = self.dimension, PER_SIDE[self.dimension, self.order]
        grid = np.stack(np.meshgrid(*[np.arange(float(side))] * d, indexing="ij"), axis=-1).reshape(-1, d)
        x = grid + rng.uniform(-JITTER, JITTER, grid.shape)
        point = rng.uniform(0, side - 1, d)
        if self.quantity == "pivot":
            x = _in_one_plane(x, self.order)
        heights = np.ones(d)
        heights[-1] = 10.0**-self.flat
        middle = np.full(d, (side - 1) / 2)
        low, high = np.full(d, -0.5), np.full(d, side - 0.5)
        turn = _turn(d) if self.quantity in TURNED else np.eye(d)
        x, point, low, high = (middle + (heights * (part - middle)) @ turn.T for part in (x, point, low, high))
        drawn = {
            "supports": rng.uniform(0.9, 1.3, len(x)) * (side if self.order < 2 else 0.9 * side) * np.sqrt(d),
            "kernel": self.kernel,
            "order": self.order,
            "window": self.window,
            "reading": self.reading,
            "point": point,
            "velocity": rng.uniform(-1, 1, d),
            "node_velocities": rng.uniform(-1, 1, x.shape),
            "cell": _ring(rng, d, middle, heights),
            "low": low,
            "high": high,
        }
        takes = KINDS[self.quantity].takes
        return WorstCase("", self.quantity, self.words, 0.0, x, **{key: drawn[key] for key in takes})


def _turn(d: int) -> Array:
    """A rotation that leaves no plane of the axes where it was, so that no rescaling of coordinates undoes a flattening."""
    turn = np.eye(d)
    for axis in range(d - 1):
        one = np.eye(d)
        one[np.ix_([axis, d - 1], [axis, d - 1])] = [[0.8, -0.6], [0.6, 0.8]]
        turn = one @ turn
    return turn


def _in_one_plane(x: Array, order: int) -> Array:
    """Nodes whose last coordinate is a linear function of the first for order 1, one of two values for order 2, exactly."""
    x = np.round(x / GRAIN) * GRAIN
    if order == 2:
        x[:, -1] = np.where(np.arange(len(x)) % 2, 1.25, 1.75)
    else:
        x[:, -1] = 0.75 * x[:, 0] + 0.25
    return x


def _ring(rng: np.random.Generator, d: int, middle: Array, heights: Array) -> Array:
    """Two ends, or a convex polygon about the middle, counter-clockwise."""
    if d == 1:
        return np.sort(middle + rng.uniform(-0.8, 0.8, (2, 1)), axis=0)
    angles = np.sort((np.arange(5) + rng.uniform(-0.3, 0.3, 5)) * 2 * np.pi / 5)
    corners = np.stack([np.cos(angles), np.sin(angles)], axis=1)[:, :d]
    found: Array = middle[:2] + 0.7 * heights[:2] * corners
    return found
