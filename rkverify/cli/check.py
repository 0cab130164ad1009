"""rkverify check"""

import json
import re
import shlex
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from rkverify.check.claim import Claim
from rkverify.check.entries import Entries, entries
from rkverify.check.gradients import check_gradients
from rkverify.check.report import Report
from rkverify.check.schemes import GradientClaim, Scheme
from rkverify.check.shape import check_shape
from rkverify.cli.geometry import cloud_of, doubles
from rkverify.cli.gradients import RULES, cells_of, tells_cells
from rkverify.cli.tables import AXES, Points, Rows, read_points, read_rows, write_text
from rkverify.errors import BadInput, UnknownName
from rkverify.readings import DERIVATIVES, NODAL_INTEGRATIONS
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array

_DECIMAL = re.compile(r"[-+]?(\d*)\.?(\d*)(?:[eE]([-+]?\d+))?")
_DOUBLE = 16
"""Numbers with as many significant digits are doubles."""
_FOR = {"shape": ("points",), "gradients": ("integration", "edge_rule", "domain", "box", "cells")}


def check(options: Namespace) -> int:
    """Print what somebody's numbers are; 1 where they are not what is claimed."""
    _refuse_foreign(options)
    if options.derivative not in DERIVATIVES:
        raise UnknownName("derivative", options.derivative, DERIVATIVES)
    tolerance = _tolerance(options.tolerance)
    nodes = cloud_of(read_points(options.nodes), options)
    report = _shape(nodes, options, tolerance) if options.subject == "shape" else _gradients(nodes, options, tolerance)
    if options.json:
        text = json.dumps(report.data(), indent=1, ensure_ascii=False)
    else:
        text = report.text() if report.passed else f"{report.text()}\n-> {_ours(options)} prints ours"
    write_text(text + "\n", options.out)
    return 0 if report.passed else 1


def _shape(nodes: Cloud, options: Namespace, tolerance: float) -> Report:
    if options.points is None:
        raise BadInput("check shape needs the points: give --points CSV")
    points = read_points(options.points)
    if points.dimension != nodes.dimension:
        raise BadInput(
            f"{options.points} has {points.dimension} coordinates and {options.nodes} has {nodes.dimension}: give both the same"
        )
    x = doubles(points.coordinates)
    slopes = [f"dpsi_d{axis}" for axis in AXES[: nodes.dimension]]
    theirs = _read(options.values, "point", (["psi", *slopes], ["psi"], slopes), len(x), len(nodes))
    claim = Claim(nodes, x, options.derivative, "source", _point_supports(nodes, points, x))
    return check_shape(claim, theirs, tolerance)


def _point_supports(nodes: Cloud, points: Points, x: Array) -> Array | None:
    """Supports of the points themselves: their column a, or those of the nodes that they are at, or the one of all nodes."""
    if all(own is not None for own in points.supports):
        return np.array([float(own) for own in points.supports if own is not None])
    places = {tuple(place): node for node, place in enumerate(nodes.positions.tolist())}
    at = [places.get(tuple(place)) for place in x.tolist()]
    if all(node is not None for node in at):
        return nodes.supports[np.array(at, dtype=np.int64)]
    return np.full(len(x), nodes.supports[0]) if np.ptp(nodes.supports) == 0 else None


def _gradients(nodes: Cloud, options: Namespace, tolerance: float) -> Report:
    if options.integration is None:
        raise BadInput("check gradients needs the integration that is claimed: give --integration scni, dni or snni")
    if options.integration not in NODAL_INTEGRATIONS:
        raise UnknownName("integration", options.integration, NODAL_INTEGRATIONS)
    cells, numbers = cells_of(nodes, options) if tells_cells(options) else (None, [])
    rule = options.edge_rule or RULES.get(options.integration, "trapezoid")
    columns = [f"b{axis}" for axis in AXES[: nodes.dimension]]
    theirs = _read(options.values, "cell", (columns,), len(nodes), len(nodes))
    scheme = Scheme(options.integration, rule, options.derivative)
    return check_gradients(GradientClaim(nodes, scheme, cells, np.array(numbers, dtype=np.int64)), theirs, tolerance)


def _read(file: str, row: str, offered: Sequence[list[str]], count: int, size: int) -> Entries:
    """The entries of a CSV file with the columns row, node and one of the offered lists, in any order."""
    rows = read_rows(file)
    wanted = next((names for names in offered if sorted(rows.header) == sorted([row, "node", *names])), None)
    if wanted is None:
        forms = " or ".join(",".join([row, "node", *names]) for names in offered)
        raise BadInput(f"{file}: the header is {','.join(rows.header)!r}; write {forms}")
    if not rows.cells:
        raise BadInput(f"{file}: there are no rows below the header; give at least one")
    ids = np.array([[rows.count(number, row), rows.count(number, "node")] for number in range(len(rows.cells))])
    for column, (name, most) in enumerate(((row, count), ("node", size))):
        bad = np.flatnonzero(ids[:, column] >= most)
        if len(bad):
            raise BadInput(
                f"{file}, row {bad[0]}: there is no {name} {ids[bad[0], column]}, only 0 to {most - 1}: count from 0"
            )
    _, first, counts = np.unique(ids, axis=0, return_index=True, return_counts=True)
    if (counts > 1).any():
        point, node = ids[first[counts > 1][0]]
        raise BadInput(f"{file}: {row} {point} has node {node} twice: give each pair one row")
    numbers = np.array([[_number(rows, number, name) for name in wanted] for number in range(len(rows.cells))])
    resolution = [_resolution([cells[name] for cells in rows.cells]) for name in wanted]
    return entries(ids[:, 0], ids[:, 1], numbers, wanted, count, size, row, np.array(resolution))


def _number(rows: Rows, row: int, column: str) -> float:
    try:
        value = float(rows.cells[row][column])
    except ValueError:
        return float(rows.number(row, column))
    if not np.isfinite(value):
        raise BadInput(
            f"{rows.file}, row {row}, column {column}: {rows.cells[row][column]!r} is not a finite number: write a decimal or p/q"
        )
    return value


def _resolution(cells: list[str]) -> float:
    """Half a unit in the last place of the numbers with the most significant digits; 0 where these are doubles or p/q.

    >>> _resolution(["0.123457", "0.500000", "12.000001"]), _resolution(["0.1", "0.30000000000000004"])
    (5e-07, 0.0)
    """
    most, last = 0, -400
    for cell in cells:
        found = _DECIMAL.fullmatch(cell.strip())
        if found is None:
            return 0.0
        whole, decimals, exponent = found.groups()
        digits, place = len((whole + decimals).lstrip("0")), int(exponent or 0) - len(decimals)
        most, last = max((most, last), (digits, place))
    return 0.0 if most >= _DOUBLE else 0.5 * 10.0**last


def _tolerance(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value < 1:
        raise BadInput(f"--tolerance {text}: give a number of at least 0 and less than 1, such as 1e-8")
    return value


def _refuse_foreign(options: Namespace) -> None:
    other = "gradients" if options.subject == "shape" else "shape"
    for name in _FOR[other]:
        if getattr(options, name) is not None:
            raise BadInput(f"--{name.replace('_', '-')} is for check {other}: leave it out of check {options.subject}")


def _ours(options: Namespace) -> str:
    """The command that prints our numbers for the same claim."""
    names = ["nodes", *_FOR[options.subject], "support", "order", "kernel", "window"]
    if options.subject == "shape" or options.integration == "dni":
        names.append("derivative")
    words = ["rkverify", options.subject]
    for name in names:
        value = getattr(options, name)
        if value is not None:
            words += [
                f"--{name.replace('_', '-')}",
                Path(value).as_posix() if name in ("nodes", "points") else str(value),
            ]
    return shlex.join(words)
