"""A claim about shape functions, and the numbers that follow from it."""

from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from rkverify.check.entries import Entries
from rkverify.errors import BadInput
from rkverify.readings import Derivative
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import Neighbours, neighbours
from rkverify.solid.shape import Shape, shape

Owner = Literal["source", "target", "mean"]
OWNERS: tuple[Owner, ...] = get_args(Owner)
"""Whose support decides about a pair: the node's (source), as in (4); the point's (target); or the mean of both."""


@dataclass(frozen=True)
class Claim:
    """Shape functions of a cloud at points (P, d): the reading of their derivative, and who owns the supports.

    point_supports (P,): of the points themselves, None where they have none.
    """

    cloud: Cloud
    points: Array
    derivative: Derivative = "full"
    owner: Owner = "source"
    point_supports: Array | None = None

    def at(self, rows: Array) -> "Claim":
        """The same claim about some of the points."""
        own = None if self.point_supports is None else self.point_supports[rows]
        return replace(self, points=self.points[rows], point_supports=own)


def predicted(claim: Claim, columns: tuple[str, ...], known: Neighbours | None = None) -> Entries:
    """The numbers that the claim leads to, psi and derivatives as the columns name them.

    known: neighbours of the points, where others than those under the supports are to be used; for the owner `source`.
    Raises what `shape` raises, and BadInput for supports of points that have none.
    """
    derivatives = int(len(columns) > 1 or columns != ("psi",))
    if claim.owner == "source":
        there = shape(claim.cloud, claim.points, derivatives, claim.derivative, known)
        return _entries(there, claim, columns)
    if claim.point_supports is None:
        raise BadInput("the points have no supports of their own: give their file a column a")
    everyone = []
    for point, own in zip(claim.points, claim.point_supports, strict=True):
        shared = np.full(len(claim.cloud), own) if claim.owner == "target" else (own + claim.cloud.supports) / 2
        there = shape(claim.cloud.at(claim.cloud.positions, shared), point[None], derivatives, claim.derivative)
        everyone.append(_entries(there, claim, columns))
    rows = [np.full(len(one.nodes), p) for p, one in enumerate(everyone)]
    return replace(
        everyone[0],
        rows=np.concatenate(rows),
        nodes=np.concatenate([one.nodes for one in everyone]),
        numbers=np.concatenate([one.numbers for one in everyone]),
        count=len(claim.points),
    )


def _entries(there: Shape, claim: Claim, columns: tuple[str, ...]) -> Entries:
    parts = [there.values[:, None]] if "psi" in columns else []
    if there.gradients is not None:
        parts.append(there.gradients)
    numbers = np.concatenate(parts, axis=1)
    pattern = there.neighbours
    return Entries(
        pattern.points, pattern.nodes, numbers, columns, len(pattern), len(claim.cloud), np.zeros(len(columns))
    )


def without(cloud: Cloud, points: Array, left_out: dict[int, list[int]]) -> Neighbours:
    """The neighbours of the points, without some nodes at some points."""
    found = neighbours(cloud, points)
    gone = np.zeros(len(found.nodes), dtype=bool)
    for point, nodes in left_out.items():
        row = slice(found.starts[point], found.starts[point + 1])
        gone[row] = np.isin(found.nodes[row], nodes)
    starts = np.concatenate([[0], np.cumsum(~gone)])[found.starts]
    return Neighbours(starts, found.nodes[~gone])
