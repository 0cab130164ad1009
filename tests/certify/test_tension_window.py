"""The stable window of DNI in tension: exact polynomials against the whole relation at many waves.

A window that ended elsewhere would show as a wave that grows inside it, or as none that does beyond.
"""

from fractions import Fraction

import numpy as np
import pytest

from rkverify.certify.tension_window import greatest_tension, least, window_end
from rkverify.errors import BadInput
from rkverify.stability.layers import Setting, dispersion

F = Fraction
KH = np.linspace(0.02, np.pi, 200)


def grows(R: str, s: str) -> bool:
    setting = Setting("semi-lagrangian", "dni", R, stress_ratio=s, layer="as-defined", convective=False)
    return max(b.omega.growth for b in dispersion(setting, KH)) > 1e-4


def test_the_window_ends_where_a_wave_inside_the_range_first_grows() -> None:
    R, kh = window_end(F(11, 5), F(12, 5), bits=20)
    assert 0 < kh < 3.1
    assert not grows(str(R - F(1, 100)), "1000")
    assert grows(str(R + F(1, 100)), "1000")


@pytest.mark.parametrize("R", ["5/2", "3"])
def test_the_greatest_tension_is_where_growth_begins(R: str) -> None:
    limit = F(str(greatest_tension(F(R)).evalf(15)))
    assert not grows(R, str(limit * F(999, 1000)))
    assert grows(R, str(limit * F(1001, 1000)))


def test_inside_the_window_no_tension_is_too_great() -> None:
    assert least(F(7, 4))[0] > 0
    assert greatest_tension(F(7, 4)) is None
    assert least(F(3, 2))[0] < 0


def test_ends_on_one_side_are_refused() -> None:
    with pytest.raises(BadInput, match="other ends"):
        window_end(F(17, 10), F(9, 5))
