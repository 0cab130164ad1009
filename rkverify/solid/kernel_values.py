"""phi, phi' and phi'' of a kernel on arrays of z, real or complex; the branch looks at the real part."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rkverify.kernels import Kernel, TruncatedPowers

Array = NDArray[Any]


def _evaluate(f: TruncatedPowers, z: Array) -> Array:
    total = np.zeros_like(z)
    for term in f.terms:
        left = float(term.end) - z
        inside = left.real > 0
        total = total + np.where(inside, float(term.coefficient) * np.where(inside, left, 1.0) ** term.power, 0.0)
    return total


def kernel_values(kernel: Kernel, offsets: Array, support: Array | float, derivatives: int) -> list[Array]:
    """phi(|y|/a) and its derivatives with respect to y, up to the given order, at y = x - x_I (any shape).

    phi is even in y: odd derivatives take the sign of y, and at y = 0 that of a C1 kernel's first derivative is zero.
    """
    side = np.where(offsets.real < 0, -1.0, 1.0)
    z = side * offsets / support
    return [
        _evaluate(kernel.phi.derivative(order), z) * (side / support) ** order if order else _evaluate(kernel.phi, z)
        for order in range(derivatives + 1)
    ]
