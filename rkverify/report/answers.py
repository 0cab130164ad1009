"""The verdict on an entry in one sentence, and the statements that say why: for a reader who has a minute."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from rkverify.ledger.states import DEFINITION, FAILS, HOLDS, OPEN, READING, UNDECIDABLE
from rkverify.report.cards import Card, Group
from rkverify.report.content import Site
from rkverify.report.formulas import data, notes
from rkverify.report.front import shortened

NAMED = 4
"""So many readings are named in a sentence; of more, the number."""
NOTHING = Group("", OPEN, "", "", "", [], [])
SAME = ("says", "word", "reading")
"""What two statements have in common that are told as one."""


@dataclass(frozen=True)
class Reason:
    """A statement that says why, and the layers in which it does."""

    layers: list[str]
    statement: dict[str, Any]


def listed(words: Sequence[str]) -> str:
    """The words as a list in a sentence.

    >>> listed(["a", "b", "c"])
    'a, b and c'
    """
    return f"{', '.join(words[:-1])} and {words[-1]}" if len(words) > 1 else "".join(words)


def statements(card: Card) -> list[dict[str, Any]]:
    """Every statement on the entry, layer by layer."""
    return [s for group in card.groups for s in _of(group)]


def in_short(card: Card) -> str:
    """The verdict in one sentence, with the readings that save it."""
    if card.state == DEFINITION:
        routes = card.detail.partition(": ")[2].split("; ")
        return f"A definition, confirmed by independent routes: {listed(routes)}."
    where = {raw["word"]: raw["short"] for raw in data("words.toml")["layer"]}
    found: dict[tuple[str, str], list[Group]] = {}
    for group in card.groups:
        if group.word:
            detail = group.detail or card.detail if group.word == READING else ""
            found.setdefault((group.word, detail), []).append(group)
    if not found:  # an entry that is decided as a whole, by statements in a layer
        whole = replace(card.groups[0], layer="", word=card.state) if card.groups else NOTHING
        found[(card.state, card.detail)] = [whole]
    parts = []
    for (word, detail), groups in found.items():
        place = listed([where[group.layer] for group in groups if group.layer])
        parts.append(_part(word, f" {place}" if place else "", detail, groups[0]))
    sentence = "; ".join(parts)
    return f"{sentence[0].upper()}{sentence[1:]}."


def _part(word: str, place: str, detail: str, group: Group) -> str:
    if word == HOLDS:
        return f"it holds{place}"
    if word == READING:
        good = detail.split("; ")
        tried = {s["reading"] for s in _of(group) if s["reading"]}
        named = listed([f"“{reading}”" for reading in good])
        if len(good) > NAMED:
            named = f"{len(good)} of {len(tried)} readings"
        return f"{place.lstrip()}{' ' if place else ''}it holds only under {named}"
    if word == FAILS:
        readings = {s["reading"] for s in _of(group) if s["reading"]}
        return f"it fails{place}{' under every reading' if len(readings) > 1 else ''}"
    return {UNDECIDABLE: f"it cannot be decided{place}", OPEN: f"it is open{place}"}[word]


def _of(group: Group) -> list[dict[str, Any]]:
    return [*group.first, *group.more]


def reasons(card: Card) -> list[Reason]:
    """Of every layer the strongest statement that decides it; where a reading saves it, one for and one against.

    The same sentence is told once, for all its layers.
    """
    found: list[Reason] = []
    in_layers = any(group.word for group in card.groups)
    for group in card.groups:
        word = group.word if in_layers else card.state
        if not word:
            continue
        told = _of(group)
        wanted = {READING: (FAILS, HOLDS), FAILS: (FAILS,), HOLDS: (HOLDS,)}.get(word, ())
        chosen = [s for word in wanted for s in [s for s in told if s["word"] == word][:1]] or told[:1]
        for s in chosen:
            shown = {**s, "says": shortened(s["says"]), "layer": ""}
            same = next((r for r in found if all(r.statement[key] == shown[key] for key in SAME)), None)
            if same is None:
                found.append(Reason([group.layer] if group.layer else [], shown))
            elif group.layer:
                same.layers.append(group.layer)
    return found


def shown(site: Site) -> set[str]:
    """The states that some entry has."""
    found = {state.name for state in site.states.values()}
    return found | {word.partition(" (")[0] for state in site.states.values() for word in state.layers.values()}


def choice(card: Card) -> str:
    """The choice on the page Readings that an equation leaves open; empty where it has none there."""
    return notes("choice").get(card.number, "") if card.formula else ""
