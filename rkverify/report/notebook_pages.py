"""An executed notebook as a page in the style of the report: no network, no script, formulas as MathML."""

import os
import re
from base64 import b64encode
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from latex2mathml.converter import convert
from markupsafe import Markup

from rkverify.ledger.entries import entries
from rkverify.paths import Checkout
from rkverify.report.content import entry_href

if TYPE_CHECKING:
    from rkverify.report.notebooks import Source

KEPT = re.compile(r"```.*?```|`[^`\n]+`|\[[^\]\n]*\]\([^)\n]*\)", re.DOTALL)
FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", re.DOTALL)
NAMED = re.compile(r"\((\d{1,2}|[CEF]\d{1,2})\)")
"""An equation as (40) or an entry as (C49)."""
DESCRIBED = re.compile(r"<desc[^>]*>(.*?)</desc>", re.DOTALL)
DRAWN = re.compile(r'<img data-drawn="([^"]*)" src="[^"]*"')
"""A drawing of a study: the page shows the study's file, the notebook holds it."""
ESCAPES = re.compile(r"\x1b\[[0-9;]*m")


def markdown(text: str) -> Markup:
    """Markdown as HTML, formulas as MathML, (40) and (C49) as links to where the report shows them."""
    import mistune

    stored: list[str] = []

    def store(html: str) -> str:
        stored.append(html)
        return f"STORED{len(stored) - 1}DEROTS"

    def formula(found: re.Match[str]) -> str:
        display = "block" if found[1] else "inline"
        return store(convert((found[1] or found[2]).strip(), display=display))

    def named(found: re.Match[str]) -> str:
        id = found[1] if found[1][0].isalpha() else f"E{found[1]}"
        return f"([{found[1]}](../{entry_href(id)}))" if id in entries() else found[0]

    text = FORMULA.sub(formula, text)
    parts, end = [], 0
    for kept in KEPT.finditer(text):
        parts += [NAMED.sub(named, text[end : kept.start()]), kept[0]]
        end = kept.end()
    html = str(
        mistune.create_markdown(escape=False, plugins=["table"])("".join([*parts, NAMED.sub(named, text[end:])]))
    )
    return Markup(re.sub(r"STORED(\d+)DEROTS", lambda m: stored[int(m[1])], html))


def code(text: str) -> Markup:
    """Python with its words marked, for the style sheet to show."""
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import PythonLexer

    return Markup(highlight(text, PythonLexer(), HtmlFormatter(nowrap=True)))


def output(shown: Any, results: str) -> Markup:
    """One output of a cell: the richest form of it that needs no script; `results` is where studies' drawings are."""
    if shown["output_type"] == "stream":
        return _lines(shown["text"])
    data = shown["data"]
    if "text/html" in data:
        return Markup(DRAWN.sub(rf'<img src="{results}/\1"', data["text/html"]))
    if "text/markdown" in data:
        return markdown(data["text/markdown"])
    if "image/svg+xml" in data:
        words = DESCRIBED.search(data["image/svg+xml"])
        source = b64encode(data["image/svg+xml"].encode()).decode()
        alternative = words[1] if words else ""
        return Markup(f'<figure><img src="data:image/svg+xml;base64,{source}" alt="{alternative}"></figure>')
    return _lines(data["text/plain"])


def _lines(text: str) -> Markup:
    shown = escape(ESCAPES.sub("", text).rstrip())
    return Markup(f'<pre class="out" tabindex="0" role="group" aria-label="output">{shown}</pre>')


def _environment() -> Environment:
    made = Environment(
        loader=PackageLoader("rkverify.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters.update(markdown=markdown, code=code, output=output)
    folder = files("rkverify.report").joinpath("templates")
    style = "".join(folder.joinpath(name).read_text("utf-8") for name in ("style.css", "notebook.css"))
    made.globals.update(style=Markup(style), back="..")
    return made


def _from_page(place: Checkout, *parts: str) -> str:
    return os.path.relpath(place.root.joinpath(*parts), place.pages / "notebooks").replace(os.sep, "/")


def notebook_page(place: Checkout, every: "Sequence[Source]", source: "Source", notebook: Any, foot: str) -> str:
    """The page of one executed notebook."""
    solutions = ("notebooks", "solutions", f"{source.name}.py")
    results = os.path.relpath(place.results, place.pages / "notebooks").replace(os.sep, "/")
    return (
        _environment()
        .get_template("notebook.html.j2")
        .render(
            title=source.title,
            every=every,
            name=source.name,
            cells=notebook.cells,
            stored=_from_page(place, "notebooks", f"{source.name}.ipynb"),
            solutions=_from_page(place, *solutions) if place.root.joinpath(*solutions).is_file() else "",
            foot=foot,
            results=results,
        )
    )


def index_page(place: Checkout, every: "Sequence[Source]", foot: str) -> str:
    """The list of the notebooks."""
    template = _environment().get_template("notebooks.html.j2")
    return template.render(
        title="Notebooks", every=every, name="index", folder=_from_page(place, "notebooks"), foot=foot
    )
