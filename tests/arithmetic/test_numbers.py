"""Numbers go in exactly or rounded once, and nothing that is not a finite number goes in at all."""

import math
from collections.abc import Callable
from fractions import Fraction

import mpmath
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float, rational
from rkverify.arithmetic.series import Series
from rkverify.errors import BadInput

Interval = tuple[Fraction, Fraction]
RATIONALS = st.fractions(-(10**30), 10**30, max_denominator=10**30)
NO_NUMBERS = ["nan", "inf", "-inf", "1/0", "abc", "", "1,5", "0x10", "1 2", math.nan, math.inf, None, [], {}]


@pytest.mark.parametrize(
    ("value", "exact"),
    [
        (3, Fraction(3)),
        (-(10**40), Fraction(-(10**40))),
        (Fraction(2, 3), Fraction(2, 3)),
        ("0.1", Fraction(1, 10)),
        ("1e-3", Fraction(1, 1000)),
        ("-2/3", Fraction(-2, 3)),
        (" 1/2 ", Fraction(1, 2)),
        (0.1, Fraction(3602879701896397, 36028797018963968)),  # the double nearest to 1/10
        (0.5, Fraction(1, 2)),
    ],
)
def test_a_text_is_a_decimal_and_a_float_its_binary_value(value: object, exact: Fraction) -> None:
    """Decides that "0.1" means one tenth while 0.1 means the double: exactness is lost nowhere on the way in."""
    assert rational(value) == exact
    assert Exact().number(value) == exact


@pytest.mark.parametrize("value", NO_NUMBERS, ids=repr)
def test_what_is_not_a_finite_number_is_refused(value: object) -> None:
    """Decides that no input turns into a number silently, and that the error is one of ours."""
    with pytest.raises(BadInput, match="is not a finite number"):
        rational(value)


@pytest.mark.parametrize("value", ["1e999999999", "-2.5E-999999999", " 1e+100001 ", "1e-100_001"])
def test_an_exponent_that_would_fill_the_memory_is_refused(value: str) -> None:
    """Decides that one cell of somebody's table cannot halt a run: 10^999999999 has a billion digits, and is no length."""
    with pytest.raises(BadInput, match="exponent beyond 100000"):
        rational(value)


def test_the_largest_exponent_is_still_exact() -> None:
    """The twin: up to the bound nothing is refused and no digit is lost."""
    assert rational("1e100000") * rational("1e-100000") == 1


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "nan", "1/0", "abc"], ids=repr)
def test_no_arithmetic_takes_what_is_not_finite(K: Arithmetic, value: object) -> None:
    """Decides that an undefined value cannot enter and be taken for 0 by a decision: sign(nan) would be 0."""
    with pytest.raises(BadInput, match="is not a finite number"):
        K.number(value)


@pytest.mark.parametrize("K", [Float(), Complex()], ids=lambda K: K.name)
def test_a_number_beyond_the_range_is_refused_in_our_words(K: Arithmetic) -> None:
    with pytest.raises(BadInput):
        K.number("1e400")


@given(q=RATIONALS)
@example(q=Fraction(2**53 + 1, 7))  # the numerator alone is longer than the 53 bits of float and mp:5
@example(q=Fraction(0))
def test_a_constant_is_rounded_at_most_once(K: Arithmetic, interval: Callable[..., Interval], q: Fraction) -> None:
    """One rounding to nearest is off by at most half an epsilon of the value; exact arithmetics by nothing.

    Decides that constants enter through the arithmetic: a detour through a double, or a second rounding, is larger.
    """
    for made in (K.number(q), K.number(f"{q.numerator}/{q.denominator}"), K.ratio(q.numerator, q.denominator)):
        low, high = interval(made)
        half_unit = Fraction(K.epsilon) / 2 * abs(q)
        assert low - half_unit <= q <= high + half_unit
        assert high - low <= Fraction(1, 10**20) * abs(q)  # only balls have a width: 20 digits and 8 bits in hand


@given(x=st.floats(allow_nan=False, allow_infinity=False, width=32))
def test_a_float_enters_with_its_binary_value(K: Arithmetic, interval: Callable[..., Interval], x: float) -> None:
    """A float of width 32 has 24 bits, which every arithmetic holds: nothing may be rounded."""
    assert interval(K.number(x)) == (Fraction(x), Fraction(x))


def test_a_number_of_the_arithmetic_stays_what_it_is(K: Arithmetic, interval: Callable[..., Interval]) -> None:
    x = K.ratio(1, 3)
    assert interval(K.number(x)) == interval(x)


@given(q=RATIONALS)
def test_text_loses_nothing(q: Fraction) -> None:
    """Decides that results can be stored as text: reading it back gives the number, or an enclosure of it."""
    assert Fraction(Exact().text(Exact().number(q))) == q
    x = Float().number(q)
    assert float(Float().text(x)) == x
    assert complex(Complex().text(complex(x, 0.1))) == complex(x, 0.1)
    digits = 30
    K = Multiprecision(digits)
    # `digits` significant decimals: half a unit of the last is at most 10^(1-digits)/2 of the value.
    assert abs(Fraction(K.text(K.number(q))) - q) <= Fraction(1, 10 ** (digits - 1)) * abs(q)
    middle, _, radius = Ball(digits).text(Ball(digits).number(q)).strip("[]").partition(" +/- ")
    assert abs(Fraction(middle) - q) <= Fraction(radius or 0)


def test_a_series_prints_its_terms_and_its_remainder() -> None:
    S = Series(3)
    assert S.text(S.variable("1/3")) == "1/3 + x + O(x^3)"


@pytest.mark.parametrize("made", [lambda: Ball(0), lambda: Multiprecision(0), lambda: Multiprecision(-3)])
def test_no_digits_are_refused(made: Callable[[], Arithmetic]) -> None:
    with pytest.raises(BadInput, match="at least one digit"):
        made()


def test_digits_asked_for_are_there_and_ten_in_hand() -> None:
    """The square root of 2 to the digits asked for, from mpmath's own context at twice the precision."""
    for digits in (5, 30, 60):
        K = Multiprecision(digits)
        with mpmath.workdps(2 * digits + 20):
            off = abs(mpmath.mpf(K.sqrt(K.number(2))) - mpmath.sqrt(2))
            assert off < mpmath.mpf(10) ** -(digits + 9)
        assert K.epsilon < 10.0 ** -(digits + 9)
