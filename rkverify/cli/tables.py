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

    @property
    def dimension(self) -> int:
        """The number d of coordinates."""
        return len(self.coordinates[0])

    def radii(self, common: str | None) -> list[Fraction | str]:
        """The support radius of every node, its own or the common one; raises BadInput where there is neither."""
        chosen: list[Fraction | str] = []
        for node, own in enumerate(self.supports):
            radius = common if own is None else own
            if radius is None:
                raise BadInput(f"node {node} has no support: give --support A, or a column a in the nodes' file")
            chosen.append(radius)
        return chosen


@dataclass(frozen=True)
class Rows:
    """The header and the cells of a CSV file with a name; rows are counted from 0 below the header."""

    file: str
    header: list[str]
    cells: list[dict[str, str]]

    def number(self, row: int, column: str) -> Fraction:
        """The exact value of a cell; raises BadInput, naming file, row and column, where it is no finite number."""
        try:
            return rational(self.cells[row][column].strip())
        except BadInput as error:
            raise BadInput(f"{self.file}, row {row}, column {column}: {error}") from None

    def count(self, row: int, column: str) -> int:
        """The value of a cell that counts something; raises BadInput where it is no integer of at least 0."""
        text = self.cells[row][column].strip()
        if not (text.isascii() and text.isdigit() and len(text) < 10):
            raise BadInput(
                f"{self.file}, row {row}, column {column}: {text!r} is no number of a {column}: count from 0"
            )
        return int(text)


def read_rows(file: str) -> Rows:
    """The rows of a CSV file.

    Raises BadInput, naming the file and the row, for a file that cannot be read or a missing or extra cell.
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
    for number, row in enumerate(rows[1:]):
        if len(row) != len(header):
            raise BadInput(
                f"{file}, row {number}: {len(row)} cells where the header has {len(header)}; complete the row"
            )
    return Rows(file, header, [dict(zip(header, row, strict=True)) for row in rows[1:]])


def read_points(file: str) -> Points:
    """The points of a CSV file with header x[,y[,z]] and perhaps a.

    Raises BadInput, naming the file and the row, for a file that cannot be read, another header, a missing or extra
    cell, or a cell that is no finite number.
    """
    rows = read_rows(file)
    axes = [name for name in rows.header if name != "a"]
    if not axes or tuple(axes) != AXES[: len(axes)] or len(set(rows.header)) != len(rows.header):
        raise BadInput(f"{file}: the header is {','.join(rows.header)!r}; write x, or x,y or x,y,z, and a for supports")
    if not rows.cells:
        raise BadInput(f"{file}: there are no rows below the header; give at least one")
    points = Points([], [])
    for number, cells in enumerate(rows.cells):
        points.coordinates.append(tuple(rows.number(number, axis) for axis in axes))
        points.supports.append(rows.number(number, "a") if cells.get("a", "").strip() else None)
    return points


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
    write_text(text, out)


def write_text(text: str, out: str | None) -> None:
    """Write text to standard output or to a file; raises BadInput where the file cannot be written."""
    if out is None:
        sys.stdout.write(text)
    elif Path(out).exists() and not (Path(out).is_file() or Path(out).is_dir()):
        Path(out).write_text(text, encoding="utf-8")  # a pipe or a terminal: nothing to replace
    else:
        write_atomically(Path(out), text)
