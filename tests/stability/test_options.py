"""What an option does is measured against the default: the measure is zero where nothing changes and exact where it is known."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from rkverify.readings import Readings
from rkverify.stability.at_rest import at_rest
from rkverify.stability.layers import Setting
from rkverify.stability.options import CHOICES, VARIANTS, compared, motions, option_rows


def test_the_first_option_is_the_default_and_is_no_distance_from_itself() -> None:
    defaults = Readings("scni")
    assert {choice: options[0] for choice, options in CHOICES.items()} == {
        name: getattr(defaults, name) for name in CHOICES
    }
    rows = option_rows([Setting("semi-lagrangian", "scni", "3/2", "1/2", layer="as-defined")], 2)
    firsts = {choice: next(iter(options)) for choice, options in VARIANTS.items()}
    assert all(row["away"] == 0 for row in rows if row["option"] == firsts[row["choice"]])
    # SCNI has no derivative of a shape function: every reading of it is the same relation.
    assert max(row["away"] for row in rows if row["choice"] == "derivative") == 0
    assert max(row["growth"] for row in rows) < 1e-6


@pytest.mark.parametrize("stress", [0.5, -0.5])
def test_the_stress_law_moves_frequencies_by_the_root_of_its_moduli(stress: float) -> None:
    """omega^2 of SCNI is the tangent times the same square: C + sigma with Truesdell's rate, C with Cauchy's."""
    setting = Setting("semi-lagrangian", "scni", "3/2", stress, layer="as-defined")
    rows = option_rows([setting], 4)
    away = next(row["away"] for row in rows if row["option"] == "cauchy-rate")
    assert away == pytest.approx(abs(sqrt(1 / (1 + stress)) - 1), rel=1e-9)


def test_motions_are_the_roots_of_the_relation() -> None:
    """(86) at R = 3/2, kh = pi/2: omega^2 = C + sigma."""
    found = motions(Setting("semi-lagrangian", "scni", "3/2", "1/2", layer="as-defined"), [pi / 2])
    assert sorted(omega.real for omega in found[0]) == pytest.approx([-sqrt(1.5), sqrt(1.5)], rel=1e-9)


def test_the_stress_that_is_carried_along_is_no_motion() -> None:
    """On a base that stretches the relation has a third root, omega = -i Q: the smallest, and not one of the two."""
    Q = 0.1
    found = motions(
        Setting("semi-lagrangian", "scni", "3/2", "1/2", velocity_gradient="1/10", layer="as-defined"), [pi / 2, 2.0]
    )
    assert [len(pair) for pair in found] == [2, 2]
    assert min(abs(omega) for pair in found for omega in pair) > 10 * Q


def test_growth_is_that_of_the_sign_that_grows_and_distances_are_shares() -> None:
    """e^{i omega t} grows where Im omega is negative; a distance is told over the largest frequency of the default."""
    found = compared([[4, -4], [2, -2]], [[4 + 0.5j, -4], [2, -2 - 0.25j]])
    assert found == {"growth": 0.25, "away": 0.5 / 4}


def test_rows_are_those_of_their_waves() -> None:
    """Growth and distance at kh = pi/3, 2 pi/3, pi by the undamped relation: DNI in tension grows, by how much depends on the option."""
    settings = [
        Setting("semi-lagrangian", "dni", R, "1/2", layer="as-defined", convective=False) for R in ("3/2", "9/5")
    ]
    rows = [row for row in option_rows(settings, 3) if row["choice"] in CHOICES]
    count = sum(len(options) for options in CHOICES.values())
    assert len(rows) == 2 * count
    kh = pi * np.arange(1, 4) / 3

    def roots(setting: Setting) -> np.ndarray:
        return np.sqrt(at_rest(setting).omega_squared(0.5, kh).astype(complex))

    for setting, part in zip(settings, (rows[:count], rows[count:]), strict=True):
        default = roots(setting)
        for row in part:
            if row["choice"] in ("mass", "node_motion"):
                continue
            mine = roots(replace(setting, **{row["choice"]: row["option"]}))
            away = np.minimum(abs(mine - default), abs(mine + default)).max() / abs(default).max()
            # the square root of rounding, where a root is double
            assert abs(row["growth"] - abs(mine.imag).max()) < 1e-6
            assert abs(row["away"] - away) < 1e-6
    assert max(row["growth"] for row in rows) > 0.1
    assert len({round(row["away"], 6) for row in rows}) > 5


def test_what_moves_nodes_and_masses_is_a_choice_too() -> None:
    rows = option_rows([Setting("semi-lagrangian", "dni", "9/5", "1/4", layer="as-defined")], 2)
    away = {(row["choice"], row["option"]): row["away"] for row in rows}
    assert away["mass", "consistent"] > 1e-2
    assert away["node_motion", "field"] > 1e-2


@pytest.mark.parametrize("Q", [0, "1/10"])
def test_options_of_the_print_and_of_n_are_those_of_their_layers(Q: str | int) -> None:
    """N does nothing to a wave at rest and something in motion, and C(h/2) is one of (75): each against its own relation."""
    setting = Setting("semi-lagrangian", "scni", "7/4", "1/2", velocity_gradient=Q, layer="as-defined")
    rows = {(row["choice"], row["option"]): row for row in option_rows([setting], 3)}
    kh = [pi * n / 3 for n in range(1, 4)]
    relations = {
        ("convection", "true"): replace(setting, layer="consistent"),
        ("convection", "none"): replace(setting, convective=False),
        ("half_point", "literal"): replace(setting, layer="printed", half_point="literal"),
    }
    for key, other in relations.items():
        default = replace(setting, layer="printed") if key[0] == "half_point" else setting
        assert rows[key]["away"] == compared(motions(default, kh), motions(other, kh))["away"]
    moved = {key: rows[key]["away"] > 1e-3 for key in relations}
    assert moved == {key: key[0] == "half_point" or Q != 0 for key in relations}
