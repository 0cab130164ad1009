"""Shape functions on a line from moment sums s_k = sum_J y^k phi: no basis vector, no factorisation by hand.

Arrays have the shape (points, nodes); y = x - x_J. Offsets may be complex, so that every result can be
differentiated by a complex step.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.kernels import Kernel
from rkverify.readings import Derivative
from rkverify.solid.kernel_values import Array, kernel_values


@dataclass(frozen=True)
class Line:
    """Kernel values and powers at offsets y (points, nodes), for supports a (nodes,) and an order."""

    y: Array
    phi: Array
    slope: Array
    order: int

    @property
    def powers(self) -> Array:
        """y^0, …, y^n (n + 1, points, nodes)."""
        return np.stack([self.y**k for k in range(self.order + 1)])

    def _hankel(self, sums: Array) -> Array:
        n = self.order + 1
        rows = [[sums[i + j] for j in range(n)] for i in range(n)]
        return np.moveaxis(np.array(rows), -1, 0)

    @property
    def moments(self) -> Array:
        """M_ij = s_(i+j) (points, n + 1, n + 1)."""
        sums = np.stack([(self.y**k * self.phi).sum(axis=1) for k in range(2 * self.order + 1)])
        return self._hankel(sums)

    def moment_rates(self, w: Array, w_kernel: Array) -> Array:
        """dM/dt where y changes at the rate w (points, nodes), and for the kernel at the rate w_kernel."""
        sums = []
        for k in range(2 * self.order + 1):
            power_rate = k * self.y ** (k - 1) * w if k else np.zeros_like(self.y)
            sums.append((power_rate * self.phi + self.y**k * self.slope * w_kernel).sum(axis=1))
        return self._hankel(np.stack(sums))

    def _coefficients(self, row: int) -> Array:
        right = np.zeros((len(self.y), self.order + 1, 1), dtype=self.y.dtype)
        right[:, row, 0] = 1.0
        return np.linalg.solve(self.moments, right)[:, :, 0]

    def _polynomial(self, coefficients: Array, derivative: int = 0) -> Array:
        total = np.zeros_like(self.y)
        for k in range(derivative, self.order + 1):
            total = total + coefficients[:, k : k + 1] * (k * self.y ** (k - 1) if derivative else self.y**k)
        return total

    def shape(self) -> Array:
        """Psi_J (points, nodes)."""
        return self._polynomial(self._coefficients(0)) * self.phi

    def rate(self, w: Array, w_kernel: Array | None = None) -> Array:
        """The rate of Psi_J where every y changes at the rate w (points, nodes).

        w_kernel: w - y a'/a where supports change: the kernel is a function of y/a.
        """
        seen = w if w_kernel is None else w_kernel
        b = self._coefficients(0)
        db = -np.linalg.solve(self.moments, self.moment_rates(w, seen) @ b[:, :, None])[:, :, 0]
        held = self._polynomial(b) * self.slope * seen + self._polynomial(b, 1) * w * self.phi
        return self._polynomial(db) * self.phi + held

    def kernel_rate(self, w: Array) -> Array:
        """Psi*_J: the correction C times the rate of the kernel."""
        return self._polynomial(self._coefficients(0)) * self.slope * w

    def gradient(self, reading: Derivative) -> Array:
        """dPsi_J/dx in a reading (points, nodes)."""
        one = np.ones_like(self.y)
        if reading == "full":
            return self.rate(one)
        if reading == "diffuse":
            return -self._polynomial(self._coefficients(1)) * self.phi
        frozen = self.kernel_rate(one)
        if reading == "frozen":
            return frozen
        return frozen + self._polynomial(self._coefficients(0), 1) * self.phi


def line(offsets: Array, supports: Array, kernel: Kernel, order: int) -> Line:
    """The line at the given offsets."""
    phi, slope = kernel_values(kernel, offsets, supports, 1)
    return Line(offsets, phi, slope, order)
