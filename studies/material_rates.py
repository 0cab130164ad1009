"""Material rates of kernels and shape functions: (34)-(36), Psi* of (40) and the true rate, in exact arithmetic."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.certify import kinematics
from rkverify.certify.samples import rational_node_sets
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

ROUNDED = Numeric(1e-11, 0, "exact rationals, rounded once when they are printed")
SETTING = [("nodes", "", "node set"), ("order", "1", "order n of the basis")]


@dataclass(frozen=True)
class Parameters:
    """Nodes per set and the seed of jitter and velocities."""

    nodes: int = 13
    seed: int = 20061


def compute(p: Parameters) -> Tables:
    """Printed rates against the coefficients of power series in time."""
    sets = rational_node_sets(p.nodes, p.seed)
    return {
        "kernel_rates": table(
            kinematics.kernel_rates(sets),
            [
                ("nodes", "", "node set"),
                ("x", "length", "material point"),
                ("difference", "1/time", "largest difference of (35) from the time series"),
                ("semi_lagrangian", "1/time", "largest rate of a semi-Lagrangian kernel"),
                ("lagrangian", "1/time", "largest rate of a Lagrangian kernel"),
            ],
            "Rates of the kernels for nodes and points with velocities of their own.",
            ROUNDED,
        ),
        "shape_rates": table(
            kinematics.shape_function_rates(sets),
            [
                *SETTING,
                ("true_against_series", "1/time", "largest difference of the true rate from the time series"),
                (
                    "star_against_series",
                    "1/time",
                    "largest difference of Psi* from C times the time series of the kernel",
                ),
                ("sum_of_true", "1/time", "largest |sum_I dPsi_I/dt|"),
                ("star_against_true", "1/time", "largest |Psi*_I - dPsi_I/dt|"),
                ("sum_of_star", "1/time", "largest |sum_I Psi*_I|"),
            ],
            "The true material rate of the shape functions, and Psi* of (40) in its place.",
            ROUNDED,
        ),
        "accelerations": table(
            kinematics.accelerations(sets),
            [
                *SETTING,
                ("difference", "length/time^2", "largest difference of (39) from the time derivative of (38)"),
                ("acceleration", "length/time^2", "largest time derivative of (38)"),
            ],
            "(39) with Psi* against the acceleration that belongs to the velocity (38).",
            ROUNDED,
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The sums of Psi* and of the true rate."""
    frame = tables["shape_rates"].frame
    figure = new_figure(6.4, 3.2)
    axes = figure.subplots()
    for style, marker, (nodes, rows) in zip(LINES, "os^", frame.groupby("nodes"), strict=False):
        axes.plot(rows["order"], rows["sum_of_star"], label=f"Ψ*, {nodes}", marker=marker, **style)
    axes.plot([0, 1, 2], [0, 0, 0], color="#808080", linewidth=3, label="true rate, all sets (exactly 0)")
    axes.set(xlabel="order n of the basis  (1)", ylabel="largest |sum over the nodes|  (1/time)", xticks=[0, 1, 2])
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    caption = f"Sum over the nodes of Psi* and of the true material rate at a material point; {p.nodes} nodes in [0, 1] with random velocities, cubic kernel (ours)."
    true, star = frame["sum_of_true"].astype(float), frame["sum_of_star"]
    alternative = (
        f"The largest sum over the nodes is at most {true.max():g} for the true rates and at least {star.min():.2g} for Psi-star, "
        f"over {len(frame)} node sets and orders of the basis."
    )
    return {"sums": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """(34), (35) hold; Psi* is not the material rate of the shape function."""
    kernels, shapes, whole = (tables[name].frame for name in ("kernel_rates", "shape_rates", "accelerations"))
    tried = f"{p.nodes} uniform, graded and jittered nodes with random velocities, five material points each"
    series = bool((kernels["difference"] == "0").all())
    still = bool((kernels["lagrangian"] == "0").all())
    moves = float(kernels["semi_lagrangian"].min())
    true = bool((shapes["true_against_series"] == "0").all() and (shapes["sum_of_true"] == "0").all())
    star = bool((shapes["star_against_series"] == "0").all())
    relative = float((whole["difference"] / whole["acceleration"]).min())
    least_sum = float(shapes["sum_of_star"].min())
    return [
        Statement(
            "kernel_rate",
            ("E35",),
            "(35) is the time derivative of the moving kernel, exactly.",
            series,
            tried,
            "exact",
        ),
        Statement(
            "lagrangian_rate",
            ("E34", "C9"),
            "The material rate of a Lagrangian kernel is exactly 0: neither X nor X_I changes.",
            still,
            tried,
            "exact",
        ),
        Statement(
            "semi_lagrangian_rate",
            ("C10",),
            f"The material rate of the semi-Lagrangian kernels does not vanish: at every point one is at least {moves:.3g} per unit of time.",
            series and moves > 0,
            tried,
            "exact",
            moves,
            "least over the points of the largest kernel rate (1/time)",
        ),
        Statement(
            "notation",
            ("E26", "E36", "E70", "E71"),
            "Distance measure, direction and material rate as transcribed give the time derivative of the moving kernel.",
            series,
            tried,
            "exact",
            routes=("time series",),
        ),
        Statement(
            "psi_star",
            ("E31", "E40", "E68"),
            "Psi* as transcribed is the time series of the kernel times Psi_I / phi_I from constrained minimisation, exactly.",
            star,
            tried,
            "exact",
            routes=("time series", "constrained minimisation"),
        ),
        Statement(
            "true_rate",
            ("E39", "C25"),
            "With the rate of C the product rule gives the time series of Psi exactly, and the rates sum to exactly 0 over the nodes.",
            true,
            tried,
            "exact",
            routes=("time series",),
        ),
        Statement(
            "acceleration",
            ("E39", "C25"),
            f"(39) with Psi* is not the time derivative of (38): they differ by at least {relative:.3g} of the largest acceleration, and Psi* sums to at least {least_sum:.3g} per unit of time where the rate of a constant is 0. The rate of C is missing.",
            relative == 0,
            tried,
            "exact",
            -relative,
            "minus the least relative difference over the node sets",
        ),
    ]


STUDY = Study("Material rates", Parameters(), Parameters(nodes=9), compute, judge, draw)
