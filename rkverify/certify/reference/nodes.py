"""Node sets of the reference values: dyadic rationals, which doubles and most single precision numbers hold exactly."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np

from rkverify.arithmetic.base import Arithmetic
from rkverify.certify.reference.by_definition import Defined, number
from rkverify.certify.reference.case import Inputs, texts
from rkverify.paper.approximation import Approximation, approximation
from rkverify.readings import Window

Place = tuple[Fraction, ...]


@dataclass(frozen=True)
class Nodes:
    """Nodes (N, d) and supports (N,)."""

    places: tuple[Place, ...]
    supports: tuple[Fraction, ...]

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return len(self.places[0])


@dataclass(frozen=True)
class Discretised:
    """Nodes with kernel, order and window, in the forms that the routes take."""

    nodes: Nodes
    kernel: str = "cubic"
    order: int = 1
    window: Window = "radial"

    def inputs(self) -> Inputs:
        """As JSON data."""
        return {
            "nodes": texts(self.nodes.places),
            "supports": texts(self.nodes.supports),
            "kernel": self.kernel,
            "order": self.order,
            "window": self.window,
        }

    def literal(self, K: Arithmetic) -> Approximation:
        """For the transcription."""
        return approximation(self.nodes.places, list(self.nodes.supports), K, self.kernel, self.order, self.window)

    def defined(self) -> Defined:
        """For the route by definition."""
        places = [[number(c) for c in x] for x in self.nodes.places]
        return Defined(places, [number(a) for a in self.nodes.supports], self.kernel, self.order, self.window)

    def covering(self, x: Sequence[Fraction], most: int = 99) -> list[int]:
        """The nodes whose support covers x, decided in rationals; the nearest ones where there are more than wanted."""
        found = []
        for I, (place, a) in enumerate(zip(self.nodes.places, self.nodes.supports, strict=True)):
            squares = [(p - q) ** 2 for p, q in zip(x, place, strict=True)]
            far = sum(squares) if self.window == "radial" else max(squares)
            if far < a**2:
                found.append((sum(squares), I))
        return sorted(I for _, I in sorted(found)[:most])


def uniform(count: int, support: str) -> Nodes:
    """Nodes 0, 1, …, count - 1 on a line."""
    return Nodes(tuple((Fraction(n),) for n in range(count)), (Fraction(support),) * count)


def jittered(dimension: int, per_side: int, least: str, seed: int) -> Nodes:
    """A grid of spacing 1 whose coordinates moved by up to 12/64, with supports of their own from `least` to 3/8 more."""
    rng = np.random.default_rng([seed, dimension, per_side])
    grid = list(product(range(per_side), repeat=dimension))
    moves = rng.integers(-12, 13, size=(len(grid), dimension))
    places = tuple(
        tuple(c + Fraction(int(m), 64) for c, m in zip(place, row, strict=True))
        for place, row in zip(grid, moves, strict=True)
    )
    more = rng.integers(0, 7, size=len(grid))
    return Nodes(places, tuple(Fraction(least) + Fraction(int(m), 16) for m in more))


def vectors(count: int, dimension: int, seed: int) -> list[Place]:
    """Vectors with components from -1 to 1 in steps of 1/32."""
    rng = np.random.default_rng([seed, count, dimension])
    return [tuple(Fraction(int(m), 32) for m in row) for row in rng.integers(-32, 33, size=(count, dimension))]
