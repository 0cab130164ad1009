"""The page says how many faults and mutants are noticed, from committed tables: these must be of the catalogue and the reasons as they are.

A fault that was added and never tried, or a survivor without a reason, would otherwise stand behind a count that looks whole.
"""

import csv
from pathlib import Path
from types import SimpleNamespace

from controls.faults import catalogue
from controls.mutants import COLUMNS, explained
from rkverify.paths import checkout
from rkverify.report.trials import Faults, trials

FOLDER = checkout().root / "reports" / "controls"


def rows(name: str) -> list[dict[str, str]]:
    with (FOLDER / f"{name}.csv").open(encoding="utf-8", newline="") as handle:
        return list(csv.DictReader(handle))


def test_every_fault_of_the_catalogue_was_tried_as_it_is_and_caught() -> None:
    tried = {(row["fault"], row["file"], row["what is wrong"], row["checks"]) for row in rows("controls")}
    assert tried == {(fault.id, fault.file, fault.wrong, " ".join(fault.checks)) for fault in catalogue().faults}
    assert {row["caught"] for row in rows("controls")} == {"yes"}


def test_every_survivor_has_its_reason_and_nothing_else_has() -> None:
    reasons = explained()
    for row in rows("mutants"):
        why = reasons.get((row["file"], row["old"].strip(), row["new"].strip()), "")
        assert row["reason"] == (why if row["outcome"] == "survived" else "")
        assert bool(row["reason"]) == (row["outcome"] == "survived"), row


def test_counts_are_those_of_the_tables(tmp_path: Path) -> None:
    folder = tmp_path / "reports" / "controls"
    folder.mkdir(parents=True)
    (folder / "controls.csv").write_text("fault,file,caught\na,rkverify/solid/x.py,yes\nb,rkverify/solid/y.py,no\n")
    outcomes = [("killed", "killed"), ("survived", "killed"), ("survived", "survived"), ("killed", "killed")]
    lines = [f"rkverify/paper/x.py,{n},o,a{n},b{n},{first},{now},t,r" for n, (first, now) in enumerate(outcomes)]
    (folder / "mutants.csv").write_text("\n".join([",".join(COLUMNS), *lines]) + "\n")
    place = SimpleNamespace(root=tmp_path, pages=tmp_path / "reports")
    found = trials(place)  # type: ignore[arg-type]
    assert found.faults == [Faults("solid", 2, 1)]
    whole, paper = found.scores
    assert (whole.package, paper.package) == ("all", "paper")
    assert (whole.mutants, whole.first, whole.now) == (4, 2, 3)
    # Clopper and Pearson, 2 of 4: the beta quantiles that tables give to four digits.
    assert (round(whole.low, 4), round(whole.high, 4)) == (0.0676, 0.9324)
    assert [survivor[0] for survivor in found.survivors] == ["paper/x.py:2"]
    assert found.faults_file == "controls/controls.csv"


def test_without_tables_there_is_nothing(tmp_path: Path) -> None:
    found = trials(SimpleNamespace(root=tmp_path, pages=tmp_path))  # type: ignore[arg-type]
    assert (found.faults, found.scores, found.survivors) == ([], [], [])
