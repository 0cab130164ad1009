"""rkverify ledger"""

import json
import textwrap
from argparse import Namespace
from typing import Any

from rkverify.ledger.entries import Entry, entries, entry
from rkverify.ledger.entries import transcriptions as transcribed
from rkverify.ledger.grades import GRADES, best, grades, in_full, in_words
from rkverify.ledger.states import State, as_data, counts, state, states
from rkverify.ledger.states import read_evidence as evidence
from rkverify.paths import checkout


def ledger(options: Namespace) -> int:
    """Print all states, or one entry with its evidence."""
    place = checkout().quick() if options.quick else checkout()
    if options.entry:
        chosen = entry(options.entry)
        found = state(chosen, evidence(place.results))
        print(
            json.dumps(_data(chosen, found), indent=1, ensure_ascii=False) if options.json else _one(chosen.id, found)
        )
        return 0
    everything = states(place.results)
    if options.json:
        data = {
            "counts": counts(everything),
            "entries": [_data(e, everything[name]) for name, e in entries().items()],
        }
        print(json.dumps(data, indent=1, ensure_ascii=False))
        return 0
    for name, found in everything.items():
        detail = f"  [{found.detail}]" if found.detail else ""
        text = textwrap.shorten(entries()[name].statement + detail, 150)
        print(f"{name:4} {found.name:22} {best(found):25} {text}")
    print()
    for word, count in counts(everything).items():
        print(f"{count:4} {word}")
    print(f"{len(everything):4} entries")
    print("\nBest grade of evidence, in any layer:")
    for grade in GRADES:
        print(f"{sum(best(found) == grade for found in everything.values()):4} {grade}")
    return 0


def _data(chosen: Entry, found: State) -> dict[str, Any]:
    """An entry with its state and the grades of its evidence."""
    return as_data(chosen, found) | {"grade": best(found), "grades": [vars(g) for g in grades(found)]}


def _one(name: str, found: State) -> str:
    chosen = entries()[name]
    lines = [f"{name}  {found.name}  ({chosen.place})", *textwrap.wrap(chosen.statement, 100)]
    if found.detail:
        lines += ["", *textwrap.wrap(found.detail, 100)]
    for layer in found.layers or ("",):
        if words := in_words(g for g in grades(found) if g.layer == layer):
            lines += textwrap.wrap(f"Evidence{f', {layer}' if layer else ''}: {words}", 100)
    lines += ["", *textwrap.wrap(f"Decided by: {chosen.decided_by}", 100)]
    if name.startswith("E"):
        lines += [f"Transcribed in: {where}" for where in transcribed().get(int(name[1:]), [])]
    lines += [f"Test: {test}" for test in chosen.tests]
    for s in found.evidence:
        mark = {True: "holds", False: "fails", None: "not decidable"}[s.holds]
        where = ", ".join(filter(None, [s.layer, s.reading]))
        lines += ["", f"{mark}: study {s.study}, {s.name}" + (f" ({where})" if where else "")]
        lines += textwrap.wrap(s.says, 96, initial_indent="    ", subsequent_indent="    ")
        lines += textwrap.wrap(f"tried: {s.tried}; {in_full(s)}", 96, initial_indent="    ", subsequent_indent="    ")
        if s.margin is not None:
            lines.append(f"    margin: {s.margin:.4g} ({s.margin_means})")
    if not found.evidence:
        lines += ["", "No study has decided it yet."]
    return "\n".join(lines)
