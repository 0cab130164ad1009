"""Growth of SPH with strain smoothing and the convective term, singly and together; measured; and with a Lagrangian kernel."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np

from rkverify.arithmetic.native import Float
from rkverify.certify.sph_comparison import NOTHING, RK, significant, wave_numbers
from rkverify.certify.sph_comparison import RELATIONS as SPATIAL
from rkverify.readings import CONVECTIONS, Convection, Derivative
from rkverify.solid.sph import SphForm
from rkverify.stability import lagrangian
from rkverify.stability.layers import Layer, Setting, dispersion
from rkverify.stability.sph import FORMS, SphBase, bar_omega_squared, growth, lagrangian_bar, omega_squared
from rkverify.stability.sph_simulate import Packet, measure, measure_lagrangian, packet_gain
from rkverify.stability.symbol import transform

Row = dict[str, Any]

PAIRINGS = {
    "antisymmetric": SphForm("continuity"),
    "galerkin": SphForm("continuity", "galerkin", "neighbour"),
}
SMOOTHINGS: dict[str, dict[str, Any]] = {
    "none": {},
    "strain": {"strain": "smoothed"},
    "strain and force": {"gradient": "smoothed"},
    "strain and force over cells": {"gradient": "smoothed", "volume": "cell"},
}
"""What may be smoothed: the strain alone, the force as well, and with the cell's length in place of m/rho."""


def smoothed(pairing: str, smoothing: str, convection: Convection) -> SphForm:
    """The form with an addition."""
    return replace(PAIRINGS[pairing], **SMOOTHINGS[smoothing], convection=convection)


def rate(value: float) -> float:
    """A growth to six digits; zero where its square is rounding."""
    return 0.0 if abs(value) < NOTHING**0.5 else significant(value, 6)


def improvements(ratios: Sequence[str], stresses: Sequence[str], gradients: Sequence[str], samples: int) -> list[Row]:
    """The largest growth over kh with every addition; frozen coefficients where Q is not 0."""
    kh = wave_numbers(samples)
    return [
        {
            "pairing": pairing,
            "smoothing": smoothing,
            "convection": convection,
            "support_ratio": R,
            "stress_ratio": s,
            "Q": Q,
            "growth": rate(float(growth(SphBase(smoothed(pairing, smoothing, convection), R, s, Q), kh).max())),
        }
        for pairing, smoothing, convection, R, s, Q in product(
            PAIRINGS, SMOOTHINGS, CONVECTIONS, ratios, stresses, gradients
        )
    ]


def printed_growths(
    ratios: Sequence[str], stresses: Sequence[str], gradients: Sequence[str], samples: int
) -> list[Row]:
    """The largest growth over kh of the printed relations: (82), (87) with DNI, (76), (86) with SCNI."""
    printed: dict[str, Setting] = {
        "(82)": Setting("semi-lagrangian", "dni", 2),
        "(87)": Setting("semi-lagrangian", "dni", 2, convective=False),
        "(76)": Setting("semi-lagrangian", "scni", 2),
        "(86)": Setting("semi-lagrangian", "scni", 2, convective=False),
    }
    kh = [float(t) for t in wave_numbers(samples)]
    rows = []
    for (number, setting), R, s, Q in product(printed.items(), ratios, stresses, gradients):
        branches = dispersion(replace(setting, support_ratio=R, stress_ratio=s, velocity_gradient=Q), kh)
        largest = max(float(branch.omega.growth) for branch in branches)
        rows.append({"relation": number, "support_ratio": R, "stress_ratio": s, "Q": Q, "growth": rate(largest)})
    return rows


def measured(ratios: Sequence[str], stresses: Sequence[str], kh: float) -> list[Row]:
    """Growth and frequency in nonlinear computations beside the linearised ones: SPH, SPH with a Lagrangian kernel, RK."""
    rows = []
    for R, s in product(ratios, stresses):
        for name, form in FORMS.items():
            base = SphBase(form, R, s)
            found = measure(base, kh)
            squared = float(omega_squared(base, np.array([found.kh]))[0])
            rows.append(_measured_row(f"SPH, {name}", R, s, found.kh, found.roots, squared))
        base = SphBase(FORMS["symmetric, continuity density"], R, s)
        found = measure_lagrangian(base, kh)
        squared = float(bar_omega_squared(lagrangian_bar(base, 2 * base.reach + 2), np.array([found.kh]))[0])
        rows.append(_measured_row("SPH, Lagrangian kernel", R, s, found.kh, found.roots, squared))
        for name, derivative in RK.items():
            branches = dispersion(_rk(R, s, derivative, "simulated"), [kh])
            at = float(branches[0].kh)
            squared = float(SPATIAL[name]("cubic", R, s, np.array([at]))[0])
            rows.append(_measured_row(name, R, s, at, [b.omega for b in branches], squared))
    return rows


def _rk(R: str, s: str, derivative: Derivative, layer: Layer) -> Setting:
    return Setting("semi-lagrangian", "dni", R, stress_ratio=s, derivative=derivative, convective=False, layer=layer)


def _measured_row(name: str, R: str, s: str, kh: float, roots: Sequence[Any], squared: float) -> Row:
    """Growth where omega^2 < 0, frequency elsewhere: the number that the linearisation gives, and its measured fellow."""
    grows = squared < 0
    value = max(float(r.growth) if grows else abs(float(r.re)) for r in roots)
    linear = abs(squared) ** 0.5
    return {
        "equations": name,
        "support_ratio": R,
        "stress_ratio": s,
        "kh": kh,
        "quantity": "growth" if grows else "frequency",
        "linearised": significant(linear, 6),
        "measured": rate(value),
        "agrees": abs(value - linear) <= 1e-3 * linear,
    }


def packets(ratios: Sequence[str], stress: str, gradients: Sequence[str], packet: Packet) -> list[Row]:
    """log of the growth of a packet of kh = pi in nonlinear computations on a moving chain, with every addition."""
    tried = [("antisymmetric", "none"), ("galerkin", "none"), ("galerkin", "strain and force over cells")]
    return [
        {
            "pairing": pairing,
            "smoothing": smoothing,
            "convection": convection,
            "support_ratio": R,
            "stress_ratio": stress,
            "Q": Q,
            "gain": significant(
                packet_gain(SphBase(smoothed(pairing, smoothing, convection), R, stress, Q), packet), 6
            ),
        }
        for (pairing, smoothing), convection, R, Q in product(tried, CONVECTIONS, ratios, gradients)
    ]


def lagrangian_kernel(ratios: Sequence[str], stresses: Sequence[str], samples: int) -> list[Row]:
    """The least omega^2 over kh with the kernel in material and in spatial coordinates, F = 1, S = sigma."""
    kh, K = wave_numbers(samples), Float()
    rows = []
    for R, s in product(ratios, stresses):
        for name in ("symmetric, continuity density", "corrected gradient"):
            base = SphBase(FORMS[name], R, s)
            material = bar_omega_squared(lagrangian_bar(base, 2 * base.reach + 2), kh)
            rows.append(_kernel_row(f"SPH, {name}", R, s, material, omega_squared(base, kh)))
        for label, derivative in RK.items():
            whole = lagrangian.stencil(lagrangian.StretchedBar(R, "dni", s, derivative=derivative), K)
            material = np.array([-transform(whole, float(t), K).re for t in kh])
            rows.append(_kernel_row(label, R, s, material, SPATIAL[label]("cubic", R, s, kh)))
    return rows


def _kernel_row(name: str, R: str, s: str, material: Any, spatial: Any) -> Row:
    return {
        "equations": name,
        "support_ratio": R,
        "stress_ratio": s,
        "tangent": 1 + float(Fraction(s)),
        "least_material": significant(float(material.min())),
        "least_spatial": significant(float(spatial.min())),
    }
