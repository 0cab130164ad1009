"""Entries, studies, tests and transcriptions name each other both ways.

A claim that lists a decider that says nothing about it, or a decider that no claim lists, is a verdict that nobody
could follow back to its computation.
"""

import json
import re

import pytest

from rkverify.ledger.entries import entries, transcriptions
from rkverify.ledger.states import OPEN, both_ways, read_evidence, states

SAMPLE = '''
import pytest

pytestmark = pytest.mark.decides("E1")

@pytest.mark.decides("E2", "C3")
@pytest.mark.parametrize("x", [pytest.param(1, marks=pytest.mark.decides("E4"))])
def test_one(x):
    helper(x)

class TestGroup:
    pytestmark = [pytest.mark.slow, pytest.mark.decides("E5")]

    @pytest.mark.decides("F1")
    def test_two(self):
        pass

def helper(x):
    """Not a test."""
'''


def test_every_way_to_write_a_marker_is_collected(tmp_path, markers):
    (tmp_path / "tests" / "a").mkdir(parents=True)
    (tmp_path / "tests" / "a" / "test_b.py").write_text(SAMPLE, encoding="utf-8")
    one, two = "tests/a/test_b.py::test_one", "tests/a/test_b.py::TestGroup::test_two"
    both = sorted([one, two])
    assert markers(tmp_path) == {"E1": both, "E2": [one], "C3": [one], "E4": [one], "E5": [two], "F1": [two]}


def test_a_marker_that_cannot_be_read_is_refused(tmp_path, markers):
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_b.py").write_text("@pytest.mark.decides(*IDS)\ndef test_x(): ...\n", encoding="utf-8")
    with pytest.raises(ValueError, match="plain strings"):
        markers(tmp_path)


def test_markers_name_entries_that_exist(markers):
    assert sorted(markers().keys() - entries().keys()) == []


def test_entries_and_tests_name_each_other(markers):
    listed = {(id, test) for id, e in entries().items() for test in e.tests}
    marked = {(id, test) for id, tests in markers().items() for test in tests}
    assert sorted(listed - marked) == [], "listed, and the test does not say that it decides the entry"
    assert sorted(marked - listed) == [], "the test says that it decides the entry, which does not list it"


def test_entries_and_studies_name_each_other(root):
    assert both_ways(root / "reports" / "results") == []


def test_listed_studies_exist(root):
    for id, e in entries().items():
        for study in e.studies:
            assert (root / "studies" / f"{study}.py").is_file(), (id, study)


@pytest.mark.parametrize(
    ("about", "told"),
    [
        (("E1", "E99"), r"study alpha makes a statement on E99, which the ledger does not have"),
        (("E88",), r"study alpha makes a statement on E88"),
        (("F1",), r"F1 is decided by study alpha and does not list it"),
    ],
)
def test_one_way_links_are_told(about, told, tmp_path, evidence):
    raw = {k: v for k, v in vars(evidence(True, about=about)).items() if k != "study"}
    (tmp_path / "alpha").mkdir()
    (tmp_path / "alpha" / "statements.json").write_text(json.dumps([raw]), encoding="utf-8")
    complaints = both_ways(tmp_path)
    assert any(re.search(told, line) for line in complaints)
    listing = next((id, e.studies[0]) for id, e in entries().items() if e.studies and id not in about)
    assert any(f"{listing[0]} lists study {listing[1]}" in line for line in complaints)


def test_every_statement_counts_for_what_it_is_about(root):
    """A statement in a layer that its entry does not have decides nothing, and nobody would notice."""
    lost = [
        f"{s.study}: {s.name} is about {id} in layer {s.layer!r}, which has {entries()[id].layers}"
        for s in read_evidence(root / "reports" / "results")
        for id in s.about
        if entries()[id].layers and s.layer not in entries()[id].layers
    ]
    assert lost == []


def test_decided_equations_are_transcribed(root):
    """A verdict on an equation of which the code has no transcription would be one on something else."""
    decided = {
        int(id[1:]) for id, found in states(root / "reports" / "results").items() if id[0] == "E" and found.name != OPEN
    }
    assert sorted(decided - transcriptions().keys()) == []


def test_transcribed_numbers_exist():
    assert sorted(n for n in transcriptions() if f"E{n}" not in entries()) == []


def test_a_docstring_names_the_number_that_it_transcribes():
    """Whoever reads the transcription next to the paper finds the place."""
    import importlib

    for number, places in transcriptions().items():
        for place in places:
            module, _, name = place.partition("rkverify.paper.")[2].partition(".")
            found = importlib.import_module(f"rkverify.paper.{module}")
            for part in name.split("."):
                found = getattr(found, part)
            words = f"{found.__doc__} {importlib.import_module(f'rkverify.paper.{module}').__doc__}"
            spans = [(int(a), int(b or a)) for a, b in re.findall(r"\((\d+)\)(?:-\((\d+)\))?", words)]
            assert any(a <= number <= b for a, b in spans), (number, place)
