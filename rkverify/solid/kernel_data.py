"""A kernel as constants for compiled code, derived exactly from its rational data and rounded once."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import comb

from rkverify.kernels import Kernel

Coefficients = tuple[float, ...]


@dataclass(frozen=True)
class KernelData:
    """phi(z) = sum over joints b of P_b(b - z), z < b, and for z < near g = phi'/z and z s = (phi'' - g)/z as polynomials.

    There the quotients of rounded numbers would lose their digits, and have no value at z = 0. g and s are all that
    gradients and second derivatives of phi(|y|/a) need: g y_k / a^2 and (g delta_kl + s y_k y_l / a^2) / a^2.
    Coefficients are listed from the highest power down to the constant.
    """

    joints: Coefficients
    pieces: tuple[Coefficients, ...]
    near: float
    g: Coefficients
    zs: Coefficients

    @property
    def constants(self) -> tuple[Coefficients, tuple[Coefficients, ...], float, Coefficients, Coefficients]:
        """What compiled code is called with."""
        return self.joints, self.pieces, self.near, self.g, self.zs


@cache
def kernel_data(kernel: Kernel) -> KernelData:
    """The constants of a kernel; `near` is half the first joint, and 0 for a kernel with a peak at its node."""
    terms, joints = kernel.phi.terms, kernel.joints
    powers = range(max(t.power for t in terms), -1, -1)
    # phi = sum_k a_k z^k inside the first joint, by the binomial theorem
    a = {
        k: sum(
            (t.coefficient * comb(t.power, k) * (-1) ** k * t.end ** (t.power - k) for t in terms if t.power >= k),
            Fraction(0),
        )
        for k in powers
    }
    peaked = kernel.smoothness_at_node < 1
    return KernelData(
        tuple(map(float, joints)),
        tuple(
            tuple(float(sum(t.coefficient for t in terms if (t.end, t.power) == (b, k))) for k in powers)
            for b in joints
        ),
        0.0 if peaked else float(joints[0]) / 2,
        tuple(float(k * a[k]) for k in powers if k >= 2) or (0.0,),
        tuple(float(k * (k - 2) * a[k]) for k in powers if k >= 3) or (0.0,),
    )
