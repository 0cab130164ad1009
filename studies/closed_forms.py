"""The right counterparts of (76), (82), (86) and (87) for 1 < R < 2, as closed forms, and how they were checked."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from rkverify.certify import form_numbers, form_tables
from rkverify.readings import CellEdges, CellMeasure, Convection, Derivative, Integration, Readings, StressLaw
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, kh_axis, new_figure

LAWS: tuple[StressLaw, ...] = ("truesdell", "cauchy-rate", "literal")
MEASURES: tuple[CellMeasure, ...] = ("edges", "fixed")


def _reading(
    integration: Integration,
    derivative: Derivative,
    law: StressLaw,
    measure: CellMeasure,
    edges: CellEdges = "voronoi",
) -> Readings:
    return Readings(integration, "none", derivative, law, cell_edges=edges, cell_measure=measure)


@dataclass(frozen=True)
class Parameters:
    """Which forms, at how many random R they are checked and with which seed; stress, gradient; readings at rest."""

    formulations: tuple[form_tables.Formulation, ...] = (
        ("scni", "full", "low"),
        ("scni", "full", "high"),
        ("dni", "full", "low"),
        ("dni", "diffuse", "low"),
    )
    convections: tuple[Convection, ...] = ("psi-star", "true")
    random_ratios: int = 50
    seed: int = 20090
    digits: int = 40
    beyond: str = "11/4"
    stress: str = "1/3"
    gradient: str = "1/5"
    shown_ratios: tuple[str, ...] = ("7/5", "7/4")
    samples: int = 60
    pi_ratios: tuple[str, ...] = tuple(str(Fraction(n, 40)) for n in range(42, 80))
    readings: tuple[tuple[str, Readings], ...] = (
        *(("7/4", _reading("dni", "full", law, measure)) for law in LAWS for measure in MEASURES),
        ("7/4", _reading("dni", "full", "truesdell", "material")),
        *(("13/10", _reading("dni", "full", "truesdell", measure)) for measure in MEASURES),
        *(("7/4", _reading("dni", "diffuse", law, measure)) for law in LAWS for measure in MEASURES),
        *(("7/4", _reading("scni", "full", law, measure)) for law in LAWS for measure in MEASURES),
        ("7/4", _reading("scni", "full", "truesdell", "material", "material")),
        ("7/4", _reading("scni", "full", "truesdell", "fixed", "fixed")),
    )


QUICK = Parameters(
    formulations=(("dni", "diffuse", "low"),),
    convections=(),
    random_ratios=2,
    shown_ratios=("7/5",),
    samples=6,
    pi_ratios=("13/10", "7/4"),
    readings=(("13/10", _reading("dni", "diffuse", "truesdell", "edges")),),
)

FLOAT = "exact rationals put into sums of a few cosines in double precision, each near 1"
SETTING = [
    ("integration", "", "scni or dni"),
    ("derivative", "", "reading of the derivative for DNI"),
    ("range", "1", "R for which the form holds: no decision that led to it changes its sign there"),
]


def compute(p: Parameters) -> Tables:
    """Forms, relations, errors, and what the print has in their place."""
    found = form_tables.all_forms(p.formulations, p.convections)
    s, Q = Fraction(p.stress), Fraction(p.gradient)
    ratios = [Fraction(R) for R in p.shown_ratios]
    with_N = [column for c in p.convections for column in (f"b {c}", f"W {c}")]
    return {
        "coefficients": table(
            form_tables.coefficient_rows(found),
            [
                ("part", "", "what the coefficient belongs to: the stress, or N with Psi* or the true rate"),
                ("range", "1", "R for which the form holds"),
                ("rate", "", "of node I"),
                ("variable", "", "of node I + shift"),
                ("shift", "nodes", "n >= 0"),
                ("parity", "", "of the coefficients in the shift"),
                ("over_R", "", "cubic kernel; s = sigma/C^sigma, Q; h = rho = C^sigma = 1"),
                (
                    "in_values",
                    "",
                    "z = h/a; p0 = phi(0), p1 = phi(z), d1 = phi'(z), c1 = phi''(z), e1 = phi(z/2), e3 = phi(3z/2)",
                ),
            ],
            "Every coefficient of the linearised equations for 1 < R < 2.",
            Exact(),
        ),
        "at_rest": table(
            form_tables.rest_rows(found),
            [
                *SETTING,
                ("long_wave", "1", "lim omega^2/(kh)^2, cubic kernel"),
                ("at_pi", "1", "omega^2 at kh = pi, cubic kernel"),
                ("at_pi_in_values", "1", "the same for any kernel"),
                ("affine", "", "whether omega^2/(1 - cos kh) is affine in cos kh"),
                ("sine_and_G", "", "whether omega^2 = (1 + s) sin^2 kh + s G (1 - cos kh)^2 identically"),
                ("square", "", "whether omega^2 = (1 + s) (2 B_1 sin kh + 2 B_2 sin 2kh)^2 identically"),
                ("is_86", "", "whether (86) with C(h/2) at the edge is this relation identically"),
            ],
            "omega^2 at rest, identities of rational functions.",
            Exact(),
        ),
        "in_motion": table(
            form_tables.motion_rows(found),
            [
                *SETTING,
                ("convection", "", "N with Psi* (as defined) or with the true rate (consistent)"),
                (
                    "factors",
                    "",
                    "whether the cubic of the symbol is (lambda - Q)(lambda^2 - b lambda + W), lambda = i omega",
                ),
                ("even", "", "whether N's coefficients of the velocities are even in the shift, so that b is real"),
                ("galilean", "", "whether N sees v - Q x alone and nothing of a uniform velocity"),
                ("b", "1/time", "symbol of the velocities, c = cos kh"),
                ("a_N", "1/time^2", "symbol of N's displacement terms; W is omega^2 at rest less a_N"),
            ],
            "The relation with N and a velocity gradient: omega^2 + i b omega - W = 0 stands against (77) and (83).",
            Exact(),
        ),
        "errors": table(
            form_numbers.error_rows(found, p.random_ratios, p.seed, s, Q, p.digits),
            [
                *SETTING[:2],
                ("convection", "", "none, psi-star or true"),
                SETTING[2],
                ("ratios", "1", "random support ratios tried"),
                ("holds", "", "whether every difference is below the digits carried"),
                ("largest_error", "1", "largest difference of a coefficient from the linearisation"),
            ],
            f"Closed forms against the linearisation through the equations at {p.digits} digits.",
            Exact(),
        ),
        "beyond": table(
            form_numbers.beyond_rows(found, s, Q, p.digits, Fraction(p.beyond)),
            [*SETTING, ("support_ratio", "1", "R"), ("error", "1", "largest difference of a coefficient")],
            "The same forms beyond their range.",
            Numeric(1e-9, 0, "computed at many digits and rounded once"),
        ),
        "along_kh": table(
            form_numbers.damping_rows(found, ratios, s, Q, p.samples) if p.convections else [],
            [
                ("integration", "", "scni or dni"),
                ("support_ratio", "1", "R"),
                ("kh", "rad", "wave number times spacing"),
                ("printed_B", "1/time", "B of (78)"),
                ("printed_C", "1/time^2", "C of (78), A of (84)"),
                *((name, "1/time" if name.startswith("b") else "1/time^2", "of the closed form") for name in with_N),
            ],
            "omega^2 + B omega + C = 0 in print, omega^2 + i b omega - W = 0 linearised.",
            Numeric(1e-11, 1e-12, FLOAT),
        ),
        "at_pi": table(
            form_numbers.pi_rows(found, [Fraction(R) for R in p.pi_ratios]),
            [
                ("derivative", "", "reading of the derivative"),
                ("support_ratio", "1", "R"),
                ("computed", "1", "omega^2(pi) rho h^2/sigma of the closed form"),
                ("printed", "1", "-4 Psi,xx(h) h^2 of (87)"),
                ("equal", "", "whether both are the same rational"),
                ("same_sign", "", "whether both have one sign"),
            ],
            "The state at kh = pi without N.",
            Numeric(1e-11, 0, "exact rationals, rounded once when they are printed"),
        ),
        "readings": table(
            form_numbers.reading_rows(p.readings),
            [
                ("support_ratio", "1", "R"),
                ("integration", "", "scni or dni"),
                ("derivative", "", "reading of the derivative for DNI"),
                ("stress_law", "", "truesdell, cauchy-rate or literal (69)"),
                ("cell_edges", "", "reading of the cell edges"),
                ("cell_measure", "", "reading of a_K"),
                ("long_wave", "1", "lim omega^2/(kh)^2 as a function of s = sigma/C^sigma"),
                ("at_pi", "1", "omega^2(pi) as a function of s"),
                ("turn_long_wave", "1", "s at which the longest waves turn"),
                ("turn_at_pi", "1", "s at which the wave kh = pi turns"),
            ],
            "What the readings of stress law and cells change at rest.",
            Exact(),
        ),
    }


def _number(text: str) -> float:
    return float(Fraction(text))


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """omega^2(pi)/sigma over R, and the damping of N over kh, each beside the print."""
    figure = new_figure(9.6, 3.8)
    left, right = figure.subplots(1, 2)
    at_pi = tables["at_pi"].frame
    styles = iter(LINES)
    for derivative, part in at_pi.groupby("derivative", sort=False):
        R = part["support_ratio"].map(_number)
        for column, label in (("computed", "closed form"), ("printed", "(87): $-4\\Psi_{,xx}(h)h^2$")):
            left.plot(R, part[column], label=f"{label}, {derivative}", **next(styles))
    left.axhline(0, color="#606060", linewidth=0.8)
    left.set(xlabel="support ratio  R = a/h  (1)", ylabel="ω²ρh²/σ at kh = π  (1)", ylim=(-40, 6), xlim=(1, 2))
    left.legend(loc="lower right")
    along = tables["along_kh"].frame
    part = along[(along["integration"] == "dni") & (along["support_ratio"] == p.shown_ratios[-1])]
    Q = _number(p.gradient)
    shown = [
        ("printed_B", "B of (78): real, in ω² + Bω"),
        *((f"b {c}", f"b: imaginary, in ω² + ibω; {c}") for c in p.convections),
    ]
    for style, (column, label) in zip(LINES, shown, strict=False):
        right.plot(part["kh"], part[column] / Q, label=label, **style)
    right.axhline(0, color="#606060", linewidth=0.8)
    kh_axis(right)
    right.set(ylabel="coefficient of ω over Q  (1)")
    right.legend(fontsize=8)
    caption = (
        f"Left: the state at kh = pi without N, DNI. Right: what the convective term does to the velocities at R = {p.shown_ratios[-1]}. Cubic B-spline "
        "(12), linear basis, h = rho = C^sigma = 1; R is ours."
    )
    spans = [
        f"{label} between {round(part[column].min() / Q, 9):.2g} and {round(part[column].max() / Q, 9) + 0.0:.2g}"
        for column, label in shown
        if len(part)
    ]
    readings = [(str(name), part) for name, part in at_pi.groupby("derivative", sort=False)]
    differ = [f"{int((~part['same_sign'].astype(bool)).sum())} of {len(part)} R with the {name} derivative" for name, part in readings]  # fmt: skip
    signs = [
        f"{name} derivative: closed form {_positive(part, 'computed')}, (87) {_positive(part, 'printed')}"
        for name, part in readings
    ]
    alternative = (
        f"At kh = pi the closed form and (87) differ in sign at {' and at '.join(differ)}. "
        f"Where they are positive: {'; '.join(signs)}. The coefficient of omega over Q: {'; '.join(spans) or 'not computed'}."
    )
    return {"closed_forms": Drawing(figure, caption, alternative)}


def _positive(part: Any, column: str) -> str:
    """At how many R, and at which, a column is positive."""
    R = part[part[column] > 0]["support_ratio"].map(_number)
    return f"at {len(R)} of {len(part)} R" + (f" from {R.min():.3g} to {R.max():.3g}" if len(R) else "")


def _all(part: Any, column: str) -> bool:
    return bool(len(part)) and bool(part[column].astype(bool).all())


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What the forms say about (76), (82), (86), (87), and about SCNI at rest."""
    rest, motion, errors = (tables[name].frame for name in ("at_rest", "in_motion", "errors"))
    scni, dni = rest[rest["integration"] == "scni"], rest[rest["integration"] == "dni"]
    narrow, wide = scni[scni["range"] == "1 < R < 3/2"], scni[scni["range"] != "1 < R < 3/2"]
    at_pi, along = tables["at_pi"].frame, tables["along_kh"].frame

    def checked(integration: str, *convections: str) -> str:
        part = errors[(errors["integration"] == integration) & errors["convection"].isin(convections)]
        return f"checked against the linearisation at {int(part['ratios'].sum())} random R: largest difference {part['largest_error'].max()}"

    def in_place(row: Any) -> str:
        return str(row["at_pi_in_values"].iloc[0]) if len(row) else "not computed"

    def over_R(row: Any) -> str:
        return str(row["at_pi"].iloc[0]) if len(row) else "not computed"

    named = "p0 = phi(0), p1 = phi(h/a), d1 = phi', c1 = phi'' at h/a, z = h/a; e1 = phi(h/2a), e3 = phi(3h/2a)"
    full = dni[dni["derivative"] == "full"]
    opposite = at_pi[(at_pi["derivative"] == "full") & ~at_pi["same_sign"]]["support_ratio"].map(_number)
    statements = [
        Statement(
            "scni_narrow",
            ("E86",),
            f"For 1 < R < 3/2 the linearised (65) with SCNI and without N has omega^2 = (C^sigma + sigma)/(rho h^2) sin^2 kh, and so has (86), identically in R; {checked('scni', 'none')}.",
            _all(narrow, "is_86") and _all(narrow, "square"),
            "all 1 < R < 3/2, sigma and kh; cubic kernel",
            "proved",
            layer="as-defined",
            reading="C(h/2) at the edge, R <= 3/2",
        ),
        Statement(
            "scni_wide",
            ("E86",),
            f"For 3/2 < R < 2 it is omega^2 = (C^sigma + sigma)/(rho h^2) [((e1 - e3) sin kh + e3 sin 2kh)/(e1 + e3)]^2 for any kernel ({named}); (86) has no e3 and is another function of R.",
            _all(wide, "is_86"),
            "all 3/2 < R < 2, sigma and kh; any kernel",
            "proved",
            layer="as-defined",
            reading="C(h/2) at the edge, R > 3/2",
        ),
        Statement(
            "scni_at_rest",
            ("C59",),
            "With SCNI at rest omega^2 is C^sigma + sigma times a square, identically: no stress with C^sigma + sigma >= 0 makes it negative.",
            _all(scni, "square") and len(scni) > 1,
            "all 1 < R < 2 but 3/2, all sigma and kh; any kernel",
            "proved",
            layer="as-defined",
        ),
        Statement(
            "dni_at_rest",
            ("E87",),
            "The right counterpart of (87) for 1 < R < 2 is omega^2 rho h^2 = (C^sigma + sigma) sin^2 kh + sigma G (1 - cos kh)^2, so that omega^2 >= 0 at every kh exactly when "
            f"C^sigma + sigma >= 0 and sigma G >= 0; omega^2(pi) = 4 sigma G = {in_place(full)} with s = sigma/C^sigma ({named}), which is {over_R(full)} for the cubic kernel. "
            f"(87) has -2 sigma Psi,xx(h) (1 - cos kh) instead, of another order in kh and, with the full derivative, of the other sign at kh = pi for {len(opposite)} of "
            f"{int((at_pi['derivative'] == 'full').sum())} R between {at_pi['support_ratio'].map(_number).min():g} and {at_pi['support_ratio'].map(_number).max():g}; {checked('dni', 'none')}.",
            _all(at_pi, "equal"),
            f"closed form: all 1 < R < 2, sigma and kh, full and diffuse derivative, any kernel; against (87) at {len(at_pi)} R and readings, cubic kernel",
            "exact",
            -float(((at_pi["computed"] - at_pi["printed"]) / at_pi["printed"]).abs().min()),
            "minus the least relative error at kh = pi",
            layer="as-defined",
        ),
    ]
    statements.append(_same(statements[2]))
    for number, name, integration in (("E76", "scni_in_motion", "scni"), ("E82", "dni_in_motion", "dni")):
        part = motion[(motion["integration"] == integration) & (motion["convection"] == "psi-star")]
        form = _all(part, "factors") and _all(part, "even")
        words, gap = _sizes(along[along["integration"] == integration], _number(p.gradient))
        statements.append(
            Statement(
                name,
                (number,),
                f"The symbol of the linearised (65) with N {'has' if form else 'does not have'} the characteristic polynomial (lambda - Q)(lambda^2 - b lambda + W) with lambda = i omega and b real, so that "
                f"omega^2 + i b omega - W = 0 stands in the place of ({number[1:]}): N's coefficients of the velocities are even in the shift, and its term in omega is imaginary where the print has a real one. "
                f"{words}; {checked(integration, 'psi-star', 'true')}.",
                gap == 0,
                f"polynomial: all 1 < R < 2 but 3/2, all Q, sigma and kh; against the print at R = {', '.join(p.shown_ratios)}, sigma/C = {p.stress}, Q = {p.gradient}, "
                f"kh = pi n/{p.samples}; cubic kernel",
                "proved",
                -gap,
                "minus the largest |B - i b|/Q",
                layer="as-defined",
            )
        )
    return statements


def _same(statement: Statement) -> Statement:
    """The same at rest with the true rate: N does nothing there."""
    return replace(statement, name=f"{statement.name}_consistent", layer="consistent")


def _sizes(along: Any, Q: float) -> tuple[str, float]:
    """The largest terms in print and in the forms, in words; and the largest |B - i b|/Q."""
    if not len(along):
        return "No sizes computed", float("inf")
    W = along["W psi-star"]
    off = (along["printed_C"] + W).abs().max() / W.abs().max()
    B, b = along["printed_B"] / Q, along["b psi-star"] / Q
    words = (
        f"B/Q of the print reaches {B.abs().max():.3g}, b/Q runs from {b.min():.3g} to {b.max():.3g}, and the last coefficient of the print is off by "
        f"{off:.3g} of the largest W"
    )
    return words, float(((B**2 + b**2) ** 0.5).max())


STUDY = Study("Closed forms of the linearised equations", Parameters(), QUICK, compute, judge, draw)
