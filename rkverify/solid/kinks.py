"""Where a kernel is not smooth enough for a derivative: exactly at its node or at one of its joints."""

import numpy as np

from rkverify.errors import NotDifferentiable
from rkverify.solid.cloud import Cloud, shown
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours

Velocities = tuple[Array, Array]
"""Of the material at the points (P, d) and of the nodes (N, d)."""


def refuse_kinks(cloud: Cloud, x: Array, derivatives: int, velocities: Velocities | None = None) -> None:
    """Raise NotDifferentiable, naming point and node, where a derivative of phi_a(x - x_J) of that order does not exist.

    A complex step differentiates once more. With velocities only pairs that move relative to each other count.
    """
    kernel, steps = cloud.kernel, bool(np.iscomplexobj(x) and (x.imag.any() or cloud.positions.imag.any()))
    if derivatives + steps <= kernel.continuity or not len(x):
        return
    kernel.phi.derivative(derivatives)  # refused where it would be no function at all
    # the edge of a support belongs to no neighbour, but is a joint
    pairs = neighbours(cloud.at(cloud.positions, cloud.supports * (1 + 1e-12)), x)
    point, node = pairs.points, pairs.nodes
    y, a = x[point] - cloud.positions[node], cloud.supports[node]
    motion = np.ones_like(y.real) if velocities is None else velocities[0][point] - velocities[1][node]
    if cloud.window == "radial":
        z = np.sqrt((y.real**2).sum(axis=1, keepdims=True)) / a[:, None]
        stepped, moved = (abs(y.imag).max(axis=1, keepdims=True) > 0), (abs(motion).max(axis=1, keepdims=True) > 0)
    else:
        z, stepped, moved = abs(y.real) / a[:, None], y.imag != 0, motion != 0
    needed = derivatives * moved + stepped
    bad = (z == 0) & (needed > kernel.smoothness_at_node)
    for joint in kernel.joints:
        bad |= (z == float(joint)) & (needed > kernel.smoothness_at(joint))
    found = np.flatnonzero(bad.any(axis=1))
    if len(found):
        p, J = point[found[0]], node[found[0]]
        raise NotDifferentiable(
            f"kernel {kernel.name!r} of node {J} has a joint or peak exactly at point {p} at ({shown(x[p])}), where this "
            "derivative jumps: move the point or take a smoother kernel"
        )
