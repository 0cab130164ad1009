"""Node sets and points with rational coordinates, for exact checks in one dimension."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product

import numpy as np


@dataclass(frozen=True)
class NodeSet:
    """Nodes in [0, 1] and support radii, points to look at, and velocities, all rational; made-up units."""

    name: str
    nodes: tuple[Fraction, ...]
    supports: tuple[Fraction, ...]
    points: tuple[Fraction, ...]
    velocities: tuple[Fraction, ...]


def rational_node_sets(count: int, seed: int) -> list[NodeSet]:
    """A uniform, a graded and a jittered set of `count` nodes, the last with supports of their own.

    The points are nodes, mid-points, a kernel's joint and the very edge of a support. Every point has at least
    three nodes under the kernels, enough for order 2.
    """
    rng = np.random.default_rng(seed)
    h = Fraction(1, count - 1)
    uniform = [j * h for j in range(count)]
    jitter = [Fraction(int(q), 100) * h for q in rng.integers(-35, 36, size=count)]
    own = tuple((3 + Fraction(int(q), 20)) * h for q in rng.integers(0, 20, size=count))
    graded = [x * (1 + x) / 2 for x in uniform]
    widest = max(q - p for p, q in pairwise(graded))
    velocities = tuple(Fraction(int(q), 10) for q in rng.integers(-10, 11, size=count))
    return [
        _set("uniform", uniform, tuple([Fraction(5, 2) * h] * count), velocities),
        _set("graded", graded, tuple([Fraction(5, 2) * widest] * count), velocities),
        _set("jittered, own supports", [x + e for x, e in zip(uniform, jitter, strict=True)], own, velocities),
    ]


def _set(name: str, nodes: list[Fraction], supports: tuple[Fraction, ...], velocities: tuple[Fraction, ...]) -> NodeSet:
    middle = len(nodes) // 2
    points = (
        nodes[middle],
        (nodes[middle] + nodes[middle + 1]) / 2,
        nodes[middle] + supports[middle] / 2,  # the cubic kernel's joint
        nodes[middle] + supports[middle],  # the edge of a support
        nodes[0] + (nodes[1] - nodes[0]) / 3,
    )
    return NodeSet(name, tuple(nodes), supports, points, velocities)


def jittered_grid(dimension: int, per_side: int, seed: int) -> list[tuple[Fraction, ...]]:
    """The nodes of a grid with spacing 1 and `per_side` nodes along each axis, each moved by up to a quarter."""
    rng = np.random.default_rng(seed)
    return [
        tuple(
            Fraction(c) + Fraction(int(q), 100)
            for c, q in zip(place, rng.integers(-25, 26, size=dimension), strict=True)
        )
        for place in product(range(per_side), repeat=dimension)
    ]
