"""Periodic node sets in the plane and in space, with nearest neighbours at distance 1 before any node is moved off its place."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Lattice:
    """Nodes at nodes[B] + m . periods for all integers m: periods (d, d), one in each row, nodes (n, d), lengths."""

    periods: Array
    nodes: Array

    def __len__(self) -> int:
        """The number n of nodes in a period."""
        return len(self.nodes)

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return len(self.periods)

    @property
    def measure(self) -> float:
        """The area or volume of a period."""
        return float(abs(np.linalg.det(self.periods)))

    @property
    def reciprocal(self) -> Array:
        """The wave vectors G (d, d), one in each row, with G_p . periods[q] = 2 pi delta_pq."""
        return 2 * np.pi * np.linalg.inv(self.periods).T

    def around(self, radius: float) -> "Patch":
        """All nodes that are closer than the radius to a node of the first period; these come first, in order."""
        size = np.ptp(self.nodes, axis=0).max() + radius
        heights = 2 * np.pi / np.linalg.norm(self.reciprocal, axis=1)
        counts = np.ceil(1.5 * size / heights).astype(int) + 1
        shifts = np.array(list(product(*(range(-m, m + 1) for m in counts))))
        shifts = shifts[np.argsort(abs(shifts).sum(axis=1), kind="stable")]
        x = (self.nodes[None] + (shifts @ self.periods)[:, None]).reshape(-1, self.dimension)
        basis = np.tile(np.arange(len(self)), len(shifts))
        near = (np.linalg.norm(x[:, None] - self.nodes[None], axis=2) < radius).any(axis=1)
        return Patch(x[near], basis[near])


@dataclass(frozen=True)
class Patch:
    """A part of a lattice: positions (P, d), and which node of the period each is a copy of (P,)."""

    positions: Array
    basis: Array


def lattice(name: str) -> Lattice:
    """The square lattice, or the hexagonal one (a triangular net with hexagonal cells), with spacing 1.

    Raises UnknownName.

    >>> round(lattice("hexagonal").measure, 6)
    0.866025
    """
    if name not in LATTICES:
        raise UnknownName("lattice", name, tuple(LATTICES))
    return Lattice(np.array(LATTICES[name]), np.zeros((1, 2)))


def cubic() -> Lattice:
    """The simple cubic lattice, whose Voronoi cells are cubes, with spacing 1."""
    return Lattice(np.eye(3), np.zeros((1, 3)))


LATTICES = {"square": ((1.0, 0.0), (0.0, 1.0)), "hexagonal": ((1.0, 0.0), (0.5, 0.75**0.5))}


def supercell(of: Lattice, count: int) -> Lattice:
    """The same nodes with a period of count of the given ones along each axis."""
    if count < 1:
        raise BadInput(f"a period of {count} nodes along each axis: take at least one")
    steps = np.array(list(product(range(count), repeat=of.dimension)))
    nodes = (of.nodes[None] + (steps @ of.periods)[:, None]).reshape(-1, of.dimension)
    return Lattice(count * of.periods, nodes)


def jittered(of: Lattice, count: int, jitter: float, seed: int) -> Lattice:
    """A period of count nodes along each axis, every coordinate off its place by up to the jitter."""
    whole = supercell(of, count)
    offsets = np.random.default_rng(seed).uniform(-jitter, jitter, whole.nodes.shape)
    return Lattice(whole.periods, whole.nodes + offsets)


def turned(of: Lattice, angle: float) -> Lattice:
    """The lattice turned counter-clockwise by the angle (rad)."""
    Q = rotation(angle)
    return Lattice(of.periods @ Q.T, of.nodes @ Q.T)


def rotation(angle: float) -> Array:
    """The matrix that turns the plane counter-clockwise by the angle (rad)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])
