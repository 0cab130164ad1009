"""From statements to states, by one written rule for all entries.

A definition is confirmed by its routes, or fails where one of them disagrees. Any other entry is decided layer by
layer; in a layer it holds where every statement holds, holds under a reading where all statements of that reading
do and those of another do not, fails where no reading saves it, and is open without a statement. Where every reading
that was tried holds, the readings are named. As a whole it is
open while a layer is; where layers differ, the state says so.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rkverify.errors import BadInput
from rkverify.ledger.entries import Entry, entries

OPEN, HOLDS, READING, FAILS = "open", "holds", "holds under a reading", "fails"
DEFINITION, UNDECIDABLE, MIXED = "definition", "not decidable", "differs between layers"
STATES = (HOLDS, READING, FAILS, MIXED, DEFINITION, UNDECIDABLE, OPEN)


@dataclass(frozen=True)
class Evidence:
    """One statement of a study, as its file holds it."""

    study: str
    name: str
    about: tuple[str, ...]
    says: str
    holds: bool | None
    tried: str
    evidence: str
    margin: float | None
    margin_means: str
    layer: str
    reading: str
    routes: tuple[str, ...]


@dataclass(frozen=True)
class State:
    """What the evidence makes of an entry: in one word, in one layer after the other, and with names."""

    name: str
    layers: Mapping[str, str]
    detail: str
    evidence: tuple[Evidence, ...]


def read_evidence(results: Path) -> list[Evidence]:
    """All statements under a results folder.

    Raises BadInput for a file that cannot be read as statements.
    """
    found = []
    for path in sorted(results.glob("*/statements.json")):
        try:
            for raw in json.loads(path.read_text(encoding="utf-8")):
                if not (raw["holds"] is None or isinstance(raw["holds"], bool)):
                    raise ValueError("holds is true, false or null")
                found.append(
                    Evidence(
                        study=path.parent.name, **{**raw, "about": tuple(raw["about"]), "routes": tuple(raw["routes"])}
                    )
                )
        except (ValueError, TypeError, KeyError, OSError):
            raise BadInput(f"{path} is no list of statements: run `make reproduce` to write it anew") from None
    return found


def verdict(evidence: Iterable[Evidence]) -> tuple[str, str]:
    """The state that statements of one layer give, and its detail."""
    statements = list(evidence)
    if not statements:
        return OPEN, ""
    if any(s.holds is False for s in statements if not s.reading):
        return FAILS, ""
    if any(s.holds is None for s in statements):
        return UNDECIDABLE, "; ".join(s.says for s in statements if s.holds is None)
    readings = sorted({s.reading for s in statements if s.reading})
    good = [r for r in readings if all(s.holds for s in statements if s.reading == r)]
    if len(good) == len(readings):
        return HOLDS, "; ".join(readings)
    if good:
        return READING, "; ".join(good)
    return FAILS, "under every reading: " + "; ".join(readings)


def state(entry: Entry, evidence: Iterable[Evidence]) -> State:
    """The state of an entry."""
    about = tuple(s for s in evidence if entry.id in s.about)
    if entry.kind == "definition":
        routes = sorted({route for s in about for route in s.routes})
        name, detail = verdict(about)
        if name == HOLDS and not routes:
            return State(OPEN, {}, "no independent route is named", about)
        if name == HOLDS:
            return State(DEFINITION, {}, f"confirmed by {len(routes)}: {'; '.join(routes)}", about)
        return State(name, {}, detail, about)
    if not entry.layers:
        name, detail = verdict(about)
        return State(name, {}, detail, about)
    each = {layer: verdict(s for s in about if s.layer == layer) for layer in entry.layers}
    names = {name for name, _ in each.values()}
    words = {layer: f"{name} ({detail})" if detail else name for layer, (name, detail) in each.items()}
    summary = (
        "; ".join(f"{layer}: {text}" for layer, text in words.items())
        if len(entry.layers) > 1
        else each[entry.layers[0]][1]
    )
    if OPEN in names:
        name = OPEN
    else:
        name = names.pop() if len(names) == 1 else MIXED
    return State(name, words, summary, about)


def states(results: Path) -> dict[str, State]:
    """The state of every entry, from the statements under a results folder."""
    evidence = read_evidence(results)
    return {name: state(e, evidence) for name, e in entries().items()}


def counts(found: Mapping[str, State]) -> dict[str, int]:
    """How many entries are in each state, in the order of `STATES`."""
    return {name: sum(s.name == name for s in found.values()) for name in STATES}


def both_ways(results: Path) -> list[str]:
    """Complaints where entries and studies do not name each other."""
    known = entries()
    named: dict[str, set[str]] = {name: set() for name in known}
    complaints = []
    for s in read_evidence(results):
        for name in s.about:
            if name not in known:
                complaints.append(f"study {s.study} makes a statement on {name}, which the ledger does not have")
            else:
                named[name].add(s.study)
    for name, e in known.items():
        for study in sorted(named[name] - set(e.studies)):
            complaints.append(f"{name} is decided by study {study} and does not list it: add it to the entry")
        for study in sorted(set(e.studies) - named[name]):
            complaints.append(f"{name} lists study {study}, which says nothing about it: remove it from the entry")
    return complaints


def as_data(entry: Entry, found: State) -> dict[str, Any]:
    """An entry and its state as plain data."""
    return {
        "id": entry.id,
        "place": entry.place,
        "statement": entry.statement,
        "kind": entry.kind,
        "decided_by": entry.decided_by,
        "state": found.name,
        "detail": found.detail,
        "layers": dict(found.layers),
        "evidence": [vars(e) for e in found.evidence],
        "tests": list(entry.tests),
    }
