"""Uniform, jittered, graded and random nodes in a non-convex plane domain with a hole and in a cube, with their cells."""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import Box, Domain, box, polygon_domain
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import voronoi

KINDS = ("uniform", "jittered", "graded", "random")
CLOSEST = 0.8
"""The least distance of random nodes, in spacings."""


@dataclass(frozen=True)
class SpaceNodes:
    """Positions (N, d) in a domain, their cells, and supports (N,); made-up unit of length."""

    domain_name: str
    kind: str
    positions: Array
    supports: Array
    domain: Domain | Box
    cells: Cells

    def cloud(self, order: int = 1, kernel: str = "cubic") -> Cloud:
        """The approximation on these nodes."""
        return cloud(self.positions, self.supports, kernel, order)


def plane_domain() -> Domain:
    """An L with a square hole in its corner, of area 2.84."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    hole = [(0.3, 0.3), (0.7, 0.3), (0.7, 0.7), (0.3, 0.7)]
    return polygon_domain([outline, hole])


def space_nodes(dimension: int, kind: str, spacing: float, support_ratio: float, seed: int) -> SpaceNodes:
    """One set of nodes about `spacing` apart: in `plane_domain()` for two dimensions, in the unit cube for three.

    jittered: off the lattice by up to 0.3 spacings along each axis; graded: spacings from 1/2 to 3/2 of it along each axis;
    random: in random order as long as they keep CLOSEST from all others. A support is the ratio times the distance of a node
    to the farthest vertex of its cell: what a vertex sees is then much the same everywhere.
    """
    domain: Domain | Box = plane_domain() if dimension == 2 else box([0] * dimension, [1] * dimension)
    rng = np.random.default_rng(seed)
    low, high = domain.bounds
    axes = [np.arange(low[j] + spacing / 2, high[j], spacing) for j in range(dimension)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, dimension)
    if kind == "jittered":
        x = x + rng.uniform(-0.3, 0.3, x.shape) * spacing
    elif kind == "graded":
        share = (x - low) / (high - low)
        x = low + share * (1 + share) / 2 * (high - low)
    elif kind == "random":
        x = _scattered(domain, rng.uniform(low, high, (30 * len(x), dimension)), CLOSEST * spacing)
    x = x[domain.contains(x)]
    cells = voronoi(x, domain)
    supports = support_ratio * _reach(x, cells)
    return SpaceNodes("L with a hole" if dimension == 2 else "cube", kind, x, supports, domain, cells)


def _reach(x: Array, cells: Cells) -> Array:
    """The distance of each node to the farthest vertex of its cell, (N,)."""
    farthest = np.zeros(len(x))
    places = cells.vertices[cells.corners]
    for side in cells.sides.T:
        owner = np.repeat(side, np.diff(cells.starts))
        inner = owner != OUTSIDE
        np.maximum.at(farthest, owner[inner], np.linalg.norm(places[inner] - x[owner[inner]], axis=1))
    return farthest


def _scattered(domain: Domain | Box, candidates: Array, closest: float) -> Array:
    kept: list[Array] = []
    for x in candidates[domain.contains(candidates)]:
        if not kept or (((np.array(kept) - x) ** 2).sum(axis=1) >= closest**2).all():
            kept.append(x)
    return np.array(kept)
