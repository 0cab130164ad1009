"""Somebody's numbers held against ours: differences, and what rounding allows."""

from dataclasses import dataclass, replace

import numpy as np

from rkverify.check.claim import Claim, predicted
from rkverify.check.entries import Entries, apart
from rkverify.check.report import Place
from rkverify.check.rounding import lengths_at, relative_rounding
from rkverify.check.sums import column_axis
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours


@dataclass(frozen=True)
class Held:
    """Theirs against one prediction: differences, what is allowed (count, c), and the largest of a row over that, excess (count, c)."""

    ours: Entries
    gap: Entries
    allowed: Array
    excess: Array

    @property
    def fits(self) -> bool:
        """Whether every difference is within its bound."""
        return bool((self.excess <= 1).all())

    @property
    def worst(self) -> float:
        """The largest difference."""
        return float(abs(self.gap.numbers).max(initial=0.0))

    @property
    def wrong(self) -> Array:
        """Which numbers of the differences are out of their bounds, (E, c)."""
        out: Array = abs(self.gap.numbers) > self.allowed[self.gap.rows]
        return out


def held_against(ours: Entries, theirs: Entries, allowed: Array) -> Held:
    """The differences of theirs from ours over the bounds (count, c)."""
    gap = apart(ours, theirs)
    most = np.zeros_like(allowed)
    np.maximum.at(most, gap.rows, abs(gap.numbers))
    return Held(ours, gap, allowed, most / allowed)


def hold(claim: Claim, theirs: Entries, ours: Entries | None = None) -> Held:
    """Differences from the claim's numbers, or from those given, over what rounding and the digits of theirs allow."""
    if ours is None:
        ours = predicted(claim, theirs.columns)
    source = replace(claim, owner="source")
    known = neighbours(source.cloud, source.points)
    rounding, lengths = relative_rounding(source.cloud, source.points, known), lengths_at(source.cloud, known)
    slopes = np.array([column_axis(name) is not None for name in theirs.columns])
    least = np.where(slopes, 1 / lengths[:, None], 1.0)
    return held_against(ours, theirs, rounding[:, None] * np.maximum(ours.row_sums(), least) + theirs.resolution)


def unmatched(held: Held, theirs: Entries) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Pairs that ours have, and theirs have not, with a number that is more than rounding; and the other way round."""
    found = []
    for one, other in ((held.ours, theirs), (theirs, held.ours)):
        real = (abs(one.numbers) > held.allowed[one.rows]).any(axis=1)
        there = other.keys[(other.numbers != 0).any(axis=1)]
        alone = real & ~np.isin(one.keys, there)
        found.append(list(zip(one.rows[alone].tolist(), one.nodes[alone].tolist(), strict=True)))
    return found[0], found[1]


def largest(held: Held, theirs: Entries) -> Place | None:
    """The difference that is the most times its bound; None for tables without entries."""
    if not len(held.gap.rows):
        return None
    over = abs(held.gap.numbers) / held.allowed[held.gap.rows]
    e, c = np.unravel_index(int(over.argmax()), over.shape)
    row, node = int(held.gap.rows[e]), int(held.gap.nodes[e])
    found = np.flatnonzero(theirs.keys == held.gap.keys[e])
    value = float(theirs.numbers[found[0], c]) if len(found) else 0.0
    return Place(
        row, node, theirs.columns[c], value, value - float(held.gap.numbers[e, c]), float(held.allowed[row, c])
    )
