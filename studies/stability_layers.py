"""Every stability claim, layer by layer: the print, the method as defined, the consistent method, nonlinear computations."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

from rkverify.certify import consequences
from rkverify.stability import verdicts
from rkverify.stability.layers import Setting
from rkverify.stability.side_by_side import SEVERAL
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure
from studies._claims import ALL, NONE, SOME, Claim, number, rows, statements

if TYPE_CHECKING:
    import pandas as pd

METHODS = (("scni", "full"), ("dni", "full"), ("dni", "diffuse"))
ANALYTIC = ("printed", "as-defined", "consistent")
LAYERS = (*ANALYTIC, "simulated")
CLOSE = 0.05
"""What 'very close to zero' may be of the peak, as for Figure 4."""


@dataclass(frozen=True)
class Parameters:
    """Support ratios (narrow: where the paper prints its relations), stresses, base motions, and what is measured."""

    narrow: tuple[str, ...] = ("11/10", "13/10", "3/2", "7/4", "19/10")
    wide: tuple[str, ...] = ("9/4", "5/2", "7/2")
    stresses: tuple[str, ...] = ("-2", "-3/2", "-1/2", "-1/10", "1/10", "1/2", "2")
    moving_stresses: tuple[str, ...] = ("-3/2", "-1/2", "1/2")
    moving_gradients: tuple[str, ...] = ("-2", "2")
    spacing: str = "1/20"
    frame_velocity: str = "5"
    stretches: tuple[str, ...] = ("4/5", "6/5")
    samples: int = 24
    measured_ratios: tuple[str, ...] = ("3/2", "7/4")
    measured_stresses: tuple[str, ...] = ("-3/2", "-1/2", "1/2", "2")
    measured_waves: tuple[float, ...] = (pi / 8, pi / 2, 7 * pi / 8, pi)
    compared: tuple[tuple[str, str, str, str], ...] = (
        ("scni", "full", "3/2", "-3/2"),
        ("scni", "full", "3/2", "1/2"),
        ("scni", "full", "7/4", "-3/2"),
        ("scni", "full", "7/4", "1/2"),
        ("scni", "full", "5/2", "1/2"),
        ("dni", "full", "3/2", "1/2"),
        ("dni", "full", "3/2", "-1/2"),
        ("dni", "full", "8/5", "1/2"),
        ("dni", "full", "8/5", "-1/2"),
        ("dni", "full", "7/4", "1/2"),
        ("dni", "full", "7/4", "-1/2"),
        ("dni", "full", "19/10", "-1/2"),
        ("dni", "full", "5/2", "-1/2"),
        ("dni", "full", "7/2", "1/2"),
        ("dni", "full", "7/2", "-1/2"),
        ("dni", "frozen", "5/2", "1/2"),
        ("dni", "frozen", "27/10", "1/2"),
        ("dni", "frozen", "3", "1/2"),
        ("dni", "diffuse", "3/2", "1/2"),
        ("dni", "diffuse", "7/4", "1/2"),
        ("dni", "diffuse", "7/4", "-1/2"),
    )
    other_kernels: tuple[tuple[str, str], ...] = (
        ("quartic", "9/5"), ("quartic", "19/10"), ("quartic", "5/2"), ("quartic", "27/10"),
        ("quintic", "2"), ("quintic", "21/10"), ("quintic", "27/10"), ("quintic", "14/5"),
        ("wendland-c2", "17/10"), ("wendland-c2", "9/5"), ("wendland-c2", "43/20"), ("wendland-c2", "9/4"),
        ("wendland-c4", "21/10"), ("wendland-c4", "11/5"), ("wendland-c4", "5/2"), ("wendland-c4", "13/5"),
    )  # fmt: skip
    compared_wave: float = 7 * pi / 8
    named: str = "7/2"


def _settings(p: Parameters, layer: Any) -> list[Setting]:
    """The settings of one analytic layer: at rest over R and stress, with Q at the paper's spacing, and the bar."""
    ratios = p.narrow if layer == "printed" else (*p.narrow, *p.wide)
    found = [
        Setting("semi-lagrangian", i, R, s, derivative=d, layer=layer)  # type: ignore[arg-type]
        for i, d in METHODS
        for R in ratios
        for s in p.stresses
    ]
    found += [
        Setting(
            "semi-lagrangian", i, R, s, velocity_gradient=Q, spacing=p.spacing, derivative=d, layer=layer,  # type: ignore[arg-type]
            convective=convective,
        )
        for i, d in METHODS
        for R in p.measured_ratios
        for s in p.moving_stresses
        for Q in p.moving_gradients
        for convective in (True, False)
    ]  # fmt: skip
    if layer != "printed":  # the print knows no frame
        found += [
            Setting(
                "semi-lagrangian", "scni", R, s, velocity_gradient=Q, spacing=p.spacing, frame_velocity=p.frame_velocity,
                layer=layer,
            )
            for R in p.measured_ratios
            for s in p.moving_stresses
            for Q in ("0", *p.moving_gradients)
        ]  # fmt: skip
    found += [
        Setting("lagrangian", "scni", R, s, F, layer=layer) for R in ratios for s in p.stresses for F in p.stretches
    ]
    return found


def _measured(p: Parameters) -> list[dict[str, Any]]:
    """Measured growth, the largest over the waves, of every method; and of the bar."""
    found = []
    for R in p.measured_ratios:
        for s in p.measured_stresses:
            settings = [Setting("semi-lagrangian", i, R, s, derivative=d, layer="simulated") for i, d in METHODS]  # type: ignore[arg-type]
            settings.append(Setting("lagrangian", "scni", R, s, p.stretches[-1], layer="simulated"))
            for setting in settings:
                found.append(verdicts.measured_growth(setting, p.measured_waves))
    return found


def compute(p: Parameters) -> Tables:
    """Growth in every layer, waves measured beside their eigenvalues, and what happens at kh = pi."""
    grid = [row for layer in ANALYTIC for row in verdicts.growth_rows(_settings(p, layer), p.samples)]
    grid += _measured(p)
    compared = [
        verdicts.measured_row(Setting("semi-lagrangian", i, R, s, derivative=d, convective=False), p.compared_wave)  # type: ignore[arg-type]
        for i, d, R, s in p.compared
    ]
    compared += [
        verdicts.measured_row(
            Setting("semi-lagrangian", "dni", R, "1/2", kernel=kernel, layer="as-defined", convective=False), pi
        )
        for kernel, R in p.other_kernels
    ]
    compared.append(verdicts.measured_row(Setting("lagrangian", "scni", p.named, "1/2"), p.compared_wave))
    compared.append(verdicts.measured_row(Setting("lagrangian", "scni", "3/2", "-3/2"), p.compared_wave))
    cutoff = [{"support_ratio": R, "no_force": verdicts.cutoff_force(R)} for R in (*p.narrow, *p.wide)]
    late = [verdicts.late_frequency(R, p.samples) for R in (p.narrow[0], p.named)]
    where = [
        ("formulation", "", "lagrangian or semi-lagrangian"),
        ("integration", "", "scni or dni"),
        ("derivative", "", "reading of the derivative, for DNI"),
        ("layer", "", "printed, as-defined, consistent or simulated"),
        ("convective", "", "with N, or without"),
        ("support_ratio", "1", "R = a/h"),
        ("stress_ratio", "1", "sigma/C^sigma, or S/C^SE"),
        ("stretch", "1", "F, for the Lagrangian form"),
        ("Q", "1/time", "velocity gradient"),
        ("spacing", "length", "h"),
        ("V", "length/time", "velocity of the node at which the equation is written"),
    ]
    why = "eigenvalues and time integrations in double precision, known to 1e-6 where they are not zero"
    return {
        "growth": table(
            grid,
            [
                *where,
                ("growth", "1", "largest growth h/c over kh; below 1e-6 none, in simulations below 1e-3"),
                ("kh", "rad", "where it is"),
                ("imaginary", "1", "largest |Im omega| h/c over kh, of the two roots that move"),
                ("unstable", "", f"whether the growth is beyond {SEVERAL}|Q|: below that the base changes as fast"),
            ],
            f"Largest growth over kh = pi n/{p.samples}; simulated: over kh near {', '.join(f'{k:.3g}' for k in p.measured_waves)}.",
            Numeric(1e-5, 1e-5, why),
        ),
        "measured": table(
            compared,
            [
                *[c for c in where if c[0] not in ("layer", "convective", "Q", "spacing", "V")],
                ("kernel", "", "of the shape functions"),
                ("kh", "rad", "wave number that fits on the chain"),
                ("quantity", "", "growth where the wave grows, frequency where it does not"),
                ("measured", "1/time", "in the nonlinear computation"),
                ("computed", "1/time", "from the linearised equations"),
                ("printed", "1/time", "from the printed relation; empty where there is none"),
                ("factor", "1", "printed over computed"),
                ("agrees", "", "whether measured and computed agree to one part in a thousand"),
            ],
            "Waves measured in nonlinear computations at rest, without N, beside eigenvalues and printed relations.",
            Numeric(1e-5, 1e-5, why),
        ),
        "cutoff": table(
            cutoff,
            [("support_ratio", "1", "R = a/h"), ("no_force", "", "whether the wave kh = pi meets no force at all")],
            "Lagrangian bar with SCNI at kh = pi, in exact rationals.",
            Numeric(0, 0, "exact"),
        ),
        "late": table(
            late,
            [
                ("support_ratio", "1", "R = a/h"),
                ("peak", "1", "largest computed omega h/c"),
                ("kh", "rad", "wave number near 0.9 pi that fits on the chain"),
                ("measured", "1", "measured omega h/c there"),
            ],
            "Measured frequency of the Lagrangian bar with SCNI near kh = pi.",
            Numeric(1e-5, 1e-8, why),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The largest growth over R in tension and compression: print, linearisation, simulation."""
    frame = tables["growth"].frame
    frame = frame[(frame["formulation"] == "semi-lagrangian") & (frame["Q"] == "0")]
    figure = new_figure(10.0, 4.4)
    panels = figure.subplots(1, 2, sharey=True)
    for axes, s in zip(panels, ("1/2", "-1/2"), strict=True):
        for (integration, derivative), colour in zip(METHODS, ("#000000", "#0072B2", "#D55E00"), strict=True):
            of = frame[
                (frame["integration"] == integration)
                & (frame["derivative"] == derivative)
                & (frame["stress_ratio"] == s)
            ]
            name = integration.upper() + (f", {derivative}" if integration == "dni" else "")
            for layer, style in (("as-defined", LINES[0]), ("printed", LINES[2])):
                part = of[of["layer"] == layer]
                R = number(part, "support_ratio")
                axes.plot(R, part["growth"], label=f"{name}: {layer}", **{**style, "color": colour})
            part = of[of["layer"] == "simulated"]
            axes.plot(number(part, "support_ratio"), part["growth"], linestyle="", marker="o", color=colour)
        axes.set(xlabel="support ratio R = a/h  (1)", title=f"{'tension' if s[0] != '-' else 'compression'}, σ/C = {s}")
    panels[0].set_ylabel("largest growth h/c  (1)")
    panels[1].legend(fontsize=8, title="simulated: dots")
    waves = ", ".join(f"{k:.3g}" for k in p.measured_waves)
    caption = (
        f"Largest growth at rest over kh = pi n/{p.samples} (simulated: kh near {waves}), over R: (86), (87) as printed for 1 < R < 2, the linearised equations "
        "(as-defined and consistent are the same at rest), nonlinear computations. All parameters ours; cubic kernel, linear basis, Truesdell rate."
    )
    drawn = frame[frame["stress_ratio"].isin(("1/2", "-1/2"))]
    scni = drawn[(drawn["integration"] == "scni") & (drawn["layer"] == "as-defined")]["growth"].max()
    setting = ["integration", "derivative", "support_ratio", "stress_ratio"]
    growths = drawn.pivot_table(index=setting, columns="layer", values="growth")
    apart = float((growths["simulated"] - growths["as-defined"]).abs().max())
    alternative = (
        f"SCNI, linearised, grows by {scni:g} at most in tension and compression. "
        f"DNI with the full derivative, linearised, grows in tension at R = {_grows(frame, 'as-defined', '1/2')} and in compression at R = {_grows(frame, 'as-defined', '-1/2')}; "
        f"as printed it grows in tension at R = {_grows(frame, 'printed', '1/2')} and in compression at {_grows(frame, 'printed', '-1/2') or 'no R'}. The measured dots are off the linearised curves by {apart:.1e} at most."
    )
    return {"layers": Drawing(figure, caption, alternative)}


def _grows(frame: "pd.DataFrame", layer: str, s: str) -> str:
    part = rows("dni", lambda _: True, derivative="full")(
        frame[(frame["layer"] == layer) & (frame["stress_ratio"] == s)]
    )
    return ", ".join(part[part["unstable"]]["support_ratio"])


def _stable(tangent_less_one: float) -> bool:
    return tangent_less_one > -1


def _unstable(tangent_less_one: float) -> bool:
    return tangent_less_one < -1


def _tension(stress: float) -> bool:
    return stress > 0


def _mild_compression(stress: float) -> bool:
    return -1 < stress < 0


def _claims(p: Parameters) -> list[Claim]:
    """The claims and their rules."""
    bar = "lagrangian"
    found = [
        Claim(
            "lagrangian_stable", ("C2", "C34", "C67"), "Lagrangian SCNI where C F^2 + S > 0 does not grow",
            rows("scni", _stable, bar), NONE, LAYERS,
        ),
        Claim(
            "lagrangian_unstable", ("C67",), "Lagrangian SCNI where C F^2 + S < 0 grows as the continuum does",
            rows("scni", _unstable, bar), ALL, LAYERS,
        ),
        Claim(
            "dni_somewhere", ("C62",), "DNI grows somewhere although the continuum is stable",
            rows("dni", _stable), SOME, LAYERS,
        ),
        Claim(
            "no_tensile_instability", ("C59",), "SCNI does not grow in tension",
            rows("scni", _tension, still=True), NONE, ("simulated",),
        ),
        Claim(
            "turns_stable", ("C52",), "DNI does not grow where C + sigma < 0", rows("dni", _unstable), NONE, ("simulated",)
        ),
        Claim(
            "unphysical", ("C53",), "A stable DNI system where the continuum is unstable does not arise: DNI grows there",
            rows("dni", _unstable), ALL, ("simulated",), decides=False,
        ),
    ]  # fmt: skip
    found.append(
        Claim(
            "scni_stable_frame", ("C2", "C42", "C62"),
            f"SCNI where C + sigma > 0, written at a node that moves with V = {p.frame_velocity} c, does not grow faster than {SEVERAL}|Q|",
            rows("scni", _stable, frame=True), NONE, ANALYTIC, "V not 0",
        )
    )  # fmt: skip
    for reading, still in (("Q = 0", True), ("Q not 0", False)):
        at = f"{'at rest' if still else 'on a base in motion'}"
        found += [
            Claim(
                "scni_stable", ("C2", "C42", "C62"),
                f"SCNI where C + sigma > 0, with N and without, {at}, does not grow faster than {SEVERAL}|Q|",
                rows("scni", _stable, still=still), NONE, LAYERS, reading,
            ),
            Claim(
                "scni_real", ("C44",), f"SCNI at R = 3/2 where C + sigma > 0, {at}: every frequency is real",
                rows("scni", _stable, still=still, ratios=("3/2",), with_n=True), NONE, LAYERS, reading, "imaginary",
            ),
            Claim(
                "scni_unstable", ("C45",), f"SCNI at R = 3/2 where C + sigma < 0, {at}, grows",
                rows("scni", _unstable, still=still, ratios=("3/2",)), ALL, LAYERS, reading,
            ),
        ]  # fmt: skip
    for derivative in ("full", "diffuse"):
        for R in p.measured_ratios:
            reading = f"{derivative} derivative, R = {R}"
            found += [
                Claim(
                    "dni_tension", ("C50", "C71"), "DNI grows in tension",
                    rows("dni", _tension, derivative=derivative, ratios=(R,)), ALL, LAYERS, reading,
                ),
                Claim(
                    "dni_tension_at_rest", ("C60", "C49"), "DNI grows in tension, where sigma Psi,xx(h) > 0",
                    rows("dni", _tension, still=True, derivative=derivative, ratios=(R,)), ALL, ("simulated",), reading,
                ),
                Claim(
                    "dni_compression_at_rest", ("C49",), "DNI does not grow in mild compression, where sigma Psi,xx(h) < 0",
                    rows("dni", _mild_compression, still=True, derivative=derivative, ratios=(R,)), NONE, ("simulated",), reading,
                ),
            ]  # fmt: skip
    return found


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """The claims by their rules; measured against computed; kh = pi."""
    measured, cutoff, late = (tables[name].frame for name in ("measured", "cutoff", "late"))
    last = late.set_index("support_ratio").loc[p.named]
    share = float(last["measured"] / last["peak"])
    factors = measured[measured["factor"].notna()]["factor"]
    others = factors[(factors != 0) & (abs(factors - 1) >= 1e-9)]
    agreed = int(measured["agrees"].sum())
    return [
        *statements(_claims(p), tables["growth"].frame),
        Statement(
            "measured",
            ("E65", "E56"),
            f"In {agreed} of {len(measured)} settings at rest the growth, or the frequency, measured in the nonlinear equations is that of the linearised ones to one part in a "
            f"thousand. Of {len(factors)} printed counterparts {int((abs(factors - 1) < 1e-9).sum())} are the same, {int((factors == 0).sum())} say the opposite of grow or oscillate, and the others are "
            f"off by factors of {others.min():.3g} to {others.max():.3g}.",
            agreed == len(measured),
            "SCNI and DNI, tension and compression, R on either side of the turns; kh near 7 pi/8 (cubic kernel) and pi (the others), linear basis",
            "sampled",
            routes=("growth measured in nonlinear computations",),
        ),
        Statement(
            "late",
            ("C32",),
            f"At R = {p.named} the measured frequency at kh = {last['kh']:.3f} is {share:.3g} of the peak; 'very close to zero' is taken as below {CLOSE:g}.",
            share < CLOSE,
            f"Lagrangian SCNI, R = {p.named}; cubic kernel, linear basis",
            "sampled",
            CLOSE - share,
            "share of the peak below the rule's bound",
            layer="simulated",
        ),
        Statement(
            "distinct_roots",
            ("C30",),
            "Two different real frequencies give waves of constant amplitude: |e^{i omega t}| = 1 for real omega.",
            consequences.real_frequencies_keep_amplitudes(),
            "all real omega",
            "proved",
            layer="printed",
            reading="omega not 0",
        ),
        Statement(
            "double_root",
            ("C30",),
            "Where omega = 0 is a double root, as at kh = pi with SCNI for every R tried, the wave meets no force at all and "
            "drifts with the velocity that it has: real, and not bounded.",
            not bool(cutoff["no_force"].all()),
            f"R = {', '.join(cutoff['support_ratio'])}; Lagrangian SCNI, cubic kernel, linear basis",
            "exact",
            layer="printed",
            reading="omega = 0 at kh = pi",
        ),
    ]


STUDY = Study(
    "Stability claims, layer by layer",
    Parameters(),
    Parameters(
        narrow=("3/2", "7/4"),
        wide=(),
        stresses=("-3/2", "1/2"),
        moving_stresses=("1/2",),
        moving_gradients=("2",),
        samples=6,
        measured_ratios=("3/2",),
        measured_stresses=("-3/2", "1/2"),
        measured_waves=(3 * pi / 4,),
        compared=(("dni", "full", "3/2", "1/2"),),
        other_kernels=(),
    ),
    compute,
    judge,
    draw,
)
