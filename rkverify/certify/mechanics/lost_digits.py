"""Digits of spatial gradients near a map that is not regular: the chain rule (25) and semi-Lagrangian gradients, in doubles.

Both are held against the transcription with many digits on the same positions, doubles that count as exact. The deformation gradient is
that of the discretisation, F_ij = sum_I x_iI dPsi_I/dX_j (14)-(16), direct at a material point.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.errors import RkverifyError
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.chain_rule import spatial_gradients
from rkverify.paper.moment import Matrix
from rkverify.paper.shape import Values, shape_gradient
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.shape import condition_numbers, shape

Row = dict[str, Any]
MOTIONS = ("fold", "flattening", "shear")
ACROSS = np.array([0.8, 0.6])
"""The unit normal of the line that folds, of the plane that is flattened; oblique, so that no entry of F vanishes."""
ALONG = np.array([-0.6, 0.8])
PLACE = (0.07, -0.11)
JITTER, SUPPORT_RATIO = 0.2, 2.3
DIGITS = 40
UNIT = 2.0**-53


@dataclass(frozen=True)
class Patch:
    """A few nodes about a material point: the cloud in X, its literal counterpart, and the gradients of Psi_I there by both."""

    cloud: Cloud
    literal: Approximation
    values: Array
    slopes: Array
    literal_slopes: tuple[Values, ...]
    K: Multiprecision

    @property
    def fold_starts(self) -> float:
        """The s at which F of `moved("fold", s)` is singular at the point; 1 for the map itself at its line, other for this F."""
        G = fold(self.cloud.positions).T @ self.slopes
        return float(-1 / np.linalg.eigvals(G).real.min())


def patch(seed: int) -> Patch:
    """7 by 7 jittered nodes in [-1, 1]^2, linear basis, cubic kernel."""
    h = 1 / 3
    axis = np.arange(-3, 4) * h
    X = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    X = X + JITTER * h * np.random.default_rng(seed).uniform(-1, 1, X.shape)
    a, K = SUPPORT_RATIO * h, Multiprecision(DIGITS)
    made, literal = cloud(X, a), approximation(X.tolist(), a, K)
    there = shape(made, np.array([PLACE]), 1)
    slopes = np.stack([there.gradient_matrix(axis).toarray()[0] for axis in range(2)], axis=1)
    place = literal.point(*PLACE)
    return Patch(
        made, literal, there.matrix().toarray()[0], slopes, _literal_slopes(literal, place), K
    )  # fmt: skip


def _literal_slopes(A: Approximation, place: Vector) -> tuple[Values, ...]:
    return tuple(shape_gradient(A, place, axis) for axis in range(2))


def fold(X: Array) -> Array:
    """-(1/pi) sin(pi N.X) N: x = X + s u folds along N.X = 0 at s = 1."""
    return -np.sin(np.pi * X @ ACROSS)[:, None] / np.pi * ACROSS


def moved(p: Patch, motion: str, closeness: float) -> Array:
    """Positions (N, 2): folded, flattened to a share, or sheared by 1/sqrt(share): cond F is about 1/share for each.

    A flattening and a shear are one-to-one for any share above 0, the fold is no map onto its image from share 0 on.
    """
    X = p.cloud.positions
    if motion == "fold":
        return X + p.fold_starts * (1 - closeness) * fold(X)
    if motion == "flattening":
        return X - (1 - closeness) * np.outer(X @ ACROSS, ACROSS)
    return X + closeness**-0.5 * np.outer(X @ ACROSS, ALONG)


def of_chain_rule(p: Patch, x: Array) -> tuple[float, float, float]:
    """det F, cond F, and the error of dPsi/dX F^-1 in doubles over its largest entry."""
    F = x.T @ p.slopes
    found = p.slopes @ np.linalg.inv(F)
    K = p.K
    exact_F: Matrix = [
        [sum((slope[I] * K.number(float(x[I, i])) for I in slope), K.zero()) for slope in p.literal_slopes]
        for i in range(2)
    ]
    exact = _dense(spatial_gradients(p.literal_slopes, exact_F, K), len(x))
    as_doubles = np.array([[float(entry) for entry in row] for row in exact_F])
    J = exact_F[0][0] * exact_F[1][1] - exact_F[0][1] * exact_F[1][0]
    size = float((as_doubles**2).sum())  # of two singular values s1, s2: s1^2 + s2^2, with s1 s2 = |J|
    condition = (size + np.sqrt(max(size**2 - 4 * float(J) ** 2, 0.0))) / (2 * abs(float(J)))
    return float(J), float(condition), float(abs(found - exact).max() / abs(exact).max())


def of_semi_lagrangian(p: Patch, x: Array) -> tuple[float, float, str]:
    """cond M, the error of dPsi/dx at the place of the material point over its largest entry, and what stopped it, if anything did."""
    now, place = p.cloud.at(x), (p.values @ x)[None]
    try:
        there = shape(now, place, 1)
    except RkverifyError as error:
        return np.inf, np.inf, type(error).__name__
    found = np.stack([there.gradient_matrix(axis).toarray()[0] for axis in range(2)], axis=1)
    literal = approximation(x.tolist(), float(now.supports[0]), p.K)
    exact = _dense(_literal_slopes(literal, literal.point(*place[0])), len(x))
    return float(condition_numbers(now, place)[0]), float(abs(found - exact).max() / abs(exact).max()), ""


def _dense(slopes: Sequence[Values], count: int) -> Array:
    table = np.zeros((count, len(slopes)))
    for axis, values in enumerate(slopes):
        for I, value in values.items():
            table[I, axis] = float(value)
    return table


def digits(patches: Sequence[Patch], motion: str, exponent: int) -> Row:
    """The most digits lost over the patches at closeness 10^-exponent: log10 of error over unit roundoff, none below 1.

    stopped: what semi-Lagrangian shape functions raise, where they do on any patch.
    """
    rows = []
    for p in patches:
        x = moved(p, motion, 10.0**-exponent)
        rows.append((*of_chain_rule(p, x), *of_semi_lagrangian(p, x)))
    J, condition, chain, M, semi, stopped = zip(*rows, strict=True)
    reasons = sorted({reason for reason in stopped if reason})
    return {
        "motion": motion,
        "closeness": 10.0**-exponent,
        "det_F": min(J),
        "condition_F": max(condition),
        "chain_rule_lost": _lost(max(chain)),
        "condition_M": max(M),
        "semi_lagrangian_lost": _lost(max(semi)),
        "stopped": "; ".join(reasons),
    }


def _lost(error: float) -> float:
    return float(np.log10(max(error, UNIT) / UNIT))
