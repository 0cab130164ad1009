"""The Lagrangian bar linearised about a uniform stretch, through both routes, and measured."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import rational
from rkverify.kernels import kernel
from rkverify.paper.approximation import approximation, lattice, middle
from rkverify.paper.cells import Cell, lattice_cell
from rkverify.paper.lagrangian_equations import LagrangianChain, gradient
from rkverify.paper.shape import shape_functions
from rkverify.readings import Derivative, Integration, Mass
from rkverify.solid.bar import Bar, periodic_bar


@dataclass(frozen=True)
class StretchedBar:
    """Nodes h apart, moved by u_I = (stretch - 1) X_I; R = a/h, S/C^SE and stretch dimensionless; rho_0 = C^SE = 1.

    stress_ratio is S/C^SE where F = stretch, as F of the cells is unless the reading's gradients do not reproduce X.
    """

    support_ratio: Scalar
    integration: Integration
    stress_ratio: Scalar = 0
    stretch: Scalar = 1
    spacing: Scalar = 1
    derivative: Derivative = "full"
    kernel: str = "cubic"
    order: int = 1
    mass: Mass = "lumped"

    @property
    def reach(self) -> int:
        """How many cells to each side a node's force involves."""
        return int(rational(self.support_ratio) + Fraction(1, 2)) + 1


def stencil(base: StretchedBar, K: Arithmetic) -> dict[int, Scalar]:
    """shift -> derivative of -f_I / m_I, which is u'' with the lumped mass, with respect to its neighbour's displacement, by duals through `paper/`."""
    reach = 2 * base.reach
    centre = reach + int(rational(base.support_ratio)) + 2
    h, F, S = K.number(base.spacing), K.number(base.stretch), K.number(base.stress_ratio)
    places = [K.number(J) * h for J in range(-centre, centre + 1)]
    A = approximation([[X] for X in places], K.number(base.support_ratio) * h, K, base.kernel, base.order)
    D = Duals(K, 2 * reach + 1)
    around = range(centre - base.reach, centre + base.reach + 1)
    cells = {L: lattice_cell(places[L], h) for L in around}
    each = {L: gradient(A, L, cell, base.integration, base.derivative) for L, cell in cells.items()}
    chain = LagrangianChain(
        gradients={L: {I: D.number(b) for I, b in values.items()} for L, values in each.items()},
        cells={L: Cell(D.number(cell.left), D.number(cell.right)) for L, cell in cells.items()},
        rho_0=D.number(1),
        modulus=D.number(1),
        prestress=D.number(S),
        stretch=D.number(F),
        K=D,
    )
    displacements = [
        D.variable((F - 1) * X, J - centre + reach) if abs(J - centre) <= reach else D.number((F - 1) * X)
        for J, X in enumerate(places)
    ]
    slopes = chain.acceleration(centre, displacements).partials
    return {n: slopes[n + reach] for n in range(-reach, reach + 1)}


def mass_stencil(base: StretchedBar, K: Arithmetic) -> dict[int, Scalar]:
    """shift -> M_IJ / m_I of the mass (19) integrated at the nodes; 1 at shift 0 for the lumped mass."""
    if base.mass == "lumped":
        return {0: K.number(1)}
    A = lattice(base.spacing, base.support_ratio, 2 * base.reach, K, base.kernel, base.order)
    centre = middle(A)
    # Psi_I is even about its node and the same for every node, so that M is Psi folded with itself.
    Psi = {J - centre: value for J, value in shape_functions(A, A.nodes[centre]).items()}
    row: dict[int, Scalar] = {}
    for (i, p), (j, q) in product(Psi.items(), Psi.items()):
        row[i + j] = row.get(i + j, K.zero()) + p * q
    return row


def bar(base: StretchedBar, count: int) -> Bar:
    """The same bar by the other route, periodic."""
    R, S, F, h = (float(rational(q)) for q in (base.support_ratio, base.stress_ratio, base.stretch, base.spacing))
    return periodic_bar(
        count, h, R, base.integration, base.derivative, kernel(base.kernel), base.order, (1.0, S, F), base.mass
    )


def stencil_by_complex_step(base: StretchedBar) -> dict[int, float]:
    """The stencil through `solid/`."""
    count = 4 * base.reach + 4
    chain = bar(base, count)
    middle, step = count // 2, 1e-30
    found = {}
    for J in range(-2 * base.reach, 2 * base.reach + 1):
        u = np.zeros(count, dtype=complex)
        u[middle + J] = 1j * step
        found[J] = float(chain.acceleration(u)[middle].imag / step)
    return found
