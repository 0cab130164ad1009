"""Worst cases as rows of tables: errors beside bounds, what each quantity's bound is worth, and what is refused."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from rkverify.certify.worst.case import KINDS, WorstCase
from rkverify.certify.worst.file import read_cases
from rkverify.certify.worst.measures import Measured
from rkverify.certify.worst.measuring import measured
from rkverify.certify.worst.moments import answers, dependent, pivot_case, pivots
from rkverify.certify.worst.shape_rounding import systems
from rkverify.certify.worst.window_rounding import window

Row = dict[str, Any]
NEAR = 1e-3
"""A bound that no case of its quantity comes nearer to is too loose."""


def verdict(found: Measured, nearest: float) -> str:
    """within, exceeded, no bound; too loose where no case of the quantity comes near."""
    if found.exceeded:
        return "exceeded"
    if not np.isfinite(found.bound):
        return "no bound"
    return "within" if nearest >= NEAR else "too loose"


def of_quantities(quantities: Sequence[str]) -> list[WorstCase]:
    """The committed cases of these quantities."""
    return [case for case in read_cases() if case.quantity in quantities]


def tabulated(quantities: Sequence[str] = tuple(KINDS)) -> list[Row]:
    """Every committed case of the quantities, measured."""
    found = [(case, measured(case)) for case in of_quantities(quantities)]
    nearest = {q: max((m.ratio for c, m in found if c.quantity == q and np.isfinite(m.bound)), default=0.0) for q in quantities}  # fmt: skip
    return [
        {
            "case": case.name,
            "quantity": case.quantity,
            "dimension": case.dimension,
            "order": "-" if case.order is None else str(case.order),
            "nodes": len(case.nodes),
            "condition": m.condition,
            "size": m.size,
            "found": case.error,
            "error": m.error,
            "bound": m.bound,
            "ratio": m.ratio,
            "share": m.share,
            "verdict": verdict(m, nearest[case.quantity]),
        }
        for case, m in found
    ]


def kind_rows(rows: Sequence[Row]) -> list[Row]:
    """For each quantity the case that comes nearest to its bound."""
    found = []
    for quantity in dict.fromkeys(row["quantity"] for row in rows):
        own = [row for row in rows if row["quantity"] == quantity]
        bounded = [row for row in own if np.isfinite(row["bound"])]
        verdicts = {row["verdict"] for row in own}
        found.append(
            {
                "quantity": quantity,
                "words": KINDS[quantity].words,
                "unit": KINDS[quantity].unit,
                "cases": len(own),
                "nearest": max((row["ratio"] for row in bounded), default=0.0),
                "condition": max((row["condition"] for row in bounded), default=0.0),
                "verdict": next((v for v in ("exceeded", "too loose") if v in verdicts), "within"),
            }
        )
    return found


def refusal_rows(quantities: Sequence[str] = tuple(KINDS)) -> list[Row]:
    """Cases with a singular moment matrix, and those that were searched for just before the refusal."""
    found = []
    for case in of_quantities(quantities):
        limit = "aim='condition'" in case.found_by
        if case.quantity != "pivot" and not limit:
            continue
        condition = systems_condition(case) if limit else pivot_case(case).condition
        found.append(
            {
                "case": case.name,
                "singular": "no" if dependent(case) is None else "yes",
                "condition": condition,
                "margin": pivots(case).margin,
                "answers": "yes" if answers(case) else "no",
            }
        )
    return found


def systems_condition(case: WorstCase) -> float:
    """The condition number of the moment matrix at the point, with its diagonal scaled to 1."""
    made, x = case.cloud(), case.array("point")
    return systems(made, case.literal(), window(made, x), x).condition
