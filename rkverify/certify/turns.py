"""Where a verdict turns: every support ratio in ]1, upper] at which omega^2(pi)/sigma of DNI, or Psi,xx(h), changes sign.

At kh = pi a central gradient sees nothing of the wave: what is left of omega^2 is sigma times a function of R alone. On
each piece of R between two places where a node sits on a joint of the kernel it is one rational function, and all of its
real zeros are found exactly.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import sympy

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.enclosed import certain_digits
from rkverify.errors import BadInput
from rkverify.kernels import kernel
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.shape import diffuse_gradient_slope, shape_second
from rkverify.readings import Derivative
from rkverify.stability.limits import alternating, nodal_forces

WIDTH = Fraction(1, 10**20)
"""Isolating intervals are refined to this width; 15 digits of a support ratio are then certain."""

Function = Callable[[Any, Arithmetic, str, Derivative], Any]


def method_at_pi(R: Any, K: Arithmetic, kernel_name: str, derivative: Derivative) -> Any:
    """omega^2(pi)/sigma of the linearised semi-Lagrangian equations with DNI at rest, rho = h = 1."""
    changes = nodal_forces(R, K, (alternating,), "dni", derivative, kernel_name).changes
    return sum((alternating(n) * change[0] for n, change in changes.items()), K.zero())


def printed_at_pi(R: Any, K: Arithmetic, kernel_name: str, derivative: Derivative) -> Any:
    """omega^2(pi)/sigma of (87): -4 Psi,xx(h), in a reading of the derivative; rho = h = 1."""
    A = lattice(1, R, 2, K, kernel_name)
    at = A.point(1)
    second = diffuse_gradient_slope(A, at) if derivative == "diffuse" else shape_second(A, at, (0, 0), derivative)
    I = middle(A)
    return -4 * second[I] if I in second else K.zero()


def pieces(kernel_name: str, upper: Fraction) -> list[tuple[Fraction, Fraction]]:
    """]1, upper] cut at every R = n / joint, where a node enters a support or crosses a joint of the kernel."""
    joints = kernel(kernel_name).joints
    cuts = {n / joint for joint in joints for n in range(1, int(upper) + 1)}
    inside = sorted(cut for cut in cuts if 1 < cut < upper)
    return list(pairwise([Fraction(1), *inside, upper]))


@dataclass(frozen=True)
class Zero:
    """A zero in R, enclosed by two rationals (equal where it is rational itself)."""

    low: Fraction
    high: Fraction

    @property
    def digits(self) -> str:
        """The zero as a decimal of which every digit is certain."""
        return certain_digits(Ball(40).between(self.low, self.high), 15)


@dataclass(frozen=True)
class Signs:
    """The zeros of a function of R in ]1, upper] in order, and its sign (1 or -1) before, between and behind them.

    degree: of the largest polynomial whose zeros were isolated. upper is a zero itself where the last sign is 0.
    """

    zeros: tuple[Zero, ...]
    signs: tuple[int, ...]
    degree: int

    @property
    def turns(self) -> list[tuple[Zero, int, int]]:
        """The zeros at which the sign changes, with the signs before and behind; a touch is none."""
        return [(z, p, q) for z, (p, q) in zip(self.zeros, pairwise(self.signs), strict=True) if p * q < 0]

    @property
    def touches(self) -> list[Zero]:
        """The zeros at which it does not."""
        return [z for z, (p, q) in zip(self.zeros, pairwise(self.signs), strict=True) if p * q >= 0]

    def at(self, R: Fraction) -> int:
        """The sign at a support ratio that is not within an enclosure of a zero."""
        return self.signs[sum(zero.high < R for zero in self.zeros)]


def signs(function: Function, kernel_name: str, derivative: Derivative, upper: Fraction) -> Signs:
    """All zeros and signs of the function on ]1, upper].

    Raises BadInput where the function jumps or has a pole inside, or where the count of zeros by Sturm's sequence
    differs from that of the isolating intervals.
    """
    zeros: list[Zero] = []
    found: list[int] = []
    degree = 0
    for low, high in pieces(kernel_name, upper):
        K = RationalFunctions({"R": (low + high) / 2})
        value = function(K.generator("R"), K, kernel_name, derivative)
        inside, size = _zeros_inside(value, low, high)
        degree = max(degree, size)
        ends = [low, *(z for zero in inside for z in (zero.low, zero.high)), high]
        each = [_sign(value, K, (p + q) / 2) for p, q in zip(ends[::2], ends[1::2], strict=True)]
        if not found:
            found.append(each[0])
        elif _at_joint(function, kernel_name, derivative, low) == 0:
            zeros.append(Zero(low, low))
            found.append(each[0])
        elif found[-1] != each[0]:
            raise BadInput(f"the function of R jumps at {low}: take a kernel of class C2")
        found += each[1:]
        zeros += inside
    if _at_joint(function, kernel_name, derivative, upper) == 0:
        zeros.append(Zero(upper, upper))
        found.append(0)
    return Signs(tuple(zeros), tuple(found), degree)


def _at_joint(function: Function, kernel_name: str, derivative: Derivative, R: Fraction) -> Fraction:
    value: Fraction = function(R, Exact(), kernel_name, derivative)
    return value


def _zeros_inside(value: Any, low: Fraction, high: Fraction) -> tuple[list[Zero], int]:
    """The zeros of a rational function in the open interval, isolated with rational ends, and the numerator's degree."""
    R = sympy.Symbol("R")
    above, below = (sympy.Poly(part.as_expr(), R) for part in (value.numer, value.denom))
    if _open_count(below, low, high):
        raise BadInput(f"the function of R has a pole between {low} and {high}")
    bounds = {"inf": _sympy(low), "sup": _sympy(high), "eps": _sympy(WIDTH)}
    inside = [
        Zero(*(Fraction(int(end.p), int(end.q)) for end in interval))
        for interval, _ in above.intervals(**bounds)
        if not (interval[0] == interval[1] and interval[0] in (_sympy(low), _sympy(high)))
    ]
    if len(inside) != _open_count(above, low, high):
        raise BadInput(f"Sturm's count of the zeros between {low} and {high} is not that of the isolating intervals")
    return inside, int(above.degree())


def _open_count(p: sympy.Poly, low: Fraction, high: Fraction) -> int:
    """How many distinct real zeros the polynomial has in the open interval, by Sturm's sequence."""
    ends = sum(int(p.eval(_sympy(end)) == 0) for end in (low, high))
    return int(p.sqf_part().count_roots(_sympy(low), _sympy(high))) - ends


def _sign(value: Any, K: RationalFunctions, R: Fraction) -> int:
    numer, denom = (part.evaluate([(K.field.ring.gens[0], _sympy_qq(R))]) for part in (value.numer, value.denom))
    quotient = numer / denom
    return int(quotient > 0) - int(quotient < 0)


def _sympy(value: Fraction) -> sympy.Rational:
    return sympy.Rational(value.numerator, value.denominator)


def _sympy_qq(value: Fraction) -> Any:
    return sympy.QQ(value.numerator, value.denominator)
