"""Figure 4: frequency of the Lagrangian RK discretisation with SCNI against kh, from (63) as printed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi

from rkverify.certify import consequences
from rkverify.certify.curves import frequencies_near_pi, lagrangian_frequencies
from rkverify.stability.side_by_side import lagrangian_rows
from rkverify.workflow.compare import Certified
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, kh_axis, new_figure
from studies import _layers as side_by_side


@dataclass(frozen=True)
class Parameters:
    """Support ratios R, points on the curve, and the share of the peak that 'very close to zero' may mean.

    Layers side by side: support ratios, stretch F, stress S/C^SE, points, and n of the measured points kh = pi n/8.
    """

    support_ratios: tuple[str, ...] = ("1.1", "1.5", "2", "2.5", "3", "3.5")
    samples: int = 240
    named: str = "3.5"
    close: float = 0.05
    layer_ratios: tuple[str, ...] = ("1.1", "1.5", "2", "2.5", "3.5")
    stretch: str = "6/5"
    stress: str = "1/3"
    layer_samples: int = 96
    waves: tuple[int, ...] = (1, 2, 3, 4, 5, 6, 7)


def compute(p: Parameters) -> Tables:
    """Enclosed curves, and the frequencies near kh = pi."""
    return {
        "curves": table(
            lagrangian_frequencies(p.support_ratios, p.samples),
            [
                ("support_ratio", "1", "R = a/h"),
                ("kh", "rad", "wave number times spacing"),
                ("omega", "1", "omega h / c with c^2 = (C^SE F^2 + S)/rho_0"),
            ],
            "The curves of Figure 4; every digit is certain, 0e-N is an enclosure of 0.",
            Certified(),
            across="kh",
        ),
        "near_pi": table(
            frequencies_near_pi(p.support_ratios, p.samples),
            [
                ("support_ratio", "1", "R = a/h"),
                ("half_width", "1", "m of (61)"),
                ("peak", "1", "largest omega h / c over the samples"),
                ("kh_of_peak", "rad", "where it is"),
                ("at_090_pi", "1", "omega h / c at kh = 0.9 pi"),
                ("at_095_pi", "1", "omega h / c at kh = 0.95 pi"),
                ("at_pi", "1", "omega h / c at kh = pi"),
                ("ratio_090", "1", "omega at 0.9 pi over the peak"),
            ],
            "How the frequency falls towards the cut-off kh = pi.",
            Certified(),
        ),
        "layers": side_by_side.layer_table(
            lagrangian_rows(("scni", "dni"), p.layer_ratios, p.stretch, p.stress, p.layer_samples, p.waves),
            f"Frequency over c/h in every layer, F = {p.stretch}, S/C^SE = {p.stress}; as-defined and consistent are the same equation.",
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The curves, and the continuum's straight line."""
    frame = tables["curves"].frame.astype({"kh": float, "omega": float})
    figure = new_figure(6.4, 4.0)
    axes = figure.subplots()
    for style, R in zip(LINES, p.support_ratios, strict=False):
        part = frame[frame["support_ratio"] == R]
        axes.plot(part["kh"], part["omega"], label=f"R = {R}", **style)
    kh = frame["kh"].unique()
    axes.plot(kh, kh, color="#808080", linewidth=0.8, label="continuum")
    kh_axis(axes)
    axes.set(ylabel="frequency  ωh/c  (1)", ylim=(0, 1.25))
    axes.legend(ncols=2)
    caption = (
        f"Figure 4 from (63) as printed: R = {', '.join(p.support_ratios)} (R = 3.5 is named in the paper, the others are ours); "
        "cubic B-spline (12) and linear basis (ours: the paper names neither for the figure); uniform nodes, lumped mass, "
        "omega h / c with c^2 = (C^SE F^2 + S)/rho_0, so that stretch and stress drop out."
    )
    ends = frame.groupby("support_ratio")["omega"].last()
    first = frame[frame["kh"] == kh[kh > 0].min()]
    off = float(abs(first["omega"] / first["kh"] - 1).max())
    peaks = tables["near_pi"].frame.set_index("support_ratio")["peak"]
    low = frame[(frame["omega"] < 0.1) & (frame["kh"] > pi / 2)].groupby("support_ratio")["kh"].min()
    steep, flat = low[peaks.index[0]], low[peaks.index[-1]]
    alternative = (
        f"Frequency over wave number: the {len(ends)} curves start within a share of {off:.0e} of the continuum's line and end at kh = pi at {ends.max():g}. "
        f"The peak goes from {float(peaks.iloc[0]):.2f} at R = {peaks.index[0]} to {float(peaks.iloc[-1]):.2f} at R = {peaks.index[-1]}, "
        f"where it is below a tenth from kh = {flat:.2f} on; at R = {peaks.index[0]} that is from {steep:.2f} on."
    )
    return {"figure4": Drawing(figure, caption, alternative), "figure4_layers": _draw_layers(p, tables)}


def _draw_layers(p: Parameters, tables: Tables) -> Drawing:
    """(63), the linearised bar with SCNI, and with DNI; measured frequencies as circles."""
    frame = tables["layers"].frame
    figure = new_figure(10, 3.9)
    panels = (
        ("SCNI", "printed", "SCNI: (63) as printed"),
        ("SCNI", "as-defined", "SCNI: as-defined = consistent"),
        ("DNI", "as-defined", "DNI: as-defined = consistent\n(not in the paper)"),
    )
    for axes, (integration, layer, title) in zip(figure.subplots(1, 3, sharey=True), panels, strict=True):
        for style, R in zip(LINES, p.layer_ratios, strict=False):
            case = frame[frame["case"] == f"{integration}, R = {R}"]
            line, points = case[case["layer"] == layer], case[case["layer"] == "simulated"]
            axes.plot(line["kh"], line["frequency"], label=f"R = {R}", **style)
            side_by_side.circles(axes, points, "frequency", None)
        kh_axis(axes, "kh  (rad)")
        axes.set_title(title, fontsize=9)
    figure.axes[0].set(ylabel="frequency  ωh/c  (1)", ylim=(0, 1.2))
    side_by_side.circles(figure.axes[0], frame.iloc[:0], "frequency", "measured")
    figure.legend(*figure.axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=6)
    names = list(dict.fromkeys(frame["case"]))
    scni, dni = ([name for name in names if name.startswith(word)] for word in ("SCNI", "DNI"))
    below = frame["uncertain_below"].max()
    printed = max(side_by_side.gap(tables, case, "printed", "as-defined", "0") for case in scni)
    measured = max(side_by_side.gap(tables, case, "as-defined", "simulated", "0") for case in (*scni, *dni))
    linear = frame[(frame["layer"] == "as-defined") & frame["case"].isin((*scni, *dni))]
    within_pi = side_by_side.within(float(linear[linear["kh"] == linear["kh"].max()]["frequency"].max()))
    peaks = [
        f"R = {R}: {side_by_side.largest(tables, f'SCNI, R = {R}', 'as-defined', '0', 'frequency'):.3g} (SCNI) and "
        f"{side_by_side.largest(tables, f'DNI, R = {R}', 'as-defined', '0', 'frequency'):.3g} (DNI)"
        for R in p.layer_ratios
    ]
    caption = (
        "Figure 4, layers side by side: (63) as printed, the Lagrangian bar linearised as the paper defines it with SCNI, and with DNI, for which the paper prints no relation. "
        "There is no convective term, so that the layer consistent is the same equation as as-defined. Circles: frequencies measured in nonlinear computations "
        f"at kh = pi n/8, n = {', '.join(map(str, p.waves))}, with an uncertainty below {below:g}. R = {', '.join(p.layer_ratios)} (3.5 is named in the paper), "
        f"F = {p.stretch}, S/C^SE = {p.stress} (ours; frequencies are over c/h with c^2 = (C^SE F^2 + S)/rho_0, so that they drop out), cubic B-spline, linear basis, full derivative for DNI."
    )
    alternative = (
        f"(63) and the linearised bar with SCNI differ by {side_by_side.within(printed)} of c/h; measured frequencies are off the curves of SCNI and DNI by "
        f"{side_by_side.within(measured)}. At kh = pi the largest linearised frequency is {within_pi}. Peaks: {'; '.join(peaks)}."
    )
    return Drawing(figure, caption, alternative)


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What (63) says near kh = pi and about stability."""
    near = tables["near_pi"].frame.set_index("support_ratio")
    share = near["ratio_090"].astype(float)
    zero_everywhere = bool((near["at_pi"].astype(float) == 0).all())
    span = f"R = {', '.join(p.support_ratios)}, kh = pi n/{p.samples}"
    is_square = all(consequences.lagrangian_as_square(m) == 0 for m in (1, 2, 3, 4))
    derived = consequences.lagrangian_tangent() == 0
    return [
        Statement(
            "tangent",
            ("E59", "C27"),
            "The derivative of P = S F with S from the Green strain is C^SE F^2 + S, for every F.",
            derived,
            "all F, free modulus",
            "proved",
        ),
        Statement(
            "stress",
            ("E53", "E54", "E55"),
            "Green strain, S and P as transcribed have the tangent (59).",
            derived,
            "all F, free modulus",
            "proved",
            routes=("the derivative is (59)",),
        ),
        Statement(
            "flat_before_pi",
            ("F4", "C32"),
            f"At kh = 0.9 pi the frequency for R = {p.named} is {share[p.named]:.3g} of its peak (for R = {share.index[0]} it is {share.iloc[0]:.3g}); "
            f"'very close to zero' is taken as below {p.close:g}. At kh = pi itself it is zero for every R tried, so that the zero there says nothing about R.",
            bool(share[p.named] < p.close) and zero_everywhere,
            span,
            "enclosed",
            p.close - float(share[p.named]),
            "share of the peak below the rule's bound",
            layer="printed",
        ),
        Statement(
            "stable_with_positive_modulus",
            ("C34", "C67"),
            "(63) is c^2 times a squared modulus, so that omega^2 >= 0 for every kh exactly when c^2 = (C^SE F^2 + S)/rho_0 >= 0 or the sum vanishes.",
            is_square,
            "free gradients of half-width 1 to 4, all kh and c^2",
            "proved",
            layer="printed",
        ),
        Statement(
            "dispersion_relation",
            ("E63", "C31"),
            "(63) follows from (61) with the plane wave (62), for gradients of any value.",
            all(step.follows for step in consequences.steps() if step.name.startswith("(61)")),
            "free gradients of half-width 1 to 3",
            "proved",
            layer="printed",
        ),
    ]


STUDY = Study(
    "Figure 4: frequency of Lagrangian RK with SCNI",
    Parameters(),
    Parameters(samples=24, layer_samples=16, layer_ratios=("1.5", "3.5"), waves=(4,)),
    compute,
    judge,
    draw,
)
