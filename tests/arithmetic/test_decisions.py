"""Every branch of the transcription is one of these decisions: sign, surely_positive, absolute and pos."""

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.series import Series
from rkverify.errors import NotDifferentiable, Undecided

Interval = tuple[Fraction, Fraction]
POWERS = (0, 1, 2, 3)
FRACTIONS = st.fractions(-100, 100, max_denominator=1000)
B = Ball(20)
S = Series(4)
DUALS = {"dual(exact)": Duals(Exact(), 1), "dual(mp)": Duals(Multiprecision(20), 1), "dual(ball)": Duals(B, 1)}


@given(q=FRACTIONS)
@example(q=Fraction(0))
def test_signs_are_those_of_the_exact_value(K: Arithmetic, q: Fraction) -> None:
    """Decides that no arithmetic takes another branch than exact arithmetic does at the same number."""
    x = K.number(q)
    assert K.sign(x) == (q > 0) - (q < 0)
    assert K.surely_positive(x) == (q > 0)
    assert K.is_zero(x) == (q == 0)
    assert K.sign(K.absolute(x)) == (q != 0)


@given(q=FRACTIONS.filter(bool), power=st.sampled_from(POWERS))
def test_truncated_powers_are_those_of_the_exact_value(
    K: Arithmetic, interval: Callable[..., Interval], q: Fraction, power: int
) -> None:
    """(x)_+^p is the only branch of a kernel: exactly 0 on the left, x^p on the right.

    Rounding: the number and each of at most p products are off by an epsilon, so (p + 1) epsilon with (1 + e)^p spent
    on the second order.
    """
    low, high = interval(K.pos(K.number(q), power))
    expected = q**power if q > 0 else Fraction(0)
    allowed = (power + 1) * (1 + power) * Fraction(K.epsilon) * expected
    assert low - allowed <= expected <= high + allowed


@pytest.mark.parametrize("power", POWERS)
def test_at_the_joint_itself_only_the_step_has_no_value(
    K: Arithmetic, interval: Callable[..., Interval], power: int
) -> None:
    """Decides that a kernel ends in an exact 0 at its edge, and that the one derivative that jumps is refused."""
    if power == 0:
        with pytest.raises(NotDifferentiable, match="joint"):
            K.pos(K.zero(), power)
    else:
        assert interval(K.pos(K.zero(), power)) == (0, 0)


@pytest.mark.parametrize("power", POWERS)
def test_a_ball_across_the_joint_holds_both_branches(interval: Callable[..., Interval], power: int) -> None:
    """A ball's radius has 30 bits and is rounded up: twice for the union, and less than four times for each product."""
    low, high = interval(B.pos(B.between(-1, 2), power))
    assert low <= 0
    assert 2**power <= high <= 2**power * (1 + Fraction(4 * power + 2, 2**29))


def test_a_ball_across_zero_decides_nothing() -> None:
    """A computed sign is a proved sign: where there is no proof there is no sign."""
    x = B.between(-1, 2)
    with pytest.raises(Undecided):
        B.sign(x)
    assert not B.surely_positive(x)
    assert not B.surely_positive(-x)
    assert not B.is_zero(x)


def test_a_ball_that_touches_zero_keeps_the_step_open(interval: Callable[..., Interval]) -> None:
    """The twin of the refusal at 0: [0, 1] may be 0, where the step has any value from 0 to 1."""
    low, high = interval(B.pos(B.between(0, 1), 0))
    assert low <= 0 < 1 <= high


@given(real=FRACTIONS, imaginary=FRACTIONS)
def test_complex_numbers_decide_by_their_real_part(real: Fraction, imaginary: Fraction) -> None:
    """Decides that a complex step does not change the branch that the real computation takes."""
    K = Complex()
    assert K.sign(complex(real, imaginary)) == Exact().sign(real)
    assert K.absolute(complex(real, imaginary)) in (complex(real, imaginary), -complex(real, imaginary))


def moving(which: str) -> tuple[Arithmetic, Scalar]:
    """0 + 1 t at a joint, in each of the arithmetics that carry a derivative."""
    if which in DUALS:
        return DUALS[which], DUALS[which].variable(0, 0)
    return (Complex(), 1e-30j) if which == "complex" else (S, S.variable(0))


@pytest.mark.parametrize("which", [*DUALS, "complex", "series"])
@pytest.mark.parametrize("power", POWERS)
def test_a_derivative_across_the_joint_is_refused_where_it_jumps(which: str, power: int) -> None:
    """(x)_+^p is C^(p-1): its first derivative exists at 0 from p = 2 on and is 0; for p = 0 and 1 it does not exist.

    A series is instead cut to what both sides agree on: the coefficients below t^p.
    """
    K, x = moving(which)
    if which == "series" and power > 0:
        assert S.coefficients(S.pos(x, power)) == (0,) * power
    elif power < 2:
        with pytest.raises(NotDifferentiable):
            K.pos(x, power)
    else:
        assert K.is_zero(K.pos(x, power))


@pytest.mark.parametrize("which", DUALS)
def test_at_rest_on_a_kink_there_is_nothing_to_refuse(which: str) -> None:
    """The twin: with no slope, (x)_+ at 0 is 0 and stays 0."""
    K = DUALS[which]
    assert K.is_zero(K.pos(K.zero(), 1))


def test_a_dual_ball_across_a_kink_has_every_slope_between(interval: Callable[..., Interval]) -> None:
    D = DUALS["dual(ball)"]
    slope = D.pos(D.along(B.between(-1, 1), [1]), 1).partials[0]
    low, high = interval(slope)
    assert low <= 0 < 1 <= high


def test_a_dual_ball_across_a_jump_has_no_slope() -> None:
    """The step's derivative is 0 on either side and does not exist at 0, which the ball contains: 0 is not certain."""
    D = DUALS["dual(ball)"]
    with pytest.raises((NotDifferentiable, Undecided)):
        D.pos(D.along(B.between(-1, 1), [1]), 0)


def test_a_series_known_to_no_order_is_not_zero() -> None:
    """O(t) may be t: it is not "exactly zero, whatever it stands for", and its truncated power is known no further."""
    short = S.pos(S.variable(0), 1)
    assert S.coefficients(short) == (0,)
    assert len(S.coefficients(S.pos(short, 1))) <= 1
    assert not S.is_zero(short)


def test_the_absolute_value_at_zero_takes_the_slope_of_x() -> None:
    """Documented: it is used only inside functions even in x, whose derivative there does not see the sign."""
    D = DUALS["dual(exact)"]
    assert D.absolute(D.variable(0, 0)).partials == (1,)
    assert D.absolute(D.variable(-1, 0)).partials == (-1,)
    assert Float().absolute(-0.0) == 0
