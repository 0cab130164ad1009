"""What a notebook shows: figures with alternative text, tables with a caption, sentences with computed values.

In Jupyter these objects display themselves; on the built pages they look as they do elsewhere in the report.
"""

import json
from base64 import b64encode
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from rkverify.errors import BadInput
from rkverify.paths import checkout
from rkverify.workflow.produce import DESCRIPTION
from rkverify.workflow.style import svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Shown:
    """Something to look at as HTML, and to read as text."""

    html: str
    text: str

    def _repr_html_(self) -> str:
        return self.html

    def __repr__(self) -> str:
        """The text alone."""
        return self.text


@dataclass(frozen=True)
class Sentence:
    """A sentence in Markdown."""

    words: str

    def _repr_markdown_(self) -> str:
        return self.words

    def __repr__(self) -> str:
        """As it is written."""
        return self.words


def says(words: str) -> Sentence:
    """A sentence in Markdown, with the values that were computed filled in by an f-string.

    >>> says(f"The sum is **{1 + 1}**.")
    The sum is **2**.
    """
    return Sentence(words)


def _picture(drawing: str, alternative: str, caption: str, file: str = "") -> Shown:
    source = "data:image/svg+xml;base64," + b64encode(drawing.encode()).decode()
    drawn = f'data-drawn="{file}" ' if file else ""
    words = escape(alternative)
    below = f'<p class="caption">{escape(caption)}</p>' if caption else ""
    return Shown(
        f'<figure><img {drawn}src="{source}" alt="{words}"><figcaption><p>{words}</p>{below}</figcaption></figure>',
        f"Figure: {alternative}",
    )


def figure(drawn: "Figure", alternative: str, caption: str = "") -> Shown:
    """A figure in the house's style; `alternative` says what it finds, for those who do not see it and those who do.

    The picture is the same for the same data. Raises BadInput without alternative text.
    """
    if not alternative.strip():
        raise BadInput("the figure has no alternative text: say in a sentence what it finds")
    return _picture(svg(drawn, alternative, caption or alternative), alternative, caption)


def study_figure(study: str, name: str) -> Shown:
    """A figure that a study drew, with the words that the study has for it.

    Raises BadInput where the study has no results or no such figure.
    """
    folder = checkout().results / study
    try:
        words = json.loads((folder / DESCRIPTION).read_text(encoding="utf-8"))["figures"][name]
        drawing = (folder / name).read_text(encoding="utf-8")
    except (OSError, KeyError):
        raise BadInput(f"study {study} has no figure {name}: run `rkverify run {study}`") from None
    return _picture(drawing, words["alternative"], words["caption"], f"{study}/{name}")


def table(rows: Iterable[Mapping[str, Any]], caption: str) -> Shown:
    """Rows (dicts with the same keys) as a table under its caption; numbers with five digits, fractions as they are.

    >>> table([{"R": 1.5, "stable": True}], "One row.")
    One row.
    R    stable
    1.5  yes
    """
    found = [{name: _cell(value) for name, value in row.items()} for row in rows]
    if not found:
        raise BadInput(f"the table {caption!r} has no rows: give at least one")
    names = list(found[0])
    widths = [max(len(name), *(len(row[name]) for row in found)) for name in names]
    lines = [names, *([row[name] for name in names] for row in found)]
    text = "\n".join("  ".join(c.ljust(w) for c, w in zip(line, widths, strict=True)).rstrip() for line in lines)
    head = "".join(f'<th scope="col">{escape(name)}</th>' for name in names)
    body = "".join("<tr>" + "".join(f"<td>{escape(row[name])}</td>" for name in names) + "</tr>" for row in found)
    group = f'<div class="scroll" tabindex="0" role="group" aria-label="{escape(caption)}">'
    return Shown(
        f"{group}<table><caption>{escape(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>",
        f"{caption}\n{text}",
    )


def _cell(value: Any) -> str:
    if value is None or isinstance(value, str):
        return value or ""
    if type(value).__name__ in ("bool", "bool_"):
        return "yes" if value else "no"
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else f"{value:.5g}"
    return str(value)
