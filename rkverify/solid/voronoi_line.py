"""Voronoi cells on a line: from half-way to the neighbour on the left to half-way to the one on the right."""

import numpy as np

from rkverify.solid.cell_topology import Topology
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.domain import Box
from rkverify.solid.kernel_values import Array


def line_topology(positions: Array, domain: Box) -> Topology:
    """The topology of the cells of nodes at positions (N, 1) in an interval: one facet between neighbours, one at each end."""
    order = np.argsort(positions[:, 0])
    pairs = np.stack([order[:-1], order[1:]], axis=1)
    ends = np.arange(len(order) + 1)[:, None]
    sides = np.concatenate([pairs, [[order[0], OUTSIDE], [order[-1], OUTSIDE]]])
    signs = np.concatenate([np.ones(len(pairs)), [-1.0, 1.0]])
    nothing = np.empty((0, 1))
    fixed = np.stack([domain.low, domain.high])
    return Topology(pairs, pairs[:0], nothing, nothing, fixed, ends, sides, signs)
