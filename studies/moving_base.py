"""Waves on a base that moves (Q not 0): nonlinear growth, linear equations that follow the base, frozen coefficients."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from rkverify.readings import Convection
from rkverify.stability import passages
from rkverify.stability.passages import Wave
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd

AGREEMENT = 1e-3
STOPS = 0.1
EXPANSION, COMPRESSION = "expansion, Q > 0", "compression, Q < 0"


@dataclass(frozen=True)
class Parameters:
    """Waves on lattice and chain, velocity gradients, and the sweep of Q over the growth; h = rho = C = 1."""

    oscillating: tuple[Wave, ...] = (
        Wave("scni", "3/2", "-1/4", 0.6, "oscillating"),
        Wave("scni", "3/2", "-1/4", 2.0, "oscillating"),
        Wave("dni", "3/2", "-1/4", 0.6, "oscillating"),
        Wave("dni", "3/2", "-1/4", 2.0, "oscillating"),
    )
    growing: tuple[Wave, ...] = (
        Wave("dni", "3/2", "1/2", 3.0, "growing"),
        Wave("dni", "7/4", "-1/2", 3.0, "growing"),
        Wave("scni", "3/2", "-3/2", 2.0, "growing"),
    )
    gradients: tuple[str, ...] = ("-1/10", "1/10")
    duration: float = 2.0
    nodes: int = 31
    shares: tuple[str, ...] = ("1/100", "1/30", "1/10", "3/10")
    sweep_convections: tuple[Convection, ...] = ("none", "true")


def compute(p: Parameters) -> Tables:
    """Passages on the lattice and on a chain, and the sweep."""
    waves = (*p.oscillating, *p.growing[:1])
    rows = passages.lattice_rows(waves, p.gradients, p.duration)
    rows += passages.chain_rows(waves, p.gradients, p.duration, p.nodes)
    both = [f"-{share}" for share in reversed(p.shares)] + list(p.shares)
    sweep = passages.validity_rows(p.growing, both, p.sweep_convections)
    why = "nonlinear integrations agree with the linear equations to 1e-4; the processor changes far less"
    for row in [*rows, *sweep]:
        # The error is rounding and time steps: what counts is that it stays below what is asked for.
        row["agrees"] = row.pop("error") <= AGREEMENT
    return {
        "passages": table(
            rows,
            [
                ("domain", "", "periodic lattice, or finite chain with free ends under dead loads"),
                ("integration", "", "scni or dni"),
                ("convection", "", "N with Psi*, with the true rate, or none"),
                ("Q", "1/time", "velocity gradient of the base at the start, in c/h"),
                ("support_ratio", "1", "R = a/h at the start"),
                ("stress_ratio", "1", "sigma/C^sigma at the start"),
                ("kh", "rad", "wave number times spacing"),
                ("start", "", "mode of the frozen base that the wave starts as"),
                ("duration", "time", "h/c"),
                ("frequency", "1/time", "of that mode"),
                ("nonlinear", "1/time", "mean growth of the wave in the nonlinear motion"),
                ("moving", "1/time", "mean growth by the linear equations that follow the base"),
                ("frozen", "1/time", "mean growth with the coefficients of the start"),
                ("agrees", "", f"whether nonlinear and moving waves differ by at most {AGREEMENT:g} of the wave"),
            ],
            "Mean growth of waves while the base stretches or shrinks.",
            Numeric(1e-3, 1e-5, why),
        ),
        "sweep": table(
            sweep,
            [
                ("integration", "", "scni or dni"),
                ("support_ratio", "1", "R = a/h at the start"),
                ("stress_ratio", "1", "sigma/C^sigma at the start"),
                ("kh", "rad", "wave number times spacing"),
                ("convection", "", "N with the true rate, or none"),
                ("Q_over_growth", "1", "Q over the growth at rest"),
                ("growth_at_rest", "1/time", "growth of the mode at Q = 0, without N"),
                ("frozen", "1/time", "growth with the coefficients of the start"),
                ("moving", "1", "mean growth by the equations that follow the base, over the frozen one"),
                ("nonlinear", "1", "mean growth in the nonlinear motion, over the frozen one"),
                ("agrees", "", f"whether nonlinear and moving waves differ by at most {AGREEMENT:g} of the wave"),
            ],
            "Growing waves over one e-folding time of the frozen base.",
            Numeric(1e-3, 1e-5, why),
        ),
    }


def _name(row: "pd.Series[str]") -> str:
    return f"{row['integration'].upper()}, R = {row['support_ratio']}, σ/C = {row['stress_ratio']}"


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Left: what N does to an oscillating wave; right: where frozen coefficients stop meaning anything."""
    figure = new_figure(10, 5.2)
    left, right = figure.subplots(1, 2)
    bars = _oscillating(tables)
    for place, (_, row) in enumerate(bars.iterrows()):
        colour = {"none": "#000000", "true": "#0072B2", "psi-star": "#D55E00"}[row["convection"]]
        hatch = {"none": "", "true": "//", "psi-star": ".."}[row["convection"]]
        left.barh(
            place, row["nonlinear"] / abs(float(Fraction(row["Q"]))), color="white", edgecolor=colour, hatch=hatch
        )
    left.set_yticks(
        range(len(bars)),
        [
            f"{r['integration'].upper()}, kh = {r['kh']:.2g}, Q = {float(Fraction(r['Q'])):g}, {_WORDS[r['convection']]}"
            for _, r in bars.iterrows()
        ],
        fontsize=7,
    )
    left.axvline(0, color="#606060", linewidth=0.8)
    left.set_xlabel("mean growth of an oscillating wave / |Q|  (1)")
    sweep = tables["sweep"].frame
    part = sweep[sweep["convection"] == "none"]
    for style, marker, (_, group) in zip(
        LINES, "os^", part.groupby(["integration", "support_ratio", "stress_ratio"], sort=False), strict=False
    ):
        shares = [float(Fraction(q)) for q in group["Q_over_growth"]]
        right.plot(shares, group["moving"], label=_name(group.iloc[0]), **style)
        right.plot(shares, group["nonlinear"], linestyle="", marker=marker, color=style["color"])
    right.axhspan(1 - STOPS, 1 + STOPS, color="#E4E4E4", zorder=0)
    right.set(xlabel="Q / growth at rest  (1)", ylabel="mean growth / frozen growth  (1)")
    right.legend(fontsize=8)
    found = _limits(p, tables)
    both = [_changes(tables, "chain", n, "nonlinear") for n in ("psi-star", "true")]
    expanding, shrinking = (
        [float(c) for frame in both for c in frame[frame["sign"] == sign]["change"]]
        for sign in (EXPANSION, COMPRESSION)
    )
    caption = (
        f"Left: an oscillating wave on a finite chain of {p.nodes} nodes over {p.duration:g} h/c in the nonlinear equations, without N, with the true rate "
        f"and with Psi* (R = {p.oscillating[0].support_ratio}, sigma/C = {p.oscillating[0].stress_ratio}, kh = {' and '.join(f'{kh:g}' for kh in sorted({wave.kh for wave in p.oscillating}))}). Right: growing waves over one e-folding time without N: lines "
        f"are the linear equations that follow the base, markers the nonlinear motion, the grey band +-{STOPS:.0%}. All parameters are ours; cubic "
        "kernel, linear basis, Truesdell rate."
    )
    alternative = (
        f"N lowers the growth of oscillating waves, with Psi* and with the true rate, in {sum(c < 0 for c in expanding)} of {len(expanding)} cases where the base expands and raises it in "
        f"{sum(c > 0 for c in shrinking)} of {len(shrinking)} where it shrinks. "
        f"Growth with frozen coefficients is off by more than {STOPS:.0%} "
        + "; ".join(f"{_shown(p, value)} for {name}" for name, value in found.items())
        + "."
    )
    return {"moving_base": Drawing(figure, caption, alternative)}


_WORDS = {"none": "no N", "true": "true rate", "psi-star": "Ψ*"}


def _oscillating(tables: Tables) -> "pd.DataFrame":
    frame = tables["passages"].frame
    return frame[(frame["domain"] == "chain") & (frame["start"] == "oscillating")]


def _limits(p: Parameters, tables: Tables) -> dict[str, float]:
    """|Q|/growth at which the growth over one e-folding time is off the frozen one by a tenth, for either sign."""
    frame = tables["sweep"].frame
    found = {}
    for _, group in frame[frame["convection"] == "none"].groupby(
        ["integration", "support_ratio", "stress_ratio"], sort=False
    ):
        shares = group["Q_over_growth"].map(Fraction)
        ends = []
        for sign in (-1, 1):
            side = group[shares * sign > 0]
            sizes = [abs(float(Fraction(q))) for q in side["Q_over_growth"]]
            order = sorted(range(len(sizes)), key=sizes.__getitem__)
            values = [float(side["moving"].iloc[n]) for n in order]
            ends.append(passages.first_beyond([sizes[n] for n in order], values, STOPS))
        found[_name(group.iloc[0])] = min(ends)
    return found


def _shown(p: Parameters, limit: float) -> str:
    if limit < float("inf"):
        return f"beyond |Q|/growth = {limit:.2g}"
    return f"nowhere up to |Q|/growth = {p.shares[-1]}"


def _changes(tables: Tables, domain: str, with_n: str, column: str) -> "pd.DataFrame":
    """Rows of oscillating waves: growth with N less growth without, and the frequency."""
    frame = tables["passages"].frame
    part = frame[(frame["domain"] == domain) & (frame["start"] == "oscillating")]
    keys = ["integration", "Q", "kh"]
    pair = part[part["convection"] == with_n].merge(part[part["convection"] == "none"], on=keys, suffixes=("", "_none"))
    pair["change"] = pair[column] - pair[f"{column}_none"]
    pair["sign"] = pair["Q"].map(lambda q: EXPANSION if Fraction(q) > 0 else COMPRESSION)
    return pair


LAYERED = (
    ("as-defined", "chain", "psi-star", "moving", ""),
    ("consistent", "lattice", "true", "moving", ""),
    ("simulated", "chain", "psi-star", "nonlinear", "Psi*"),
    ("simulated", "chain", "true", "nonlinear", "true rate"),
)


def _told(part: "pd.DataFrame") -> str:
    """The changes of growth, wave by wave."""
    return ", ".join(f"{c:+.3g} (kh = {kh:.2g})" for c, kh in zip(part["change"], part["kh"], strict=True))


def _on_n(changes: "pd.DataFrame", layer: str, with_n: str, reading: str, where: str) -> list[Statement]:
    """What N does to the growth of every wave, for either sign of Q; the worst wave decides."""
    words, key = {"psi-star": "Psi*", "true": "the true rate"}[with_n], f"{layer}_{with_n}".replace("-", "_")
    found = []
    for sign in (EXPANSION, COMPRESSION):
        part = changes[changes["sign"] == sign]
        scni, dni = (part[part["integration"] == i] for i in ("scni", "dni"))
        size = abs(float(Fraction(part["Q"].iloc[0])))
        least, most = float(scni["change"].min()), float(scni["change"].max())
        worst = float(part["change"].max())
        rules = {
            "scni": (("C4", "C56"), most <= 0, most, "'no harm' is taken as no increase for any wave"),
            "slightly": (
                ("C57", "C69"),
                -size < least and most < 0,
                most,
                "'slightly more stable' is taken as a decrease for every wave by less than |Q|, the rate of the base itself",
            ),
            "dni": (
                ("C58",),
                worst <= 0,
                worst,
                f"for DNI waves by {_told(dni)}; 'a similar effect' of no harm is taken as no increase for any wave of either",
            ),
        }
        for name, (about, holds, change, rule) in rules.items():
            found.append(
                Statement(
                    f"{name}_{key}_{sign.split(',')[0]}",
                    about,
                    f"With {words} and Q = {part['Q'].iloc[0]} c/h N makes {int((scni['change'] > 0).sum())} of {len(scni)} SCNI waves grow faster: it changes their growth by {_told(scni)} c/h; {rule}.",
                    holds,
                    where,
                    "sampled",
                    -change,
                    "growth without N less growth with it, of the worst wave; c/h",
                    layer=layer,
                    reading=f"{reading}, {sign}" if reading else sign,
                )
            )
    scni = changes[changes["integration"] == "scni"].pivot(index="kh", columns="sign", values="change")
    opposite = int((scni[EXPANSION] * scni[COMPRESSION] < 0).sum())
    gap = float((scni[COMPRESSION] - scni[EXPANSION]).abs().max())
    found.append(
        Statement(
            f"sign_of_Q_{key}",
            ("C43",),
            f"With {words} N damps {opposite} of {len(scni)} SCNI waves under one sign of Q and drives them under the other: their growth changes by up to {gap:.3g} c/h when Q changes its sign. "
            "The sign would not matter if N did the same under both.",
            opposite == 0,
            where,
            "sampled",
            -gap,
            "minus the largest difference between the two signs; c/h",
            layer=layer,
            reading=reading,
        )
    )
    return found


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Whether the linear equations are right, and what N does to stability."""
    frame, sweep = tables["passages"].frame, tables["sweep"].frame
    w, waves = p.oscillating[0], " and ".join(f"{kh:g}" for kh in sorted({wave.kh for wave in p.oscillating}))
    tried = (
        f"oscillating waves, R = {w.support_ratio}, sigma/C = {w.stress_ratio}, kh near {waves}, Q = {', '.join(p.gradients)} c/h over {p.duration:g} h/c; "
        "cubic kernel, linear basis, Truesdell rate"
    )
    agreed = int(frame["agrees"].sum() + sweep["agrees"].sum())
    total = len(frame) + len(sweep)
    limits = _limits(p, tables)
    statements = [
        Statement(
            "agreement",
            (),
            f"In {agreed} of {total} settings with Q not 0 the nonlinear perturbation is that of the linear equations whose coefficients follow the base, to {AGREEMENT:g} of the wave: "
            "SCNI and DNI, both signs of Q, without N, with the true rate, and with Psi* on a finite chain.",
            agreed == total,
            "the tables' settings",
            "sampled",
            routes=("nonlinear motion against its linear equations",),
        ),
        Statement(
            "frozen_limit",
            (),
            "Growth with frozen coefficients is off by more than a tenth over one e-folding time "
            + "; ".join(f"{_shown(p, value)} ({name})" for name, value in limits.items())
            + ": the base takes the support ratio and the stress with it.",
            min(limits.values()) < float("inf"),
            f"|Q|/growth up to {p.shares[-1]}",
            "sampled",
            min(limits.values()),
            "least |Q|/growth at which the frozen growth is off by a tenth",
        ),
    ]
    for layer, domain, with_n, column, reading in LAYERED:
        changes = _changes(tables, domain, with_n, column)
        source = "nonlinear motion" if column == "nonlinear" else "linear equations that follow the base"
        statements += _on_n(changes, layer, with_n, reading, f"{tried}; {source}, {domain}")
    return statements


STUDY = Study(
    "Waves on a base that moves",
    Parameters(),
    Parameters(
        oscillating=(Wave("scni", "3/2", "-1/4", 2.0, "oscillating"), Wave("dni", "3/2", "-1/4", 2.0, "oscillating")),
        growing=(Wave("dni", "7/4", "-1/2", 3.0, "growing"),),
        duration=0.25,
        nodes=9,
        shares=("1/10",),
        sweep_convections=("none",),
    ),
    compute,
    judge,
    draw,
)
