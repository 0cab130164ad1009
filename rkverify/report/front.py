"""The front page: states and evidence as one picture, and the findings, each a statement of a study."""

import re
from dataclasses import dataclass
from typing import Any

from rkverify.errors import BadInput
from rkverify.ledger.grades import GRADES, best
from rkverify.ledger.states import STATES
from rkverify.report.cards import Card
from rkverify.report.content import CSS, Site
from rkverify.report.formulas import data
from rkverify.report.sections import statements

NONE = "no evidence yet"
DIGITS = re.compile(r"\d+\.\d{8,}")
"""A number with more digits than a sentence on the front page needs; the statement itself keeps them."""


def shortened(says: str) -> str:
    """The sentence with its long numbers to six digits.

    >>> shortened("turning at R = 1.576327153241754299888518284476")
    'turning at R = 1.57633'
    """
    return DIGITS.sub(lambda m: f"{float(m[0]):.6g}", says)


@dataclass(frozen=True)
class Finding:
    """A question, the entry it is about with its verdicts, and the statement that answers it."""

    subject: str
    card: Card
    statement: dict[str, Any]


def findings(site: Site, cards: dict[str, Card], quick: bool = False) -> list[Finding]:
    """The findings that front.toml lists and that studies have made; a study without results has none.

    quick: a quick run's smaller parameters may leave a statement out. Raises BadInput where one is missing otherwise.
    """
    found = []
    for raw in data("front.toml")["finding"]:
        if raw["statement"].partition("/")[0] in site.missing:
            continue
        try:
            said = statements(site, raw["statement"])[0]
        except BadInput:
            if not quick:
                raise
            continue
        found.append(Finding(raw["subject"], cards[raw["about"]], {**said, "says": shortened(said["says"])}))
    return found


@dataclass(frozen=True)
class Part:
    """A part of a bar: a grade of evidence, how many entries, where it starts."""

    grade: str
    css: str
    count: int
    start: int


@dataclass(frozen=True)
class Bar:
    """A state and its entries by the strongest grade of evidence for each."""

    state: str
    css: str
    total: int
    parts: list[Part]


def picture(site: Site) -> list[Bar]:
    """Bars of how many entries are in each state, split by the strongest grade of evidence."""
    bars = []
    for word in STATES:
        graded = [best(s) or NONE for s in site.states.values() if s.name == word]
        parts, start = [], 0
        for place, grade in enumerate((*GRADES, NONE)):
            if count := graded.count(grade):
                parts.append(Part(grade, f"grade{place}", count, start))
                start += count
        if graded:
            bars.append(Bar(word, CSS[word], len(graded), parts))
    return bars


def in_words(bars: list[Bar]) -> str:
    """The picture's alternative text: what it says, with every count."""
    total = sum(bar.total for bar in bars)
    each = [
        f"{bar.total} in the state '{bar.state}' ({', '.join(f'{part.count} {part.grade}' for part in bar.parts)})"
        for bar in bars
    ]
    return f"Of {total} entries, {'; '.join(each)}."
