"""Corrected kernel gradients of smoothed particle hydrodynamics, and fits of wlsqm, in formulas of ours."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from math import gamma, pi

import numpy as np

from rkverify.check.claim import Claim, predicted
from rkverify.check.entries import Entries, apart
from rkverify.check.peer_tables import PeerTable
from rkverify.kernels import Kernel, Term, TruncatedPowers
from rkverify.readings import Derivative
from rkverify.solid.kernel_values import Array, kernel_values
from rkverify.solid.neighbours import Neighbours, neighbours
from rkverify.solid.shape import shape

LEAST = Fraction(1, 10000)
"""The weight that wlsqm leaves to its farthest neighbour (Case_make_weights_alpha in its infra.pyx)."""
CENTRE = Kernel(
    "wlsqm centre",
    # (1 - LEAST)(1 - z)^2 + LEAST for z <= 1, from powers of (2 - z) and (3 - z): no power of 0, whose derivative is a point mass
    TruncatedPowers(
        (
            Term(1 - LEAST, Fraction(2), 2),
            Term(-2 * (1 - LEAST) - 1, Fraction(2), 1),
            Term(Fraction(1), Fraction(3), 1),
        )
    ),
    "weights of wlsqm, WEIGHT_CENTER",
)


UNIFORM = Kernel("constant", TruncatedPowers((Term(Fraction(1), Fraction(2), 0),)), "unweighted least squares")
"""The constant 1 for z < 2, so that the farthest neighbour at z = 1 has it as well."""


def least_squares(table: PeerTable, of: Kernel) -> Entries:
    """Diffuse derivatives with z = distance / that of the farthest neighbour; the neighbours are those within the radius."""
    claim, everyone = table.claim, []
    known = neighbours(claim.cloud, claim.points)
    for point, place in enumerate(claim.points):
        nodes = known.of(point)
        farthest = np.sqrt(((claim.cloud.positions[nodes] - place) ** 2).sum(axis=1)).max()
        here = replace(claim.cloud, supports=np.full(len(claim.cloud), farthest), kernel=of)
        one = Neighbours(np.array([0, len(nodes)]), nodes)
        there = shape(here, place[None], 1, "diffuse", one)
        assert there.gradients is not None
        everyone.append(np.column_stack([there.values, there.gradients]))
    numbers = np.concatenate(everyone)
    return replace(table.theirs, rows=known.points, nodes=known.nodes, numbers=numbers)


def corrected(table: PeerTable, reading: Derivative) -> Entries:
    """L grad Psi^0 with L = (sum_J grad Psi_J^0 (x_J - x)^T)^-1 for the functions of order 0 in a reading, the node at x left out."""
    claim = replace(table.claim, cloud=replace(table.claim.cloud, order=0), derivative=reading)
    return made_linear(claim, predicted(claim, table.theirs.columns))


def mixed(table: PeerTable) -> Entries:
    """The same of (grad W_J - sum_J grad W_J / sum_J W_J) / sum_J W_J, as PySPH documents it; grad Psi^0 has W_J before that sum.

    The two terms have different units, so that the numbers depend on the unit of length.
    """
    claim = table.claim
    W = weights(claim, table.theirs.columns)
    total = np.bincount(W.rows, W.values, W.gradients.count)[W.rows, None]
    gradients = W.gradients.numbers
    sums = np.zeros((W.gradients.count, gradients.shape[1]))
    np.add.at(sums, W.rows, gradients)
    return made_linear(claim, replace(W.gradients, numbers=(gradients - sums[W.rows] / total) / total))


@dataclass(frozen=True)
class Weights:
    """Kernels of integral 1 over space at the pairs (E,) of a claim with one support, and their gradients as entries."""

    rows: Array
    values: Array
    gradients: Entries


def weights(claim: Claim, columns: tuple[str, ...]) -> Weights:
    """W_J = phi / (|S| a^d int_0^1 z^(d-1) phi dz) with the area |S| of the unit sphere."""
    known, d, a = neighbours(claim.cloud, claim.points), claim.cloud.dimension, float(claim.cloud.supports[0])
    y = claim.points[known.points] - claim.cloud.positions[known.nodes]
    r = np.sqrt((y**2).sum(axis=1))
    sphere = 2 * pi ** (d / 2) / gamma(d / 2)
    whole = sphere * a**d * float(claim.cloud.kernel.phi.moment(d - 1))
    phi, slope = (f / whole for f in kernel_values(claim.cloud.kernel, r, a, 1))
    slopes = (slope / np.where(r > 0, r, 1.0))[:, None] * y
    size = len(claim.cloud)
    return Weights(
        known.points, phi, Entries(known.points, known.nodes, slopes, columns, len(known), size, np.zeros(len(columns)))
    )


def made_linear(claim: Claim, there: Entries) -> Entries:
    """The gradients times the matrix L of their point that makes sum_J g_J (x_J - x)^T the identity."""
    y = claim.cloud.positions[there.nodes] - claim.points[there.rows]
    L = np.zeros((there.count, y.shape[1], y.shape[1]))
    np.add.at(L, there.rows, there.numbers[:, :, None] * y[:, None, :])
    numbers = np.linalg.solve(L[there.rows], there.numbers[:, :, None])[:, :, 0]
    return replace(there, numbers=numbers)


def uncorrected(table: PeerTable) -> tuple[int, int, float]:
    """How many pairs of a table have the full derivative, how many that of the kernel alone, and the largest rest."""
    full = predicted(table.claim, table.theirs.columns)
    kernels = weights(table.claim, table.theirs.columns[1:])
    alone = replace(full, numbers=np.column_stack([full.numbers[:, 0], kernels.gradients.numbers]))
    gaps = [abs(apart(ours, table.theirs).numbers).max(axis=1) for ours in (full, alone)]
    nearest = np.argmin(gaps, axis=0)
    return int((nearest == 0).sum()), int((nearest == 1).sum()), float(np.min(gaps, axis=0).max())


def unit_dependence(table: PeerTable, formula: Callable[[PeerTable], Entries], factor: float = 1000.0) -> float:
    """How much the gradients of a formula change, over the largest, if lengths are told in another unit: 0 for a derivative."""
    claim = table.claim
    scaled = replace(claim.cloud, positions=claim.cloud.positions * factor, supports=claim.cloud.supports * factor)
    other = formula(replace(table, claim=replace(claim, cloud=scaled, points=claim.points * factor))).numbers * factor
    here = formula(table).numbers
    return float(abs(other - here).max() / abs(here).max())
