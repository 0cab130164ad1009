"""Bodies to try: nodes of four kinds in an L with a hole and in a square, boundary nodes on the boundary, with their cells."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rkverify.readings import NodalIntegration
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import Box, Domain, box, polygon_domain
from rkverify.solid.gradients import GradientOperator, boundary_integrals, dni, scni, snni
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import voronoi

KINDS = ("uniform", "jittered", "graded", "random")
L_SHAPE = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0))
HOLE = ((0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75))
JITTER = 0.3
"""Largest distance of a jittered node from its place, in spacings, along each axis."""
CLOSEST = 0.6
"""Least distance between random nodes, in spacings."""


@dataclass(frozen=True)
class Specimen:
    """Positions (N, 2), the nodes on the boundary, the domain and the spacing h; length without unit."""

    name: str
    kind: str
    positions: Array
    on_boundary: Array
    domain: Domain | Box
    spacing: float

    @cached_property
    def cells(self) -> Cells:
        """The nodes' Voronoi cells in the domain."""
        return voronoi(self.positions, self.domain)

    def cloud(self, support_ratio: float, order: int = 1) -> Cloud:
        """The approximation with supports of the ratio times the spacing, cubic kernel."""
        return cloud(self.positions, support_ratio * self.spacing, order=order)

    def operator(self, near: Cloud, integration: NodalIntegration, rule: str = "trapezoid") -> GradientOperator:
        """SCNI, DNI or SNNI, each with the integrals over the boundary by the rule."""
        if integration == "scni":
            return scni(near, self.cells, rule)
        edge = boundary_integrals(near, self.cells, rule)
        if integration == "dni":
            return dni(near, self.cells.measures, boundary=edge)
        return snni(near, self.cells.measures, boundary=edge)


def l_with_hole(kind: str, divisions: int, seed: int) -> Specimen:
    """The L with a hole, `divisions` spacings to a unit of length (a multiple of 4, so that corners are nodes)."""
    return _specimen("L with a hole", kind, polygon_domain([L_SHAPE, HOLE]), (2.0, 2.0), divisions, seed)


def square(kind: str, divisions: int, seed: int) -> Specimen:
    """The unit square."""
    return _specimen("square", kind, box([0, 0], [1, 1]), (1.0, 1.0), divisions, seed)


def _specimen(
    name: str, kind: str, domain: Domain | Box, extent: tuple[float, float], divisions: int, seed: int
) -> Specimen:
    h = 1 / divisions
    rng = np.random.default_rng(seed)
    axes = [np.arange(round(length * divisions) + 1) / divisions for length in extent]
    lattice = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    lattice = lattice[domain.contains(lattice)]
    edge = _distance(lattice, domain) < h / 4
    fixed, inner = lattice[edge], lattice[~edge]
    if kind == "jittered":
        inner = inner + JITTER * h * rng.uniform(-1, 1, inner.shape)
    elif kind == "graded":  # quarters of the axes keep their ends, where the boundary may be
        fixed, inner = _graded(fixed), _graded(inner)
    elif kind == "random":
        inner = _scattered(fixed, rng.uniform(0, extent, (40 * len(inner), 2)), domain, h)
    positions = np.concatenate([fixed, inner])
    return Specimen(name, kind, positions, np.arange(len(fixed)), domain, h)


def _graded(x: Array) -> Array:
    """Spacings that vary between 0.6 and 1.4 within each quarter of a unit of length."""
    part, t = np.divmod(4 * x, 1)
    return (part + t + 0.4 * t * (1 - t)) / 4


def _distance(x: Array, domain: Domain | Box) -> Array:
    """The distance of points (n, 2) to the nearest of the boundary's sides (n,)."""
    nearest = np.full(len(x), np.inf)
    for ring in domain.rings:
        for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            side = end - start
            t = np.clip((x - start) @ side / (side @ side), 0, 1)
            nearest = np.minimum(nearest, np.linalg.norm(x - start - t[:, None] * side, axis=1))
    return nearest


def _scattered(fixed: Array, candidates: Array, domain: Domain | Box, h: float) -> Array:
    """Random points that keep CLOSEST from each other, from the fixed ones, and half of that from the boundary."""
    inside = candidates[domain.contains(candidates)]
    inside = inside[_distance(inside, domain) > CLOSEST * h / 2]
    kept = list(fixed)
    for x in inside:
        if ((np.array(kept) - x) ** 2).sum(axis=1).min() >= (CLOSEST * h) ** 2:
            kept.append(x)
    return np.array(kept[len(fixed) :])
