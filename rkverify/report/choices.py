"""The page Readings: each choice that the paper leaves open, its options, and what studies found each of them to do."""

import csv
from dataclasses import dataclass, fields
from typing import Any

from rkverify.paths import Checkout
from rkverify.readings import Readings
from rkverify.report.content import Site
from rkverify.report.formulas import data
from rkverify.report.sections import Section, sections

EFFECTS = ("reading_options", "summary.csv")
"""The study and the table that have the largest effect of each option."""
SHOWN = ("at_rest", "in_motion", "tension", "compression")
"""The columns of that table that the page shows."""


@dataclass(frozen=True)
class Option:
    """An option: its name, what it means, and what it does in numbers, for the default itself too.

    What no study has taken apart is empty. `gauss:N` stands for every rule of its kind.
    """

    name: str
    meaning: str
    effects: list[tuple[str, list[str]]]


@dataclass(frozen=True)
class Choice:
    """A choice with its options, the default and its reason, and the part of the page that shows effects."""

    name: str
    options: list[Option]
    columns: list[dict[str, str]]
    default: str
    reason: str
    question: str
    shown: Section


def choices(place: Checkout, site: Site) -> list[Choice]:
    """The choices of readings.toml. Raises BadInput where it names what no study has."""
    plan = data("readings.toml")
    parts = sections(place, site, {"studies": [], "section": [_as_section(raw) for raw in plan["choice"]]})
    defaults = {field.name: str(field.default) for field in fields(Readings)}
    effects = _effects(place, site)
    return [
        Choice(
            raw["name"],
            [Option(name, means, _of(effects.get(raw["name"], []), name)) for name, means in raw["options"].items()],
            _columns(site) if raw["name"] in effects else [],
            defaults[raw["name"]] if raw["name"] in Readings.__dict__ else raw.get("default", ""),
            raw["reason"],
            raw["question"],
            part,
        )
        for raw, part in zip(plan["choice"], parts, strict=True)
    ]


def _columns(site: Site) -> list[dict[str, str]]:
    study, file = EFFECTS
    described = next(table["columns"] for table in site.studies[study].tables if table["file"] == file)
    found = {column["name"]: column for column in described}
    return [found[name] for name in SHOWN]


def _effects(place: Checkout, site: Site) -> dict[str, list[tuple[str, list[str]]]]:
    """Choice -> (option, its numbers), none where the study has no results."""
    study, file = EFFECTS
    found: dict[str, list[tuple[str, list[str]]]] = {}
    if study in site.studies:
        with (place.results / study / file).open(encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream):
                numbers = [f"{float(row[name]):.3g}" if row[name] else "" for name in SHOWN]
                found.setdefault(row["choice"], []).append((row["option"], numbers))
    return found


def _of(effects: list[tuple[str, list[str]]], name: str) -> list[tuple[str, list[str]]]:
    kind = name.removesuffix("N")
    return [
        (option, numbers) for option, numbers in effects if option == name or (kind != name and option.startswith(kind))
    ]


def _as_section(raw: dict[str, Any]) -> dict[str, Any]:
    return {"figures": [], "statements": [], "tables": [], "command": "", **raw, "text": raw["question"]}
