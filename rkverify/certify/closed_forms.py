"""The right counterparts of (76), (82), (86), (87) on the uniform lattice with 1 < R < 2, by machine algebra.

The lines of `paper/` are run with rational functions and duals: once with the cubic kernel as functions of R, once
with a kernel of which only the values that occur have names. Unit spacing, density and modulus; s = sigma/C^sigma.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, cast

import sympy

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.kernel_symbols import named_kernel
from rkverify.errors import BadInput
from rkverify.kernels import Kernel
from rkverify.readings import Convection, Derivative, Integration, Readings
from rkverify.stability.jacobian_paper import Stencil, linearise
from rkverify.stability.lattice_state import Base

SAMPLES = {"low": Fraction(13, 10), "high": Fraction(7, 4)}
"""A support ratio on either side of R = 3/2, beyond which a cell edge sees four nodes."""


@dataclass(frozen=True)
class ClosedForm:
    """One coefficient of the linearised equations: which, for which readings and R, and its closed form.

    rate, variable, shift: derivative of the rate at node I with respect to the variable at node I + shift.
    """

    integration: Integration
    derivative: Derivative
    convection: Convection
    side: str
    rate: str
    variable: str
    shift: int
    form: sympy.Expr


def stencil_over_R(readings: Readings, side: str) -> tuple[Stencil, RationalFunctions]:
    """The stencil for the cubic kernel as rational functions of R, s and Q; 1 < R < 3/2 (low) or 3/2 < R < 2 (high)."""
    K = RationalFunctions({"R": SAMPLES[side], "s": "1/7", "Q": "1/3"})
    base = Base(K.generator("R"), readings, K.generator("s"), K.generator("Q"))
    return linearise(base, K).stencil, K


def stencil_over_kernel_values(readings: Readings, side: str) -> tuple[Stencil, RationalFunctions]:
    """The same for any kernel, in phi(0), phi(z) with z = 1/R, phi' = z g, phi'' = c, and for SCNI phi(z/2), phi(3z/2)."""
    z = 1 / SAMPLES[side]
    places = {Fraction(0): "0", z: "1"}
    if readings.integration == "scni":
        places |= {z / 2: "half", **({3 * z / 2: "threehalf"} if side == "high" else {})}
    sample: dict[str, Any] = {"z_1": z, "s": "1/7", "Q": "1/3"}
    for place, label in places.items():
        sample |= {f"p_{label}": 1 - place, f"g_{label}": -1, f"c_{label}": 1}
        if place:
            sample |= {f"z_{label}": place}
    K = RationalFunctions(sample)
    base = Base(
        1 / K.generator("z_1"),
        readings,
        K.generator("s"),
        K.generator("Q"),
        kernel=cast(Kernel, named_kernel(K, places)),
    )
    return linearise(base, K).stencil, K


def geometric_factor(stencil: Stencil, K: RationalFunctions) -> sympy.Expr:
    """G in omega^2 = (1 + s) sin^2 kh + s G (1 - cos kh)^2, the relation of DNI at rest.

    Raises BadInput where the stencil is not of this form: v' must be s G times (-1/4, 1, -3/2, 1, -1/4) in the
    positions, and -+1/2 in the stresses, which follow the positions as +-(1 + s)/2.
    """
    s = K.generator("s")
    position, stress, follows = stencil["v", "x"], stencil["v", "stress"], stencil["stress", "v"]
    G = position.get(1, K.zero()) / s
    fits = (
        all(position.get(n, K.zero()) == G * s * K.ratio(*weight) for n, weight in _PATTERN.items())
        and set(position) <= set(_PATTERN)
        and stress == {-1: K.ratio(-1, 2), 1: K.ratio(1, 2)}
        and follows == {-1: -(1 + s) / 2, 1: (1 + s) / 2}
    )
    if not fits:
        raise BadInput("the stencil is not of the form of the closed form: it holds for DNI at rest with 1 < R < 2")
    return sympy.factor(G.as_expr())


_PATTERN = {-2: (-1, 4), -1: (1, 1), 0: (-3, 2), 1: (1, 1), 2: (-1, 4)}


def closed_forms(readings: Readings, side: str) -> list[ClosedForm]:
    """Every coefficient of the stencil that is not zero, as a function of R (cubic kernel), s and Q; shifts >= 0."""
    stencil, _ = stencil_over_R(readings, side)
    return [
        ClosedForm(
            readings.integration,
            readings.derivative,
            readings.convection,
            side,
            rate,
            variable,
            n,
            sympy.factor(c.as_expr()),
        )
        for (rate, variable), coefficients in stencil.items()
        for n, c in coefficients.items()
        if n >= 0
    ]


def largest_error(
    readings: Readings, side: str, ratios: list[Fraction], s: Fraction, Q: Fraction, digits: int
) -> float:
    """The largest difference of the closed forms from the linearisation at many digits, at the given R."""
    K = Multiprecision(digits)
    stencil, field = stencil_over_R(readings, side)
    worst = K.zero()
    for R in ratios:
        numbers = linearise(Base(R, readings, s, Q), K).stencil
        point = RationalFunctions({"R": R, "s": s, "Q": Q})
        for key, coefficients in numbers.items():
            for n in coefficients.keys() | stencil[key].keys():
                exact = _value(stencil[key][n], field, point) if n in stencil[key] else Fraction(0)
                worst = max(worst, K.absolute(coefficients.get(n, K.zero()) - K.number(exact)))
    return float(worst)


def _value(element: Any, field: RationalFunctions, point: RationalFunctions) -> Fraction:
    moved = RationalFunctions.__new__(RationalFunctions)
    moved.sample, moved.field = point.sample, field.field
    return moved.witness(element)
