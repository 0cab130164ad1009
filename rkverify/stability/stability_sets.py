"""Where the formulations are stable: over stress, support and velocity gradient, with critical time steps.

Units h = rho = C = 1 throughout; s is sigma/C^sigma, or S/C^SE for the Lagrangian bar.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import isfinite, nan, pi, sqrt
from typing import Any

import numpy as np

from rkverify.arithmetic.native import rational
from rkverify.readings import CellMeasure, StressLaw
from rkverify.stability.at_rest import AtRest, at_rest
from rkverify.stability.layers import Setting
from rkverify.stability.side_by_side import ANALYTIC, Case
from rkverify.stability.surveys import Roots, growth, roots_over

Row = dict[str, Any]

FORMULATIONS: Mapping[str, Setting] = {
    "Lagrangian SCNI": Setting("lagrangian", "scni", "3/2", layer="as-defined"),
    "Lagrangian DNI": Setting("lagrangian", "dni", "3/2", layer="as-defined"),
    "SCNI": Setting("semi-lagrangian", "scni", "3/2", layer="as-defined"),
    "DNI full": Setting("semi-lagrangian", "dni", "3/2", layer="as-defined"),
    "DNI diffuse": Setting("semi-lagrangian", "dni", "3/2", derivative="diffuse", layer="as-defined"),
    "printed SCNI": Setting("semi-lagrangian", "scni", "3/2"),
    "printed DNI full": Setting("semi-lagrangian", "dni", "3/2"),
    "printed DNI diffuse": Setting("semi-lagrangian", "dni", "3/2", derivative="diffuse"),
}
"""Formulations by name; `as-defined` at rest is `consistent` as well, since N does nothing there."""

PRINT_ENDS = 2
"""The printed stencils (75), (81) are for 1 < R < 2."""

Relations = Mapping[tuple[str, str], AtRest]


def relations(names: Sequence[str], support_ratios: Sequence[str]) -> Relations:
    """(formulation, R) -> its relation at rest, for every R where it is meant to hold."""
    return {
        (name, R): at_rest(replace(FORMULATIONS[name], support_ratio=R))
        for name in names
        for R in support_ratios
        if rational(R) < PRINT_ENDS or not name.startswith("printed")
    }


def stress_rows(found: Relations) -> list[Row]:
    """The interval of s in which omega^2 >= 0 at every kh; an end without a bound is infinite."""
    return [{"formulation": name, "support_ratio": R, **_interval(relation)} for (name, R), relation in found.items()]


def _interval(relation: AtRest) -> Row:
    low, high = relation.stable_stresses()
    return {"stable_from": _rounded(low), "stable_to": _rounded(high)}


def _rounded(value: float) -> float:
    return round(value, 6) + 0.0 if isfinite(value) else value


def step_rows(found: Relations, stresses: Sequence[str]) -> list[Row]:
    """dt_c c/h = 2/(omega_max h/c), and the least omega^2: where it is negative every step grows."""
    rows = []
    for (name, R), relation in found.items():
        for stress in stresses:
            s = float(rational(stress))
            least, most = relation.extremes(s)
            rows.append(
                {
                    "formulation": name,
                    "support_ratio": R,
                    "stress_ratio": stress,
                    "omega_max": round(sqrt(max(most, 0.0)), 9),
                    "critical_step": round(relation.critical_step(s), 9),
                    # A least value of rounding size is the zero at kh = 0 or pi.
                    "least_squared": round(least, 9) + 0.0,
                }
            )
    return rows


def wave_rows(found: Relations, stresses: Sequence[str], samples: int) -> list[Row]:
    """omega^2 at kh = pi (n - 1/2)/samples for every R: the ends, where it may touch zero, are left out."""
    kh = pi * (np.arange(samples) + 0.5) / samples
    return [
        {
            "formulation": name,
            "stress_ratio": stress,
            "support_ratio": R,
            "kh": round(float(theta), 10),
            "omega_squared": round(float(value), 9) + 0.0,
        }
        for (name, R), relation in found.items()
        for stress in stresses
        for theta, value in zip(kh, relation.omega_squared(float(rational(stress)), kh), strict=True)
    ]


def reading_rows(
    names: Sequence[str],
    support_ratios: Sequence[str],
    laws: Sequence[StressLaw],
    measures: Sequence[CellMeasure],
) -> list[Row]:
    """The stable interval at rest for every stress law and cell measure."""
    rows = []
    for name in names:
        for law in laws:
            for measure in measures:
                for R in support_ratios:
                    setting = replace(FORMULATIONS[name], support_ratio=R, stress_law=law, cell_measure=measure)
                    rows.append(
                        {
                            "formulation": name,
                            "stress_law": law,
                            "cell_measure": measure,
                            "support_ratio": R,
                            **_interval(at_rest(setting)),
                        }
                    )
    return rows


def moving_rows(
    cases: Sequence[Case], gradients: Sequence[float], stresses: Sequence[float], samples: int
) -> list[Row]:
    """The largest growth h/c over kh = pi n/samples for every layer, Q h/c (not 0) and s; in print the least D as well."""
    kh = pi * np.arange(1, samples + 1) / samples
    rows = []
    for case in cases:
        for layer in ANALYTIC:
            roots = roots_over(case.setting(layer), kh)
            for Q in gradients:
                for s in stresses:
                    omega = roots(s, Q)
                    # The two roots are apart by sqrt(D).
                    D = float(((omega[:, 0] - omega[:, 1]) ** 2).real.min()) if layer == "printed" else nan
                    largest = round(float(growth(omega).max()), 7) + 0.0
                    rows.append(
                        {
                            "case": case.label,
                            "layer": layer,
                            "Q": Q,
                            "stress_ratio": s,
                            "growth": largest,
                            "discriminant": round(D, 7) + 0.0,
                        }
                    )
    return rows


def motion_rows(
    cases: Sequence[Case], gradients: Sequence[float], stresses: Sequence[float], samples: int
) -> list[Row]:
    """What motion does to the unstable set of every layer, for each Q h/c; growth is the largest over kh = pi n/samples.

    change: the largest |growth(s, Q) - growth(s, 0)| / |Q| over the given s. stable_growth: the largest growth over |Q|
    at any s >= -1. turn: the s below which some growth exceeds TELLS, in print alone: frozen coefficients have a growth
    of order |Q| at every s (nan).
    """
    kh = pi * np.arange(1, samples + 1) / samples
    rows = []
    for case in cases:
        for layer in ANALYTIC:
            if layer == "printed" and rational(case.support_ratio) >= PRINT_ENDS:
                continue
            roots = roots_over(case.setting(layer), kh)

            def largest(s: float, Q: float, roots: Roots = roots) -> float:
                return float(growth(roots(s, Q)).max())

            for Q in gradients:
                at = {s: (largest(s, Q), largest(s, 0.0)) for s in stresses}
                rows.append(
                    {
                        "case": case.label,
                        "layer": layer,
                        "Q": Q,
                        "change": round(max(abs(g - still) for g, still in at.values()) / abs(Q), 5),
                        "stable_growth": round(max(g for s, (g, _) in at.items() if s >= -1) / abs(Q), 5) + 0.0,
                        "turn": round(_turn(largest, Q), 6) if layer == "printed" else nan,
                    }
                )
    return rows


TELLS = 1e-6
"""Growth h/c that is told from zero: the square root of a difference that rounding makes 1e-15 is far below."""


def _turn(largest: Callable[[float, float], float], Q: float) -> float:
    """Bisection of -100 <= s <= 5 for the end of the unstable range below."""
    low, high = -100.0, 5.0
    while high - low > 1e-8:
        middle = (low + high) / 2
        low, high = (middle, high) if largest(middle, Q) > TELLS else (low, middle)
    return high
