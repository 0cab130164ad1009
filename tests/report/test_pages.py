"""The pages as files: complete without a script, without the network, and without a dead end.

A reader without sight, network or JavaScript gets what these properties promise and nothing else does.
"""

import csv
import re
import time
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest
from bs4 import BeautifulSoup

from rkverify import readings
from rkverify.errors import BadInput
from rkverify.ledger.entries import entries
from rkverify.ledger.states import STATES, states
from rkverify.paths import checkout
from rkverify.readings import (
    CELL_EDGES,
    CELL_MEASURES,
    CONVECTIONS,
    DERIVATIVES,
    HALF_POINTS,
    MASSES,
    NODAL_INTEGRATIONS,
    NODE_MOTIONS,
    STRESS_LAWS,
    SUPPORT_RADII,
    WINDOWS,
)
from rkverify.report import answers, cards, choices, content, front, sections, site
from rkverify.report.formulas import data, formulas, notes
from rkverify.report.links import slug
from rkverify.solid.edge_rules import EDGE_RULES
from rkverify.workflow.discovery import study_names
from rkverify.workflow.study import LAYERS

Read = Callable[[str | Path], Any]
"""What `conftest.read` gives."""
STUDIES = [name for name in study_names(checkout()) if (checkout().results / name).is_dir()]
PAGES = [*site.menu(), *STUDIES]


def soup(pages: Path, name: str) -> BeautifulSoup:
    return BeautifulSoup((pages / f"{name}.html").read_text(encoding="utf-8"), "html.parser")


def test_every_study_has_a_page_and_nothing_else_is_built(pages: Path) -> None:
    expected = sorted([*(f"{name}.html" for name in PAGES), *site.ASSETS])
    assert sorted(p.name for p in pages.iterdir()) == expected


def test_no_study_has_the_name_of_another_page() -> None:
    assert not set(study_names(checkout())) & set(site.menu())


def test_every_study_is_on_one_page_on_a_subject_and_every_name_there_is_a_study() -> None:
    """A study that no page shows is work that nobody sees; a name that no study has is a hole."""
    plans, known = sections.plans(), study_names(checkout())
    for name in known:
        assert len(sections.pages_of(name, plans)) == 1, f"{name}: put it on one page of rkverify/report/pages"
    for title, plan in plans.items():
        for pattern in plan["studies"]:
            assert any(sections.pages_of(name, {title: {"studies": [pattern]}}) for name in known), pattern


@pytest.mark.parametrize("name", PAGES)
def test_every_link_leads_somewhere_and_none_to_the_network(pages: Path, read: Read, name: str) -> None:
    for target in sorted(set(read(name).links)):
        if target == "data:,":  # an empty icon, so that no browser asks for one
            continue
        assert "//" not in target, target
        file, _, fragment = target.partition("#")
        path = (pages / unquote(file)).resolve() if file else pages / f"{name}.html"
        assert path.is_file(), target
        if fragment:
            assert fragment in read(path).ids, target


@pytest.mark.parametrize("name", PAGES)
def test_images_say_what_they_show_and_headings_are_in_order(pages: Path, read: Read, name: str) -> None:
    found = read(name)
    assert all(alt and len(alt.split()) > 8 for alt in found.images)
    assert found.headings[0] == 1
    assert found.headings.count(1) == 1
    assert all(later <= earlier + 1 for earlier, later in pairwise(found.headings))
    assert found.language == "en"
    assert len(found.ids) == len(set(found.ids))


@pytest.mark.parametrize("name", PAGES)
def test_the_foot_names_commit_versions_processor_command_and_time(pages: Path, read: Read, name: str) -> None:
    assert re.search(
        r"Page built \d{4}-\d\d-\d\d \d\d:\d\d UTC by rkverify.* at commit \w+.*; Python 3.*numpy .*cores",
        read(name).text,
    )


@pytest.mark.parametrize("letter", ["E", "C", "F"])
def test_every_entry_has_a_card_with_its_computed_state(pages: Path, letter: str) -> None:
    found = soup(pages, content.PARTS[letter])
    computed = states(checkout().results)
    for name in entries():
        if name.startswith(letter):
            assert found.find(id=name).find(class_="state").get_text() == computed[name].name


@pytest.mark.parametrize("letter", ["E", "C", "F"])
def test_from_any_entry_to_data_and_code_in_two_clicks(pages: Path, letter: str) -> None:
    """One click, on the entry's number on the front page or its own page, leads to the card, and a second one to a file.

    Every study that speaks of the entry has its tables and its code there; every entry has one.
    """
    found, front_page = soup(pages, content.PARTS[letter]), soup(pages, "index")
    computed, seen = states(checkout().results), 0
    for name in entries():
        if not name.startswith(letter):
            continue
        assert front_page.find("a", href=content.entry_href(name)) is not None, name
        assert found.select_one(f'nav.numbers a[href="{content.entry_href(name)}"]') is not None, name
        links = [a["href"] for a in found.find(id=name).find_all("a", href=True)]
        spoken = {e.study for e in computed[name].evidence}
        assert spoken, f"{name}: no study speaks of it"
        for study in spoken:
            assert any(f"/{study}/" in link and link.endswith(".csv") for link in links), (name, study)
            assert any(link.endswith(f"studies/{study}.py") for link in links), (name, study)
        for link in links:
            if not link.startswith("#"):
                assert (pages / unquote(link.partition("#")[0])).is_file(), (name, link)
        seen += 1
    assert seen == {"E": 87, "C": 75, "F": 8}[letter]


@pytest.mark.parametrize("letter", ["E", "C", "F"])
def test_every_card_says_its_verdict_in_one_sentence_and_why(pages: Path, letter: str) -> None:
    """Of each layer's verdict there is a statement of that verdict; all others are folded away, and none is lost."""
    found, computed = soup(pages, content.PARTS[letter]), states(checkout().results)
    for name in entries():
        if not name.startswith(letter):
            continue
        card, state = found.find(id=name), computed[name]
        sentence = card.select_one(".answer").get_text(" ", strip=True)
        assert sentence.endswith("."), sentence
        assert sentence.count(". ") == 0, sentence
        words = [word.partition(" (")[0] for word in state.layers.values()] or [state.name]
        for word, said in (("holds", "it holds"), ("fails", "it fails"), ("definition", "definition")):
            assert (said in sentence.lower()) == any(each.startswith(word) for each in words), (name, sentence)
        linked = {a["href"] for a in card.select(".said a")}
        assert {f"{e.study}.html#{slug(e.name)}" for e in state.evidence} <= linked, name
        at_once = [each for each in card.select(".said") if each.find_parent("details") is None]
        chips = {each.select_one(".state").get_text() for each in at_once}
        for word in words:
            wanted = {"holds": {"holds"}, "fails": {"fails"}, "holds under a reading": {"holds", "fails"}}.get(
                word, set()
            )
            assert wanted <= chips, (name, word, chips)


def test_a_sentence_names_the_readings_or_counts_them() -> None:
    """Up to four readings are named; the readings are those of the state, and the words those of the layer."""

    def said(word: str, layer: str, reading: str) -> dict[str, Any]:
        return {"word": word, "reading": reading, "says": f"{word} {layer} {reading}", "layer": layer}

    def group(layer: str, word: str, detail: str, *told: dict[str, Any]) -> cards.Group:
        return cards.Group(layer, word, "", detail, "", list(told), [])

    def shown(*groups: cards.Group) -> tuple[str, list[tuple[list[str], str]]]:
        fields = {"state": "differs between layers", "detail": "", "groups": list(groups)}
        card = SimpleNamespace(**fields)
        return answers.in_short(card), [(r.layers, r.statement["says"]) for r in answers.reasons(card)]

    both = [said("fails", "x", "b"), said("holds", "x", "a")]
    assert shown(
        group("printed", "holds", ""),
        group("as-defined", "fails", "", *both[:1]),
        group("simulated", "fails", "", *both[:1]),
    ) == (
        "It holds in print; it fails for the equations as defined and in nonlinear computations.",
        [(["as-defined", "simulated"], "fails x b")],
    )
    assert shown(group("consistent", "holds under a reading", "a", *both)) == (
        "With the true rate it holds only under “a”.",
        [(["consistent"], "fails x b"), (["consistent"], "holds x a")],
    )
    many = [said("holds", "x", each) for each in "abcde"] + [said("fails", "x", "f")]
    assert shown(group("printed", "holds under a reading", "a; b; c; d; e", *many))[0] == (
        "In print it holds only under 5 of 6 readings."
    )


def test_every_word_of_a_verdict_is_explained(pages: Path) -> None:
    """A reader who knows the paper has not seen our states and layers before."""
    words = data("words.toml")
    assert [raw["word"] for raw in words["state"]] == list(STATES)
    assert [raw["word"] for raw in words["layer"]] == list(LAYERS)
    for name in ("index", "claims", "equations"):
        told = soup(pages, name).select_one("dl.words").get_text(" ", strip=True)
        for layer in LAYERS:
            assert layer in told


def test_every_equation_is_shown_with_the_code_that_is_it(pages: Path) -> None:
    assert sorted(formulas()) == list(range(1, 88))
    found = soup(pages, "equations")
    for number in formulas():
        card = found.find(id=f"E{number}")
        assert card.find("math") is not None
        assert card.find("math").find("merror") is None
        assert any("rkverify/paper/" in a["href"] for a in card.find_all("a"))
    assert "\\" not in "".join(formulas().values())
    parts = {"msub": 2, "msup": 2, "mfrac": 2, "mover": 2, "munder": 2, "msubsup": 3, "munderover": 3}
    for mathml in formulas().values():
        for element in ElementTree.fromstring(mathml).iter():
            name = element.tag.rpartition("}")[2]
            assert len(element) == parts.get(name, len(element)), ElementTree.tostring(element)
    assert {*notes("scan"), *notes("reading")} <= set(formulas())
    assert set(notes("choice")) <= set(notes("reading"))


@pytest.mark.parametrize("name", [s for s in STUDIES if s.startswith("figure")])
def test_a_figure_has_ours_verdict_parameters_data_and_code(pages: Path, name: str) -> None:
    card = soup(pages, "figures").find(id=f"F{name.removeprefix('figure')}")
    assert card.find("img")["src"].endswith(f"{name}.svg")
    assert card.find(class_="said") is not None
    assert any(a["href"].endswith(".csv") for a in card.find_all("a"))
    assert any(a["href"].endswith(f"studies/{name}.py") for a in card.find_all("a"))
    assert "every other value is ours" in card.get_text()


def test_the_readings_are_those_of_the_library_both_ways() -> None:
    """A reading that the page does not explain, or one that it invents, misleads."""
    known = {
        "derivative": DERIVATIVES,
        "half_point": HALF_POINTS,
        "convection": CONVECTIONS,
        "stress_law": STRESS_LAWS,
        "cell_measure": CELL_MEASURES,
        "integration": NODAL_INTEGRATIONS,
        "node_motion": NODE_MOTIONS,
        "cell_edges": CELL_EDGES,
        "support_radius": SUPPORT_RADII,
        "mass": MASSES,
        "window": WINDOWS,
        "edge_rule": EDGE_RULES,
    }
    # Nothing that rkverify/readings.py offers is left out.
    offered = {name: value for name, value in vars(readings).items() if name.isupper() and isinstance(value, tuple)}
    shown_options = [set(options) for options in known.values()]
    for name, options in offered.items():
        assert any(set(options) <= each for each in shown_options), name
    shown = {raw["name"]: tuple(raw["options"]) for raw in data("readings.toml")["choice"]}
    assert {name: set(options) for name, options in known.items()} == {
        name: set(options) for name, options in shown.items()
    }
    found = {choice.name: choice for choice in choices.choices(checkout(), content.gather(checkout()))}
    assert found["derivative"].default == "full"
    assert found["convection"].default == "psi-star"


def test_the_page_says_in_computed_numbers_what_each_option_does(pages: Path) -> None:
    """Every option has a line with numbers, those of the study; the default moves nothing."""
    with (checkout().results / "reading_options" / "summary.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    found = soup(pages, "readings")
    for raw in data("readings.toml")["choice"]:
        lines = {
            line.find("th").find("code").get_text(): [cell.get_text() for cell in line.find_all("td")]
            for line in found.find(id=raw["name"]).find("table").find("tbody").find_all("tr")
        }
        own = [row for row in rows if row["choice"] == raw["name"]]
        assert [row["option"] for row in own if float(row["at_rest"]) == 0 and row["in_motion"] in ("0", "")][:1] == [
            own[0]["option"]
        ]
        assert set(lines) == {row["option"] for row in own}, raw["name"]
        for row in own:
            assert lines[row["option"]][1:] == [
                f"{float(row[name]):.3g}" if row[name] else "–" for name in choices.SHOWN
            ]


def test_a_page_names_what_studies_have_and_nothing_else() -> None:
    """A figure, table or statement that vanished from a study must not vanish from a page in silence; a quick run may lack it."""
    place = checkout()
    gathered = content.gather(place)
    plan: dict[str, Any] = {"studies": [], "section": [{"title": "", "text": "", "command": ""}]}
    plan["section"][0]["statements"] = ["derivation/dni", "derivation/scni_edge_*"]
    assert len(sections.sections(place, gathered, plan)[0].statements) == 3
    for kind in ("figures", "tables", "statements"):
        plan["section"][0] = {"title": "", "text": "", "command": "", kind: ["derivation/no_such"]}
        with pytest.raises(BadInput, match="no_such"):
            sections.sections(place, gathered, plan)
        lacking = sections.sections(replace(place, state=place.quick().state), gathered, plan)
        assert lacking[0].statements == lacking[0].figures == lacking[0].tables == []


def test_a_study_of_a_page_that_no_section_shows_is_shown_whole() -> None:
    gathered = content.gather(checkout())
    shown = sections.sections(checkout(), gathered, {"studies": ["derivation"]})
    assert [part.study for part in shown] == ["derivation"]
    assert len(shown[0].statements) + len(shown[0].more) == len(gathered.studies["derivation"].statements)


def test_the_picture_counts_every_entry_once_and_says_so_in_words(pages: Path) -> None:
    gathered = content.gather(checkout())
    bars = front.picture(gathered)
    assert sum(part.count for bar in bars for part in bar.parts) == len(entries())
    for bar in bars:
        assert bar.total == sum(part.count for part in bar.parts)
        assert f"{bar.total} in the state '{bar.state}'" in front.in_words(bars)
    assert front.in_words(bars) in soup(pages, "index").find("svg").get_text()


def test_the_site_is_quickly_built(pages: Path) -> None:
    """20 s, so that it is built often."""
    start = time.perf_counter()
    site.build(replace(checkout(), pages=pages.parent / "again"))
    assert time.perf_counter() - start < 20
