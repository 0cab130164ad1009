"""Solutions to the exercises of `von_neumann_in_four_layers`."""

from dataclasses import replace
from fractions import Fraction
from math import pi

from rkverify.arithmetic.native import Exact
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.layers import LAYERS, Setting, dispersion

NOTICED = 1e-3
"""Growth below this, in c/h, is none in a measurement."""


def growth(setting: Setting) -> float:
    """The largest growth over twelve waves."""
    return max(float(branch.omega.growth) for branch in dispersion(setting, [pi * n / 12 for n in range(1, 13)]))


def exercise_1() -> dict[str, dict[str, bool]]:
    """Which layers let a wave grow at R = 7/4: in tension the print alone, in compression all but the print."""
    setting = Setting("semi-lagrangian", "dni", "7/4")
    return {
        stress: {layer: growth(replace(setting, stress_ratio=stress, layer=layer)) > NOTICED for layer in LAYERS}
        for stress in ("1/2", "-1/2")
    }


def exercise_2() -> Fraction:
    """omega^2(pi) = minus the sum of (-1)^n c_n over the stencil of accelerations, as a fraction."""
    setting = Setting("semi-lagrangian", "dni", "3/2", "1/2", layer="as-defined")
    stencil = linearise(setting.base(), Exact()).stencil["v", "x"]
    return -sum((c if n % 2 == 0 else -c for n, c in stencil.items()), Fraction(0))


def exercise_3() -> dict[str, float]:
    """|omega| at kh = pi of the Lagrangian bar with SCNI: zero to rounding's root in every layer."""
    setting = Setting("lagrangian", "scni", "3/2", "1/3", "6/5")
    return {
        layer: max(abs(complex(b.omega.re, b.omega.im)) for b in dispersion(replace(setting, layer=layer), [pi]))
        for layer in LAYERS
    }
