"""What each option of each open choice does to a wave, all other choices at their defaults: on a line, and in the plane where a line has no such choice."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

from rkverify.readings import Integration
from rkverify.stability.layers import Setting
from rkverify.stability.options import option_rows
from rkverify.stability.options_in_space import option_rows_in_space
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Statement, Study, Tables, table

if TYPE_CHECKING:
    import pandas as pd

SAME = 1e-6
"""Below this share of the largest frequency two relations are one: double roots are known to the root of rounding."""


CHOICES = {
    "derivative": "the derivative of a shape function",
    "stress_law": "the rate of stress",
    "node_motion": "what a node moves with",
    "cell_edges": "the edges of cells under motion",
    "cell_measure": "the measure of a cell",
    "support_radius": "the support radius in time",
    "mass": "the mass matrix",
    "half_point": "C(h/2)",
    "convection": "the rate in the convective term",
    "window": "the window of the kernel in the plane",
    "edge_rule": "the rule on a cell's edge",
    "integration": "the nodal integration",
}
"""The choices in words."""


@dataclass(frozen=True)
class Parameters:
    """Support ratios, stresses over C, velocity gradients in c/h (0 first), waves over the half circle; in the plane support ratios,
    the stress over mu = lambda along one axis, and the nodes along an axis into which the waves fit.
    """

    support_ratios: tuple[str, ...] = ("3/2", "7/4")
    stress_ratios: tuple[str, ...] = ("-1/2", "1/2")
    velocity_gradients: tuple[str, ...] = ("0", "1/10")
    integrations: tuple[Integration, ...] = ("scni", "dni")
    samples: int = 6
    plane_ratios: tuple[str, ...] = ("1.4", "1.8")
    stress: float = 0.3
    count: int = 8


def compute(p: Parameters) -> Tables:
    """Growth and distance from the default for every option; and for each option the largest of them."""
    rows = []
    for integration, R, s, Q in product(p.integrations, p.support_ratios, p.stress_ratios, p.velocity_gradients):
        setting = Setting("semi-lagrangian", integration, R, s, velocity_gradient=Q, layer="as-defined")
        place = {"integration": integration, "support_ratio": R, "stress_ratio": s, "Q": Q}
        rows += [{**_rounded(row), **place} for row in option_rows([setting], p.samples)]
    states = {"tension": (p.stress, 0.0, 0.0), "compression": (-p.stress, 0.0, 0.0)}
    plane = [_rounded(row) for row in option_rows_in_space(p.plane_ratios, states, p.count)]
    growth = ("growth", "c/h", "fastest growth of a wave")
    away = ("away", "1", "largest distance of a frequency from the default's, over the default's largest frequency")
    choice = ("choice", "", "the reading whose option is taken")
    option = ("option", "", "its option; every other reading is at its default")
    why = "rounded to six digits; eigenvalues of matrices of size up to five, double ones to the root of rounding"
    compared = Numeric(1e-4, 1e-5, why)
    options = table(
        rows,
        [
            choice,
            option,
            ("integration", "", "scni or dni"),
            ("support_ratio", "1", "R = a/h"),
            ("stress_ratio", "1", "sigma/C"),
            ("Q", "c/h", "velocity gradient"),
            growth,
            away,
        ],
        "What each option of a reading does to growth and frequencies on a line.",
        compared,
    )
    in_plane = table(
        plane,
        [
            choice,
            option,
            ("integration", "", "of the default: scni, dni or snni"),
            ("support_ratio", "1", "support radius over spacing"),
            ("state", "", "uniaxial tension or compression"),
            growth,
            away,
        ],
        f"What each option of a reading does on the square lattice at rest; stress {p.stress:g} mu, lambda = mu, speeds in units of (mu/rho)^1/2.",
        compared,
    )
    summary = table(
        _summary(p, options.frame, in_plane.frame),
        [
            choice,
            option,
            ("where", "", "on a line, or in the plane where a line has no such choice"),
            ("at_rest", "1", "largest shift of a frequency at rest, as a share of the largest"),
            ("in_motion", "", "the same in motion, on a line"),
            ("tension", "c/h", "fastest growth at rest in tension"),
            ("compression", "c/h", "fastest growth at rest in compression"),
        ],
        f"The largest of all settings, option by option; in motion: Q = {p.velocity_gradients[-1]} c/h.",
        compared,
    )
    return {"options": options, "in_plane": in_plane, "summary": summary}


def _rounded(row: dict[str, object]) -> dict[str, object]:
    return {key: round(value, 6) + 0.0 if isinstance(value, float) else value for key, value in row.items()}


def _summary(p: Parameters, options: "pd.DataFrame", plane: "pd.DataFrame") -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for (choice, option), part in options.groupby(["choice", "option"], sort=False):
        rest, moving = part[part["Q"] == "0"], part[part["Q"] == p.velocity_gradients[-1]]
        pressed = rest.stress_ratio.str.startswith("-")
        rows.append(
            {
                "choice": choice,
                "option": option,
                "where": "line",
                "at_rest": rest.away.max(),
                "in_motion": f"{moving.away.max():.4g}",
                "tension": rest[~pressed].growth.max(),
                "compression": rest[pressed].growth.max(),
            }
        )
    for (choice, option), part in plane.groupby(["choice", "option"], sort=False):
        growth = part.groupby("state").growth.max()
        rows.append(
            {
                "choice": choice,
                "option": option,
                "where": "plane",
                "at_rest": part.away.max(),
                "in_motion": "",
                **growth,
            }
        )
    return rows


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """For each choice: whether every option gives a relation of its own, and how far they are apart."""
    summary = tables["summary"].frame
    waves = "cubic kernel, linear basis"
    line = (
        f"R = {', '.join(p.support_ratios)}; sigma/C = {', '.join(p.stress_ratios)}; "
        f"Q = {', '.join(p.velocity_gradients)} c/h; {p.samples} waves; {waves}"
    )
    plane = f"square lattice, R = {', '.join(p.plane_ratios)}; stress {p.stress:g} mu along an axis, both signs; {p.count} by {p.count} waves; {waves}"
    found = []
    for choice, part in summary.groupby("choice", sort=False):
        first, others = part.iloc[0], part.iloc[1:]
        on_line = first["where"] == "line"
        shifts = [max(row.at_rest, float(row.in_motion or 0)) for row in others.itertuples()]
        told = "; ".join(
            f"{row.option} by {row.at_rest:.3g}" + (f" and {float(row.in_motion):.3g}" if on_line else "")
            for row in others.itertuples()
        )
        still = [str(row.option) for row, shift in zip(others.itertuples(), shifts, strict=True) if shift <= SAME]
        moved = f"{', '.join(still)} moves no frequency" if still else "every other option moves some frequency"
        states = "at rest and in motion" if on_line else "at rest"
        layer = {"half_point": "printed", "convection": ""}.get(str(choice), "as-defined" if on_line else "")
        found.append(
            Statement(
                name=str(choice),
                about=(),
                says=f"For {CHOICES[str(choice)]}, in place of {first['option']}, {moved}. Largest shifts {states}, as shares of the largest frequency: {told}.",
                holds=bool(min(shifts) > SAME),
                tried=line if on_line else plane,
                evidence="sampled",
                margin=round(min(shifts) - SAME, 6),
                margin_means="least of the options' largest shifts, less the share below which relations are one",
                layer=layer,
            )
        )
    return found


STUDY = Study(
    title="Readings: what each option does to a wave",
    parameters=Parameters(),
    quick=Parameters(support_ratios=("3/2",), samples=2, plane_ratios=("1.4",), count=4),
    compute=compute,
    judge=judge,
)
