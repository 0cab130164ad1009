"""Smoothed gradients (52), (72) and direct gradients (80) in one dimension: sums, means, symmetry, bandwidth."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.arithmetic.native import Exact as Rational
from rkverify.certify import kinematics
from rkverify.certify.samples import rational_node_sets
from rkverify.stability.printed import gradients_are_odd, stencil_half_width
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure


@dataclass(frozen=True)
class Parameters:
    """Nodes per set, seed, and the support ratios R in twentieths."""

    nodes: int = 13
    seed: int = 20061
    support_twentieths: tuple[int, ...] = tuple(range(21, 82))


def compute(p: Parameters) -> Tables:
    """Sums of smoothed gradients, and the width of the stencil of (61) over R."""
    K = Rational()
    ratios = [K.ratio(n, 20) for n in p.support_twentieths]
    widths = [(R, *stencil_half_width(R, K), gradients_are_odd(R, K)) for R in ratios]
    return {
        "sums": table(
            kinematics.smoothed_gradients(rational_node_sets(p.nodes, p.seed)),
            [
                ("nodes", "", "node set"),
                ("constant", "1/length", "largest |sum_I b_I^L| over the cells"),
                ("linear", "1", "largest |sum_I b_I^L x_I - 1| over the cells"),
                ("from_mean", "1/length", "largest distance of b_I^L from the mean of Psi_I,x over the middle cell"),
            ],
            "Smoothed gradients of order 1 on Voronoi cells.",
            Numeric(0, 1e-10, "the quadrature's rounding is no portable number; exact columns are text"),
        ),
        "widths": table(
            [
                {"support_ratio": str(R), "R": float(R), "printed": m, "computed": true, "odd": odd}
                for R, m, true, odd in widths
            ],
            [
                ("support_ratio", "1", "R = a/h"),
                ("R", "1", "R as a decimal"),
                ("printed", "1", "m = int(R + 0.5)"),
                ("computed", "1", "largest distance, in cells, of a smoothed gradient that is not zero"),
                ("odd", "", "whether b_I^{I+n} = -b_I^{I-n} exactly"),
            ],
            "Half-width of the smoothed gradients on the uniform lattice, in exact arithmetic.",
            Exact(),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Printed and computed half-width over R."""
    frame = tables["widths"].frame
    figure = new_figure(6.4, 3.0)
    axes = figure.subplots()
    axes.plot(frame["R"], frame["computed"], drawstyle="steps-post", label="computed", **LINES[0])
    axes.plot(frame["R"], frame["printed"], "o", markersize=3, color=LINES[2]["color"], label="m = int(R + 0.5)")
    axes.set(xlabel="support ratio R = a/h  (1)", ylabel="half-width of the stencil  (cells)")
    axes.legend()
    caption = (
        "Half-width m of (61) as printed and as computed from exact smoothed gradients; cubic kernel, order 1 (ours)."
    )
    larger = frame[frame["printed"] > frame["computed"]]
    alternative = (
        f"The printed half-width equals the computed one at {int((frame['printed'] == frame['computed']).sum())} of {len(frame)} support ratios; "
        f"it is larger by {(larger['printed'] - larger['computed']).max()} at R = {', '.join(f'{R:g}' for R in larger['R'])}, where the gradients beyond the computed one are zero."
    )
    return {"widths": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """The sums are exact, the gradients are means, and m is wide enough."""
    sums, widths = tables["sums"].frame, tables["widths"].frame
    exact = bool((sums["constant"] == "0").all() and (sums["linear"] == "0").all())
    worst = float(sums["from_mean"].max())
    # 16-point Gauss is exact to rounding on smooth pieces: some 100 terms of size 10/length, each 2^-52 off.
    allowed = 100 * 10 * p.nodes * 2.0**-52
    enough = bool((widths["computed"] <= widths["printed"]).all())
    tight = widths[widths["computed"] < widths["printed"]]
    at_halves = bool(((tight["R"] * 2) % 2 == 1).all())
    span = f"R from {widths['R'].min():g} to {widths['R'].max():g} in steps of 1/20"
    cells = f"{p.nodes} uniform, graded and jittered nodes, every cell"
    return [
        Statement(
            "smoothed",
            ("E52", "E72"),
            f"The smoothed gradient is the mean of Psi,x over the cell to {rounding(worst)}, and its sums sum_I b = 0 and sum_I b x_I = 1 are exact.",
            exact and worst <= allowed,
            cells,
            "exact",
            routes=("quadrature of the full derivative", "exact sums"),
        ),
        Statement(
            "direct",
            ("E80",),
            "The direct gradient is the full derivative at the node; its mean over a cell is the smoothed gradient.",
            exact and worst <= allowed,
            cells,
            "sampled",
            routes=("quadrature of the full derivative",),
        ),
        Statement(
            "bandwidth",
            ("C29",),
            f"No smoothed gradient beyond m = int(R + 0.5) differs from zero; m is one too large, harmlessly, at {len(tight)} of {len(widths)} support ratios, those with R + 1/2 an integer.",
            enough and at_halves,
            span,
            "exact",
            float((widths["printed"] - widths["computed"]).min()),
            "least surplus of the printed half-width",
        ),
        Statement(
            "odd",
            ("E64",),
            "The gradients of (64) are odd about the node, exactly.",
            bool(widths["odd"].all()),
            span,
            "exact",
            routes=("antisymmetry on the lattice",),
        ),
    ]


STUDY = Study(
    "Nodal gradients in one dimension",
    Parameters(),
    Parameters(nodes=9, support_twentieths=(25, 30, 50)),
    compute,
    judge,
    draw,
)
