"""The one written rule that makes states of statements, case by case.

The rule is what "holds" and "fails" mean in every table of the report; if it were lenient in one corner, all verdicts
that pass through that corner would be worth nothing. T, F and N: holds, fails, not decidable; a letter with a name:
under that reading.
"""

import pytest

from rkverify.errors import BadInput
from rkverify.ledger import states as rule
from rkverify.ledger.states import DEFINITION, FAILS, HOLDS, MIXED, OPEN, READING, UNDECIDABLE

WORD = {"T": True, "F": False, "N": None}

VERDICTS = {
    "": (OPEN, ""),
    "T": (HOLDS, ""),
    "F": (FAILS, ""),
    "N": (UNDECIDABLE, "says None"),
    "T T": (HOLDS, ""),
    "T F": (FAILS, ""),
    "T N": (UNDECIDABLE, "says None"),
    "F N": (FAILS, ""),  # what is refuted is refuted, whatever else cannot be decided
    "Ta Tb": (HOLDS, "a; b"),
    "Ta Fb": (READING, "a"),
    "Ta Tb Fc": (READING, "a; b"),
    "Ta Ta Fb": (READING, "a"),
    "Ta Fa Tb": (READING, "b"),
    "Fa Fb": (FAILS, "under every reading: a; b"),
    "Fa": (FAILS, "under every reading: a"),
    "Ta Fa": (FAILS, "under every reading: a"),
    "T Ta Fb": (READING, "a"),
    "T Fa": (FAILS, "under every reading: a"),
    "F Ta": (FAILS, ""),  # a statement without a reading counts under all of them
    "F Ta Fb": (FAILS, ""),
    "Ta N": (UNDECIDABLE, "says None"),
}


def statements(words, evidence, layer=""):
    return [evidence(WORD[word[0]], word[1:], layer) for word in words.split()]


@pytest.mark.parametrize("words", VERDICTS)
def test_the_verdict_of_one_layer(words, evidence):
    assert rule.verdict(statements(words, evidence)) == VERDICTS[words]


@pytest.mark.parametrize("words", VERDICTS)
def test_the_order_of_the_statements_does_not_count(words, evidence):
    assert rule.verdict(reversed(statements(words, evidence))) == VERDICTS[words]


@pytest.mark.parametrize("words", VERDICTS)
def test_an_entry_without_layers_has_the_verdict_as_its_state(words, entry, evidence):
    found = rule.state(entry(), statements(words, evidence))
    assert (found.name, found.detail) == VERDICTS[words]
    assert found.layers == {}


LAYERED = {
    ("T", "T"): HOLDS,
    ("F", "F"): FAILS,
    ("T", "F"): MIXED,
    ("T", ""): OPEN,
    ("F", ""): OPEN,
    ("", ""): OPEN,
    ("N", "N"): UNDECIDABLE,
    ("N", "T"): MIXED,
    ("Ta Fb", "Ta Fb"): READING,
    ("Ta Fb", "T"): MIXED,
    ("Fa Fb", "F"): FAILS,
}


@pytest.mark.parametrize("words", LAYERED, ids=" | ".join)
def test_layers_are_never_merged(words, entry, evidence):
    """A formula in print that is right and an equation that is not must not add up to something that holds."""
    about = [
        s for layer, w in zip(("printed", "simulated"), words, strict=True) for s in statements(w, evidence, layer)
    ]
    found = rule.state(entry(layers=("printed", "simulated")), about)
    assert found.name == LAYERED[words]
    for layer, w in zip(("printed", "simulated"), words, strict=True):
        name, detail = VERDICTS[w]
        assert found.layers[layer] == (f"{name} ({detail})" if detail else name)
        assert f"{layer}: {name}" in found.detail


def test_evidence_of_another_layer_does_not_decide(entry, evidence):
    assert rule.state(entry(layers=("printed",)), [evidence(True, layer="simulated"), evidence(True)]).name == OPEN


def test_a_definition_is_confirmed_by_its_routes(entry, evidence):
    found = rule.state(entry("definition"), [evidence(True, routes=("b", "a")), evidence(True, routes=("a",))])
    assert (found.name, found.detail) == (DEFINITION, "confirmed by 2: a; b")


@pytest.mark.parametrize(("words", "name"), [("F", FAILS), ("T F", FAILS), ("N", UNDECIDABLE), ("Ta Fb", READING)])
def test_a_definition_that_a_route_does_not_confirm(words, name, entry, evidence):
    assert rule.state(entry("definition"), statements(words, evidence)).name == name


def test_a_definition_without_a_route_is_not_confirmed(entry, evidence):
    """A transcription that agrees with nothing but itself has not been confirmed."""
    assert rule.state(entry("definition"), [evidence(True)]).name == OPEN


def test_statements_about_other_entries_do_not_count(entry, evidence):
    found = rule.state(entry(), [evidence(True), evidence(False, about=("C2", "C11"))])
    assert (found.name, len(found.evidence)) == (HOLDS, 1)


@pytest.mark.parametrize("content", ["", "{", "{}3", "3", "null", "[1]", '{"a": 1}', '[{"name": "x"}]', "\x00"])
def test_a_file_that_is_no_list_of_statements_is_named(content, tmp_path):
    """Evidence that cannot be read must stop the ledger: leaving it out would turn a failure into silence."""
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "statements.json").write_text(content, encoding="utf-8")
    with pytest.raises(BadInput, match=r"study/statements\.json"):
        rule.read_evidence(tmp_path)


@pytest.mark.parametrize("holds", ["yes", 1, 0, "false", []])
def test_a_verdict_is_true_false_or_null(holds, tmp_path, evidence):
    """Any other value would count as true or false by Python's own rules, 'false' as true."""
    raw = {k: v for k, v in vars(evidence(holds)).items() if k != "study"}
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "statements.json").write_text(rule.json.dumps([raw]), encoding="utf-8")
    with pytest.raises(BadInput, match=r"study/statements\.json"):
        rule.read_evidence(tmp_path)


def test_counts_add_up(root):
    found = rule.states(root / "reports" / "results")
    counts = rule.counts(found)
    assert list(counts) == list(rule.STATES)
    assert sum(counts.values()) == len(found) == 170
