"""Python's own numbers: float, complex (for the complex step) and exact rationals."""

import cmath
import math
import re
import sys
from fractions import Fraction

from rkverify.arithmetic.base import Arithmetic, Scalar, not_negative
from rkverify.errors import BadInput, NotDifferentiable, NotRepresentable

LARGEST_EXPONENT = 100_000
"""Of ten, in text: an exact rational has as many digits, and 1e999999999 would take the machine's memory to say no more."""


def rational(value: Scalar) -> Fraction:
    """The exact rational that an int, a Fraction, a finite float or a string such as 0.1, 1e-3 or 2/3 stands for.

    Raises BadInput where it stands for none, or has an exponent beyond LARGEST_EXPONENT.

    >>> rational("0.1"), rational("2/3")
    (Fraction(1, 10), Fraction(2, 3))
    """
    try:
        exponent = re.search(r"[eE]([-+]?[\d_]+)\s*$", value) if isinstance(value, str) else None
        if exponent is not None and abs(int(exponent[1])) > LARGEST_EXPONENT:
            raise BadInput(f"{value!r} has an exponent beyond {LARGEST_EXPONENT}: choose another unit")
        return Fraction(value)
    except (ValueError, OverflowError, TypeError, ZeroDivisionError):
        raise BadInput(f"{value!r} is not a finite number: write a decimal or p/q") from None


def finite(value: Scalar) -> float:
    """The double nearest to a number.

    Raises BadInput for what is not finite, or too large for a double.
    """
    try:
        double = value if isinstance(value, float) else float(rational(value))
    except OverflowError:
        raise BadInput(f"{value!r} is too large for double precision: choose mp:DIGITS or exact") from None
    if not math.isfinite(double):
        raise BadInput(f"{value!r} is not a finite number: write a decimal or p/q")
    return double


class Float(Arithmetic):
    """IEEE double precision."""

    name = "float"
    epsilon = sys.float_info.epsilon

    def number(self, value: Scalar) -> float:
        return finite(value)

    def witness(self, x: float) -> float:
        return x

    def sqrt(self, x: float) -> float:
        return math.sqrt(not_negative(x, self))

    def cos(self, x: float) -> float:
        return math.cos(x)

    def sin(self, x: float) -> float:
        return math.sin(x)

    def pi(self) -> float:
        return math.pi

    def text(self, x: float) -> str:
        return repr(x)


class Complex(Arithmetic):
    """Complex doubles; decisions look at the real part, so that f(x + i e) carries f'(x) in its imaginary part."""

    name = "complex"
    epsilon = sys.float_info.epsilon

    def number(self, value: Scalar) -> complex:
        if isinstance(value, complex):
            return complex(finite(value.real), finite(value.imag))
        return complex(finite(value))

    def witness(self, x: complex) -> float:
        return x.real

    def pos(self, x: complex, power: int) -> complex:
        if x.real == 0 and x.imag != 0 and power == 1:
            raise NotDifferentiable(
                "a kernel's kink lies exactly at the point: move the point or take a kernel of class C1"
            )
        return complex(super().pos(x, power))

    def known_below(self, x: complex, order: int) -> complex:
        if order < 2 and x.imag != 0:
            raise NotDifferentiable("the kernel has a peak at its node: move the point or take a smoother kernel")
        return x

    def sqrt(self, x: complex) -> complex:
        return cmath.sqrt(x)

    def cos(self, x: complex) -> complex:
        return cmath.cos(x)

    def sin(self, x: complex) -> complex:
        return cmath.sin(x)

    def pi(self) -> complex:
        return complex(math.pi)

    def text(self, x: complex) -> str:
        return repr(x)


class Exact(Arithmetic):
    """Rational numbers; every operation is exact, and what is not rational is refused."""

    name = "exact"
    epsilon = 0.0

    def number(self, value: Scalar) -> Fraction:
        return rational(value)

    def witness(self, x: Fraction) -> Fraction:
        return x

    def sqrt(self, x: Fraction) -> Fraction:
        root = Fraction(math.isqrt(max(x.numerator, 0)), math.isqrt(x.denominator))
        if root * root != x:
            raise NotRepresentable(
                f"the square root of {x} is not rational: arithmetic 'exact' works in one dimension and where "
                "distances are rational; choose mp:DIGITS elsewhere"
            )
        return root

    def text(self, x: Fraction) -> str:
        try:
            return str(x)
        except ValueError:
            digits = int(max(x.numerator.bit_length(), x.denominator.bit_length()) * math.log10(2))
            raise NotRepresentable(
                f"an exact result has some {digits} digits, more than are written: choose mp:DIGITS"
            ) from None
