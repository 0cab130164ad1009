"""Digits that are certified are what a table prints: one too many and every later comparison with it is wrong."""

from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.certify.certified import certified, interval, scientific
from rkverify.certify.rounding import rounding_bounds
from rkverify.errors import BadInput, Undecided

NUMBERS = st.fractions(min_value=-(10**12), max_value=10**12, max_denominator=10**12).filter(bool)


@given(NUMBERS, st.integers(1, 40))
def test_a_decimal_is_within_half_a_unit_of_its_last_digit(value, digits):
    """Rounded once, to nearest, with exactly the digits asked for."""
    text, unit = scientific(value, digits)
    shown = text.lstrip("-").partition("e")[0].replace(".", "")
    assert len(shown) == digits
    assert shown[0] != "0"
    assert abs(Fraction(text) - value) <= unit / 2
    assert Fraction(text) / unit == int(Fraction(text) / unit)


@given(NUMBERS, st.integers(2, 28), st.sampled_from([1, -1]))
def test_digits_end_where_the_routes_part(value, place, sign):
    """Two routes a relative 10^-place apart have at least place - 1 digits in common and at most place + 1."""
    other = value * (1 + sign * Fraction(1, 10**place))
    found = certified({"one": value, "other": other})
    assert place - 1 <= found.digits <= place + 1
    unit = scientific(value, found.digits)[1]
    assert max(abs(found.value - value), abs(found.value - other)) <= unit


def test_a_digit_more_would_be_wrong():
    """The twin: with one digit more one of the routes is farther than a unit away."""
    one, other = Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**9)
    found = certified({"one": one, "other": other})
    text, unit = scientific(one, found.digits + 1)
    assert abs(Fraction(text) - other) > unit
    assert certified({"one": one, "other": one}).digits == 30


@pytest.mark.parametrize("value", [Fraction(0), Fraction(1, 10**31), -Fraction(1, 10**40)])
def test_a_number_below_the_last_place_is_zero(value):
    assert certified({"": value}).text == "0"


def test_enclosures_count_with_their_radius():
    """A ball of 20 digits cannot certify 30, and nothing that it contains is lost."""
    K = Ball(20)
    third = K.number(1) / 3
    low, high = interval(third)
    assert low < Fraction(1, 3) < high
    assert 18 <= certified({"ball": third}).digits <= 24
    assert certified({"mp": Multiprecision(40).ratio(1, 3)}).text == "3." + "3" * 29 + "e-1"


@pytest.mark.parametrize("power", [-40, -3, 7])
def test_a_carry_moves_the_exponent(power):
    assert scientific(Fraction("9.996") * Fraction(10) ** power, 3)[0] == f"1.00e{power + 1}"


@pytest.mark.parametrize(
    ("routes", "says"),
    [
        ({}, "give at least one"),
        ({"a": mpmath.mpf("nan")}, "not a finite number"),
        ({"a": mpmath.mpf("inf")}, "not a finite number"),
        ({"a": 0.5}, "compute it in one of these"),
        ({"a": Fraction(10) ** 5000}, "choose another unit"),
    ],
)
def test_what_has_no_digits_is_refused(routes, says):
    with pytest.raises(BadInput, match=says):
        certified(routes)


def test_routes_without_a_common_digit_are_undecided():
    with pytest.raises(Undecided, match="no digit in common"):
        certified({"one": Fraction(1), "other": Fraction(-1)})


@given(st.integers(1, 10**6), st.integers(1, 10**6), st.integers(1, 10**6))
def test_the_bound_holds_for_the_same_operations_in_doubles(a, b, c):
    """(a/b - c/b) * b with cancellation: the error in doubles is at most the width of the enclosure with 53 bits."""

    def formula(K):
        p, q, r = map(K.number, (a, b, c))
        return {"x": (p / q - r / q) * q}

    error = abs(Fraction((a / b - c / b) * b) - (a - c))
    assert error <= Fraction(rounding_bounds(formula)["x"])


def test_the_bound_grows_with_the_condition():
    """Cancellation of six digits takes six digits: the bound is computed, not a constant."""
    plain, lost = (rounding_bounds(lambda K, big=big: {"x": (K.number(1) / 3 + big) - big})["x"] for big in (0, 10**6))
    assert 10**5 < lost / plain < 10**8
