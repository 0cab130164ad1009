"""Gauss points by their definition: roots of the polynomial that is orthogonal to all of lower degree, found in rationals."""

from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import ceil, log2

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput, NotRepresentable

MOST_POINTS = 20
GUARD_BITS = 20


def gauss_points(count: int, power: int, K: Arithmetic) -> list[tuple[Scalar, Scalar]]:
    """Points t and weights, of sum 1, that average f(t) over [0, 1] with the density (power + 1) t^power.

    Exact for polynomials of degree 2 count - 1. Raises BadInput for a count that is not offered; NotRepresentable for
    more than one point in an arithmetic that has no rounding, since the points are irrational.
    """
    if not 1 <= count <= MOST_POINTS:
        raise BadInput(f"{count} Gauss points are not offered: choose 1 to {MOST_POINTS}")
    if count > 1 and K.epsilon == 0:
        raise NotRepresentable(
            f"Gauss points are irrational and arithmetic {K.name!r} does not round: choose float or mp:DIGITS, or another rule"
        )
    bits = ceil(-log2(K.epsilon)) + GUARD_BITS if K.epsilon else 1
    found = _points_and_weights(count, power, bits)
    return [(K.number(t), K.number(w)) for t, w in found]


@cache
def _points_and_weights(count: int, power: int, bits: int) -> tuple[tuple[Fraction, Fraction], ...]:
    roots = _roots(count, power, bits)
    weights = []
    for t in roots:
        # The mean of the polynomial that is 1 at this point and 0 at the others.
        others = [r for r in roots if r != t]
        cardinal = [Fraction(1)]
        for r in others:
            cardinal = _times_linear(cardinal, r, 1 / (t - r))
        weights.append(_mean(cardinal, power))
    return tuple(zip(roots, weights, strict=True))


def _times_linear(p: list[Fraction], root: Fraction, factor: Fraction) -> list[Fraction]:
    """p(t) (t - root) factor, coefficients from the constant on."""
    shifted, kept = [Fraction(0), *p], [*p, Fraction(0)]
    return [factor * (s - root * k) for s, k in zip(shifted, kept, strict=True)]


def _mean(p: list[Fraction], power: int) -> Fraction:
    return sum((c * Fraction(power + 1, power + 1 + k) for k, c in enumerate(p)), Fraction(0))


def _product(p: list[Fraction], q: list[Fraction]) -> list[Fraction]:
    total = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            total[i + j] += a * b
    return total


@cache
def _orthogonal(count: int, power: int) -> tuple[Fraction, ...]:
    """The polynomial t^count + … orthogonal to all of lower degree, by Gram and Schmidt."""
    p = [Fraction(0)] * count + [Fraction(1)]
    for lower in range(count):
        q = list(_orthogonal(lower, power))
        share = _mean(_product(p, q), power) / _mean(_product(q, q), power)
        p = [c - share * (q[k] if k < len(q) else 0) for k, c in enumerate(p)]
    return tuple(p)


def _value(p: tuple[Fraction, ...], t: Fraction) -> Fraction:
    total = Fraction(0)
    for c in reversed(p):
        total = total * t + c
    return total


@cache
def _roots(count: int, power: int, bits: int) -> tuple[Fraction, ...]:
    """The roots, to `bits` binary digits, by halving between those of the polynomial before, which separate them."""
    p, found = _orthogonal(count, power), []
    if count == 1:
        return (-p[0],)
    for low, high in pairwise((Fraction(0), *_roots(count - 1, power, bits), Fraction(1))):
        rising = _value(p, high) > _value(p, low)
        left, right = int(low * 2**bits), int(high * 2**bits) + 1
        while right - left > 1:
            middle = (left + right) // 2
            if (_value(p, Fraction(middle, 2**bits)) > 0) == rising:
                right = middle
            else:
                left = middle
        found.append(Fraction(left + right, 2 ** (bits + 1)))
    return tuple(found)
