"""Frequency and growth over kh, layer beside layer: printed, as-defined, consistent, and measured points at rest."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import Any

import numpy as np

from rkverify.arithmetic.native import rational
from rkverify.readings import Derivative, Integration
from rkverify.stability import simulate
from rkverify.stability.at_rest import at_rest
from rkverify.stability.layers import Layer, Setting
from rkverify.stability.surveys import frequency, growth, roots_over

Row = dict[str, Any]
SEVERAL = 3
"""Frozen growths up to this many |Q| are left open: the base changes as fast as such a wave grows."""

ANALYTIC: tuple[Layer, ...] = ("printed", "as-defined", "consistent")
BOUNDS = (1e-5, 1e-3, 1e-1, 1.0)
"""Round numbers below which the uncertainty of a measurement is said to be; what is found here is some 1e-6 at most."""


@dataclass(frozen=True)
class Case:
    """One formulation: integration, derivative of the shape functions (DNI) and support ratio R."""

    integration: Integration
    support_ratio: str
    derivative: Derivative = "full"

    @property
    def label(self) -> str:
        """The case in words."""
        reading = f" {self.derivative}" if self.integration == "dni" else ""
        return f"{self.integration.upper()}{reading}, R = {self.support_ratio}"

    def setting(self, layer: Layer) -> Setting:
        """The semi-Lagrangian setting in a layer, default readings, h = rho = C^sigma = 1."""
        return Setting("semi-lagrangian", self.integration, self.support_ratio, derivative=self.derivative, layer=layer)


def semi_lagrangian_rows(
    cases: Sequence[Case],
    stress: str,
    gradients: Sequence[str],
    spacing: str,
    samples: int,
    eighths: Sequence[int],
) -> list[Row]:
    """|Re omega| h/c and growth h/c at kh = pi n/samples for every case, analytic layer and Q (1/time, c = 1).

    Measured points at kh = pi n/8, n in `eighths`, at rest. Of the roots at one kh the largest frequency and the
    largest growth are given; h counts through Q h alone.
    """
    kh = pi * np.arange(1, samples + 1) / samples
    s, h = float(rational(stress)), float(rational(spacing))
    rows: list[Row] = []
    for case in cases:
        for layer in ANALYTIC:
            roots = roots_over(case.setting(layer), kh)
            for Q in gradients:
                omega = roots(s, float(rational(Q)) * h)
                rows += [
                    _row(case.label, layer, Q, theta, f, g)
                    for theta, f, g in zip(kh, frequency(omega), growth(omega), strict=True)
                ]
        base = replace(case.setting("as-defined"), stress_ratio=stress).base()
        for n in eighths:
            rows.append(_measured_row(case.label, "0", simulate.measure(base, pi * n / 8), 1.0))
    return rows


def lagrangian_rows(
    integrations: Sequence[Integration],
    support_ratios: Sequence[str],
    stretch: str,
    stress: str,
    samples: int,
    eighths: Sequence[int],
) -> list[Row]:
    """The same for the Lagrangian bar with c^2 = (C^SE F^2 + S)/rho_0: (63), the linearised bar, and measured points.

    There is no convective term, so that `consistent` is the same equation as `as-defined`.
    """
    kh = pi * np.arange(1, samples + 1) / samples
    F, S = float(rational(stretch)), float(rational(stress))
    c = (F * F + S) ** 0.5
    rows: list[Row] = []
    for integration in integrations:
        for R in support_ratios:
            label = f"{integration.upper()}, R = {R}"
            setting = Setting("lagrangian", integration, R, stress, stretch)
            for layer in ANALYTIC[:2] if integration == "scni" else ANALYTIC[1:2]:
                squared = at_rest(replace(setting, layer=layer)).omega_squared(S, kh)
                omega = np.sqrt(squared.astype(complex))[:, None] / c
                rows += [
                    _row(label, layer, "0", theta, f, abs(g))
                    for theta, f, g in zip(kh, frequency(omega), growth(omega), strict=True)
                ]
            rows += [_measured_row(label, "0", simulate.measure_bar(setting.bar(), pi * n / 8), c) for n in eighths]
    return rows


def _row(case: str, layer: str, Q: str, kh: float, frequency: float, growth: float, below: float = 0.0) -> Row:
    return {
        "case": case,
        "layer": layer,
        "Q": Q,
        "kh": round(float(kh), 10),
        "frequency": round(float(frequency), 7) + 0.0,
        "growth": round(float(growth), 7) + 0.0,
        "uncertain_below": below,
    }


def _measured_row(case: str, Q: str, found: simulate.Measured, c: float) -> Row:
    largest = max(abs(root.re) for root in found.roots) / c
    fastest = max(root.growth for root in found.roots) / c
    below = next(bound for bound in BOUNDS if found.uncertainty / c < bound)
    # What the measurement cannot tell from zero is zero.
    seen, grown = (value if value > 10 * below else 0.0 for value in (largest, fastest))
    return _row(case, "simulated", Q, found.kh, seen, grown, below)
