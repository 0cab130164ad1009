"""A claim about shape functions, and the numbers that follow from it."""

from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from rkverify.check.entries import Entries
from rkverify.check.weighted import weighted
from rkverify.errors import BadInput
from rkverify.readings import Derivative
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array, kernel_values
from rkverify.solid.neighbours import Neighbours, neighbours
from rkverify.solid.shape import shape

Owner = Literal["source", "target", "mean"]
OWNERS: tuple[Owner, ...] = get_args(Owner)
"""Whose support decides about a pair: the node's (source), as in (4); the point's (target); or the mean of both."""


@dataclass(frozen=True)
class Claim:
    """Shape functions of a cloud at points (P, d): the reading of their derivative, and who owns the supports.

    point_supports (P,): of the points themselves, None where they have none. normalised: kernels divided by a^d, as in
    smoothed particle hydrodynamics, which matters where supports differ.
    """

    cloud: Cloud
    points: Array
    derivative: Derivative = "full"
    owner: Owner = "source"
    point_supports: Array | None = None
    normalised: bool = False

    def at(self, rows: Array) -> "Claim":
        """The same claim about some of the points."""
        own = None if self.point_supports is None else self.point_supports[rows]
        return replace(self, points=self.points[rows], point_supports=own)


def predicted(claim: Claim, columns: tuple[str, ...], known: Neighbours | None = None) -> Entries:
    """The numbers that the claim leads to, psi and derivatives as the columns name them.

    known: neighbours of the points, where others than those under the supports are to be used; for the owner `source`.
    Raises what `shape` raises, BadInput for supports of points that have none, LinAlgError for a singular moment matrix.
    """
    if claim.owner == "source" and not claim.normalised:
        there = shape(claim.cloud, claim.points, int(columns != ("psi",)), claim.derivative, known)
        pattern = there.neighbours
        return _entries(claim, columns, pattern.points, pattern.nodes, there.values, there.gradients)
    rows = [_of_point(claim, point) for point in range(len(claim.points))]
    points = np.repeat(np.arange(len(rows)), [len(nodes) for nodes, _, _ in rows])
    nodes, values, slopes = (np.concatenate(parts) for parts in zip(*rows, strict=True))
    return _entries(claim, columns, points, nodes, values, slopes)


def _of_point(claim: Claim, point: int) -> tuple[Array, Array, Array]:
    """Nodes, values and gradients at one point with supports that are not the nodes' alone, or normalised kernels."""
    cloud, x = claim.cloud, claim.points[point]
    a = cloud.supports
    if claim.owner != "source":
        if claim.point_supports is None:
            raise BadInput("the points have no supports of their own: give their file a column a")
        own = np.full(len(cloud), claim.point_supports[point])
        a = own if claim.owner == "target" else (own + a) / 2
    y = x - cloud.positions
    nodes = np.flatnonzero((abs(y).max(axis=1) if cloud.window == "tensor" else np.sqrt((y**2).sum(axis=1))) < a)
    y, a = y[nodes], a[nodes]
    w, dw = _windows(cloud, y, a)
    scale = (a.max() / a) ** cloud.dimension if claim.normalised else np.ones(len(a))
    unit = a.max()
    values, slopes = weighted(y / unit, scale * w, unit * scale[:, None] * dw, cloud.order, claim.derivative)
    return nodes, values, slopes / unit


def _windows(cloud: Cloud, y: Array, a: Array) -> tuple[Array, Array]:
    """phi_a (n,) and its gradient (n, d) at offsets y."""
    if cloud.window == "radial":
        r = np.sqrt((y**2).sum(axis=1))
        phi, slope = kernel_values(cloud.kernel, r, a, 1)
        return phi, (slope / np.where(r > 0, r, 1.0))[:, None] * y
    phi, slope = kernel_values(cloud.kernel, y, a[:, None], 1)
    others = [np.prod(np.delete(phi, k, axis=1), axis=1) for k in range(y.shape[1])]
    return np.prod(phi, axis=1), slope * np.column_stack(others)


def _entries(
    claim: Claim, columns: tuple[str, ...], points: Array, nodes: Array, values: Array, slopes: Array | None
) -> Entries:
    parts = [values[:, None]] if "psi" in columns else []
    if slopes is not None and columns != ("psi",):
        parts.append(slopes)
    numbers = np.concatenate(parts, axis=1)
    return Entries(points, nodes, numbers, columns, len(claim.points), len(claim.cloud), np.zeros(len(columns)))


def without(cloud: Cloud, points: Array, left_out: dict[int, list[int]]) -> Neighbours:
    """The neighbours of the points, without some nodes at some points."""
    found = neighbours(cloud, points)
    gone = np.zeros(len(found.nodes), dtype=bool)
    for point, nodes in left_out.items():
        row = slice(found.starts[point], found.starts[point + 1])
        gone[row] = np.isin(found.nodes[row], nodes)
    starts = np.concatenate([[0], np.cumsum(~gone)])[found.starts]
    return Neighbours(starts, found.nodes[~gone])
