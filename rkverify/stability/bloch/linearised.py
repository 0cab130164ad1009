"""df_I/dx_J of a periodic node set through `solid/`, by complex steps on a patch around one period.

f_iI = sum_L sigma_ij(x_L) B_jI^L with B_jI^L = a_L b_jI^L. What a node moves changes B only in cells that its support reaches,
so that sum_L dB_jI^L/dx_lJ is a sum over the cells of the patch, without stress: the geometric part for any stress.

For conforming cells (SCNI) sum_L B_jI^L is identically zero inside the patch, for any positions, cells and rule: each facet
counts with opposite signs in its two cells. So is its derivative, and no cell has to be differentiated, not even those
that meet four in a point; see `degenerate`.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.cell_topology import Topology
from rkverify.solid.cells import Cells
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import voronoi
from rkverify.stability.bloch.cell_integrals import areas, conforming, dense, moving, room
from rkverify.stability.bloch.lattices import Lattice, Patch
from rkverify.stability.bloch.measure_slopes import STEP, cells_of, measure_slopes
from rkverify.stability.bloch.scheme import Scheme


@dataclass(frozen=True)
class Coupling:
    """Values (E, d, …) between rows (E,) and columns (E,), both nodes of a period, the column's copy at the offsets (E, d)."""

    rows: Array
    columns: Array
    offsets: Array
    values: Array


@dataclass(frozen=True)
class Linearised:
    """One period: cell measures a (n,), masses m (n,), b_jI^L (L to I) and sum_L d(a_L b_jI^L)/dx_lJ (I to J, last axes j, l).

    Units: length^d, mass, 1/length, length^(d-2).
    """

    measures: Array
    masses: Array
    gradients: Coupling
    geometric: Coupling

    def __len__(self) -> int:
        """The number n of nodes in a period."""
        return len(self.measures)


def linearised(lattice: Lattice, scheme: Scheme) -> Linearised:
    """Gradients and their derivatives; raises BadInput for order 0, and what `shape` raises: TooFewNodes, NotDifferentiable, …."""
    if scheme.order == 0:
        raise BadInput("order 0 does not reproduce linear motions: choose order 1 or 2")
    d = lattice.dimension
    a, reach = areas(lattice)
    # the corner of a square or cube of measure a is d^(1/2)/2 of its side away
    corner = float((d / 4) ** 0.5 * a.max() ** (1 / d))
    inner = scheme.reach_in(d) + (0.0 if scheme.integration == "dni" else max(reach, corner))
    if scheme.integration == "scni":
        patch = lattice.around(inner + 2 * reach + 1e-6)
        home = np.arange(len(lattice))
        cells = voronoi(patch.positions, room(patch.positions))
        B = conforming(scheme, patch.positions, cells, home)
        nothing = np.zeros(0, int)
        geometric = Coupling(nothing, nothing, np.zeros((0, d)), np.zeros((0, d, d)))
    else:
        cells_reach = max(inner, 2 * reach) + 1e-6
        patch = lattice.around(cells_reach + max(inner, 2 * reach) + 1e-6)
        home = np.arange(len(lattice))
        parts = moving(scheme, patch.positions, home)(patch.positions, a[patch.basis])
        B = np.stack([part.toarray() for part in parts], axis=2)
        geometric = _geometric(lattice, scheme, patch, a, cells_reach)
    L, I = np.nonzero((B != 0).any(axis=2))
    offsets = patch.positions[I] - patch.positions[L]
    gradients = Coupling(L, patch.basis[I], offsets, B[L, I] / a[L, None])
    return Linearised(a, _masses(scheme, patch, a), gradients, geometric)


def _masses(scheme: Scheme, patch: Patch, a: Array) -> Array:
    """Row sums of (42) with density 1: m_I = sum_L a_L Psi_I(x_L); a_I on a lattice of one node."""
    Psi = dense(scheme.cloud(patch.positions), patch.positions[: len(a)])
    masses = np.zeros(len(a))
    np.add.at(masses, patch.basis, (a[:, None] * Psi).sum(axis=0))
    return masses


def _geometric(lattice: Lattice, scheme: Scheme, patch: Patch, a: Array, cells_reach: float) -> Coupling:
    """Each node of the period moves in turn, along each axis; forces are read at all nodes of the patch."""
    x, count = patch.positions, len(lattice)
    measures = a[patch.basis]
    cells = cells_of(x) if scheme.cell_measure == "edges" else None
    rows, columns, offsets, values = [], [], [], []
    for J in range(count):
        slopes = node_slopes(scheme, x, measures, J, cells_reach, cells)
        I = np.flatnonzero((slopes != 0).any(axis=(1, 2)))
        rows.append(patch.basis[I])
        columns.append(np.full(len(I), J))
        offsets.append(x[J] - x[I])
        values.append(slopes[I])
    return Coupling(np.concatenate(rows), np.concatenate(columns), np.concatenate(offsets), np.concatenate(values))


def node_slopes(
    scheme: Scheme, x: Array, measures: Array, J: int, reach: float, cells: Topology | Cells | None
) -> Array:
    """sum_L d(a_L b_jI^L)/dx_lJ for all nodes I at x (P, d): (P, j, l), from the cells closer than `reach` to node J.

    cells: the Voronoi cells' topology, in space the cells, where the reading of the measures is `edges`.
    """
    chosen = np.flatnonzero(np.linalg.norm(x - x[J], axis=1) < reach)
    of = moving(scheme, x, chosen)
    own = [part[:, [J]].toarray()[:, 0] for part in of(x, measures)] if scheme.cell_measure == "material" else None
    grown = measure_slopes(x, cells, J) if cells is not None else None
    d = x.shape[1]
    slopes = np.zeros((len(x), d, d))
    for axis in range(d):
        there = x.astype(complex)
        there[J, axis] += 1j * STEP
        changed = measures.astype(complex)
        if grown is not None:
            changed = changed + 1j * STEP * grown[:, axis]
        elif own is not None:  # a' = a tr L = a sum_J b_lJ v_lJ
            changed[chosen] += 1j * STEP * own[axis]
        for j, part in enumerate(of(there, changed)):
            slopes[:, j, axis] = part.sum(axis=0).imag / STEP
    return slopes
