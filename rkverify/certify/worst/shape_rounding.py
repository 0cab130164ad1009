"""What rounding does to shape functions, their derivatives and rates at one point, as `solid/` computes them.

Running errors but for one step, the linear systems M x = r. Their computed solution is that of M + dM exactly, with
|dM| <= E u, E = error of M + (3 m + 4) d d^T, d^2 = diag M: factors L D L^T have a backward error of (m + 2) u |L||D||L|^T,
the two triangles and the diagonal of (2 m + 2) u more, and |L||D||L|^T <= d d^T for a positive matrix (Higham, chapter 10).
So |x' - x| <= (1 - u |M^-1| E)^-1 u |M^-1| (E |x| + error of r), with no term left out, as long as u |M^-1| E has a spectral
radius below 1; where it has not, the matrix that doubles have may be singular, and there is no bound. What offsets, kernels
and residuals r - M x' do further on is followed with its sign: derivatives are built on three solutions, and bounds that
multiply |M^-1| each time are too large by 10^4 for order 2 in space.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.certify.worst.running import UNIT, Book, Rounded, rounded, stacked
from rkverify.certify.worst.window_rounding import Window, moment_rounding, window
from rkverify.paper.approximation import Approximation
from rkverify.paper.basis import exponents
from rkverify.paper.moment import moment_matrix
from rkverify.solid.bases import axis_pairs, basis_tables
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Systems:
    """M (m, m) with lengths in units of a, its inverse rounded from many digits, the backward error (m, m) of a solution.

    condition: the 2-norm condition number of M with its diagonal scaled to 1. book: the sources of errors, which solutions add to.
    """

    matrix: Rounded
    inverse: Array
    backward: Array
    condition: float
    book: Book

    @cached_property
    def moved(self) -> Array:
        """E (m, m), in units of u."""
        found: Array = self.matrix.reach + self.backward
        return found

    @cached_property
    def bounded(self) -> bool:
        """Whether no matrix that is E away is singular, so that solutions have bounds."""
        return bool(abs(np.linalg.eigvals(UNIT * abs(self.inverse) @ self.moved)).max() < 1)

    def solved(self, right: Rounded) -> Rounded:
        """x with M x = r (m,), where there are bounds; m sources are what nothing else knows of r - M x."""
        x, size, moved = self.inverse @ right.value, abs(self.inverse), self.moved
        spread = UNIT * size @ moved
        most = np.linalg.solve(np.eye(len(x)) - spread, size @ (moved @ abs(x) + right.reach))
        own = (self.matrix.error + self.backward) @ abs(x) + right.error + UNIT * moved @ most
        known = np.zeros((self.book.count, len(x)))
        known[: len(right.sources)] += right.sources
        known[: len(self.matrix.sources)] -= self.matrix.sources @ x
        self.book.count += len(x)
        return Rounded(x, np.zeros_like(x), np.concatenate([known @ self.inverse.T, self.inverse.T * own[:, None]]))


def exact_moments(A: Approximation, x: Array, scale: float) -> list[list[Any]]:
    """The moment matrix of the transcription at x (d,), with lengths in units of `scale`, in its own arithmetic."""
    powers = [sum(alpha) for alpha in exponents(A.dimension, A.order)]
    unit = A.K.number(scale)
    M = moment_matrix(A, A.point(*x.tolist()))
    return [[entry / unit ** (p + q) for entry, q in zip(row, powers, strict=True)] for row, p in zip(M, powers, strict=True)]  # fmt: skip


def systems(cloud: Cloud, A: Approximation, near: Window, x: Array) -> Systems:
    """The systems at x (d,): A is the same approximation in many digits."""
    assert isinstance(A.K, Multiprecision)
    context = A.K.context
    M = context.matrix(exact_moments(A, x, near.scale))
    m = M.rows
    inverse = np.array([[float(c) for c in row] for row in (M**-1).tolist()])
    root = np.sqrt([float(M[i, i]) for i in range(m)])
    backward = (3 * m + 4) * np.outer(root, root)
    values = context.eigsy(with_unit_diagonal(M), eigvals_only=True)
    condition = float(values[m - 1] / values[0])
    return Systems(moment_rounding(cloud, near), inverse, backward, condition, near.book)


def with_unit_diagonal(M: Any, like: Any = None) -> Any:
    """M_ij / sqrt(L_ii L_jj) with L = M, or another matrix, of mpmath: what units of length and thin node sets do to M is gone."""
    L, context = M if like is None else like, M.ctx
    root = [context.sqrt(L[i, i]) for i in range(M.rows)]
    return context.matrix([[M[i, j] / (root[i] * root[j]) for j in range(M.cols)] for i in range(M.rows)])


@dataclass(frozen=True)
class ShapeRounding:
    """At one point: nodes (n,), Psi, its derivatives along the axes (d,) and pairs of axes, and the systems solved for them."""

    nodes: Array
    values: Rounded
    first: list[Rounded]
    second: list[Rounded]
    systems: Systems


def inner(c: Rounded, H: list[Rounded]) -> Rounded:
    """c.H at every node, one term after the other."""
    total = c[0] * H[0]
    for i in range(1, len(H)):
        total = total + c[i] * H[i]
    return total


def shape_rounding(cloud: Cloud, A: Approximation, x: Array, derivatives: int, reading: str = "full") -> ShapeRounding:
    """The operations of `compiled_shape` at x (d,) for the readings full and diffuse of the derivatives."""
    near = window(cloud, x)
    of = systems(cloud, A, near, x)
    table, d, pairs = basis_tables(cloud.dimension, cloud.order), cloud.dimension, axis_pairs(cloud.dimension)
    if not of.bounded:
        none = _without_bound(near)
        return ShapeRounding(near.nodes, none, [none] * d, [none] * len(pairs), of)
    full, per = reading == "full", rounded(1.0) / rounded(near.scale)
    C = inner(of.solved(rounded(table.picks[0])), near.H)
    cH, first, second = [], [], []
    for k in range(d if derivatives else 0):
        right = rounded(table.picks[1 + k])
        if full:
            right = right + _sums(-(C * near.slopes[k]), near)
        cH.append(inner(of.solved(right), near.H))
        slope = cH[k] * near.phi
        first.append((slope + C * near.slopes[k] if full else slope) * per)
    for kl, (k, l) in enumerate(pairs if derivatives > 1 else []):
        right = rounded(table.picks[1 + d + kl])
        known = cH[k] * near.slopes[l] + cH[l] * near.slopes[k] + C * near.seconds[kl]
        if full:
            right = right + _sums(-known, near)
        curve = inner(of.solved(right), near.H) * near.phi
        second.append((curve + known if full else curve) * (per * per))
    return ShapeRounding(near.nodes, C * near.phi, first, second, of)


def _without_bound(near: Window) -> Rounded:
    return Rounded(np.zeros(len(near.nodes)), np.full(len(near.nodes), np.inf))


def _sums(known: Rounded, near: Window) -> Rounded:
    return stacked([h * known for h in near.H]).total()


@dataclass(frozen=True)
class RateRounding:
    """At one point: nodes (n,), Psi* of (40) and the material rate of Psi."""

    nodes: Array
    star: Rounded
    true: Rounded
    systems: Systems


def rate_rounding(cloud: Cloud, A: Approximation, x: Array, velocity: Array, node_velocities: Array) -> RateRounding:
    """The operations of the compiled rates at x (d,) for velocities of the material (d,) and of the nodes (N, d)."""
    near = window(cloud, x)
    of = systems(cloud, A, near, x)
    if not of.bounded:
        return RateRounding(near.nodes, _without_bound(near), _without_bound(near), of)
    table, d = basis_tables(cloud.dimension, cloud.order), cloud.dimension
    b = of.solved(rounded(table.picks[0]))
    C = inner(b, near.H)
    w = [
        (rounded(velocity[k]) - rounded(node_velocities[near.nodes, k])) / rounded(near.scale)
        for k in range(d)
    ]  # fmt: skip
    slope = near.slopes[0] * w[0]
    for k in range(1, d):
        slope = slope + near.slopes[k] * w[k]
    dH = [sum((w[k] * table.powers[k, i] * near.H[table.lowered[k, i]] for k in range(d)), rounded(0 * near.H[0].value)) for i in range(table.size)]  # fmt: skip
    dC = rounded(0 * C.value)
    for i in range(table.size):
        dC = dC + b[i] * dH[i]
    known = [-(dH[i] * (C * near.phi) + near.H[i] * (dC * near.phi + C * slope)) for i in range(table.size)]
    r = of.solved(stacked(known).total())
    for i in range(table.size):
        dC = dC + r[i] * near.H[i]
    return RateRounding(near.nodes, C * slope, dC * near.phi + C * slope, of)
