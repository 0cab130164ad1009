"""What N does to the base, in exact rationals: an equality here is no matter of tolerance."""

from fractions import Fraction

import pytest

from rkverify.certify.base_state import (
    convected,
    convective_forces,
    long_wave_modulus,
    neglected_mass,
    rate_sums,
    uniform_stress_force,
)

F = Fraction
RATIOS = [F(11, 10), F(3, 2), F(7, 4), F(5, 2)]


@pytest.mark.decides("C26")
@pytest.mark.parametrize("R", RATIOS)
def test_the_true_rates_sum_to_zero_and_psi_star_does_not(R: Fraction) -> None:
    """Shape functions sum to one at any time, so that their rates sum to zero: Psi* cannot be the rate of one."""
    star, true = rate_sums(R)
    assert true == 0
    assert star < 0


def test_the_sum_of_psi_star_by_hand() -> None:
    """R = 3/2: C(h) phi'(z) z at z = 2/3 on either side, over M = phi(0) + 2 phi(2/3): 2 (-8/27)/(2/3 + 8/81) = -24/31."""
    assert rate_sums(F(3, 2))[0] == F(-24, 31)


@pytest.mark.decides("E65")
@pytest.mark.parametrize("R", RATIOS)
def test_psi_star_accelerates_the_base_by_its_sum(R: Fraction) -> None:
    """Two routes to one number: the sum of the rates, and the acceleration by the whole equations."""
    star, _ = rate_sums(R)
    assert convected(R, "psi-star").base_acceleration == -star
    assert convected(R, "psi-star").common_velocity == -star
    assert convected(R, "true").base_acceleration == convected(R, "true").common_velocity == 0


@pytest.mark.decides("C35", "E73")
@pytest.mark.parametrize(
    ("convection", "V", "exact"), [("none", 1, True), ("true", 1, True), ("psi-star", 0, True), ("psi-star", 1, False)]
)
def test_73_is_complete_where_the_base_does_not_accelerate(convection: str, V: int, exact: bool) -> None:
    lost = neglected_mass(F(7, 4), F(1, 3), F(1, 5), F(V), convection)
    assert (lost == 0) == exact


@pytest.mark.decides("C1", "C68")
def test_n_is_zero_in_translations_and_with_the_true_rate_in_stretching() -> None:
    assert convective_forces("rigid translation", "psi-star") == convective_forces("rigid translation", "true") == 0
    assert convective_forces("stretching v = x - 5", "psi-star") > 0
    assert convective_forces("stretching v = x - 5", "true") == 0
    assert convective_forces("bending v = x^2", "true") > 0


def test_a_uniform_stress_leaves_no_force_with_scni_and_one_with_dni() -> None:
    """The shape functions' values at the cell edges cancel from cell to cell, whatever the positions."""
    assert uniform_stress_force("scni") == 0
    assert uniform_stress_force("dni") > 0


@pytest.mark.decides("C41")
@pytest.mark.parametrize(("law", "modulus"), [("truesdell", F(4, 3)), ("cauchy-rate", F(1)), ("literal", F(2, 3))])
def test_the_modulus_of_long_waves(law: str, modulus: Fraction) -> None:
    for integration in ("scni", "dni"):
        assert {long_wave_modulus(R, F(1, 3), law, integration) for R in RATIOS[:3]} == {modulus}
