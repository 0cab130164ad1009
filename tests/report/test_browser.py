"""The pages in a real browser, from disk, with the network off, JavaScript on and off.

Only a browser tells whether a page renders without an error in its console, asks for anything outside, or needs
to be scrolled sideways on a telephone.
"""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, sync_playwright

from rkverify.paths import checkout
from rkverify.workflow.discovery import study_names

PAGES = ["index", "ledger", "stability", *study_names(checkout())]
FLAGS = ["--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"]

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Debian's Chromium; without one the test fails and says what to install."""
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    assert path, "no Chromium found: apt-get install chromium, or leave these tests out with -m 'not browser'"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS, chromium_sandbox=False)
        yield browser
        browser.close()


@pytest.mark.parametrize("scripts", [True, False], ids=["JavaScript on", "JavaScript off"])
@pytest.mark.parametrize("width", [1200, 390])
def test_pages_open_without_error_request_or_sideways_scrolling(
    browser: Browser, pages: Path, scripts: bool, width: int
) -> None:
    context = browser.new_context(
        java_script_enabled=scripts, offline=True, viewport={"width": width, "height": 900}, reduced_motion="reduce"
    )
    problems: list[str] = []
    page = context.new_page()
    page.on("console", lambda m: problems.append(f"console: {m.text}") if m.type in ("error", "warning") else None)
    page.on("pageerror", lambda e: problems.append(f"error: {e}"))
    page.on("requestfailed", lambda r: problems.append(f"failed: {r.url}"))
    page.on("request", lambda r: None if r.url.startswith(("file:", "data:")) else problems.append(f"outside: {r.url}"))
    for name in PAGES:
        page.goto((pages / f"{name}.html").as_uri())
        page.wait_for_load_state("load")
        assert page.locator("h1").count() == 1
        if scripts:
            wide = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
            assert wide <= 0, f"{name} is {wide} pixels wider than a window of {width}"
            broken = page.evaluate(
                "[...document.images].filter(i => i.loading != 'lazy' && !i.naturalWidth).map(i => i.src)"
            )
            assert broken == []
    assert problems == []
    context.close()
