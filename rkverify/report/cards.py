"""What the pages Equations, Figures and Claims show of each entry: state, evidence layer by layer, code, checks, data."""

from dataclasses import dataclass
from typing import Any

from rkverify.ledger.entries import Entry, transcriptions
from rkverify.ledger.grades import best, grades, in_words, rank
from rkverify.ledger.states import DEFINITION, FAILS, HOLDS, OPEN, READING, UNDECIDABLE, State
from rkverify.paths import Checkout
from rkverify.report.content import CSS, Site, StudyPage, state_css, statement
from rkverify.report.formulas import formulas, notes
from rkverify.report.links import Link, module_link, test_link
from rkverify.workflow.study import LAYERS

FIRST = 3
"""So many statements of a layer are shown at once; more are folded away."""


@dataclass(frozen=True)
class Group:
    """The statements on an entry in one layer ("" for an entry that knows none), those that decide it first; grade: of the verdict, in words."""

    layer: str
    word: str
    css: str
    detail: str
    grade: str
    first: list[dict[str, Any]]
    more: list[dict[str, Any]]


@dataclass(frozen=True)
class Card:
    """An entry as its page shows it; grade: the best in any layer, whole: in words, where the verdict knows no layers."""

    id: str
    number: int
    place: str
    statement: str
    kind: str
    decided_by: str
    state: str
    css: str
    detail: str
    grade: str
    whole: str
    margin: str
    margin_means: str
    groups: list[Group]
    studies: list[StudyPage]
    tests: list[Link]
    code: list[Link]
    formula: Any = None
    scan: str = ""
    reading: str = ""

    @property
    def evidence(self) -> str:
        """The grades in words, layer by layer; empty while nothing decides."""
        told: dict[str, list[str]] = {}
        for group in self.groups:
            if group.grade:
                told.setdefault(group.grade, []).append(group.layer)
        return self.whole or "; ".join(f"{', '.join(names)}: {grade}" for grade, names in told.items())

    @property
    def layers(self) -> dict[str, Group]:
        """Layer -> its group."""
        return {group.layer: group for group in self.groups if group.layer}

    @property
    def verdicts(self) -> list[tuple[str, str, str, str]]:
        """(layers, state, style, readings): layers of one state together; the state as a whole where the entry knows no layers."""
        if len(self.layers) < 2:
            return [("", self.state, self.css, "" if self.state == DEFINITION else self.detail)]
        found: dict[tuple[str, str], list[str]] = {}
        for name, group in self.layers.items():
            if group.word:
                found.setdefault((group.word, group.detail if group.word == READING else ""), []).append(name)
        return [(", ".join(names), word, state_css(word), readings) for (word, readings), names in found.items()]


def card(place: Checkout, site: Site, entry: Entry, found: State) -> Card:
    """The card of one entry."""
    number = int(entry.id[1:])
    deciding = [e for e in found.evidence if e.holds is (found.name != FAILS)] or list(found.evidence)
    tightest = min((e for e in deciding if e.margin is not None), key=lambda e: abs(e.margin or 0.0), default=None)
    is_equation = entry.id.startswith("E")
    return Card(
        id=entry.id,
        number=number,
        place=entry.place,
        statement=entry.statement,
        kind=entry.kind,
        decided_by=entry.decided_by,
        state=found.name,
        css=CSS[found.name],
        detail="" if found.layers else found.detail,
        grade=best(found),
        whole=in_words(g for g in grades(found) if not g.layer),
        margin="" if tightest is None else str(statement(tightest)["margin"]),
        margin_means="" if tightest is None else tightest.margin_means,
        groups=_groups(entry, found),
        studies=[
            site.studies[name]
            for name in sorted({*entry.studies, *(e.study for e in found.evidence)})
            if name in site.studies
        ],
        tests=[test_link(place, test) for test in entry.tests],
        code=[module_link(place, path) for path in transcriptions().get(number, [])] if is_equation else [],
        formula=formulas().get(number) if is_equation else None,
        scan=notes("scan").get(number, "") if is_equation else "",
        reading=notes("reading").get(number, "") if is_equation else "",
    )


def _groups(entry: Entry, found: State) -> list[Group]:
    needed = [*entry.layers, *({e.layer for e in found.evidence} - set(entry.layers))]
    order = {layer: place for place, layer in enumerate(("", *LAYERS))}
    groups, graded = [], grades(found)
    for layer in sorted(needed, key=lambda name: order[name]):
        here = [e for e in found.evidence if e.layer == layer]
        word, _, detail = found.layers.get(layer, "" if layer else found.name).partition(" (")
        # What turns a verdict comes first, and of it the strongest evidence.
        here.sort(key=lambda e: (e.holds is True if word != HOLDS else e.holds is not True, rank(e)))
        said = [statement(e) for e in here]
        grade = in_words(g for g in graded if g.layer == layer)
        groups.append(Group(layer, word, state_css(word), detail.removesuffix(")"), grade, said[:FIRST], said[FIRST:]))
    return groups


def cards(place: Checkout, site: Site, letter: str) -> list[Card]:
    """The cards of all entries of one kind."""
    return [card(place, site, entry, found) for entry, found in site.entries(letter)]


@dataclass(frozen=True)
class FigureCard:
    """One of the paper's figures: its card, and the study that draws it and what the claims make of it."""

    card: Card
    study: StudyPage | None
    claims: list[Card]


def figure_cards(place: Checkout, site: Site, claims: list[Card]) -> list[FigureCard]:
    """The paper's figures with the studies of their number, and the claims that these studies speak of."""
    found = []
    for shown in cards(place, site, "F"):
        study = site.studies.get(f"figure{shown.number}")
        spoken = {id for e in site.evidence if study and e.study == study.name for id in e.about}
        found.append(FigureCard(shown, study, [c for c in claims if c.id in spoken]))
    return found


def undecided(site: Site) -> list[dict[str, Any]]:
    """Entries that are open or cannot be decided, as a whole or in a layer, and what is lacking."""
    rows = []
    for name, found in site.states.items():
        words = found.layers or {"": f"{found.name} ({found.detail})" if found.detail else found.name}
        why = [
            f"{layer}: {_lacking(word)}" if layer else _lacking(word)
            for layer, word in words.items()
            if word.startswith((OPEN, UNDECIDABLE))
        ]
        if why:
            rows.append({"id": name, "state": found.name, "css": CSS[found.name], "why": "; ".join(why)})
    return rows


def _lacking(word: str) -> str:
    name, _, detail = word.partition(" (")
    return detail.removesuffix(")") or ("no study speaks of it" if name == OPEN else name)
