"""Boxes about nodes, as cells that do not conform: they overlap and leave gaps, and no facet is shared."""

from itertools import product

import numpy as np

from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.kernel_values import Array

_AROUND: dict[int, tuple[tuple[float, ...], ...]] = {
    1: ((),),
    2: ((-1.0,), (1.0,)),
    3: ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)),
}
"""The corners of a face, in order around it, in the face's own coordinates."""


def boxes(positions: Array, measures: Array) -> Cells:
    """Intervals, squares or cubes along the axes, of the given measures (N,), about the positions (N, d).

    >>> import numpy as np
    >>> square = boxes(np.zeros((1, 2)), np.array([4.0]))
    >>> square.vertices.tolist(), square.areas.tolist()
    ([[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]], [[-2.0, 0.0], [2.0, 0.0], [0.0, -2.0], [0.0, 2.0]])
    """
    count, d = positions.shape
    signs = list(product((-1.0, 1.0), repeat=d))
    faces = [(axis, side) for axis in range(d) for side in (-1.0, 1.0)]
    corners = [signs.index((*p[:axis], side, *p[axis:])) for axis, side in faces for p in _AROUND[d]]
    normals = np.array([side * np.eye(d)[axis] for axis, side in faces]) + 0.0
    edge = (measures ** (1 / d))[:, None, None]
    return Cells(
        (positions[:, None] + edge / 2 * np.array(signs)).reshape(-1, d),
        np.arange(count * len(faces) + 1) * len(_AROUND[d]),
        (np.arange(count)[:, None] * len(signs) + np.array(corners)).ravel(),
        np.column_stack([np.repeat(np.arange(count), len(faces)), np.full(count * len(faces), OUTSIDE)]),
        (edge ** (d - 1) * normals).reshape(-1, d),
        measures,
    )
