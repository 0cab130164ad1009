"""Moments of kernels, exact, against the integral of the pieces and against adaptive quadrature at 30 digits."""

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

import mpmath
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.kernels import Kernel
from rkverify.kernels import kernel as named

Pieces = Callable[[Fraction], Fraction]
Interpolated = Callable[[Pieces, Fraction, Fraction, int], list[Fraction]]
DEGREES = [0, 1, 2, 5]
HIGHEST = 8


@pytest.mark.parametrize("degree", DEGREES)
def test_moments_are_the_integrals_of_the_pieces(
    kernel: Kernel, independent: Pieces, interpolated: Interpolated, degree: int
) -> None:
    """z^k phi(z) is a polynomial between joints: interpolated from the textbook kernel and integrated term by term."""
    total = Fraction(0)
    for low, high in pairwise((Fraction(0), *kernel.joints)):
        coefficients = interpolated(lambda z: z**degree * independent(z), low, high, HIGHEST + degree)
        total += sum((c * (high - low) ** (n + 1) / (n + 1) for n, c in enumerate(coefficients)), Fraction(0))
    assert kernel.phi.moment(degree) == total


@pytest.mark.parametrize("degree", DEGREES)
def test_moments_are_those_of_quadrature(kernel: Kernel, degree: int) -> None:
    """Gauss-Legendre between joints at 30 digits is exact for these degrees but for rounding, 100 operations of 1e-40."""
    K = Multiprecision(30)
    joints = [K.number(b) for b in (Fraction(0), *kernel.joints)]
    found = K.context.quad(lambda z: z**degree * kernel.phi(z, K), joints, method="gauss-legendre")
    assert abs(found - K.number(kernel.phi.moment(degree))) < mpmath.mpf(10) ** -37


@pytest.mark.parametrize(("name", "order"), [("tent", 2), ("cubic", 4), ("quartic", 5), ("quintic", 6)])
def test_b_splines_integrate_to_one_in_their_own_spacing(name: str, order: int) -> None:
    """The B-spline of order n has integral 1 on |q| < n/2, hence 1/n on 0 < z < 1, and variance n/12 in q."""
    phi = named(name).phi
    assert phi.moment(0) == Fraction(1, order)
    assert 2 * phi.moment(2) * Fraction(order, 2) ** 3 == Fraction(order, 12)


def test_the_moment_of_a_derivative_is_that_by_parts(kernel: Kernel) -> None:
    """Integration by parts: the integral of phi' is -phi(0), that of z phi' is minus that of phi."""
    slope = kernel.phi.derivative()
    assert slope.moment(0) == -kernel.phi.at_zero()
    assert slope.moment(1) == -kernel.phi.moment(0)
