"""The right counterparts of (75), (81) on the uniform lattice with 1 < R < 2, by machine algebra.

The lines of `paper/` are run with rational functions and duals: once with the cubic kernel as functions of R, once
with a kernel of which only the values that occur have names. Unit spacing, density and modulus; s = sigma/C^sigma.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, cast

import numpy as np
import sympy

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.kernel_forms import kernel_by_values, sample_of_kernel
from rkverify.errors import BadInput
from rkverify.kernels import Kernel
from rkverify.readings import Convection, Readings
from rkverify.stability.jacobian_paper import Stencil, linearise
from rkverify.stability.lattice_state import Base

SAMPLES = {"low": Fraction(13, 10), "high": Fraction(7, 4)}
"""A support ratio on either side of R = 3/2, beyond which a cell edge sees four nodes."""

RANGES = {"low": (Fraction(1), Fraction(3, 2)), "high": (Fraction(3, 2), Fraction(2))}


def stencil_over_R(readings: Readings, side: str) -> tuple[Stencil, RationalFunctions]:
    """The stencil for the cubic kernel as rational functions of R, s and Q; 1 < R < 3/2 (low) or 3/2 < R < 2 (high)."""
    K = RationalFunctions({"R": SAMPLES[side], "s": "1/7", "Q": "1/3"})
    base = Base(K.generator("R"), readings, K.generator("s"), K.generator("Q"))
    return linearise(base, K).stencil, K


def stencil_over_kernel_values(readings: Readings, side: str) -> tuple[Stencil, RationalFunctions]:
    """The same for any kernel, in phi(0), phi(z) with z = 1/R, phi' = z g, phi'' = c, and for SCNI phi(z/2), phi(3z/2)."""
    labels = ["0", "1"]
    if readings.integration == "scni":
        labels += ["half", "threehalf"] if side == "high" else ["half"]
    # Smoothed gradients are differences of Psi: without N no phi'' enters, and fewer names make shorter work.
    curvature = readings.integration == "dni" or readings.convection != "none"
    sample: dict[str, Any] = {"z_1": 1 / SAMPLES[side], "s": "1/7", "Q": "1/3"}
    K = RationalFunctions(sample | sample_of_kernel(labels, curvature))
    R, s, Q = 1 / K.generator("z_1"), K.generator("s"), K.generator("Q")
    base = Base(R, readings, s, Q, kernel=cast(Kernel, kernel_by_values(K, labels)))
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

Make = Callable[[Readings, str], tuple[Stencil, RationalFunctions]]


def convective_part(
    convection: Convection, side: str, make: Make = stencil_over_R
) -> tuple[Stencil, RationalFunctions]:
    """What N adds to v': the stencil with N less the one without; taken with the shortest readings.

    N is built from Psi and Psi* alone, so that integration and derivative do not enter; `largest_error` confirms it.
    """
    with_term, K = make(Readings("dni", convection, "diffuse"), side)
    without, _ = make(Readings("dni", "none", "diffuse"), side)
    added = {("v", variable): _less(with_term["v", variable], without["v", variable], K) for variable in ("x", "v")}
    return added, K


def _less(one: dict[int, Any], other: dict[int, Any], K: RationalFunctions) -> dict[int, Any]:
    gaps: dict[int, Any] = {n: K.zero() for n in sorted({*one, *other})}
    for n, c in one.items():
        gaps[n] = gaps[n] + c
    for n, c in other.items():
        gaps[n] = gaps[n] - c
    return {n: gap for n, gap in gaps.items() if not K.is_zero(gap)}


def together(stress: Stencil, convective: Stencil, K: RationalFunctions) -> Stencil:
    """The stencil with the stress part and the convective part added up."""
    added = {key: _less(values, {}, K) for key, values in stress.items()}
    for key, values in convective.items():
        added[key] = _less(added[key], {n: -c for n, c in values.items()}, K)
    return added


def random_ratios(side: str, count: int, seed: int) -> list[Fraction]:
    """Support ratios with the denominator 10^9 + 7, drawn evenly from the inside of a side's range."""
    low, high = RANGES[side]
    whole = 10**9 + 7
    first, last = int(low * whole) + 1, int(high * whole)
    return [Fraction(int(n), whole) for n in np.random.default_rng(seed).integers(first, last, size=count)]


def largest_error(
    readings: Readings,
    side: str,
    ratios: Sequence[Fraction],
    s: Fraction,
    Q: Fraction,
    digits: int,
    forms: Stencil | None = None,
) -> float:
    """The largest difference of the closed forms from the linearisation at many digits, at the given R.

    forms: those to be checked, over R; by default those of these readings on this side.
    """
    K = Multiprecision(digits)
    at = values_over_R(stencil_over_R(readings, side)[0] if forms is None else forms, s, Q)
    worst = K.zero()
    for R in ratios:
        exact = at(R)
        for key, numbers in linearise(Base(R, readings, s, Q), K).stencil.items():
            known = exact[key]
            for n in numbers.keys() | known.keys():
                gap = numbers.get(n, K.zero()) - K.number(known.get(n, Fraction(0)))
                worst = max(worst, K.absolute(gap))
    return float(worst)


def values_over_R(stencil: Stencil, s: Fraction, Q: Fraction) -> Callable[[Fraction], Stencil]:
    """R -> the stencil's coefficients at these s and Q, exactly."""
    each = {key: {n: _ratio_over_R(c, s, Q) for n, c in values.items()} for key, values in stencil.items()}
    return lambda R: {key: {n: at(R) for n, at in values.items()} for key, values in each.items()}


def _ratio_over_R(element: Any, s: Fraction, Q: Fraction) -> Callable[[Fraction], Fraction]:
    """R -> the value of an element of the field at these s and Q, exactly."""
    above, below = (_polynomial_in_R(part, s, Q) for part in (element.numer, element.denom))
    return lambda R: _horner(above, R) / _horner(below, R)


def _polynomial_in_R(part: Any, s: Fraction, Q: Fraction) -> list[Fraction]:
    """Coefficients of the powers of R, the highest first."""
    powers: dict[int, Fraction] = {}
    for (i, j, k), c in part.terms():
        powers[i] = powers.get(i, Fraction(0)) + Fraction(int(c.numerator), int(c.denominator)) * s**j * Q**k
    return [powers.get(i, Fraction(0)) for i in range(max(powers, default=0), -1, -1)]


def _horner(coefficients: list[Fraction], R: Fraction) -> Fraction:
    total = Fraction(0)
    for c in coefficients:
        total = total * R + c
    return total
