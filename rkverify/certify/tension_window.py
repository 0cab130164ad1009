"""The supports at which DNI at rest is stable in every tension, and the greatest stable tension beyond: to many digits.

omega^2 = (1 - c)[(1 + s) S(c) + s G(c)] with c = cos kh: stable at every tension s > 0 where S + G >= 0 for all c, and up
to the least -S/(S + G) over the c where S + G < 0. Least values lie at the ends or where a derivative vanishes.
"""

from collections.abc import Sequence
from fractions import Fraction

import sympy

from rkverify.certify.stress_range import polynomials
from rkverify.errors import BadInput
from rkverify.readings import Derivative

DIGITS = 30
c = sympy.Symbol("c")


def _both(R: Fraction, kernel: str, derivative: Derivative) -> tuple[sympy.Poly, sympy.Poly]:
    S, G = polynomials(R, derivative, kernel)
    material, geometric = (
        sympy.Poly([sympy.Rational(q.numerator, q.denominator) for q in reversed(part)] or [0], c) for part in (S, G)
    )
    return material, material + geometric


def _places(numerator: sympy.Poly) -> list[sympy.Expr]:
    """-1, 1 and the real zeros between them, to DIGITS digits; exact zeros of an exact polynomial, each isolated."""
    inside = (
        []
        if numerator.degree() < 1
        else [r for r in numerator.nroots(n=DIGITS, maxsteps=200) if abs(sympy.im(r)) < 1e-20]
    )
    return [sympy.Integer(-1), sympy.Integer(1), *(sympy.re(r) for r in inside if -1 < sympy.re(r) < 1)]


def least(R: Fraction, kernel: str = "cubic", derivative: Derivative = "full") -> tuple[sympy.Expr, sympy.Expr]:
    """The least S + G over c, and the c: not negative where every tension is stable."""
    _, total = _both(R, kernel, derivative)
    return min(((total.eval(place), place) for place in _places(total.diff(c))), key=lambda pair: pair[0])


def window_end(
    low: Fraction, high: Fraction, kernel: str = "cubic", derivative: Derivative = "full", bits: int = 40
) -> tuple[Fraction, float]:
    """The R at which some wave first grows at a high enough tension, and its kh; stable at `low`, not at `high`.

    By bisection, each sign that of a number known to 30 digits. Raises BadInput where the ends are on one side.
    """
    if least(low, kernel, derivative)[0] < 0 or least(high, kernel, derivative)[0] >= 0:
        raise BadInput(f"every tension is stable at both of R = {low} and {high}, or at neither: give other ends")
    for _ in range(bits):
        middle = (low + high) / 2
        if least(middle, kernel, derivative)[0] < 0:
            high = middle
        else:
            low = middle
    return low, float(sympy.acos(least(high, kernel, derivative)[1]))


def greatest_tension(R: Fraction, kernel: str = "cubic", derivative: Derivative = "full") -> sympy.Expr | None:
    """The greatest s = sigma/C^sigma at which no wave grows in tension, None where there is none such, to 25 digits."""
    material, total = _both(R, kernel, derivative)
    stationary = material.diff(c) * total - material * total.diff(c)
    limits = [-material.eval(place) / total.eval(place) for place in _places(stationary) if total.eval(place) < 0]
    return min(limits, default=None)


def window_rows(kernels: Sequence[str], tenths: range, tensions_at: Sequence[str]) -> list[dict[str, str]]:
    """For every kernel the R, in the given tenths, at which the stable window ends, its kh, and greatest tensions beyond.

    The window is the first stretch of R in which every tension is stable.
    """
    rows = []
    for kernel in kernels:
        ratios = [Fraction(n, 10) for n in tenths]
        stable = [least(R, kernel)[0] >= 0 for R in ratios]
        first = stable.index(True)
        beyond = first + stable[first:].index(False)
        R, kh = window_end(ratios[beyond - 1], ratios[beyond], kernel)
        row = {"kernel": kernel, "window_end": _decimal(R), "kh": f"{kh:.6f}"}
        for ratio in tensions_at:
            limit = greatest_tension(Fraction(ratio), kernel)
            row[f"greatest_at_{ratio.replace('/', '_')}"] = "none" if limit is None else str(sympy.N(limit, 12))
        rows.append(row)
    return rows


def _decimal(R: Fraction) -> str:
    return str(sympy.N(sympy.Rational(R.numerator, R.denominator), 12))
