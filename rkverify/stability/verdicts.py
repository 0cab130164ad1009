"""Who is stable where: the largest growth over kh for many settings, layer by layer, and the same measured."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import pi
from typing import Any

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, rational
from rkverify.stability.lagrangian import StretchedBar, stencil
from rkverify.stability.layers import Branch, Setting, dispersion
from rkverify.stability.side_by_side import SEVERAL

Row = dict[str, Any]

ROUNDING = 1e-6
"""Growth below this, in c/h, is none: at a double root eigenvalues are known to the square root of rounding, 1e-8."""

NOTICED = 1e-3
"""Measured growth below this, in c/h, is none."""


def waves(samples: int) -> list[float]:
    """kh = pi/samples, …, pi."""
    return [pi * n / samples for n in range(1, samples + 1)]


def described(setting: Setting) -> Row:
    """The part of a setting that tells it from others, as columns."""
    return {
        "formulation": setting.formulation,
        "integration": setting.integration,
        "derivative": setting.derivative,
        "layer": setting.layer,
        "convective": setting.convective,
        "support_ratio": str(setting.support_ratio),
        "stress_ratio": str(setting.stress_ratio),
        "stretch": str(setting.stretch),
        "Q": str(setting.velocity_gradient),
        "spacing": str(setting.spacing),
        "V": str(setting.frame_velocity),
    }


def largest_growth(setting: Setting, samples: int) -> Row:
    """The largest growth h/c over kh and where; how far from real the moving roots are; unstable: growth beyond 3 |Q|.

    A base in motion changes as fast as waves with less growth do, so that frozen coefficients decide nothing there.
    """
    h, Q = float(rational(setting.spacing)), abs(float(rational(setting.velocity_gradient)))
    branches = dispersion(setting, waves(samples))
    count, Q0 = len(branches) // samples, float(rational(setting.velocity_gradient))
    fastest = _fastest(branches, ROUNDING / h)
    growth = max(float(b.omega.growth) for b in branches) * h
    imaginary = max(_imaginary(branches[j : j + count], Q0) for j in range(0, len(branches), count)) * h
    return {
        **described(setting),
        "growth": growth if growth > ROUNDING else 0.0,
        "kh": float(fastest.kh) if growth > ROUNDING else 0.0,
        "imaginary": imaginary if imaginary > ROUNDING else 0.0,
        "unstable": growth > SEVERAL * Q * h + ROUNDING,
    }


def _fastest(branches: Sequence[Branch], within: float) -> Branch:
    """The branch of the largest growth; of those that come within a tolerance of it the first, whatever rounding says."""
    largest = max(b.omega.growth for b in branches)
    return next(b for b in branches if b.omega.growth >= largest - within)


def _imaginary(roots: Sequence[Branch], Q: float) -> float:
    """The largest |Im omega| of the two roots that move: a third one, omega = -i Q, is the stress carried along."""
    distance = sorted(roots, key=lambda b: -abs(complex(b.omega.re, b.omega.im) + 1j * Q))
    return max(abs(float(b.omega.im)) for b in distance[:2])


def growth_rows(settings: Iterable[Setting], samples: int) -> list[Row]:
    """`largest_growth` for every setting."""
    return [largest_growth(setting, samples) for setting in settings]


def measured_growth(setting: Setting, kh: Sequence[float]) -> Row:
    """The largest growth h/c measured over some waves, as a row of `largest_growth`."""
    branches = dispersion(replace(setting, layer="simulated"), kh)
    h = float(rational(setting.spacing))
    fastest = _fastest(branches, NOTICED / h)
    growth = max(float(b.omega.growth) for b in branches) * h
    seen = growth > NOTICED
    return {
        **described(replace(setting, layer="simulated")),
        "growth": growth if seen else 0.0,
        "kh": float(fastest.kh) if seen else 0.0,
        "imaginary": growth if seen else 0.0,
        "unstable": seen,
    }


def late_frequency(support_ratio: str, samples: int) -> Row:
    """The measured omega h/c of the Lagrangian bar with SCNI near kh = 0.9 pi, and the largest computed one."""
    setting = Setting("lagrangian", "scni", support_ratio, layer="as-defined")
    peak = max(abs(float(b.omega.re)) for b in dispersion(setting, waves(samples)))
    late = dispersion(replace(setting, layer="simulated"), [0.9 * pi])
    measured = max(abs(float(b.omega.re)) for b in late)
    return {"support_ratio": support_ratio, "peak": peak, "kh": float(late[0].kh), "measured": measured}


def measured_row(setting: Setting, kh: float) -> Row:
    """A measured wave beside its eigenvalue and the printed root: growth of the unstable ones, frequency of the others.

    The eigenvalue comes from the transcription by duals, the measurement from the vectorised equations. printed is empty
    where the paper prints no relation; factor is printed over computed, empty where that is zero.
    """
    simulated = dispersion(replace(setting, layer="simulated"), [kh])
    at = float(simulated[0].kh)
    growth = max(float(b.omega.growth) for b in simulated)
    unstable = growth > NOTICED
    value = growth if unstable else max(abs(float(b.omega.re)) for b in simulated)
    computed = _of_kind(replace(setting, layer="as-defined"), at, unstable, Multiprecision(20))
    printed = None
    if not (setting.formulation == "lagrangian" and setting.integration == "dni"):
        printed = _of_kind(replace(setting, layer="printed"), at, unstable)
    return {
        **{k: v for k, v in described(setting).items() if k not in ("layer", "convective", "Q", "spacing", "V")},
        "kernel": str(setting.kernel),
        "kh": at,
        "quantity": "growth" if unstable else "frequency",
        "measured": value,
        "computed": computed,
        "printed": printed,
        "factor": None if printed is None or computed == 0 else printed / computed,
        "agrees": abs(value - computed) <= 1e-3 * abs(computed),
    }


def _of_kind(setting: Setting, kh: float, unstable: bool, K: Arithmetic | None = None) -> float:
    branches = dispersion(setting, [kh], K)
    found = max(float(b.omega.growth) if unstable else abs(float(b.omega.re)) for b in branches)
    return found if found > ROUNDING else 0.0


def cutoff_force(support_ratio: str) -> bool:
    """Whether the Lagrangian bar with SCNI has no force at all at kh = pi: sum_n (-1)^n c_n = 0 in exact rationals."""
    K = Exact()
    coefficients = stencil(StretchedBar(support_ratio, "scni", "1/3", "6/5"), K)
    return bool(sum((c if n % 2 == 0 else -c for n, c in coefficients.items()), K.zero()) == 0)
