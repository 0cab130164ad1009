"""Arithmetics of different precision live side by side: none changes another, nor any global setting."""

from collections.abc import Callable, Iterator
from itertools import zip_longest

import flint
import mpmath
import pytest

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.series import Series

Make = Callable[[], Arithmetic]


def steps(K: Arithmetic) -> Iterator[str]:
    """A computation in small steps, each of which rounds: Newton's iteration for the root of 2, as text."""
    x = K.number(1)
    for _ in range(6):
        x = (x + 2 / x) / 2
        yield K.text(x)


def series_steps(K: Series) -> Iterator[str]:
    x = K.variable(1)
    for _ in range(3):
        x = (x + 2 / x) / 2
        yield K.text(x)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (lambda: Multiprecision(10), lambda: Multiprecision(60)),
        (lambda: Ball(10), lambda: Ball(60)),
        (lambda: Ball(10), lambda: Multiprecision(60)),
    ],
)
def test_interleaved_computations_are_those_done_alone(one: Make, other: Make) -> None:
    """Decides that precision belongs to the number, not to the moment: text is compared, to the last digit."""
    alone = list(steps(one())), list(steps(other()))
    together = list(zip(*zip_longest(steps(one()), steps(other())), strict=True))
    assert tuple(map(list, together)) == alone


def test_interleaved_series_keep_their_lengths() -> None:
    alone = list(series_steps(Series(2))), list(series_steps(Series(7)))
    together = list(zip(*zip_longest(series_steps(Series(2)), series_steps(Series(7))), strict=True))
    assert tuple(map(list, together)) == alone


def failing(make: Callable[[], Scalar]) -> None:
    with pytest.raises((ZeroDivisionError, ValueError)):
        make()


@pytest.mark.parametrize("digits", [5, 200])
def test_global_contexts_are_left_as_found(digits: int) -> None:
    """Decides that using the suite does not change a caller's own flint or mpmath, also after an error."""
    before = flint.ctx.prec, flint.ctx.cap, mpmath.mp.prec
    K, S = Ball(digits), Series(digits)
    list(steps(K))
    list(series_steps(Series(3)))
    list(steps(Multiprecision(digits)))
    K.sqrt(K.between(-1, 2))
    K.cos(K.pi())
    failing(lambda: S.number(1) / S.number(0))
    failing(lambda: 1 / S.variable(0))
    assert (flint.ctx.prec, flint.ctx.cap, mpmath.mp.prec) == before


def test_a_callers_own_precision_does_not_reach_a_ball() -> None:
    """The other direction: the result is the same whatever the global context says."""
    alone = list(steps(Ball(40)))
    kept = flint.ctx.prec
    flint.ctx.prec = 20
    try:
        assert list(steps(Ball(40))) == alone
    finally:
        flint.ctx.prec = kept


def test_more_digits_make_narrower_balls() -> None:
    """The twin of enclosure: an enclosure that did not shrink would prove little. 8 bits in hand, 3.3 bits a digit."""
    for digits in (5, 20, 80):
        K = Ball(digits)
        radius = K.sqrt(K.number(2)).value.rad()
        assert 0 < radius < flint.arb(10) ** -digits
