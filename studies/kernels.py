"""The kernels as data, (12) among them: values, continuity, moments, and an independent library's B-splines."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.certify.kernel_facts import facts, gaps_to_library, profile
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure


@dataclass(frozen=True)
class Parameters:
    """How many points z the curves have."""

    samples: int = 121


def compute(p: Parameters) -> Tables:
    """Facts of every kernel, exactly; curves of phi and phi''; distance from scipy's B-splines."""
    return {
        "facts": table(
            facts(),
            [
                ("kernel", "", "name"),
                ("at_zero", "1", "phi(0)"),
                ("continuity", "1", "m of the class C^m of phi(|z|) on the whole line"),
                ("joints", "1", "where pieces meet"),
                ("least", "1", "least value of phi on the samples"),
                ("moment_0", "1", "integral of phi from 0 to 1"),
                ("moment_2", "1", "integral of z^2 phi from 0 to 1"),
                ("source", "", "where the kernel comes from"),
            ],
            "Every kernel of the suite; all numbers are exact rationals.",
            Exact(),
        ),
        "profiles": table(
            profile(p.samples),
            [
                ("kernel", "", "name"),
                ("z", "1", "distance over support radius"),
                ("phi", "1", "kernel"),
                ("slope", "1", "first derivative"),
                ("curvature", "1", "second derivative"),
            ],
            "phi, phi' and phi'' of every kernel.",
            Numeric(1e-12, 1e-11, "a sum of at most five terms below 10^3, each rounded once at 2^-53"),
        ),
        "library": table(
            gaps_to_library(p.samples),
            [
                ("kernel", "", "name"),
                ("difference", "1", "largest difference from scipy's B-spline of that order"),
                ("allowed", "1", "rounding bound: 64 units of 2^-52 times the largest term"),
            ],
            "The B-splines against scipy.interpolate.BSpline; the cubic one also against the printed pieces of (12).",
            Numeric(0, 1e-12, "differences of rounding size are no portable numbers"),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Curves of phi and of its curvature."""
    frame = tables["profiles"].frame
    figure = new_figure(8, 3.4)
    left, right = figure.subplots(1, 2)
    for style, (name, part) in zip(LINES, frame.groupby("kernel", sort=True), strict=True):
        top = part["phi"].iloc[0]
        left.plot(part["z"], part["phi"] / top, label=name, **style)
        right.plot(part["z"], part["curvature"] / top, label=name, **style)
    left.set(xlabel="z = distance / support radius  (1)", ylabel="φ(z) / φ(0)  (1)")
    right.set(xlabel="z = distance / support radius  (1)", ylabel="φ″(z) / φ(0)  (1)", ylim=(-22, 14))
    left.legend()
    caption = "Kernels of the suite, each divided by its value at 0; the paper's (12) is called cubic. All choices but (12) are ours."
    kinds = frame.groupby("kernel")
    fall = [name for name, part in kinds if (part["phi"].diff().dropna() < 0).all()]
    left = max(part["phi"].iloc[-1] / part["phi"].iloc[0] for _, part in kinds)
    turn = [name for name, part in kinds if part["curvature"].iloc[0] < 0 < part["curvature"].max()]
    alternative = (
        f"{len(fall)} of {len(kinds)} kernels fall at every step from the node on, to {left:.2g} of their top or less at z = {frame['z'].max():.3g}; "
        f"a negative curvature at the node and a positive one further out have {', '.join(turn)}."
    )
    return {"kernels": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """(12) is a kernel: C2, not C3, positive inside, zero at its end; and it is the cubic B-spline."""
    cubic = tables["facts"].frame.set_index("kernel").loc["cubic"]
    library = tables["library"].frame.set_index("kernel")
    agrees = bool((library["difference"] <= library["allowed"]).all())
    return [
        Statement(
            "cubic_is_the_b_spline",
            ("E12",),
            f"The transcription of (12) agrees with its printed pieces exactly and with scipy's cubic B-spline to {rounding(library.loc['cubic', 'difference'])}.",
            agrees and cubic["at_zero"] == "2/3",
            f"{p.samples} points z in [0, 1]",
            "exact",
            routes=("printed pieces", "scipy B-spline"),
        ),
        Statement(
            "cubic_is_a_kernel",
            ("C16",),
            f"(12) is of class C^{cubic['continuity']} and no smoother, not negative, and zero from z = 1 on with phi(0) = {cubic['at_zero']}.",
            bool(cubic["continuity"] == 2 and cubic["least"] == "0"),
            "continuity from the coefficients, for all z; sign on the samples",
            "sampled",
            margin=float(cubic["continuity"]),
            margin_means="class of continuity",
        ),
    ]


STUDY = Study("Kernels", Parameters(), Parameters(samples=13), compute, judge, draw)
