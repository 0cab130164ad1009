"""Results for a paper: tables as tabulars, states and numbers of statements as macros, an example that uses all of them."""

import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from io import StringIO
from pathlib import Path
from typing import Any

from rkverify.errors import BadInput
from rkverify.ledger.entries import entries
from rkverify.ledger.states import Evidence, State, counts, read_evidence, state
from rkverify.paths import Checkout
from rkverify.report.latex_text import cell, name, text
from rkverify.workflow.discovery import choose
from rkverify.workflow.files import write_atomically
from rkverify.workflow.manifest import description

NUMBERS = "rkverify-numbers.tex"
EXAMPLE = "rkverify-example.tex"
ROWS = 40
"""A table with more rows than this is data, and no table for a paper."""
LONG = 32
"""From this many characters on a column is set as a paragraph."""
FOUND = re.compile(r"(?<![\w.^/])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?:/\d+)?(?![\w^])")
"""A number in a sentence: no part of a name, an exponent or a power."""
REFERENCE = re.compile(r"\(\d+\)(?:-\(\d+\))?")
"""The number of an equation, which is no result."""
HOLDS = {True: "holds", False: "fails", None: "not decidable"}
HEAD = "% Written by `rkverify export --latex`, {of}: do not edit, write it anew."


def export(place: Checkout, names: Sequence[str], folder: Path, rows: int = ROWS) -> tuple[list[Path], list[str]]:
    """Write macros, tables and the example; returns the files, and the tables that were left out for their length.

    names: studies, all for none. Raises UnknownName, BadInput where a study has no results.
    """
    chosen = choose(place, list(names))
    for study in chosen:
        if not (place.results / study).is_dir():
            raise BadInput(f"study {study} has no results: run `rkverify run {study}`")
    evidence = read_evidence(place.results)
    states = {id: state(entry, evidence) for id, entry in entries().items()}
    found = macros(states, [e for e in evidence if e.study in chosen])
    written = {NUMBERS: _macro_file(found)}
    left_out = []
    for study in chosen:
        for file, words in description(place, study)["tables"].items():
            tex = f"rkverify-{study}-{Path(file).stem}.tex".replace("_", "-")
            content = place.results.joinpath(study, file).read_text(encoding="utf-8")
            if length(content, words) > rows:
                left_out.append(f"{study}/{file}")
            else:
                written[tex] = table(content, words, f"{study}/{file}")
    written[EXAMPLE] = example(written)
    for tex, content in written.items():
        write_atomically(folder / tex, content)
    return [folder / tex for tex in written], left_out


def macros(states: Mapping[str, State], evidence: Sequence[Evidence]) -> dict[str, str]:
    """Name of a macro -> what it writes: states of entries, layer by layer, counts, and statements with their numbers.

    Raises BadInput where two would have one name.
    """
    found: dict[str, str] = {}
    for key, value in _named(states, evidence):
        if key in found:
            raise BadInput(f"two macros would be called {key}: rename a statement of the study")
        found[key] = value
    return found


def _named(states: Mapping[str, State], evidence: Sequence[Evidence]) -> Iterator[tuple[str, str]]:
    for id, one in states.items():
        yield name(id, "State"), text(one.name)
        for layer, words in one.layers.items():
            yield name(id, layer), text(words)
    for word, count in counts(states).items():
        yield name("count", word), str(count)
    for e in evidence:
        key = (e.study, e.name)
        yield name(*key, "Verdict"), HOLDS[e.holds]
        yield name(*key, "Says"), text(e.says)
        if e.margin is not None:
            yield name(*key, "Margin"), cell(f"{e.margin:.4g}")
        for n, number in enumerate(FOUND.findall(REFERENCE.sub("", e.says)), start=1):
            yield name(*key, "Number", str(n)), cell(number)


def _macro_file(found: Mapping[str, str]) -> str:
    lines = [f"\\newcommand{{\\{key}}}{{{value}}}" for key, value in found.items()]
    return "\n".join([HEAD.format(of="states and statements"), *lines]) + "\n"


def length(content: str, words: Mapping[str, Any]) -> int:
    """How many rows a CSV file has, each point counted where a line is a curve of them."""
    header, *lines = list(csv.reader(StringIO(content)))
    return len(lines) * (1 + len(header) - len(words["columns"]))


def table(content: str, words: Mapping[str, Any], source: str) -> str:
    """A CSV file as a tabular: names of columns, units, and what they mean as comments."""
    header, *lines = list(csv.reader(StringIO(content)))
    columns = {column["name"]: column for column in words["columns"]}
    points = words["columns"][-1]  # describes the columns that the points of a curve have
    told = [columns.get(title, points)["unit"] for title in header]
    units = [f"({unit})" if unit else "" for unit in told]
    long = [any(len(line[n]) >= LONG for line in lines) for n in range(len(header))]
    shape = "".join("p{0.3\\textwidth}" if wide else "l" for wide in long)
    comments = [f"%   {title.replace('…', '...')}: {text(column['meaning'])}" for title, column in columns.items()]

    def row(cells: Sequence[str]) -> str:
        return " & ".join(cells) + " \\\\"

    body = [
        f"\\begin{{tabular}}{{{shape}}}",
        "\\hline",
        row([text(title) for title in header]),
        row([text(unit) for unit in units]),
        "\\hline",
        *(row([cell(value) for value in line]) for line in lines),
        "\\hline",
        "\\end{tabular}",
    ]
    head = [HEAD.format(of=source), f"% {text(str(words['caption']))}", *comments]
    return "\n".join([*head, *body]) + "\n"


def example(written: Mapping[str, str]) -> str:
    """A document with every table, and a sentence that is made of macros."""
    failing, all_of_them = name("count", "fails"), len(entries())
    parts = [
        HEAD.format(of="an example that compiles"),
        "\\documentclass{article}",
        "\\textwidth=180mm \\oddsidemargin=-10mm \\renewcommand{\\arraystretch}{1.25}",
        f"\\input{{{Path(NUMBERS).stem}}}",
        "\\begin{document}",
        f"Of {all_of_them} entries \\{failing}{{}} fail; C43 is: \\{name('C43', 'State')}.",
    ]
    for tex in written:
        if tex != NUMBERS:
            title = Path(tex).stem.removeprefix("rkverify-").replace("-", " ")
            parts.append(
                f"\n\\bigskip\\noindent {text(title)}\n\n\\noindent{{\\scriptsize\\input{{{Path(tex).stem}}}}}"
            )
    return "\n".join([*parts, "\\end{document}"]) + "\n"
