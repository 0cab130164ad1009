"""omega(kh) of every formulation and integration: it solves the printed relation, scales, and meets closed forms."""

from collections.abc import Callable
from dataclasses import replace
from itertools import product

import pytest

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Float
from rkverify.paper import printed_semi_lagrangian as semi
from rkverify.paper.notation import lattice_values
from rkverify.paper.printed_lagrangian import b_hat, omega_squared
from rkverify.paper.shape import DERIVATIVES
from rkverify.stability.layers import Branch, Setting, dispersion

KH = ["1/10", "1/2", "1", "2", "3"]
M = Multiprecision(30)
PLAIN = Setting("semi-lagrangian", "scni", "3/2", spacing="1/20")
RICH = replace(PLAIN, stress_ratio="1/4", velocity_gradient="1/2")
SEMI = [
    replace(RICH, integration=integration, convective=convective, half_point=half_point, derivative=derivative)
    for integration, convective, half_point, derivative in product(
        ("scni", "dni"), (True, False), ("literal", "edge"), DERIVATIVES
    )
]


def label(setting: Setting) -> str:
    return f"{setting.integration}-{'N' if setting.convective else 'no N'}-{setting.half_point}-{setting.derivative}"


def left_hand_side(setting: Setting) -> Callable[[object, object], object]:
    """The printed relation's left-hand side for the setting, as a function of kh and omega."""
    s = lattice_values(setting.spacing, setting.support_ratio, M, setting.half_point, setting.derivative)
    q = semi.State(M.number(1), M.number(setting.stress_ratio), M.number(1), M.number(setting.velocity_gradient))
    scni = setting.integration == "scni"
    if setting.convective:
        relation = semi.scni_relation if scni else semi.dni_relation
        return lambda kh, omega: relation(s, q, kh, omega, M)
    squared = semi.scni_omega_squared if scni else semi.dni_omega_squared
    return lambda kh, omega: omega**2 - squared(s, q, kh, M)


@pytest.mark.parametrize("setting", SEMI, ids=label)
def test_every_root_solves_the_printed_relation(setting: Setting) -> None:
    """(76), (82), (86) or (87), written out as printed, vanishes at the root as a complex number.

    omega is below 100 and the relation's terms below 1e5 at h = 1/20; fewer than 1000 operations: 1e8 epsilon.
    """
    relation = left_hand_side(setting)
    branches = dispersion(setting, KH, M)
    assert [b.root for b in branches] == [0, 1] * len(KH)
    for branch in branches:
        omega = M.context.mpc(branch.omega.re, branch.omega.im)
        assert abs(relation(branch.kh, omega)) < 1e8 * M.epsilon
        assert branch.omega.growth == -branch.omega.im
    assert all((branch.D is not None) == setting.convective for branch in branches)


def test_d_is_the_squared_distance_of_the_roots() -> None:
    """D = (omega_1 - omega_2)^2 at every kh: real and positive, or minus four times the squared growth."""
    for setting in (RICH, replace(RICH, integration="dni"), replace(RICH, stress_ratio="-2", velocity_gradient=0)):
        branches = dispersion(setting, KH, M)
        for one, other in zip(branches[::2], branches[1::2], strict=True):
            distance = M.context.mpc(one.omega.re - other.omega.re, one.omega.im - other.omega.im)
            assert abs(distance**2 - one.D) < 1e8 * M.epsilon
            assert one.D == other.D


@pytest.mark.parametrize("R", ["11/10", "3/2", 2, "7/2"])
@pytest.mark.parametrize("stress", ["-2", 0, "1/2"])
def test_lagrangian_frequencies_are_the_roots_of_63(R: object, stress: object) -> None:
    setting = Setting("lagrangian", "scni", R, stress, stretch="6/5")
    c_squared = M.number("6/5") ** 2 + M.number(stress)
    for branch in dispersion(setting, KH, M):
        squared = omega_squared(b_hat(1, R, M), c_squared, branch.kh, M)
        re, im = branch.omega.squared
        assert abs(re - squared) < 1e4 * M.epsilon
        assert im == 0
        assert branch.D is None
        assert (branch.omega.im != 0) == (c_squared < 0)


def frequencies(branches: list[Branch]) -> list[tuple[object, object]]:
    return [(b.omega.re, b.omega.im) for b in branches]


@pytest.mark.decides("E63")
@pytest.mark.parametrize("kernel", ["cubic", "quintic", "tent", "wendland-c2"])
def test_for_three_halves_the_frequency_is_a_sine(kernel: str) -> None:
    """Two nodes share each cell's edge equally, so the gradients are ± 1/(2h): omega = c |sin kh| / h, whatever the kernel."""
    setting = Setting("lagrangian", "scni", "3/2", "1/2", spacing="1/20", kernel=kernel)
    c = M.sqrt(M.ratio(3, 2))
    for branch in dispersion(setting, KH, M)[::2]:
        assert abs(branch.omega.re - 20 * c * abs(M.sin(branch.kh))) < 1e4 * M.epsilon


def test_the_twin_for_another_support() -> None:
    """At R = 2 four nodes reach an edge and the frequency is no longer the sine."""
    branch = dispersion(Setting("lagrangian", "scni", 2), ["1"], M)[0]
    assert abs(branch.omega.re - M.sin(M.number(1))) > 1e-3


def test_lagrangian_and_semi_lagrangian_meet_without_a_velocity_gradient() -> None:
    """R = 3/2, F = 1, Q = 0, the edge reading: (86) and (63) are the same frequency; as printed (`literal`) they are not."""
    lagrangian = frequencies(dispersion(Setting("lagrangian", "scni", "3/2", "1/4"), KH, M))
    for half_point, meet in (("edge", True), ("literal", False)):
        for convective in (True, False):
            setting = Setting("semi-lagrangian", "scni", "3/2", "1/4", convective=convective, half_point=half_point)
            gaps = [abs(p[0] - q[0]) for p, q in zip(frequencies(dispersion(setting, KH, M)), lagrangian, strict=True)]
            assert (max(gaps) < 1e4 * M.epsilon) == meet


@pytest.mark.parametrize("integration", ["scni", "dni"])
@pytest.mark.parametrize("formulation", ["lagrangian", "semi-lagrangian"])
def test_frequencies_go_with_the_inverse_spacing(formulation: str, integration: str) -> None:
    """At Q = 0 omega h depends on R and the stress alone: halving h doubles every bit of a double."""
    if (formulation, integration) == ("lagrangian", "dni"):
        return
    setting = Setting(formulation, integration, "3/2", "1/4", spacing="1/4")
    for half in (2, 8):
        finer = replace(setting, spacing=f"1/{4 * half}")
        coarse, fine = (frequencies(dispersion(s, [0.3, 1.1, 2.9], Float())) for s in (setting, finer))
        assert fine == [(half * re, half * im) for re, im in coarse]


def test_a_velocity_gradient_brings_its_own_time() -> None:
    """The twin: with Q the product omega h is another; scaling Q by 1/h as well restores it."""
    coarse, fine = (frequencies(dispersion(replace(RICH, spacing=h), [1.0])) for h in ("1/4", "1/8"))
    assert fine != [(2 * re, 2 * im) for re, im in coarse]
    both = replace(RICH, spacing="1/8", velocity_gradient=1)
    assert frequencies(dispersion(both, [1.0])) == [(2 * re, 2 * im) for re, im in coarse]


@pytest.mark.parametrize("setting", SEMI[::3], ids=label)
def test_doubles_agree_with_forty_digits(setting: Setting) -> None:
    """Fewer than 500 operations, a moment matrix with a condition below 50 at R = 3/2, omega = (-B ± sqrt D)/2.

    |error| <= 500 * 50 epsilon (|B| + |terms of D| / sqrt |D|); the terms of D are below 5 |D| at these kh.
    """
    kh = [0.5, 1.0, 2.0]
    for rounded, precise in zip(dispersion(setting, kh), dispersion(setting, kh, M), strict=True):
        size = abs(float(precise.omega.re)) + abs(float(precise.omega.im)) + 1
        allowed = 500 * 50 * 6 * Float.epsilon * size
        assert abs(rounded.omega.re - float(precise.omega.re)) <= allowed
        assert abs(rounded.omega.im - float(precise.omega.im)) <= allowed


def test_balls_enclose_the_frequencies() -> None:
    """Decides that certified curves are: the enclosure contains the value from 30 digits, and is narrow."""
    K = Ball(25)
    for setting in (RICH, replace(RICH, integration="dni"), Setting("lagrangian", "scni", "7/2")):
        for enclosed, precise in zip(dispersion(setting, KH, K), dispersion(setting, KH, M), strict=True):
            gap = enclosed.omega.re - K.number(M.text(precise.omega.re))
            assert not K.surely_positive(abs_gap := gap - K.number("1e-27"))
            assert not K.surely_positive(-abs_gap - 2 * K.number("1e-27"))
            assert float(enclosed.omega.re.value.rad()) < 1e-20
