"""Growth by layer: the rows on which every stability claim is judged."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.stability.at_rest import at_rest
from rkverify.stability.layers import Setting, dispersion
from rkverify.stability.simulate import fitting_wave
from rkverify.stability.verdicts import (
    cutoff_force,
    largest_growth,
    late_frequency,
    measured_growth,
    measured_row,
    waves,
)


def test_waves_end_at_the_shortest() -> None:
    """kh = pi is where DNI grows first: left out, the growth of a survey would be that of another wave."""
    assert waves(4) == [pi / 4, pi / 2, 3 * pi / 4, pi]
    setting = Setting("semi-lagrangian", "dni", "3/2", stress_ratio="1/2", layer="as-defined")
    assert largest_growth(setting, 12)["kh"] == pi


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


@pytest.mark.parametrize("h", ["1", "1/20"])
def test_unstable_is_what_grows_faster_than_three_times_the_base(h: str) -> None:
    """Growth between 2 and 3 |Q| is left open, growth beyond 3 |Q| is not, for either sign of Q and whatever the spacing."""
    seen = set()
    unit = 1.0 if h == "1" else 0.05
    for Q in (0.1 / unit, -0.1 / unit):
        for s in np.linspace(0.01, 0.08, 5):
            setting = Setting("semi-lagrangian", "dni", "3/2", float(s), 1, Q, h, layer="as-defined", convective=False)
            row = largest_growth(setting, 8)
            own = max(b.omega.growth for b in dispersion(setting, waves(8))) * float(row["growth"] > 0)
            assert abs(row["growth"] - own * unit) < 1e-6
            share = row["growth"] / 0.1
            assert row["unstable"] == (share > 3)
            seen.add(int(share))
    assert {2, 3} <= seen


def test_rows_of_what_does_not_grow_are_zero() -> None:
    """Zeros and no wave, computed or measured; and the imaginary part of what grows is its growth."""
    calm = Setting("semi-lagrangian", "scni", "7/4", "1/2", layer="as-defined", convective=False)
    for row in (largest_growth(calm, 6), measured_growth(calm, [pi / 2])):
        assert (row["growth"], row["kh"], row["imaginary"], row["unstable"]) == (0, 0, 0, False)
        assert (row["support_ratio"], row["stress_ratio"], row["Q"], row["V"], row["stretch"]) == (
            "7/4", "1/2", "0", "0", "1",
        )  # fmt: skip
    wild = replace(calm, integration="dni", stress_ratio="-1/2", spacing="1/10")
    computed, measured = largest_growth(wild, 6), measured_growth(wild, [pi / 2, pi])
    relation = at_rest(replace(wild, spacing=1))
    exact = sqrt(-relation.omega_squared(-0.5, np.array([pi]))[0])
    for row, error in ((computed, 1e-9), (measured, 1e-4)):
        assert abs(row["growth"] - exact) < error
        assert row["imaginary"] == pytest.approx(row["growth"], rel=1e-6)
        assert row["kh"] == pi
        assert row["unstable"]
    assert (computed["layer"], measured["layer"], computed["spacing"]) == ("as-defined", "simulated", "1/10")


def test_the_moving_roots_are_told_from_the_stress_that_is_carried() -> None:
    """omega = -i Q is the stress, whose growth is no root of the motion: left out of `imaginary`, kept in `growth`."""
    setting = Setting(
        "semi-lagrangian", "scni", "3/2", "1/2", velocity_gradient="1/10", layer="as-defined", convective=False
    )
    row = largest_growth(setting, 6)
    apart = []
    for theta in waves(6):
        roots = [complex(b.omega.re, b.omega.im) for b in dispersion(setting, [theta])]
        apart.append(max(abs(w.imag) for w in sorted(roots, key=lambda w: abs(w + 0.1j))[1:]))
    assert abs(row["imaginary"] - max(apart)) < 1e-9
    assert abs(row["growth"] - 0.1) < 1e-6


def test_factors_of_print_and_what_agrees() -> None:
    """DNI at R = 7/4: computed by the relation at rest, printed by its own; no printed value for the Lagrangian DNI."""
    setting = Setting("semi-lagrangian", "dni", "7/4", stress_ratio="1/2", convective=False)
    row = measured_row(setting, pi / 2)
    kh = np.array([row["kh"]])
    computed = sqrt(at_rest(replace(setting, layer="as-defined")).omega_squared(0.5, kh)[0])
    printed = sqrt(at_rest(setting).omega_squared(0.5, kh)[0])
    assert abs(row["computed"] - computed) < 1e-9
    assert abs(row["measured"] - computed) < 1e-5
    assert abs(row["printed"] - printed) < 1e-9
    assert abs(row["factor"] - printed / computed) < 1e-9
    assert row["quantity"] == "frequency"
    assert row["agrees"]
    bar = measured_row(Setting("lagrangian", "dni", "7/4", stretch="6/5"), pi / 2)
    assert bar["printed"] is bar["factor"] is None
    assert bar["agrees"]
    assert (bar["stretch"], bar["kernel"]) == ("6/5", "cubic")


@pytest.mark.parametrize("formulation", ["lagrangian", "semi-lagrangian"])
def test_the_consistent_mass_divides_at_many_digits_as_in_doubles(formulation: str) -> None:
    """omega^2 through `paper/` at 30 digits and by the eigenvalues of `solid/`; the twin with the lumped mass is another number."""
    of = {}
    for mass in ("lumped", "consistent"):
        setting = Setting(formulation, "dni", "7/4", "1/3", mass=mass, layer="as-defined")
        many = dispersion(setting, ["1.3"], Multiprecision(30))
        double = dispersion(setting, [1.3])
        of[mass] = max(abs(float(b.omega.re)) for b in many)
        assert abs(of[mass] - max(abs(b.omega.re) for b in double)) < 1e-9
    assert of["consistent"] > 1.05 * of["lumped"]


def test_the_late_frequency_is_that_of_its_wave() -> None:
    """Measured near 0.9 pi; the peak over the samples: both by (63), which is exact for SCNI (C33)."""
    row = late_frequency("7/4", 24)
    relation = at_rest(Setting("lagrangian", "scni", "7/4", layer="as-defined"))
    assert abs(row["kh"] - 0.9 * pi) < 0.05
    assert abs(row["measured"] - sqrt(relation.omega_squared(0.0, np.array([row["kh"]]))[0])) < 1e-5
    peak = sqrt(relation.omega_squared(0.0, np.array(waves(24))).max())
    assert abs(row["peak"] - peak) < 1e-9


def test_the_wave_that_fits_is_the_nearest_on_the_shortest_chain() -> None:
    """By brute force over all chains from the least to 96 nodes; of equally near ones that of fewer nodes."""
    assert fitting_wave(pi, 7) == (8, 4)
    assert fitting_wave(pi, 8) == (8, 4)
    assert fitting_wave(2 * pi * 5 / 96, 10) == (96, 5)
    for kh in (0.9 * pi, 7 * pi / 8, 1.0, 2 * pi * 5 / 97, 0.2):
        count, waves = fitting_wave(kh, 11)
        gaps = {(N, n): abs(2 * pi * n / N - kh) for N in range(11, 97) for n in range(1, N // 2 + 1)}
        assert abs(gaps[count, waves] - min(gaps.values())) < 1e-11
        assert count == min(N for (N, _), gap in gaps.items() if gap < min(gaps.values()) + 1e-12)
