"""Decimal text of enclosures: only digits that are certain are printed."""

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.guarded import Guarded
from rkverify.errors import Undecided

DIGITS = 15


def certain_digits(x: Guarded, digits: int = DIGITS) -> str:
    """The enclosure as a decimal with at most `digits` digits, right to one unit of the last place.

    Raises Undecided for an enclosure without bounds. An enclosure of zero prints as 0e-N: its magnitude is below 10^-N.

    >>> K = Ball(30)
    >>> certain_digits(K.ratio(1, 3), 5), certain_digits(K.sin(K.pi()))
    ('0.33333', '0e-32')
    """
    if not x.value.is_finite():
        raise Undecided("a value came out without bounds: use more digits, or a point where it is defined")
    with x.home.settings():
        return str(x.value.str(digits, radius=False))


def bounds(x: Guarded) -> tuple[float, float]:
    """A lower and an upper bound of the enclosure as floats, rounded outwards by one part in 10^15."""
    lower, upper = float(x.value.lower()), float(x.value.upper())
    return lower - 1e-15 * abs(lower), upper + 1e-15 * abs(upper)


def half_wave_numbers(samples: int, K: Ball) -> list[Guarded]:
    """kh = j pi / samples for j = 1, …, samples, as enclosures."""
    return [K.pi() * j / samples for j in range(1, samples + 1)]
