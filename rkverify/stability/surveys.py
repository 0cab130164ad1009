"""Growth over many settings at once: stencils are polynomials in sigma/C^sigma and Q, so that six of them give all.

Everything is in the units h = rho = C^sigma = 1: frequencies and growths are omega h / c with c^2 = C^sigma/rho, a
velocity gradient is Q h / c.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.stability import jacobian_solid
from rkverify.stability.at_rest import at_rest, printed_relation
from rkverify.stability.layers import Setting

Roots = Callable[[float, float], Array]
"""(s, Q) -> the roots omega at every kh (waves, roots), complex; the wave e^{i(kx + omega t)} grows at -Im omega."""


def roots_over(setting: Setting, kh: Array) -> Roots:
    """omega of a semi-Lagrangian layer for every stress ratio s and velocity gradient Q, at given kh.

    A stencil is affine in s, since the stress enters the force alone, and of degree 2 in Q, since N is v times v: six
    stencils give it at every (s, Q). In print D is affine in s and in Q^2, and B is Q times a function of kh.
    """
    rest = at_rest(setting)

    def still(s: float) -> Array:
        omega = np.sqrt(rest.omega_squared(s, kh).astype(complex))
        return np.stack([omega, -omega], axis=1)

    moving = _printed_roots(setting, kh) if setting.layer == "printed" else _frozen_roots(setting, kh)
    # Without motion stress follows the positions, and the eigenvalue 0 that it adds would only bring in rounding.
    return lambda s, Q: moving(s, Q) if Q else still(s)


def _printed_roots(setting: Setting, kh: Array) -> Roots:
    relation = printed_relation(setting)

    def discriminant(s: int, Q: int) -> Array:
        return np.array([relation.discriminant(relation.state(s, Q), theta) for theta in kh.tolist()])

    linear = np.array([relation.linear(relation.state(0, 1), theta) for theta in kh.tolist()])
    free = discriminant(0, 0)
    per_stress, per_square = discriminant(1, 0) - free, discriminant(0, 1) - free

    def roots(s: float, Q: float) -> Array:
        half = np.sqrt((free + s * per_stress + Q * Q * per_square).astype(complex)) / 2
        return np.stack([-Q * linear / 2 + half, -Q * linear / 2 - half], axis=1)

    return roots


def _frozen_roots(setting: Setting, kh: Array) -> Roots:
    symbols = {
        (s, Q): _symbols(replace(setting, stress_ratio=s, velocity_gradient=Q, spacing=1), kh)
        for s in (0, 1)
        for Q in (-1, 0, 1)
    }

    def over_Q(s: int, Q: float) -> Array:
        below, middle, above = (symbols[s, node] for node in (-1, 0, 1))
        return middle + Q * (above - below) / 2 + Q * Q * (above + below - 2 * middle) / 2

    def roots(s: float, Q: float) -> Array:
        return -1j * np.linalg.eigvals((1 - s) * over_Q(0, Q) + s * over_Q(1, Q))

    return roots


def _symbols(setting: Setting, kh: Array) -> Array:
    """A(kh) with d/dt of the amplitudes = A times the amplitudes (waves, kinds, kinds)."""
    base = setting.base()
    found = jacobian_solid.stencil(base)
    reach = max(abs(n) for n in found["x", "x"])
    shifts = range(-reach, reach + 1)
    blocks = np.array([[[found[row, column][n] for n in shifts] for column in base.kinds] for row in base.kinds])
    return np.einsum("ijn,kn->kij", blocks, np.exp(1j * np.outer(kh, list(shifts))))


def growth(omega: Array) -> Array:
    """The largest growth -Im omega at every kh."""
    return (-omega.imag).max(axis=1)


def frequency(omega: Array) -> Array:
    """The largest |Re omega| at every kh."""
    return abs(omega.real).max(axis=1)
