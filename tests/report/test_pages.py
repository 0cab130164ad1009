"""The pages as files: complete without a script, without the network, and without a dead end.

A reader without sight, network or JavaScript gets what these properties promise and nothing else does.
"""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

import pytest
from bs4 import BeautifulSoup

from rkverify.errors import BadInput
from rkverify.ledger.entries import entries
from rkverify.ledger.states import states
from rkverify.paths import checkout
from rkverify.report import content, stability
from rkverify.workflow.discovery import study_names

STUDIES = study_names(checkout())
PAGES = ["index", "ledger", "stability", *STUDIES]


def soup(pages: Path, name: str) -> BeautifulSoup:
    return BeautifulSoup((pages / f"{name}.html").read_text(encoding="utf-8"), "html.parser")


def test_every_study_has_a_page_and_nothing_else_is_built(pages: Path) -> None:
    assert sorted(p.name for p in pages.iterdir()) == sorted([*(f"{name}.html" for name in PAGES), "style.css"])


@pytest.mark.parametrize("name", PAGES)
def test_every_link_leads_somewhere_and_none_to_the_network(pages: Path, name: str) -> None:
    page = soup(pages, name)
    for tag, attribute in (("a", "href"), ("img", "src"), ("link", "href"), ("script", "src")):
        for element in page.find_all(tag):
            target = element.get(attribute)
            if target == "data:,":  # an empty icon, so that no browser asks for one
                continue
            assert "//" not in target, target
            file, _, fragment = target.partition("#")
            path = (pages / unquote(file)).resolve() if file else pages / f"{name}.html"
            assert path.is_file(), target
            if fragment:
                assert BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").find(id=fragment), target


@pytest.mark.parametrize("name", PAGES)
def test_images_say_what_they_show_and_headings_are_in_order(pages: Path, name: str) -> None:
    page = soup(pages, name)
    for image in page.find_all("img"):
        assert len(image["alt"].split()) > 8
    levels = [int(heading.name[1]) for heading in page.find_all(["h1", "h2", "h3", "h4"])]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(later <= earlier + 1 for earlier, later in pairwise(levels))
    assert page.html["lang"] == "en"
    ids = [element["id"] for element in page.find_all(id=True)]
    assert len(ids) == len(set(ids))


@pytest.mark.parametrize("name", [s for s in STUDIES if s.startswith("figure")])
def test_a_figure_page_has_figure_formula_statement_data_and_code(pages: Path, name: str) -> None:
    page = soup(pages, name)
    assert page.find("figure").find("img")["src"].endswith(f"{name}.svg")
    assert page.find("math") is not None
    assert page.find(class_="statement") is not None
    assert any(a["href"].endswith(".csv") for a in page.find_all("a"))
    assert any(a["href"].endswith(f"studies/{name}.py") for a in page.find_all("a"))


def test_the_ledger_page_shows_the_computed_state_of_every_entry(pages: Path) -> None:
    page = soup(pages, "ledger")
    computed = states(checkout().results)
    for name in entries():
        row = page.find("tr", id=name)
        assert row.find(class_="state").get_text() == computed[name].name


def test_the_stability_page_names_what_studies_have_and_nothing_else(
    pages: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A figure, table or statement that vanished from a study must not vanish from the page in silence; a quick run may lack it."""
    place = checkout()
    site = content.gather(place)
    shown = sum(len(part["figures"]) + len(part["statements"]) for part in stability.plan()["section"])
    found = stability.sections(place, site)
    assert sum(len(part.figures) + len(part.statements) for part in found) == shown
    plan = stability.plan()
    plan["section"][0]["statements"].append("derivation/no_such_statement")
    monkeypatch.setattr(stability, "plan", lambda: plan)
    with pytest.raises(BadInput, match="no_such_statement"):
        stability.sections(place, site)
    lacking = stability.sections(replace(place, state=place.quick().state), site)
    assert sum(len(part.figures) + len(part.statements) for part in lacking) == shown
