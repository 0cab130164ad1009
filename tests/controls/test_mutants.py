"""The score counts each mutant once, by the newest tests that it met: a survivor kept from old tests would be a fault of the past."""

import csv
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from controls import mutants
from controls.mutants import ROOT, explained, sources

FILE = "rkverify/solid/cells.py"
SAMPLE = [
    {"file": FILE, "line": n, "place": [n, 0, n, 1], "operator": "o", "old": f"a{n}", "new": f"b{n}", "text": ""}
    for n in range(4)
]


class NoBox:
    """Stands for the copy of the checkout."""

    def __init__(self, folder: Path) -> None: ...

    def close(self) -> None: ...


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    """Runs main with a sample of four; says which lines ran."""
    ran: list[int] = []
    state = {"killed": {0}, "tests": "old"}

    def outcome(_: object, mutant: dict) -> tuple[str, str, float]:
        ran.append(mutant["line"])
        return ("killed", "test", 0.0) if mutant["line"] in state["killed"] else ("survived", "", 0.0)

    monkeypatch.setattr(mutants, "sampled", lambda count, seed: {"sample": SAMPLE, "places": 4, "files": 1})
    monkeypatch.setattr(mutants, "Sandbox", NoBox)
    monkeypatch.setattr(mutants, "outcome", outcome)
    monkeypatch.setattr(mutants, "state_of", lambda tests: state["tests"])
    monkeypatch.setattr(mutants, "TABLE", tmp_path / "table.csv")
    monkeypatch.setattr(mutants, "KEPT", tmp_path / "kept")
    monkeypatch.setattr(mutants.os, "nice", lambda _: 0)

    def once(arguments: Sequence[str] = (), killed: set[int] | None = None, tests: str = "old") -> tuple[set[int], int]:
        state.update(killed=killed or {0}, tests=tests)
        ran.clear()
        monkeypatch.setattr(sys, "argv", ["mutants", *arguments])
        mutants.main()
        rows = list(csv.DictReader((tmp_path / "table.csv").read_text(encoding="utf-8").splitlines()))
        assert len(rows) == len(SAMPLE)
        assert list(rows[0]) == list(mutants.COLUMNS)
        return set(ran), sum(row["outcome"] == "survived" for row in rows)

    return once


def test_survivors_meet_new_tests_and_nothing_runs_twice_for_the_same(run) -> None:
    assert run() == ({0, 1, 2, 3}, 3)
    assert run() == (set(), 3)
    assert run(["--again"], {0, 2}) == (set(), 3)  # the same tests would say the same
    assert run(killed={0, 2}, tests="new") == (set(), 3)  # not asked for
    assert run(["--again"], {0, 2}, "new") == ({1, 2, 3}, 2)
    assert run(["--again"], {0, 2}, "new") == (set(), 2)


def test_what_came_out_at_first_is_kept(run) -> None:
    """A score after tests were written for its survivors is a score of those tests: the first one stays beside it."""
    run()
    run(["--again"], {0, 2}, "new")
    rows = list(csv.DictReader(mutants.TABLE.read_text(encoding="utf-8").splitlines()))
    assert [(row["first"], row["outcome"]) for row in rows] == [
        ("killed", "killed"),
        ("survived", "survived"),
        ("survived", "killed"),
        ("survived", "survived"),
    ]
    (log,) = mutants.KEPT.iterdir()
    told = mutants.described([entry | {"reason": ""} for entry in mutants.kept_in(log).values()])
    assert "when first run" in told
    assert "1 of 4 killed" in told
    assert "2 of 4 killed" in told


def test_every_module_has_tests_that_are_there(monkeypatch: pytest.MonkeyPatch) -> None:
    known = mutants.catalogue()
    monkeypatch.setattr(mutants, "catalogue", lambda: known)
    for file in sources():
        tests = mutants.tests_of(file)
        assert tests
        for test in tests:
            path, _, name = test.partition("::")
            assert (ROOT / path).exists(), test
            assert not name or f"def {name.partition('[')[0]}(" in (ROOT / path).read_text(encoding="utf-8"), test


def test_reasons_are_about_lines_that_are_there() -> None:
    """A reason for a line that has changed would excuse nothing, or something else."""
    for file, old, new in explained():
        text = [line.strip() for line in (ROOT / file).read_text(encoding="utf-8").splitlines()]
        assert old in text, (file, old)
        assert new not in text, (file, new)
