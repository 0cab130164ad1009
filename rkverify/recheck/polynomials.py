"""Polynomials with rational coefficients, lowest power first, and what their Bernstein coefficients say of their zeros.

On ]a, b[ a polynomial has at most as many zeros as its Bernstein coefficients have changes of sign, and as many up to
an even number: none or one are therefore decided (Descartes' rule after x = (a + b t)/(1 + t)).
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import comb

Polynomial = list[Fraction]
Surface = list[Polynomial]
"""surface[i][j] belongs to x^i y^j."""


def trimmed(p: Sequence[Fraction]) -> Polynomial:
    """Without zeros at the top; the empty list is 0."""
    q = list(p)
    while q and not q[-1]:
        q.pop()
    return q


def plus(p: Polynomial, q: Polynomial, factor: Fraction | int = 1) -> Polynomial:
    """p + factor q."""
    size = max(len(p), len(q))
    zero = Fraction(0)
    return trimmed([(p[k] if k < len(p) else zero) + factor * (q[k] if k < len(q) else zero) for k in range(size)])


def times(p: Polynomial, q: Polynomial) -> Polynomial:
    """p q."""
    if not p or not q:
        return []
    product = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        if a:
            for j, b in enumerate(q):
                product[i + j] += a * b
    return trimmed(product)


def power(p: Polynomial, exponent: int) -> Polynomial:
    """p to a whole power."""
    total = [Fraction(1)]
    for _ in range(exponent):
        total = times(total, p)
    return total


def derivative(p: Polynomial) -> Polynomial:
    """p'."""
    return [k * a for k, a in enumerate(p)][1:]


def value(p: Sequence[Fraction], x: Fraction) -> Fraction:
    """p(x)."""
    total = Fraction(0)
    for a in reversed(p):
        total = total * x + a
    return total


def sign(x: Fraction) -> int:
    """-1, 0 or 1."""
    return (x > 0) - (x < 0)


def stretched(p: Polynomial, factor: Fraction | int) -> Polynomial:
    """p(factor x)."""
    return trimmed([a * Fraction(factor) ** k for k, a in enumerate(p)])


def reversed_to(p: Polynomial, degree: int) -> Polynomial:
    """x^degree p(1/x)."""
    padded = [*p, *[Fraction(0)] * (degree + 1 - len(p))]
    return trimmed(padded[::-1])


def bernstein(p: Sequence[Fraction], low: Fraction, high: Fraction) -> list[Fraction]:
    """The Bernstein coefficients of p on [low, high]: p = sum_i b_i binom(d, i) t^i (1 - t)^(d - i), x = low + (high - low) t."""
    d = len(p) - 1
    shifted: Polynomial = []
    for a in reversed(p):  # Horner with x = low + (high - low) t
        shifted = plus(times(shifted, [low, high - low]), [a])
    shifted += [Fraction(0)] * (d + 1 - len(shifted))
    scaled = [a / comb(d, k) for k, a in enumerate(shifted)]
    return [sum((comb(i, k) * scaled[k] for k in range(i + 1)), Fraction(0)) for i in range(d + 1)]


def variations(coefficients: Sequence[Fraction]) -> int:
    """How often the sign changes along the coefficients, zeros left out."""
    signs = [sign(a) for a in coefficients if a]
    return sum(p != q for p, q in pairwise(signs))


def surface_bernstein(P: Surface, x: tuple[Fraction, Fraction], y: tuple[Fraction, Fraction]) -> list[list[Fraction]]:
    """The Bernstein coefficients of sum_ij P[i][j] x^i y^j on a rectangle; their range encloses that of P there."""
    width = max(len(row) for row in P)
    rows = [bernstein([*row, *[Fraction(0)] * (width - len(row))], *y) for row in P]
    columns = [bernstein([row[j] for row in rows], *x) for j in range(width)]
    return [[columns[j][i] for j in range(width)] for i in range(len(P))]


def determinant(matrix: list[list[Fraction]]) -> Fraction:
    """By elimination."""
    rows = [list(row) for row in matrix]
    total = Fraction(1)
    for k in range(len(rows)):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k]), None)
        if pivot is None:
            return Fraction(0)
        if pivot != k:
            rows[k], rows[pivot] = rows[pivot], rows[k]
            total = -total
        total *= rows[k][k]
        for i in range(k + 1, len(rows)):
            if rows[i][k]:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return total


def discriminant(p: Sequence[Fraction]) -> Fraction:
    """The resultant of p and p', from Sylvester's matrix: zero exactly where p has a double zero, or loses its degree."""
    d, slope = len(p) - 1, derivative(list(p))
    high, low = list(p)[::-1], slope[::-1]
    size = 2 * d - 1
    rows = []
    for k in range(d - 1):
        rows.append([Fraction(0)] * k + high + [Fraction(0)] * (size - k - len(high)))
    for k in range(d):
        rows.append([Fraction(0)] * k + low + [Fraction(0)] * (size - k - len(low)))
    return determinant(rows)
