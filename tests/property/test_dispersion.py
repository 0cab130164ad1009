"""Random settings: every root solves its relation, and D >= 0 wherever the sum of squares says so."""

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.kernels import KERNELS
from rkverify.paper.notation import HALF_POINTS, lattice_values
from rkverify.paper.shape import DERIVATIVES
from rkverify.stability.layers import INTEGRATIONS, Setting, dispersion
from rkverify.stability.printed import PrintedQuadratic

M = Multiprecision(30)
ANGLES = st.fractions(Fraction(1, 50), Fraction(157, 50), max_denominator=100)
SETTINGS = st.builds(
    Setting,
    st.just("semi-lagrangian"),
    st.sampled_from(INTEGRATIONS),
    st.fractions(Fraction(11, 10), Fraction(19, 10), max_denominator=40),
    st.fractions(-3, 3, max_denominator=20),
    velocity_gradient=st.fractions(-2, 2, max_denominator=20),
    spacing=st.fractions(Fraction(1, 50), 1, max_denominator=50),
    half_point=st.sampled_from(HALF_POINTS),
    derivative=st.sampled_from(DERIVATIVES),
    kernel=st.sampled_from(sorted(set(KERNELS) - {"tent"})),
)


def relation(setting: Setting) -> PrintedQuadratic:
    values = lattice_values(
        setting.spacing, setting.support_ratio, M, setting.half_point, setting.derivative, setting.kernel, setting.order
    )
    return PrintedQuadratic(values, setting.integration, M, setting.convective)


@given(setting=SETTINGS, kh=ANGLES)
def test_roots_solve_the_relation(setting: Setting, kh: Fraction) -> None:
    """omega^2 + B omega + C = 0 with C from D, as complex numbers; Vieta: the roots' sum is -B and their product C.

    1/h <= 50 and values below 100: terms below 100^2 * 50^2 * 10 < 1e9, 1000 operations, 1e12 epsilon.
    """
    printed, theta = relation(setting), M.number(kh)
    state = printed.state(setting.stress_ratio, setting.velocity_gradient)
    B, D = printed.linear(state, theta), printed.discriminant(state, theta)
    one, other = (M.context.mpc(b.omega.re, b.omega.im) for b in dispersion(setting, [kh], M))
    C = (B * B - D) / 4
    assert abs(one + other + B) < 1e12 * M.epsilon
    assert abs(one * other - C) < 1e12 * M.epsilon
    for omega in (one, other):
        assert abs(omega**2 + B * omega + C) < 1e12 * M.epsilon


@given(setting=SETTINGS, kh=ANGLES)
def test_growth_is_a_negative_discriminant(setting: Setting, kh: Fraction) -> None:
    """One root grows exactly where D < 0, at the rate sqrt(-D)/2, and its partner decays as fast."""
    one, other = dispersion(setting, [kh], M)
    assert one.omega.growth == -other.omega.growth
    assert (one.omega.growth > 0) == (one.D < 0)
    assert abs(4 * one.omega.growth**2 + min(one.D, 0)) <= 4 * M.epsilon * abs(one.D)


@pytest.mark.decides("C40", "C42", "C56")
@given(setting=SETTINGS, kh=ANGLES)
def test_scni_is_stable_where_the_tangent_is_positive(setting: Setting, kh: Fraction) -> None:
    """(79) as printed: with C^sigma + sigma >= 0 D is never negative, and the convective term never lowers it.

    hypothesis climbs towards a negative D; 1e12 epsilon is the rounding of its terms.
    """
    scni = replace(setting, integration="scni", stress_ratio=max(setting.stress_ratio, Fraction(-1)))
    D, still = (dispersion(s, [kh], M)[0].D for s in (scni, replace(scni, velocity_gradient=0)))
    target(-float(D), label="-D")
    assert -1e12 * M.epsilon <= D
    assert still - 1e12 * M.epsilon <= D


@given(setting=SETTINGS, kh=ANGLES)
def test_the_twin_where_it_is_negative(setting: Setting, kh: Fraction) -> None:
    """Without Q and with C^sigma + sigma < 0 D is negative at every kh that has a sine: one wave grows."""
    broken = replace(setting, integration="scni", stress_ratio=Fraction(-2), velocity_gradient=0)
    assume(abs(M.sin(M.number(kh))) > 1e-3)
    one, _ = dispersion(broken, [kh], M)
    assert one.D < 0
    assert one.omega.growth > 0


@given(setting=SETTINGS, kh=ANGLES)
def test_waves_in_either_direction(setting: Setting, kh: Fraction) -> None:
    """kh -> -kh turns B and keeps D: the frequencies of the wave that runs the other way are the negatives."""
    forth, back = dispersion(setting, [kh], M), dispersion(setting, [-kh], M)
    assert forth[0].D == back[0].D
    for p, q in zip(forth, reversed(back), strict=True):
        assert abs(p.omega.re + q.omega.re) <= 1e12 * M.epsilon
        assert abs(p.omega.im + q.omega.im) <= 1e12 * M.epsilon
