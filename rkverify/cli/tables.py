"""Tables in and out: CSV with a header, or JSON; numbers are read as text, so that no digit is lost."""

import csv
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from io import StringIO
from pathlib import Path
from typing import Any

from rkverify.arithmetic.native import rational
from rkverify.errors import BadInput
from rkverify.workflow.files import write_atomically

AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Points:
    """Coordinates (N, d) as exact rationals, and support radii where the table has a column a (None if blank)."""

    coordinates: list[tuple[Fraction, ...]]
    supports: list[Fraction | None]


def read_points(file: str) -> Points:
    """The points of a CSV file with header x[,y[,z]] and perhaps a.

    Raises BadInput, naming the file and the row, for a file that cannot be read, another header, a missing or extra
    cell, or a cell that is no finite number.
    """
    try:
        text = Path(file).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"cannot read {file}: {getattr(error, 'strerror', None) or 'it is not text'}") from None
    try:
        rows = [row for row in csv.reader(StringIO(text)) if row]
    except csv.Error as error:
        raise BadInput(f"{file} is no table: {error}; write one row per line") from None
    header = [name.strip() for name in rows[0]] if rows else []
    axes = [name for name in header if name != "a"]
    if not axes or tuple(axes) != AXES[: len(axes)] or len(set(header)) != len(header):
        raise BadInput(f"{file}: the header is {','.join(header)!r}; write x, or x,y or x,y,z, and a for supports")
    if len(rows) == 1:
        raise BadInput(f"{file}: there are no rows below the header; give at least one")
    points = Points([], [])
    for number, row in enumerate(rows[1:]):
        if len(row) != len(header):
            raise BadInput(
                f"{file}, row {number}: {len(row)} cells where the header has {len(header)}; complete the row"
            )
        cells = dict(zip(header, row, strict=True))
        points.coordinates.append(tuple(_number(cells[axis], file, number, axis) for axis in axes))
        own = cells.get("a", "").strip()
        points.supports.append(_number(own, file, number, "a") if own else None)
    return points


def _number(cell: str, file: str, row: int, column: str) -> Fraction:
    try:
        return rational(cell.strip())
    except BadInput as error:
        raise BadInput(f"{file}, row {row}, column {column}: {error}") from None


def write_table(columns: Sequence[str], rows: Sequence[Sequence[Any]], as_json: bool, out: str | None) -> None:
    """Write rows as CSV, or as a JSON list of objects, to standard output or to a file.

    Raises BadInput where the file cannot be written.
    """
    if as_json:
        text = json.dumps([dict(zip(columns, row, strict=True)) for row in rows], indent=1) + "\n"
    else:
        stream = StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
        text = stream.getvalue()
    if out is None:
        sys.stdout.write(text)
    elif Path(out).exists() and not (Path(out).is_file() or Path(out).is_dir()):
        Path(out).write_text(text, encoding="utf-8")  # a pipe or a terminal: nothing to replace
    else:
        write_atomically(Path(out), text)
