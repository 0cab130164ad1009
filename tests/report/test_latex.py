"""rkverify export --latex: what a paper takes over must say what the results say, and compile.

A number that is copied by hand from a table into a paper is the one that nobody recomputes.
"""

import csv
import io
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from rkverify.errors import BadInput, UnknownName
from rkverify.ledger.entries import entries
from rkverify.ledger.states import Evidence, counts, read_evidence, states
from rkverify.paths import checkout
from rkverify.report import latex
from rkverify.report.latex_text import cell, name, text

STUDIES = ["turns", "gradients", "theorems"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    found = tmp_path_factory.mktemp("a paper")
    latex.export(checkout(), STUDIES, found, rows=60)
    return found


@pytest.fixture(scope="module")
def macros(folder) -> dict[str, str]:
    lines = (folder / latex.NUMBERS).read_text(encoding="utf-8").splitlines()[1:]
    return dict(re.fullmatch(r"\\newcommand\{\\([A-Za-z]+)\}\{(.*)\}", line).groups() for line in lines)


def test_states_are_the_computed_ones(macros) -> None:
    found = states(checkout().results)
    for id in entries():
        assert macros[name(id, "State")] == found[id].name
        assert {macros[name(id, layer)] for layer in found[id].layers} == {text(w) for w in found[id].layers.values()}
    assert macros["rkvCfortythreeState"] == found["C43"].name
    for word, count in counts(found).items():
        assert macros[name("count", word)] == str(count)


def test_statements_come_with_verdict_margin_and_numbers(macros) -> None:
    for e in read_evidence(checkout().results):
        key = name(e.study, e.name)
        if e.study not in STUDIES:
            assert f"{key}Says" not in macros
            continue
        assert macros[f"{key}Says"] == text(e.says)
        assert macros[f"{key}Verdict"] == {True: "holds", False: "fails", None: "not decidable"}[e.holds]
        assert (f"{key}Margin" in macros) == (e.margin is not None)
    e = next(e for e in read_evidence(checkout().results) if (e.study, e.name) == ("gradients", "bandwidth"))
    counted = re.search(r"at (\d+) of (\d+) support ratios", e.says)
    numbers = [v for k, v in macros.items() if k.startswith("rkvGradientsBandwidthNumber")]
    assert [f"${n}$" for n in counted.groups()] == [n for n in numbers if n in {f"${m}$" for m in counted.groups()}]


def test_equation_numbers_and_names_are_no_numbers_of_a_sentence() -> None:
    says = "(74) and (75)-(77) of C43 at R = 3/2, h^2, x_1: 12 of 40 differ by -1.5e-07 or 2.25."
    e = Evidence("s", "n", (), says, True, "", "exact", None, "", "", "", ())
    found = [v for k, v in latex.macros({}, [e]).items() if "Number" in k]
    assert found == ["$3/2$", "$12$", "$40$", r"$-1.5\times 10^{-7}$", "$2.25$"]


def test_a_table_has_every_cell_of_its_file(folder) -> None:
    content = (checkout().results / "turns" / "turns.csv").read_text(encoding="utf-8")
    rows = list(csv.reader(io.StringIO(content)))
    tex = (folder / "rkverify-turns-turns.tex").read_text(encoding="utf-8")
    body = [line.removesuffix(" \\\\").split(" & ") for line in tex.splitlines() if line.endswith("\\\\")]
    assert body[0] == [text(title) for title in rows[0]]
    assert body[2:] == [[cell(value) for value in row] for row in rows[1:]]


def test_long_tables_are_left_out_and_named(tmp_path) -> None:
    written, left_out = latex.export(checkout(), ["gradients"], tmp_path, rows=5)
    assert left_out == ["gradients/widths.csv"]
    assert "rkverify-gradients-sums.tex" in {path.name for path in written}
    assert not (tmp_path / "rkverify-gradients-widths.tex").exists()


def test_nothing_outside_ascii_is_left(folder) -> None:
    for path in folder.glob("*.tex"):
        assert path.read_text(encoding="utf-8").isascii(), path.name


def test_every_study_can_be_exported(tmp_path) -> None:
    """A character without a LaTeX form, or two statements with one macro, would only show when somebody exports."""
    written, _ = latex.export(checkout(), [], tmp_path)
    assert len(written) > len(list(checkout().results.glob("*/statements.json")))


def test_what_cannot_be_exported_is_told(tmp_path) -> None:
    with pytest.raises(UnknownName, match="unknown study 'no_such'"):
        latex.export(checkout(), ["no_such"], tmp_path)
    with pytest.raises(BadInput, match="there is no LaTeX for '漢'"):
        text("漢")
    same = [Evidence("s", n, (), "", True, "", "exact", None, "", "", "", ()) for n in ("a_b", "a-b")]
    with pytest.raises(BadInput, match="two macros would be called rkvSABVerdict"):
        latex.macros({}, same)


def test_names_of_different_entries_differ() -> None:
    assert len({name(id, "State") for id in entries()}) == len(entries())


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="no pdflatex: apt-get install texlive-latex-base")
def test_the_example_compiles(folder) -> None:
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", latex.EXAMPLE],
        cwd=folder, capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:]
    log = (folder / latex.EXAMPLE).with_suffix(".log").read_text(encoding="latin-1")
    assert "Missing character" not in log
    assert "Undefined control sequence" not in log
    assert (folder / latex.EXAMPLE).with_suffix(".pdf").stat().st_size > 10_000
