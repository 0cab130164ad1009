"""Clouds of one to three dimensions, and honest numbers on them that tests then spoil."""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
import pytest

from rkverify.check.claim import Claim, predicted
from rkverify.check.entries import Entries
from rkverify.solid.cloud import cloud

SIZES = {1: 14, 2: 9, 3: 6}
RADII = {1: 2.3, 2: 3.3}


@dataclass(frozen=True)
class Case:
    """A claim with the columns of its numbers."""

    claim: Claim
    columns: tuple[str, ...]

    def numbers(self, **change: object) -> Entries:
        """The numbers of the claim, or of one that differs from it."""
        return predicted(replace(self.claim, **change), self.columns)


def _jittered(dimension: int, seed: int = 4) -> np.ndarray:
    rng = np.random.default_rng(seed)
    lattice = np.array(list(product(range(SIZES[dimension]), repeat=dimension)), dtype=float)
    return lattice + rng.uniform(-0.2, 0.2, lattice.shape)


def _case(dimension: int, order: int = 1, own: bool = False, points: int = 20) -> Case:
    rng = np.random.default_rng(dimension + 10 * order)
    nodes = _jittered(dimension)
    radius = RADII[max(order, 1)]
    low, high = 1.0, SIZES[dimension] - 2.0
    places = rng.uniform(low, high, (points, dimension))
    supports = rng.uniform(radius, 1.25 * radius, len(nodes)) if own else radius
    at_points = rng.uniform(radius, 1.25 * radius, points) if own else np.full(points, radius)
    names = ("psi", *(f"dpsi_d{axis}" for axis in "xyz"[:dimension]))
    return Case(Claim(cloud(nodes, supports, order=order), places, point_supports=at_points), names)


@pytest.fixture
def case():
    """case(dimension, order, own=…, points=…) -> Case."""
    return _case


@pytest.fixture
def plane() -> Case:
    return _case(2)


@pytest.fixture
def jittered():
    """jittered(dimension) -> nodes (N, d) near a lattice of unit spacing."""
    return _jittered
