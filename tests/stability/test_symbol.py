"""Symbols of stencils that are no mirror images of themselves: signs of phases and of growth that a lattice's own stencils do not show."""

from math import isclose, pi

import numpy as np
import pytest

from rkverify.arithmetic.native import Float
from rkverify.readings import Readings
from rkverify.stability.lattice_state import Base
from rkverify.stability.symbol import eigenvalue_roots, omega_squared_at_rest, symbol, transform

REST = Base("3/2", Readings("scni"))
MOVING = Base("3/2", Readings("scni"), velocity_gradient="1/10")
KH = pi / 3


def stencils(**given):
    """Every pair of kinds, empty but for those given as row_column."""
    empty = {(row, column): {} for row in REST.kinds for column in REST.kinds}
    return {**empty, **{tuple(name.split("_")): values for name, values in given.items()}}


def test_the_transform_is_the_sum_of_its_waves():
    """sum_n c_n e^{i n kh}: a mirrored stencil has the conjugate, which cosines alone would not tell."""
    coefficients = {-2: 0.3, 0: 1.5, 1: -0.7, 3: 0.2}
    found = transform(coefficients, KH, Float())
    expected = sum(c * np.exp(1j * n * KH) for n, c in coefficients.items())
    assert abs(complex(found.re, found.im) - expected) < 1e-15
    assert abs(expected.imag) > 0.1


def test_entries_are_transforms_and_accelerations_are_over_the_mass():
    uneven = {-1: 0.2, 0: 1.0, 1: 0.6}
    stencil = {**stencils(x_v={0: 1.0}, v_x=uneven, stress_v={1: 0.5}), ("mass", "v"): {0: 0.8, 1: 0.3}}
    A = symbol(REST, stencil, KH)
    wave = np.exp(1j * KH)
    expected = np.zeros((3, 3), complex)
    expected[0, 1], expected[2, 1] = 1, 0.5 * wave
    expected[1, 0] = (0.2 / wave + 1 + 0.6 * wave) / (0.8 + 0.3 * wave)
    np.testing.assert_allclose(A, expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("base", [REST, MOVING], ids=["at rest", "in motion"])
def test_roots_solve_the_equation_and_the_growing_one_is_first(base):
    """x'' = 4 x of the next node: lambda^2 = 4 e^{i kh}, omega = -i lambda, and e^{i omega t} grows at -Im omega.

    At rest the third eigenvalue, zero, is no motion and is left out; in motion it stays.
    """
    roots = eigenvalue_roots(base, stencils(x_v={0: 1.0}, v_x={1: 4.0}), KH)
    assert len(roots) == (2 if base is REST else 3)
    first, last = (complex(root.re, root.im) for root in (roots[0], roots[-1]))
    expected = -2j * np.exp(1j * KH / 2)
    assert abs(first - expected) < 1e-14
    assert abs(last + expected) < 1e-14
    assert isclose(roots[0].growth, 2 * np.cos(KH / 2), rel_tol=1e-14)


def test_the_square_at_rest_is_what_positions_and_what_follows_them_pull():
    """- (v_x + v_stress stress_v)/m, with the products of complex transforms: odd stencils give minus a product of sines."""
    odd = {-1: -0.5, 1: 0.5}  # i sin(kh)
    stencil = stencils(x_v={0: 1.0}, v_x={-1: 1.0, 0: -2.0, 1: 1.0}, v_stress=odd, stress_v={-1: -1.5, 1: 1.5})
    expected = 2 - 2 * np.cos(KH) + 3 * np.sin(KH) ** 2
    found = omega_squared_at_rest(REST, stencil, KH, Float())
    assert abs(found - expected) < 1e-14
    heavy = {**stencil, ("mass", "v"): {-1: 0.25, 0: 1.5, 1: 0.25}}
    assert abs(omega_squared_at_rest(REST, heavy, KH, Float()) - expected / (1.5 + 0.5 * np.cos(KH))) < 1e-14
    # the eigenvalues of the same symbol: +omega and -omega
    for root in eigenvalue_roots(REST, stencil, KH):
        assert abs(root.squared[0] - expected) < 1e-12
