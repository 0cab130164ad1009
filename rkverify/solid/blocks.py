"""Points in blocks whose entries fit into the processor's cache, taken through the compiled stages one after another."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NoReturn

import numpy as np

from rkverify.errors import BadInput, SingularMomentMatrix, TooFewNodes
from rkverify.solid.bases import basis_tables
from rkverify.solid.cloud import Cloud, checked_positions, shown
from rkverify.solid.compiled_shape import FEW, FINE, moment_stage
from rkverify.solid.compiled_weights import kernel_stage, offset_stage, weight_stage
from rkverify.solid.kernel_data import kernel_data
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import Neighbours

_ENTRIES = 1 << 14


@dataclass(frozen=True)
class Block:
    """Points first to last: scale (B,), scaled offsets (d, E), phi and its derivatives (1 + …, E), factors of M, b (B, m)."""

    nodes: Array
    starts: Array
    first: int
    last: int
    scale: Array
    offsets: Array
    weights: Array
    factors: Array
    b: Array

    @property
    def of_shape(self) -> tuple[Any, ...]:
        """What the compiled stage of derivatives begins with."""
        return (
            self.starts, self.first, self.last, self.scale, self.offsets, self.weights, self.factors, self.b,
        )  # fmt: skip


def numbers(cloud: Cloud, points: Array) -> Array:
    """The points in the number type of points and nodes together: complex where either is."""
    return np.ascontiguousarray(points, np.result_type(points, cloud.positions))


def blocks(cloud: Cloud, x: Array, known: Neighbours, derivatives: int, factorise: bool = True) -> Iterator[Block]:
    """The points in blocks, each with the kernels' derivatives up to the given order and the factors of M (or M itself).

    Arrays of a block are written over by the next. Raises TooFewNodes and SingularMomentMatrix, BadInput for neighbours of other points.
    """
    starts, nodes = (np.ascontiguousarray(part, np.int64) for part in (known.starts, known.nodes))
    d, tensor = cloud.dimension, cloud.window == "tensor"
    if len(known) != len(x):
        raise BadInput(f"neighbours of {len(known)} points are given for {len(x)} points: give them of the same points")
    if (np.diff(starts) < 0).any() or (starts[0], starts[-1]) != (0, len(nodes)):
        raise BadInput(f"the starts of neighbours must ascend from 0 to their number {len(nodes)}")
    if len(nodes) and not 0 <= nodes.min() <= nodes.max() < len(cloud):
        raise BadInput(
            f"neighbours from node {nodes.min()} to {nodes.max()} are given, the nodes run from 0 to {len(cloud) - 1}"
        )
    if not len(x):
        return
    m, edges, count = basis_tables(d, cloud.order).size, _edges(starts), d if tensor else 1
    placed = np.column_stack([cloud.positions, cloud.supports]).astype(
        x.dtype, copy=False
    )  # one place in memory for a node
    common = float(cloud.supports[0]) if (cloud.supports == cloud.supports[0]).all() else 0.0
    spans = list(pairwise(edges))
    most, rows = max(int(starts[last] - starts[first]) for first, last in spans), int(np.diff(edges).max())
    heights = [d, *[count] * 4, 1 + d + d * (d + 1) // 2]
    room = [np.empty(height * most, x.dtype) for height in heights]
    scale, supports, ratios = np.empty(rows), np.empty(most), np.empty(most)
    factors, b = np.empty((rows, m * (m + 1) // 2), x.dtype), np.empty((rows, m), x.dtype)
    data = kernel_data(cloud.kernel).constants
    offsets, weights_of, moments = offset_stage(d, tensor), weight_stage(d, tensor), moment_stage(d, cloud.order)
    for first, last in spans:
        here = int(starts[last] - starts[first])
        y, z, f, g, s, weights = (
            memory[: height * here].reshape(height, here) for memory, height in zip(room, heights, strict=True)
        )
        offsets(starts, nodes, x, placed, common, first, last, scale, supports, ratios, y, z)
        kernel_stage(z.ravel(), derivatives, *data, *(part.ravel() for part in (f, g, s)))
        weights_of(derivatives, ratios, y, f, g, s, weights)
        point, fault, number, rest = moments(starts, first, last, y, weights, factorise, factors, b)
        if fault != FINE:
            _refuse(cloud, x, point, fault, number, rest)
        yield Block(nodes, starts, first, last, scale, y, weights, factors[: last - first], b)


def _edges(starts: Array) -> list[int]:
    edges = [0]
    while edges[-1] < len(starts) - 1:
        reached = int(np.searchsorted(starts, starts[edges[-1]] + _ENTRIES, "right")) - 1
        edges.append(max(reached, edges[-1] + 1))
    return edges


def _refuse(cloud: Cloud, x: Array, point: int, fault: int, number: int, left: float) -> NoReturn:
    checked_positions(cloud.positions, "node")  # of nodes that moved: nothing covers what is not finite
    place, m = f"point {point} at ({shown(x[point])})", basis_tables(cloud.dimension, cloud.order).size
    if fault == FEW:
        what = (
            "lies in a gap that no node's support covers"
            if number == 0
            else f"is covered by the supports of {number} {'nodes' if number > 1 else 'node'}"
        )
        raise TooFewNodes(f"{place} {what}; order {cloud.order} needs {m}: enlarge supports or add nodes there")
    where = _flatness(cloud, x[point])
    kept = f"pivot {number} keeps {left:.1e} of its diagonal entry"
    advice = "add nodes beside it, or enlarge supports" if where else "enlarge supports, move nodes or lower the order"
    raise SingularMomentMatrix(f"the moment matrix of {place} is singular: {where or kept}: {advice}")


def _flatness(cloud: Cloud, x: Array) -> str:
    """Words for the line or plane that the nodes covering a point lie in to rounding, empty where they fill the space."""
    apart = cloud.positions.real - x.real
    distance = abs(apart).max(axis=1) if cloud.window == "tensor" else np.linalg.norm(apart, axis=1)
    covering = apart[distance < cloud.supports]
    about = covering - covering.mean(axis=0)
    sizes = np.linalg.svd(about, compute_uv=False)
    # Coordinates carry the rounding of the largest of them, singular values that of all nodes.
    noise = len(covering) * np.finfo(float).eps * max(abs(covering).max(), abs(x).max())
    rank = int((sizes > noise).sum())
    if rank >= cloud.dimension:
        return ""
    return (
        f"the {len(covering)} nodes whose supports cover it lie {('at one place', 'on one line', 'in one plane')[rank]}"
    )
