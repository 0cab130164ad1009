"""What rounding leaves of moment matrices that are nearly or exactly singular: smallest eigenvalues, and pivots that are 0."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import flint
import numpy as np

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.measures import Measured, compared
from rkverify.certify.worst.running import SLACK, UNIT, Rounded, rounded
from rkverify.certify.worst.shape_rounding import exact_moments, with_unit_diagonal
from rkverify.certify.worst.window_rounding import moment_rounding, window
from rkverify.errors import SingularMomentMatrix
from rkverify.paper.basis import exponents, monomial
from rkverify.solid.bases import basis_tables
from rkverify.solid.blocks import blocks
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours
from rkverify.solid.shape import shape

EPSILON = 2.0**-52


def moments_in_doubles(made: Cloud, x: Array) -> Array:
    """The moment matrix (m, m) that `solid/` computes at x (d,), with lengths in units of the largest support there."""
    m = basis_tables(made.dimension, made.order).size
    block = next(blocks(made, x[None], neighbours(made, x[None]), 0, factorise=False))
    M = np.zeros((m, m))
    M[np.tril_indices(m)] = block.factors[0]
    return np.where(np.tri(m, dtype=bool), M, M.T)


def eigenvalue_case(case: WorstCase) -> Measured:
    """The smallest eigenvalue of the moment matrix that doubles hold, M + dM, against that of the exact one.

    Both with the exact one's diagonal scaled to 1. By Rayleigh's quotient, with v and w the unit vectors that belong to the two, -|w.dM w| <= the difference <= |v.dM v|,
    where dM has the running errors of the entries. The eigenvalues themselves are taken with many digits.
    """
    made, x = case.cloud(), case.array("point")
    A, near = case.literal(), window(made, x)
    assert isinstance(A.K, Multiprecision)
    context = A.K.context
    exact = context.matrix(exact_moments(A, x, near.scale))
    values, vectors = context.eigsy(with_unit_diagonal(exact))
    in_doubles = context.matrix(moments_in_doubles(made, x).tolist())
    held, held_vectors = context.eigsy(with_unit_diagonal(in_doubles, exact))
    moved, root = moment_rounding(made, near), np.sqrt([float(exact[i, i]) for i in range(exact.rows)])
    v, w = (np.array([float(c) for c in part[:, 0]]) / root for part in (vectors, held_vectors))
    bound = max(_quotient(moved, v, v), _quotient(moved, w, w))
    return compared(float(abs(held[0] - values[0])), bound, float(values[0]), float(values[len(v) - 1] / values[0]))


def _quotient(moved: Rounded, v: Array, w: Array) -> float:
    """A bound on |v.dM w|, what the sources do with its sign."""
    own = abs(v) @ moved.error @ abs(w)
    return float(SLACK * UNIT * (own + abs(np.einsum("i,sij,j->s", v, moved.sources, w)).sum()))


@dataclass(frozen=True)
class Pivots:
    """For each pivot of L D L^T, in doubles, what it keeps of its diagonal entry (m,), and the least of pivot over uncertainty.

    Up to a margin of 1 `solid/` says that the matrix is singular: a pivot is v^T M v with v a row of L^-1, and not known
    to be positive where it is below m (n + m) 2^-52 sum_i v_i^2 M_ii for n nodes over the point.
    """

    kept: Array
    margin: float


def pivots(case: WorstCase) -> Pivots:
    """The pivots of the matrix that `solid/` computes, by its own operations in their order."""
    made, x = case.cloud(), case.array("point")
    M = moments_in_doubles(made, x)
    m, count = len(M), len(neighbours(made, x[None]).of(0))
    L, D, margins = np.eye(m), np.zeros(m), np.zeros(m)
    for j in range(m):
        pivot = M[j, j]
        for k in range(j):
            pivot -= L[j, k] * L[j, k] * D[k]
        D[j] = pivot
        for i in range(j + 1, m):
            entry = M[i, j]
            for k in range(j):
                entry -= L[i, k] * L[j, k] * D[k]
            L[i, j] = entry / pivot if pivot else 0.0
        v = np.linalg.solve(L[: j + 1, : j + 1].T, np.eye(j + 1)[j])
        margins[j] = pivot / (m * (count + m) * EPSILON * (v**2 @ np.diag(M)[: j + 1]))
    return Pivots(D / np.diag(M), float(margins.min()))


def dependent(case: WorstCase) -> int | None:
    """The first column of H over the nodes that cover the point that depends on those before it, in rationals; None if none does."""
    made, x = case.cloud(), case.array("point")
    K, near = Exact(), neighbours(made, x[None]).of(0)
    place = [Fraction(c) for c in x.tolist()]
    offsets = [
        tuple(p - Fraction(c) for p, c in zip(place, node, strict=True)) for node in made.positions[near].tolist()
    ]
    columns = [[monomial(y, alpha, K) for y in offsets] for alpha in exponents(made.dimension, made.order)]
    ranks = [_rank(columns[: n + 1]) for n in range(len(columns))]
    return next((n for n, (r, s) in enumerate(pairwise([0, *ranks])) if s == r), None)


def _rank(columns: list[list[Fraction]]) -> int:
    entries = [flint.fmpq(c.numerator, c.denominator) for column in columns for c in column]
    return int(flint.fmpq_mat(len(columns), len(columns[0]), entries).rank())


def pivot_case(case: WorstCase) -> Measured:
    """What doubles keep of a pivot that is exactly 0, as nodes on a line, in a plane or on a conic make it, of its diagonal entry.

    With w the null vector of the leading block, w_j = 1, the computed pivot is w^T dM w to first order, |dM| <= the errors
    of the entries and of the elimination, (m + 2) d d^T. The condition number is that of the block without column j.
    """
    made, x = case.cloud(), case.array("point")
    A, near, j = case.literal(), window(made, x), dependent(case)
    if j is None:
        return compared(0.0, float("inf"), 1.0, float("nan"))
    assert isinstance(A.K, Multiprecision)
    context = A.K.context
    full = exact_moments_unchecked(case, near.scale)
    block = context.matrix([row[:j] for row in full[:j]])
    w = [float(c) for c in (block**-1 * context.matrix([row[j] for row in full[:j]]))] if j else []
    null = np.array([*w, -1.0])
    root = np.sqrt([float(full[i][i]) for i in range(j + 1)])
    block_moved = moment_rounding(made, near)[: j + 1, : j + 1]
    eliminated = rounded(0 * block_moved.value)
    eliminated = Rounded(eliminated.value, (j + 3) * np.outer(root, root))
    bound = (_quotient(block_moved, null, null) + _quotient(eliminated, null, null)) / root[j] ** 2
    values = [float(v) for v in context.eigsy(with_unit_diagonal(block), eigvals_only=True)] if j else [1.0]
    return compared(abs(float(pivots(case).kept[j])), bound, 1.0, max(values) / min(values))


def exact_moments_unchecked(case: WorstCase, scale: float) -> list[list[Any]]:
    """The moment matrix with many digits, singular or not."""
    A = case.literal()
    return exact_moments(A, case.array("point"), scale)


def answers(case: WorstCase) -> bool:
    """Whether `solid/` gives shape functions at the point rather than call the moment matrix singular."""
    made, x = case.cloud(), case.array("point")
    try:
        shape(made, x[None])
    except SingularMomentMatrix:
        return False
    return True
