"""No result is typed into prose: every number that a computation gives is filled in by the build.

A number that somebody typed stays when the result changes, and then the report says something false.
"""

import ast
import json
import re
import shutil
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

from rkverify.paths import Checkout, checkout
from rkverify.report import content, site
from rkverify.report.formulas import data
from rkverify.workflow.discovery import study_names

ALLOWED = {
    "numbers of equations": r"\(\d+\)(?:[-–]\(\d+\))?",
    "numbers of figures and sections": r"(?:Figures?|Section) \d[\d.]*(?:(?: to| and) \d)?",
    "a symbol's index, argument or exponent": r"[A-Za-z]_\d+|C\(h/2\)|M\^-1|omega\^2|I-2|I_2",
    "the class of a kernel, an invariant, a dimension": r"\b[CJ]\d\b|\b\d-D\b",
    "ranges and cases that the paper states": r"1 < R < 2|C\^sigma \+ sigma [<>] 0|sigma > 0|\(?Q (?:not|=) 0\)?|V = 0|V = Q = 0",
    "the orders of the basis that the library has": r"order 0, 1, 2",
    "units, not results": r"h = rho = 1|the modulus is 1|Im ω &gt; 0",
    "what the scan prints": r"read: 0\.|from 1\.",
    "the time step of central differences, by definition": r"2/omega_max",
    "a program's status": r"status <code>1</code>",
}
"""Reason -> what may stand in prose although nobody computes it."""
FIELDS = ("title", "lead", "text", "subject", "question", "reason", "scan", "reading", "options")


def typed(prose: str) -> list[str]:
    """The numbers in prose that no reason allows."""
    for pattern in ALLOWED.values():
        prose = re.sub(pattern, " ", prose)
    return re.findall(r"\S*\d\S*", prose)


def template_prose(text: str) -> str:
    """A template without what Jinja fills in, without tags, and without scripts."""
    text = re.sub(r"\{#.*?#\}|\{%.*?%\}|\{\{.*?\}\}", " ", text, flags=re.DOTALL)
    text = re.sub(r"status <code>1</code>|Im ω &gt; 0", " ", text)
    return re.sub(r"<code.*?</code>|<option.*?</option>|<[^>]*>", " ", text, flags=re.DOTALL)


def strings(value: Any, key: str = "") -> Iterator[str]:
    """The texts of a TOML file that pages show as prose."""
    if isinstance(value, dict):
        for name, part in value.items():
            yield from strings(part, key if key in ("scan", "reading", "options") else name)
    elif isinstance(value, list):
        for part in value:
            yield from strings(part, key)
    elif isinstance(value, str) and key in FIELDS:
        yield value


OWN = files("rkverify.report")
TEMPLATES = sorted(path.name for path in OWN.joinpath("templates").iterdir() if path.name.endswith(".html.j2"))
TOMLS = ["front.toml", "readings.toml", "notes.toml"]
TOMLS += sorted(f"pages/{path.name}" for path in OWN.joinpath("pages").iterdir() if path.name.endswith(".toml"))


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_number_is_typed_into_a_template(name: str) -> None:
    assert typed(template_prose(OWN.joinpath("templates", name).read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize("name", TOMLS)
def test_no_number_is_typed_into_the_texts_of_a_page(name: str) -> None:
    assert [found for text in strings(data(name)) for found in typed(text)] == []


@pytest.mark.parametrize("name", study_names(checkout()))
def test_no_number_is_typed_into_the_purpose_of_a_study(name: str) -> None:
    source = (checkout().studies / f"{name}.py").read_text(encoding="utf-8")
    assert typed(ast.get_docstring(ast.parse(source)) or "") == []


def test_a_typed_number_is_found() -> None:
    """The twin: results look like these, and what the reasons allow does not hide them."""
    assert typed("(82) differs by 0.391 of the largest") == ["0.391"]
    assert typed("12 of 16 settings, as Figure 4 has it") == ["12", "16"]
    assert typed(template_prose("<p>{{ count }} entries, 57 hold</p>")) == ["57"]
    assert list(strings({"lead": "a 1", "place": "b 2", "options": {"full": "c 3"}})) == ["a 1", "c 3"]


@pytest.fixture
def spoilt(tmp_path: Path) -> tuple[Checkout, Checkout]:
    """Pages of the committed results, and of results in which one statement on C59 says the contrary."""
    place = checkout()
    names = [name for name in study_names(place) if (place.results / name).is_dir()]
    places = []
    for kind in ("plain", "spoilt"):
        results = tmp_path / kind / "results"
        for name in names:
            folder = results / name
            folder.mkdir(parents=True)
            for file in ("statements.json", "study.json"):
                shutil.copy(place.results / name / file, folder)
            for path in (place.results / name).iterdir():
                if not (folder / path.name).exists():
                    (folder / path.name).symlink_to(path)
        places.append(replace(place, results=results, pages=tmp_path / kind / "pages"))
    path = places[1].results / "printed_consequences" / "statements.json"
    said = json.loads(path.read_text(encoding="utf-8"))
    changed = next(s for s in said if s["name"] == "no_tensile_instability")
    assert changed["about"] == ["C59"]
    changed |= {"holds": not changed["holds"], "says": "It is otherwise."}
    path.write_text(json.dumps(said), encoding="utf-8")
    return places[0], places[1]


def test_a_changed_statement_changes_its_verdict_and_sentence_and_nothing_else(
    spoilt: tuple[Checkout, Checkout],
) -> None:
    """Verdicts are computed from statements, so that a wrong sign in a transcription shows where it matters and only there."""
    before, after = (content.gather(place).states for place in spoilt)
    assert [name for name in before if before[name].name != after[name].name] == ["C59"]
    texts = []
    for place in spoilt:
        site.build(place)
        shown = {path.stem: path.read_text(encoding="utf-8") for path in place.pages.glob("*.html")}
        texts.append({name: re.sub(r"Page built .*", "", text) for name, text in shown.items()})
    differ = {name for name in texts[0] if texts[0][name] != texts[1][name]}
    # The overview counts states; "Stability" lists the verdicts by layer, "Certificates" those on signs; tolerances stand on "Reproduce".
    assert differ <= {"claims", "index", "stability", "certificates", "printed_consequences", "reproduce"}
    assert {"claims", "index", "printed_consequences"} <= differ
    cards = [re.split(r'(?=<article class="card" id=")', text["claims"]) for text in texts]
    changed = [new[:40] for old, new in zip(*cards, strict=True) if old != new and new.startswith("<article")]
    assert len(changed) == 1
    assert 'id="C59"' in changed[0]
    assert "It is otherwise." in texts[1]["claims"]
