"""rkverify cells"""

from argparse import Namespace
from typing import Any

from rkverify.cli.geometry import domain_of, doubles
from rkverify.cli.tables import AXES, read_points, write_table
from rkverify.errors import BadInput
from rkverify.solid.cell_rings import all_rings
from rkverify.solid.cells import Cells
from rkverify.solid.voronoi import voronoi


def cells(options: Namespace) -> int:
    """Print the vertices or the measures of the nodes' cells."""
    nodes = read_points(options.nodes)
    domain = domain_of(options, nodes.dimension)
    if nodes.dimension == 3 and not options.measures:
        raise BadInput("cells in three dimensions have faces and no rings: ask for --measures")
    found = voronoi(doubles(nodes.coordinates), domain)
    if options.measures:
        columns, rows = ["node", "measure"], [list(row) for row in enumerate(found.measures.tolist())]
    else:
        columns, rows = ["node", "ring", "vertex", *AXES[: nodes.dimension]], _vertices(found)
    write_table(columns, rows, options.json, options.out)
    return 0


def _vertices(found: Cells) -> list[list[Any]]:
    if found.dimension == 1:
        ends: list[list[float]] = [[] for _ in range(len(found))]
        for facet, sides in enumerate(found.sides.tolist()):
            place = found.vertices[found.corners[found.starts[facet]], 0].item()
            for cell in sides:
                if cell >= 0:
                    ends[cell].append(place)
        return [[cell, 0, vertex, x + 0.0] for cell, both in enumerate(ends) for vertex, x in enumerate(sorted(both))]
    return [
        [cell, number, vertex, *(c + 0.0 for c in place)]
        for cell, loops in enumerate(all_rings(found))
        for number, ring in enumerate(loops)
        for vertex, place in enumerate(ring.tolist())
    ]
