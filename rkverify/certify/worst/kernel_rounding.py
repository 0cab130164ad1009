"""What rounding does to a kernel's phi(z), g = phi'/z and s = (phi'' - g)/z^2 as `solid/` computes them, operation by operation."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rkverify.certify.worst.running import UNIT, Rounded, constant, rounded
from rkverify.kernels import Kernel
from rkverify.solid.kernel_data import kernel_data
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class KernelRounding:
    """phi, g and s at z (n,)."""

    f: Rounded
    g: Rounded
    s: Rounded


def kernel_rounding(kernel: Kernel, z: Rounded) -> KernelRounding:
    """The kernel and the two quotients at z (n,): Horner's scheme and its derivatives, or a polynomial for the quotients near 0.

    Where rounding may put z on the other side of a joint, the whole of the piece beyond it is an error.
    """
    ends, pieces, near, g_near, zs_near = kernel_data(kernel).constants
    zero = rounded(np.zeros_like(z.value))
    f, slope, curve = zero, zero, zero
    for end, piece in zip(ends, pieces, strict=True):
        left = constant(end) - z
        unsure = abs(left.value) <= UNIT * left.error
        outside = (left.value <= 0) & ~unsure
        left = Rounded(np.maximum(left.value, 0), left.reach)
        phi, first, second = rounded(0.0), rounded(0.0), rounded(0.0)
        for c in piece:
            second = second * left + first
            first = first * left + phi
            phi = phi * left + constant(c)
        f, slope, curve = (
            total + _cut(part, outside, unsure, z) for total, part in ((f, phi), (slope, -first), (curve, 2.0 * second))
        )
    beside = (z.value < near) | (z.value == 0)
    over = Rounded(np.where(beside, 1.0, z.value), np.where(beside, 0.0, z.reach))
    # Where rounding may take the other of the two formulas, the larger error counts.
    either = abs(z.value - near) <= UNIT * z.reach
    g = _chosen(beside, _polynomial(g_near, z), slope / over, either)
    at_node = z.value == 0
    series = _polynomial(zs_near, z) / Rounded(np.where(at_node, 1.0, z.value), np.where(at_node, 0.0, z.reach))
    s = _chosen(beside, _chosen(at_node, zero, series), (curve - g) / (over * over), either)
    return KernelRounding(f, g, s)


def _cut(part: Rounded, outside: Array, unsure: Array, like: Rounded) -> Rounded:
    value, error = (np.broadcast_to(x, like.value.shape) for x in (part.value, part.reach))
    error = error + np.where(unsure, abs(value) / UNIT, 0.0)
    return Rounded(np.where(outside, 0.0, value), np.where(outside, 0.0, error))


def _chosen(which: Array, one: Rounded, other: Rounded, either: Array | bool = False) -> Rounded:
    error = np.where(which, one.reach, other.reach)
    larger = np.where(either, np.maximum(one.reach, other.reach), error)
    return Rounded(np.where(which, one.value, other.value), larger)


def _polynomial(coefficients: Sequence[float], z: Rounded) -> Rounded:
    total = rounded(np.zeros_like(z.value))
    for c in coefficients:
        total = total * z + constant(c)
    return total
