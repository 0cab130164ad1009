"""Nodes, domains and cells of the command line's files as the arrays of `solid/`."""

import sys
from argparse import Namespace
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np

from rkverify.arithmetic.native import finite
from rkverify.cli.tables import AXES, Points, Rows, read_rows
from rkverify.errors import BadInput
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import Box, Domain, box, polygon_domain
from rkverify.solid.kernel_values import Array

Ring = list[tuple[Fraction, ...]]


def cloud_of(nodes: Points, options: Namespace) -> Cloud:
    """The nodes with their supports, kernel, order and window, in double precision."""
    supports = [finite(radius) for radius in nodes.radii(options.support)]
    return cloud(doubles(nodes.coordinates), supports, options.kernel, options.order, options.window)


def doubles(places: Sequence[Sequence[Fraction]]) -> Array:
    """Exact coordinates rounded to doubles, (N, d); raises BadInput, naming the row, where one is too large."""
    for row, place in enumerate(places):
        for axis, c in zip(AXES, place, strict=False):
            if abs(c) > sys.float_info.max:
                raise BadInput(f"row {row}, {axis}: a number of more than 308 digits is too large for double precision")
    return np.array([[float(c) for c in place] for place in places])


def domain_of(options: Namespace, dimension: int) -> Domain | Box:
    """The domain that --domain or --box describes, for nodes of this dimension; raises BadInput."""
    if options.box is None and options.domain is None:
        raise BadInput("there is no domain: give --domain FILE or --box x0,y0,x1,y1")
    if options.box is not None:
        return _box(options.box, dimension)
    if dimension != 2:
        raise BadInput(f"--domain {options.domain} is for nodes with x,y, and these have {dimension}: give --box")
    return polygon_domain([doubles(ring) for ring in read_domain(options.domain)])


def _box(text: str, dimension: int) -> Box:
    try:
        numbers = [finite(part.strip()) for part in text.split(",")]
    except BadInput as error:
        raise BadInput(f"--box {text}: {error}") from None
    if len(numbers) != 2 * dimension:
        wanted = ",".join(f"{axis}{end}" for end in (0, 1) for axis in AXES[:dimension])
        raise BadInput(f"--box {text}: {len(numbers)} numbers for nodes in {dimension} dimensions: write {wanted}")
    return box(numbers[:dimension], numbers[dimension:])


def read_domain(file: str) -> list[Ring]:
    """The rings of a CSV file with header ring,x,y: ring 0 is the outline, the others are holes, vertices in order.

    A last vertex that repeats the first is left out. Raises BadInput for another header, or a ring that is missing,
    interrupted or has fewer than three vertices.
    """
    rows = read_rows(file)
    _check_header(rows, ("ring", "x", "y"))
    numbers = [rows.count(row, "ring") for row in range(len(rows.cells))]
    rings: dict[int, Ring] = {}
    for row, ring in enumerate(numbers):
        if row and ring != numbers[row - 1] and ring in rings:
            raise BadInput(
                f"{file}, row {row}: ring {ring} goes on after ring {numbers[row - 1]}: keep its rows together"
            )
        rings.setdefault(ring, []).append((rows.number(row, "x"), rows.number(row, "y")))
    _check_counted(list(rings), f"{file}: ring")
    return [_ring(rings[ring], f"{file}, ring {ring}") for ring in sorted(rings)]


def read_cells(file: str, nodes: int) -> dict[int, list[Ring]]:
    """node -> rings of its cell, of a CSV file with header node,ring,vertex,x,y, or without ring where there is one each.

    Raises BadInput for another header, a node that does not exist, rings or vertices that are not numbered 0, 1, 2, …,
    a ring of fewer than three vertices, and a cell without area.
    """
    rows = read_rows(file)
    several = "ring" in rows.header
    _check_header(rows, ("node", "ring", "vertex", "x", "y") if several else ("node", "vertex", "x", "y"))
    found: dict[int, dict[int, dict[int, tuple[Fraction, ...]]]] = {}
    for row in range(len(rows.cells)):
        node, vertex = rows.count(row, "node"), rows.count(row, "vertex")
        ring = rows.count(row, "ring") if several else 0
        if node >= nodes:
            raise BadInput(f"{file}, row {row}: there is no node {node}, only 0 to {nodes - 1}")
        vertices = found.setdefault(node, {}).setdefault(ring, {})
        if vertex in vertices:
            raise BadInput(
                f"{file}, row {row}: node {node} has vertex {vertex} of ring {ring} twice: number its vertices"
            )
        vertices[vertex] = rows.number(row, "x"), rows.number(row, "y")
    cells: dict[int, list[Ring]] = {}
    for node in sorted(found):
        _check_counted(list(found[node]), f"{file}: node {node}, ring")
        cells[node] = []
        for ring, vertices in sorted(found[node].items()):
            _check_counted(list(vertices), f"{file}: node {node}, ring {ring}, vertex")
            cells[node].append(_ring([vertices[v] for v in sorted(vertices)], f"{file}: node {node}, ring {ring}"))
        if not any(_area(ring) for ring in cells[node]):
            raise BadInput(f"{file}: the cell of node {node} has area 0: give vertices that enclose an area")
    return cells


def _check_header(rows: Rows, wanted: Sequence[str]) -> None:
    if sorted(rows.header) != sorted(wanted):
        raise BadInput(f"{rows.file}: the header is {','.join(rows.header)!r}; write {','.join(wanted)}")
    if not rows.cells:
        raise BadInput(f"{rows.file}: there are no rows below the header; give at least one")


def _check_counted(numbers: list[int], what: str) -> None:
    missing = set(range(len(numbers))) - set(numbers)
    if missing:
        raise BadInput(
            f"{what} {min(missing)} is missing where there is {what.rpartition(' ')[2]} {max(numbers)}: count from 0"
        )


def _ring(vertices: Ring, where: str) -> Ring:
    ring = vertices[:-1] if vertices[0] == vertices[-1] else vertices
    if len(ring) < 3:
        raise BadInput(f"{where} has {len(ring)} different vertices: give at least three")
    return ring


def _area(ring: Ring) -> Fraction:
    closed = [*ring, ring[0]]
    return sum((a[0] * b[1] - b[0] * a[1] for a, b in pairwise(closed)), Fraction(0)) / 2
