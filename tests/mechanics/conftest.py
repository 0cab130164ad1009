"""A small body on uneven nodes, in the plane and in space, that the tests of mechanics share."""

import numpy as np
import pytest

from rkverify.solid.cells import Cells
from rkverify.solid.cloud import cloud
from rkverify.solid.domain import box
from rkverify.solid.gradients import GradientOperator, dni, scni, snni
from rkverify.solid.materials.law import Law
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.mechanics.body import Body, body
from rkverify.solid.voronoi import voronoi

MODULI = Moduli(1.5, 0.8)


class Block:
    """Nodes in the unit square or cube, boundary nodes on the boundary, the others off the lattice; supports of their own."""

    def __init__(self, dimension: int = 2, side: int = 5, seed: int = 3, support: float = 2.3):
        rng = np.random.default_rng(seed)
        axis = np.linspace(0, 1, side)
        x = np.stack(np.meshgrid(*[axis] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension)
        inner = ((x > 0) & (x < 1)).all(axis=1)
        spacing = 1 / (side - 1)
        x[inner] += 0.2 * spacing * rng.uniform(-1, 1, (inner.sum(), dimension))
        self.positions, self.spacing, self.rng = x, spacing, rng
        self.domain = box([0] * dimension, [1] * dimension)
        self.cells: Cells = voronoi(x, self.domain)
        self.cloud = cloud(x, support * spacing * rng.uniform(1, 1.1, len(x)))

    def operator(self, integration: str = "scni", rule: str = "trapezoid") -> GradientOperator:
        if integration == "scni":
            return scni(self.cloud, self.cells, rule)
        return (dni if integration == "dni" else snni)(self.cloud, self.cells.measures)

    def body(self, integration: str = "scni", law: Law | None = None, rule: str = "trapezoid") -> Body:
        return body(self.cloud, self.operator(integration, rule), law or NeoHookean(MODULI), density=1.3)

    def small(self, size: float = 0.02) -> np.ndarray:
        """Random coefficients that turn nothing inside out."""
        return size * self.rng.uniform(-1, 1, self.positions.shape)


@pytest.fixture
def block():
    return Block


@pytest.fixture
def moduli():
    return MODULI
