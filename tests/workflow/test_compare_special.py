"""Values that are no ordinary numbers, and files that are no artefacts: told like any departure, never a crash.

A table that turned to nan or inf is the failure that a comparison is most needed for.
"""

import pytest

from rkverify.workflow.compare import Certified, Exact, Numeric, Record, Visual
from rkverify.workflow.produce import Artefact
from rkverify.workflow.reconcile import departures

WHY = "made up"
CELLS = (Certified(), Numeric(1e-3, 1e-3, WHY))
RULES = (Exact(), *CELLS, Visual(0.05, WHY), Record(1e-3, WHY))
SPECIAL = ("nan", "NaN", "-nan", "sNaN", "inf", "-inf", "Infinity", "", "text")


def by_kind(rule):
    return rule.kind


@pytest.mark.parametrize("rule", CELLS, ids=by_kind)
@pytest.mark.parametrize("cell", SPECIAL)
def test_a_cell_that_is_no_number_any_more_is_told_at_its_place(rule, cell):
    before, after = "x,y\n1,0.5\n", f"x,y\n1,{cell}\n"
    for committed, recomputed in ((before, after), (after, before)):
        assert [d.place for d in rule.differences(committed, recomputed)] == ["row 1, column y"]


@pytest.mark.parametrize("rule", CELLS, ids=by_kind)
@pytest.mark.parametrize(("one", "other"), [("inf", "-inf"), ("inf", "nan"), ("nan", "inf")])
def test_no_two_special_values_pass_for_each_other(rule, one, other):
    assert rule.differences(f"x\n{one}\n", f"x\n{other}\n")


@pytest.mark.parametrize("value", ["NaN", "Infinity", "-Infinity", "1e400"])
def test_a_margin_that_is_no_number_any_more_is_told(value):
    before, after = '{"margin": 0.5}', f'{{"margin": {value}}}'
    for committed, recomputed in ((before, after), (after, before)):
        assert [d.place for d in Record(1e-3, WHY).differences(committed, recomputed)] == ["margin"]


def test_an_overflow_in_a_sentence_is_told():
    """1e999 in a sentence reads as infinity, which is within any share of itself from every number."""
    assert Record(1e-3, WHY).differences('{"says": "at least 0.5"}', '{"says": "at least 1e999"}')


@pytest.mark.parametrize("rule", RULES, ids=by_kind)
@pytest.mark.parametrize("text", ['{"x": NaN}', '{"x": Infinity}', '"a sentence with 1e999 in it"', "[]", "null"])
def test_a_text_agrees_with_itself(rule, text):
    """Otherwise a study with such a value could never be run again: same sources, same text, refused."""
    assert rule.differences(text, text) == []


GARBAGE = {
    "binary": b"\xff\xfe\x00\x01",
    "nothing": b"",
    "zeros": b"\x00" * 200_000,
    "cut short": b'x\n"7.',
    "carriage return": b"x\r1\ry",
    "half a record": b'{"x": ',
}


@pytest.mark.parametrize("rule", RULES, ids=by_kind)
@pytest.mark.parametrize("kind", GARBAGE)
def test_a_file_that_is_no_artefact_is_a_departure(rule, kind, tmp_path):
    """verify and run must name the file that somebody's disk or merge spoilt, not stop on it."""
    good = '{"x": 1}' if isinstance(rule, Record) else "x\n1\n"
    (tmp_path / "file").write_bytes(GARBAGE[kind])
    found = departures(tmp_path, {"file": Artefact(good, rule)})
    assert [d.file for d in found] == ["file"]
    assert all(line.startswith("file: ") for line in found[0].lines())
    (tmp_path / "file").write_text(good, encoding="utf-8")
    assert departures(tmp_path, {"file": Artefact(good, rule)}) == []


def test_a_missing_file_is_a_departure(tmp_path):
    (found,) = departures(tmp_path, {"gone.csv": Artefact("x\n", Exact())})
    assert "missing" in found.lines()[0]


def test_many_departures_are_cut_short_and_counted(tmp_path):
    (tmp_path / "t.csv").write_text("x\n" + "1\n" * 40, encoding="utf-8")
    (found,) = departures(tmp_path, {"t.csv": Artefact("x\n" + "2\n" * 40, Numeric(0, 0, WHY))})
    assert len(found.lines(5)) == 6
    assert "35 more places" in found.lines(5)[-1]
