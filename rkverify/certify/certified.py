"""A number with its certified digits: |value - text| is at most one unit of the last printed digit, on every route to it.

Routes are numbers of any real arithmetic: exact rationals, enclosures with their radius, floats of two precisions. All are
taken as intervals with rational ends, so that the digits follow from their common hull without any rounding of our own.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import floor, log10
from typing import Any

import flint

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.guarded import Guarded
from rkverify.errors import BadInput, Undecided

ASKED = 30
LARGEST_POWER = 4000
"""Of ten: numbers beyond it are refused."""


@dataclass(frozen=True)
class Certified:
    """A decimal d.ddd…e±n with the count of its digits, or 0 with the count of decimal places known to be zero; the routes."""

    text: str
    digits: int
    routes: tuple[str, ...]

    @property
    def value(self) -> Fraction:
        """The printed number."""
        return Fraction(self.text)


def interval(value: Scalar) -> tuple[Fraction, Fraction]:
    """The least and the largest rational that a number may stand for; raises BadInput for what is no finite real number.

    >>> interval(Fraction(1, 3))
    (Fraction(1, 3), Fraction(1, 3))
    """
    if isinstance(value, Guarded):
        value = value.value
    if isinstance(value, int | Fraction):
        return Fraction(value), Fraction(value)
    if isinstance(value, flint.fmpq):
        return interval(Fraction(int(value.p), int(value.q)))
    if isinstance(value, flint.arb):
        if not value.is_finite():
            raise BadInput("an enclosure has no bounds: use more digits, or a point where the value is defined")
        middle, radius = _binary(value.mid()), _binary(value.rad())
        return middle - radius, middle + radius
    if hasattr(value, "_mpf_"):
        sign, man, exponent, _ = value._mpf_
        if not man and exponent:
            raise BadInput(f"{value} is not a finite number: look at the point where it was asked for")
        whole = Fraction(int(man)) * Fraction(2) ** int(exponent)
        return (-whole, -whole) if sign else (whole, whole)
    raise BadInput(f"{value!r} is no exact, enclosed or multiprecision number: compute it in one of these")


def _binary(x: Any) -> Fraction:
    man, exponent = x.man_exp()
    return Fraction(int(man)) * Fraction(2) ** int(exponent)


def certified(routes: Mapping[str, Scalar], asked: int = ASKED) -> Certified:
    """The most digits, up to `asked`, to which all routes agree; they are named in the order given.

    The first route is printed. Raises Undecided where not even one digit is common to all, BadInput for no routes.

    >>> certified({"one": Fraction(1, 3), "other": Fraction("0.3333339")})
    Certified(text='3.33333e-1', digits=6, routes=('one', 'other'))
    """
    if not routes:
        raise BadInput("a number without a route has no digits: give at least one")
    ends = [interval(value) for value in routes.values()]
    low, high = min(a for a, _ in ends), max(b for _, b in ends)
    middle, names = (ends[0][0] + ends[0][1]) / 2, tuple(routes)
    largest = max(abs(low), abs(high))
    if largest == 0 or largest <= Fraction(1, 10**asked):
        return Certified("0", asked, names)
    for digits in range(asked, 0, -1):
        text, unit = scientific(middle, digits)
        if max(high - Fraction(text), Fraction(text) - low) <= unit:
            return Certified(text, digits, names)
    spread = f"from {float(low):.3g} to {float(high):.3g}"
    raise Undecided(
        f"the routes {', '.join(names)} have no digit in common ({spread}): raise the precision or find the fault"
    )


def scientific(value: Fraction, digits: int) -> tuple[str, Fraction]:
    """The decimal d.dd…e±n nearest to a number, ties to the even digit, and the unit of its last digit.

    >>> scientific(Fraction(2, 3), 3)
    ('6.67e-1', Fraction(1, 1000))
    """
    size, power = abs(value), 0
    if size:
        power = floor(log10(size.numerator) - log10(size.denominator))
        if abs(power) > LARGEST_POWER:
            raise BadInput(f"a number of about 1e{power} is not printed: choose another unit")
        # Logarithms of whole numbers are right to rounding: at a power of ten they may be off by one.
        power += (size >= Fraction(10) ** (power + 1)) - (size < Fraction(10) ** power)
    unit = Fraction(10) ** (power - digits + 1)
    figures = round(size / unit)
    if figures >= 10**digits:
        return scientific(Fraction(10) ** (power + 1) * (1 if value > 0 else -1), digits)
    shown = str(figures).zfill(digits)
    point = f".{shown[1:]}" if digits > 1 else ""
    return f"{'-' if value < 0 else ''}{shown[0]}{point}e{power}", unit
