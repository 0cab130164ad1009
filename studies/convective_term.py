"""What the convective term does to the base state, what (73) neglects, and the modulus of each stress law; in exact rationals."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rkverify.certify import base_state
from rkverify.readings import STRESS_LAWS
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

LAWS = STRESS_LAWS
MATERIAL = {"truesdell": "sigma' = (C + sigma) L", "cauchy-rate": "sigma' = C L", "literal": "(69) taken literally"}


@dataclass(frozen=True)
class Parameters:
    """Support ratios, stress sigma/C^sigma, velocity gradient Q and frame velocities V h, all exact."""

    support_ratios: tuple[str, ...] = ("11/10", "13/10", "3/2", "7/4", "2", "5/2", "7/2")
    stress: str = "1/3"
    gradient: str = "1/5"
    frame_velocities: tuple[str, ...] = ("0", "1")


def compute(p: Parameters) -> Tables:
    """Sums of rates, base accelerations, the neglected mass, forces in given motions, tangents."""
    ratios, s, Q = [Fraction(R) for R in p.support_ratios], Fraction(p.stress), Fraction(p.gradient)
    sums = []
    for R in ratios:
        star, true = base_state.rate_sums(R)
        with_star, with_true = base_state.convected(R, "psi-star"), base_state.convected(R, "true")
        sums.append(
            {
                "support_ratio": str(R),
                "sum_psi_star": str(star),
                "sum_true": str(true),
                "base_acceleration_psi_star": str(with_star.base_acceleration),
                "base_acceleration_true": str(with_true.base_acceleration),
                "common_velocity_psi_star": str(with_star.common_velocity),
                "common_velocity_true": str(with_true.common_velocity),
            }
        )
    neglected = [
        {
            "support_ratio": str(R),
            "convection": convection,
            "frame_velocity": V,
            "share": str(base_state.neglected_mass(R, s, Q, Fraction(V), convection)),
        }
        for R in ratios
        for convection in ("none", "true", "psi-star")
        for V in p.frame_velocities
    ]
    motions = [
        {
            "motion": motion,
            **{c.replace("-", "_"): str(base_state.convective_forces(motion, c)) for c in ("psi-star", "true")},
        }
        for motion in base_state.MOTIONS
    ]
    moduli = [
        {
            "support_ratio": str(R),
            "stress_law": law,
            **{i: str(base_state.long_wave_modulus(R, s, law, i)) for i in ("scni", "dni")},
        }
        for R in ratios
        for law in LAWS
    ]
    uniform = [{"integration": i, "force": str(base_state.uniform_stress_force(i))} for i in ("scni", "dni")]
    return {
        "sums": table(
            sums,
            [
                ("support_ratio", "1", "R = a/h"),
                ("sum_psi_star", "1", "sum_J Psi*_J / Q at a node of the base v = V + Q x"),
                ("sum_true", "1", "the same sum of the true rates"),
                ("base_acceleration_psi_star", "1", "v' of the base over Q V, with Psi*"),
                ("base_acceleration_true", "1", "the same with the true rate"),
                ("common_velocity_psi_star", "1", "v' after a common extra velocity, over Q times it, with Psi*"),
                ("common_velocity_true", "1", "the same with the true rate"),
            ],
            "What N does to a uniformly stretching base, SCNI.",
            Exact(),
        ),
        "neglected_mass": table(
            neglected,
            [
                ("support_ratio", "1", "R = a/h"),
                ("convection", "", "N with Psi*, with the true rate, or none"),
                ("frame_velocity", "length/time", "velocity of the node"),
                ("share", "1", "largest coefficient that (73) leaves out over the largest of the linearised (65)"),
            ],
            f"What neglecting the perturbed nodal mass loses; SCNI, sigma/C = {p.stress}, Q = {p.gradient}, h = 1.",
            Exact(),
        ),
        "motions": table(
            motions,
            [
                ("motion", "", "velocity field on uneven nodes"),
                ("psi_star", "force", "largest component of N v with Psi*"),
                ("true", "force", "the same with the true rate"),
            ],
            "N v in given motions on uneven nodes of masses 1.",
            Exact(),
        ),
        "uniform_stress": table(
            uniform,
            [("integration", "", "scni or dni"), ("force", "force", "largest internal force on inner nodes")],
            "Internal forces of a uniform unit stress on uneven nodes: the geometric part of the stiffness is its derivative.",
            Exact(),
        ),
        "moduli": table(
            moduli,
            [
                ("support_ratio", "1", "R = a/h"),
                ("stress_law", "", "reading of the stress law"),
                ("scni", "1", "lim omega^2 rho / (k^2 C) for long waves, SCNI"),
                ("dni", "1", "the same for DNI"),
            ],
            f"The tangent modulus that long waves see at rest, over C^sigma; sigma/C = {p.stress}.",
            Exact(),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The acceleration of the base over R."""
    frame = tables["sums"].frame
    R = [float(Fraction(r)) for r in frame["support_ratio"]]
    figure = new_figure(6.0, 3.2)
    axes = figure.subplots()
    shown = {"base_acceleration_psi_star": "N with Ψ*", "base_acceleration_true": "N with the true rate"}
    for style, marker, (column, label) in zip(LINES, "os", shown.items(), strict=False):
        axes.plot(R, [float(Fraction(v)) for v in frame[column]], marker=marker, label=label, **style)
    axes.set(xlabel="support ratio R = a/h  (1)", ylabel="acceleration of the base / (Q V)  (1)")
    axes.legend()
    star = [float(Fraction(v)) for v in frame["base_acceleration_psi_star"]]
    caption = (
        "Acceleration that N gives to a uniformly stretching base v = V + Q x where no force acts; SCNI, cubic kernel, linear "
        "basis, uniform lattice. R is ours."
    )
    alternative = (
        f"With Psi* the base accelerates by {min(star):.2g} to {max(star):.2g} times Q V; with the true "
        f"rate it does not accelerate at {int((frame['base_acceleration_true'] == '0').sum())} of {len(frame)} R."
    )
    return {"base": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What N is, where it acts, and what is lost in (73)."""
    sums, neglected = tables["sums"].frame, tables["neglected_mass"].frame
    motions = tables["motions"].frame.set_index("motion")
    uniform = tables["uniform_stress"].frame.set_index("integration")["force"].map(Fraction)
    moduli = tables["moduli"].frame
    span = f"R = {', '.join(p.support_ratios)}; cubic kernel, linear basis"
    star, of_rates = sums["base_acceleration_psi_star"].map(Fraction), sums["sum_psi_star"].map(Fraction)
    still = {
        c: motions.loc["rigid translation", c] == "0" and (motions.loc[motions.index[1:], c] != "0").all()
        for c in ("psi_star", "true")
    }
    affine_free = (motions.loc[[m for m in motions.index if m.startswith("stretching")], "true"] == "0").all()
    balanced = bool((sums["base_acceleration_true"] == "0").all() and (sums["sum_true"] == "0").all())
    stretched = Fraction(motions.loc["stretching v = x", "psi_star"])
    uneven = "uneven nodes at rational distances, a = 7/4, masses 1, four motions"
    statements = [
        Statement(
            "where_n_acts_star",
            ("C1", "C68"),
            "With Psi* of (40), N v is exactly zero in a rigid translation, where the material under no kernel changes, and not "
            f"zero in stretching and bending, where it does (largest component {float(stretched):.3g} for v = x).",
            bool(still["psi_star"]),
            uneven,
            "exact",
            reading="Psi*",
        ),
        Statement(
            "where_n_acts_true",
            ("C1", "C68"),
            "With the true material rate N v is exactly zero in every affine motion, although stretching changes the material "
            "under the kernels: linear fields are reproduced at any time, so that they need no convective term.",
            bool(still["true"] and not affine_free),
            uneven,
            "exact",
            reading="true rate",
        ),
        Statement(
            "origin_of_n",
            ("C26",),
            "N of (41) is what the rate of the kernel contributes: it vanishes in rigid translations, where the kernels' rates do. "
            f"The complete rate of the shape function is another one: on the base v = Q x the sum of Psi* is {sums['sum_psi_star'].iloc[0]} to "
            f"{sums['sum_psi_star'].iloc[-1]} times Q, that of the true rates is zero for every R.",
            bool(still["psi_star"] and balanced),
            span,
            "exact",
        ),
    ]
    for convection, V, reading, words in (
        ("none", None, "no N", "Without N"),
        ("true", None, "true rate", "With the true rate"),
        ("psi-star", "0", "Psi*, node at rest", "With Psi* at a node without velocity"),
        (
            "psi-star",
            p.frame_velocities[-1],
            "Psi*, node in motion",
            f"With Psi* at a node with V = {p.frame_velocities[-1]} h/time",
        ),
    ):
        part = neglected[neglected["convection"] == convection]
        part = part if V is None else part[part["frame_velocity"] == V]
        share = part["share"].map(Fraction)
        statements.append(
            Statement(
                f"neglected_mass_{convection}_{V or 'any'}",
                ("C35", "E73"),
                f"{words} the perturbation of the nodal mass multiplies the acceleration of the base; what (73) leaves out "
                f"is at most {float(share.max()):.3g} of the largest coefficient.",
                bool((share == 0).all()),
                f"{span}; sigma/C = {p.stress}, Q = {p.gradient}, h = 1; every coefficient of (73) against the linearised (65)",
                "exact",
                -float(share.max()),
                "minus the largest share left out",
                layer="as-defined",
                reading=reading,
            )
        )
    for law in LAWS:
        part = moduli[moduli["stress_law"] == law]
        values = {Fraction(v) for column in ("scni", "dni") for v in part[column]}
        value = max(values)
        statements.append(
            Statement(
                f"tangent_{law.replace('-', '_')}",
                ("C41",),
                f"With {MATERIAL[law]} long waves see the modulus {value} C at sigma/C = {p.stress}, for every R, with SCNI and with DNI.",
                values == {1 + Fraction(p.stress)},
                f"{span}; sigma/C = {p.stress}, at rest",
                "exact",
                reading=law,
            )
        )
    statements += [
        Statement(
            "base_acceleration",
            ("E65",),
            f"On the base v = V + Q x, on which no force acts, (65) with Psi* gives the acceleration kappa Q V with kappa = {star.iloc[0]} "
            f"(R = {p.support_ratios[0]}) to {star.iloc[-1]} (R = {p.support_ratios[-1]}): a common velocity changes the motion, the equations are "
            "not Galilean invariant and momentum is not kept. With the true rate kappa = 0.",
            balanced
            and bool((sums["common_velocity_psi_star"].map(Fraction) == star).all() and (star == -of_rates).all()),
            span,
            "exact",
            routes=("sums of the rates", "acceleration of the base", "response to a common velocity"),
        ),
        Statement(
            "uniform_stress",
            ("E67",),
            f"A uniform stress gives exactly zero internal force on inner nodes at any positions with SCNI, and up to {float(uniform['dni']):.3g} "
            "with DNI: the geometric part of the stiffness, its derivative, is zero with SCNI and is not with DNI.",
            uniform["scni"] == 0 and uniform["dni"] != 0,
            "uneven nodes at rational distances, a = 7/4",
            "exact",
        ),
    ]
    return statements


STUDY = Study(
    "The convective term and the base state",
    Parameters(),
    Parameters(support_ratios=("11/10", "7/4")),
    compute,
    judge,
    draw,
)
