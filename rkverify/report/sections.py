"""Pages on a subject: the studies that belong to each, and their figures and statements in an order that explains."""

import csv
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from importlib.resources import files
from typing import Any

from rkverify.errors import BadInput
from rkverify.ledger.states import STATES
from rkverify.paths import Checkout, checkout
from rkverify.report.cards import Card
from rkverify.report.content import Site, StudyPage, statement
from rkverify.report.formulas import data
from rkverify.workflow.study import LAYERS

LONG = re.compile(r"-?\d*\.\d{5,11}(e-?\d+)?")
"""A float as the tables write it; certified numbers have more digits and are shown as they are."""
AT_ONCE = 4
"""So many statements of a study are shown at once; more are folded away."""


@dataclass(frozen=True)
class Section:
    """A part of a page: what it explains, what it shows, what was found, and the command that computes it anew."""

    title: str
    text: str
    figures: list[dict[str, str]]
    statements: list[dict[str, Any]]
    tables: list[dict[str, Any]]
    command: str
    more: list[dict[str, Any]] = field(default_factory=list)
    study: str = ""


def plans() -> dict[str, dict[str, Any]]:
    """Page -> its title, its lead, its studies (names or patterns), its sections, in the order of the menu."""
    folder = files("rkverify.report").joinpath("pages")
    names = [entry.name for entry in folder.iterdir() if entry.name.endswith(".toml")]
    found = {name.removesuffix(".toml"): data(f"pages/{name}") for name in names}
    return dict(sorted(found.items(), key=lambda item: int(item[1]["place"])))


def pages_of(study: str, given: dict[str, dict[str, Any]]) -> list[str]:
    """The pages that a study belongs to: one, if the plans are right."""
    return [page for page, plan in given.items() if any(fnmatchcase(study, pattern) for pattern in plan["studies"])]


def is_quick(place: Checkout) -> bool:
    """Whether the results are those of a quick run."""
    return place.state == checkout().quick().state


def sections(place: Checkout, site: Site, plan: dict[str, Any]) -> list[Section]:
    """The parts of a page as its plan has them, then a part for each of its studies that the plan's parts do not show.

    A quick run shows what its smaller parameters left of the plan. Raises BadInput where the plan names a study's
    figure, table or statement that the study does not have.
    """
    quick = is_quick(place)

    def each(names: list[str], find: Callable[[str], list[dict[str, Any]]]) -> list[dict[str, Any]]:
        found = []
        for name in names:
            if name.partition("/")[0] in site.missing:
                continue
            try:
                found += find(name)
            except BadInput:
                if not quick:
                    raise
        return found

    found, shown = [], set()
    for part in plan.get("section", []):
        names = [*part.get("figures", []), *part.get("statements", []), *part.get("tables", [])]
        shown |= {name.partition("/")[0] for name in names}
        found.append(
            Section(
                part["title"],
                part["text"],
                each(part.get("figures", []), lambda name: _figure(site, name)),
                each(part.get("statements", []), lambda name: statements(site, name)),
                each(part.get("tables", []), lambda name: _table(place, site, name)),
                part["command"],
            )
        )
    rest = [s for s in site.studies.values() if s.name not in shown and pages_of(s.name, {"": plan})]
    return [*found, *(of_study(study) for study in rest)]


def of_study(study: StudyPage) -> Section:
    """A part that shows one study whole."""
    told = sorted(study.statements, key=lambda s: bool(s["word"] == STATES[0]))
    command = f"rkverify run {study.name}"
    return Section(
        study.title, study.purpose, study.figures, told[:AT_ONCE], [], command, told[AT_ONCE:], study=study.name
    )


def _missing(name: str) -> BadInput:
    return BadInput(
        f"a page shows {name}, which no study has: run the studies, or take it out of rkverify/report/pages"
    )


def _figure(site: Site, name: str) -> list[dict[str, str]]:
    study, _, file = name.partition("/")
    for figure in site.studies[study].figures if study in site.studies else ():
        if figure["src"].endswith("/" + file):
            return [figure]
    raise _missing(f"the figure {name}")


def statements(site: Site, pattern: str) -> list[dict[str, Any]]:
    """The statements study/name that match a pattern.

    Raises BadInput where none does.
    """
    found = [statement(e) for e in site.evidence if fnmatchcase(f"{e.study}/{e.name}", pattern)]
    if not found:
        raise _missing(f"the statement {pattern}")
    return found


def _table(place: Checkout, site: Site, name: str) -> list[dict[str, Any]]:
    study, _, file = name.partition("/")
    for table in site.studies[study].tables if study in site.studies else ():
        if table["file"] == file:
            with (place.results / study / file).open(encoding="utf-8", newline="") as stream:
                header, *rows = csv.reader(stream)
            return [{**table, "header": header, "rows": [[_short(cell) for cell in row] for row in rows]}]
    raise _missing(f"the table {name}")


def _short(cell: str) -> str:
    """A number with more digits than a page needs, to four; zeros in `turns` and exact fractions stay."""
    return f"{float(cell):.4g}" if LONG.fullmatch(cell) else cell


def by_layer(cards: list[Card]) -> list[Card]:
    """The entries with a verdict in more than one layer."""
    return [card for card in cards if len(card.layers) > 1]


def counts_by_layer(cards: list[Card]) -> tuple[list[str], list[dict[str, Any]]]:
    """The states that occur, and how many entries are in each, layer by layer."""
    told = {layer: [card.layers[layer].word for card in cards if layer in card.layers] for layer in LAYERS}
    words = [word for word in STATES if any(word in each for each in told.values())]
    return words, [{"layer": layer, "numbers": [each.count(word) for word in words]} for layer, each in told.items()]
