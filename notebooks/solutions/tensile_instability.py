"""Solutions to the exercises of `tensile_instability`."""

from fractions import Fraction
from math import pi
from typing import Any

from rkverify.arithmetic.native import Exact
from rkverify.certify import turns
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.layers import Setting
from rkverify.stability.verdicts import measured_row


def exercise_1() -> list[str]:
    """The support ratios up to 3 at which the sign turns with the quintic kernel."""
    found = turns.signs(turns.method_at_pi, "quintic", "full", Fraction(3))
    return [zero.digits for zero, _, _ in found.turns]


def exercise_2() -> dict[str, Any]:
    """R = 8/5 in tension at kh = pi: print says zero frequency and growth, the computation shows a wave that does not grow."""
    return measured_row(Setting("semi-lagrangian", "dni", "8/5", "1/2", layer="as-defined"), pi)


def exercise_3() -> dict[str, Fraction]:
    """omega^2(pi) of SCNI from the exact stencil, for three stresses: zero, so that the stress does not matter."""
    found = {}
    for stress in ("-1/2", "0", "1/2"):
        setting = Setting("semi-lagrangian", "scni", "7/4", stress, layer="as-defined")
        stencil = linearise(setting.base(), Exact()).stencil["v", "x"]
        found[stress] = -sum((c if n % 2 == 0 else -c for n, c in stencil.items()), Fraction(0))
    return found
