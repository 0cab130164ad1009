"""What an option does is measured against the default: the measure is zero where nothing changes and exact where it is known."""

from math import pi, sqrt

import pytest

from rkverify.readings import Readings
from rkverify.stability.layers import Setting
from rkverify.stability.options import CHOICES, motions, option_rows


def test_the_first_option_is_the_default_and_is_no_distance_from_itself() -> None:
    defaults = Readings("scni")
    assert {choice: options[0] for choice, options in CHOICES.items()} == {
        name: getattr(defaults, name) for name in CHOICES
    }
    rows = option_rows([Setting("semi-lagrangian", "scni", "3/2", "1/2", layer="as-defined")], 2)
    assert all(row["away"] == 0 for row in rows if row["option"] == CHOICES[row["choice"]][0])
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
