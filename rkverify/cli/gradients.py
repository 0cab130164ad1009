"""rkverify gradients"""

import re
from argparse import Namespace

import numpy as np

from rkverify.cli.geometry import cloud_of, domain_of, doubles, read_cells
from rkverify.cli.tables import AXES, read_points, write_table
from rkverify.errors import BadInput, UnknownName
from rkverify.readings import DERIVATIVES, NODAL_INTEGRATIONS
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud
from rkverify.solid.given_cells import polygon_cells
from rkverify.solid.gradients import GradientOperator, dni, scni, snni
from rkverify.solid.voronoi import voronoi

RULES = {"scni": "trapezoid", "snni": "midpoint"}


def gradients(options: Namespace) -> int:
    """Print the gradient operator."""
    if options.integration not in NODAL_INTEGRATIONS:
        raise UnknownName("integration", options.integration, NODAL_INTEGRATIONS)
    if options.derivative not in DERIVATIVES:
        raise UnknownName("derivative", options.derivative, DERIVATIVES)
    nodes = cloud_of(read_points(options.nodes), options)
    operator, numbers = operator_of(nodes, options)
    columns = ["cell", "node", *(f"b{axis}" for axis in AXES[: nodes.dimension])]
    write_table(columns, _rows(operator, numbers), options.json, options.out)
    return 0


def operator_of(nodes: Cloud, options: Namespace) -> tuple[GradientOperator, list[int]]:
    """The operator that the options describe, and the node to which each of its cells belongs."""
    if options.integration == "dni":
        if options.edge_rule is not None:
            raise BadInput("--edge-rule is for scni and snni: DNI takes derivatives at the node; leave it out")
        cells, numbers = cells_of(nodes, options) if tells_cells(options) else (None, list(range(len(nodes))))
        measures = np.ones(len(nodes))
        if cells is not None:
            measures[numbers] = cells.measures
        return _only(dni(nodes, measures, options.derivative), numbers), numbers
    if options.derivative != "full":
        raise BadInput(
            f"--derivative {options.derivative} is for dni: {options.integration} takes no derivative; leave it out"
        )
    if not tells_cells(options):
        raise BadInput(f"--integration {options.integration} needs cells: give --domain FILE, --box or --cells FILE")
    cells, numbers = cells_of(nodes, options)
    rule = options.edge_rule or RULES[options.integration]
    if options.integration == "scni":
        return scni(nodes, cells, rule), numbers
    measures = np.ones(len(nodes))
    measures[numbers] = cells.measures
    return _only(snni(nodes, measures, rule), numbers), numbers


def cells_of(nodes: Cloud, options: Namespace) -> tuple[Cells, list[int]]:
    """The cells of --domain, --box or --cells, and the node to which each belongs."""
    if options.cells is None:
        return voronoi(nodes.positions, domain_of(options, nodes.dimension)), list(range(len(nodes)))
    if nodes.dimension != 2:
        raise BadInput(f"--cells {options.cells} is for nodes with x,y, and these have {nodes.dimension}: give --box")
    given = read_cells(options.cells, len(nodes))
    numbers = list(given)
    try:
        return polygon_cells([[doubles(ring) for ring in rings] for rings in given.values()]), numbers
    except BadInput as error:
        told = re.sub(r"\bcell (\d+)", lambda cell: f"the cell of node {numbers[int(cell[1])]}", str(error))
        raise BadInput(f"{options.cells}: {told}") from None


def tells_cells(options: Namespace) -> bool:
    """Whether the options say which cells there are."""
    return any(given is not None for given in (options.domain, options.box, options.cells))


def _only(operator: GradientOperator, numbers: list[int]) -> GradientOperator:
    parts = tuple(part[numbers] for part in operator.parts)
    return GradientOperator(parts, operator.measures[numbers], operator.boundary)


def _rows(operator: GradientOperator, numbers: list[int]) -> list[list[int | float]]:
    largest = sum(abs(part) for part in operator.parts).tocsr()
    largest.eliminate_zeros()
    largest.sort_indices()
    cells, nodes = largest.tocoo().coords
    values = np.stack([part[cells, nodes] for part in operator.parts], axis=1) + 0.0
    of_cells = np.array(numbers)[cells]
    return [[cell, node, *b] for cell, node, b in zip(of_cells.tolist(), nodes.tolist(), values.tolist(), strict=True)]
