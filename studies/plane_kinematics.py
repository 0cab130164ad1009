"""Smoothed gradients, chain rule, supports and relative motion in one to three dimensions: (13)-(17), (23), (25), (47), Figures 2 and 3."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from rkverify.certify import motions_in_space, smoothing
from rkverify.certify.motions import RIGID
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Table, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure


@dataclass(frozen=True)
class Parameters:
    """Dimensions, seed of the jittered nodes, Gauss points by dimension, particles along an axis, digits."""

    dimensions: tuple[int, ...] = (1, 2, 3)
    seed: int = 20061
    orders: tuple[int, ...] = (0, 1, 2)
    points: tuple[tuple[int, ...], ...] = ((1, 2, 3, 4, 5), (1, 2, 3, 4, 5), (1, 2, 3))
    particles: int = 11
    digits: int = 20


ROUNDED = Numeric(1e-6, 1e-13, "sums of some thousand terms below 10 in double precision")


def compute(p: Parameters) -> Tables:
    """Everything that the statements rest on."""
    averages = [
        row
        for dimension, points in zip(p.dimensions, p.points, strict=False)
        for window in ("radial", "tensor")
        if dimension == 2 or window == "radial"
        for row in smoothing.averages(dimension, "radial" if window == "radial" else "tensor", points, p.seed)
    ]
    return {
        "sums": _sums(p),
        "patches": table(
            smoothing.patches(p.dimensions, p.seed),
            [
                ("dimension", "", "space dimensions"),
                ("order", "", "order of the basis"),
                ("integration", "", "nodal integration"),
                ("completeness", "1", "largest error of the displacement gradient, which is of size 1"),
                ("constraint", "length^(d-1)", "largest |sum_L b A_L - int Psi N| over the nodes"),
                ("unbalanced", "force", "largest nodal force that is left, the modulus being 1"),
            ],
            "A linear displacement with the two conditions met or withheld; the zeros are exact.",
            ROUNDED,
        ),
        "polynomials": table(
            smoothing.polynomials(p.dimensions, p.seed),
            [
                ("dimension", "", "space dimensions"),
                ("degree", "", "degree of the displacement"),
                ("rule", "", "rule on the boundary of the cell"),
                ("difference", "1", "largest difference of (14) from (13); 0 is exact, others to six digits"),
            ],
            "The divergence theorem on polynomial displacements, one Voronoi cell, in rationals.",
            Exact(),
        ),
        "averages": table(
            averages,
            [
                ("dimension", "", "space dimensions"),
                ("window", "", "radial or tensor"),
                ("rule", "", "rule on the boundary of the cell"),
                ("points", "", "Gauss points on an edge and each way in the cell; 0 for the other rules"),
                ("boundary_and_sum", "1", "largest difference of (15) from (16)"),
                ("boundary_and_average", "1", "largest difference of (14) from (13)"),
                ("gradients", "1/length", "largest difference of (17) from the mean of Psi_I,i over the cell"),
                ("size", "1", "largest entry of (16)"),
            ],
            "The forms of the smoothed deformation gradient of an approximated displacement; order 1, kernel wendland-c4.",
            ROUNDED,
        ),
        "chain_rule": table(
            motions_in_space.chain_rule(p.dimensions, p.orders, p.seed),
            [
                ("dimension", "", "space dimensions"),
                ("order", "", "order of the basis"),
                ("motion", "", "map from X to x"),
                (
                    "difference",
                    "1/length",
                    "largest difference of (25) from the derivative of the mapped function, exact",
                ),
                ("without", "1/length", "the same without F^-1"),
            ],
            "The chain rule (25) against duals through the inverse of the map, in rationals; tensor window, cubic kernel.",
            Numeric(1e-9, 1e-15, "differences are text; one rounding of a rational"),
        ),
        "supports": table(
            motions_in_space.supports(p.dimensions, p.particles, p.seed, p.digits),
            [
                ("dimension", "", "space dimensions"),
                ("motion", "", "map from X to x"),
                ("time", "", "time t of the motion"),
                ("particles", "", "particles under the kernel before"),
                ("lagrangian_entered", "", "of the Lagrangian support: particles that came"),
                ("lagrangian_left", "", "and that went"),
                ("entered", "", "of the semi-Lagrangian support: particles that came"),
                ("left", "", "and that went"),
                ("lagrangian_change", "1", "largest change of a Lagrangian shape function at material points"),
                ("change", "1", "largest change of a semi-Lagrangian one there"),
            ],
            "Material particles under one kernel, and shape functions at material points, in motions; radial window, order 1.",
            Numeric(1e-9, 1e-15, "counts are whole numbers; values carry twenty digits"),
        ),
        "signs": table(
            motions_in_space.signs(p.dimensions, p.seed, p.digits),
            [
                ("dimension", "", "space dimensions"),
                ("motion", "", "map from X to x"),
                ("time", "", "time t of the motion"),
                ("away", "", "pairs of nodes with n.(v - v_I) > 0"),
                ("towards", "", "pairs with n.(v - v_I) < 0"),
                ("neither", "", "pairs with n.(v - v_I) = 0"),
                ("wrong", "", "pairs whose distance does otherwise"),
            ],
            "The sign of n.(v - v_I) against the distance a little before and after.",
            Exact(),
        ),
    }


def _sums(p: Parameters) -> Table:
    return table(
        smoothing.sums(p.dimensions, p.seed),
        [
            ("dimension", "", "space dimensions"),
            ("configuration", "", "undeformed, or after a homogeneous deformation with new cells"),
            ("rule", "", "rule on the boundary of the cells"),
            ("constant", "1/length", "largest |sum_I b_iI|"),
            ("linear", "1", "largest |sum_I b_iI X_jI - delta_ij|"),
            ("measures", "length^d", "|sum_L A_L - measure of the domain|"),
            ("constraint", "length^(d-1)", "largest |sum_L b_iI A_L - int Psi_I N_i dGamma|"),
        ],
        "Sums of smoothed gradients over Voronoi cells, in rationals; order 1, cubic kernel, tensor window.",
        Exact(),
    )


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Boundary form against cell average, over the number of Gauss points."""
    frame = tables["averages"].frame
    figure = new_figure(6.4, 3.4)
    axes = figure.subplots()
    for style, ((dimension, window), rows) in zip(LINES, frame.groupby(["dimension", "window"]), strict=False):
        gauss = rows[rows["points"] > 0]
        label = f"{dimension}-D, {window}" if dimension == 2 else f"{dimension}-D"
        axes.semilogy(
            gauss["points"],
            gauss["boundary_and_average"].clip(lower=1e-16),
            marker="o",
            markersize=4,
            label=label,
            **style,
        )
    trapezoid = _of(frame, "trapezoid", 2)
    if len(trapezoid):
        size = float(trapezoid["boundary_and_average"].max())
        axes.axhline(size, color="0.45", linewidth=0.8)
        axes.annotate("largest with the trapezoidal rule at the vertices", (0.98, size), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=8)  # fmt: skip
    axes.set_xticks(sorted(set(frame["points"]) - {0}))
    axes.set(xlabel="Gauss points on an edge, and each way in the cell  (1)", ylabel="largest |(14) - (13)|  (1)")
    axes.legend(fontsize=8)
    caption = (
        "Smoothed deformation gradient of one Voronoi cell as a boundary integral (14) and as an average over the cell (13), "
        "by ever finer quadrature; order 1, kernel wendland-c4, coefficients of every sign (ours). The trapezoidal rule stays "
        "where it is: its sums are exact, its integral is not."
    )
    share = float((trapezoid["boundary_and_average"] / trapezoid["size"]).max()) if len(trapezoid) else 0.0
    gauss = frame[frame["points"] > 0].sort_values("points").groupby(["dimension", "window"])["boundary_and_average"]
    ends = gauss.agg(["first", "last"])
    told = "; ".join(f"{d}-D {window} from {a:.1e} to {b:.1e}" for (d, window), a, b in ends.itertuples())
    alternative = (
        f"With more Gauss points the difference between the boundary form and the cell average goes in {told}, falling with every further point in "
        f"{sum((part.diff().dropna() < 0).all() for _, part in gauss)} of {len(ends)} cases, "
        f"while that of the trapezoidal rule at the vertices stays, at up to {share:.0%} of the largest entry."
    )
    return {"averages": Drawing(figure, caption, alternative)}


def _of(frame: pd.DataFrame, rule: str, least: int) -> pd.DataFrame:
    return frame[(frame["rule"] == rule) & (frame["dimension"] >= least)]


def _falls(frame: pd.DataFrame, column: str) -> bool:
    """From the first to the last count of Gauss points by at least a factor of 100 for each that was added, or to rounding."""
    cases = []
    for _, rows in frame[frame["points"] > 0].groupby(["dimension", "window"]):
        first, last = rows.iloc[0], rows.iloc[-1]
        cases.append(last[column] < max(first[column] * 10.0 ** (first["points"] - last["points"]), 1e-13))
    return all(cases)


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Each equation and claim by its table."""
    frames = {name: t.frame for name, t in tables.items()}
    return [*_smoothing(p, frames), *_conditions(p, frames), *_motions(p, frames)]


def _span(p: Parameters) -> str:
    return f"jittered nodes in {', '.join(f'{d}-D' for d in p.dimensions)}"


def _smoothing(p: Parameters, frames: Mapping[str, pd.DataFrame]) -> list[Statement]:
    averages, polynomials, sums = frames["averages"], frames["polynomials"], frames["sums"]
    same = float(averages["boundary_and_sum"].max())
    finest = float(
        averages.loc[averages.groupby(["dimension", "window"])["points"].idxmax(), "boundary_and_average"].max()
    )
    falls = _falls(averages, "boundary_and_average")
    gradients = _falls(averages, "gradients")
    linear = bool((polynomials[polynomials["degree"] == 1]["difference"] == "0").all())
    simpson = bool((polynomials[polynomials["rule"] == "simpson"]["difference"] == "0").all())
    quadratic = polynomials[(polynomials["degree"] == 2) & (polynomials["dimension"] > 1)]
    quadratic = quadratic[quadratic["rule"].isin(smoothing.RULES)]
    trapezoid = _of(averages, "trapezoid", 2)
    error = float((trapezoid["boundary_and_average"] / trapezoid["size"]).max()) if len(trapezoid) else 0.0
    exact = {c: bool((sums[c] == "0").all()) for c in ("constant", "linear", "measures", "constraint")}
    undeformed = sums["configuration"] == "undeformed"
    zero = {c: (sums[c] == "0") for c in exact}
    here = bool((zero["constant"] & zero["linear"])[undeformed].all())
    there = bool((zero["constant"] & zero["linear"] & zero["measures"])[~undeformed].all())
    # Sums of a few hundred terms below 10, in doubles.
    rounded = same <= 1e3 * 10 * 2.0**-52
    cells = f"one Voronoi cell each, {_span(p)}, radial and tensor window"
    return [
        Statement(
            "average",
            ("E13",),
            f"The cell average (13) is the boundary integral (14), exactly for linear displacements and, with Simpson's rule on the edges, for quadratic ones; for approximated displacements to {finest:.0e} with the finest rule.",
            linear and simpson and falls,
            cells,
            "sampled",
            routes=("boundary integral (14)", "exact integrals of polynomials"),
        ),
        Statement(
            "divergence",
            ("E14",),
            f"The boundary integral (14) tends to the cell average (13) as the rule gets finer. With the trapezoidal rule at the vertices it is off by up to {error:.1%} of the largest entry.",
            linear and simpson and falls,
            cells,
            "sampled",
        ),
        Statement(
            "name",
            ("E15",),
            f"(15) as a boundary integral of u^h is the sum (16) over the coefficients to {rounding(same)}, and tends to the cell average.",
            rounded and falls,
            cells,
            "sampled",
            routes=("sum over coefficients (16)", "cell average of du/dX"),
        ),
        Statement(
            "linear in the coefficients",
            ("E16",),
            f"The sum (16) is the boundary integral (15) of the approximated displacement, by the same rule, to {rounding(same)}, with every rule.",
            rounded,
            cells + "; coefficients of every sign",
            "sampled",
        ),
        Statement(
            "operator",
            ("E17",),
            "The smoothed gradient (17) tends to the mean of Psi_I,i over the cell as the rule gets finer; its sums sum_I b_iI = 0 and sum_I b_iI X_jI = delta_ij and the integration constraint over all cells are exact with trapezoid and midpoint.",
            gradients and here and exact["constraint"],
            f"{_span(p)}, every cell",
            "exact",
        ),
        Statement(
            "restated",
            ("E23",),
            "(23) has the sums of (17), and the areas of the cells sum exactly to that of the domain.",
            here and exact["measures"],
            f"{_span(p)}, every cell",
            "exact",
            routes=("sums over the nodes", "tiling of the domain"),
        ),
        Statement(
            "current configuration",
            ("E47",),
            "After a homogeneous deformation, with cells made anew around the moved nodes, (47) keeps both sums and the measure, exactly.",
            there,
            f"{_span(p)}, stretched, sheared and turned",
            "exact",
            routes=("sums over the nodes", "tiling of the deformed domain"),
        ),
        Statement(
            "the same smoothing",
            ("C18",),
            f"(13), (14) and (16) are the same where the integrals are: (14) and (16) to {rounding(same)} with any rule, (13) and (14) to {finest:.0e} with the finest one. With one rule on the boundary and another in the cell they differ: trapezoid and midpoint miss (13) even for quadratic displacements, in {int((quadratic['difference'] != '0').sum())} of {len(quadratic)} cases.",
            rounded and falls and linear and simpson,
            cells,
            "sampled",
            margin=error,
            margin_means="what the trapezoidal rule misses, of the largest entry",
        ),
    ]


def _conditions(p: Parameters, frames: Mapping[str, pd.DataFrame]) -> list[Statement]:
    rows = frames["patches"]
    both = rows[(rows["order"] == 1) & (rows["integration"] == "scni")]
    lacking = rows[(rows["order"] == 0) | (rows["integration"] == "dni")]
    met = bool((both[["completeness", "constraint", "unbalanced"]] == 0).all(axis=None))
    as_meant = bool(
        (rows[rows["integration"] == "scni"]["constraint"] == 0).all()
        and (rows[rows["integration"] == "dni"]["constraint"] > 0).all()
        and (rows[rows["order"] == 0]["completeness"] > 0).all()
        and (rows[rows["order"] == 1]["completeness"] == 0).all()
    )
    least = float(lacking["unbalanced"].min())
    return [
        Statement(
            "two conditions",
            ("C17",),
            f"The kinematic half of the linear patch test, without solving it: a linear displacement leaves no node out of balance where first-order completeness and the integration constraint hold both, exactly, and at least {least:.2g} (modulus 1, displacement gradient of size 1) where either is withheld.",
            met and as_meant and least > 0,
            f"{_span(p)}; orders 0 and 1, SCNI and DNI, tractions by the same rule",
            "exact",
            margin=least,
            margin_means="least force left with a condition withheld",
        )
    ]


def _motions(p: Parameters, frames: Mapping[str, pd.DataFrame]) -> list[Statement]:
    chain, supports, signs = frames["chain_rule"], frames["supports"], frames["signs"]
    deforming = chain[chain["motion"] != "translation"]
    rigid = supports["motion"].isin([motion(0).name for motion in RIGID])
    stay = bool((supports["lagrangian_entered"] + supports["lagrangian_left"] == 0).all())
    frozen = bool((supports["lagrangian_change"] == 0).all())
    exchanged = supports["entered"] + supports["left"]
    kept_rigid = bool((exchanged[rigid] == 0).all())
    share = exchanged[~rigid] / supports["particles"][~rigid]
    changed = float(supports["change"][~rigid].min())
    pairs = int(signs[["away", "towards", "neither"]].sum().sum())
    wrong = int(signs["wrong"].sum())
    return [
        Statement(
            "chain rule",
            ("E25",),
            f"dPsi/dX_j F_ji^-1 is the derivative of the mapped shape function, exactly, for homogeneous and curved maps; leaving F^-1 out is off by at least {float(deforming['without'].min()):.2g}/length.",
            bool((chain["difference"] == "0").all()) and bool((deforming["without"] > 0).all()),
            f"{_span(p)}, orders {', '.join(map(str, p.orders))}, {chain['motion'].nunique()} maps",
            "exact",
        ),
        Statement(
            "stay with the material",
            ("C20",),
            f"Shape functions of X have the same values at material points at all times, exactly; those of x change by at least {changed:.2g} in every motion that is not rigid.",
            frozen and stay and changed > 0,
            f"{_span(p)}; {supports['motion'].nunique()} motions at {supports['time'].nunique()} times",
            "exact",
            margin=changed,
            margin_means="least change of semi-Lagrangian values in a deformation",
        ),
        Statement(
            "particles",
            ("C23",),
            f"A Lagrangian support keeps all its particles. A semi-Lagrangian one keeps them in rigid motions and exchanges between {float(share.min()):.0%} and {float(share.max()):.0%} of their number in the others.",
            stay and kept_rigid and bool((exchanged[~rigid] > 0).all()),
            f"{_span(p)}; {supports['motion'].nunique()} motions at {supports['time'].nunique()} times, {p.particles} particles along each axis",
            "exact",
            margin=float(share.min()),
            margin_means="least share exchanged in a deformation",
        ),
        Statement(
            "approach and departure",
            ("C24",),
            f"For {pairs - wrong} of {pairs} pairs the distance grows, falls or stays as n.(v - v_I) is positive, negative or zero.",
            wrong == 0,
            f"{_span(p)}, all pairs of nodes, {signs['motion'].nunique()} motions at times drawn at random",
            "sampled",
        ),
    ]


STUDY = Study(
    "Kinematics in one to three dimensions",
    Parameters(),
    Parameters(dimensions=(1, 2), orders=(1,), points=((1, 3), (1, 3)), particles=9),
    compute,
    judge,
    draw,
)
