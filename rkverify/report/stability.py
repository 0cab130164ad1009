"""The page "Stability": claims by layer, then figures and statements of several studies in an order that explains."""

import csv
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

from rkverify.errors import BadInput
from rkverify.ledger.entries import entries
from rkverify.ledger.states import STATES, Evidence, State
from rkverify.paths import Checkout, checkout
from rkverify.report.content import Site, StudyPage, state_css, statement

LONG = re.compile(r"-?\d*\.\d{5,11}(e-?\d+)?")
"""A float as the tables write it; certified numbers have more digits and are shown as they are."""

LAYERS = ("printed", "as-defined", "consistent", "simulated")


@dataclass(frozen=True)
class Section:
    """A part of the page: what it explains, what it shows, what was found, and the command that computes it anew."""

    title: str
    text: str
    figures: list[dict[str, str]]
    statements: list[dict[str, Any]]
    tables: list[dict[str, Any]]
    command: str


def plan() -> dict[str, Any]:
    """What the page shows in which order."""
    return tomllib.loads(files("rkverify.report").joinpath("stability.toml").read_text(encoding="utf-8"))


def sections(place: Checkout, site: Site) -> list[Section]:
    """The parts of the page, as the plan has them; a quick run shows what its smaller parameters left of them.

    Raises BadInput where the plan names a study's figure, table or statement that the study does not have.
    """
    pages = {study.name: study for study in site.studies}
    quick = place.state == checkout().quick().state

    def each(names: list[str], find: Callable[[str], dict[str, Any]]) -> list[dict[str, Any]]:
        found = []
        for name in names:
            try:
                found.append(find(name))
            except BadInput:
                if not quick:
                    raise
        return found

    found = []
    for part in plan()["section"]:
        found.append(
            Section(
                part["title"],
                part["text"],
                each(part["figures"], lambda name: _figure(pages, name)),
                each(part["statements"], lambda name: _statement(site.evidence, name)),
                each(part.get("tables", []), lambda name: _table(place, pages, name)),
                part["command"],
            )
        )
    return found


def _missing(name: str) -> BadInput:
    return BadInput(
        f"the page Stability shows {name}, which no study has: run the studies, or take it out of stability.toml"
    )


def _figure(pages: dict[str, StudyPage], name: str) -> dict[str, str]:
    study, _, file = name.partition("/")
    for figure in pages[study].figures if study in pages else ():
        if figure["src"].endswith("/" + file):
            return {**figure, "study": study}
    raise _missing(f"the figure {name}")


def _statement(evidence: list[Evidence], name: str) -> dict[str, Any]:
    study, _, key = name.partition("/")
    for e in evidence:
        if (e.study, e.name) == (study, key):
            return {**statement(e), "study": study}
    raise _missing(f"the statement {name}")


def _table(place: Checkout, pages: dict[str, StudyPage], name: str) -> dict[str, Any]:
    study, _, file = name.partition("/")
    for table in pages[study].tables if study in pages else ():
        if table["file"] == file:
            with (place.results / study / file).open(encoding="utf-8", newline="") as stream:
                header, *rows = csv.reader(stream)
            return {**table, "header": header, "rows": [[_short(cell) for cell in row] for row in rows], "study": study}
    raise _missing(f"the table {name}")


def _short(cell: str) -> str:
    """A number with more digits than a page needs, to four; zeros in `turns` and exact fractions stay."""
    return f"{float(cell):.4g}" if LONG.fullmatch(cell) else cell


def claims_by_layer(states: dict[str, State]) -> list[dict[str, Any]]:
    """Claims with a verdict in more than one layer: the state in each, and the readings that save it."""
    rows = []
    for name, entry in entries().items():
        if len(entry.layers) > 1:
            words = states[name].layers
            cells = []
            for layer in LAYERS:
                word, _, detail = words.get(layer, "").partition(" (")
                cells.append({"word": word, "detail": detail.removesuffix(")"), "css": state_css(word)})
            # An equation's formula stands on its study's page; here its place says enough.
            said = entry.place if name.startswith("E") else entry.statement
            rows.append({"id": name, "statement": said, "cells": cells})
    return rows


def counts_by_layer(rows: list[dict[str, Any]]) -> tuple[list[str], list[dict[str, Any]]]:
    """The states that occur, and how many entries are in each, layer by layer."""
    words = [word for word in STATES if any(cell["word"] == word for row in rows for cell in row["cells"])]
    found = []
    for place, layer in enumerate(LAYERS):
        told = [row["cells"][place]["word"] for row in rows]
        found.append({"layer": layer, "numbers": [told.count(word) for word in words]})
    return words, found
