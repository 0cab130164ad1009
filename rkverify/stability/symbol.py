"""From a stencil to growth: the Fourier symbol of the linearised equations and its eigenvalues."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import rational
from rkverify.stability.jacobian_paper import Stencil
from rkverify.stability.lattice_state import Base
from rkverify.stability.roots import Root


@dataclass(frozen=True)
class Wave:
    """A complex number in a real arithmetic, for sums over e^{i n kh}."""

    re: Scalar
    im: Scalar


def transform(coefficients: dict[int, Scalar], kh: Scalar, K: Arithmetic) -> Wave:
    """sum_n c_n e^{i n kh}."""
    re, im = K.zero(), K.zero()
    for n, c in coefficients.items():
        re = re + c * K.cos(n * kh)
        im = im + c * K.sin(n * kh)
    return Wave(re, im)


def symbol(base: Base, stencil: Stencil, kh: float) -> NDArray[np.complex128]:
    """The matrix A(kh) with d/dt of the amplitudes = A times the amplitudes of x, v, stress, …."""
    kinds = base.kinds
    A = np.zeros((len(kinds), len(kinds)), dtype=complex)
    for i, row in enumerate(kinds):
        for j, column in enumerate(kinds):
            A[i, j] = sum(c * np.exp(1j * n * kh) for n, c in stencil[row, column].items())
    if ("mass", "v") in stencil:
        A[kinds.index("v")] /= sum(c * np.exp(1j * n * kh) for n, c in stencil["mass", "v"].items())
    return A


def eigenvalue_roots(base: Base, stencil: Stencil, kh: float) -> list[Root]:
    """omega = -i lambda for every eigenvalue lambda of the symbol, the fastest growing first.

    Without a velocity gradient stress, edges and measures are functions of the positions: each adds an eigenvalue 0
    that is no motion, and these are left out.
    """
    values = np.linalg.eigvals(symbol(base, stencil, kh))
    if rational(base.velocity_gradient) == 0:
        values = values[np.argsort(-abs(values))][:2]
    found = [Root(float(value.imag), float(-value.real)) for value in values]
    return sorted(found, key=lambda root: (-root.growth, -root.re))


def omega_squared_at_rest(base: Base, stencil: Stencil, kh: Scalar, K: Arithmetic) -> Scalar:
    """omega^2 of the undamped motion about a base at rest (Q = V = 0): minus the symbol from positions to v'.

    Stress, edges and measures follow the positions as their rates follow the velocities. Real, since the lattice is
    its own mirror image; 1/time^2.
    """
    total = transform(stencil["v", "x"], kh, K).re
    for kind in base.kinds[2:]:
        carried, follows = transform(stencil["v", kind], kh, K), transform(stencil[kind, "v"], kh, K)
        total = total + carried.re * follows.re - carried.im * follows.im
    if ("mass", "v") in stencil:
        total = total / transform(stencil["mass", "v"], kh, K).re
    return -total
