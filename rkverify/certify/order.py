"""Observed orders of convergence, pair by pair, and the rule by which one is accepted."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import log

SPREAD = 0.35
"""The last two pairwise orders may differ by this much: on uneven nodes each refinement is another draw."""


@dataclass(frozen=True)
class Observed:
    """Pairwise orders log(e_k / e_(k+1)) / log(h_k / h_(k+1)), coarse to fine.

    settled: the last two differ by SPREAD at most, so that the last one may be called the order; otherwise no order is observed.
    """

    pairwise: tuple[float, ...]

    @property
    def settled(self) -> bool:
        """Whether the sequence has an order by the rule."""
        return len(self.pairwise) > 1 and abs(self.pairwise[-1] - self.pairwise[-2]) <= SPREAD

    @property
    def last(self) -> float:
        """The order of the finest pair."""
        return self.pairwise[-1]

    def reaches(self, expected: float) -> bool:
        """Settled, and not below the expected order by more than SPREAD."""
        return self.settled and self.last >= expected - SPREAD


def observed(sizes: Sequence[float], errors: Sequence[float]) -> Observed:
    """The observed orders of errors over sizes h, coarse to fine.

    >>> observed([1.0, 0.5, 0.25], [3.0, 0.75, 0.1875]).pairwise
    (2.0, 2.0)
    """
    pairs = pairwise(zip(sizes, errors, strict=True))
    return Observed(tuple(log(e / f) / log(h / g) for (h, e), (g, f) in pairs))
