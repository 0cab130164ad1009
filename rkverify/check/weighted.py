"""Shape functions from any weights, point by point: for choices that a cloud cannot hold, such as supports that two nodes share.

Written straight from (2)-(6) with dense matrices, and by another route than `solid/`: a few lines for each point.
"""

import numpy as np

from rkverify.check.sums import monomials
from rkverify.readings import Derivative
from rkverify.solid.kernel_values import Array


def weighted(y: Array, w: Array, dw: Array, order: int, reading: Derivative) -> tuple[Array, Array]:
    """Psi_J (n,) and its gradient (n, d) for offsets y = x - x_J (n, d), weights w_J (n,) and their gradients dw (n, d).

    Psi_J = b.H(y_J) w_J with sum_J H w H^T b = H(0). Raises LinAlgError where the moment matrix is singular.
    """
    exponents = np.array(monomials(y.shape[1], order))
    H = np.prod(y[:, None] ** exponents, axis=2)
    M = (H * w[:, None]).T @ H
    at_zero = np.zeros(len(exponents))
    at_zero[0] = 1.0
    b = np.linalg.solve(M, at_zero)
    C = H @ b
    slopes = np.empty_like(dw)
    for k in range(y.shape[1]):
        lowered = exponents - np.eye(y.shape[1], dtype=int)[k]
        H_k = exponents[:, k] * np.prod(y[:, None] ** np.maximum(lowered, 0), axis=2)
        H_k_at_zero = (lowered == 0).all(axis=1) * exponents[:, k]
        if reading == "full":
            slopes[:, k] = H @ np.linalg.solve(M, -H_k_at_zero - H.T @ (C * dw[:, k])) * w + C * dw[:, k]
        elif reading == "diffuse":
            slopes[:, k] = H @ np.linalg.solve(M, -H_k_at_zero) * w
        else:
            slopes[:, k] = C * dw[:, k] + (H_k @ b * w if reading == "frozen-b" else 0.0)
    return C * w, slopes
