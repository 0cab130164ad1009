"""The semi-discrete equations of Section 4 by two routes: stencils in every reading, forces as slopes of an energy."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.certify import two_routes
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table

DUALS, STEPS = "duals through the transcription", "complex steps through vectorised code"


@dataclass(frozen=True)
class Parameters:
    """Support ratios, stress, velocity gradient, velocity of the node, stretch of the bar, all exact; readings, () for all."""

    support_ratios: tuple[str, ...] = ("11/10", "3/2", "7/4", "2", "5/2", "7/2")
    stress: str = "1/3"
    gradient: str = "1/5"
    frame_velocity: str = "1/7"
    stretch: str = "6/5"
    readings: tuple[str, ...] = ()


def compute(p: Parameters) -> Tables:
    """Agreement of every stencil, and the exact checks on forces and loads."""
    rows = two_routes.stencil_rows(p.support_ratios, p.stress, p.gradient, p.frame_velocity, p.readings)
    rows += two_routes.bar_rows(p.support_ratios, p.stress, p.stretch)
    checks = [{"check": f"f_int = dW/du, {i}", "holds": two_routes.force_is_energy_slope(i)} for i in ("scni", "dni")]
    checks += [{"check": f"f_ext: {name}", "holds": holds} for name, holds in two_routes.load_totals().items()]
    checks += [
        {"check": f"{number} with the {mass} mass", "holds": two_routes.bar_residual(mass) <= two_routes.AGREEMENT}
        for number, mass in (("(48)", "consistent"), ("(56)", "lumped"))
    ]
    return {
        "stencils": table(
            rows,
            [
                ("reading", "", "what differs from the default readings"),
                ("integration", "", "scni or dni"),
                ("support_ratio", "1", "R = a/h"),
                ("coefficients", "", "coefficients compared"),
                ("agree", "", f"whether all differ by less than {two_routes.AGREEMENT:g} of the largest"),
            ],
            f"Linearised equations by two routes; sigma/C = {p.stress}, Q = {p.gradient}, V = {p.frame_velocity}, h = 1.",
            Exact(),
        ),
        "checks": table(
            checks,
            [("check", "", "what is compared"), ("holds", "", "whether it holds")],
            "Forces, loads and masses of the Lagrangian bar on uneven nodes.",
            Exact(),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Nothing: two hundred agreements make no picture."""
    return {}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Whether the transcriptions of the equations are confirmed."""
    stencils, checks = tables["stencils"].frame, tables["checks"].frame.set_index("check")["holds"]
    bar = stencils["reading"].str.startswith(two_routes.BAR)
    semi, lagrangian = stencils[~bar], stencils[bar]
    tried = f"R = {', '.join(p.support_ratios)}, SCNI and DNI; sigma/C = {p.stress}, Q = {p.gradient}, V = {p.frame_velocity}"
    energy = checks[[name for name in checks.index if name.startswith("f_int")]]
    loads = checks[[name for name in checks.index if name.startswith("f_ext")]]
    masses = [name for name in checks.index if "mass" in name]
    uneven = f"{len(two_routes.UNEVEN)} uneven nodes, a = 7/4, uneven displacements, in rationals"
    return [
        Statement(
            "semi_lagrangian",
            ("E65", "E66", "E67", "E69"),
            f"{int(semi['agree'].sum())} of {len(semi)} linearised semi-Lagrangian equations, in {semi['reading'].nunique()} readings, agree between the two "
            f"routes to {two_routes.AGREEMENT:g} of the largest coefficient.",
            bool(semi["agree"].all()),
            tried,
            "sampled",
            routes=(DUALS, STEPS),
        ),
        Statement(
            "lagrangian",
            ("E48", "E56"),
            f"{int(lagrangian['agree'].sum())} of {len(lagrangian)} linearised Lagrangian bars agree between the two routes, and the nonlinear ones "
            "satisfy (48) with the consistent and (56) with the lumped mass to rounding.",
            bool(lagrangian["agree"].all() and checks[masses].all()),
            f"R = {', '.join(p.support_ratios)}, SCNI, and DNI in every reading of the derivative; S/C = {p.stress}, stretch {p.stretch}",
            "sampled",
            routes=(DUALS, STEPS, "residual of the vectorised bar"),
        ),
        Statement(
            "energy",
            ("E49", "E51"),
            "The nodally integrated internal force is exactly the derivative of the stored energy with respect to every coefficient.",
            bool(energy.all()),
            uneven,
            "exact",
        ),
        Statement(
            "loads",
            ("E50",),
            "The external forces add up to the load, and do its virtual work in a linear displacement, exactly.",
            bool(loads.all()),
            uneven,
            "exact",
            routes=("total load", "virtual work"),
        ),
    ]


STUDY = Study(
    "The semi-discrete equations by two routes",
    Parameters(),
    Parameters(support_ratios=("3/2",), readings=("default", "stress_law = literal", "mass = consistent")),
    compute,
    judge,
    draw,
)
