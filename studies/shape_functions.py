"""RK shape functions of order 0, 1, 2 in one dimension: exact reproduction, independent routes, derivatives."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rkverify.certify import kinematics
from rkverify.certify.samples import rational_node_sets
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

DEFINITIONS = ("E1", "E2", "E5", "E6", "E8", "E10", "E11", "E27", "E28", "E32", "E33", "E38")
SETTING = [("nodes", "", "node set"), ("order", "1", "order n of the basis")]


@dataclass(frozen=True)
class Parameters:
    """Nodes per set, the seed of the jitter, the digits of the multiple-precision route, dimensions and sides of grids."""

    nodes: int = 13
    seed: int = 20061
    digits: int = 50
    grids: tuple[tuple[int, int], ...] = ((2, 5), (3, 5))


def compute(p: Parameters) -> Tables:
    """Residuals and differences, exact rationals wherever they can be."""
    sets = rational_node_sets(p.nodes, p.seed)
    return {
        "reproduction": table(
            kinematics.reproduction(sets),
            [
                *SETTING,
                ("degree", "1", "degree of the monomial"),
                ("residual", "length^degree", "largest residual of (3), (29)"),
            ],
            "Reproducing conditions in exact arithmetic, up to one degree beyond the order.",
            Exact(),
        ),
        "reproduction_in_space": table(
            [row for d, side in p.grids for row in kinematics.reproduction_in_space(d, side, p.seed, p.digits)],
            [
                ("dimension", "1", "number of space dimensions"),
                ("order", "1", "order n of the basis"),
                ("degree", "1", "total degree of the monomials"),
                ("residual", "length^degree", "largest residual of (3), (29)"),
            ],
            f"Reproducing conditions in two and three dimensions, radial kernel, {p.digits} digits.",
            Numeric(
                1e-2, 10.0 ** (5 - p.digits), "zero is a rounding error of the last digits, others are rounded to three"
            ),
        ),
        "routes": table(
            kinematics.shape_routes(sets),
            [*SETTING, ("route", "", "independent route"), ("difference", "1", "largest difference of Psi")],
            "Shape functions (4) against independent routes, in exact arithmetic.",
            Exact(),
        ),
        "digits": table(
            kinematics.digits_against_exact(sets, p.digits),
            [*SETTING, ("error", f"10^-{p.digits}", "largest error of Psi")],
            f"Shape functions at {p.digits} digits against the exact rationals.",
            Numeric(1e-6, 0, "multiple-precision operations are the same on every machine; the last print is a float"),
        ),
        "derivatives": table(
            kinematics.derivative_routes(sets),
            [*SETTING, ("first", "1/length", "largest difference of Psi,x"), ("second", "1/length^2", "of Psi,xx")],
            "Full derivatives by the product rule against the coefficients of the power series of Psi(x + t), exact.",
            Exact(),
        ),
        "readings": table(
            kinematics.readings_of_the_derivative(sets),
            [
                *SETTING,
                ("reading", "", "reading of the derivative"),
                ("constant", "1/length", "largest |sum_I Psi_I,x|"),
                ("linear", "1", "largest |sum_I Psi_I,x x_I - 1|"),
                ("from_full", "1", "largest difference from the full derivative over its largest value"),
            ],
            "What each reading of the derivative keeps of the reproducing conditions.",
            Numeric(1e-11, 0, "exact rationals, rounded once when they are printed"),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """How far each reading is from the full derivative."""
    frame = tables["readings"].frame
    part = frame[(frame["nodes"] == "jittered, own supports") & (frame["reading"] != "full")]
    figure = new_figure(6.4, 3.2)
    axes = figure.subplots()
    for style, marker, (reading, rows) in zip(LINES, "os^", part.groupby("reading"), strict=False):
        axes.plot(rows["order"], rows["from_full"], label=reading, marker=marker, **style)
    axes.set(
        xlabel="order n of the basis  (1)",
        ylabel="largest difference from full / largest full  (1)",
        xticks=[0, 1, 2],
        yscale="log",
    )
    axes.legend()
    caption = f"Distance of three readings of Psi,x from the full derivative; jittered nodes with supports of their own, {p.nodes} nodes, cubic kernel (ours)."
    sizes = "; ".join(
        f"{reading} by {', '.join(f'{value:.2g} at order {order}' for order, value in zip(rows['order'], rows['from_full'], strict=True))}"
        for reading, rows in part.groupby("reading")
    )
    alternative = f"Largest difference from the full derivative, as a share of its largest value: {sizes}."
    return {"readings": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Which of the equations the exact residuals confirm."""
    kept = tables["reproduction"].frame
    within, beyond = kept[kept["degree"] <= kept["order"]], kept[kept["degree"] > kept["order"]]
    least_beyond = min(float(Fraction(r)) for r in beyond["residual"])
    space = tables["reproduction_in_space"].frame.astype({"residual": float})
    zero_in_space = float(space[space["degree"] <= space["order"]]["residual"].max())
    beyond_in_space = float(space[space["degree"] > space["order"]]["residual"].min())
    # Ten digits are in hand beyond the printed ones, for the condition of the moment matrix.
    in_space = zero_in_space < 10.0**-p.digits and beyond_in_space > 1e-6
    exact = in_space and bool((within["residual"] == "0").all()) and least_beyond > 0
    same = bool((tables["routes"].frame["difference"] == "0").all())
    slopes = tables["derivatives"].frame
    derived = bool((slopes["first"] == "0").all() and (slopes["second"] == "0").all())
    error = float(tables["digits"].frame["error"].max())
    tried = f"one dimension: {p.nodes} uniform, graded and jittered nodes, five points each, orders 0 to 2"
    everywhere = f"{tried}; two and three dimensions: one point of a jittered grid"
    routes = ("reproducing conditions", "constrained minimisation", "Cramer's rule")
    return [
        Statement(
            "reproduction",
            ("E3", "E29"),
            f"Every monomial up to the order is reproduced with residual exactly 0; one degree further the residual is at least {least_beyond:.3g}. In two and three dimensions the residuals are {zero_in_space:.1g} and at least {beyond_in_space:.3g}.",
            exact,
            everywhere,
            "exact",
            least_beyond,
            "least residual one degree beyond the order",
        ),
        Statement(
            "closed_form",
            ("E4", "E9", "E30", "C15"),
            "The closed form is, to the last rational, the function of the form (2) that meets (3): the minimiser with multipliers has the same values.",
            exact and same,
            tried,
            "exact",
            routes=routes,
        ),
        Statement(
            "definitions",
            DEFINITIONS,
            "Basis, moment matrix and correction function as transcribed give the same shape functions as two routes that use none of them.",
            exact and same,
            tried,
            "exact",
            routes=routes,
        ),
        Statement(
            "derivatives",
            ("E2",),
            "First and second full derivatives by the product rule are the coefficients of the power series of Psi, exactly.",
            derived,
            tried,
            "exact",
            routes=("power series",),
        ),
        Statement(
            "digits",
            ("E4",),
            f"At {p.digits} digits the shape functions are within {error:.2g} units of 10^-{p.digits} of the exact rationals.",
            error < 1,
            tried,
            "exact",
            1 - error,
            "distance from one unit",
            routes=("multiple precision",),
        ),
    ]


STUDY = Study("Shape functions in one dimension", Parameters(), Parameters(nodes=9), compute, judge, draw)
