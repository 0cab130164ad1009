"""The derivation of the printed stencils from the semi-discrete equations, link by link, in exact rationals."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rkverify.certify import links
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure


@dataclass(frozen=True)
class Parameters:
    """Support ratios, stress sigma/C^sigma or S/C^SE, velocity gradient Q and stretch F, all exact."""

    support_ratios: tuple[str, ...] = ("11/10", "13/10", "3/2", "8/5", "7/4", "19/10")
    wide_ratios: tuple[str, ...] = ("5/2", "7/2")
    stress: str = "1/3"
    gradient: str = "1/5"
    stretch: str = "6/5"


def compute(p: Parameters) -> Tables:
    """Every link at every support ratio."""
    narrow, wide = ([Fraction(R) for R in ratios] for ratios in (p.support_ratios, p.wide_ratios))
    s, Q, F = Fraction(p.stress), Fraction(p.gradient), Fraction(p.stretch)
    rows = (
        links.lagrangian_rows([*narrow, *wide], s, F) + links.convective_rows(narrow, Q) + links.stress_rows(narrow, s)
    )
    columns = [
        ("link", "", "from which equation to which"),
        ("support_ratio", "1", "R = a/h"),
        ("under", "", "reading, or what is dropped"),
        ("comes_out", "", "whether the stencils are equal to the last rational"),
        ("lost", "1", "largest difference over the largest coefficient"),
    ]
    caption = "Links of the derivation; all stencils are exact rationals, differences are rounded once."
    return {
        "links": table(rows, columns, caption, Numeric(1e-11, 0, "exact rationals, rounded once when they are printed"))
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """What each link loses over R."""
    frame = tables["links"].frame
    shown = {
        "(65) -> (73)": ("N in (75) against every term of N", "all of N"),
        "(73) -> (74)": ("Psi_I times the change of Psi*_J dropped", "(74): term dropped"),
        "(74) -> (75)": ("stress term, C(h/2) edge", "SCNI stress, edge"),
        "(74) -> (81)": ("truesdell, full, measure edges", "DNI stress"),
    }
    figure = new_figure(6.4, 3.4)
    axes = figure.subplots()
    for style, marker, (link, (under, label)) in zip(LINES, "os^D", shown.items(), strict=False):
        part = frame[(frame["link"] == link) & (frame["under"] == under)]
        axes.plot(
            [float(Fraction(R)) for R in part["support_ratio"]], part["lost"], label=label, marker=marker, **style
        )
    axes.set(xlabel="support ratio R = a/h  (1)", ylabel="difference / largest coefficient  (1)", ylim=(0, None))
    axes.legend()
    caption = (
        f"What the printed stencils lose against the linearised equations; sigma/C = {p.stress} and Q = {p.gradient} (ours), cubic kernel, "
        "linear basis."
    )
    spans = []
    for link, (under, label) in shown.items():
        lost = frame[(frame["link"] == link) & (frame["under"] == under)]["lost"]
        spans.append(f"{label} from {lost.min():.2g} to {lost.max():.2g}")
    alternative = f"What is lost over R, as a share of the largest coefficient: {'; '.join(spans)}."
    return {"lost": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Which links hold, and what must be dropped where they do not."""
    frame = tables["links"].frame
    narrow = f"R = {', '.join(p.support_ratios)}; sigma/C = {p.stress}, Q = {p.gradient}; cubic kernel, linear basis"

    def part(link: str, under: str) -> "object":
        return frame[(frame["link"] == link) & (frame["under"] == under)]

    def comes_out(link: str, under: str) -> bool:
        return bool(part(link, under)["comes_out"].all())  # type: ignore[index]

    def least(link: str, under: str) -> float:
        return float(part(link, under)["lost"].min())  # type: ignore[index]

    scni = frame[(frame["link"] == "(65) -> (86)") & (frame["under"] == "C(h/2) edge")]
    low = scni["support_ratio"].map(Fraction) <= Fraction(3, 2)
    scni_low, scni_high = scni[low], scni[~low]
    literal = frame[(frame["link"] == "(65) -> (86)") & (frame["under"] == "C(h/2) literal")]
    dni = frame[(frame["link"] == "(74) -> (81)") & ~frame["under"].str.startswith("B_I")]
    relation = frame[frame["link"] == "(65) -> (87)"]
    alone = frame[frame["under"].str.startswith("B_I")].groupby("under", sort=False)["comes_out"].all()
    rebuilt = [under.partition("; ")[2] for under in alone[alone].index]
    dropped = "Psi_I times the change of Psi*_J dropped"
    statements = [
        Statement(
            "lagrangian",
            ("E57", "E58", "E60", "E61", "C28"),
            "The linearisation of (56) with SCNI is (61), coefficient by coefficient.",
            comes_out("(56) -> (61)", "every term") and comes_out("(57)-(60) -> (61)", "every term"),
            f"R = {', '.join((*p.support_ratios, *p.wide_ratios))}; S/C = {p.stress}, F = {p.stretch}",
            "exact",
            layer="as-defined",
            routes=("duals through the nonlinear force",),
        ),
        Statement(
            "term_dropped_in_74",
            ("E74", "C36"),
            f"(74) leaves out the part Psi_I times the change of Psi*_J of the perturbed N; it is worth at least {least('(73) -> (74)', dropped):.3g} of N's largest coefficient.",
            comes_out("(73) -> (74)", dropped),
            narrow,
            "exact",
            -least("(73) -> (74)", dropped),
            "minus the least relative loss",
            layer="as-defined",
        ),
        Statement(
            "direction_dropped_in_75",
            ("E75", "C37"),
            f"The two terms of (75) that come from N do not follow from (74): with n_IK of (71) kept they differ by at least {least('(74) -> (75)', 'n_IK of (71) kept'):.3g} of their size. "
            "With n_IK replaced by 1, and Psi_I varied through its kernel alone, they come out to the last rational: the coefficients of the velocities turn from even to odd in I.",
            comes_out("(74) -> (75)", "n_IK of (71) kept"),
            narrow,
            "exact",
            -least("(74) -> (75)", "n_IK of (71) kept"),
            "minus the least relative loss",
            layer="as-defined",
        ),
        Statement(
            "reproduced_without_direction",
            ("E71",),
            "With n_IK of (71) replaced by 1 the terms of (75) and (81) that come from N are reproduced exactly: this is the direction that the print has lost.",
            comes_out("(74) -> (75)", "n_IK of (71) dropped"),
            narrow,
            "exact",
            routes=("printed stencils rebuilt without it",),
        ),
        Statement(
            "convective_relations",
            ("E76", "E82"),
            f"Against every term of N, with Psi* and nodes that move with their coefficients, the printed terms with Q are off by at least {least('(65) -> (73)', 'N in (75) against every term of N'):.3g} of its size.",
            comes_out("(65) -> (73)", "N in (75) against every term of N"),
            narrow,
            "exact",
            -least("(65) -> (73)", "N in (75) against every term of N"),
            "minus the least relative loss",
            layer="as-defined",
        ),
        Statement(
            "scni_edge_narrow",
            ("E86",),
            "With C(h/2) taken at the cell's edge (86) is the linearisation of (65) without N, to the last rational, for R <= 3/2.",
            bool(scni_low["comes_out"].all()),
            f"R = {', '.join(scni_low['support_ratio'])}",
            "exact",
            layer="as-defined",
            reading="C(h/2) at the edge, R <= 3/2",
        ),
        Statement(
            "scni_edge_wide",
            ("E86",),
            f"For R > 3/2 the cell edge at 3h/2 lies under the kernel and (86) leaves it out: off by up to {scni_high['lost'].max():.3g}.",
            bool(scni_high["comes_out"].all()),
            f"R = {', '.join(scni_high['support_ratio'])}",
            "exact",
            -float(scni_high["lost"].max()),
            "minus the largest relative loss",
            layer="as-defined",
            reading="C(h/2) at the edge, R > 3/2",
        ),
        Statement(
            "scni_literal",
            ("E86",),
            f"With the moment matrix at the node, as the notation prints it, (86) is off by up to {literal['lost'].max():.3g}.",
            bool(literal["comes_out"].all()),
            narrow,
            "exact",
            -float(literal["lost"].max()),
            "minus the largest relative loss",
            layer="as-defined",
            reading="C(h/2) literal",
        ),
        Statement(
            "dni",
            ("E81", "C47"),
            f"None of {len(dni) // len(p.support_ratios)} readings of stress law, derivative and cell measure gives the stress terms of (81): the nearest is off by {dni['lost'].min():.3g}. "
            "What is lost is the change of the correction with the other nodes: varied as a function of x_K - x_I alone, B_I(x_K) gives (81).",
            bool(dni.groupby("under")["comes_out"].all().any()),
            narrow,
            "exact",
            -float(dni["lost"].min()),
            "minus the least relative loss",
            layer="as-defined",
        ),
        Statement(
            "dni_relation",
            ("E87",),
            f"(87) is not the relation of the linearised (65) without N in any of the readings: the nearest is off by {relation['lost'].min():.3g} of omega^2.",
            bool(relation.groupby("under")["comes_out"].all().any()),
            f"{narrow}; kh = 7/5",
            "exact",
            -float(relation["lost"].min()),
            "minus the least relative error",
            layer="as-defined",
        ),
        Statement(
            "dni_reproduced",
            ("E80",),
            f"All stress terms of (81) come out to the last rational when B_I(x_K) is varied as a function of x_K - x_I alone, its slope taken by duals on the fixed lattice, in: {'; '.join(rebuilt)}. "
            "Psi,xx is then the slope of Psi,x at the neighbouring node.",
            bool(rebuilt),
            narrow,
            "exact",
            routes=("printed stencil rebuilt",),
        ),
    ]
    return statements


STUDY = Study(
    "Derivation of the printed stencils",
    Parameters(),
    Parameters(support_ratios=("3/2", "7/4"), wide_ratios=()),
    compute,
    judge,
    draw,
)
