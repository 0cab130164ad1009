"""A free, turning, vibrating block over ten thousand steps: energy, momentum, angular momentum, and the reason for every drift."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from rkverify.certify.mechanics.balances import table_of_rates
from rkverify.certify.mechanics.long_motion import block, course, drifts, lagrangian, semi_lagrangian, turned
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

ROUNDING = 1e-12
"""Below this a balance holds: sums of some hundred products, over thousands of steps a random walk of them."""

RUNS = (
    ("lagrangian", "scni", ""),
    ("semi-lagrangian", "scni", "true"),
    ("semi-lagrangian", "scni", "none"),
    ("semi-lagrangian", "scni", "psi-star"),
    ("semi-lagrangian", "dni", "true"),
)
QUANTITIES = {"energy": "energy", "momentum": "momentum over mass and speed", "angular": "angular momentum"}


@dataclass(frozen=True)
class Parameters:
    """Divisions of the block's side, seed, steps, shares of the critical time step, points of a course, angle of a turn."""

    divisions: int = 6
    seed: int = 3
    steps: int = 10_000
    share: float = 0.4
    shares: tuple[float, ...] = (0.8, 0.4, 0.2)
    shorter: int = 10
    points: int = 200
    angle: float = 0.3


def compute(p: Parameters) -> Tables:
    """Long runs, drifts over the step, and the rates that the equations have by themselves."""
    b = block(p.divisions, p.seed)
    courses, kept = [], []
    for formulation, integration, convection in RUNS:
        accounts = _run(b, formulation, integration, convection, p.share, p.steps)
        what = {"formulation": formulation, "integration": integration, "convection": convection}
        courses += [{**what, **row} for row in course(accounts, p.points)]
        kept.append({**what, "share": p.share, **drifts(accounts)})
    for share in p.shares:
        steps = round(p.steps * p.share / share)
        for formulation, integration, convection in RUNS[:3]:
            fewer = steps if formulation == "lagrangian" else steps // p.shorter
            accounts = _run(b, formulation, integration, convection, share, fewer)
            what = {"formulation": formulation, "integration": integration, "convection": convection}
            kept.append({**what, "share": share, **drifts(accounts)})
    rates = table_of_rates(b, ("scni", "dni", "snni"))
    names = [
        ("formulation", "", "lagrangian (neo-Hookean) or semi-lagrangian (Truesdell's rate)"),
        ("integration", "", "scni or dni"),
        ("convection", "", "N with the true rate, with Psi*, or none; nothing for the Lagrangian form"),
    ]
    changes = [
        ("energy", "1", "kinetic energy and work of the stress, over the energy at the start"),
        ("momentum", "1", "over mass and speed at the start"),
        ("angular", "1", "angular momentum, over that at the start"),
    ]
    why = "rounding grows along a motion; a change of 1e-13 of the start is seen as some 1e-13 at the end"
    small = "rounding is no portable number"
    return {
        "courses": table(
            courses,
            [*names, ("time", "side/wave speed", "since the start"), *changes],
            f"Changes since the start over {p.steps} steps of {p.share:g} of the critical one.",
            Numeric(1e-5, 1e-9, why),
        ),
        "drifts": table(
            kept,
            [
                *names,
                ("share", "1", "time step over the critical one"),
                ("steps", "1", "steps done; fewer where the motion broke down"),
                ("time", "side/wave speed", "at the end"),
                *[(name, unit, f"largest change: {text}") for name, unit, text in changes],
                ("mass", "1", "largest change of the total mass"),
            ],
            "Largest changes in each run.",
            Numeric(1e-5, 1e-9, why),
        ),
        "rates": table(
            rates,
            [
                ("integration", "", "scni, dni or snni"),
                ("convection", "", "N with the true rate, with Psi*, or none"),
                ("mass", "", "lumped or consistent"),
                ("momentum", "1/time", "rate of the momentum over mass and speed"),
                ("angular", "1/time", "rate of the angular momentum over itself"),
                (
                    "angular_left",
                    "1/time",
                    "the same without the part of nodes that move otherwise than the matter at them",
                ),
                ("energy", "1/time", "rate of v.M v/2 and of the work of stress together, over v.M v/2"),
                ("galilean", "1", "change of the largest force with a velocity of 10 added everywhere"),
            ],
            "Rates that the semi-discrete equations have in one moment, without a time step.",
            Numeric(1e-7, 1e-12, small),
        ),
        "turned": table(
            [{"angle": p.angle, "stress": turned(b, p.angle)}],
            [("angle", "rad", "of each of ten rigid turns"), ("stress", "1", "largest stress over the shear modulus")],
            "Objectivity: a body turned rigidly, cells rebuilt each time.",
            Numeric(0, ROUNDING, small),
        ),
    }


def _run(b: Any, formulation: str, integration: Any, convection: Any, share: float, steps: int) -> Any:
    if formulation == "lagrangian":
        return lagrangian(b, share, steps)
    return semi_lagrangian(b, integration, convection, share, steps)


def _label(formulation: str, integration: str, convection: str) -> str:
    if formulation == "lagrangian":
        return f"Lagrangian, {integration.upper()}"
    term = {"true": "N with the true rate", "none": "without N", "psi-star": "N with Ψ*"}[convection]
    return f"semi-Lagrangian, {integration.upper()}, {term}"


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """A figure each for energy, momentum and angular momentum."""
    frame, kept = tables["courses"].frame, _long(p, tables)
    drawings = {}
    for quantity, words in QUANTITIES.items():
        figure = new_figure(7.2, 3.7)
        axes = figure.subplots()
        for style, (formulation, integration, convection) in zip(LINES, RUNS, strict=False):
            part = frame[
                (frame["formulation"] == formulation)
                & (frame["integration"] == integration)
                & (frame["convection"] == convection)
            ]
            size = part[quantity].abs().clip(lower=ROUNDING)
            axes.semilogy(
                part["time"], size, label=_label(formulation, integration, convection), **{**style, "linewidth": 1.1}
            )
        axes.set(
            xlabel="time  (side of the block / wave speed)",
            ylabel="|change since the start|  (1)",
            ylim=(ROUNDING / 3, 30),
        )
        axes.set_title(f"{words}; at {ROUNDING:g}: rounding or nothing", fontsize=10)
        axes.legend(fontsize=7, loc="center right", bbox_to_anchor=(1.0, 0.32))
        values = "; ".join(
            f"{_label(*run)}: {'rounding' if kept[run][quantity] < ROUNDING else format(kept[run][quantity], '.2g')}"
            + (f", broken down after {kept[run]['steps']} steps" if kept[run]["steps"] < p.steps else "")
            for run in RUNS
        )
        caption = (
            f"A free block of {(p.divisions + 1) ** 2} jittered nodes that turns and vibrates, {p.steps} steps of {p.share:g} of the critical one; order 1, "
            "cubic kernel, support 2.3 spacings. All parameters are ours."
        )
        drawings[quantity] = Drawing(figure, caption, f"Largest change of the {words} in each run: {values}.")
    return drawings


def _long(p: Parameters, tables: Tables) -> dict[tuple[str, str, str], Any]:
    rows = tables["drifts"].frame.iloc[: len(RUNS)].to_dict("records")
    return {(row["formulation"], row["integration"], row["convection"]): row for row in rows}


def _listed(values: Sequence[float]) -> str:
    return ", ".join(f"{v:.2g}" for v in values)


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What is kept, by which equation, and why the rest is not."""
    kept, frame, rates = _long(p, tables), tables["drifts"].frame, tables["rates"].frame
    reference = kept[RUNS[0]]
    by_step = frame.iloc[len(RUNS) :]

    def over_step(formulation: str, convection: str, quantity: str) -> list[float]:
        part = by_step[(by_step["formulation"] == formulation) & (by_step["convection"] == convection)]
        return [float(v) for v in part[quantity]]

    energy = over_step("lagrangian", "", "energy")
    falls = [a / b for a, b in pairwise(energy)]
    true, none = over_step("semi-lagrangian", "true", "momentum"), over_step("semi-lagrangian", "none", "momentum")
    true_falls, none_falls = ([a / b for a, b in pairwise(v)] for v in (true, none))

    def rate(convection: str, quantity: str, mass: str | None = None) -> tuple[float, float]:
        part = rates[(rates["convection"] == convection) & ((rates["mass"] == mass) if mass else True)]
        return float(part[quantity].min()), float(part[quantity].max())

    whole = max(rate("true", quantity, "consistent")[1] for quantity in ("momentum", "energy", "angular_left"))
    others = min(rate(c, "momentum")[0] for c in ("none", "psi-star"))
    lumped = rate("true", "energy", "lumped")
    star = kept[RUNS[3]]
    galilean = {c: rate(c, "galilean") for c in ("true", "none", "psi-star")}
    stress = float(tables["turned"].frame["stress"].iloc[0])
    tried = f"a free block of {(p.divisions + 1) ** 2} jittered nodes, {p.steps} steps"
    at_once = "one moment of a turning, vibrating, unevenly stressed block, SCNI, DNI and SNNI"
    return [
        Statement(
            "lagrangian",
            (),
            f"The Lagrangian block keeps momentum and angular momentum to rounding and its energy to {reference['energy']:.1e}; with half the step the largest change of the energy falls by {_listed(falls)}: it is the second-order error of central differences and no drift.",
            reference["momentum"] < ROUNDING and reference["angular"] < ROUNDING and all(3 < f < 5.5 for f in falls),
            tried,
            "sampled",
        ),
        Statement(
            "equation",
            ("E41",),
            "With the true rate in N and the consistent mass the semi-discrete equations keep momentum, and kinetic energy with the work of stress, to rounding, and angular momentum but for nodes that move otherwise than the matter at them; "
            f"without N or with Psi* momentum changes at a rate of {others:.1e} or more, and with the lumped mass energy does at {lumped[0]:.1e}.",
            whole < ROUNDING < min(others, lumped[0]),
            at_once,
            "sampled",
            others,
            "least rate of the momentum without the true rate",
            reading="N with the true material rate",
        ),
        Statement(
            "step",
            (),
            f"With the true rate the momentum's drift over the same time falls by {_listed(true_falls)} with half the step: N takes velocities half a step old. Without N it falls by {_listed(none_falls)} only: that drift belongs to the equations.",
            all(f > 1.5 for f in true_falls) and all(f < 1.5 for f in none_falls),
            tried,
            "sampled",
        ),
        Statement(
            "psi_star",
            ("C4", "C69"),
            f"In the plane N with Psi* feeds the motion: the energy of the free block grew by {star['energy']:.2g} times what it was"
            + (
                f" and the motion broke down after {star['steps']} of {p.steps} steps"
                if star["steps"] < p.steps
                else ""
            )
            + f"; without N it changed by {kept[RUNS[2]]['energy']:.2g}, with the true rate by {kept[RUNS[1]]['energy']:.2g}.",
            bool(star["energy"] <= 3 * kept[RUNS[2]]["energy"]),
            tried,
            "sampled",
            layer="simulated",
            reading="N with Psi* in the plane",
        ),
        Statement(
            "galilean",
            ("E41",),
            f"A velocity added to every node changes no force with the true rate or without N, and changes the largest force by {galilean['psi-star'][0]:.2g} of itself or more with Psi*.",
            max(galilean["true"][1], galilean["none"][1]) < ROUNDING and galilean["psi-star"][0] < ROUNDING,
            at_once,
            "sampled",
            reading="N with Psi* as printed",
        ),
        Statement(
            "objective",
            (),
            "A block turned rigidly in ten steps, cells rebuilt in each, has no stress but rounding.",
            stress < ROUNDING,
            f"turns of {p.angle:g} rad",
            "sampled",
        ),
    ]


STUDY = Study(
    "Energy and momentum of a free block",
    Parameters(),
    Parameters(divisions=4, steps=60, shorter=3, points=20),
    compute,
    judge,
    draw,
)
