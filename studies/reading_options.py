"""What each option of each open choice does to a wave, all other choices at their defaults."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import inf

from rkverify.readings import Integration
from rkverify.stability.layers import Setting
from rkverify.stability.options import CHOICES, option_rows
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Statement, Study, Tables, table

SAME = 1e-6
"""Below this share of the largest frequency two relations are one: double roots are known to the root of rounding."""


@dataclass(frozen=True)
class Parameters:
    """Support ratios, stresses over C, velocity gradients in c/h (0 first), waves over the half circle."""

    support_ratios: tuple[str, ...] = ("3/2", "7/4")
    stress_ratios: tuple[str, ...] = ("-1/2", "1/2")
    velocity_gradients: tuple[str, ...] = ("0", "1/10")
    integrations: tuple[Integration, ...] = ("scni", "dni")
    samples: int = 6


def compute(p: Parameters) -> Tables:
    """Growth and distance from the default for every option."""
    rows = []
    for integration, R, s, Q in product(p.integrations, p.support_ratios, p.stress_ratios, p.velocity_gradients):
        setting = Setting("semi-lagrangian", integration, R, s, velocity_gradient=Q, layer="as-defined")
        place = {"integration": integration, "support_ratio": R, "stress_ratio": s, "Q": Q}
        for row in option_rows([setting], p.samples):
            shown = {"growth": round(row["growth"], 6) + 0.0, "away": round(row["away"], 6) + 0.0}
            rows.append({**row, **place, **shown})
    columns = [
        ("choice", "", "the reading whose option is taken"),
        ("option", "", "its option; every other reading is at its default"),
        ("integration", "", "scni or dni"),
        ("support_ratio", "1", "R = a/h"),
        ("stress_ratio", "1", "sigma/C"),
        ("Q", "c/h", "velocity gradient"),
        ("growth", "c/h", "fastest growth of a wave"),
        ("away", "1", "largest distance of a frequency from the default's, over the default's largest frequency"),
    ]
    why = "rounded to six digits; eigenvalues of matrices of size up to five, double ones to the root of rounding"
    return {
        "options": table(
            rows, columns, "What each option of a reading does to growth and frequencies.", Numeric(1e-4, 1e-5, why)
        )
    }


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """For each choice: whether every option gives a relation of its own at rest, and how far they are apart."""
    frame = tables["options"].frame
    tried = (
        f"as-defined; R = {', '.join(p.support_ratios)}; sigma/C = {', '.join(p.stress_ratios)}; "
        f"Q = {', '.join(p.velocity_gradients)} c/h; {p.samples} waves; cubic kernel, linear basis"
    )
    found = []
    for choice, options in CHOICES.items():
        own = frame[frame.choice == choice]
        parts, least = [], inf
        for option in options[1:]:
            each = own[own.option == option]
            rest, moving = (float(each[each.Q == Q].away.max()) for Q in ("0", p.velocity_gradients[-1]))
            least = min(least, rest)
            parts.append(f"{option} by {rest:.3g} and {moving:.3g}")
        found.append(
            Statement(
                name=choice,
                about=(),
                says=f"Every other option than {options[0]} moves some frequency at rest. Largest shifts, as shares of the largest "
                f"frequency, at rest and at Q = {p.velocity_gradients[-1]} c/h: {'; '.join(parts)}.",
                holds=bool(least > SAME),
                tried=tried,
                evidence="sampled",
                margin=round(least - SAME, 6),
                margin_means="least of the options' largest shifts at rest, less the share below which relations are one",
                layer="as-defined",
            )
        )
    return found


STUDY = Study(
    title="Readings: what each option does to a wave",
    parameters=Parameters(),
    quick=Parameters(support_ratios=("3/2",), stress_ratios=("1/2",), samples=2),
    compute=compute,
    judge=judge,
)
