"""Grades follow from what statements record: a grade that somebody could type would say what he wished.

Made-up statements decide what each half of a verdict is worth; the committed ones, that no sign or stability claim is without.
"""

from dataclasses import replace

import pytest

from rkverify.ledger import states as rule
from rkverify.ledger.entries import entries
from rkverify.ledger.grades import (  # fmt: skip
    CERTIFIED,
    GRADES,
    PROVED,
    ROUTES,
    SAMPLED,
    best,
    grade,
    grades,
    in_full,
    in_words,
    on_signs,
)
from rkverify.ledger.states import OPEN, states


@pytest.mark.parametrize(
    ("stored", "routes", "expected", "words"),
    [
        ("proved", (), PROVED, "proved"),
        ("proved", ("a",), PROVED, "proved; independent routes agree: a"),
        ("enclosed", (), CERTIFIED, "certified value (enclosed)"),
        ("exact", (), CERTIFIED, "certified value (exact arithmetic)"),
        ("exact", ("a", "b"), CERTIFIED, "certified value (exact arithmetic); independent routes agree: a, b"),
        ("sampled", ("a", "b"), ROUTES, "independent routes agree: a, b"),
        ("sampled", (), SAMPLED, "sampled"),
    ],
)
def test_the_grade_of_a_statement(stored, routes, expected, words, evidence):
    e = replace(evidence(True, routes=routes), evidence=stored)
    assert (grade(e), in_full(e)) == (expected, words)


def graded(words, layer, evidence):
    """holds or fails, reading, stored evidence: "+r/proved" holds under r and is proved."""
    found = []
    for word in words.split():
        told, _, stored = word.partition("/")
        found.append(replace(evidence({"+": True, "-": False, "?": None}[told[0]], told[1:], layer), evidence=stored))
    return found


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("+/proved +/sampled", "proved"),
        ("+/sampled +/exact", "certified value"),
        ("-/sampled +/proved", "sampled"),
        ("-/proved +/sampled", "proved"),
        ("+a/proved -b/sampled", "proved where it holds; sampled where it fails"),
        ("+a/sampled -b/enclosed", "sampled where it holds; certified value where it fails"),
        ("+a/proved -b/proved -b/sampled", "proved"),
        ("-a/sampled -b/proved", "proved"),
        ("?/sampled", "sampled"),
        ("", ""),
    ],
)
def test_what_decides_a_verdict_gives_it_its_grade(words, expected, entry, evidence):
    """A proof of what holds says nothing of what fails: each half has the best of the statements that decide it."""
    made = entry()
    assert in_words(grades(rule.state(made, graded(words, "", evidence)))) == expected
    layered = entry(layers=("printed", "simulated"))
    found = rule.state(layered, [*graded(words, "printed", evidence), *graded("+/exact", "simulated", evidence)])
    assert in_words(g for g in grades(found) if g.layer == "printed") == expected
    assert [g.grade for g in grades(found) if g.layer == "simulated"] == [CERTIFIED]


def test_the_best_grade_is_that_of_any_layer(entry, evidence):
    layered = entry(layers=("printed", "simulated"))
    found = rule.state(layered, [*graded("+/sampled", "printed", evidence), *graded("-/proved", "simulated", evidence)])
    assert best(found) == PROVED
    assert best(rule.state(layered, [])) == ""


def test_routes_are_named_once_each(entry, evidence):
    found = rule.state(entry("definition"), [evidence(True, routes=("b", "a")), evidence(True, routes=("a", "c"))])
    assert in_words(grades(found)) == "certified value; independent routes agree: a, b, c"


def without_grade(found):
    """(entry, layer) of the sign and stability claims whose verdict in a layer has no grade."""
    return [
        (name, layer)
        for name, state in found.items()
        if on_signs(entries()[name])
        for layer in (entries()[name].layers or ("",))
        if not [g for g in grades(state) if g.layer == layer and g.grade in GRADES]
    ]


def test_every_sign_or_stability_claim_carries_its_grade_in_every_layer(root):
    found = states(root / "reports" / "results")
    claims = [name for name in found if on_signs(entries()[name])]
    assert {"C2", "C5", "C34", "C40", "C50", "C67", "E76", "F5"} <= set(claims)
    assert without_grade(found) == []


def test_a_claim_without_a_grade_is_found(root):
    """The twin: without what one study says in a layer, that claim is told."""
    kept = [
        e for e in rule.read_evidence(root / "reports" / "results") if "C34" not in e.about or e.layer != "simulated"
    ]
    assert without_grade({name: rule.state(e, kept) for name, e in entries().items()}) == [("C34", "simulated")]


def test_every_decided_entry_has_a_grade(root):
    """And where routes are said to agree, they have names."""
    for name, state in states(root / "reports" / "results").items():
        assert (state.name == OPEN) == (best(state) == ""), name
        for g in grades(state):
            assert g.grade != ROUTES or g.routes, name
