"""Figure 1: nodal representative cells of Voronoi type in a domain that is not convex, with boundary, outward normals and area."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd
from matplotlib.axes import Axes

from rkverify.certify.pictures import cells
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

FILL = {"interior": "#CFE0EE", "clipped": "#F3D9C6"}
THIN_AND_THICK: tuple[tuple[bool, dict[str, Any]], ...] = ((False, {"linewidth": 1.6}), (True, {"linewidth": 3.2}))
POINTS: tuple[dict[str, Any], ...] = (
    {"marker": "s", "markersize": 5, "color": "#000000"},
    {"marker": "o", "markersize": 4.5, "color": LINES[2]["color"], "markerfacecolor": "#FFFFFF"},
)


@dataclass(frozen=True)
class Parameters:
    """Kind of the nodes, spacing, support over the distance to a cell's farthest vertex, seed, step along a normal, rules drawn."""

    nodes: str = "jittered"
    spacing: float = 0.2
    support_ratio: float = 2.5
    seed: int = 104
    step: float = 1e-3
    rules: tuple[str, ...] = ("trapezoid", "gauss:2")


PLACES = Numeric(1e-9, 1e-12, "vertices are solutions of well-conditioned linear equations; residuals are rounding")


def compute(p: Parameters) -> Tables:
    """The cells, the two that are drawn large, and the sums over them."""
    picture = cells.picture(p.nodes, p.spacing, p.support_ratio, p.seed)
    return {
        "outlines": table(
            cells.outlines(picture),
            [
                ("node", "", "node L"),
                ("ring", "", "ring of the cell, the first its outline"),
                ("vertex", "", "vertex, in order"),
                ("x1", "length", "place of the vertex"),
                ("x2", "length", "place of the vertex"),
            ],
            "All cells Omega_L.",
            PLACES,
        ),
        "nodes": table(
            cells.places(picture),
            [
                ("node", "", "node L"),
                ("x1", "length", "place of the node"),
                ("x2", "length", "place of the node"),
                ("boundary", "", "whether the cell has an edge on the boundary of the domain"),
                ("area", "length^2", "A_L, as the code takes it"),
                ("by_vertices", "length^2", "area inside the ring of vertices, by shapely"),
            ],
            "Nodes and the areas of their cells.",
            PLACES,
        ),
        "edges": table(
            cells.edges(picture),
            [
                ("cell", "", "interior or clipped"),
                ("node", "", "node L"),
                ("start_1", "length", "one end"),
                ("start_2", "length", "one end"),
                ("end_1", "length", "other end"),
                ("end_2", "length", "other end"),
                ("n1", "1", "outward normal N"),
                ("n2", "1", "outward normal N"),
                ("length", "length", "length of the edge"),
                ("beyond", "", "node on the other side, -1 outside the domain"),
            ],
            "Edges of Gamma_L of the two cells.",
            PLACES,
        ),
        "rule_points": table(
            cells.rule_points(picture, p.rules),
            [
                ("cell", "", "interior or clipped"),
                ("rule", "", "rule on an edge"),
                ("x1", "length", "place of the point"),
                ("x2", "length", "place of the point"),
                ("share", "1", "share of the cell's perimeter that the point stands for"),
            ],
            "Points of edge rules on the two cells.",
            PLACES,
        ),
        "residuals": table(
            cells.residuals(picture),
            [
                ("cell", "", "interior, clipped, or all: the largest over all cells"),
                ("rule", "", "rule on an edge"),
                ("closing", "1", "|sum of the outward area vectors| over the perimeter"),
                ("unclipped", "1", "the same without the edges on the boundary of the domain"),
                ("constant", "1", "A^(1/2) |sum_I b_iI|"),
                ("linear", "1", "max |sum_I b_iI x_jI - delta_ij|"),
                ("nodes", "", "nodes with b_iI other than 0"),
            ],
            "Sums over the boundary of a cell; cubic kernel, order 1.",
            PLACES,
        ),
        "whole": table(
            [cells.whole(picture, p.step)],
            [
                ("cells", "", "cells"),
                ("edges", "", "their edges, those between two counted once"),
                ("wrong", "", "steps along a normal, and back, that do not end in the cells that share the edge"),
                ("domain", "length^2", "area of the domain"),
                ("sum", "length^2", "sum of A_L"),
            ],
            f"All cells; steps of {p.step:g} edge lengths along the normals, judged by nearest nodes.",
            PLACES,
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The domain with its cells, and the two cells with normals and points."""
    frames = {name: t.frame for name, t in tables.items()}
    figure = new_figure(10.6, 4.2)
    whole, *large = figure.subplots(1, 3, width_ratios=(1.0, 1.0, 1.0))
    nodes = frames["nodes"].set_index("node")
    chosen = frames["edges"].groupby("cell", sort=False)["node"].first()
    names = {node: cell for cell, node in chosen.items()}
    for (node, _), ring in frames["outlines"].groupby(["node", "ring"]):
        whole.fill(ring["x1"], ring["x2"], facecolor=FILL.get(names.get(node, ""), "#FFFFFF"), edgecolor="#8A8A8A", linewidth=0.7)  # fmt: skip
    whole.plot(nodes["x1"], nodes["x2"], "o", markersize=2.4, color="#000000")
    for node, cell in names.items():
        whole.annotate(
            {"interior": "b", "clipped": "c"}[cell], tuple(nodes.loc[node, ["x1", "x2"]]), (3, 2), textcoords="offset points", fontsize=9, fontweight="bold",
        )  # fmt: skip
    whole.set_title("(a) domain, nodes and cells", fontsize=9)
    for axes, cell, title in zip(large, FILL, ("(b) a cell in the interior", "(c) a cell clipped at a corner of the boundary"), strict=True):  # fmt: skip
        _draw_cell(axes, cell, frames, nodes)
        axes.set_title(title, fontsize=9)
    for axes in figure.axes:
        axes.set_aspect("equal")
        axes.set_facecolor("#EDEDED")
        axes.grid(False)
        axes.set(xlabel="$X_1$  (length)")
    whole.set_ylabel("$X_2$  (length)")
    handles, labels = large[1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8)
    areas = nodes["area"]
    worst = frames["residuals"].set_index(["cell", "rule"])
    sentences = [
        f"({letter}) node {chosen[cell]}, area {areas[chosen[cell]]:.5f}, {int((frames['edges']['cell'] == cell).sum())} edges, "
        f"outward area vectors that add up to zero within {rounding(float(worst.loc[(cell, p.rules[0]), 'closing']))} of the perimeter, smoothed gradient of {int(worst.loc[(cell, p.rules[0]), 'nodes'])} nodes by the {p.rules[0]}"
        for letter, cell in zip("bc", FILL, strict=True)
    ]
    caption = (
        f"Figure 1 from computed cells: {len(nodes)} {p.nodes} nodes, spacing {p.spacing:g}, seed {p.seed}, in an L of sides 2 and 1 with a square hole of side 0.4; "
        f"Voronoi cells cut off at the boundary. {'; '.join(sentences)}. Grey is outside the domain; arrows: outward normals N of the edges, all drawn of one length. Points of the edge rules "
        f"{' and '.join(p.rules)}. All of it is ours: the paper draws one cell by hand and gives no numbers; cubic kernel, order 1, supports {p.support_ratio:g} times the distance to the farthest vertex of a node's cell."
    )
    interior, clipped = (chosen[cell] for cell in FILL)
    edges = frames["edges"]["cell"].value_counts()
    closing = float(frames["residuals"]["closing"].max())
    alternative = (
        f"The edges of a cell times their outward normals add up to zero within {rounding(closing)} of the perimeter, in the interior (area {areas[interior]:.5f}) and where a corner of the boundary cuts in (area {areas[clipped]:.5f}). "
        f"An L-shaped domain with a square hole is drawn with its {len(nodes)} cells, whose areas add up to {areas.sum():.6g}. Enlarged are a cell of {edges['interior']} edges in the interior and one of {edges['clipped']} edges at "
        f"a corner of the hole. Arrows are normals of the edges; marks show the points of the rules {' and '.join(p.rules)}."
    )
    return {"figure1": Drawing(figure, caption, alternative)}


def _draw_cell(axes: Axes, cell: str, frames: Mapping[str, pd.DataFrame], nodes: pd.DataFrame) -> None:
    edges = frames["edges"][frames["edges"]["cell"] == cell]
    points = frames["rule_points"][frames["rule_points"]["cell"] == cell]
    node = edges["node"].iloc[0]
    for (other, _), ring in frames["outlines"].groupby(["node", "ring"]):
        axes.fill(ring["x1"], ring["x2"], facecolor=FILL[cell] if other == node else "#FFFFFF", edgecolor="#B0B0B0", linewidth=0.7)  # fmt: skip
    for outer, style in THIN_AND_THICK:
        part = edges[(edges["beyond"] < 0) == outer]
        label = "$\\Gamma_L$ on the boundary of the domain" if outer else "$\\Gamma_L$ between cells"
        axes.plot(part[["start_1", "end_1"]].T.values, part[["start_2", "end_2"]].T.values, color="#000000", solid_capstyle="butt", label=[label, *["_"] * (len(part) - 1)] if len(part) else [], **style)  # fmt: skip
    middle = edges[["start_1", "start_2"]].to_numpy() / 2 + edges[["end_1", "end_2"]].to_numpy() / 2
    axes.quiver(*middle.T, edges["n1"], edges["n2"], color=LINES[1]["color"], angles="xy", scale_units="inches", scale=2.6, width=0.008, zorder=4, label="outward normal N")  # fmt: skip
    for rule, style in zip(points["rule"].unique(), POINTS, strict=True):
        part = points[points["rule"] == rule]
        axes.plot(part["x1"], part["x2"], linestyle="none", label=f"points of the rule {rule}", zorder=5, **style)
    x1, x2 = nodes.loc[node, ["x1", "x2"]]
    axes.plot(nodes["x1"], nodes["x2"], "o", markersize=3, color="#8A8A8A", zorder=3)
    axes.plot(x1, x2, "o", markersize=5, color="#000000", zorder=6)
    axes.annotate("$\\mathbf{X}_L$", (x1, x2), (5, 4), textcoords="offset points", zorder=6)
    axes.text(0.03, 0.03, f"L = {node},  $A_L$ = {nodes.loc[node, 'area']:.5f}", transform=axes.transAxes, backgroundcolor="#FFFFFF")  # fmt: skip
    low, high = edges[["start_1", "start_2"]].min(), edges[["start_1", "start_2"]].max()
    centre, half = (low + high) / 2, 0.78 * (high - low).max()
    axes.set(xlim=(centre.iloc[0] - half, centre.iloc[0] + half), ylim=(centre.iloc[1] - half, centre.iloc[1] + half))


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Areas, normals, closing and sums."""
    frames = {name: t.frame for name, t in tables.items()}
    whole, nodes, rest = frames["whole"].iloc[0], frames["nodes"], frames["residuals"]
    everywhere = rest[rest["cell"] == "all"]
    tiled = abs(whole["sum"] / whole["domain"] - 1)
    apart = (nodes["area"] - nodes["by_vertices"]).abs().max()
    closing, unclipped = everywhere["closing"].max(), rest[rest["cell"] == "clipped"]["unclipped"].max()
    sums = everywhere[["constant", "linear"]].max(axis=None)
    # Sums of some ten products of numbers below 2 for areas and area vectors; some hundred terms of size 1/spacing with
    # condition numbers below 1e3 for the gradients; each off by 2^-52 of itself.
    geometry, gradients = 1e-13, 1e-10
    cells = f"{int(whole['cells'])} cells of {p.nodes} nodes in an L with a hole, spacing {p.spacing:g}, seed {p.seed}"
    return [
        Statement(
            "cells",
            ("F1",),
            f"The areas A_L add up to the area {whole['domain']:g} of the domain to {rounding(tiled)} and are those inside the vertices to {rounding(apart)}; {int(2 * whole['edges'] - whole['wrong'])} of {int(2 * whole['edges'])} steps along a normal and back end in the cells that share the edge, "
            "and nowhere else: normals point out.",
            bool(max(tiled, apart) <= geometry and whole["wrong"] == 0),
            cells,
            "sampled",
        ),
        Statement(
            "closed",
            ("F1",),
            f"The outward area vectors of every cell add up to zero within {rounding(closing)} of its perimeter; without its edges on the boundary of the domain those of the clipped cell leave {unclipped:.2g} of it.",
            bool(closing <= geometry < unclipped),
            cells,
            "sampled",
            float(unclipped),
            "what is left without the edges on the boundary, over the perimeter",
        ),
        Statement(
            "as_used_for_scni",
            ("F1",),
            f"Smoothed over these boundaries, gradients (17) have the sums 0 and delta_ij to {rounding(sums)} with {', '.join(everywhere['rule'])}.",
            bool(sums <= gradients),
            f"{cells}; cubic kernel, order 1, supports {p.support_ratio:g} times the distance to a cell's farthest vertex",
            "sampled",
        ),
    ]


STUDY = Study(
    "Figure 1: nodal representative cells for SCNI", Parameters(), Parameters(spacing=0.25), compute, judge, draw
)
