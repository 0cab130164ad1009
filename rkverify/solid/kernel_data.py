"""A kernel as arrays for compiled code, derived exactly from its rational data and rounded once."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import comb

import numpy as np

from rkverify.kernels import Kernel
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class KernelData:
    """phi(z) = sum_t c_t (b_t - z)_+^p_t, and next to the node, z < near, g = phi'/z and z s = (phi'' - g)/z as polynomials.

    There the quotients of rounded numbers would lose their digits, and have no value at z = 0. g and s are all that
    gradients and second derivatives of phi(|y|/a) need: g y_k / a^2 and (g delta_kl + s y_k y_l / a^2) / a^2.
    """

    ends: Array
    coefficients: Array
    powers: Array
    near: float
    g: Array
    zs: Array

    @property
    def arrays(self) -> tuple[Array, Array, Array, float, Array, Array]:
        """What compiled code is called with."""
        return self.ends, self.coefficients, self.powers, self.near, self.g, self.zs


@cache
def kernel_data(kernel: Kernel) -> KernelData:
    """The arrays of a kernel; `near` is half the first joint, and 0 for a kernel with a peak at its node."""
    terms = kernel.phi.terms
    degree = max(t.power for t in terms)
    # phi = sum_k a_k z^k inside the first joint, by the binomial theorem
    a = [
        sum(
            (t.coefficient * comb(t.power, k) * (-1) ** k * t.end ** (t.power - k) for t in terms if t.power >= k),
            Fraction(0),
        )
        for k in range(degree + 1)
    ]
    peaked = kernel.smoothness_at_node < 1
    return KernelData(
        np.array([float(t.end) for t in terms]),
        np.array([float(t.coefficient) for t in terms]),
        np.array([t.power for t in terms]),
        0.0 if peaked else float(min(t.end for t in terms)) / 2,
        np.array([float(k * a[k]) for k in range(2, degree + 1)] or [0.0]),
        np.array([float(k * (k - 2) * a[k]) for k in range(3, degree + 1)] or [0.0]),
    )
