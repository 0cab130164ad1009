"""Writing the pages."""

from datetime import UTC, datetime
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from rkverify.ledger.grades import GRADES
from rkverify.paths import Checkout
from rkverify.report import answers, api, cards, choices, content, explorer, front, grading, record, sections, trials
from rkverify.report.formulas import data, formulas
from rkverify.report.typeset import typeset
from rkverify.workflow.files import write_atomically
from rkverify.workflow.study import LAYERS

ASSETS = ("style.css", "jump.js", "tables.js", "lattice.js", "explorer.js")
OWN = {"index": "Overview", "equations": "Equations", "claims": "Claims", "readings": "Readings"}
LAST = {"explorer": "Explorer", "api": "For your code", "reproduce": "Reproduce"}
"""Pages with a template of their own, before and after those on a subject."""


def menu() -> dict[str, str]:
    """Page -> its name in the menu, in order."""
    subjects = {name: plan["title"] for name, plan in sections.plans().items()}
    first = {"index": OWN["index"], "equations": OWN["equations"], "figures": subjects.pop("figures")}
    return {**first, "claims": OWN["claims"], "readings": OWN["readings"], **subjects, **LAST}


def pages(place: Checkout, site: content.Site) -> dict[str, dict[str, Any]]:
    """Page -> template, title and what the template shows."""
    claims = cards.cards(place, site, "C")
    equations = cards.cards(place, site, "E")
    figures = cards.figure_cards(place, site, claims)
    every = {card.id: card for card in [*equations, *claims, *(figure.card for figure in figures)]}
    layered = sections.by_layer(list(every.values()))
    words, numbers = sections.counts_by_layer(layered)
    bars = front.picture(site)
    found: dict[str, dict[str, Any]] = {
        "index": {
            "title": "Stability of Lagrangian and semi-Lagrangian RK discretisations, checked by computation",
            "lead": data("front.toml")["lead"],
            "bars": bars,
            "grades": [*GRADES, front.NONE],
            "in_words": front.in_words(bars),
            "counts": content.count_rows(site),
            "entries": {"Claims": claims, "Equations": equations, "Figures": [figure.card for figure in figures]},
            "findings": front.findings(site, every, sections.is_quick(place)),
            "undecided": cards.undecided(site),
        },
        "equations": {"title": "Equations", "cards": equations},
        "claims": {"title": "Claims", "cards": claims, "layers": LAYERS},
        "readings": {
            "title": "Readings",
            "lead": data("readings.toml")["lead"],
            "choices": choices.choices(place, site),
        },
        "explorer": {
            "title": "Explorer",
            "data": explorer.data(place),
            "measured": explorer.measured(place),
            "options": explorer.options(),
            "relations": [
                {"key": key, "number": number, "mathml": formulas()[number]}
                for key, number in explorer.RELATIONS.items()
            ],
        },
        "api": {"title": "For your code", "lead": api.lead(), "parts": api.parts(place)},
        "reproduce": {
            "title": "Reproduce",
            "rows": record.study_rows(place, site),
            "tolerances": record.tolerances(site),
            "environment": record.environment(place),
            "targets": record.targets(place),
            "sources": record.sources(place),
        },
    }
    for name, plan in sections.plans().items():
        shown: dict[str, Any] = {"title": plan["title"], "lead": plan["lead"]}
        if name == "figures":
            found[name] = {**shown, "cards": figures}
            continue
        found[name] = {
            **shown,
            "template": "subject",
            "sections": sections.sections(place, site, plan),
            "layered": layered if plan.get("layers") else [],
            "layers": LAYERS,
            "words": words,
            "numbers": numbers,
            "controls": record.controls(place) if plan.get("controls") else [],
            "trials": trials.trials(place) if plan.get("controls") else None,
            "meanings": grading.meanings(site) if plan.get("grades") else [],
            "on_signs": grading.sign_claims(site, every) if plan.get("grades") else [],
        }
    for name, study in site.studies.items():
        found[name] = {
            "template": "study",
            "title": study.title,
            "study": study,
            "run_foot": study.foot,
            "page_of": [(page, menu()[page]) for page in sections.pages_of(name, sections.plans())],
        }
    return found


def build(place: Checkout) -> Path:
    """Write every page, the style sheet and the scripts; returns the front page.

    Raises BadInput where no study has results, a page shows what no study has, or the folder cannot be written.
    """
    site = content.gather(place)
    environment = Environment(
        loader=PackageLoader("rkverify.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["typeset"] = typeset
    environment.globals.update(
        menu=menu(),
        site=site,
        entry_href=content.entry_href,
        answers=answers,
        state_css=content.state_css,
        glossary=data("words.toml"),
        last=content.last_numbers(),
        foot=content.build_foot(place, datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")),
        run_foot="",
        notebooks=(place.pages / "notebooks" / "index.html").is_file(),
    )
    for name, shown in pages(place, site).items():
        template = environment.get_template(f"{shown.get('template', name)}.html.j2")
        write_atomically(place.pages / f"{name}.html", template.render(page=name, **shown))
    for name in ASSETS:
        write_atomically(place.pages / name, files("rkverify.report").joinpath(f"templates/{name}").read_text("utf-8"))
    return place.pages / "index.html"
