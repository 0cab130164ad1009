"""What the pages show, gathered from results, ledger and run records; no number is written here."""

import json
import os
from dataclasses import dataclass, field
from typing import Any

from rkverify.errors import BadInput
from rkverify.ledger.entries import Entry, entries
from rkverify.ledger.grades import in_full
from rkverify.ledger.states import FAILS, HOLDS, STATES, Evidence, State, counts, read_evidence, state
from rkverify.paths import Checkout
from rkverify.report.formulas import formulas
from rkverify.report.links import Link, module_link, relative, slug
from rkverify.workflow import manifest, records
from rkverify.workflow.discovery import study_names
from rkverify.workflow.produce import DESCRIPTION, STATEMENTS

CSS = dict(zip(STATES, ("holds", "reading", "fails", "mixed", "definition", "undecidable", "open"), strict=True))
PARTS = {"E": "equations", "F": "figures", "C": "claims"}
"""The first letter of an entry and the page that shows it."""
SHOWN = (
    "studies.",
    "rkverify.paper.",
    "rkverify.solid.",
    "rkverify.certify.",
    "rkverify.stability.",
    "rkverify.check.",
)


def state_css(word: str) -> str:
    """The style of a state, none for an entry that needs no verdict there."""
    return CSS.get(word, "")


def entry_href(id: str) -> str:
    """Where an entry is shown."""
    return f"{PARTS[id[0]]}.html#{id}"


def last_numbers() -> dict[str, int]:
    """Page of entries -> the number of its last entry."""
    return {page: sum(id.startswith(letter) for id in entries()) for letter, page in PARTS.items()}


@dataclass(frozen=True)
class StudyPage:
    """What a study's page shows."""

    name: str
    title: str
    short: str
    purpose: str
    figures: list[dict[str, str]]
    tables: list[dict[str, Any]]
    documents: list[Link]
    statements: list[dict[str, Any]]
    parameters: list[tuple[str, str]]
    formulas: list[dict[str, Any]]
    code: list[Link]
    seconds: float | None
    foot: str


def _comparison(record: dict[str, Any]) -> str:
    details = ", ".join(
        f"{key} {value:.3g}" if isinstance(value, float) else f"{key} {value}"
        for key, value in record.items()
        if key not in ("kind", "why")
    )
    return f"{record['kind']}{f' ({details})' if details else ''}{': ' + record['why'] if 'why' in record else ''}"


def statement(evidence: Evidence) -> dict[str, Any]:
    """A statement as a page shows it."""
    word = {True: HOLDS, False: FAILS, None: "not decidable"}[evidence.holds]
    proof = "proof" if evidence.evidence == "proved" else "evidence"
    return {
        "study": evidence.study,
        "id": slug(evidence.name),
        "href": f"{evidence.study}.html#{slug(evidence.name)}",
        "about": [Link(entry_href(id), id) for id in evidence.about],
        "word": word,
        "css": CSS[word],
        "label": "counterexample" if evidence.holds is False else proof,
        "layer": evidence.layer,
        "reading": evidence.reading,
        "where": ", ".join(filter(None, [evidence.layer, evidence.reading])),
        "says": evidence.says,
        "tried": evidence.tried,
        "evidence": in_full(evidence),
        "margin": "" if evidence.margin is None else f"{evidence.margin + 0.0:.4g}",
        "margin_means": evidence.margin_means,
    }


def study_page(place: Checkout, name: str, evidence: list[Evidence]) -> StudyPage:
    """The page of one study, from its committed files."""
    data = manifest.description(place, name)
    results = os.path.relpath(place.results / name, place.pages).replace(os.sep, "/")
    own = [e for e in evidence if e.study == name]
    about = {id for e in own for id in e.about}
    numbers = sorted(int(id[1:]) for id in about if id.startswith("E"))
    source = (place.studies / f"{name}.py").read_text(encoding="utf-8")
    described = {*data["tables"], *data["figures"], STATEMENTS, DESCRIPTION}
    run = records.last_run(place, name)
    return StudyPage(
        name=name,
        title=data["title"],
        short=data["title"].partition(":")[0],
        purpose=source.split('"""')[1].strip(),
        figures=[{"src": f"{results}/{file}", "study": name, **words} for file, words in data["figures"].items()],
        tables=[
            {
                "study": name,
                "file": file,
                "href": f"{results}/{file}",
                "comparison": _comparison(data["comparison"][file]),
                **words,
            }
            for file, words in data["tables"].items()
        ],
        documents=[Link(f"{results}/{file}", file) for file in data["comparison"] if file not in described],
        statements=[statement(e) for e in own],
        parameters=[
            (key, json.dumps(value, ensure_ascii=False)) for key, value in data["provenance"]["parameters"].items()
        ],
        formulas=[{"number": n, "href": f"equations.html#E{n}", "mathml": formulas()[n]} for n in numbers],
        code=[
            Link(relative(place, "studies", f"{name}.py"), f"studies/{name}.py"),
            *(
                module_link(place, m)
                for m in data["provenance"]["modules"]
                if m.startswith(SHOWN) and m != f"studies.{name}"
            ),
        ],
        seconds=None if run is None else run.seconds,
        foot=foot(place, name),
    )


def foot(place: Checkout, name: str) -> str:
    """Commit, versions, processor, command and time of the run that made a study's results here."""
    run = records.last_run(place, name)
    if run is None:
        return "These results are the committed ones; they have not been recomputed on this machine."
    return f"Computed by {_how(run.circumstances)}; it took {run.seconds:.1f} s and finished {run.finished}."


def _how(circumstances: dict[str, Any]) -> str:
    how = {key: circumstances.get(key, "unknown") for key in ("command", "commit", "python", "processor", "cores")}
    versions = ", ".join(f"{package} {number}" for package, number in circumstances.get("packages", {}).items())
    return (
        f"{how['command']} at commit {how['commit']}; Python {how['python']}, {versions}; "
        f"{how['processor']}, {how['cores']} cores"
    )


def build_foot(place: Checkout, now: str) -> str:
    """Commit, versions, processor, command and time of the build of the pages."""
    return f"Page built {now} by {_how(records.circumstances(place.root))}."


@dataclass(frozen=True)
class Site:
    """Everything that the pages show. missing: studies without results, of which the pages show nothing."""

    studies: dict[str, StudyPage]
    states: dict[str, State]
    evidence: list[Evidence] = field(repr=False)
    missing: list[str]

    def entries(self, letter: str) -> list[tuple[Entry, State]]:
        """The entries of one kind, in the paper's order, each with its state."""
        return [(e, self.states[name]) for name, e in entries().items() if name.startswith(letter)]


def gather(place: Checkout) -> Site:
    """Read results, statements and records.

    Raises BadInput where no study has results, or those of one cannot be read.
    """
    names = study_names(place)
    missing = [name for name in names if not (place.results / name).is_dir()]
    if len(missing) == len(names):
        raise BadInput(f"no study has results under {place.shown(place.results)}: run `make reproduce`")
    evidence = [e for e in read_evidence(place.results) if e.study in names]
    studies = {name: study_page(place, name, evidence) for name in names if name not in missing}
    found = {name: state(e, evidence) for name, e in entries().items()}
    return Site(studies, found, evidence, missing)


def count_rows(site: Site) -> list[dict[str, Any]]:
    """How many entries of each kind are in each state."""
    rows = []
    for word in STATES:
        row: dict[str, Any] = {"state": word, "css": CSS[word], "all": counts(site.states)[word]}
        for letter in PARTS:
            row[letter] = sum(s.name == word for name, s in site.states.items() if name.startswith(letter))
        rows.append(row)
    return rows
