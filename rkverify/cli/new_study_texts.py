"""What `rkverify new-study` writes: a study that computes, draws and judges something true, and a test that can fail."""

from collections.abc import Mapping, Sequence

STUDY = '''"""{title}: say here in one line what is asked."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.arithmetic.native import Exact as Rational
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.kernel_rates import phi
from rkverify.paper.shape import shape_functions
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure


@dataclass(frozen=True)
class Parameters:
    """Support ratios R = a/h, exact."""

    support_ratios: tuple[str, ...] = ("5/4", "3/2", "7/4", "2", "5/2", "3")


def compute(p: Parameters) -> Tables:
    """Sums of kernels and of shape functions at a node of the uniform lattice."""
    K = Rational()
    rows = []
    for R in p.support_ratios:
        A = lattice(1, R, 1, K)
        x = A.nodes[middle(A)]
        kernels = sum((phi(A, x, I) for I in A.neighbours(x)), K.zero())
        shapes = sum(shape_functions(A, x).values(), K.zero())
        rows.append({{"support_ratio": R, "kernels": str(kernels), "shape_functions": str(shapes)}})
    columns = [
        ("support_ratio", "1", "R = a/h"),
        ("kernels", "1", "sum_I phi_a(x - x_I)"),
        ("shape_functions", "1", "sum_I Psi_I(x)"),
    ]
    return {{"sums": table(rows, columns, "Sums at a node of the uniform lattice, exact.", Exact())}}


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Both sums over R."""
    frame = tables["sums"].frame
    ratios = [float(Rational().number(R)) for R in frame["support_ratio"]]
    figure = new_figure(6.4, 3.0)
    axes = figure.subplots()
    sums = {{column: [float(Rational().number(s)) for s in frame[column]] for column in ("kernels", "shape_functions")}}
    axes.plot(ratios, sums["kernels"], label="kernels", **LINES[1])
    axes.plot(ratios, sums["shape_functions"], label="shape functions", **LINES[0])
    axes.set(xlabel="support ratio  R = a/h  (1)", ylabel="sum at a node  (1)")
    axes.legend()
    low, high = min(sums["kernels"]), max(sums["kernels"])
    ones = sum(value == 1 for value in sums["shape_functions"])
    alternative = f"The kernels' sum lies between {{low:.3g}} and {{high:.3g}}; the shape functions' sum is one at {{ones}} of {{len(ratios)}} support ratios."
    return {{"sums": Drawing(figure, "Cubic kernel, linear basis; the support ratios are ours.", alternative)}}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Shape functions sum to one."""
    frame = tables["sums"].frame
    ones = int((frame["shape_functions"] == "1").sum())
    tried = f"R from {{frame['support_ratio'].iloc[0]}} to {{frame['support_ratio'].iloc[-1]}}, {{len(frame)}} ratios"
    return [
        Statement(
            "sums",
            (),
            f"Shape functions sum to one at {{ones}} of {{len(frame)}} support ratios.",
            ones == len(frame),
            tried,
            "exact",
        ),
{statements}    ]


STUDY = Study("{title}", Parameters(), Parameters(support_ratios=("3/2", "7/4")), compute, judge, draw)
'''

UNDECIDED = """        Statement(
            "undecided{suffix}",
            {about},
            "Not decided yet: the study computes nothing about this.",
            None,
            tried,
            "sampled",
            layer="{layer}",
        ),
"""

TEST = '''"""{title}: say here once why what is tested decides something.

Shape functions are kernels with a correction; without it the sum is another one, so that the test can fail.
"""

import pytest

from rkverify.paths import checkout
from rkverify.workflow.discovery import load

NAME = "{name}"


@pytest.fixture(scope="module")
def study():
    return load(checkout(), NAME)


@pytest.fixture(scope="module")
def tables(study):
    return study.compute(study.quick)


def test_shape_functions_sum_to_one_and_kernels_do_not(tables) -> None:
    frame = tables["sums"].frame
    assert set(frame["shape_functions"]) == {{"1"}}
    assert "1" not in set(frame["kernels"])


def test_every_statement_is_judged_from_the_tables(study, tables) -> None:
    statements = study.judge(study.quick, tables)
    assert statements[0].holds is True
    names = [statement.name for statement in statements]
    assert len(names) == len(set(names))
'''

ROW = "| {title} | `rkverify run {name}` | `{name}/` | 1 s | byte for byte |\n"
"""The study in the README's table of results."""


def title(name: str) -> str:
    """A title to begin with.

    >>> title("my_first_study")
    'My first study'
    """
    return name.replace("_", " ").capitalize()


def study_text(name: str, about: Mapping[str, Sequence[str]]) -> str:
    """The study; about: layer ('' for none) -> entries on which it makes a statement that decides nothing yet."""
    statements = "".join(
        UNDECIDED.format(suffix=f"_{layer.replace('-', '_')}" if layer else "", about=_tuple(ids), layer=layer)
        for layer, ids in about.items()
    ).replace('            layer="",\n', "")
    return STUDY.format(title=title(name), statements=statements)


def _tuple(ids: Sequence[str]) -> str:
    listed = ", ".join(f'"{id}"' for id in ids)
    return f"({listed},)" if len(ids) == 1 else f"({listed})"


def text_of_test(name: str) -> str:
    """The test of the study."""
    return TEST.format(name=name, title=title(name))
