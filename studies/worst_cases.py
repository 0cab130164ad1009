"""Worst cases that searches found, measured again: every error beside its derived bound, and how near the bound it comes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil, isfinite
from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np

from rkverify.certify.worst.case import KINDS
from rkverify.certify.worst.file import fingerprint
from rkverify.certify.worst.pictures import outline
from rkverify.certify.worst.tabulated import NEAR, kind_rows, refusal_rows, tabulated
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

FAMILIES: dict[str, tuple[str, ...]] = {
    "shape functions and derivatives": ("value", "first", "second"),
    "moment matrix": ("eigenvalue", "pivot"),
    "two routes: rates, smoothed gradients": ("psi_star", "true_rate", "smoothed"),
    "cells": ("measures", "closure"),
    "patch test": ("patch",),
}
NOISE = Numeric(
    999.0,
    0.0,
    "errors are the rounding of one processor's operations, another's are of any size below the bound: three orders of magnitude; "
    "the verdicts, which are text, must be the same",
)


@dataclass(frozen=True)
class Parameters:
    """The hash of the committed cases, and the quantities that are measured."""

    data: str
    quantities: tuple[str, ...] = tuple(KINDS)


def compute(p: Parameters) -> Tables:
    """All cases, each quantity's nearest approach to its bound, and how near to the refusal the cases are."""
    rows = tabulated(p.quantities)
    return {
        "worst_cases": table(
            rows,
            [
                ("case", "", "name"),
                ("quantity", "", "what is measured; in words in kinds.csv"),
                ("dimension", "1", "space dimensions"),
                ("order", "", "order of the basis; - where there is none"),
                ("nodes", "1", "number of nodes"),
                ("condition", "1", "condition number: of the moment matrix with its diagonal scaled to 1, the largest at the points visited; of the stiffness for the patch test; of a cell's measure as a sum for cells"),
                ("size", "its own", "largest of what is measured, any unit of length and time"),
                ("found", "its own", "largest error when it was found, on the processor of the search"),
                ("error", "its own", "largest error"),
                ("bound", "its own", "largest bound; inf where rounding may have made the matrix singular"),
                ("ratio", "1", "largest error over largest bound"),
                ("share", "1", "largest share of its own bound that a number takes"),
                ("verdict", "", "within; exceeded; no bound; too loose: no case of the quantity comes to within 1000 of its bound"),
            ],
            "Worst cases: error, derived bound and their ratio.",
            NOISE,
        ),
        "kinds": table(
            kind_rows(rows),
            [
                ("quantity", "", "what is measured"),
                ("words", "", "in words"),
                ("unit", "", "its unit, where lengths and times have one"),
                ("cases", "1", "number of cases"),
                ("nearest", "1", "largest ratio of error and bound over the cases"),
                ("condition", "1", "largest condition number of a case with a bound"),
                ("verdict", "", "within, exceeded or too loose"),
            ],
            "How near each quantity's bound is approached.",
            NOISE,
        ),
        "refusals": table(
            refusal_rows(p.quantities),
            [
                ("case", "", "name"),
                ("singular", "", "whether the moment matrix is singular, in rationals"),
                ("condition", "1", "condition number with the diagonal scaled to 1; without the dependent column where singular"),
                ("margin", "1", "what is left of the pivot that decides over what solid/ takes for rounding; up to 1 it refuses"),
                ("answers", "", "whether solid/ answers"),
            ],
            "Moment matrices that are singular, and those worst conditioned of what solid/ still answers.",
            NOISE,
        ),
    }  # fmt: skip


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The cases, and their errors over condition numbers."""
    return {"cases": _pictures(tables["worst_cases"].frame), "errors": _errors(tables["worst_cases"].frame)}


COLUMNS, TITLE = 6, 26


def _pictures(frame: "pd.DataFrame") -> Drawing:
    names = list(frame["case"])
    lines = ceil(len(names) / COLUMNS)
    figure = new_figure(11.0, 1.95 * lines + 0.4)
    panels = figure.subplots(lines, COLUMNS, squeeze=False).ravel()
    for axes in panels[len(names) :]:
        axes.set_axis_off()
    for axes, name in zip(panels, names, strict=False):
        _picture(axes, name)
    flat = int((frame["condition"] > 1e4).sum())
    caption = (
        "The worst cases: nodes (dots), the three supports whose edges are nearest to the point (grey circles or squares; segments below the nodes of a line), the point (cross) or the cell (thick outline), "
        "the cells' edges where cells are measured. Axes in the cases' own units of length, alike in both directions; cases in space are seen along the third axis."
    )
    alternative = (
        f"{flat} of {len(names)} worst cases have a condition number above 10^4, up to {frame['condition'].max():.1g}; that of the other {len(names) - flat} is between "
        f"{frame['condition'].min():.2g} and {frame[frame['condition'] <= 1e4]['condition'].max():.2g}. Drawn are the nodes of each case, {int(frame['nodes'].min())} to {int(frame['nodes'].max())}."
    )
    return Drawing(figure, caption, alternative)


def _picture(axes: "Axes", name: str) -> None:
    from matplotlib.patches import Circle, Rectangle

    shown = outline(name)
    for (x, y), a in shown.supports:
        if shown.square:
            axes.add_patch(Rectangle((x - a, y - a), 2 * a, 2 * a, fill=False, color="#AAAAAA", linewidth=0.7))
        else:
            axes.add_patch(Circle((x, y), a, fill=False, color="#AAAAAA", linewidth=0.7))
    for line in shown.edges:
        axes.plot(*line, color="#888888", linewidth=0.7)
    for line in shown.cell:
        axes.plot(*line, color=LINES[1]["color"], linewidth=1.8)
    axes.plot(*shown.nodes, "o", color="#000000", markersize=2.5)
    axes.plot(*shown.point, "x", color=LINES[2]["color"], markersize=7, markeredgewidth=1.8)
    (x0, x1), (y0, y1) = shown.window
    axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
    axes.set_title(_broken(name), fontsize=7)
    axes.tick_params(labelsize=6)
    axes.grid(False)


def _broken(name: str) -> str:
    return fill(name, TITLE)


def _errors(frame: "pd.DataFrame") -> Drawing:
    figure = new_figure(8.0, 4.4)
    axes = figure.subplots()
    for (family, quantities), marker, style in zip(FAMILIES.items(), "os^Dv", LINES, strict=False):
        part = frame[frame["quantity"].isin(quantities)]
        x, size = part["condition"].to_numpy(), part["size"].to_numpy()
        bounds = (part["bound"] / size).to_numpy()
        errors = (part["found"] / size).to_numpy()
        axes.plot(x, errors, marker, color=style["color"], markersize=5, label=family)
        known = [isfinite(b) for b in bounds]
        for place, error, bound, has in zip(x, errors, bounds, known, strict=True):
            if has:
                axes.plot([place, place], [error, bound], color=style["color"], linewidth=0.7)
                axes.plot([place], [bound], "_", color=style["color"], markersize=9, markeredgewidth=1.6)
            else:
                axes.annotate("no bound", (place, error), (0, -13), textcoords="offset points", ha="center", fontsize=8)
    axes.set(xscale="log", yscale="log", xlabel="condition number  (1)", ylabel="error over size  (1)")
    axes.legend(loc="upper left", fontsize=8)
    caption = (
        "Error of each worst case over the size of what is measured (symbols) when it was found, and its derived bound (dashes), over the condition number: of the moment matrix with its diagonal scaled to 1, "
        "of the stiffness for the patch test, of a sum for cells."
    )
    bounded = frame[frame["verdict"] != "no bound"]
    low, high = bounded["condition"].min(), bounded["condition"].max()
    exceeded = int((frame["verdict"] == "exceeded").sum())
    seen = bounded[bounded["found"] > 0]
    apart = np.log10(seen["bound"] / seen["found"])
    slopes = [
        np.polyfit(np.log10(seen["condition"]), np.log10(seen[name] / seen["size"]), 1)[0]
        for name in ("found", "bound")
    ]
    alternative = (
        f"{exceeded} of {len(frame)} errors are above their bounds, which are {apart.min():.1f} to {apart.max():.1f} powers of ten above them, {apart.median():.1f} in the middle. "
        f"For condition numbers from {low:.1g} to {high:.1g} errors go with the power {slopes[0]:.2f} of the condition number and bounds with the power {slopes[1]:.2f}, by least squares."
    )
    return Drawing(figure, caption, alternative)


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Within the bounds, near to them, and what is refused."""
    cases, kinds, refusals = (tables[name].frame for name in ("worst_cases", "kinds", "refusals"))
    count = {verdict: int((cases["verdict"] == verdict).sum()) for verdict in ("within", "exceeded", "no bound", "too loose")}  # fmt: skip
    tried = f"{len(cases)} cases in one to three dimensions, orders 0 to 2, found by seeded climbs"
    found = [
        Statement(
            "bounds",
            (),
            f"{count['within'] + count['too loose']} of {len(cases)} worst cases are within their derived bounds, {count['exceeded']} exceed them, {count['no bound']} are so badly conditioned that there is none.",
            count["exceeded"] == 0,
            tried,
            "sampled",
            routes=("transcription with 50 digits, or exact sums", "running error analysis"),
        ),
        Statement(
            "near",
            (),
            f"{int((kinds['nearest'] >= NEAR).sum())} of {len(kinds)} bounds are approached by some case to within a factor of {1 / NEAR:.0f}.",
            bool((kinds["nearest"] >= NEAR).all()),
            tried,
            "sampled",
        ),
    ]
    singular, regular = (refusals[refusals["singular"] == word] for word in ("yes", "no"))
    if len(singular):
        found.append(
            Statement(
                "refused",
                (),
                f"{int((singular['answers'] == 'no').sum())} of {len(singular)} exactly singular moment matrices are refused, whatever rounding leaves of a pivot that is zero, and a search for more of it finds.",
                bool((singular["answers"] == "no").all()),
                "nodes on a line, in a plane and in two rows; what is left of the pivot climbed for",
                "sampled",
            )
        )
    if len(regular):
        worst = regular.loc[regular["condition"].idxmax()]
        errors = cases[cases["quantity"] == "value"]
        row = errors.loc[errors["condition"].idxmax()]
        found.append(
            Statement(
                "answered",
                (),
                f"{int((regular['answers'] == 'yes').sum())} of {len(regular)} regular moment matrices just before the refusal are answered, up to a condition number of {worst['condition']:.2g} with the diagonal scaled to 1. At {row['condition']:.2g} the error of the shape functions is below {rounding(float(row['error'] / row['size']))} of their size: an answer says that the matrix is not singular, not that digits are left.",
                bool((regular["answers"] == "yes").all()),
                tried,
                "sampled",
            )
        )
    return found


STUDY = Study(
    "Worst cases and their bounds",
    Parameters(fingerprint()),
    Parameters(fingerprint(), ("value", "eigenvalue", "pivot", "closure")),
    compute,
    judge,
    draw,
)
