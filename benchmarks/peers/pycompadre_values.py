"""pycompadre's generalised moving least squares: weights of the nodes in the value and in the gradient at points.

Run as `python pycompadre_values.py FOLDER` in the peers' environment.
"""

import sys
from pathlib import Path

import numpy as np
import pycompadre
from tables import Provenance, columns, read, within, write_values

RADII = {1: 2.2, 2: 3.1}
"""Support radius, in spacings, for each order."""


def stencils(
    nodes: np.ndarray,
    points: np.ndarray,
    radii: np.ndarray,
    order: int,
    weighting: str = "CardinalCubicBSpline",
    power: tuple[int, int] = (2, 1),
) -> list[list[float]]:
    """Rows point, node, value, gradient. The window belongs to the target point: pycompadre knows no other."""
    d = nodes.shape[1]
    gmls = pycompadre.GMLS(order, d, "QR", "STANDARD")
    helper = pycompadre.ParticleHelper(gmls)
    helper.generateKDTree(nodes)
    lists = [within(nodes, place, radius) for place, radius in zip(points, radii)]
    table = np.zeros((len(points), 1 + max(map(len, lists))), dtype=np.int32)
    for row, found in zip(table, lists):
        row[0], row[1 : 1 + len(found)] = len(found), found
    helper.setTargetSites(points)
    helper.setNeighbors(table)
    helper.setWindowSizes(radii)
    value = pycompadre.TargetOperation.ScalarPointEvaluation
    gradient = pycompadre.TargetOperation.GradientOfScalarPointEvaluation
    gmls.addTargets([value, gradient])
    gmls.setWeightingType(weighting)
    for index, parameter in enumerate(power):
        gmls.setWeightingParameter(parameter, index)
    gmls.generateAlphas(1, False)
    solution = gmls.getSolutionSet()
    return [
        [
            point,
            node,
            solution.getAlpha(value, point, 0, 0, k, 0, 0),
            *(solution.getAlpha(gradient, point, axis, 0, k, 0, 0) for axis in range(d)),
        ]
        for point, found in enumerate(lists)
        for k, node in enumerate(found)
    ]


def main(into: Path) -> None:
    """All tables."""
    told = Provenance(into, "pycompadre", pycompadre.__version__)
    for name in ("line", "plane", "box"):
        nodes, points = read(f"nodes_{name}")[0], read(f"points_{name}")[0]
        for order, radius in RADII.items():
            rows = stencils(nodes, points, np.full(len(points), radius), order)
            table = f"pycompadre_{name}_order{order}"
            write_values(into, table, columns(nodes.shape[1]), rows)
            told.add(table, "GMLS, CardinalCubicBSpline", f"nodes_{name}", f"points_{name}", radius, order)
    nodes, points = read("nodes_plane")[0], read("points_plane")[0]
    rows = stencils(nodes, points, np.full(len(points), RADII[1]), 1, "Power", (2, 1))
    write_values(into, "pycompadre_plane_power", columns(2), rows)
    told.add("pycompadre_plane_power", "GMLS, Power (1 - z)^2", "nodes_plane", "points_plane", RADII[1], 1)
    (nodes, _), (points, radii) = read("nodes_own"), read("points_at_nodes")
    write_values(into, "pycompadre_own", columns(2), stencils(nodes, points, radii, 1))
    told.add("pycompadre_own", "GMLS, CardinalCubicBSpline, own supports", "nodes_own", "points_at_nodes", "own", 1)
    told.write()


if __name__ == "__main__":
    kokkos = pycompadre.KokkosParser(False)  # its life is Kokkos' life
    main(Path(sys.argv[1]))
    del kokkos
