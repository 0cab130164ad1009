"""Points in blocks whose entries fit into the processor's cache, taken through the compiled stages one after another."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NoReturn

import numpy as np

from rkverify.errors import BadInput, SingularMomentMatrix, TooFewNodes
from rkverify.solid.bases import basis_tables
from rkverify.solid.cloud import Cloud, shown
from rkverify.solid.compiled_shape import FEW, FINE, moment_stage
from rkverify.solid.compiled_weights import kernel_stage, offset_stage, weight_stage
from rkverify.solid.kernel_data import kernel_data
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import Neighbours

_ENTRIES = 1 << 14


@dataclass(frozen=True)
class Block:
    """Points rows (B,): scale (B,), scaled offsets (d, E), phi and its derivatives (1 + …, E), factors of M, b (B, m)."""

    nodes: Array
    starts: Array
    rows: Array
    scale: Array
    offsets: Array
    weights: Array
    factors: Array
    b: Array

    @property
    def of_shape(self) -> tuple[Any, ...]:
        """What the compiled stage of derivatives begins with."""
        return (
            self.starts, self.rows, self.scale, self.offsets, self.weights, self.factors, self.b,
        )  # fmt: skip


def numbers(cloud: Cloud, points: Array) -> Array:
    """The points in the number type of points and nodes together: complex where either is."""
    return np.ascontiguousarray(points, np.result_type(points, cloud.positions))


def blocks(cloud: Cloud, x: Array, known: Neighbours, derivatives: int, factorise: bool = True) -> Iterator[Block]:
    """The points in blocks, each with the kernels' derivatives up to the given order and the factors of M (or M itself).

    Points close by come together, so that they find their nodes in the cache. Arrays of a block are written over by the next.
    Raises TooFewNodes and SingularMomentMatrix for the first such point, BadInput for neighbours of other points.
    """
    order = np.arange(len(x)) if known.order is None else known.order
    starts, nodes, order = (np.ascontiguousarray(part, np.int64) for part in (known.starts, known.nodes, order))
    d, tensor = cloud.dimension, cloud.window == "tensor"
    if len(known) != len(x):
        raise BadInput(f"neighbours of {len(known)} points are given for {len(x)} points: give them of the same points")
    if (np.diff(starts) < 0).any() or (starts[0], starts[-1]) != (0, len(nodes)):
        raise BadInput(f"the starts of neighbours must ascend from 0 to their number {len(nodes)}")
    if len(order) != len(x) or (len(x) and not 0 <= order.min() <= order.max() < len(x)):
        raise BadInput("the order of the points does not hold each of them once: leave it out")
    if len(nodes) and not 0 <= nodes.min() <= nodes.max() < len(cloud):
        raise BadInput(
            f"neighbours from node {nodes.min()} to {nodes.max()} are given, the nodes run from 0 to {len(cloud) - 1}"
        )
    if not len(x):
        return
    m, counts, count = basis_tables(d, cloud.order).size, np.diff(starts), d if tensor else 1
    reached = np.concatenate([[0], np.cumsum(counts[order])])
    positions, supports = np.ascontiguousarray(cloud.positions, x.dtype), np.ascontiguousarray(cloud.supports)
    spans = list(pairwise(_edges(reached)))
    most = max(int(reached[last] - reached[first]) for first, last in spans)
    B = max(last - first for first, last in spans)
    heights = [d, *[count] * 6, 1 + d + d * (d + 1) // 2]
    room = [np.empty(height * most, x.dtype) for height in heights]
    scale, factors, b = np.empty(B), np.empty((B, m * (m + 1) // 2), x.dtype), np.empty((B, m), x.dtype)
    data = kernel_data(cloud.kernel).arrays
    offsets, weights_of, moments = offset_stage(d, tensor), weight_stage(d, tensor), moment_stage(d, cloud.order)
    for first, last in spans:
        rows, here = order[first:last], int(reached[last] - reached[first])
        y, z, f, g, s, left, power, weights = (
            memory[: height * here].reshape(height, here) for memory, height in zip(room, heights, strict=True)
        )
        offsets(starts, nodes, x, positions, supports, rows, scale, y, z)
        kernel_stage(z.ravel(), derivatives, *data, *(part.ravel() for part in (f, g, s, left, power)))
        weights_of(starts, nodes, supports, rows, derivatives, scale, y, f, g, s, weights)
        point, fault, number, rest = moments(starts, rows, y, weights, factorise, factors, b)
        if fault != FINE:
            if known.order is not None:  # name the first one, not the one met first
                yield from blocks(cloud, x, replace(known, order=None), 0, factorise)
            _refuse(cloud, x, point, fault, number, rest)
        yield Block(nodes, starts, rows, scale, y, weights, factors[: len(rows)], b)


def _edges(reached: Array) -> list[int]:
    edges = [0]
    while edges[-1] < len(reached) - 1:
        last = int(np.searchsorted(reached, reached[edges[-1]] + _ENTRIES, "right")) - 1
        edges.append(max(last, edges[-1] + 1))
    return edges


def _refuse(cloud: Cloud, x: Array, point: int, fault: int, number: int, left: float) -> NoReturn:
    place, m = f"point {point} at ({shown(x[point])})", basis_tables(cloud.dimension, cloud.order).size
    if fault == FEW:
        what = (
            "lies in a gap that no node's support covers"
            if number == 0
            else f"is covered by the supports of {number} node{'s' * (number > 1)}"
        )
        raise TooFewNodes(f"{place} {what}; order {cloud.order} needs {m}: enlarge supports or add nodes there")
    where = " (are the nodes under the support on one line or in one plane?)" if cloud.dimension > 1 else ""
    raise SingularMomentMatrix(
        f"the moment matrix of {place} is singular: pivot {number} keeps {left:.1e} of its diagonal entry{where}: "
        "enlarge supports, move nodes or lower the order"
    )
