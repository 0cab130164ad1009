"""What deliberate faults and random mutants say about the tests, from the tables that `make controls` and `make mutants` write."""

import csv
from dataclasses import dataclass
from pathlib import Path

from rkverify.paths import Checkout
from rkverify.report.links import relative

LEVEL = 0.95
"""Of the intervals of scores."""


@dataclass(frozen=True)
class Faults:
    """Deliberate faults of one part of the suite, and how many of them their checks catch."""

    part: str
    faults: int
    caught: int


@dataclass(frozen=True)
class Score:
    """Mutants of one package: how many were killed when first run and are killed now, with the interval of the first share."""

    package: str
    mutants: int
    first: int
    low: float
    high: float
    now: int
    explained: int


@dataclass(frozen=True)
class Trials:
    """Both tables, with the mutants that survive (place, before, after, reason) and links to the files."""

    faults: list[Faults]
    faults_file: str
    scores: list[Score]
    survivors: list[tuple[str, str, str, str]]
    mutants_file: str


def _rows(path: Path) -> list[dict[str, str]]:
    if not path.is_file():
        return []
    with path.open(encoding="utf-8", newline="") as handle:
        return list(csv.DictReader(handle))


def trials(place: Checkout) -> Trials:
    """What the tables below reports/controls hold; empty lists where they have not been written."""
    folder = place.root / "reports" / "controls"
    faults, mutants = (_rows(folder / f"{name}.csv") for name in ("controls", "mutants"))
    parts: dict[str, list[bool]] = {}
    for row in faults:
        parts.setdefault(row["file"].split("/")[1].removesuffix(".py"), []).append(row["caught"] == "yes")
    packages: dict[str, list[dict[str, str]]] = {"all": mutants} if mutants else {}
    for row in mutants:
        packages.setdefault(row["file"].split("/")[1], []).append(row)
    survivors = [
        (
            f"{row['file'].removeprefix('rkverify/')}:{row['line']}",
            row["old"].strip(),
            row["new"].strip(),
            row["reason"],
        )
        for row in mutants
        if row["outcome"] == "survived"
    ]
    return Trials(
        [Faults(part, len(found), sum(found)) for part, found in sorted(parts.items())],
        relative(place, "reports/controls/controls.csv"),
        [_score(package, rows) for package, rows in sorted(packages.items())],
        survivors,
        relative(place, "reports/controls/mutants.csv"),
    )


def _score(package: str, rows: list[dict[str, str]]) -> Score:
    from scipy.stats import binomtest

    first, now = (sum(row[when] != "survived" for row in rows) for when in ("first", "outcome"))
    bounds = binomtest(first, len(rows)).proportion_ci(LEVEL, method="exact")
    return Score(package, len(rows), first, bounds.low, bounds.high, now, sum(bool(row["reason"]) for row in rows))
