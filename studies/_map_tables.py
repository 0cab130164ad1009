"""Parameters and tables of the stability maps."""

from dataclasses import dataclass
from fractions import Fraction

from rkverify.readings import CellMeasure, StressLaw
from rkverify.stability import stability_sets as sets
from rkverify.stability import two_forms
from rkverify.stability.side_by_side import ANALYTIC, Case
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Tables, table

ROUNDING = Numeric(
    1e-6, 2e-6, "double precision: sums of some tens of products, and bounds of s that are ratios of two"
)
ROOTS = Numeric(1e-6, 2e-5, "double precision, over |Q| >= 1/100: a double root moves by the square root of rounding")


@dataclass(frozen=True)
class Parameters:
    """Support ratios of the maps at rest, ranges of the maps over Q h/c and s, and what the statements are tried over.

    rest: fortieths of R. gradient_steps, stress_steps: the maps over (Q h/c, s) have Q h/c = (n + 1/2)/(2 gradient_steps)
    for n = -gradient_steps, …, gradient_steps - 1, so that Q = 0 is left out, and s = 2 n/stress_steps.
    """

    fortieths: tuple[int, ...] = tuple(range(41, 141))
    samples: int = 48
    gradient_steps: int = 14
    stress_steps: int = 20
    moving: tuple[Case, ...] = (
        Case("scni", "3/2"),
        Case("dni", "3/2"),
        Case("dni", "7/4"),
        Case("dni", "3/2", "diffuse"),
    )
    map_stresses: tuple[str, ...] = ("-1/2", "1/2")
    step_stresses: tuple[str, ...] = ("0", "1/2")
    reading_ratios: tuple[str, ...] = ("11/10", "3/2", "7/4", "19/10", "5/2", "3", "7/2")
    laws: tuple[StressLaw, ...] = ("truesdell", "cauchy-rate", "literal")
    measures: tuple[CellMeasure, ...] = ("edges", "fixed")
    tried: tuple[str, ...] = ("11/10", "13/10", "3/2", "7/4", "19/10", "5/2", "7/2")
    tried_stresses: tuple[str, ...] = ("-3", "-3/2", "-11/10", "-101/100", "-99/100", "-9/10", "-1/2", "0", "1", "5")
    small_gradients: tuple[str, ...] = ("1/100", "1/20", "1/10")
    large_gradients: tuple[str, ...] = ("1/2", "1", "2")
    apart: float = 0.05
    stretches: tuple[str, ...] = ("1/2", "4/5", "6/5", "2")
    path: tuple[str, ...] = ("1/4", "1/2", "4/7", "3/5", "1", "2")
    measured_stretch: str = "4/5"
    measured: tuple[tuple[str, str], ...] = (
        ("3/2", "-5/4"),
        ("3/2", "-3/4"),
        ("7/4", "-5/4"),
        ("7/4", "-3/4"),
        ("5/2", "-3/2"),
        ("5/2", "-1/2"),
    )

    @property
    def support_ratios(self) -> tuple[str, ...]:
        """R of the maps at rest."""
        return tuple(f"{n}/40" for n in self.fortieths)


QUICK = Parameters(
    fortieths=(60, 70),
    samples=12,
    gradient_steps=2,
    stress_steps=4,
    moving=(Case("scni", "3/2"),),
    reading_ratios=("3/2",),
    laws=("truesdell",),
    measures=("edges",),
    tried=("3/2",),
    small_gradients=("1/10",),
    large_gradients=("2",),
    stretches=("4/5",),
    measured=(("3/2", "-1/2"),),
)

FORMULATION = (
    "formulation",
    "",
    "Lagrangian or (without a word) semi-Lagrangian, integration, derivative; printed or as-defined = consistent",
)
RATIO = ("support_ratio", "1", "R = a/h")
STRESS = ("stress_ratio", "1", "sigma/C^sigma; S/C^SE for the Lagrangian bar")
FROM_TO = [
    ("stable_from", "1", "least s = sigma/C^sigma with omega^2 >= 0 at every kh; -inf where none is too small"),
    ("stable_to", "1", "largest such s; inf where none is too large"),
]


def number(text: str) -> float:
    """An exact number as a float."""
    return float(Fraction(text))


def compute(p: Parameters) -> Tables:
    """Maps at rest, maps with a velocity gradient, readings, critical steps, and the two forms beside each other."""
    at_rest = sets.relations(tuple(sets.FORMULATIONS), p.support_ratios)
    semi = {key: value for key, value in at_rest.items() if not key[0].startswith("Lagrangian")}
    dni = {key: value for key, value in semi.items() if "DNI" in key[0]}
    wide = range(-p.gradient_steps, p.gradient_steps)
    gradients = [(n + 0.5) / (2 * p.gradient_steps) for n in wide]
    stresses = [2 * n / p.stress_steps for n in range(-p.stress_steps, p.stress_steps + 1)]
    scni = [Case("scni", R) for R in p.tried]
    tried_gradients = [sign * number(Q) for Q in (*p.small_gradients, *p.large_gradients) for sign in (-1, 1)]
    return {
        "rest": table(
            sets.stress_rows(semi),
            [FORMULATION, RATIO, *FROM_TO],
            "Stable stresses at Q = 0: an interval for every R.",
            ROUNDING,
        ),
        "rest_waves": table(
            sets.wave_rows(dni, p.map_stresses, p.samples),
            [
                FORMULATION,
                ("stress_ratio", "1", "sigma/C^sigma"),
                RATIO,
                ("kh", "rad", "wave number times spacing"),
                ("omega_squared", "1", "omega^2 h^2 rho/C^sigma"),
            ],
            "omega^2 of DNI over R and kh at Q = 0.",
            ROUNDING,
            across="kh",
        ),
        "moving": table(
            sets.moving_rows(p.moving, gradients, stresses, p.samples),
            [
                ("case", "", "integration, derivative, R"),
                ("layer", "", "printed, as-defined or consistent"),
                ("Q", "1", "Q h/c"),
                ("stress_ratio", "1", "sigma/C^sigma"),
                ("growth", "1", "largest growth h/c over kh, coefficients frozen"),
                ("discriminant", "1", "in print the least D h^2/c^2 over kh"),
            ],
            "Growth over velocity gradient and stress.",
            ROOTS,
            across="stress_ratio",
        ),
        "readings": table(
            sets.reading_rows(("SCNI", "DNI full", "DNI diffuse"), p.reading_ratios, p.laws, p.measures),
            [FORMULATION, ("stress_law", "", "reading"), ("cell_measure", "", "reading"), RATIO, *FROM_TO],
            "Stable stresses at rest for every stress law and cell measure.",
            ROUNDING,
        ),
        "critical_step": table(
            sets.step_rows(at_rest, p.step_stresses),
            [
                FORMULATION,
                RATIO,
                STRESS,
                ("omega_max", "1", "largest omega h/c over all kh"),
                ("critical_step", "1", "dt c/h = 2/(omega_max h/c) of central differences"),
                ("least_squared", "1", "least omega^2 h^2/c^2 over all kh; where it is negative every step grows"),
            ],
            "Critical time steps at Q = 0; c^2 = C/rho with C = C^sigma, or C^SE at F = 1.",
            ROUNDING,
        ),
        "motion": table(
            sets.motion_rows(scni, tried_gradients, [number(s) for s in p.tried_stresses], p.samples),
            [
                ("case", "", "integration, R"),
                ("layer", "", "printed, as-defined or consistent"),
                ("Q", "1", "Q h/c"),
                ("change", "1", "largest difference of growth from that at rest, over |Q|"),
                ("stable_growth", "1", "largest growth over |Q| at any s >= -1"),
                ("turn", "1", "in print: the s below which some growth is not zero"),
            ],
            "What a velocity gradient does to the unstable set of SCNI.",
            ROOTS,
        ),
        "two_forms": table(
            two_forms.same_material_rows(ANALYTIC, p.tried, p.stretches, p.tried_stresses),
            [
                ("layer", "", "printed, as-defined or consistent"),
                RATIO,
                ("stretch", "1", "F"),
                ("stress_ratio", "1", "sigma/C^sigma"),
                ("lagrangian_least", "1", "least omega^2 rho_0 h_X^2/C^SE of the Lagrangian form"),
                ("semi_lagrangian_least", "1", "least omega^2 rho h^2/C^sigma of the semi-Lagrangian form at Q = 0"),
                ("difference", "1", "largest difference of omega^2 in the same units, over the largest omega^2"),
            ],
            "Both forms with SCNI on the same material, C^sigma = F^3 C^SE.",
            ROUNDING,
        ),
        "constant_moduli": table(
            two_forms.constant_moduli_rows(ANALYTIC, "3/2", p.path),
            [
                ("layer", "", "printed, as-defined or consistent"),
                ("stretch", "1", "F"),
                ("lagrangian_least", "1", "least omega^2 rho_0 h_X^2/C^SE with S = C^SE (F^2 - 1)/2"),
                ("semi_lagrangian_least", "1", "least omega^2 rho h^2/C^sigma with sigma = C^sigma (F - 1)"),
            ],
            "Both forms with SCNI from the unstressed state, each with its own modulus constant; R = 3/2.",
            ROUNDING,
        ),
        "measured": table(
            two_forms.measured_rows(p.measured, p.measured_stretch)
            + two_forms.measured_constant_moduli("3/2", p.path[1]),
            [
                ("moduli", "", "same material: C^sigma = F^3 C^SE; constant moduli: from the unstressed state"),
                RATIO,
                ("stretch", "1", "F"),
                ("stress_ratio", "1", "sigma/C^sigma"),
                ("lagrangian_growth", "1", "measured growth h/c of the Lagrangian bar, 0 within its uncertainty"),
                ("semi_lagrangian_growth", "1", "the same of the semi-Lagrangian chain"),
            ],
            "Growth measured in nonlinear computations near kh = pi/2, SCNI, Q = 0.",
            Numeric(1e-4, 1e-5, "uncertainty of a measured growth, far below 1e-5"),
        ),
    }
