"""Roots of omega^2 + B omega + C = 0 without complex numbers: they solve it, and their growth has the right sign."""

import cmath
from fractions import Fraction

import pytest
from hypothesis import example, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.errors import NotRepresentable, Undecided
from rkverify.stability.roots import Root, quadratic_roots

FLOATS = st.floats(-1e6, 1e6)
FRACTIONS = st.fractions(-20, 20, max_denominator=50)


def residual(root: Root, B: Fraction, D: Fraction) -> tuple[Fraction, Fraction]:
    """Real and imaginary part of omega^2 + B omega + (B^2 - D)/4, exactly, for a root in doubles."""
    re, im = Fraction(root.re), Fraction(root.im)
    return re * re - im * im + B * re + (B * B - D) / 4, 2 * re * im + B * im


@given(B=FLOATS, D=FLOATS)
@example(B=1.0, D=0.0)
@example(B=0.0, D=-4.0)
@example(B=1.0, D=1.0)  # a root at 0
@example(B=1e6, D=(1e6 - 1e-6) ** 2)  # -B + sqrt(D) cancels
def test_roots_solve_the_quadratic(B: float, D: float) -> None:
    """With s^2 = |D| a root is (B ± s)/2, off by 2 epsilon (|B| + s)/2 at most: root, halving, one sum.

    The residual's slope is |2 omega + B| = s, and D itself is taken as exact: |residual| <= 2 epsilon (|B| + s)^2.
    """
    size = Fraction(abs(B)) + Fraction(abs(D) ** 0.5)
    allowed = 2 * Fraction(Float.epsilon) * size**2 + Fraction(1, 2**1000)
    parts = [part for root in quadratic_roots(B, D, Float()) for part in residual(root, Fraction(B), Fraction(D))]
    target(float(max(map(abs, parts)) / allowed))
    assert max(map(abs, parts)) <= allowed


@given(one=FRACTIONS, other=FRACTIONS)
def test_real_roots_are_found_exactly(one: Fraction, other: Fraction) -> None:
    """(omega - p)(omega - q) has B = -(p + q) and D = (p - q)^2: in rationals the roots come back, the larger first."""
    roots = quadratic_roots(-(one + other), (one - other) ** 2, Exact())
    assert [(r.re, r.im) for r in roots] == [(max(one, other), 0), (min(one, other), 0)]


@given(re=FRACTIONS, im=FRACTIONS.filter(bool))
def test_complex_roots_are_found_exactly(re: Fraction, im: Fraction) -> None:
    """Conjugate roots re ± i im have B = -2 re and D = -4 im^2; the one that grows, Im omega < 0, comes first."""
    roots = quadratic_roots(-2 * re, -4 * im**2, Exact())
    assert [(r.re, r.im) for r in roots] == [(re, -abs(im)), (re, abs(im))]
    assert [r.growth for r in roots] == [abs(im), -abs(im)]
    assert all(residual(root, -2 * re, -4 * im**2) == (0, 0) for root in roots)


@given(re=st.floats(-3, 3), im=st.floats(-3, 3), t=st.floats(0, 2))
def test_growth_is_that_of_the_plane_wave(re: float, im: float, t: float) -> None:
    """|e^{i omega t}| = e^{growth t} for the wave e^{i(kx + omega t)}: decides the sign of -Im omega.

    The exponential's relative error is that of its argument, below 6 epsilon times 2, and its own.
    """
    size = abs(cmath.exp(1j * complex(re, im) * t))
    expected = cmath.exp(Root(re, im).growth * t).real
    assert size == pytest.approx(expected, rel=20 * Float.epsilon)


@given(re=FRACTIONS, im=FRACTIONS)
def test_squares_of_roots(re: Fraction, im: Fraction) -> None:
    """omega^2 as two real numbers, by the binomial of a + i b written the other way: (a + b)(a - b)."""
    assert Root(re, im).squared == ((re + im) * (re - im), (re + im) ** 2 - re**2 - im**2)


def test_the_border_is_a_double_root() -> None:
    """D = 0 is stable: two equal real roots, no growth; on either side of it the roots part along another axis."""
    assert [(r.re, r.im) for r in quadratic_roots(Fraction(-4), Fraction(0), Exact())] == [(2, 0), (2, 0)]
    assert [r.growth for r in quadratic_roots(0.0, -1e-300, Float())] == [0.5e-150, -0.5e-150]
    assert [r.growth for r in quadratic_roots(0.0, 1e-300, Float())] == [0, 0]


def test_what_cannot_be_decided_or_represented_is_refused() -> None:
    K = Ball(20)
    with pytest.raises(Undecided):
        quadratic_roots(K.number(0), K.between(-1, 1), K)
    with pytest.raises(NotRepresentable):
        quadratic_roots(Fraction(0), Fraction(2), Exact())


@given(B=FRACTIONS, D=FRACTIONS.filter(bool))
def test_more_digits_and_balls_agree(B: Fraction, D: Fraction) -> None:
    """40 digits against an enclosure: the enclosures of the residual contain 0 and the two agree to 30 digits."""
    M, K = Multiprecision(40), Ball(40)
    for precise, enclosed in zip(
        quadratic_roots(M.number(B), M.number(D), M), quadratic_roots(K.number(B), K.number(D), K), strict=True
    ):
        for p, e in ((precise.re, enclosed.re), (precise.im, enclosed.im)):
            assert abs(float(p) - float(K.witness(e))) <= 1e-14 * (1 + abs(float(p)))
        square = enclosed.squared
        constant = (K.number(B) ** 2 - K.number(D)) / 4
        parts = (square[0] + K.number(B) * enclosed.re + constant, square[1] + K.number(B) * enclosed.im)
        assert not any(K.surely_positive(part) or K.surely_positive(-part) for part in parts)
