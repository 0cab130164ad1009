"""Truncated series: their coefficients are derivatives over factorials, and they end where a joint cuts them."""

from fractions import Fraction
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rkverify.arithmetic.series import Series

FRACTIONS = st.fractions(-10, 10, max_denominator=20)
LENGTH = 6
S = Series(LENGTH)


@given(q=FRACTIONS, rate=FRACTIONS, degree=st.integers(0, 8))
def test_powers_have_the_binomial_coefficients(q: Fraction, rate: Fraction, degree: int) -> None:
    """f^(n)/n! of (q + r t)^p is binom(p, n) q^(p-n) r^n, all of them up to the length and none beyond."""
    expected = [comb(degree, n) * q ** max(degree - n, 0) * rate**n for n in range(LENGTH)]
    assert S.coefficients(S.variable(q, rate) ** degree) == tuple(expected)


@given(q=FRACTIONS.filter(bool), rate=FRACTIONS)
def test_reciprocals_have_the_geometric_coefficients(q: Fraction, rate: Fraction) -> None:
    expected = [(-rate) ** n / q ** (n + 1) for n in range(LENGTH)]
    assert S.coefficients(1 / S.variable(q, rate)) == tuple(expected)


@given(q=FRACTIONS)
def test_coefficients_are_repeated_derivatives(q: Fraction) -> None:
    """(1 + x)/(1 + x^2) differentiated by hand up to the third derivative: another route to the same coefficients."""
    x = S.variable(q)
    found = S.coefficients((1 + x) / (1 + x * x))
    d, n = 1 + q * q, 1 + q
    by_hand = [
        n / d,
        (1 - 2 * q - q**2) / d**2,
        2 * (q**3 + 3 * q**2 - 3 * q - 1) / d**3,
        6 * (-(q**4) - 4 * q**3 + 6 * q**2 + 4 * q - 1) / d**4,
    ]
    factorials = (1, 1, 2, 6)
    assert [c * f for c, f in zip(found, factorials, strict=False)] == by_hand


@pytest.mark.parametrize("length", [1, 2, 9])
def test_a_series_is_as_long_as_asked_for(length: int) -> None:
    K = Series(length)
    assert len(K.coefficients(K.variable(3) * K.variable(2))) == length


@pytest.mark.parametrize("power", [1, 2, 3])
def test_a_joint_cuts_the_series_where_the_sides_part(power: int) -> None:
    """1 + (t)_+^p is 1 on the left and 1 + t^p on the right: they agree below t^p, and there the series must end.

    Decides that a coefficient that is given is the derivative from both sides.
    """
    x = S.variable(0)
    found = S.coefficients(1 + S.pos(x, power) * (2 + x))
    assert found == (1, *[Fraction(0)] * (power - 1))


def test_beside_the_joint_nothing_is_cut() -> None:
    """The twin: a little to the right all coefficients are known, and the p-th is not zero."""
    x = S.variable("1/1000")
    found = S.coefficients(1 + S.pos(x, 2))
    assert len(found) == LENGTH
    assert found[2] == 1


def test_a_longer_joint_cuts_later() -> None:
    """(t^2)_+ is t^2 from both sides, but only its vanishing below t is known from t^2 = 0: cut, never wrong."""
    found = S.coefficients(S.pos(S.variable(0) ** 2, 1))
    assert found == (0,) * len(found)
    assert len(found) <= 2
