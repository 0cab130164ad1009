"""Pages built from the committed results into a folder of the test's own, and what they hold, read once."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field, replace
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from playwright.sync_api import Page as Tab

from rkverify.paths import checkout
from rkverify.report.site import build


@pytest.fixture(scope="session")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the pages, its name with a space in it."""
    folder = tmp_path_factory.mktemp("the report") / "pages"
    build(replace(checkout(), pages=folder))
    return folder


@dataclass
class Page(HTMLParser):
    """Links, ids, headings, images and words of a page."""

    links: list[str] = field(default_factory=list)
    ids: list[str] = field(default_factory=list)
    headings: list[int] = field(default_factory=list)
    images: list[str | None] = field(default_factory=list)
    inside: dict[str, list[str]] = field(default_factory=dict)
    words: list[str] = field(default_factory=list)
    language: str | None = None
    _card: str = ""

    def __post_init__(self) -> None:
        super().__init__(convert_charrefs=True)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        found = dict(attributes)
        if tag == "html":
            self.language = found.get("lang")
        if id := found.get("id"):
            self.ids.append(id)
        if (found.get("class") or "") in ("card", "statement"):
            self._card = found.get("id") or ""
        for name in ("href", "src"):
            if (target := found.get(name)) is not None:
                self.links.append(target)
                self.inside.setdefault(self._card, []).append(target)
        if tag in ("h1", "h2", "h3", "h4"):
            self.headings.append(int(tag[1]))
        if tag == "img":
            self.images.append(found.get("alt"))

    def handle_endtag(self, tag: str) -> None:
        if tag == "article":
            self._card = ""

    def handle_data(self, data: str) -> None:
        self.words.append(data)

    @property
    def text(self) -> str:
        """All words."""
        return " ".join("".join(self.words).split())


@pytest.fixture(scope="session")
def read(pages: Path) -> Callable[[str | Path], Page]:
    """Name or path of a page -> what it holds."""

    @cache
    def of(path: Path) -> Page:
        page = Page()
        page.feed(path.read_text(encoding="utf-8"))
        return page

    return lambda name: of(name if isinstance(name, Path) else pages / f"{name}.html")


@pytest.fixture
def opened(browser: Browser) -> Callable[..., AbstractContextManager[Tab]]:
    """A page whose console stays silent and which asks for nothing but files."""

    @contextmanager
    def tab(width: int = 1200, scripts: bool = True) -> Iterator[Tab]:
        context = browser.new_context(
            java_script_enabled=scripts, offline=True, viewport={"width": width, "height": 900}, reduced_motion="reduce"
        )
        problems: list[str] = []
        page = context.new_page()
        page.on("console", lambda m: problems.append(f"console: {m.text}") if m.type in ("error", "warning") else None)
        page.on("pageerror", lambda e: problems.append(f"error: {e}"))
        # Leaving a page cuts off what still loads: no failure; a file that is not there has another word.
        page.on("requestfailed", lambda r: None if "ABORTED" in r.failure else problems.append(f"failed: {r.url}"))
        page.on("request", lambda r: None if r.url.startswith(("file:", "data:")) else problems.append(r.url))
        yield page
        assert problems == []
        context.close()

    return tab
