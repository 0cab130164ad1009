"""Growth by layer: the rows on which every stability claim is judged."""

from math import pi

import pytest

from rkverify.stability.layers import Setting, dispersion
from rkverify.stability.verdicts import cutoff_force, largest_growth, late_frequency, measured_growth, measured_row


def test_growth_on_either_side_of_the_turn() -> None:
    """DNI in tension grows at R = 3/2 and not at R = 7/4, where compression does: each row must be able to be the other."""
    for R, s, grows in (("3/2", "1/2", True), ("7/4", "1/2", False), ("7/4", "-1/2", True), ("3/2", "-1/2", False)):
        setting = Setting("semi-lagrangian", "dni", R, stress_ratio=s, layer="as-defined")
        assert largest_growth(setting, 12)["unstable"] == grows
        assert measured_growth(setting, [pi])["unstable"] == grows


def test_a_moving_base_must_be_outgrown() -> None:
    """The stress mode of the frozen base grows exactly at the rate Q, which counts as no growth."""
    setting = Setting("semi-lagrangian", "scni", "3/2", velocity_gradient="1/10", layer="as-defined", convective=False)
    row = largest_growth(setting, 12)
    assert abs(row["growth"] - 0.1) < 1e-6
    assert not row["unstable"]


@pytest.mark.decides("E65", "E56")
@pytest.mark.parametrize("formulation", ["lagrangian", "semi-lagrangian"])
@pytest.mark.parametrize(("s", "quantity"), [("-3/2", "growth"), ("1/2", "frequency")])
def test_measured_rows_say_what_they_measured(formulation: str, s: str, quantity: str) -> None:
    row = measured_row(Setting(formulation, "scni", "3/2", stress_ratio=s, convective=False), 7 * pi / 8)
    assert row["quantity"] == quantity
    assert row["agrees"]
    assert abs(row["factor"] - 1) < 1e-9


def test_the_mass_changes_the_frequency_and_not_the_verdict() -> None:
    for formulation in ("lagrangian", "semi-lagrangian"):
        of = {}
        for mass in ("lumped", "consistent"):
            for layer in ("as-defined", "simulated"):
                setting = Setting(formulation, "scni", "7/4", mass=mass, layer=layer)
                of[mass, layer] = max(abs(b.omega.re) for b in dispersion(setting, [3 * pi / 8]))
        assert abs(of["consistent", "simulated"] - of["consistent", "as-defined"]) < 1e-6
        assert of["consistent", "as-defined"] > 1.05 * of["lumped", "as-defined"]


@pytest.mark.decides("C30")
@pytest.mark.parametrize("R", ["11/10", "3/2", "7/4", "7/2"])
def test_nothing_holds_the_wave_at_pi(R: str) -> None:
    assert cutoff_force(R)


@pytest.mark.decides("C32")
def test_the_frequency_before_pi_falls_with_the_support() -> None:
    shares = [row["measured"] / row["peak"] for row in (late_frequency(R, 24) for R in ("11/10", "7/2"))]
    assert shares[1] < 0.05 < shares[0]
