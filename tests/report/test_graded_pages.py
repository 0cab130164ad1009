"""Grades on the pages: whoever reads a verdict sees how good its evidence is, and finds what the word means."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from bs4 import BeautifulSoup

from rkverify.ledger.entries import entries
from rkverify.ledger.grades import GRADES, MEANINGS, PROVED, best, grades, in_words, on_signs
from rkverify.ledger.states import states
from rkverify.paths import checkout
from rkverify.report import content, front

Read = Callable[[str | Path], Any]


def soup(pages: Path, name: str) -> BeautifulSoup:
    return BeautifulSoup((pages / f"{name}.html").read_text(encoding="utf-8"), "html.parser")


@pytest.mark.parametrize("letter", ["E", "F", "C"])
def test_every_card_shows_its_grades_layer_by_layer_with_the_routes(pages: Path, letter: str) -> None:
    found, computed = soup(pages, content.PARTS[letter]), states(checkout().results)
    for name in entries():
        if name.startswith(letter) and best(computed[name]):
            text = found.find(id=name).select_one("p.grade").get_text(" ", strip=True)
            for g in grades(computed[name]):
                assert g.layer in text, name
                assert in_words([g]) in text, name
                assert all(route in text for route in g.routes)


def test_every_sign_or_stability_claim_is_in_the_table_with_its_grades(pages: Path) -> None:
    table, computed = soup(pages, "certificates").find(id="on-signs"), states(checkout().results)
    rows = {row.find("th").get_text(): row for row in table.find("tbody").find_all("tr")}
    assert list(rows) == sorted(rows, key=list(entries()).index)
    assert set(rows) == {name for name, entry in entries().items() if on_signs(entry)}
    for name, row in rows.items():
        words = [span.get_text() for span in row.select(".grade")]
        layers = entries()[name].layers or ("",)
        expected = [in_words(g for g in grades(computed[name]) if g.layer == layer) for layer in layers]
        assert sorted(words) == sorted(expected), name


def test_every_grade_is_explained_and_counted(pages: Path) -> None:
    text = " ".join(soup(pages, "certificates").find(id="grades").find_next("table").get_text(" ").split())
    computed = states(checkout().results)
    for grade, means in MEANINGS.items():
        assert f"{grade} {means}" in text
        counted = [sum(best(s) == grade for n, s in computed.items() if n.startswith(c)) for c in content.PARTS]
        assert f"{means} {' '.join(map(str, counted))}" in text


def test_what_is_only_sampled_is_on_the_page_with_its_reasons(pages: Path) -> None:
    page = soup(pages, "certificates")
    lines = (checkout().results / "theorems" / "open_ends.csv").read_text(encoding="utf-8").splitlines()
    table = page.find("a", string="theorems/open_ends.csv").find_parent("table")
    assert len(table.find("tbody").find_all("tr")) == len(lines) - 1


def test_the_front_page_names_the_grades_of_its_picture(pages: Path) -> None:
    page = soup(pages, "index")
    key = [item.get_text(strip=True) for item in page.select(".key li")]
    assert key == [*GRADES, front.NONE]
    assert PROVED in page.find("title", id="bars-words").get_text()
