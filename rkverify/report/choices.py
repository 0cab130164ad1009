"""The page Readings: each choice that the paper leaves open, its options, and what studies found each of them to do."""

from dataclasses import dataclass, fields
from typing import Any

from rkverify.paths import Checkout
from rkverify.readings import Readings
from rkverify.report.content import Site
from rkverify.report.formulas import data
from rkverify.report.sections import Section, sections


@dataclass(frozen=True)
class Choice:
    """A choice with its options (name, meaning), the default and its reason, and the part of the page that shows effects."""

    name: str
    options: list[tuple[str, str]]
    default: str
    reason: str
    question: str
    shown: Section


def choices(place: Checkout, site: Site) -> list[Choice]:
    """The choices of readings.toml. Raises BadInput where it names what no study has."""
    plan = data("readings.toml")
    parts = sections(place, site, {"studies": [], "section": [_as_section(raw) for raw in plan["choice"]]})
    defaults = {field.name: str(field.default) for field in fields(Readings)}
    return [
        Choice(
            raw["name"],
            list(raw["options"].items()),
            defaults[raw["name"]] if raw["name"] in Readings.__dict__ else raw.get("default", ""),
            raw["reason"],
            raw["question"],
            part,
        )
        for raw, part in zip(plan["choice"], parts, strict=True)
    ]


def _as_section(raw: dict[str, Any]) -> dict[str, Any]:
    return {"figures": [], "statements": [], "tables": [], "command": "", **raw, "text": raw["question"]}
