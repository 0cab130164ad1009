"""Every kernel in turn, and each kernel's pieces written down a second time, without the library's data."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from rkverify.kernels import KERNELS, Kernel

Pieces = Callable[[Fraction], Fraction]
TENT, CUBIC, QUARTIC, QUINTIC = 2, 4, 5, 6  # the orders of the B-splines


@pytest.fixture(scope="session", params=KERNELS.values(), ids=lambda k: k.name)
def kernel(request: pytest.FixtureRequest) -> Kernel:
    """Each kernel; scope session, so that hypothesis may use it."""
    return request.param


@pytest.fixture(scope="session")
def independent(kernel: Kernel) -> Pieces:
    """The same kernel from its textbook definition, exactly."""
    return INDEPENDENT[kernel.name]


@pytest.fixture(scope="session")
def interpolated() -> Callable[[Pieces, Fraction, Fraction, int], list[Fraction]]:
    """(f, low, high, degree) -> the coefficients, about `low`, of the polynomial that f is between low and high."""
    return _interpolated


def b_spline(order: int) -> Pieces:
    """The central B-spline by the recursion of Cox and de Boor, support |q| < order/2, on z = q / (order/2)."""

    def value(n: int, q: Fraction) -> Fraction:
        if n == 1:
            return Fraction(-Fraction(1, 2) <= q < Fraction(1, 2))
        half, step = Fraction(n, 2), Fraction(1, 2)
        return ((half + q) * value(n - 1, q + step) + (half - q) * value(n - 1, q - step)) / (n - 1)

    return lambda z: value(order, z * Fraction(order, 2))


def inside(polynomial: Pieces) -> Pieces:
    return lambda z: polynomial(z) if z < 1 else Fraction(0)


INDEPENDENT: dict[str, Pieces] = {
    "tent": b_spline(TENT),
    "cubic": b_spline(CUBIC),
    "quartic": b_spline(QUARTIC),
    "quintic": b_spline(QUINTIC),
    "wendland-c2": inside(lambda z: (1 - z) ** 4 * (1 + 4 * z)),
    "wendland-c4": inside(lambda z: (1 - z) ** 6 * (1 + 6 * z + Fraction(35, 3) * z**2)),
}


def _interpolated(f: Pieces, low: Fraction, high: Fraction, degree: int) -> list[Fraction]:
    """Newton's divided differences at points inside ]low, high[, expanded about `low`."""
    places = [(high - low) * Fraction(j + 1, degree + 2) for j in range(degree + 1)]
    table = [f(low + t) for t in places]
    for level in range(1, degree + 1):
        for j in range(degree, level - 1, -1):
            table[j] = (table[j] - table[j - 1]) / (places[j] - places[j - level])
    coefficients = [Fraction(0)]
    for place, top in zip(reversed(places), reversed(table), strict=True):
        shifted = [Fraction(0), *coefficients]
        coefficients = [s - place * c for s, c in zip(shifted, [*coefficients, Fraction(0)], strict=True)]
        coefficients[0] += top
    return coefficients[: degree + 1]
