"""Figure 3: velocities of neighbours relative to a kernel's centre in a computed motion, and what the sign of n.(v - v_I) tells."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from rkverify.certify.motions import flexure, translation, turn
from rkverify.certify.pictures import relative_motion
from rkverify.certify.pictures.block import Block
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

SCALE = 2.5
"""Length per time that is drawn as one length."""
SIGNS = {
    "away": {"marker": "^", "color": LINES[1]["color"], "label": "n·(v − v$_I$) > 0: moves away"},
    "towards": {"marker": "v", "color": LINES[2]["color"], "label": "n·(v − v$_I$) < 0: approaches"},
}


@dataclass(frozen=True)
class Parameters:
    """Nodes per side, support radius, seed, place near the node drawn, time drawn, times tried, step of the difference quotient.

    Circles, and points on each, for the lines on which n.(v - v_I) is zero.
    """

    per_side: int = 9
    support: str = "5/2"
    seed: int = 20061
    near: tuple[str, str] = ("2", "0")
    time: str = "3/10"
    times: tuple[str, ...] = ("0", "3/20", "3/10", "9/20", "3/5")
    step: str = "1/50"
    circles: int = 12
    points: int = 72


def _block(p: Parameters) -> tuple[Block, int]:
    """The nodes, and the one that is drawn."""
    block = Block(p.per_side, Fraction(p.support), p.seed)
    return block, block.node_at(tuple(map(Fraction, p.near)))


def compute(p: Parameters) -> Tables:
    """The neighbours of one node, all pairs at all times, and n.(v - v_I) around the node."""
    block, centre = _block(p)
    t, step = Fraction(p.time), Fraction(p.step)
    rounded = Numeric(1e-9, 1e-12, "a few operations in double precision, differences divided by the step")
    return {
        "neighbours": table(
            relative_motion.neighbours(block, centre, flexure, t, step),
            [
                ("node", "", "node J under the kernel of the node drawn"),
                *((f"offset_{j}", "length", "x - x_I") for j in (1, 2)),
                *((f"v_{j}", "length/time", "velocity v of the neighbour") for j in (1, 2)),
                *((f"relative_{j}", "length/time", "v - v_I") for j in (1, 2)),
                *((f"n_{j}", "1", "direction n of (36)") for j in (1, 2)),
                ("projection", "length/time", "n.(v - v_I)"),
                ("complex_step", "length/time", "d|x - x_I|/dt by a complex step in time, without velocities"),
                ("difference", "length/time", f"the same by a central difference of step {p.step}"),
                ("moves", "", "away, towards or neither, by the exact sign of (x - x_I).(v - v_I)"),
            ],
            f"Neighbours of node {centre} at t = {p.time}.",
            rounded,
        ),
        "pairs": table(
            relative_motion.every_pair(block, (flexure, turn, translation), [Fraction(t) for t in p.times], step),
            [
                ("motion", "", "map from X to x"),
                ("time", "", "time t of the motion"),
                ("pairs", "", "pairs of a node and a neighbour under its kernel"),
                ("away", "", "with n.(v - v_I) > 0"),
                ("towards", "", "with n.(v - v_I) < 0"),
                ("neither", "", "with n.(v - v_I) = 0, exactly"),
                ("wrong", "", "pairs whose distance a little before and after, by exact squares, does otherwise"),
                ("without", "", "pairs for which n.v, without v_I, has another sign"),
                ("speed", "length/time", "largest |n.(v - v_I)|"),
                ("complex_step", "length/time", "largest distance of n.(v - v_I) from the complex step"),
                ("coarse", "length/time", f"from the central difference of step {p.step}"),
                ("fine", "length/time", "from that of half the step"),
            ],
            "Every node with every neighbour.",
            rounded,
        ),
        "around": table(
            relative_motion.field(block, centre, flexure, t, p.circles, p.points),
            [
                ("circle", "", "circle about the node, the last of radius a"),
                ("point", "", "point on it, the last the first again"),
                *((f"offset_{j}", "length", "x - x_I") for j in (1, 2)),
                ("projection", "length/time", "n.(v - v_I) of the material at x"),
            ],
            f"n.(v - v_I) about node {centre} at t = {p.time}.",
            rounded,
        ),
    }


def _mean_angle(near: pd.DataFrame, moves: str) -> str:
    """The mean acute angle between n and the first axis, over the neighbours that move this way."""
    part = near[near["moves"] == moves]
    return f"{np.degrees(np.arctan2(part['n_2'].abs(), part['n_1'].abs())).mean():.0f} degrees" if len(part) else "none"


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Velocities; relative velocities with their projections; projections against rates of the distance."""
    near, around, centre = tables["neighbours"].frame, tables["around"].frame, _block(p)[1]
    figure = new_figure(10.6, 4.3)
    velocities, relative, rates = figure.subplots(1, 3)
    v_I = (near["v_1"] - near["relative_1"]).iloc[0], (near["v_2"] - near["relative_2"]).iloc[0]
    a = float(Fraction(p.support))
    for axes in (velocities, relative):
        axes.add_patch(Circle((0, 0), a, facecolor="#F4F4F4", edgecolor="#000000", linewidth=1, zorder=0))
        axes.plot(0, 0, "o", markersize=7, color="#000000", zorder=5)
        axes.set_aspect("equal")
        axes.set(xlim=(-1.4 * a, 1.4 * a), ylim=(-1.4 * a, 1.4 * a), xlabel="$x_1 - x_{1I}$  (length)", ylabel="$x_2 - x_{2I}$  (length)")  # fmt: skip
        axes.grid(False)
    _arrows(velocities, near, "v", "#404040")
    velocities.quiver(0, 0, *v_I, color="#000000", angles="xy", scale_units="xy", scale=SCALE, width=0.014, zorder=5)
    velocities.plot(near["offset_1"], near["offset_2"], "o", markersize=3.5, color="#404040")
    velocities.annotate("$\\mathbf{v}_I$", (v_I[0] / SCALE, v_I[1] / SCALE), (3, 3), textcoords="offset points", fontsize=10)  # fmt: skip
    velocities.set_title("(a) velocities v of the neighbours, and v$_I$", fontsize=9)
    _zero_lines(relative, around)
    _arrows(relative, near, "relative", "#808080", width=0.005)
    for word, style in SIGNS.items():
        part = near[near["moves"] == word]
        along = part["projection"] * part["n_1"], part["projection"] * part["n_2"]
        relative.quiver(part["offset_1"], part["offset_2"], *along, color=style["color"], angles="xy", scale_units="xy", scale=SCALE, width=0.010, headwidth=2.6, headlength=3, headaxislength=3, zorder=4)  # fmt: skip
        for axes, x, y in ((relative, "offset_1", "offset_2"), (rates, "complex_step", "projection")):
            axes.plot(part[x], part[y], linestyle="none", markersize=6, markeredgecolor="#000000", markeredgewidth=0.5, zorder=5, **style)  # fmt: skip
    named = near.loc[near["projection"].idxmax()]
    relative.plot((0, named["offset_1"]), (0, named["offset_2"]), color="#000000", linewidth=0.6, zorder=1)
    relative.quiver(0, 0, named["n_1"], named["n_2"], color="#000000", angles="xy", scale_units="xy", scale=1, width=0.008, zorder=5)  # fmt: skip
    relative.annotate("$\\mathbf{n}$", (named["n_1"], named["n_2"]), (0, -11), textcoords="offset points")
    relative.set_title("(b) v − v$_I$ (grey) and its projection on n", fontsize=9)
    ends = near["projection"].min(), near["projection"].max()
    rates.plot(ends, ends, color="#000000", linewidth=0.8, zorder=1, label="equal")
    rates.axhline(0, color="#808080", linewidth=0.6)
    rates.axvline(0, color="#808080", linewidth=0.6)
    rates.set(xlabel="d|x − x$_I$|/dt by complex step  (length/time)", ylabel="n·(v − v$_I$)  (length/time)")
    rates.set_title("(c) projection and rate of the distance", fontsize=9)
    handles, labels = relative.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    count = near["moves"].value_counts()
    gap = (near["projection"] - near["complex_step"]).abs().max()
    caption = (
        f"Figure 3 from the motion of Figure 2, {flexure(0).name}: x_1 = (1 + t) X_1, x_2 = X_2/(1 + t) + t x_1^2/6, at t = {p.time}; {p.per_side} by {p.per_side} nodes about 1 apart, moved by up to a quarter, seed {p.seed}, a = {p.support}, node I = {centre} with {len(near)} neighbours: "
        f"{count.get('away', 0)} move away, {count.get('towards', 0)} approach. Arrows are velocities times {1 / SCALE:g} time. (b) Coloured: (n.(v - v_I)) n, n drawn for one neighbour; dashed: where n.(v - v_I) = 0. (c) The two agree to {rounding(gap)}. All parameters and the motion are ours: the paper's figure is a sketch of one neighbour."
    )
    speed, apart = float(np.hypot(*v_I)), float(np.hypot(near["relative_1"], near["relative_2"]).max())
    alternative = (
        f"Of {len(near)} neighbours of a node {count.get('away', 0)} move away, where n.(v - v_I) is positive, and {count.get('towards', 0)} approach, where it is negative; it is off the rate of the distance by {rounding(gap)} at most. "
        f"The common part v_I of the velocities has the size {speed:.2g}, the velocities relative to it up to {apart:.2g}. The {count.get('away', 0)} projections on n that point outward are marked by upward triangles, the {count.get('towards', 0)} that point "
        f"inward by downward triangles. Neighbours that move away are {_mean_angle(near, 'away')} off the first axis on the average, those that approach {_mean_angle(near, 'towards')}."
    )
    return {"figure3": Drawing(figure, caption, alternative)}


def _arrows(axes: Axes, near: pd.DataFrame, name: str, colour: str, width: float = 0.006) -> None:
    axes.quiver(near["offset_1"], near["offset_2"], near[f"{name}_1"], near[f"{name}_2"], color=colour, angles="xy", scale_units="xy", scale=SCALE, width=width, zorder=3)  # fmt: skip


def _zero_lines(axes: Axes, around: pd.DataFrame) -> None:
    columns = ("offset_1", "offset_2", "projection")
    x1, x2, values = (around.pivot(index="circle", columns="point", values=name).to_numpy() for name in columns)
    axes.contour(x1, x2, values, levels=[0], colors=["#000000"], linestyles=["--"], linewidths=[1])
    axes.plot([], [], color="#000000", linestyle="--", linewidth=1, label="n·(v − v$_I$) = 0")


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """The projection is the rate of the distance, and its sign tells approach from departure."""
    near, pairs, centre = tables["neighbours"].frame, tables["pairs"].frame, _block(p)[1]
    rigid = pairs["motion"] != flexure(0).name
    deforming = pairs[~rigid]
    count = near["moves"].value_counts()
    gap, speed = pairs["complex_step"].max(), deforming["speed"].max()
    falls = float((deforming["coarse"] / deforming["fine"]).min())
    still = bool((pairs[rigid]["neither"] == pairs[rigid]["pairs"]).all())
    both = bool((deforming[["away", "towards"]] > 0).all(axis=None))
    wrong, total = int(pairs["wrong"].sum()), int(pairs["pairs"].sum())
    without = int(deforming["without"].sum())
    # Some twenty operations on numbers below 20 for each projection and rate, each off by 2^-52 of itself.
    allowed = 20 * 20 * 2.0**-52
    agrees = bool(gap <= allowed)
    tried = f"{p.per_side}^2 jittered nodes, a = {p.support}; {', '.join(pairs['motion'].unique())} at t = {', '.join(p.times)}"
    return [
        Statement(
            "rate of the distance",
            ("F3",),
            f"n.(v - v_I) is d|x - x_I|/dt by a complex step to {rounding(gap)}, with projections up to {speed:.2g}; central differences come closer by a factor of {falls:.2f} at least where the step is halved.",
            agrees and 3.5 < falls < 4.5,
            f"{tried}, all {total} pairs under a kernel",
            "sampled",
        ),
        Statement(
            "approach and departure",
            ("F3", "C24"),
            f"Of the {len(near)} neighbours of node {centre} at t = {p.time}, {count.get('away', 0)} have n.(v - v_I) > 0 and move away, {count.get('towards', 0)} have n.(v - v_I) < 0 and approach. In all, {int(pairs['away'].sum())} pairs part, {int(pairs['towards'].sum())} approach, {int(pairs['neither'].sum())}, those in rigid motions, do neither, and for {total - wrong} of {total} the distance "
            f"does what the sign says. With v in the place of v - v_I the sign would be another one for {without} of {int(deforming['pairs'].sum())} pairs of the deforming motion.",
            wrong == 0 and still and both,
            f"{tried}, all pairs under a kernel; signs and distances in rationals",
            "exact",
            float(without / deforming["pairs"].sum()),
            "share of pairs told wrongly without v_I",
        ),
    ]


STUDY = Study(
    "Figure 3: motion relative to a kernel's centre",
    Parameters(),
    Parameters(per_side=7, times=("0", "3/10"), circles=6, points=36),
    compute,
    judge,
    draw,
)
