"""The notebooks as Jupyter runs them: twice the same, without a warning, and pages that open anywhere.

Only a kernel tells whether a notebook runs from top to bottom; only a second run tells whether its outputs are facts.
"""

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from playwright.sync_api import Browser

from rkverify.errors import BadInput, UnknownName
from rkverify.paths import checkout
from rkverify.report.notebook_pages import index_page, markdown, notebook_page
from rkverify.report.notebooks import build, execute, sources, text_of

SOURCES = sources(checkout())


@pytest.mark.slow
@pytest.mark.browser
@pytest.mark.parametrize("source", SOURCES, ids=lambda source: source.name)
def test_run_twice_it_is_the_same_and_its_page_opens(source, tmp_path: Path, browser: Browser) -> None:
    with ThreadPoolExecutor(2) as pool:
        first, second = pool.map(execute, [source.path, source.path])
    assert text_of(first) == text_of(second)
    place = replace(checkout(), pages=tmp_path / "the pages")
    page = place.pages / "notebooks" / f"{source.name}.html"
    page.parent.mkdir(parents=True)
    page.write_text(notebook_page(place, SOURCES, source, first, "Foot."), encoding="utf-8")
    _is_complete(page)
    _opens(page, browser)


def _is_complete(page: Path) -> None:
    soup = BeautifulSoup(page.read_text(encoding="utf-8"), "html.parser")
    levels = [int(heading.name[1]) for heading in soup.find_all(["h1", "h2", "h3"])]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(later <= earlier + 1 for earlier, later in pairwise(levels))
    for image in soup.find_all("img"):
        inside = image["src"].startswith("data:image/svg+xml;base64,")
        assert inside or (page.parent / image["src"]).resolve().is_relative_to(checkout().results), image["src"]
        assert inside or (page.parent / image["src"]).is_file(), image["src"]
        assert len(image["alt"].split()) > 8
    assert soup.find("script") is None
    assert "STORED" not in soup.get_text()
    assert "$" not in "".join(part.get_text() for part in soup.find_all(class_="words"))
    root, names = checkout().root, {source.name for source in SOURCES}
    for link in soup.find_all("a"):
        target, _, fragment = link["href"].partition("#")
        assert "//" not in target
        path = (page.parent / target).resolve()
        if path.is_relative_to(root):
            assert path.exists(), target
        elif path.parent == page.parent.resolve():
            assert path.stem in names | {page.stem, "index"}, target
        elif target:
            assert path.name in {"index.html", "equations.html", "claims.html", "figures.html"}, target
            assert fragment or path.name == "index.html"


def _opens(page: Path, browser: Browser) -> None:
    problems: list[str] = []
    for scripts in (True, False):
        for width in (1200, 390):
            context = browser.new_context(
                java_script_enabled=scripts, offline=True, viewport={"width": width, "height": 900}
            )
            tab = context.new_page()
            tab.on("console", lambda m: problems.append(f"console: {m.text}"))
            tab.on("pageerror", lambda e: problems.append(f"error: {e}"))
            tab.on("requestfailed", lambda r: problems.append(f"failed: {r.url}"))
            tab.on(
                "request",
                lambda r: None if r.url.startswith(("file:", "data:")) else problems.append(f"outside: {r.url}"),
            )
            tab.goto(page.as_uri())
            tab.wait_for_load_state("load")
            if scripts:
                wide = tab.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
                assert wide <= 0, f"{page.name} is {wide} pixels wider than a window of {width}"
                assert tab.evaluate("[...document.images].every(i => i.naturalWidth > 0)")
            context.close()
    assert problems == []


def small(folder: Path, *lines: str) -> Path:
    """A notebook with these cells."""
    cells = [
        {"cell_type": "code", "id": f"c{n}", "metadata": {}, "source": line, "outputs": [], "execution_count": None}
        for n, line in enumerate(lines)
    ]
    path = folder / "small.ipynb"
    path.write_text(json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("1 / 0", "small.ipynb: ZeroDivisionError: division by zero"),
        ("import warnings; warnings.warn('soon')", "small.ipynb: cell c1 warns: .*soon"),
    ],
)
def test_a_cell_that_fails_or_warns_is_told_in_one_line(line: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=told) as refused:
        execute(small(tmp_path, "x = 1", line))
    assert "\n" not in str(refused.value)


def test_what_is_written(tmp_path: Path) -> None:
    place = replace(checkout(), pages=tmp_path / "the pages")
    front = build(place, ["start_here"])
    assert sorted(p.name for p in front.parent.iterdir()) == ["index.html", "start_here.html", "start_here.ipynb"]
    assert json.loads((front.parent / "start_here.ipynb").read_text(encoding="utf-8"))["nbformat"] == 4
    with pytest.raises(UnknownName, match="unknown notebook 'start_her'"):
        build(place, ["start_her"])


def test_the_list_names_all_in_order(tmp_path: Path) -> None:
    place = replace(checkout(), pages=tmp_path)
    soup = BeautifulSoup(index_page(place, SOURCES, "Foot."), "html.parser")
    assert [h.a["href"] for h in soup.find_all("h2")] == [f"{source.name}.html" for source in SOURCES]


def test_formulas_become_mathml_and_numbers_links_and_code_stays() -> None:
    html = markdown("With $x_I$ and `$PATH (40)`, (40) and (C49), (99) [as (3)](y.html).")
    assert "<math" in html
    assert "<code>$PATH (40)</code>" in html
    assert '(<a href="../equations.html#E40">40</a>)' in html
    assert '(<a href="../claims.html#C49">C49</a>)' in html
    assert "(99)" in html
    assert '<a href="y.html">as (3)</a>' in html
