"""Separation and folding: where the chain rule (25) loses its digits, what acts across a gap, and what ends shape functions of x."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from rkverify.certify.mechanics import folding, lost_digits, separation
from rkverify.readings import NODAL_INTEGRATIONS
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Table, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

WITHIN = 1.5
"""Digits by which a loss may differ from log10 of the condition: constants and draws of rounding errors."""
SUMS = Numeric(1e-5, 1e-9, "sums of some thousand products in double precision, conditions up to 1e8")
ROUNDINGS = Numeric(1e-2, WITHIN, "digits lost are draws of rounding errors, other ones on other machines")
WORDS = {"SingularMomentMatrix": "M singular", "TooFewNodes": "too few nodes"}
ACTS = 1e-6
"""A force over mu times the width from which on something acts: rounding is some 1e-14."""
DISTANT = 10
"""A gap, in supports, across which no material holds together."""


@dataclass(frozen=True)
class Parameters:
    """Exponents of 10^-k and seeds for lost digits; halves; block and steps of the fold; stretches over the support ratio."""

    exponents: tuple[int, ...] = tuple(range(14))
    seeds: tuple[int, ...] = (0, 1, 2)
    columns: int = 5
    rows: int = 8
    radius: float = 2.3
    gaps: tuple[float, ...] = (0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, DISTANT, 100)
    steps: int = 280
    every: int = 4
    furthest: float = 3.0
    start: float = 1.5
    divisions: int = 12
    folds: tuple[float, ...] = tuple(round(0.1 * k, 1) for k in range(21))
    fold_steps: int = 200
    stretches: tuple[float, ...] = (0.5, 0.8, 0.9, 0.97, 0.99, 0.999, 1.01, 2.0, 10.0)
    side: int = 9


def compute(p: Parameters) -> Tables:
    """All motions."""
    patches = [lost_digits.patch(seed) for seed in p.seeds]
    lost = [lost_digits.digits(patches, motion, k) for motion in lost_digits.MOTIONS for k in p.exponents]
    h = separation.halves(p.columns, p.rows, p.radius, p.seeds[0])
    a = p.radius
    parting = separation.lagrangian_gap(h, 0.0, [a * gap for gap in p.gaps])
    met = [p.start * a * share for share in (1.0, 0.5, 0.0, -0.5)]
    meeting = separation.lagrangian_gap(h, p.start * a, met)
    parts, meets = [], []
    for integration in NODAL_INTEGRATIONS:
        parts += separation.semi_lagrangian_gap(h, integration, 0.0, p.furthest * a, p.steps, p.every)
        if integration != "scni":  # whose cells are those of one outline
            meets += separation.semi_lagrangian_gap(h, integration, p.start * a, 0.0, p.steps // 2, p.every)
    b = folding.block(p.divisions, a, p.seeds[0])
    led = [folding.semi_lagrangian_fold(b, i, p.folds[-1], p.fold_steps) for i in NODAL_INTEGRATIONS]
    ends = [
        *({"what": f"fold, {row['integration']}", "value": row["reached"], "stopped": row["stopped"]} for row in led),
        {"what": "fold, det F = 0", "value": folding.fold_starts(b), "stopped": ""},
        *(
            {"what": f"stretch, {i}", "value": folding.largest_stretch(p.side, a, i), "stopped": "TooFewNodes"}
            for i in ("dni", "scni")
        ),
    ]  # fmt: skip
    return {
        "digits": _digits_table(lost),
        "lagrangian_gap": _lagrangian_table(
            [{"motion": "parting", **row} for row in parting] + [{"motion": "meeting", **row} for row in meeting]
        ),
        "semi_lagrangian_gap": _semi_table(
            [{"motion": "parting", **row} for row in parts] + [{"motion": "meeting", **row} for row in meets]
        ),
        "fold": _fold_table(folding.lagrangian_fold(b, p.folds)),
        "stretch": table(
            folding.stretch(p.side, a, p.stretches),
            [
                ("stretch", "1", "stretch along x_1 over the support ratio R"),
                ("fixed", "1", "largest cond M over the nodes, supports fixed; inf: singular"),
                ("grown", "1", "the same with supports R times the larger spacing"),
            ],
            "A square lattice stretched along one axis.",
            SUMS,
        ),
        "ends": table(
            ends,
            [
                ("what", "", "motion and integration"),
                ("value", "1", "s of the fold, or stretch over R, up to which forces or gradients exist"),
                ("stopped", "", "the error that ends them; none where the end of the motion was reached"),
            ],
            "Where the semi-Lagrangian discretisation itself ends, with fixed supports.",
            Numeric(1e-6, 0.0101, "the last step that works: one step more or less"),
        ),
    }


def _digits_table(rows: Sequence[lost_digits.Row]) -> Table:
    columns = [
        ("motion", "", "fold: s/s_fold = 1 - closeness; flattening to a share; shear by 1/sqrt(share)"),
        ("closeness", "1", "10^-k: how near to det F = 0, the share that is left of a thickness"),
        ("det_F", "1", "least of the discrete det F over the node sets"),
        ("condition_F", "1", "largest cond F"),
        ("chain_rule_lost", "digits", "most digits lost by (25)"),
        ("condition_M", "1", "largest cond M at the place of the material point"),
        (
            "semi_lagrangian_lost",
            "digits",
            "most digits lost by gradients of shape functions of x; inf: there are none",
        ),
        ("stopped", "", "the error where there are none"),
    ]
    return table(rows, columns, "Digits lost in doubles against 40 digits.", ROUNDINGS)


def _lagrangian_table(rows: Sequence[separation.Row]) -> Table:
    columns = [
        ("motion", "", "parting: one plate, SCNI; meeting: two halves out of each other's reach, DNI"),
        ("gap", "1", "over the support radius; negative: the halves overlap"),
        ("pairs", "1", "pairs of nodes across, which never change"),
        (
            "st_venant_kirchhoff",
            "1",
            "force across over mu times the width; positive where the halves push each other away",
        ),
        ("neo_hookean", "1", "the same"),
        ("least_det_F", "1", "over the cells"),
        ("condition_F", "1", "largest over the cells"),
        ("overlap", "1", "nodes of the right half inside the left one"),
    ]
    return table(rows, columns, "Two halves with a gap, Lagrangian.", SUMS)


def _semi_table(rows: Sequence[separation.Row]) -> Table:
    columns = [
        ("motion", "", "parting or meeting"),
        ("integration", "", "dni, snni or scni"),
        ("gap", "1", "over the support radius"),
        ("pairs", "1", "pairs of nodes across"),
        ("force", "1", "force across over mu times the width, positive where the halves push each other away"),
        ("condition_nodes", "1", "largest cond M over the nodes"),
        ("condition_middle", "1", "largest cond M half-way in the gap; inf: none or singular"),
        ("stopped", "", "the error that ends the motion"),
    ]
    return table(rows, columns, "Two halves with a gap, semi-Lagrangian, fixed supports, Truesdell law.", SUMS)


def _fold_table(rows: Sequence[folding.Row]) -> Table:
    columns = [
        ("s", "1", "the map itself folds at 1"),
        ("least_det_F", "1", "over the cells"),
        ("condition_F", "1", "largest over the cells"),
        ("neo_hookean", "", "whether the stress with F^-1 exists in every cell"),
        ("st_venant_kirchhoff", "", "whether the stress without it does"),
        ("condition_M", "1", "largest over the nodes, semi-Lagrangian"),
        ("entered", "1", "pairs under supports of x that were none in X, over their number in X"),
        ("left", "1", "pairs that are none any more"),
    ]
    return table(rows, columns, "A block led through a fold.", SUMS)


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Lost digits, and what acts across a gap."""
    return {"digits": _draw_digits(tables["digits"].frame), "gap": _draw_gap(p, tables)}


def _draw_digits(frame: pd.DataFrame) -> Drawing:
    figure = new_figure(7.2, 3.0)
    panels = figure.subplots(1, 3, sharey=True)
    labels = {
        "fold": "fold: 1 − s/s₀  (1)",
        "flattening": "share of thickness  (1)",
        "shear": "1 / (amount of shear)²  (1)",
    }
    for axes, motion in zip(panels, lost_digits.MOTIONS, strict=True):
        part = frame[frame["motion"] == motion]
        x = part["closeness"]
        axes.plot(x, np.log10(part["condition_F"]), color="#999999", linewidth=1, label="log₁₀ cond F")
        axes.plot(
            x, part["chain_rule_lost"], **{**LINES[0], "linestyle": ""}, marker="o", ms=4, label="chain rule (25)"
        )
        there = part[np.isfinite(part["semi_lagrangian_lost"])]
        axes.plot(
            there["closeness"], there["semi_lagrangian_lost"], color=LINES[2]["color"], linestyle="", marker="^", ms=4,
            label="functions of x",
        )  # fmt: skip
        gone = part[~np.isfinite(part["semi_lagrangian_lost"])]
        if len(gone):
            first = gone["closeness"].max()
            axes.axvspan(x.min() / 3, first * 3, color="#DDDDDD", hatch="//", zorder=0)
            axes.annotate(
                f"none of x:\n{WORDS[gone['stopped'].iloc[0]]}", (first, 15.5), (1, 0), textcoords="offset points",
                fontsize=7, va="top",
            )  # fmt: skip
        axes.set(xscale="log", xlabel=labels[motion], title=motion, ylim=(-0.5, 16), xlim=(3, x.min() / 3))
    panels[0].set_ylabel("digits lost  (of 16)")
    panels[0].legend(fontsize=7, loc="upper left")
    caption = (
        "Digits lost by spatial gradients in doubles against 40 digits, the most of some sets of 7 by 7 jittered nodes in [-1, 1]², linear "
        f"basis, cubic kernel, supports of {lost_digits.SUPPORT_RATIO} spacings, at one material point. s₀: where the discrete det F is 0. "
        "Maps and parameters are ours."
    )
    told = []
    for motion in lost_digits.MOTIONS:
        part = frame[frame["motion"] == motion]
        there = part[np.isfinite(part["semi_lagrangian_lost"])]
        power = np.log10(part["condition_F"])
        # Above the first power of ten, where rounding of the last digits is no longer what is seen.
        chain = np.polyfit(power[power > 1], part["chain_rule_lost"][power > 1], 1)[0]
        stopped = f" and ends at cond F = {there['condition_F'].max():.0e} ({WORDS[part['stopped'].dropna().iloc[-1]]})" if len(there) < len(part) else ""  # fmt: skip
        told.append(
            f"{motion}: the chain rule loses {chain:.2f} digits for each power of ten of cond F; a gradient of functions of x has lost up to "
            f"{there['semi_lagrangian_lost'].max():.1f}{stopped}"
        )
    alternative = f"{'. '.join(word[0].upper() + word[1:] for word in told)}."
    return Drawing(figure, caption, alternative)


def _draw_gap(p: Parameters, tables: Tables) -> Drawing:
    lagrangian, semi = tables["lagrangian_gap"].frame, tables["semi_lagrangian_gap"].frame
    figure = new_figure(7.2, 3.0)
    parting, meeting, condition = figure.subplots(1, 3)
    style = {"dni": LINES[1], "snni": LINES[2], "scni": LINES[3]}
    reference = lagrangian[(lagrangian["motion"] == "parting") & (lagrangian["gap"] <= p.furthest)]
    parting.plot(reference["gap"], -reference["neo_hookean"], **LINES[0], marker="o", ms=3, label="Lagrangian")
    for axes, motion, sign in ((parting, "parting", -1), (meeting, "meeting", 1)):
        for name, part in semi[semi["motion"] == motion].groupby("integration"):
            axes.plot(part["gap"], sign * part["force"], **style[str(name)], label=str(name).upper())
    closed = lagrangian[(lagrangian["motion"] == "meeting") & (lagrangian["gap"] >= 0)]
    meeting.plot(closed["gap"], closed["neo_hookean"], **LINES[0], marker="o", ms=3)
    parting.set(title="parting", xlabel="gap / support  (1)", ylabel="pull across / (μ width)  (1)")
    meeting.set(title="meeting", xlabel="gap / support  (1)", ylabel="push across / (μ width)  (1)")
    meeting.axvline(1 - 1 / p.radius, color="#777777", linewidth=0.8)
    meeting.annotate(
        "nodes in reach", (1 - 1 / p.radius, 0.6), (3, 0), textcoords="offset points", fontsize=7, color="#555555"
    )
    parting.set_ylim(top=7.5)
    parting.legend(fontsize=7, loc="upper left", ncols=2, columnspacing=1)
    part = semi[(semi["motion"] == "parting") & (semi["integration"] == "dni")]
    condition.plot(part["gap"], part["condition_nodes"], **LINES[0], label="at the nodes")
    condition.plot(part["gap"], part["condition_middle"], **LINES[2], label="half-way in the gap")
    last = float(part["gap"][np.isfinite(part["condition_middle"])].max())
    condition.axvspan(last, p.furthest, color="#DDDDDD", hatch="//", zorder=0)
    condition.annotate("no shape\nfunctions there", (last, 100), (4, 0), textcoords="offset points", fontsize=7)
    condition.set(
        title="moment matrix",
        xlabel="gap / support  (1)",
        ylabel="cond M  (1)",
        yscale="log",
        xlim=(0, p.furthest),
        ylim=(10, 3e5),
    )
    condition.legend(fontsize=7, loc="upper right")
    caption = (
        f"Two halves of {p.columns} by {p.rows} nodes, spacing 1, supports {p.radius:g}, moved apart, or towards each other from a gap of "
        f"{p.start:g} supports without stress. Lagrangian: neo-Hookean. Semi-Lagrangian: Truesdell law, supports fixed; cells of SCNI are those of "
        "the whole outline. All parameters are ours."
    )
    pulls = -lagrangian[lagrangian["motion"] == "parting"].set_index("gap")["neo_hookean"]
    seen = part[np.isfinite(part["condition_middle"])]["condition_middle"]
    push = float(closed["neo_hookean"].abs().max())
    met = [
        f"{str(name).upper()} from {forces[forces['force'].abs() > ACTS]['gap'].max():.2g} supports on"
        for name, forces in semi[semi["motion"] == "meeting"].groupby("integration")
        if (forces[forces["gap"] >= 0]["force"].abs() > ACTS).any()
    ]
    alternative = (
        f"The Lagrangian pull across the gap grows at {int((pulls.diff().dropna() > 0).sum())} of {len(pulls) - 1} steps, to {pulls.iloc[-1]:.3g} at {pulls.index[-1]:g} supports; {_pulls(semi)}. "
        f"Meeting halves that have not touched push each other in the current configuration with {', '.join(met) or 'no integration'}; in the reference configuration the push is {rounding(push) if push < ACTS else f'{push:.2g}'} or less. "
        f"cond M is {part['condition_nodes'].min():.3g} to {part['condition_nodes'].max():.3g} at the nodes; in the gap it goes from {seen.iloc[0]:.2g} to {seen.iloc[-1]:.2g} at {last:.2g} supports, the last with shape functions there."
    )
    return Drawing(figure, caption, alternative)


def _pulls(semi: pd.DataFrame) -> str:
    """Where the pull of every integration ends, and by what."""
    told = []
    for name, part in semi[semi["motion"] == "parting"].groupby("integration"):
        there = part[np.isfinite(part["force"])]
        pulling = there[there["force"].abs() > ACTS]
        size, gap = pulling["force"].abs().max(), pulling["gap"].max()
        stopped = [WORDS[word] for word in part["stopped"] if word in WORDS]
        if gap < there["gap"].max():
            told.append(f"that of {str(name).upper()} reaches {size:.2g} and is gone beyond {gap:.2g} supports")
        else:
            end = f" (then {stopped[0]})" if stopped else ""
            told.append(f"that of {str(name).upper()} reaches {size:.2g} at {gap:.2g} supports, the last computed{end}")
    return "; ".join(told)


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Entries C7, C8, C22, C65 and C66."""
    lost, lag, semi, fold = (tables[n].frame for n in ("digits", "lagrangian_gap", "semi_lagrangian_gap", "fold"))
    ends = tables["ends"].frame.set_index("what")["value"]
    tried = f"fold, flattening and shear at {len(p.exponents)} distances, {len(p.seeds)} sets of jittered nodes in the plane"
    halves = f"two halves of {p.columns} by {p.rows} nodes, R = {p.radius:g}"
    led = f"block of {p.divisions} by {p.divisions} spacings, R = {p.radius:g}, s from 0 to {p.folds[-1]:g}"
    kept = (lost["chain_rule_lost"] - np.log10(lost["condition_F"])).abs() <= WITHIN
    worst = float(lost["condition_F"].max())
    starts = float(ends["fold, det F = 0"])
    gone = fold[~fold["neo_hookean"].astype(bool)]
    before = fold[fold["neo_hookean"].astype(bool)]
    apart, met = lag[lag["motion"] == "parting"], lag[lag["motion"] == "meeting"]
    far = apart[apart["gap"].round(6) == DISTANT].iloc[0]
    furthest = apart.iloc[-1]
    grows = bool((apart[["neo_hookean", "st_venant_kirchhoff"]].diff().dropna() < 0).all().all())
    silent = bool((met[["neo_hookean", "st_venant_kirchhoff"]].abs() <= 1e-12).all().all()) and met["overlap"].max() > 0
    defined = bool((lag["least_det_F"] > 0.5).all()) and np.isfinite(lag["condition_F"]).all()
    statements = [
        Statement(
            "chain_rule_digits",
            ("C7",),
            f"Spatial gradients by (25) lose a digit for each power of ten of cond F, within {WITHIN:g}: as det F goes to 0 in a fold and in a "
            f"flattening, and just so in a shear with det F = 1, up to cond F = {worst:.0e}. From det F = 0 on the stress of a law that needs F^-1 does not exist.",
            bool(kept.all()) and len(gone) > 0,
            tried,
            "sampled",
            float(np.log10(worst)),
            "powers of ten of cond F over which the loss was followed",
            reading="stress through F^-1, (24) and (25)",
        ),
        Statement(
            "no_inverse_needed",
            ("C7",),
            f"The kernel itself asks for no inverse: with P as a function of F in (21), as in St. Venant-Kirchhoff, the force exists in every cell up to s = {p.folds[-1]:g}, "
            f"beyond the fold at {starts:.3f}, with det F down to {fold['least_det_F'].min():.3g}.",
            not bool(fold["st_venant_kirchhoff"].all()),
            led,
            "sampled",
            reading="first Piola-Kirchhoff stress as a function of F, (21)",
        ),
        Statement(
            "fold_ends_it",
            ("C22",),
            f"Where the map folds, (24) ends: the stress with F^-1 exists up to s = {before['s'].max():g} and not from {gone['s'].min():g} on; "
            f"F is singular in the first cell at {starts:.3f} (the map itself at 1).",
            bool(before["s"].max() <= starts <= gone["s"].min()) and len(before) + len(gone) == len(fold),
            led,
            "sampled",
            reading="the map folds, det F = 0 in a cell",
        ),
        Statement(
            "surfaces_defined",
            ("C22", "C65"),
            f"New or closing surfaces leave F^-1 and the force defined: with a gap of {furthest['gap']:.0f} supports det F is at least {lag['least_det_F'].min():.3g} and cond F "
            f"{furthest['condition_F']:.3g}, so that about {np.log10(furthest['condition_F']):.0f} digits of 16 are lost; halves that pass through each other keep F = 1 with {met['overlap'].max()} nodes of one in the other.",
            not defined,
            halves,
            "sampled",
            reading="surfaces form or close: F^-1 or the force cease to be defined",
        ),
        Statement(
            "surfaces_described",
            ("C22", "C65"),
            f"They no longer describe what happens: all {far['pairs']} pairs across stay, and at a gap of {far['gap']:.0f} supports the halves still pull each other with {-far['neo_hookean']:.3g} mu times the width "
            f"(neo-Hookean; {-far['st_venant_kirchhoff']:.3g} St. Venant-Kirchhoff), the more the further; closing surfaces do not feel each other.",
            grows and silent and bool((apart["pairs"] == apart["pairs"].iloc[0]).all()),
            halves,
            "sampled",
            float(-far["neo_hookean"]),
            "force across a distant gap, over mu times the width",
            reading="surfaces form or close: no surface opens, none meets another",
        ),
    ]
    return statements + _of_semi_lagrangian(p, lost, semi, fold, ends, tried, halves, led)


def _of_semi_lagrangian(
    p: Parameters, lost: pd.DataFrame, semi: pd.DataFrame, fold: pd.DataFrame, ends: "pd.Series[float]", tried: str,
    halves: str, led: str,
) -> list[Statement]:  # fmt: skip
    starts, last = float(ends["fold, det F = 0"]), p.folds[-1]
    folded = lost[lost["motion"] == "fold"]
    flat = lost[(lost["motion"] == "flattening") & (lost["stopped"] != "")]
    sheared = lost[(lost["motion"] == "shear") & (lost["stopped"] != "")]
    statements = [
        Statement(
            "no_inverse_map",
            ("C8",),
            f"Gradients of shape functions of x lose at most {WITHIN:g} digits however near to the fold, down to det F = {folded['det_F'].min():.0e}, and DNI has forces from current positions "
            f"alone up to s = {ends['fold, dni']:g}, past the fold at {starts:.3f}; cond M at the nodes is at most {fold['condition_M'].max():.2g}.",
            bool((folded["semi_lagrangian_lost"] <= WITHIN).all()) and bool(ends["fold, dni"] > starts),
            f"{tried}; {led}",
            "sampled",
            float(ends["fold, dni"]) - starts,
            "how far beyond the fold, in s",
        )
    ]
    for name in ("dni", "snni"):
        parts, meets = (semi[(semi["motion"] == m) & (semi["integration"] == name)] for m in ("parting", "meeting"))
        acting = parts[parts["force"].abs() > ACTS]["gap"].max()
        first = meets[meets["force"].abs() > ACTS]["gap"].max()
        through = bool(
            (parts["stopped"] == "").all() and (meets["stopped"] == "").all() and ends[f"fold, {name}"] > starts
        )
        reached = ends[f"fold, {name}"]
        fate = "the end of the motion" if reached >= last else "where its own moment matrix becomes singular"
        statements.append(
            Statement(
                f"goes_on_{name}",
                ("C66",),
                f"{name.upper()} goes on through a fold to s = {reached:.3g} ({fate}; the fold is at {starts:.3f}) and through a gap of {parts['gap'].max():.2g} supports, across which nothing acts beyond "
                f"{acting:.2f}. The support and no law of fracture or contact decides it: the most pull is {-parts['force'].min():.3g} mu times the width, and halves that were never together push each "
                f"other from a gap of {first:.2f} supports on, before they touch, with {meets['force'].max():.3g} at contact.",
                through,
                f"{halves}; {led}",
                "sampled",
                float(reached) - starts,
                "how far beyond the fold, in s",
                reading=f"{name.upper()}, supports fixed",
            )
        )
    parts = semi[(semi["motion"] == "parting") & (semi["integration"] == "scni")]
    statements += [
        Statement(
            "scni_ends",
            ("C66",),
            f"SCNI with Voronoi cells of the moved outline ends in the fold at s = {ends['fold, scni']:.3g}, where nodes leave the outline (det F = 0 at {starts:.3f}); across a gap its cells keep the halves "
            f"together, with a pull that grows to {-parts['force'].min():.3g} mu times the width, until at {parts['gap'].max():.3g} supports facets in the gap are covered by too few nodes.",
            bool((parts["stopped"] == "").all()),
            f"{halves}; {led}",
            "sampled",
            reading="SCNI with cells of one outline, supports fixed",
        ),
        Statement(
            "stretched_out",
            ("C66",),
            f"With fixed supports a stretch along one axis ends the gradients at {ends['stretch, dni']:.3f} R (DNI) and {ends['stretch, scni']:.3f} R (SCNI), where the next column leaves the "
            f"supports; a shear ends them from cond F = {sheared['condition_F'].min():.0e} on, where (25) still has 16 less {np.log10(sheared['condition_F'].min()):.0f} digits.",
            bool(ends["stretch, dni"] > 1.5),
            f"square lattice of {p.side} by {p.side} nodes, R = {p.radius:g}; {tried}",
            "sampled",
            reading="supports fixed, stretched or sheared beyond them",
        ),
        Statement(
            "flattened",
            ("C66",),
            f"Flattened as a whole, nodes come to lie on a line and cond M grows as the inverse square of the thickness: the moment matrix is singular in doubles from a share of {flat['closeness'].max():.0e} "
            f"on, where (25) has lost {np.log10(flat['condition_F'].min()):.0f} digits of 16.",
            flat.empty,
            tried,
            "sampled",
            reading="everything under the supports flattened onto a line",
        ),
    ]
    return statements


STUDY = Study(
    "Separation and folding",
    Parameters(),
    Parameters(
        exponents=(0, 4, 8, 13), steps=70, every=2, divisions=8, fold_steps=50, folds=(0.0, 0.8, 0.9, 1.0, 1.2, 2.0)
    ),
    compute,
    judge,
    draw,
)
