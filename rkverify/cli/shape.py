"""rkverify shape"""

from argparse import Namespace
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.named import arithmetic
from rkverify.cli.tables import Points, read_points, write_table
from rkverify.errors import BadInput
from rkverify.paper.approximation import approximation
from rkverify.paper.shape import shape_functions, shape_gradient


def shape(options: Namespace) -> int:
    """Print the shape functions of the nodes at the points."""
    K = arithmetic(options.arithmetic)
    nodes, points = read_points(options.nodes), read_points(options.points)
    for name, table in ((options.nodes, nodes), (options.points, points)):
        if len(table.coordinates[0]) > 1:
            raise BadInput(
                f"{name} has {len(table.coordinates[0])} coordinates: this version works in one dimension, with x alone"
            )
    A = approximation(nodes.coordinates, _supports(nodes, options.support), K, options.kernel, options.order)
    rows = []
    for number, place in enumerate(points.coordinates):
        x = A.point(*place)
        slopes = shape_gradient(A, x, 0, options.derivative)
        for node, Psi in shape_functions(A, x).items():
            if not (K.is_zero(Psi) and K.is_zero(slopes[node])):
                rows.append([number, node, _printed(K, Psi), _printed(K, slopes[node])])
    write_table(["point", "node", "psi", "dpsi_dx"], rows, options.json, options.out)
    return 0


def _supports(nodes: Points, common: str | None) -> list[Scalar]:
    for node, own in enumerate(nodes.supports):
        if own is None and common is None:
            raise BadInput(f"node {node} has no support: give --support A, or a column a in the nodes' file")
    return [common if own is None else own for own in nodes.supports]


def _printed(K: Arithmetic, value: Scalar) -> Any:
    return value if isinstance(value, float) else K.text(value)
