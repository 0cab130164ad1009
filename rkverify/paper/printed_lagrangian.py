"""Section 4.1 as printed: stress (53)-(55), (59), stencil (61), plane wave (62) and dispersion relation (63), (64)."""

from collections.abc import Callable

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.cells import lattice_cell
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.numbered import equation


@equation(55)
def green_strain(F: Scalar) -> Scalar:
    """E = (F^2 - 1)/2   (55)."""
    return (F * F - 1) / 2


@equation(54)
def second_piola_kirchhoff(modulus: Scalar, E: Scalar) -> Scalar:
    """S = C^SE E, the sum of the increments Delta S = C^SE Delta E from the unstressed state   (54)."""
    return modulus * E


@equation(53)
def first_piola_kirchhoff(S: Scalar, F: Scalar) -> Scalar:
    """P = S F   (53)."""
    return S * F


@equation(59)
def tangent(modulus: Scalar, F: Scalar, S: Scalar) -> Scalar:
    """C^SE F^2 + S, the factor of f~ in P~   (59); a stress."""
    return modulus * F * F + S


def bandwidth(support_ratio: Scalar, K: Arithmetic) -> int:
    """m = int(R + 0.5), below (61)."""
    return int(K.witness(K.number(support_ratio) + K.ratio(1, 2)))


@equation(64)
def b_hat(
    spacing: Scalar, support_ratio: Scalar, K: Arithmetic, kernel_name: str = "cubic", order: int = 1
) -> list[Scalar]:
    """b^_K = b_I^{I+K-m-1} for K = 1, …, 2m+1: the smoothed gradients (52) of one shape function over its cells   (64)."""
    m = bandwidth(support_ratio, K)
    A = lattice(spacing, support_ratio, m + 1, K, kernel_name, order)
    h, I = K.number(spacing), middle(A)
    return [smoothed_gradient(A, lattice_cell(J * h, h)).get(I, K.zero()) for J in range(-m, m + 1)]


@equation(61)
def stencil_acceleration(b: list[Scalar], c_squared: Scalar, displacement: Callable[[int], Scalar]) -> Scalar:
    """u_I'' = -c^2 sum_K b_I^{I+K} sum_J b_I^{I-J} u_{I+J+K} with c^2 = (C^SE F^2 + S)/rho_0   (61).

    displacement(n) is u_{I+n}; b is the list of (64).
    """
    m = len(b) // 2
    total = 0
    for K in range(-m, m + 1):
        for J in range(-m, m + 1):
            total = total + b[K + m] * b[m - J] * displacement(J + K)
    return -c_squared * total


@equation(63)
def omega_squared(b: list[Scalar], c_squared: Scalar, kh: Scalar, K: Arithmetic) -> Scalar:
    """omega^2 = c^2 sum_K b^_K sum_L b^_L cos((K - L) k h)   (63); 1/time^2."""
    # cos((K - L) kh) depends on the difference alone: each cosine is taken once.
    size = len(b)
    cosine = {n: K.cos(n * kh) for n in range(size)}
    total = K.zero()
    for k in range(size):
        inner = K.zero()
        for j in range(size):
            inner = inner + b[j] * cosine[abs(k - j)]
        total = total + b[k] * inner
    return c_squared * total
