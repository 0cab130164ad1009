"""What is read off a measured motion: which wave fits on a chain, and how much of it is in positions and velocities."""

from dataclasses import replace
from fractions import Fraction
from math import pi

import numpy as np
import pytest

from rkverify.readings import Readings
from rkverify.stability.jacobian_solid import base_chain
from rkverify.stability.lattice_state import Base
from rkverify.stability.simulate import GROWTH_LIMIT, LARGEST_CHAIN, _amplitudes, fitting_wave, measure_flow


@pytest.mark.parametrize(
    ("turns", "least", "found"),
    [("1/4", 5, (8, 2)), ("1/2", 5, (6, 3)), ("1/7", 4, (7, 1)), ("3/7", 8, (14, 6)), ("1/3", 9, (9, 3))],
)
def test_a_wave_that_fits_is_on_the_shortest_chain(turns: str, least: int, found: tuple[int, int]) -> None:
    """kh = 2 pi n/N exactly: of the chains that hold it, and are no shorter than the least, the shortest."""
    assert fitting_wave(2 * pi * float(Fraction(turns)), least) == found


@pytest.mark.parametrize("kh", [0.3, 1.0, 2.0, 3.0])
def test_no_chain_holds_a_wave_that_is_nearer(kh: float) -> None:
    """Against all quotients: 2 pi n/N for every chain and every number of waves on it."""
    count, waves = fitting_wave(kh, 10)
    assert 10 <= count <= LARGEST_CHAIN
    every = [2 * pi * n / N for N in range(10, LARGEST_CHAIN + 1) for n in range(N // 2 + 1)]
    assert abs(2 * pi * waves / count - kh) <= min(abs(other - kh) for other in every) + 1e-12


def test_amplitudes_are_those_of_their_wave_alone() -> None:
    """a cos + b sin is (a - i b)/2 of e^{i kh I} and as much of its mirror image; a translation and other waves are none of it."""
    _, still = base_chain(Base("3/2", Readings("scni")), 12)
    kh, node = pi / 3, np.arange(12)
    x = still.x + 0.3 * np.cos(kh * node) + 0.1 * np.sin(kh * node) + 0.7 + 0.2 * np.cos(2 * kh * node)
    v = still.v - 0.4 * np.sin(kh * node) + 0.5
    found = _amplitudes([still, replace(still, x=x, v=v)], still, kh)
    np.testing.assert_allclose(found, [[0, 0], [0.15 - 0.05j, 0.2j]], rtol=0, atol=1e-14)


def test_a_wave_is_followed_no_further_than_its_equations_are_linear() -> None:
    """Growth 5 up to a few hundred times the push; beyond, nothing pushes any more, and the run must not go there."""
    count, kh, push = 8, pi / 2, 1e-6

    def slope(_: float, z: np.ndarray) -> np.ndarray:
        x, v = z[:count], z[count:]
        return np.concatenate([v, np.where(abs(v) < 3 * GROWTH_LIMIT * push, 25 * x, 0)])

    found = measure_flow(slope, np.zeros(2 * count), count, kh, 0.06, push)
    assert abs(max(root.growth for root in found.roots) - 5) < 1e-6
    assert found.uncertainty < 1e-5
