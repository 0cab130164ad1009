"""The notebooks as they are stored: what a reader opens, and what a diff shows.

Outputs in the repository would go stale, and a number typed into the prose would go wrong, without anybody noticing.
"""

import json
import re

import pytest

from rkverify.ledger.entries import entries
from rkverify.paths import checkout
from rkverify.report.notebooks import sources

SOURCES = sources(checkout())
NAMES = [source.name for source in SOURCES]
WANTED = {
    "start_here",
    "scni_and_dni_on_a_patch_test",
    "lagrangian_and_semi_lagrangian_kernels",
    "the_convective_term",
    "von_neumann_in_four_layers",
    "tensile_instability",
    "certificates",
}
ALLOWED = [r"`[^`]*`", r"\$\$.+?\$\$", r"\$[^$]+\$", r"\]\([^)]*\)", r"\((?:\d+|[CEF]\d+)\)"]
"""Where digits may stand: code, formulas, links, numbers of equations and entries."""


def cells(name: str) -> list[dict]:
    path = checkout().root / "notebooks" / f"{name}.ipynb"
    return json.loads(path.read_text(encoding="utf-8"))["cells"]


def words(name: str) -> str:
    return "\n\n".join("".join(c["source"]) for c in cells(name) if c["cell_type"] == "markdown")


def test_all_notebooks_are_there_and_the_first_is_the_first() -> None:
    assert set(NAMES) >= WANTED
    assert NAMES[0] == "start_here"


@pytest.mark.parametrize("name", NAMES)
def test_stored_without_outputs_under_ids_that_stay(name: str) -> None:
    found = cells(name)
    for cell in found:
        assert cell["metadata"] == {}
        if cell["cell_type"] == "code":
            assert (cell["outputs"], cell["execution_count"]) == ([], None)
    ids = [cell["id"] for cell in found]
    assert len(ids) == len(set(ids))
    assert all(re.fullmatch(r"[a-z][a-z0-9-]*", id) for id in ids), "an id that says what the cell is for"


@pytest.mark.parametrize("name", NAMES)
def test_no_number_is_typed_into_the_prose(name: str) -> None:
    """Exercises aside, whose numbers are settings for the reader to try."""
    prose = words(name).partition("## Exercises")[0]
    for pattern in ALLOWED:
        prose = re.sub(pattern, "", prose, flags=re.DOTALL)
    headings = re.compile(r"^#+ .*$", re.MULTILINE)  # 'Figures 4 to 8' is a name
    assert re.findall(r".{0,30}\d.{0,30}", headings.sub("", prose)) == []


@pytest.mark.parametrize("name", NAMES)
def test_entries_that_are_named_exist(name: str) -> None:
    assert [id for id in re.findall(r"\(([CEF]\d+)\)", words(name)) if id not in entries()] == []


@pytest.mark.parametrize("name", sorted(WANTED))
def test_two_or_three_exercises_each_with_a_solution(name: str, solutions) -> None:
    exercises = re.findall(r"^\*\*Exercise (\d)\.\*\*", words(name), re.MULTILINE)
    assert exercises in (["1", "2"], ["1", "2", "3"])
    solved = solutions(name)
    assert [n for n in "123456789" if hasattr(solved, f"exercise_{n}")] == exercises
    assert f"`notebooks/solutions/{name}.py`" in words(name)
