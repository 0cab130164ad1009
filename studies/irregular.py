"""Finite chains of uneven nodes in one dimension: does the verdict of the uniform infinite lattice hold?"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from rkverify.stability import irregular
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Parameters:
    """Methods (integration, derivative), support ratios, stresses, how far nodes are off the lattice, nodes, seeds."""

    methods: tuple[tuple[str, str], ...] = (("scni", "full"), ("dni", "full"), ("dni", "diffuse"))
    support_ratios: tuple[str, ...] = ("3/2", "9/5")
    stresses: tuple[str, ...] = ("-1/2", "1/2")
    jitters: tuple[str, ...] = ("0", "1/20", "1/10", "1/5")
    nodes: int = 25
    seeds: int = 4


def compute(p: Parameters) -> Tables:
    """The largest growth of every chain."""
    cases: Any = [(i, d, R) for i, d in p.methods for R in p.support_ratios]
    why = "eigenvalues of a matrix of order 125 in double precision, none of them multiple where it is not zero"
    return {
        "growth": table(
            irregular.rows(cases, p.stresses, p.jitters, p.nodes, p.seeds),
            [
                ("integration", "", "scni or dni"),
                ("derivative", "", "reading of the derivative, for DNI"),
                ("support_ratio", "1", "R = a/h"),
                ("stress_ratio", "1", "sigma/C^sigma"),
                ("jitter", "1", "nodes are off the lattice by up to this times h"),
                ("least", "1", "least growth h/c over the seeds"),
                ("largest", "1", "largest growth h/c over the seeds"),
                ("unstable", "seeds", f"of {p.seeds}, in which the chain grows"),
                (
                    "measured_agrees",
                    "",
                    "whether the first seed's nonlinear growth is the eigenvalue to one in a thousand",
                ),
            ],
            f"Largest growth of chains of {p.nodes} nodes with free ends under dead loads, at rest, without N.",
            Numeric(1e-4, 1e-4, why),
        )
    }


def _name(integration: str, derivative: str) -> str:
    return "SCNI" if integration == "scni" else f"DNI, {derivative} derivative"


def _changed(part: "pd.DataFrame", seeds: int) -> "pd.DataFrame":
    """The settings whose verdict is not the one without jitter in every seed."""
    keys = ["support_ratio", "stress_ratio"]
    even = part[part["jitter"] == "0"].set_index(keys)["unstable"]
    grows = part.set_index(keys).index.map(even) > 0
    return part[(part["unstable"] != seeds) & grows | (part["unstable"] != 0) & ~grows]


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Growth over jitter."""
    frame = tables["growth"].frame
    figure = new_figure(10.0, 3.8)
    panels = figure.subplots(1, len(p.methods), sharey=True)
    for axes, (integration, derivative) in zip(panels, p.methods, strict=True):
        part = frame[(frame["integration"] == integration) & (frame["derivative"] == derivative)]
        for style, marker, (keys, group) in zip(
            LINES, "os^D", part.groupby(["support_ratio", "stress_ratio"], sort=False), strict=False
        ):
            x = [float(Fraction(j)) for j in group["jitter"]]
            axes.plot(x, group["largest"], marker=marker, label=f"R = {keys[0]}, σ/C = {keys[1]}", **style)
            axes.fill_between(x, group["least"], group["largest"], color=style["color"], alpha=0.15, linewidth=0)
        axes.set(xlabel="nodes off the lattice by up to … h  (1)", title=_name(integration, derivative))
    panels[0].set_ylabel("largest growth h/c  (1)")
    panels[0].legend(fontsize=8)
    caption = (
        f"Largest growth of chains of {p.nodes} uneven nodes with free ends under dead loads, least to largest over {p.seeds} seeds. All parameters are ours; "
        "cubic kernel, linear basis, Truesdell rate, supports R h for all nodes, cells half-way between nodes."
    )
    words = []
    for integration, derivative in p.methods:
        part = frame[(frame["integration"] == integration) & (frame["derivative"] == derivative)]
        words.append(f"{_name(integration, derivative)}: {len(_changed(part, p.seeds))} of {len(part)} settings")
    alternative = f"Where unevenness changes the verdict of the uniform lattice: {'; '.join(words)}. Largest growth {frame['largest'].max():.3g} c/h."
    return {"irregular": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Whether every uneven chain has the verdict of the lattice."""
    frame = tables["growth"].frame
    found = []
    for integration, derivative in p.methods:
        part = frame[(frame["integration"] == integration) & (frame["derivative"] == derivative)]
        changed = _changed(part, p.seeds)
        where = "".join(
            f"; at R = {r['support_ratio']}, sigma/C = {r['stress_ratio']} and jitter {r['jitter']} the chain grows in {r['unstable']} of {p.seeds} seeds, by up to {r['largest']:.3g} c/h"
            for _, r in changed.iterrows()
        )
        even = float(part[part["jitter"] == "0"]["largest"].max())
        found.append(
            Statement(
                f"verdict_{integration}_{derivative}",
                ("C75",),
                f"{_name(integration, derivative)}: {len(part) - len(changed)} of {len(part)} settings of finite chains have the verdict of the even chain{where}. The largest "
                f"growth is {even:.3g} c/h on even nodes and {float(part['largest'].max()):.3g} on uneven ones; nonlinear runs agree in {int(part['measured_agrees'].sum())}.",
                changed.empty,
                f"one dimension; R = {', '.join(p.support_ratios)}; sigma/C = {', '.join(p.stresses)}; nodes off by up to {', '.join(p.jitters)} h, {p.nodes} nodes, {p.seeds} seeds; cubic kernel, linear basis",
                "sampled",
                reading=f"one dimension, {_name(integration, derivative)}",
            )
        )
    return found


STUDY = Study(
    "Finite chains of uneven nodes",
    Parameters(),
    Parameters(
        methods=(("scni", "full"), ("dni", "full")), support_ratios=("9/5",), jitters=("0", "1/5"), nodes=13, seeds=1
    ),
    compute,
    judge,
    draw,
)
