"""What SCNI, SNNI and DNI keep in two and three dimensions: linear sums and the integration constraint, rule by rule."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rkverify.certify import integration_in_space
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd

FLOOR = 1e-12
"""What is smaller is drawn here: the digits of rounding are another machine's others."""


@dataclass(frozen=True)
class Parameters:
    """For two and three dimensions: spacings, support over a node's distance to its cell's farthest vertex, seed, reference rules."""

    spacings: tuple[float, float] = (0.1, 0.2)
    support_ratio: float = 3.2
    seed: int = 20064
    references: tuple[str, str] = ("gauss:16", "gauss:6")


def compute(p: Parameters) -> Tables:
    """Residuals of every integration on every set of nodes."""
    rows = [
        row
        for d, spacing, reference in zip((2, 3), p.spacings, p.references, strict=True)
        for row in integration_in_space.rows(d, spacing, p.support_ratio, p.seed, reference)
    ]
    why = "residuals of rounding are no portable numbers; the others are sums whose rounding stays below 1e-10"
    return {
        "residuals": table(
            rows,
            [
                ("domain", "", "L with a hole (two dimensions) or cube (three)"),
                ("nodes", "", "uniform, jittered, graded or random"),
                ("count", "1", "number of nodes"),
                ("integration", "", "scni: over the cells; snni: over boxes of the same measures; dni: at the nodes"),
                ("rule", "", "rule on the facets of cells or boxes"),
                ("order", "1", "order of the basis"),
                ("constant", "1", "largest A_L^(1/d) |sum_I b_iI^L|"),
                ("linear", "1", "largest |sum_I b_iI^L x_jI - delta_ij|"),
                (
                    "constraint",
                    "1",
                    "largest |sum_L A_L b_iI^L - integral of Psi_I n_i over the boundary|, over the largest of these integrals",
                ),
                ("from_mean", "1", "distance of the operator from the mean of grad Psi_I over the cells, relative"),
            ],
            f"Sums and integration constraint of nodal gradient operators; cubic kernel, radial supports {p.support_ratio} times a node's distance to the farthest vertex of its cell. "
            f"Mean gradients, and the boundary for DNI and SNNI, by {p.references[0]} on edges and {p.references[1]} on faces.",
            Numeric(1e-6, 1e-9, why),
        )
    }


def _name(row: "pd.Series") -> str:
    if row["integration"] == "dni":
        return "DNI"
    basis = "" if row["order"] else ", order 0"
    return f"{row['integration'].upper()}, {row['rule']}{basis}"


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Residuals of the sums, of the constraint, and the distance from the mean gradient, by integration."""
    frame = tables["residuals"].frame
    names = list(dict.fromkeys(frame.apply(_name, axis=1)))
    figure = new_figure(10.0, 3.9)
    panels = figure.subplots(1, 3, sharey=True)
    titles = {
        "linear": "gradient of a linear field,\nlargest error  (1)",
        "constraint": "integration constraint,\nrelative residual  (1)",
        "from_mean": "distance from the cells'\nmean gradient, relative  (1)",
    }
    for axes, (column, label) in zip(panels, titles.items(), strict=True):
        for style, (domain, part) in zip(LINES[::2], frame.groupby("domain", sort=False), strict=False):
            for marker, (kind, group) in zip("os^D", part.groupby("nodes", sort=False), strict=True):
                y = [names.index(_name(row)) + (0.15 if domain == "cube" else -0.15) for _, row in group.iterrows()]
                axes.plot(
                    group[column].clip(lower=FLOOR), y, marker, markersize=4, color=style["color"],
                    markerfacecolor="none" if domain == "cube" else style["color"], label=f"{kind}, {domain}",
                )  # fmt: skip
        rounded = column != "from_mean"
        axes.set(xscale="log", xlim=(FLOOR / 2 if rounded else 1e-6, 3), xlabel=label)
        if rounded:
            axes.axvspan(FLOOR / 2, 10 * FLOOR, color="#EEEEEE", zorder=0)
    panels[0].set_yticks(range(len(names)), names)
    panels[0].invert_yaxis()
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize=8)
    worst, least = _constraint(frame)
    caption = (
        f"Linear sums, integration constraint and distance from the mean of grad Psi over the cells for {int(frame.groupby(['domain', 'nodes'])['count'].first().sum())} nodes in {frame.groupby(['domain', 'nodes']).ngroups} sets. "
        f"The grey band is rounding; what is below 1e-12 is drawn at its edge. All parameters are ours: cubic kernel, supports {p.support_ratio} times the distance to the farthest vertex of a node's cell."
    )
    scni, linear = frame["integration"] == "scni", frame["order"] == 1
    tried = f"rules {', '.join(frame[scni]['rule'].unique())} and orders {', '.join(map(str, sorted(frame[scni]['order'].unique())))}"
    alternative = (
        f"SCNI misses the integration constraint by {rounding(float(frame[scni]['constraint'].max()))} at most, SNNI and DNI by {least:.2g} at least, of the largest boundary integral. "
        f"SCNI was tried with {tried}. With a linear basis the gradient of a linear field is off by {rounding(float(frame[linear]['linear'].max()))} at most in all integrations, "
        f"with order 0 by {float(frame[~linear]['linear'].min()):.2g} at least. SCNI operators are up to {worst:.2g} off the cells' mean gradient, depending on the rule."
    )
    return {"residuals": Drawing(figure, caption, alternative)}


def _constraint(frame: "pd.DataFrame") -> tuple[float, float]:
    """The largest distance of an SCNI rule of order 1 from the mean gradient, and the least residual of DNI and SNNI."""
    smoothed = frame[(frame["integration"] == "scni") & (frame["order"] == 1)]
    others = frame[frame["integration"] != "scni"]
    return float(smoothed["from_mean"].max()), float(others["constraint"].min())


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Each of the two conditions, where it is met and where it is not."""
    frame = tables["residuals"].frame
    scni, linear = frame["integration"] == "scni", frame["order"] == 1
    kept = float(frame[scni]["constraint"].max())
    worst, least = _constraint(frame)
    exact = float(frame[linear][["constant", "linear"]].max().max())
    without = float(frame[~linear]["linear"].min())
    rules = frame[scni & linear].groupby("rule", sort=False)["from_mean"].max()
    kinds = frame.groupby(["domain", "nodes"], sort=False)["count"].first()
    tried = f"{', '.join(f'{count} {kind} nodes in the {domain}' for (domain, kind), count in kinds.items())}; cubic kernel, radial supports, seed {p.seed}"
    # 1e-10: sums of some hundred terms of size 1/spacing with condition numbers below 1e3, each off by 2^-52 of itself.
    return [
        Statement(
            "constraint",
            (),
            f"SCNI satisfies the integration constraint to {rounding(kept)} with the trapezoid, the midpoint and Gauss points on facets, also with a basis of order 0; "
            f"SNNI and DNI miss it by {least:.2g} at least and {float(frame[~scni]['constraint'].max()):.2g} at most of the largest boundary integral.",
            kept <= 1e-10 < 1e-3 < least,
            tried,
            "sampled",
            least,
            "least relative residual of the constraint under SNNI and DNI",
        ),
        Statement(
            "linear",
            (),
            f"With a linear basis SCNI, SNNI and DNI give every linear field its gradient to {rounding(exact)}, whatever the rule; with a basis of order 0 SCNI is off by {without:.2g} at least.",
            exact <= 1e-10 < 1e-3 < without,
            tried,
            "sampled",
            without,
            "least error of the gradient of a linear field with a basis of order 0",
        ),
        Statement(
            "rules",
            (),
            f"The rules pass the same linear tests and differ from the mean gradient over the cell by up to {', '.join(f'{value:.2g} ({rule})' for rule, value in rules.items())}: an operator is told by its rule.",
            bool(rules["trapezoid"] > rules["midpoint"] > rules["gauss:2"] > rules["gauss:4"] > 0),
            tried,
            "sampled",
            worst,
            "largest relative distance of an SCNI operator of order 1 from the mean gradient",
        ),
    ]


STUDY = Study(
    "Nodal integration in two and three dimensions",
    Parameters(),
    Parameters(spacings=(0.2, 1 / 3), references=("gauss:8", "gauss:3")),
    compute,
    judge,
    draw,
)
