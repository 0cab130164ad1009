"""Plane waves in a stressed plane: growth of DNI, SCNI and SNNI, zero-energy modes, nonlinear runs, uneven finite sets of nodes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.stability.bloch import evidence, surveys
from rkverify.stability.bloch.evidence import Case
from rkverify.stability.bloch.surveys import Method
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from studies._plane_drawings import draw_clouds, draw_growth, draw_modes, draw_zone
from studies._plane_statements import (
    chain_statements,
    cloud_statements,
    degenerate_statements,
    kinds_statements,
    simulated_statements,
)

FULL, DIFFUSE, SNNI, SCNI = Method("dni"), Method("dni", "diffuse"), Method("snni"), Method("scni")
MIDPOINT, GAUSS = Method("scni", rule="midpoint"), Method("scni", rule="gauss:3")


@dataclass(frozen=True)
class Parameters:
    """Methods, support ratios, size of the stress in units of mu = lambda, waves per direction, cases of the nonlinear runs.

    The map of the zone, nonlinear runs of uneven nodes and the finite clouds are at one support ratio, that of `ratio`.
    """

    lattices: tuple[str, ...] = ("square", "hexagonal")
    methods: tuple[Method, ...] = (FULL, DIFFUSE, SNNI, SCNI)
    support_ratios: tuple[str, ...] = tuple(f"{n / 10:.1f}" for n in range(12, 31))
    stress: float = 0.3
    waves: int = 12
    ratio: str = "1.7"
    zone_points: int = 13
    zero_methods: tuple[Method, ...] = (FULL, DIFFUSE, SNNI, SCNI, MIDPOINT, GAUSS)
    zero_ratios: tuple[str, ...] = ("1.4", "1.7", "2.4")
    rules: tuple[str, ...] = ("trapezoid", "midpoint", "gauss:2", "gauss:4", "gauss:8")
    shares: tuple[float, ...] = (0.9, 0.99, 1.01, 1.1)
    cases: tuple[Case, ...] = (
        Case("square", FULL, "1.4", "tension", (2, 0)),
        Case("square", FULL, "1.8", "tension", (2, 0)),
        Case("square", FULL, "1.4", "compression", (2, 0)),
        Case("square", FULL, "1.4", "compression", (0, 2)),
        Case("square", FULL, "1.8", "compression", (2, 0)),
        Case("square", FULL, "1.7", "shear", (2, 2)),
        Case("square", DIFFUSE, "1.7", "tension", (2, 1)),
        Case("square", DIFFUSE, "1.5", "compression", (0, 2)),
        Case("hexagonal", FULL, "1.6", "compression", (2, 0)),
        Case("square", SNNI, "1.7", "tension", (2, 0)),
        Case("square", SNNI, "1.7", "shear", (2, 2)),
        Case("hexagonal", SNNI, "1.6", "biaxial tension", (0, 2)),
        Case("hexagonal", SNNI, "2.4", "compression", (0, 2)),
        Case("square", SCNI, "1.4", "tension", (1, 1)),
        Case("square", SCNI, "1.7", "compression", (2, 0)),
        Case("square", SCNI, "1.7", "shear", (2, 2)),
        Case("hexagonal", SCNI, "1.7", "compression", (2, 1)),
    )
    states: tuple[str, ...] = ("tension", "compression", "shear")
    jitters: tuple[str, ...] = ("0", "1/10", "1/5")
    cloud_side: int = 17
    seeds: int = 2
    uneven: tuple[tuple[Method, str, str], ...] = (
        (SCNI, "compression", "truesdell"),
        (SCNI, "shear", "truesdell"),
        (SCNI, "shear", "jaumann"),
        (FULL, "shear", "truesdell"),
    )
    uneven_jitter: float = 0.2
    uneven_time: float = 8.0


GROWS = Numeric(1e-6, 1e-6, "eigenvalues in double precision; a double root moves by the square root of rounding")
WAVE = [("kx", "rad/length", "wave vector, spacing 1"), ("ky", "rad/length", "wave vector")]
METHOD = ("method", "", "integration with its derivative or edge rule")
STATE = ("state", "", "stress, of the size that the caption names")
RATIO = ("support_ratio", "1", "support radius over spacing")


def compute(p: Parameters) -> Tables:
    """All tables."""
    size = f"stress {p.stress:g}, lambda = mu = 1"
    step = 1e-6
    return {
        "growth": table(
            surveys.growth_rows(p.lattices, p.methods, p.support_ratios, p.stress, p.waves),
            [
                ("lattice", "", "square or hexagonal"),
                METHOD,
                RATIO,
                STATE,
                ("growth", "1/time", "largest growth over the waves"),
                *WAVE,
                ("strain", "1/length", "least strain of that wave with unit amplitude, 0 for a zero-energy mode"),
            ],
            f"Largest growth over the waves that fit into {p.waves} by {p.waves} nodes; {size}, Truesdell, measures from edges.",
            GROWS,
        ),
        "zone": table(
            surveys.zone_rows(
                "square", [m for m in p.methods if m != SCNI], p.ratio, p.states, p.stress, p.zone_points
            ),
            [METHOD, STATE, *WAVE, ("growth", "1/time", "largest growth of the two waves")],
            f"Growth over half the Brillouin zone of the square lattice, R = {p.ratio}; {size}.",
            GROWS,
            across=WAVE[1][0],
        ),
        "chain": table(
            surveys.chain_rows(p.lattices, [m for m in p.methods if m != SNNI], p.support_ratios, p.stress, p.waves),
            [
                METHOD,
                RATIO,
                STATE,
                ("chain", "1/time", "largest growth on the chain, modulus lambda + 2 mu"),
                ("along_axis", "1/time^2", "largest |omega^2 - chain's| of longitudinal waves along x, tensor window"),
                *((name, "1/time", f"largest growth on the {name} lattice, radial window") for name in p.lattices),
            ],
            f"The chain beside the plane; {size}.",
            GROWS,
        ),
        "bound": table(
            surveys.bound_rows(p.lattices, p.ratio, p.waves, p.shares),
            [("lattice", "", ""), ("share", "1", "compression over mu"), ("growth", "1/time", "largest growth")],
            f"SCNI under large compression, R = {p.ratio}, Truesdell.",
            GROWS,
        ),
        "measured": table(
            evidence.measured_rows(p.cases, p.stress),
            [
                ("lattice", "", "of 4 by 4 periodic nodes"),
                METHOD,
                RATIO,
                STATE,
                *WAVE,
                ("predicted", "1/time", "growth by K(k)"),
                ("measured", "1/time", "growth in the nonlinear run"),
                ("uncertainty", "1/time", "how far either half of the run is from it"),
            ],
            f"Growth of waves in nonlinear runs; {size}.",
            Numeric(1e-4, 1e-4, "measured over some e-folding times with errors of steps of 1e-8"),
        ),
        "zero_modes": table(
            evidence.zero_rows(p.zero_methods, p.zero_ratios, p.waves, p.uneven_jitter, 1),
            [
                ("nodes", "", "lattice, or a period of jittered nodes"),
                METHOD,
                RATIO,
                ("modes", "1", "modes but for translations"),
                ("without_strain", "1", "of these, modes that no cell sees as a strain"),
                ("least", "1/length", "least strain of the others, unit amplitude"),
                ("largest", "1/length", "largest strain"),
            ],
            f"Zero-energy modes among waves that fit into {p.waves} by {p.waves} nodes, without stress.",
            Numeric(1e-6, 1e-9, "singular values in double precision; counts are far from their bound"),
        ),
        "strain": table(
            evidence.strain_map(
                [m for m in p.zero_methods if m not in (DIFFUSE, GAUSS)], p.ratio, 2 * p.zone_points - 5
            ),
            [METHOD, *WAVE, ("strain", "1/length", "least strain of a wave of unit amplitude")],
            f"Strain over a quarter of the Brillouin zone of the square lattice, R = {p.ratio}.",
            GROWS,
            across=WAVE[1][0],
        ),
        "drawn": table(
            evidence.drawn_rows(6, 0.25),
            [
                ("mode", "", "wave vector and direction"),
                ("x", "length", ""),
                ("y", "length", ""),
                ("ux", "length", "displacement"),
                ("uy", "length", "displacement"),
            ],
            "Zero-energy modes of the square lattice.",
            GROWS,
        ),
        "clouds": table(
            evidence.cloud_rows(p.methods, p.ratio, p.states, p.jitters, p.stress, p.cloud_side, p.seeds),
            [
                METHOD,
                STATE,
                ("jitter", "length", "nodes are off the lattice by up to this"),
                ("nodes", "1", "free nodes"),
                ("lattice", "1/time", "largest growth on the infinite lattice"),
                ("least", "1/time", "least growth over the seeds"),
                ("largest", "1/time", "largest growth over the seeds"),
            ],
            f"Largest growth of finite sets of nodes with a held rim, R = {p.ratio}; {size}.",
            Numeric(1e-3, 1e-5, "eigenvalues of a matrix of order 200 that is not symmetric"),
        ),
        "uneven": table(
            evidence.uneven_rows(p.uneven, p.ratio, 4, p.uneven_jitter, p.stress, p.uneven_time),
            [
                METHOD,
                STATE,
                ("law", "", "stress rate"),
                ("predicted", "1/time", "growth by K(0) of a jittered period of 4 by 4 nodes"),
                ("measured", "1/time", "growth of that mode in the nonlinear run"),
                ("uncertainty", "1/time", "how far either half of the run is from it"),
            ],
            f"The fastest mode of a period of 4 by 4 nodes, off the square lattice by up to {p.uneven_jitter:g}; {size}.",
            Numeric(1e-3, 1e-6, "measured with errors of steps of 1e-10"),
        ),
        "degenerate": table(
            evidence.degenerate_rows(p.rules, p.ratio, step),
            [
                ("rule", "", "rule on edges"),
                ("single", "1", "largest derivative of an a_L b_I^L"),
                ("triangulations", "1", "largest difference between the two triangulations"),
                ("sides", "1", "largest difference between the one-sided difference quotients"),
                ("sum_by_steps", "1", "largest derivative of sum_L a_L b_I^L, either triangulation"),
                ("sum_by_quotients", "1", "the same by difference quotients on either side"),
                ("areas_by_steps", "length", "largest distance of an area's derivative from the closed form, steps"),
                ("areas_by_quotients", "length", "the same by difference quotients"),
            ],
            f"Derivatives with respect to a node's position on the square lattice, where four cells meet; R = {p.ratio}, quotients over {step:g}.",
            Numeric(1e-6, 1e-6, "quotients carry rounding over their step"),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Growth over R, over the zone, zero-energy modes, uneven sets."""
    return {
        "growth": draw_growth(tables["growth"].frame, p.states, p.stress, p.waves),
        "zone": draw_zone(tables["zone"].frame, p.states, p.ratio, p.stress),
        "zero_modes": draw_modes(tables["strain"].frame, tables["drawn"].frame, tables["zero_modes"].frame, p.ratio),
        "clouds": draw_clouds(tables["clouds"].frame, p.states, p.ratio, p.stress, p.seeds),
    }


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What carries over from the chain, which instabilities there are, and what uneven finite sets do."""
    frames = {name: one.frame for name, one in tables.items()}
    span = f"{' and '.join(p.lattices)} lattice, R = {p.support_ratios[0]} to {p.support_ratios[-1]}, stress {p.stress:g} mu, cubic kernel, linear basis"
    return [
        *chain_statements(frames, span),
        *simulated_statements(frames, "periodic boxes of 4 by 4 nodes, cubic kernel, linear basis"),
        *kinds_statements(frames, span),
        *cloud_statements(frames, p.ratio, p.cloud_side, p.seeds),
        *degenerate_statements(frames["degenerate"], p.ratio),
    ]


STUDY = Study(
    "Stability in the plane",
    Parameters(),
    Parameters(
        support_ratios=("1.4", "1.8"),
        waves=4,
        zone_points=5,
        zero_ratios=("1.7",),
        rules=("trapezoid", "gauss:4"),
        cases=(
            Case("square", FULL, "1.8", "compression", (2, 0)),
            Case("square", SNNI, "1.7", "tension", (2, 0)),
            Case("square", SCNI, "1.7", "shear", (2, 2)),
        ),
        jitters=("0", "1/5"),
        cloud_side=9,
        seeds=1,
        uneven=((SCNI, "shear", "truesdell"),),
        uneven_time=1.0,
    ),
    compute,
    judge,
    draw,
)
