"""What the pages show, gathered from results, ledger and run records; no number is written here."""

import json
import os
import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any

from latex2mathml.converter import convert
from markupsafe import Markup

from rkverify.ledger.entries import entries, transcriptions
from rkverify.ledger.states import FAILS, HOLDS, MIXED, READING, STATES, Evidence, State, counts, read_evidence, state
from rkverify.paths import Checkout
from rkverify.workflow import manifest, records
from rkverify.workflow.discovery import study_names

CSS = dict(zip(STATES, ("holds", "reading", "fails", "mixed", "definition", "undecidable", "open"), strict=True))
PARTS = {"E": "Equations", "F": "Figures", "C": "Claims"}


def state_css(word: str) -> str:
    """The style of a state, none for an entry that needs no verdict there."""
    return CSS.get(word, "")


@cache
def formulas() -> dict[int, Markup]:
    """Equation number -> MathML."""
    raw = tomllib.loads(files("rkverify.report").joinpath("formulas.toml").read_text(encoding="utf-8"))
    return {int(number): Markup(convert(latex, display="block")) for number, latex in raw.items()}


@dataclass(frozen=True)
class StudyPage:
    """What a study's page shows."""

    name: str
    title: str
    short: str
    purpose: str
    figures: list[dict[str, str]]
    tables: list[dict[str, Any]]
    statements: list[dict[str, Any]]
    parameters: list[tuple[str, str]]
    formulas: list[dict[str, Any]]
    code: list[dict[str, str]]
    foot: str


def relative(place: Checkout, *parts: str) -> str:
    """A link from a page to a place in the checkout."""
    return os.path.relpath(place.root.joinpath(*parts), place.pages).replace(os.sep, "/")


def module_link(place: Checkout, path: str) -> dict[str, str]:
    """A link to the source of a module, or of the module that a function or method stands in."""
    while True:
        place_of_it = place.root.joinpath(*path.split("."))
        for file in (place_of_it.with_suffix(".py"), place_of_it / "__init__.py"):
            if file.is_file():
                shown = file.relative_to(place.root).as_posix()
                return {"name": shown, "href": relative(place, shown)}
        path = path.rpartition(".")[0]


def _comparison(record: dict[str, Any]) -> str:
    details = ", ".join(f"{key} {value}" for key, value in record.items() if key not in ("kind", "why"))
    return f"{record['kind']}{f' ({details})' if details else ''}{': ' + record['why'] if 'why' in record else ''}"


def statement(evidence: Evidence) -> dict[str, Any]:
    """A statement as a page shows it."""
    word = {True: HOLDS, False: FAILS, None: "not decidable"}[evidence.holds]
    return {
        "name": evidence.name,
        "about": evidence.about,
        "word": word,
        "css": CSS[word],
        "where": ", ".join(filter(None, [evidence.layer, evidence.reading])),
        "says": evidence.says,
        "tried": evidence.tried,
        "evidence": evidence.evidence,
        "routes": evidence.routes,
        "margin": "" if evidence.margin is None else f"{evidence.margin:.4g}",
        "margin_means": evidence.margin_means,
    }


def study_page(place: Checkout, name: str, evidence: list[Evidence]) -> StudyPage:
    """The page of one study, from its committed files."""
    data = manifest.description(place, name)
    results = os.path.relpath(place.results / name, place.pages).replace(os.sep, "/")
    own = [e for e in evidence if e.study == name]
    modules = data["provenance"]["modules"]
    numbers = sorted({int(id[1:]) for e in own for id in e.about if id.startswith("E")} & formulas().keys())
    if name.startswith("figure"):
        numbers = sorted(set(numbers) | FIGURE_FORMULAS.get(name, set()))
    source = (place.studies / f"{name}.py").read_text(encoding="utf-8")
    return StudyPage(
        name=name,
        title=data["title"],
        short=data["title"].partition(":")[0],
        purpose=source.split('"""')[1].strip(),
        figures=[{"src": f"{results}/{file}", **words} for file, words in data["figures"].items()],
        tables=[
            {"file": file, "href": f"{results}/{file}", "comparison": _comparison(data["comparison"][file]), **words}
            for file, words in data["tables"].items()
        ],
        statements=[statement(e) for e in own],
        parameters=[
            (key, json.dumps(value, ensure_ascii=False)) for key, value in data["provenance"]["parameters"].items()
        ],
        formulas=[{"number": n, "mathml": formulas()[n]} for n in numbers],
        code=[
            module_link(place, m)
            for m in modules
            if m.startswith(("studies.", "rkverify.paper.", "rkverify.certify.", "rkverify.stability."))
        ],
        foot=foot(place, name),
    )


FIGURE_FORMULAS = {
    "figure4": {61, 63},
    "figure5": {76, 79},
    "figure6": {76, 79},
    "figure7": {80, 82, 85},
    "figure8": {80, 82, 85},
}


def foot(place: Checkout, name: str) -> str:
    """Commit, versions, processor, command and time of the run that made a study's results here."""
    run = records.last_run(place, name)
    if run is None:
        return "These results are the committed ones; they have not been recomputed on this machine."
    how = {key: run.circumstances.get(key, "unknown") for key in ("command", "commit", "python", "processor", "cores")}
    versions = ", ".join(f"{package} {number}" for package, number in run.circumstances.get("packages", {}).items())
    return (
        f"Computed by {how['command']} at commit {how['commit']} in {run.seconds:.1f} s, finished {run.finished}; "
        f"Python {how['python']}, {versions}; {how['processor']}, {how['cores']} cores."
    )


@dataclass(frozen=True)
class Site:
    """Everything that the pages show."""

    studies: list[StudyPage]
    states: dict[str, State]
    evidence: list[Evidence] = field(repr=False)


def gather(place: Checkout) -> Site:
    """Read results, statements and records."""
    evidence = read_evidence(place.results)
    studies = [study_page(place, name, evidence) for name in study_names(place)]
    found = {name: state(e, evidence) for name, e in entries().items()}
    return Site(studies, found, evidence)


def count_rows(site: Site) -> list[dict[str, Any]]:
    """How many entries of each kind are in each state."""
    rows = []
    for word in STATES:
        row: dict[str, Any] = {"state": word, "css": CSS[word], "all": counts(site.states)[word]}
        for letter in PARTS:
            row[letter] = sum(s.name == word for name, s in site.states.items() if name.startswith(letter))
        rows.append(row)
    return rows


def findings(site: Site) -> list[dict[str, Any]]:
    """The entries that fail, differ between layers or hold under a reading only, the plainest first."""
    order = (FAILS, MIXED, READING)
    found = []
    for name, e in entries().items():
        s = site.states[name]
        if s.name in order:
            found.append(
                {"id": name, "state": s.name, "css": CSS[s.name], "statement": e.statement, "detail": s.detail}
            )
    return sorted(found, key=lambda f: order.index(f["state"]))


def ledger_parts(place: Checkout, site: Site) -> list[dict[str, Any]]:
    """The ledger's rows by equations, figures and claims."""
    parts = []
    for letter, title in PARTS.items():
        rows = []
        for name, e in entries().items():
            if name.startswith(letter):
                s = site.states[name]
                where = transcriptions().get(int(name[1:]), []) if letter == "E" else []
                code = [{"name": path.rpartition(".")[2], "href": module_link(place, path)["href"]} for path in where]
                rows.append(
                    {
                        "id": name, "state": s.name, "css": CSS[s.name], "statement": e.statement, "place": e.place,
                        "detail": s.detail, "evidence": s.evidence, "code": code,
                    }
                )  # fmt: skip
        parts.append({"title": title, "rows": rows})
    return parts
