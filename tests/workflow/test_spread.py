"""A file with a line for each curve holds what the table with a row for each point holds, and says what is where.

It is a fifth as long, and only worth that where nobody can misread it.
"""

import csv
from io import StringIO

import pandas as pd
import pytest

from rkverify.report.latex import length
from rkverify.report.latex import table as tabular
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Table, table

COLUMNS = [
    ("case", "", "which one"),
    ("Q", "1/time", "velocity gradient"),
    ("kh", "rad", "wave number times spacing"),
    ("D", "1", "discriminant"),
    ("growth", "1/time", "largest growth"),
]
ROWS = [
    {"case": "a, b", "Q": "0", "kh": 0.1, "D": 1.5, "growth": 0.25},
    {"case": "a, b", "Q": "0", "kh": 1 / 3, "D": -2.0, "growth": 0.0},
    {"case": "a, b", "Q": "1/2", "kh": 0.1, "D": 3.0, "growth": 7.0},
    {"case": "c", "Q": "0", "kh": 1 / 3, "D": float("nan"), "growth": 1e-9},
]


def made(values: int, across: str = "kh") -> Table:
    """The table with so many columns of values."""
    kept = [name for name, _, _ in COLUMNS[: 3 + values]]
    rows = [{name: row[name] for name in kept} for row in ROWS]
    return table(rows, COLUMNS[: 3 + values], "A table.", Exact(), across)


def points(text: str, keys: int) -> dict[tuple[str, ...], str]:
    """A wide file read back: key, and head -> value of each cell that is not empty."""
    header, *lines = list(csv.reader(StringIO(text)))
    found = {}
    for line in lines:
        for head, cell in zip(header[keys:], line[keys:], strict=True):
            if cell:
                name, _, place = head.partition(" = ")
                assert name == "kh"
                found[(*line[:keys], place)] = cell
    return found


def test_every_point_is_there_once_with_the_digits_of_the_long_file() -> None:
    long = list(csv.DictReader(StringIO(made(1, "").text())))
    expected = {(row["case"], row["Q"], row["kh"]): row["D"] for row in long if row["D"]}
    assert points(made(1).text(), 2) == expected


def test_several_quantities_have_lines_of_their_own() -> None:
    long = list(csv.DictReader(StringIO(made(2, "").text())))
    expected = {
        (row["case"], row["Q"], name, row["kh"]): row[name] for row in long for name in ("D", "growth") if row[name]
    }
    assert points(made(2).text(), 3) == expected
    assert len(made(2).text().splitlines()) == 1 + 5  # c has no D at all, and no line for it


def test_what_the_columns_hold_is_said() -> None:
    one, two = made(1).columns_of_file, made(2).columns_of_file
    assert [c.name for c in one] == ["case", "Q", "kh = …"]
    assert (one[-1].unit, one[-1].meaning) == ("1", "discriminant, at this kh (rad), wave number times spacing")
    assert [c.name for c in two] == ["case", "Q", "quantity", "kh = …"]
    assert two[2].meaning == "what the line holds. D (1): discriminant; growth (1/time): largest growth"
    assert [c.name for c in made(2, "").columns_of_file] == [name for name, _, _ in COLUMNS]


def test_the_same_place_twice_is_refused() -> None:
    """One value would hide the other."""
    twice = Table(made(1).columns, pd.concat([made(1).frame, made(1).frame.tail(1)]), "A table.", Exact(), "kh")
    with pytest.raises(ValueError, match=r"two rows of the table are for c, 0, kh = 0\.333333333333$"):
        twice.text()


def test_as_latex_it_counts_its_points_and_has_its_units() -> None:
    words = {"caption": "A table.", "columns": [vars(column) for column in made(1).columns_of_file]}
    assert length(made(1).text(), words) == 2 * 2  # places that are empty count as well
    assert length(made(2, "").text(), {"columns": made(2, "").columns_of_file}) == len(ROWS)
    tex = tabular(made(1).text(), words, "a file")
    assert "%   kh = ...: discriminant, at this kh (rad)" in tex
    assert " & (1/time) & (1) & (1) \\\\" in tex
