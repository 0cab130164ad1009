"""What a figure's alternative text finds is computed: a finding that somebody typed stays when the tables change, and then says something false.

Whoever does not see a figure has this text alone, and the pages show its first sentence below the figure. So no text may be a
constant, and each of its sentences must be filled in from something that is computed: a parameter or a constant of the module
says what was chosen, not what was found.
"""

import ast
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

from rkverify.paths import checkout

ALLOWED = {
    "says what the marks of Figure 1 are": "Arrows are normals of the edges; marks show the points of the rules ….",
    "says what is drawn in Figure 2": "The semi-Lagrangian support is a circle of the same radius a = …: kept nodes are dots, lost ones crosses and gained ones diamonds.",
}
"""Reason -> a sentence without anything computed; what is filled in from parameters is shown as …"""
HOLE = "\0"
"""Stands where something computed is filled in."""
SOURCES = sorted(checkout().studies.glob("*.py"))


def filled(expression: ast.expr) -> str:
    """What an expression puts into a sentence: a hole where it is computed, … where it has parameters and constants alone."""
    names = {node.id for node in ast.walk(expression) if isinstance(node, ast.Name)}
    return HOLE if any(name != "p" and not name.isupper() for name in names) else "…"


def template(expression: ast.expr) -> str:
    """A text with holes in place of what the build fills in."""
    if isinstance(expression, ast.Constant):
        return str(expression.value)
    if isinstance(expression, ast.JoinedStr):
        return "".join(map(template, expression.values))
    if isinstance(expression, ast.BinOp):
        return template(expression.left) + template(expression.right)
    if isinstance(expression, ast.FormattedValue):
        return filled(expression.value)
    return filled(expression)


def branches(expression: ast.expr) -> Iterator[ast.expr]:
    """The texts of which one is chosen."""
    if isinstance(expression, ast.IfExp):
        yield from chain(branches(expression.body), branches(expression.orelse))
    else:
        yield expression


def expressions(tree: ast.Module) -> Iterator[ast.expr]:
    """Every alternative text of a module: handed to a Drawing, given a name first, or returned by a function of that name."""
    for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
        nodes = list(ast.walk(function))
        named = {"alternative"}
        for call in (node for node in nodes if isinstance(node, ast.Call)):
            if isinstance(call.func, ast.Name) and call.func.id == "Drawing":
                given = {word.arg: word.value for word in call.keywords}
                text = given.get("alternative") or call.args[2]
                if isinstance(text, ast.Name):
                    named.add(text.id)
                else:
                    yield from branches(text)
        for node in nodes:
            if isinstance(node, ast.Assign) and any(isinstance(t, ast.Name) and t.id in named for t in node.targets):
                yield from branches(node.value)
            if isinstance(node, ast.Return) and node.value and function.name.endswith("_alternative"):
                yield from branches(node.value)


def typed(source: str) -> list[str]:
    """The sentences of a module's alternative texts that hold nothing computed."""
    sentences = (
        sentence.removesuffix(".") + "."
        for expression in expressions(ast.parse(source))
        for sentence in template(expression).split(". ")
    )
    return [sentence for sentence in sentences if HOLE not in sentence and sentence not in ALLOWED.values()]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_every_sentence_of_an_alternative_text_holds_something_computed(path: Path) -> None:
    assert typed(path.read_text(encoding="utf-8")) == []


def test_every_module_with_drawings_has_texts_that_were_looked_at() -> None:
    """Otherwise the test above would pass where it finds nothing to read; `_discriminants` draws with its callers' texts too."""
    sources = {path.stem: path.read_text(encoding="utf-8") for path in SOURCES}
    drawn = {name for name, source in sources.items() if " Drawing(" in source}
    assert len(drawn) > 20
    assert [name for name in drawn if not list(expressions(ast.parse(sources[name])))] == []


def test_every_exception_is_used() -> None:
    """An exception that no figure needs any more would let another one's finding through."""
    texts = [template(e) for path in SOURCES for e in expressions(ast.parse(path.read_text(encoding="utf-8")))]
    assert [reason for reason, sentence in ALLOWED.items() if not any(sentence.rstrip(".") in t for t in texts)] == []


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('"Stress runs in loops that harden."', ["Stress runs in loops that harden."]),
        ('f"D is negative over most wave numbers at h = {p.spacings[0]}."', ["D is negative over most wave numbers at h = …."]),
        ('f"All pass below {PASSED:g}. " f"Off by {least:.2g}."', ["All pass below …."]),
        ('f"Off by {least:.2g}. " "Long waves do not grow."', ["Long waves do not grow."]),
        ('f"{n} of {len(frame)} grow." if n else "None grows."', ["None grows."]),
        ('f"{shared.verdicts(p, tables)} fall. " + "; ".join(words) + "."', []),
    ],
)  # fmt: skip
def test_a_typed_finding_is_found(text: str, found: list[str]) -> None:
    """The twin: texts that were in the studies once, as an argument and by way of a name."""
    handed = f"def draw(p, tables):\n    return Drawing(figure, caption, {text})\n"
    named = f"def draw(p, tables):\n    words = {text}\n    return Drawing(figure, caption, alternative=words)\n"
    assert typed(handed) == typed(named) == found
