"""The pages in a real browser, from disk, with the network off, JavaScript on and off.

Only a browser tells whether a page renders without an error in its console, asks for anything outside, or needs
to be scrolled sideways on a telephone; and only a program that knows the rules finds what keeps a reader out.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
from axe_playwright_python.base import AXE_FILE_PATH
from playwright.sync_api import Page

from rkverify.paths import checkout
from rkverify.report import site
from rkverify.workflow.discovery import study_names

Opened = Callable[..., AbstractContextManager[Page]]
"""What `conftest.opened` gives."""
STUDIES = [name for name in study_names(checkout()) if (checkout().results / name).is_dir()]
PAGES = [*site.menu(), *STUDIES]
pytestmark = pytest.mark.browser


def violations(page: Page, contrast: bool = True) -> list[str]:
    """What axe-core has against a page: names, contrast, order of headings, landmarks, tables, keyboard."""
    page.add_script_tag(path=AXE_FILE_PATH)
    # Cards and rows of one template are all alike to these rules: of each kind the first ones stand for all.
    page.evaluate("""() => {
        const rest = ".card:nth-of-type(n+8), .statement:nth-of-type(n+5), .part:nth-of-type(n+6), tbody tr:nth-child(n+8),"
            + ".statements .said:nth-child(n+4), .formula ~ .formula ~ .formula:not([data-relation]), h3 ~ h3 ~ h3 ~ h3 ~ h3 ~ details";
        document.querySelectorAll(rest).forEach(e => e.remove());
    }""")
    found = page.evaluate(
        "rules => axe.run(document, {resultTypes: ['violations'], preload: false, iframes: false, rules})",
        {"color-contrast": {"enabled": contrast}},
    )
    return [f"{v['id']}: {v['nodes'][0]['html'][:200]}" for v in found["violations"]]


@pytest.mark.parametrize("part", range(3))
def test_pages_are_whole_with_javascript_on_a_desk_and_on_a_telephone(opened: Opened, pages: Path, part: int) -> None:
    with opened() as page:
        for name in PAGES[part::3]:  # in parts, so that several processes share them
            page.set_viewport_size({"width": 1200, "height": 900})
            page.goto((pages / f"{name}.html").as_uri())
            assert page.locator("h1").count() == 1
            broken = "[...document.images].filter(i => !i.naturalWidth).map(i => i.src)"
            assert page.evaluate(broken) == []
            for width in (1200, 390):
                page.set_viewport_size({"width": width, "height": 900})
                wide = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
                assert wide <= 0, f"{name} is {wide} pixels wider than a window of {width}"
            # Contrast is a matter of the style sheet, which the pages of all studies share.
            assert violations(page, contrast=name not in STUDIES[3:]) == [], name


def test_pages_are_whole_without_javascript(opened: Opened, pages: Path) -> None:
    with opened(width=390, scripts=False) as page:
        for name in PAGES:
            page.goto((pages / f"{name}.html").as_uri())
            assert page.locator("h1").count() == 1
        page.goto((pages / "explorer.html").as_uri())
        assert "rkverify dispersion" in page.locator("noscript").inner_html()
        assert page.locator("#explorer").is_hidden()
        page.goto((pages / "claims.html").as_uri())
        assert not page.locator("form.filter").is_visible()


def test_a_drawing_that_is_not_there_is_noticed(opened: Opened, pages: Path) -> None:
    """The control: an image without its file fails, although it is loaded late."""

    def spoilt() -> None:
        with opened() as page:
            page.goto((pages / "index.html").as_uri())
            image = "<img src=nowhere.svg loading=lazy alt=nothing>"
            with page.expect_event("requestfailed"):
                page.evaluate("image => document.body.insertAdjacentHTML('afterbegin', image)", image)

    with pytest.raises(AssertionError, match=r"failed: .*nowhere\.svg"):
        spoilt()


def test_axe_finds_what_is_wrong(opened: Opened, pages: Path) -> None:
    """The control: an image without words and pale letters are found."""
    with opened() as page:
        page.goto((pages / "index.html").as_uri())
        spoilt = "<p style='color:#ddd'>Letters too pale to be read<img src='data:,'></p>"
        page.evaluate("text => document.querySelector('h1').insertAdjacentHTML('afterend', text)", spoilt)
        assert {text.partition(":")[0] for text in violations(page)} == {"image-alt", "color-contrast"}


def test_entries_are_found_and_sorted(opened: Opened, pages: Path) -> None:
    with opened() as page:
        page.goto((pages / "claims.html").as_uri())
        rows = page.locator("#entries tbody tr:visible")
        total = rows.count()
        page.get_by_label("State").select_option("fails")
        assert 0 < rows.count() < total
        assert set(rows.locator("td:nth-child(3) .state").all_inner_texts()) == {"fails"}
        assert page.locator("article.card:visible").count() == rows.count()
        page.get_by_label("State").select_option("")
        page.get_by_label("Find").fill("sign of Q")
        assert "C43" in rows.locator("th").all_inner_texts()
        assert rows.count() < total
        page.get_by_label("Find").fill("sigma Psi_I,xx C^sigma")  # as a keyboard has it; the page has letters
        assert "C49" in rows.locator("th").all_inner_texts()
        page.get_by_label("Find").fill("")
        page.get_by_role("button", name="claim").click()
        page.get_by_role("button", name="claim").click()
        assert rows.locator("th").first.inner_text() == f"C{total}"
        page.evaluate("location.hash = ''")
        page.get_by_label("Find").fill("sign of Q")
        page.evaluate("location.hash = 'C1'")
        page.wait_for_function("!document.getElementById('C1').hidden")


@pytest.mark.parametrize(
    ("start", "written", "where"),
    [
        ("index", "C43", "claims.html#C43"),
        ("index", " c 4 ", "claims.html#C4"),
        ("turns", "(80)", "equations.html#E80"),
        ("index", "eq. 59", "equations.html#E59"),
        ("index", "Fig. 7", "figures.html#F7"),
        ("claims", "49", "claims.html#C49"),
        ("index", "49", ""),
        ("index", "C76", ""),
        ("index", "figure 0", ""),
    ],
)
def test_a_number_leads_to_its_entry_from_every_page(
    opened: Opened, pages: Path, start: str, written: str, where: str
) -> None:
    """A reader who comes with the paper in hand has a number, and nothing else."""
    with opened() as page:
        page.goto((pages / f"{start}.html").as_uri())
        page.get_by_label("Go to").fill(written)
        page.keyboard.press("Enter")
        if where:
            page.wait_for_url(f"**/{where}")
            assert page.locator(f"#{where.partition('#')[2]} .answer").is_visible()
        else:
            assert "no such entry" in page.locator("form.jump output").inner_text()


def test_the_keyboard_reaches_the_content(opened: Opened, pages: Path) -> None:
    with opened() as page:
        page.goto((pages / "index.html").as_uri())
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.className") == "skip"
        page.keyboard.press("Enter")
        assert page.evaluate("document.activeElement.id") == "main"
