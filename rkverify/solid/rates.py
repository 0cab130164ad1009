"""What becomes of semi-Lagrangian shape functions as points and nodes move: Psi* of (40) and the true material rate."""

from typing import Any

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.blocks import blocks, numbers
from rkverify.solid.cloud import Cloud
from rkverify.solid.compiled_shape import rate_stage
from rkverify.solid.kernel_values import Array
from rkverify.solid.kinks import refuse_kinks
from rkverify.solid.neighbours import Neighbours, checked_points
from rkverify.solid.neighbours import neighbours as neighbours_of


def psi_star(
    cloud: Cloud, points: Array, velocities: Array, node_velocities: Array, neighbours: Neighbours | None = None
) -> Array:
    """Psi*_J(x) = C(x; x - x_J) times the material rate of phi_a(x - x_J), entry by entry (nnz,), 1/time   (40), (68).

    velocities of the material at the points (P, d) and of the nodes (N, d), length/time. Raises BadInput for velocities of another
    shape or not finite, and otherwise as `shape` does for first derivatives.

    >>> from rkverify.solid.cloud import cloud
    >>> nodes = cloud([[0], [1], [2]], 1.5)
    >>> psi_star(nodes, [[1.0]], [[0.0]], [[1.0], [0.0], [0.0]]).round(12).tolist()
    [0.387096774194, 0.0, 0.0]
    """
    return _rates(cloud, points, velocities, node_velocities, neighbours, true=False)


def true_rate(
    cloud: Cloud, points: Array, velocities: Array, node_velocities: Array, neighbours: Neighbours | None = None
) -> Array:
    """The material derivative of Psi_J(x), with the rate of C that (40) leaves out, entry by entry (nnz,), 1/time.

    Arguments and errors as for `psi_star`.
    """
    return _rates(cloud, points, velocities, node_velocities, neighbours, true=True)


def _rates(
    cloud: Cloud, points: Array, velocities: Array, node_velocities: Array, known: Neighbours | None, true: bool
) -> Array:
    x = checked_points(cloud, points)
    v = _checked(velocities, x, "point")
    v_nodes = _checked(node_velocities, cloud.positions, "node")
    kind = np.result_type(numbers(cloud, x), v, v_nodes)
    x, v, v_nodes = (np.ascontiguousarray(part, kind) for part in (x, v, v_nodes))
    known = neighbours_of(cloud, x) if known is None else known
    refuse_kinks(cloud, x, 1, (v, v_nodes))
    rates = np.empty(len(known.nodes), kind)
    run = rate_stage(cloud.dimension, cloud.order)
    for block in blocks(cloud, x, known, 1):
        run(block.nodes, *block.of_shape, v, v_nodes, true, rates)
    return rates


def _checked(velocities: Any, like: Array, what: str) -> Array:
    v = np.asarray(velocities, dtype=complex if np.iscomplexobj(velocities) else float)
    if v.shape != like.shape:
        raise BadInput(
            f"velocities of the {what}s have shape {v.shape}, the {what}s {like.shape}: give one for each {what}"
        )
    bad = np.flatnonzero(~np.isfinite(v).all(axis=1))
    if len(bad):
        raise BadInput(f"the velocity of {what} {bad[0]} is not finite: give numbers")
    return v
