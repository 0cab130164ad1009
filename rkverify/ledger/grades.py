"""How good the evidence is, in four grades, each derived from what a statement records and never typed beside an entry.

A statement stores how its numbers came about ('proved', 'enclosed', 'exact', 'sampled') and the routes that agree. An
entry takes, for each half of its verdict (where it holds, where it fails), the best grade among the statements that
decide that half; an entry with layers does so layer by layer.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from rkverify.ledger.entries import Entry
from rkverify.ledger.states import DEFINITION, FAILS, HOLDS, READING, UNDECIDABLE, Evidence, State

PROVED, CERTIFIED, ROUTES, SAMPLED = "proved", "certified value", "independent routes agree", "sampled"
MEANINGS = {
    PROVED: "for every value in the range that the statement names, by exact algebra or in ball arithmetic. Where the study "
    "writes a proof log, the command rkverify recheck repeats every step of it.",
    CERTIFIED: "every digit of the numbers that decide is certain: they were computed in exact arithmetic or are enclosed in "
    "balls. It holds at the values that were tried; of those between it says nothing.",
    ROUTES: "the numbers come in floating point by the code that the statement is about and by the named routes, which "
    "share nothing with it; they agree to rounding, or to an order that the statement gives. At the values tried.",
    SAMPLED: "the numbers come in floating point by one route, at the values that were tried.",
}
"""Grade -> what it means, the strongest first."""
GRADES = tuple(MEANINGS)
OF_STORED = {"proved": PROVED, "enclosed": CERTIFIED, "exact": CERTIFIED, "sampled": SAMPLED}
"""The word that a statement stores -> its grade without a second route."""
HOW = {"enclosed": "enclosed", "exact": "exact arithmetic"}
PARTS = {True: "where it holds", False: "where it fails", None: ""}
"""A half of a verdict in words."""
ON_SIGNS = re.compile(r"stab(le|ility)|\bsigns?\b", re.IGNORECASE)
"""What an entry says that speaks of a sign or of stability without a verdict in layers."""


def grade(e: Evidence) -> str:
    """The grade of one statement."""
    found = OF_STORED[e.evidence]
    return ROUTES if found == SAMPLED and e.routes else found


def rank(e: Evidence) -> int:
    """0 for a proof, the larger the weaker."""
    return GRADES.index(grade(e))


def in_full(e: Evidence) -> str:
    """The grade of a statement with how its value is certified and which routes agree."""
    found = grade(e)
    how = f" ({HOW[e.evidence]})" if e.evidence in HOW else ""
    if not e.routes:
        return found + how
    agree = f"{ROUTES}: {', '.join(e.routes)}"
    return agree if found == ROUTES else f"{found}{how}; {agree}"


def strongest(evidence: Iterable[Evidence]) -> str:
    """The strongest grade among statements; empty where there is none."""
    found = {grade(e) for e in evidence}
    return next((name for name in GRADES if name in found), "")


@dataclass(frozen=True)
class Graded:
    """The grade of a verdict, or of one of its halves, in one layer ("" for an entry that knows none), and which routes agree."""

    layer: str
    part: str
    grade: str
    routes: tuple[str, ...]


def graded(word: str, layer: str, evidence: Iterable[Evidence]) -> list[Graded]:
    """The grades of a verdict: both halves where a reading decides and their grades differ, one otherwise, none while open."""
    halves: dict[str, tuple[bool | None, ...]] = {
        HOLDS: (True,), DEFINITION: (True,), FAILS: (False,), READING: (True, False), UNDECIDABLE: (None,)
    }  # fmt: skip
    found, statements = [], list(evidence)
    for half in halves.get(word, ()):
        deciding = [e for e in statements if e.holds is half]
        if deciding:
            routes = tuple(sorted({route for e in deciding for route in e.routes}))
            found.append(Graded(layer, PARTS[half], strongest(deciding), routes))
    if len({g.grade for g in found}) == 1:
        routes = tuple(sorted({route for g in found for route in g.routes}))
        return [Graded(layer, "", found[0].grade, routes)]
    return found


def grades(found: State) -> list[Graded]:
    """The grades of an entry, layer by layer where it has layers."""
    if not found.layers:
        return graded(found.name, "", found.evidence)
    return [
        one
        for layer, word in found.layers.items()
        for one in graded(word.partition(" (")[0], layer, [e for e in found.evidence if e.layer == layer])
    ]


def best(found: State) -> str:
    """The strongest grade of an entry in any of its layers; empty while nothing decides it."""
    there = {g.grade for g in grades(found)}
    return next((name for name in GRADES if name in there), "")


def in_words(given: Iterable[Graded]) -> str:
    """Grades of one layer in words.

    >>> in_words([Graded("", "where it holds", PROVED, ()), Graded("", "where it fails", ROUTES, ("duals", "steps"))])
    'proved where it holds; independent routes agree where it fails: duals, steps'
    """
    parts = []
    for g in given:
        words = f"{g.grade} {g.part}".rstrip()
        if g.routes:
            words += f": {', '.join(g.routes)}" if g.grade == ROUTES else f"; {ROUTES}: {', '.join(g.routes)}"
        parts.append(words)
    return "; ".join(parts)


def on_signs(entry: Entry) -> bool:
    """Whether an entry states a sign or a stability: it needs a verdict in layers, or says so in its words."""
    return bool(entry.layers or ON_SIGNS.search(entry.statement))
