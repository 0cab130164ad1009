"""Which nodes' supports cover which points: |x - x_J| < a_J, the support owned by the node J, (26)."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.spatial import cKDTree

from rkverify.errors import BadInput
from rkverify.solid.cloud import Cloud, checked_positions
from rkverify.solid.kernel_values import Array

_BLOCK = 1 << 16  # points searched at once, which bounds the memory of the search
_CLASS = 2**0.25  # supports that differ by less are searched for with one radius


@dataclass(frozen=True)
class Neighbours:
    """For point p the nodes nodes[starts[p]:starts[p + 1]], ascending; starts (P + 1,), nodes (nnz,)."""

    starts: Array
    nodes: Array

    def __len__(self) -> int:
        """The number P of points."""
        return len(self.starts) - 1

    @property
    def points(self) -> Array:
        """The point of every entry (nnz,)."""
        return np.repeat(np.arange(len(self)), np.diff(self.starts))

    def of(self, point: int) -> Array:
        """The nodes of one point."""
        row: Array = self.nodes[self.starts[point] : self.starts[point + 1]]
        return row


def checked_points(cloud: Cloud, points: Array) -> Array:
    """The points as a checked array (P, d); raises BadInput for another dimension than the nodes' or a value not finite."""
    x = np.asarray(points)
    if x.ndim == 2 and len(x) == 0 and x.shape[1] == cloud.dimension:
        return x.astype(complex if np.iscomplexobj(x) else float)
    x = checked_positions(points, "point")
    if x.shape[1] != cloud.dimension:
        raise BadInput(
            f"the points have {x.shape[1]} coordinates and the nodes have {cloud.dimension}: give them as many"
        )
    return x


def neighbours(cloud: Cloud, points: Array) -> Neighbours:
    """The nodes J with |x - x_J| < a_J (radial) or max_j |x_j - x_jJ| < a_J (tensor) at every point (P, d), (26).

    Decided on the real parts in double precision. Raises BadInput as `checked_points`.

    >>> from rkverify.solid.cloud import cloud
    >>> neighbours(cloud([[0], [1], [3]], [2.5, 1, 1]), np.array([[2.0], [3.0]])).nodes.tolist()
    [0, 2]
    """
    x, X, a = checked_points(cloud, points).real, cloud.positions.real, cloud.supports
    norm = 2.0 if cloud.window == "radial" else np.inf
    classes = [(nodes, cKDTree(X[nodes]), float(a[nodes].max())) for nodes in _classes(a)]
    order = cKDTree(x).indices if len(x) else np.zeros(0, np.int64)  # in leaves: points close by are searched together
    found, counts = [], np.zeros(len(x), np.int64)
    for first in range(0, len(x), _BLOCK):
        block = np.sort(order[first : first + _BLOCK])
        here = cKDTree(x[block])
        rows, columns = [], []
        for nodes, tree, radius in classes:
            # a little wider than the largest support: who is inside is decided below, not by the tree's rounding
            pairs = here.sparse_distance_matrix(tree, radius * (1 + 1e-12), p=norm, output_type="ndarray")
            point, node = block[pairs["i"]], nodes[pairs["j"]]
            inside = _distances(x[point] - X[node], norm) < a[node]
            rows.append(pairs["i"][inside])
            columns.append(node[inside])
        row, column = np.concatenate(rows), np.concatenate(columns)
        table = csr_array((np.ones(len(row), np.bool_), (row, column)), shape=(len(block), len(X)))
        table.sort_indices()
        counts[block] = np.diff(table.indptr)
        found.append((block, table.indices))
    starts = np.concatenate([[0], np.cumsum(counts)])
    everyone = np.empty(starts[-1], np.int64)
    for block, columns_of_block in found:
        own = np.repeat(starts[block] - np.concatenate([[0], np.cumsum(counts[block])[:-1]]), counts[block])
        everyone[own + np.arange(len(own))] = columns_of_block
    return Neighbours(starts, everyone)


def _classes(supports: Array) -> list[Array]:
    """The nodes in groups of nearly equal supports, so that a search by the largest of a group finds few in vain."""
    level = np.floor(np.log(supports / supports.min()) / np.log(_CLASS)).astype(int)
    return [np.flatnonzero(level == value) for value in np.unique(level)]


def _distances(offsets: Array, norm: float) -> Array:
    lengths: Array = np.sqrt((offsets**2).sum(axis=1)) if norm == 2 else abs(offsets).max(axis=1)
    return lengths
