"""Writing the pages."""

from importlib.resources import files
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from rkverify.paths import Checkout
from rkverify.report.content import count_rows, findings, gather, ledger_parts
from rkverify.report.stability import LAYERS, claims_by_layer, counts_by_layer, plan, sections
from rkverify.workflow.files import write_atomically


def build(place: Checkout) -> Path:
    """Write index.html, ledger.html, stability.html, a page for each study and the style sheet; returns the front page.

    Raises BadInput where a study has no results, or the folder cannot be written.
    """
    site = gather(place)
    environment = Environment(
        loader=PackageLoader("rkverify.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates = {
        name: environment.get_template(f"{name}.html.j2") for name in ("index", "ledger", "stability", "study")
    }
    foot = site.studies[0].foot
    pages = {
        "index": templates["index"].render(
            page="index",
            title="A verification of Lagrangian and semi-Lagrangian RK discretisations",
            studies=site.studies,
            counts=count_rows(site),
            total=len(site.states),
            statement_count=len(site.evidence),
            findings=findings(site),
            foot=foot,
        ),
        "ledger": templates["ledger"].render(
            page="ledger", title="Ledger", studies=site.studies, parts=ledger_parts(place, site), foot=foot
        ),
    }
    claims = claims_by_layer(site.states)
    words, numbers = counts_by_layer(claims)
    pages["stability"] = templates["stability"].render(
        page="stability",
        title="Stability",
        studies=site.studies,
        lead=plan()["lead"],
        layers=LAYERS,
        claims=claims,
        words=words,
        counts=numbers,
        sections=sections(place, site),
        foot=foot,
    )
    for study in site.studies:
        pages[study.name] = templates["study"].render(
            page=study.name, title=study.title, studies=site.studies, study=study, foot=study.foot
        )
    for name, text in pages.items():
        write_atomically(place.pages / f"{name}.html", text)
    style = files("rkverify.report").joinpath("templates/style.css").read_text(encoding="utf-8")
    write_atomically(place.pages / "style.css", style)
    return place.pages / "index.html"
