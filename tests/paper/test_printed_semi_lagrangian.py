"""Sections 4.2 and 4.3 in numbers: stencils on plane waves, quadratics and discriminants, all values random."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.paper import printed_semi_lagrangian as semi
from rkverify.paper.notation import LatticeValues
from rkverify.paper.plane_wave import phase_sign
from rkverify.paper.printed_semi_lagrangian import State

K = Multiprecision(30)
ANY = st.fractions(-10, 10, max_denominator=50)
POSITIVE = st.fractions(Fraction(1, 10), 10, max_denominator=50)
VALUES = st.builds(LatticeValues, POSITIVE, POSITIVE, *[ANY] * 8)
STATES = st.builds(State, ANY, ANY, POSITIVE, ANY)
# With |values| <= 10 and rho, h, R >= 1/10 no term exceeds 100 * 10^4 / 10^-2 * 8 < 10^10; fewer than 100 operations.
ALLOWED = 100 * 10**10 * K.epsilon
RELATIONS: dict[str, tuple[Callable[..., object], Callable[..., object], Callable[..., object]]] = {
    "scni": (semi.scni_stencil, semi.scni_relation, semi.scni_constant),
    "dni": (semi.dni_stencil, semi.dni_relation, semi.dni_constant),
}


def rounded(values: LatticeValues | State) -> LatticeValues | State:
    return replace(values, **{name: K.number(q) for name, q in vars(values).items()})


def on_wave(stencil: Callable[..., object], s: LatticeValues, q: State, kh: object, omega: object, sign: int) -> object:
    """The stencil on u = e^{i(n kh + sign omega t)} at t = 0, with its time derivatives."""
    i = K.context.mpc(0, sign)

    def derivative(order: int) -> Callable[[int], object]:
        return lambda n: (i * omega) ** order * K.context.mpc(K.cos(n * kh), K.sin(n * kh))

    return stencil(s, q, derivative(0), derivative(1), derivative(2))


@pytest.mark.decides("E75", "E76", "E81", "E82", "C38", "C48")
@pytest.mark.parametrize("which", RELATIONS)
@given(s=VALUES, q=STATES, kh=ANY, omega=ANY)
def test_the_stencil_on_a_plane_wave_is_the_relation(
    which: str, s: LatticeValues, q: State, kh: Fraction, omega: Fraction
) -> None:
    """(75) -> (76) and (81) -> (82) with the wave e^{i(kx + omega t)}, at 40 digits: the second way beside the symbols."""
    stencil, relation, _ = RELATIONS[which]
    s, q, theta, w = rounded(s), rounded(q), K.number(kh), K.number(omega)
    left = on_wave(stencil, s, q, theta, w, phase_sign("plus"))
    assert abs(left + relation(s, q, theta, w, K)) < ALLOWED


@pytest.mark.decides("E62")
@pytest.mark.parametrize("which", RELATIONS)
@given(s=VALUES, q=STATES, kh=ANY, omega=ANY)
def test_with_the_other_sign_it_is_not(which: str, s: LatticeValues, q: State, kh: Fraction, omega: Fraction) -> None:
    """The twin: e^{i(kx - omega t)} leaves twice B omega, which is zero only where Q, omega or the sines are."""
    stencil, relation, _ = RELATIONS[which]
    s, q, theta, w = rounded(s), rounded(q), K.number(kh), K.number(omega)
    B = semi.linear_coefficient(s, q, theta, K)
    assume(abs(B * w) > 1e-3)
    left = on_wave(stencil, s, q, theta, w, phase_sign("minus"))
    assert abs(left + relation(s, q, theta, w, K)) > 1e-3
    assert abs(left + relation(s, q, theta, w, K) - 2 * B * w) < ALLOWED


@pytest.mark.decides("E77", "E78", "E83", "E84")
@pytest.mark.parametrize("which", RELATIONS)
@given(s=VALUES, q=STATES, kh=ANY, omega=ANY)
def test_the_relation_is_the_quadratic(which: str, s: LatticeValues, q: State, kh: Fraction, omega: Fraction) -> None:
    """(76) = (77) with (78), (82) = (83) with (84); B is the same in both."""
    _, relation, constant = RELATIONS[which]
    s, q, theta, w = rounded(s), rounded(q), K.number(kh), K.number(omega)
    B, C = semi.linear_coefficient(s, q, theta, K), constant(s, q, theta, K)
    assert abs(relation(s, q, theta, w, K) - semi.quadratic(B, C, w)) < ALLOWED


@pytest.mark.decides("E79", "E85")
@given(one=ANY, other=ANY)
def test_the_discriminant_is_the_squared_distance_of_the_roots(one: Fraction, other: Fraction) -> None:
    """For omega^2 + B omega + C = (omega - p)(omega - q): D = (p - q)^2, exactly; not D = B^2 - C, say."""
    B, C = -(one + other), one * other
    assert semi.discriminant(B, C) == (one - other) ** 2
    assert semi.quadratic(B, C, one) == semi.quadratic(B, C, other) == 0


@pytest.mark.decides("E86", "E87", "C54")
@given(s=VALUES, q=STATES, kh=ANY)
def test_without_a_velocity_gradient_the_short_relations_remain(s: LatticeValues, q: State, kh: Fraction) -> None:
    """(76) at Q = 0 is (86), (82) at Q = 0 is (87): the convective term is the only place where Q stands."""
    s, q, theta = rounded(s), rounded(q), K.number(kh)
    still = replace(q, Q=K.zero())
    for relation, squared in (
        (semi.scni_relation, semi.scni_omega_squared),
        (semi.dni_relation, semi.dni_omega_squared),
    ):
        assert abs(relation(s, still, theta, K.zero(), K) + squared(s, q, theta, K)) < ALLOWED
        assert squared(s, q, theta, K) == squared(s, still, theta, K)


@given(s=VALUES, q=STATES, kh=ANY)
def test_the_twin_with_a_velocity_gradient(s: LatticeValues, q: State, kh: Fraction) -> None:
    """With Q the two differ by exactly the convective square at omega = 0, which is not zero."""
    s, q, theta = rounded(s), rounded(q), K.number(kh)
    square = (2 * q.Q * s.C_h * s.slope_h / s.R) ** 2 * (1 - K.cos(theta))
    assume(square > 1e-3)
    for relation, squared in (
        (semi.scni_relation, semi.scni_omega_squared),
        (semi.dni_relation, semi.dni_omega_squared),
    ):
        difference = relation(s, q, theta, K.zero(), K) + squared(s, q, theta, K)
        assert abs(difference + square) < ALLOWED
        assert abs(difference) > 1e-4


@pytest.mark.decides("C43")
@given(s=VALUES, q=STATES, kh=ANY)
def test_the_sign_of_q_turns_b_and_nothing_else(s: LatticeValues, q: State, kh: Fraction) -> None:
    """B is odd in Q, C and A are even, hence D is even: frequencies change sign with Q, their reality does not."""
    s, q, theta = rounded(s), rounded(q), K.number(kh)
    turned = replace(q, Q=-q.Q)
    assert semi.linear_coefficient(s, turned, theta, K) == -semi.linear_coefficient(s, q, theta, K)
    for constant in (semi.scni_constant, semi.dni_constant):
        assert constant(s, turned, theta, K) == constant(s, q, theta, K)


@given(s=VALUES, q=STATES)
def test_a_rigid_translation_has_no_frequency(s: LatticeValues, q: State) -> None:
    """At kh = 0 every coefficient is exactly zero: a uniform displacement is not pulled back."""
    s, q = rounded(s), rounded(q)
    assert semi.linear_coefficient(s, q, K.zero(), K) == 0
    assert semi.scni_constant(s, q, K.zero(), K) == semi.dni_constant(s, q, K.zero(), K) == 0
