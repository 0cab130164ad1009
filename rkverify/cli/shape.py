"""rkverify shape

In one dimension, and in every arithmetic but double precision, by the literal transcription; otherwise by the fast route.
"""

from argparse import Namespace
from typing import Any

import numpy as np

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.named import arithmetic
from rkverify.cli.tables import AXES, Points, read_points, write_table
from rkverify.errors import BadInput, NotRepresentable
from rkverify.paper.approximation import approximation
from rkverify.paper.shape import shape_functions, shape_gradient
from rkverify.readings import known_window


def shape(options: Namespace) -> int:
    """Print the shape functions of the nodes at the points."""
    K = arithmetic(options.arithmetic)
    nodes, points = read_points(options.nodes), read_points(options.points)
    if points.dimension != nodes.dimension:
        raise BadInput(f"{_has(options.nodes, nodes)} and {_has(options.points, points)}: give both the same")
    fast = K.name == "float" and nodes.dimension > 1
    try:
        rows = _fast(nodes, points, options) if fast else _literal(nodes, points, K, options)
    except NotRepresentable as error:
        hint = ", or --window tensor" if nodes.dimension > 1 and options.window == "radial" else ""
        raise NotRepresentable(f"{error}{hint}") from None
    slopes = [f"dpsi_d{axis}" for axis in AXES[: nodes.dimension]]
    write_table(["point", "node", "psi", *slopes], rows, options.json, options.out)
    return 0


def _has(file: str, points: Points) -> str:
    return f"{file} has {points.dimension} coordinates ({','.join(AXES[: points.dimension])})"


def _literal(nodes: Points, points: Points, K: Arithmetic, options: Namespace) -> list[list[Any]]:
    window = known_window(options.window)
    A = approximation(nodes.coordinates, nodes.radii(options.support), K, options.kernel, options.order, window)
    rows = []
    for number, place in enumerate(points.coordinates):
        x = A.point(*place)
        slopes = [shape_gradient(A, x, axis, options.derivative) for axis in range(nodes.dimension)]
        for node, Psi in shape_functions(A, x).items():
            values = [Psi, *(slope[node] for slope in slopes)]
            if not all(map(K.is_zero, values)):
                rows.append([number, node, *(_printed(K, value) for value in values)])
    return rows


def _fast(nodes: Points, points: Points, options: Namespace) -> list[list[Any]]:
    from rkverify.cli.geometry import cloud_of, doubles
    from rkverify.solid.shape import shape as shape_in_space

    there = shape_in_space(cloud_of(nodes, options), doubles(points.coordinates), 1, options.derivative)
    assert there.gradients is not None
    values = np.column_stack([there.values, there.gradients]) + 0.0
    starts = there.neighbours.starts
    numbers = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    kept = (values != 0).any(axis=1)
    columns = (numbers[kept].tolist(), there.neighbours.nodes[kept].tolist(), values[kept].tolist())
    return [[number, node, *value] for number, node, value in zip(*columns, strict=True)]


def _printed(K: Arithmetic, value: Scalar) -> Any:
    return value if isinstance(value, float) else K.text(value)
