"""The list of what is to be decided is complete and well-formed: a forgotten entry would be one that nothing refutes."""

import re

import pytest

from rkverify.errors import UnknownName
from rkverify.ledger.entries import COUNTS, FILES, entries, entry
from rkverify.ledger.states import DEFINITION, state
from rkverify.workflow.study import LAYERS

EXPECTED = [f"{letter}{n}" for letter, count in (("E", 87), ("F", 8), ("C", 75)) for n in range(1, count + 1)]


def test_there_are_170_entries_in_the_papers_order():
    """`entries` is a dict, in which a second entry of the same id would hide the first: the files are read as well."""
    assert sum(COUNTS.values()) == 170
    assert list(entries()) == EXPECTED


@pytest.mark.parametrize("file", FILES)
def test_no_id_is_used_twice(file, root):
    text = (root / "rkverify" / "ledger" / file).read_text(encoding="utf-8")
    ids = re.findall(r'^id = "(.*)"$', text, re.MULTILINE)
    assert len(ids) == text.count("[[entry]]") == COUNTS[ids[0][0]]
    assert len(set(ids)) == len(ids)


@pytest.mark.parametrize("id", EXPECTED)
def test_an_entry_is_complete(id):
    e = entries()[id]
    assert e.id == id
    assert e.kind in ({"figure"} if id[0] == "F" else {"definition", "result"})
    for words in (e.place, e.statement, e.decided_by):
        assert words.strip() == words != ""
    assert re.search(r"Section|Abstract|Figure|Conclusion|Title", e.place), e.place
    assert set(e.layers) <= set(LAYERS)
    assert list(e.layers) == [layer for layer in LAYERS if layer in e.layers], "layers in their order, each once"
    for names in (e.studies, e.tests):
        assert list(names) == sorted(set(names)), "in order, each once"


@pytest.mark.parametrize("id", [id for id in EXPECTED if id[0] == "E"])
def test_an_equations_place_names_its_number(id):
    assert re.search(rf"\({id[1:]}\)", entries()[id].place), entries()[id].place


@pytest.mark.parametrize("name", ["C43", "c43"])
def test_an_entry_is_found_by_its_id(name):
    assert entry(name) is entries()["C43"]


@pytest.mark.parametrize("name", ["E0", "E88", "F9", "C76", "", "43", "E01"])
def test_an_unknown_id_is_refused(name):
    with pytest.raises(UnknownName, match="E1 to E87"):
        entry(name)


@pytest.mark.parametrize("id", EXPECTED)
def test_nothing_is_confirmed_without_evidence(id):
    assert state(entries()[id], []).name not in (DEFINITION, "holds")
