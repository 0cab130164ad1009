"""Boxes by bisection: intervals on which a polynomial has no zero or one, rectangles on which it is positive (python-flint)."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import flint

from rkverify.errors import BadInput

DIGITS = 30
"""Enclosures of zeros are narrower than 10^-DIGITS."""
WIDTH = Fraction(1, 10 ** (DIGITS + 2))
Box = tuple[Fraction, Fraction, int]
Zero = tuple[Fraction, Fraction]
Region = tuple[Zero, Zero]


class NotProved(BadInput):
    """A statement that the prover finds false, or cannot decide."""


def rational(x: Fraction | int) -> Any:
    """As an fmpq."""
    exact = Fraction(x)
    return flint.fmpq(exact.numerator, exact.denominator)


def fraction(x: Any) -> Fraction:
    """From an fmpq or an fmpz."""
    q = flint.fmpq(x)
    return Fraction(int(q.p), int(q.q))


def polynomial(coefficients: Sequence[Any]) -> Any:
    """An fmpq_poly from coefficients, the lowest power first."""
    return flint.fmpq_poly([rational(c) if isinstance(c, int | Fraction) else c for c in coefficients])


def sign(p: Any, x: Fraction) -> int:
    """The sign of p(x)."""
    value = p(rational(x))
    return int(value > 0) - int(value < 0)


def changes(p: Any, low: Fraction, high: Fraction) -> int:
    """Changes of sign of (1 + t)^d p((low + high t)/(1 + t)): Descartes' bound for the zeros of p in the open interval."""
    shifted = p(flint.fmpq_poly([rational(low), rational(high - low)]))
    coefficients = [shifted[k] for k in range(p.degree(), -1, -1)]
    bound = flint.fmpq_poly(coefficients)(flint.fmpq_poly([1, 1]))
    signs = [c > 0 for c in bound.coeffs() if c != 0]
    return sum(s != t for s, t in pairwise(signs))


def boxes(p: Any, low: Fraction, high: Fraction) -> list[Box]:
    """Intervals side by side with no zero or one of p in each; p must have no double zero inside.

    Raises NotProved where bisection does not end.
    """
    waiting, found = [(low, high)], []
    while waiting:
        a, b = waiting.pop()
        count = changes(p, a, b)
        if count <= 1:
            found.append((a, b, count))
            continue
        if b - a < WIDTH or len(waiting) > 200:
            raise NotProved(f"a zero between {float(a)} and {float(b)} is not alone: take the squarefree part")
        middle = next(m for k in range(2, 99) if sign(p, m := a + (b - a) / k) != 0)
        waiting += [(middle, b), (a, middle)]
    return found


def narrow(p: Any, low: Fraction, high: Fraction) -> Zero:
    """The one zero in the open interval: exact where it is rational, otherwise enclosed to WIDTH with opposite signs."""
    for factor, _ in p.numer().factor()[1]:
        if factor.degree() == 1:
            root = fraction(flint.fmpq(-factor[0], factor[1]))
            if low < root < high:
                return root, root
    low, high = _inside(p, low, high)
    left = sign(p, low)
    while high - low > WIDTH:
        middle = (low + high) / 2
        low, high = (middle, high) if sign(p, middle) == left else (low, middle)
    return low, high


def _inside(p: Any, low: Fraction, high: Fraction) -> Zero:
    """The interval moved off zeros at its ends."""
    step = (high - low) / 2
    while sign(p, low) == 0 or sign(p, high) == 0 or sign(p, low) == sign(p, high):
        step /= 2
        moved = (low + step * (sign(p, low) == 0), high - step * (sign(p, high) == 0))
        if changes(p, *moved) == 1:
            low, high = moved
    return low, high


def zeros(p: Any, found: list[Box]) -> list[Zero]:
    """The zeros that the boxes hold, narrowed."""
    return [narrow(p, a, b) for a, b, count in found if count]


def tree(P: list[Any], region: Region, most: int = 4000) -> str:
    """Bisections of a rectangle until sum_i P[i](y) x^i has positive Bernstein coefficients on each part, as text.

    Raises NotProved where it is not positive at a corner, or more parts are needed than `most`.
    """
    letters: list[str] = []
    waiting = [(_coefficients(P, region), region)]
    while waiting:
        table, ((a, b), (c, d)) = waiting.pop()
        if min(map(min, table)) > 0:
            letters.append("+")
            continue
        corners = [(table[i][j], x, y) for i, x in ((0, a), (-1, b)) for j, y in ((0, c), (-1, d))]
        for least, x, y in corners:
            if least <= 0:
                raise NotProved(f"the function is {float(fraction(least)):.3g} times something positive at ({x}, {y})")
        if len(letters) > most:
            raise NotProved(f"more than {most} boxes do not suffice")
        along_x = _roughness(table) >= _roughness([list(column) for column in zip(*table, strict=True)])
        letters.append("x" if along_x else "y")
        if along_x:
            halves = (((a, (a + b) / 2), (c, d)), (((a + b) / 2, b), (c, d)))
        else:
            halves = (((a, b), (c, (c + d) / 2)), ((a, b), ((c + d) / 2, d)))
        waiting += [(_coefficients(P, half), half) for half in reversed(halves)]
    return "".join(letters)


def _roughness(table: list[list[Any]]) -> Any:
    """The largest second difference down the columns, by which the coefficients may miss the function."""
    gaps = (abs(p - 2 * q + r) for one, two, three in zip(table, table[1:], table[2:], strict=False) for p, q, r in zip(one, two, three, strict=True))  # fmt: skip
    return max(gaps, default=flint.fmpq(0))


def _coefficients(P: list[Any], region: Region) -> list[list[Any]]:
    (a, b), y = region
    width = max(p.degree() for p in P)
    rows = [_bernstein(p, width, *y) for p in P]
    columns = [_bernstein(flint.fmpq_poly([row[j] for row in rows]), len(P) - 1, a, b) for j in range(width + 1)]
    return [[column[i] for column in columns] for i in range(len(P))]


def _bernstein(p: Any, degree: int, low: Fraction, high: Fraction) -> list[Any]:
    shifted = p(flint.fmpq_poly([rational(low), rational(high - low)]))
    total = flint.fmpq_poly([0])
    for k in range(degree + 1):  # x^k (1 + x)^(d - k) carries the power k of t = x/(1 + x)
        total += shifted[k] * flint.fmpq_poly([0] * k + [1]) * flint.fmpq_poly([1, 1]) ** (degree - k)
    return [total[k] / flint.fmpz.bin_uiui(degree, k) for k in range(degree + 1)]
