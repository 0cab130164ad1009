"""Figure 2: Lagrangian and semi-Lagrangian kernel supports, and the nodes under them, before and after a computed deformation."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from rkverify.certify.motions import flexure, turn
from rkverify.certify.pictures import supports
from rkverify.certify.pictures.block import Block
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

MARKS: dict[str, dict[str, Any]] = {
    "kept": {"marker": "o", "color": "#000000", "markersize": 5},
    "lost": {"marker": "X", "color": LINES[2]["color"], "markersize": 7, "markeredgecolor": "#000000", "markeredgewidth": 0.5},
    "gained": {"marker": "D", "color": "#FFFFFF", "markersize": 5, "markeredgecolor": LINES[1]["color"], "markeredgewidth": 1.5},
    "outside": {"marker": ".", "color": "#9A9A9A", "markersize": 4},
}  # fmt: skip


@dataclass(frozen=True)
class Parameters:
    """Nodes per side, support radius, seed, place near the node that is drawn, times (the last is drawn), points and lines drawn."""

    per_side: int = 9
    support: str = "5/2"
    seed: int = 20061
    near: tuple[str, str] = ("1", "0")
    times: tuple[str, ...] = ("0", "3/20", "3/10", "9/20", "3/5")
    corners: int = 61
    lines: int = 10


def _block(p: Parameters) -> tuple[Block, int]:
    """The nodes, and the one that is drawn."""
    block = Block(p.per_side, Fraction(p.support), p.seed)
    return block, block.node_at(tuple(map(Fraction, p.near)))


def compute(p: Parameters) -> Tables:
    """Memberships of one node's supports, counts over time for one and for all, and the curves to draw."""
    block, centre = _block(p)
    times = [Fraction(t) for t in p.times]
    return {
        "members": table(
            supports.memberships(block, centre, flexure(times[-1])),
            [
                ("node", "", "node J"),
                ("X1", "length", "place before"),
                ("X2", "length", "place before"),
                ("x1", "length", "place after"),
                ("x2", "length", "place after"),
                ("lagrangian", "", "what became of it under the Lagrangian kernel of the node drawn"),
                ("semi_lagrangian", "", "and under the semi-Lagrangian one"),
            ],
            f"Nodes before and after, t = {p.times[-1]}; supports of node {centre}.",
            Numeric(1e-12, 1e-14, "one rounding of a rational"),
        ),
        "counts": table(
            supports.counts(block, centre, (flexure, turn), times),
            [
                ("motion", "", "map from X to x"),
                ("time", "", "time t of the motion"),
                ("centres", "", "one: the node drawn; all: the sum over all nodes"),
                ("before", "", "nodes under the kernel before, its own node included"),
                ("lagrangian_kept", "", "of the Lagrangian support, X found back from x: nodes kept"),
                ("lagrangian_lost", "", "lost"),
                ("lagrangian_gained", "", "gained"),
                ("semi_kept", "", "of the semi-Lagrangian support: nodes kept"),
                ("semi_lost", "", "lost"),
                ("semi_gained", "", "gained"),
                ("image_differs", "", "nodes for which the image of the circle, as a polygon, says otherwise than X"),
            ],
            "Nodes kept, lost and gained, by exact distances.",
            Exact(),
        ),
        "shapes": table(
            supports.shapes(block, centre, flexure, times),
            [
                ("time", "", "time t of the motion"),
                ("longest", "1", "largest distance of the Lagrangian support's edge from the moved node over a"),
                ("shortest", "1", "smallest"),
                ("area", "1", "area over pi a^2, of a polygon of many corners"),
            ],
            "The Lagrangian support in the deformed plane; for the semi-Lagrangian one all three are 1.",
            Numeric(1e-9, 1e-12, "sums of a few thousand products in double precision"),
        ),
        "outlines": table(
            supports.outlines(block, centre, flexure, times[-1], p.corners, p.lines),
            [
                ("curve", "", "number of the curve"),
                ("kind", "", "edge of the block, material line, or edge of the support"),
                ("X1", "length", "before"),
                ("X2", "length", "before"),
                ("x1", "length", "after"),
                ("x2", "length", "after"),
            ],
            "Material curves before and after.",
            Numeric(1e-12, 1e-13, "a few operations in double precision"),
        ),
    }


def _last(p: Parameters, tables: Tables, centres: str) -> "pd.Series[int]":
    frame = tables["counts"].frame
    deformed = frame["motion"] == flexure(0).name
    return frame[deformed & (frame["time"] == p.times[-1]) & (frame["centres"] == centres)].iloc[0]


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Before; after with the Lagrangian support; after with the semi-Lagrangian one."""
    members, outlines, centre = tables["members"].frame, tables["outlines"].frame, _block(p)[1]
    figure = new_figure(10.6, 3.7)
    before, lagrangian, semi = figure.subplots(1, 3, width_ratios=(1.0, 1.35, 1.35))
    panels = (
        (before, "X", None, "(a) undeformed: one support"),
        (lagrangian, "x", "lagrangian", "(b) Lagrangian: |X − X$_I$| < a"),
        (semi, "x", "semi_lagrangian", "(c) semi-Lagrangian: |x − x$_I$| < a"),
    )
    for axes, letter, kind, title in panels:
        _material(axes, outlines, letter)
        support = outlines[outlines["kind"] == "support"]
        if kind == "semi_lagrangian":
            place = members.loc[centre, ["x1", "x2"]]
            axes.add_patch(Circle(tuple(place), float(Fraction(p.support)), facecolor="#DDE8F0", edgecolor="#000000", linewidth=1.6, zorder=1))  # fmt: skip
            axes.plot(support["x1"], support["x2"], color="#000000", linewidth=1, linestyle=":", zorder=2)
        else:
            axes.fill(support[f"{letter}1"], support[f"{letter}2"], facecolor="#DDE8F0", edgecolor="#000000", linewidth=1.6, zorder=1)  # fmt: skip
        words = members[kind] if kind else members["lagrangian"]
        for word, style in MARKS.items():
            part = members[words == word]
            axes.plot(part[f"{letter}1"], part[f"{letter}2"], linestyle="none", zorder=3, label=word, **style)
        x1, x2 = members.loc[centre, [f"{letter}1", f"{letter}2"]]
        axes.plot(
            x1, x2, "o", markersize=11, markerfacecolor="none", markeredgecolor="#000000", zorder=4, label="node I"
        )
        axes.set_title(title, fontsize=9)
        axes.set(xlabel=f"${letter}_1$  (length)", ylabel=f"${letter}_2$  (length)")
        axes.set_aspect("equal")
        axes.grid(False)
    figure.legend(*semi.get_legend_handles_labels(), loc="outside lower center", ncols=5)
    one, everyone = _last(p, tables, "one"), _last(p, tables, "all")
    shape = tables["shapes"].frame.iloc[-1]
    caption = (
        f"Figure 2 from a computed motion, {flexure(0).name}: x_1 = (1 + t) X_1, x_2 = X_2/(1 + t) + t x_1^2/6, which keeps areas, at t = {p.times[-1]}. {p.per_side} by {p.per_side} nodes about 1 apart, moved by up to a quarter, seed {p.seed}; "
        f"a = {p.support}; node I = {centre}. (a) {one['before']} nodes under the kernel, node I among them. (b) The image of the support keeps {one['lagrangian_kept']}, loses {one['lagrangian_lost']} and gains {one['lagrangian_gained']}; its edge is {shape['shortest']:.2f} a to {shape['longest']:.2f} a from the node. "
        f"(c) The circle about the moved node keeps {one['semi_kept']}, loses {one['semi_lost']} and gains {one['semi_gained']}; dotted: the Lagrangian support. All parameters and the motion are ours: the paper's figure is a sketch. Grey lines move with the material."
    )
    alternative = (
        f"A Lagrangian support deforms with the material and keeps {one['lagrangian_kept']} of its {one['before']} nodes; a semi-Lagrangian one stays a circle and keeps {one['semi_kept']}, loses {one['semi_lost']} and gains {one['semi_gained']}. "
        f"Drawn are a block of {p.per_side} by {p.per_side} nodes with a circle around one of them, and the same block after the motion, in which the circle's image has its edge {shape['shortest']:.2f} a to {shape['longest']:.2f} a from the node. "
        f"The semi-Lagrangian support is a circle of the same radius a = {p.support}: kept nodes are dots, lost ones crosses and gained ones diamonds. Over all nodes {everyone['semi_lost']} of {everyone['before']} memberships are lost."
    )
    return {"figure2": Drawing(figure, caption, alternative)}


def _material(axes: Axes, outlines: pd.DataFrame, letter: str) -> None:
    for (_, kind), curve in outlines.groupby(["curve", "kind"], sort=False):
        if kind != "support":
            style: dict[str, Any] = (
                {"color": "#606060", "linewidth": 1.2} if kind == "edge" else {"color": "#DADADA", "linewidth": 0.6}
            )
            axes.plot(curve[f"{letter}1"], curve[f"{letter}2"], zorder=2 if kind == "edge" else 0, **style)


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What each support does with its nodes."""
    frame, shapes = tables["counts"].frame, tables["shapes"].frame
    one, everyone = _last(p, tables, "one"), _last(p, tables, "all")
    keeps = bool((frame[["lagrangian_lost", "lagrangian_gained", "image_differs"]] == 0).all(axis=None))
    exchanged = frame["semi_lost"] + frame["semi_gained"]
    rigid, moving = frame["motion"] == turn(0).name, frame["time"] != "0"
    stays = bool((exchanged[rigid | ~moving] == 0).all())
    exchanges = bool((exchanged[~rigid & moving] > 0).all())
    last = shapes.iloc[-1]
    deforms = bool(last["longest"] > 1 > last["shortest"])
    area = float((shapes["area"] / shapes["area"].iloc[0] - 1).abs().max())
    tried = f"{p.per_side}^2 jittered nodes, a = {p.support}, every node; {flexure(0).name} and {turn(0).name} at t = {', '.join(p.times)}"
    return [
        Statement(
            "lagrangian",
            ("F2", "C23"),
            f"In the deformed plane the Lagrangian support is the image of the circle, from {last['shortest']:.3f} a to {last['longest']:.3f} a wide about its node and of the circle's area, as det F = 1; it holds the same {one['before']} nodes, and that for every node: {everyone['lagrangian_kept']} of {everyone['before']} memberships are kept and {everyone['lagrangian_gained']} gained, by the material coordinates and by the image as a polygon.",
            keeps and deforms and area < 1e-6,
            tried,
            "exact",
        ),
        Statement(
            "semi_lagrangian",
            ("F2", "C23"),
            f"The semi-Lagrangian support stays a circle about the moved node: of {one['before']} nodes it keeps {one['semi_kept']}, loses {one['semi_lost']} and gains {one['semi_gained']} by t = {p.times[-1]}; all nodes together keep {everyone['semi_kept']} of {everyone['before']} memberships, lose {everyone['semi_lost']} and gain {everyone['semi_gained']}. In a rigid turn nothing is exchanged.",
            stays and exchanges,
            tried,
            "exact",
            float((everyone["semi_lost"] + everyone["semi_gained"]) / everyone["before"]),
            "exchanged memberships over those before",
        ),
    ]


STUDY = Study(
    "Figure 2: Lagrangian and semi-Lagrangian kernel supports",
    Parameters(),
    Parameters(per_side=7, near=("1", "0"), times=("0", "3/5"), corners=31),
    compute,
    judge,
    draw,
)
