"""Tables of numbers by row and node: theirs, and ours for comparison."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Entries:
    """Numbers (E, c) in the named columns, each for a row (a point or a cell) and a node, (E,), of `count` rows and `size` nodes.

    Sorted by row and node, each pair once. resolution (c,): half a unit of the last digit that the numbers carry.
    """

    rows: Array
    nodes: Array
    numbers: Array
    columns: tuple[str, ...]
    count: int
    size: int
    resolution: Array

    @property
    def keys(self) -> Array:
        """One integer for each pair, ascending."""
        return self.rows * self.size + self.nodes

    def matrix(self, column: int) -> csr_array:
        """One column as a matrix (count, size)."""
        return csr_array((self.numbers[:, column], (self.rows, self.nodes)), shape=(self.count, self.size))

    def only(self, rows: Array) -> "Entries":
        """The same with the chosen rows alone, numbered as they are."""
        kept = np.isin(self.rows, rows)
        return Entries(
            self.rows[kept], self.nodes[kept], self.numbers[kept], self.columns, self.count, self.size, self.resolution
        )

    def part(self, columns: Sequence[int]) -> "Entries":
        """The same with some of the columns."""
        chosen = list(columns)
        names = tuple(self.columns[c] for c in chosen)
        return Entries(
            self.rows, self.nodes, self.numbers[:, chosen], names, self.count, self.size, self.resolution[chosen]
        )

    def row_sums(self) -> Array:
        """Sums of the absolute values over the nodes, (count, c)."""
        total = np.zeros((self.count, len(self.columns)))
        np.add.at(total, self.rows, abs(self.numbers))
        return total


def entries(
    rows: Array, nodes: Array, numbers: Array, columns: Sequence[str], count: int, size: int, what: str = "point",
    resolution: Array | None = None,
) -> Entries:  # fmt: skip
    """Checked and sorted entries; `what` the rows are is for messages, without a resolution the numbers are doubles.

    Raises BadInput, naming the entry, for a row or node that does not exist, a pair that is there twice, or a number
    that is not finite.
    """
    I, J = np.asarray(rows, dtype=np.int64), np.asarray(nodes, dtype=np.int64)
    table = np.asarray(numbers, dtype=float).reshape(len(I), len(columns))
    for name, ids, most in ((what, I, count), ("node", J, size)):
        bad = np.flatnonzero((ids < 0) | (ids >= most))
        if len(bad):
            raise BadInput(f"entry {bad[0]} is of {name} {ids[bad[0]]}: there are {most}, counted from 0")
    bad = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(bad):
        raise BadInput(f"entry {bad[0]} of {what} {I[bad[0]]}, node {J[bad[0]]} is not finite: every number must be")
    order = np.lexsort((J, I))
    keys = (I * size + J)[order]
    twice = np.flatnonzero(np.diff(keys) == 0)
    if len(twice):
        place = order[twice[0]]
        raise BadInput(f"{what} {I[place]} has node {J[place]} twice: give each pair once")
    least = np.zeros(len(columns)) if resolution is None else np.asarray(resolution, dtype=float)
    return Entries(I[order], J[order], table[order], tuple(columns), count, size, least)


def apart(ours: Entries, theirs: Entries) -> Entries:
    """theirs - ours over all pairs of either, where a pair that is missing counts as zero."""
    keys = np.union1d(ours.keys, theirs.keys)
    numbers = np.zeros((len(keys), len(theirs.columns)))
    numbers[np.searchsorted(keys, theirs.keys)] += theirs.numbers
    numbers[np.searchsorted(keys, ours.keys)] -= ours.numbers
    return Entries(
        keys // theirs.size, keys % theirs.size, numbers, theirs.columns, theirs.count, theirs.size, theirs.resolution
    )
