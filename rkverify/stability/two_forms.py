"""The Lagrangian condition C^SE F^2 + S >= 0 and the semi-Lagrangian C^sigma + sigma >= 0, on the same material.

In one dimension P = S F = sigma, the cross-section being constant. So F dP/dF = F (C^SE F^2 + S), and the Truesdell
rate sigma' = (C^sigma + sigma) F'/F makes it C^sigma + sigma: both forms have the same tangent exactly when
C^sigma = F^3 C^SE, the modulus pushed forward. With rho = rho_0/F and a spacing F h_X the frequencies are then the
same as well: omega_L^2 rho_0 h_X^2/C^SE = F^2 omega_S^2 rho h^2/C^sigma.
"""

from collections.abc import Sequence
from math import pi
from typing import Any

import numpy as np

from rkverify.arithmetic.native import rational
from rkverify.stability import simulate
from rkverify.stability.at_rest import at_rest
from rkverify.stability.layers import Layer, Setting

Row = dict[str, Any]
PRINT_ENDS = 2
"""The printed stencil (75) is for 1 < R < 2."""

ROUNDING = 1e-12
"""A least omega^2 above minus this is zero: sums of some tens of products of order 1."""


def same_material_rows(
    layers: Sequence[Layer], support_ratios: Sequence[str], stretches: Sequence[str], stresses: Sequence[str]
) -> list[Row]:
    """Least omega^2 of both forms with SCNI where C^sigma = F^3 C^SE, so that sigma/C^sigma = (S/C^SE)/F^2.

    stresses: sigma/C^sigma. difference: largest |omega_L^2 - F^2 omega_S^2| over kh, over the largest |omega_L^2|, each
    in its own units.
    """
    kh = pi * np.arange(65) / 64
    rows = []
    for layer in layers:
        for R in support_ratios:
            if layer == "printed" and rational(R) >= PRINT_ENDS:
                continue
            semi = at_rest(Setting("semi-lagrangian", "scni", R, layer=layer))
            for stretch in stretches:
                bar = at_rest(Setting("lagrangian", "scni", R, stretch=stretch, layer=layer))
                for stress in stresses:
                    F2, s = float(rational(stretch)) ** 2, float(rational(stress))
                    one, other = bar.omega_squared(s * F2, kh), F2 * semi.omega_squared(s, kh)
                    rows.append(
                        {
                            "layer": layer,
                            "support_ratio": R,
                            "stretch": stretch,
                            "stress_ratio": stress,
                            "lagrangian_least": _or_zero(bar.extremes(s * F2)[0]),
                            "semi_lagrangian_least": _or_zero(semi.extremes(s)[0]),
                            "difference": _or_zero(abs(one - other).max() / max(abs(one).max(), ROUNDING)),
                        }
                    )
    return rows


def constant_moduli_rows(layers: Sequence[Layer], support_ratio: str, stretches: Sequence[str]) -> list[Row]:
    """Both forms loaded from the unstressed state with a modulus that stays constant: C^SE in one, C^sigma in the other.

    S = C^SE (F^2 - 1)/2, and sigma' = (C^sigma + sigma) F'/F gives sigma = C^sigma (F - 1).
    """
    rows = []
    for layer in layers:
        semi = at_rest(Setting("semi-lagrangian", "scni", support_ratio, layer=layer))
        for stretch in stretches:
            F = rational(stretch)
            bar = at_rest(Setting("lagrangian", "scni", support_ratio, stretch=stretch, layer=layer))
            rows.append(
                {
                    "layer": layer,
                    "stretch": stretch,
                    "lagrangian_least": _or_zero(bar.extremes(float((F * F - 1) / 2))[0]),
                    "semi_lagrangian_least": _or_zero(semi.extremes(float(F - 1))[0]),
                }
            )
    return rows


def _or_zero(value: float) -> float:
    return round(float(value), 9) + 0.0 if abs(value) > ROUNDING else 0.0


def measured_rows(places: Sequence[tuple[str, str]], stretch: str) -> list[Row]:
    """Growth measured near kh = pi/2 in both forms on the same material, at (R, sigma/C^sigma); SCNI, Q = 0.

    Growths are omega h/c in the units of the semi-Lagrangian form.
    """
    F2 = rational(stretch) ** 2
    rows = []
    for R, stress in places:
        s = rational(stress)
        semi = Setting("semi-lagrangian", "scni", R, stress_ratio=s, layer="as-defined")
        bar = Setting("lagrangian", "scni", R, stress_ratio=s * F2, stretch=stretch)
        rows.append(_measured("same material", R, stretch, semi, bar, float(s)))
    return rows


def measured_constant_moduli(support_ratio: str, stretch: str) -> list[Row]:
    """The same with moduli that stay constant from the unstressed state."""
    F = rational(stretch)
    semi = Setting("semi-lagrangian", "scni", support_ratio, stress_ratio=F - 1, layer="as-defined")
    bar = Setting("lagrangian", "scni", support_ratio, stress_ratio=(F * F - 1) / 2, stretch=stretch)
    return [_measured("constant moduli", support_ratio, stretch, semi, bar, float(F - 1))]


def _measured(moduli: str, R: str, stretch: str, semi: Setting, bar: Setting, s: float) -> Row:
    one, other = simulate.measure_bar(bar.bar(), pi / 2), simulate.measure(semi.base(), pi / 2)
    F = float(rational(stretch))
    return {
        "moduli": moduli,
        "support_ratio": R,
        "stretch": stretch,
        "stress_ratio": round(s, 9),
        "lagrangian_growth": _seen(one, F),
        "semi_lagrangian_growth": _seen(other, 1.0),
    }


def _seen(found: simulate.Measured, unit: float) -> float:
    """The measured growth, zero where it is below a hundred times its uncertainty."""
    growth = max(root.growth for root in found.roots)
    return round(growth / unit, 6) if growth > 100 * found.uncertainty else 0.0
