"""The linear patch test of a body in double precision, and what rounding may do to it."""

import numpy as np
from scipy.linalg import lu

from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.measures import Measured, compared
from rkverify.certify.worst.running import SLACK, UNIT, Rounded, stacked
from rkverify.certify.worst.smoothed import boundary_rounding, gradient_rounding, vertex_shapes
from rkverify.certify.worst.tiling import measure_rounding
from rkverify.errors import Undecided
from rkverify.solid.gradients import scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import voronoi

LAME, SHEAR = 1.0, 0.5
STRAIN = (0.5, -0.25)
"""Powers of 2, so that they round nothing."""


def patch_case(case: WorstCase) -> Measured:
    """A linear elastic body by SCNI under the tractions of a uniform strain, held against rigid motions at nodes alone.

    Exactly, the coefficients d are the linear field: f = K d by the integration constraint and the linear sums, whatever the
    cells. In doubles K' d' = f' + e, so d' - d = K'^-1 (f' - K' d + e). Of f' - K' d, which is 0 without rounding, errors of
    shape functions at a vertex cancel as the shape functions do, so that they are followed with their signs. e is the
    backward error of the elimination, 3 n u |L||U| |d'| (Higham, 9.3). The condition number is that of the stiffness; raises
    Undecided where doubles do not know that it has an inverse.
    """
    cells = voronoi(case.nodes, case.box())
    operator = scni(case.cloud(), cells, "trapezoid")
    d, count = case.dimension, len(case.nodes)
    at, measures = vertex_shapes(case, cells), measure_rounding(cells, case.nodes)
    own, over = gradient_rounding(cells, measures, at), boundary_rounding(cells, at)
    strain, D = np.diag(STRAIN[:d]), _moduli(d)
    exact = (case.nodes @ strain).ravel()
    stress = (D @ strain.ravel()).reshape(d, d)
    B, A, C = _rows([part.toarray() for part in operator.parts]), np.kron(operator.measures, np.ones(d * d)), np.kron(np.eye(count), D)  # fmt: skip
    K, load = B.T @ (A[:, None] * (C @ B)), (operator.boundary.T @ stress).ravel()
    free = _free(case.nodes)
    right = load[free] - K[np.ix_(free, ~free)] @ exact[~free]
    own_part = K[np.ix_(free, free)]
    condition, n = float(np.linalg.cond(own_part)), len(right)
    if not condition < 1 / UNIT:
        raise Undecided("the stiffness has no inverse in double precision: smaller supports tell the nodes apart")
    found = np.linalg.solve(own_part, right)

    sizes = abs(B).T @ (A[:, None] * (abs(C) @ abs(B)))
    # Products of rows of count d^2 and d^2 numbers, one by the measure; sums of the right-hand side.
    rounding = UNIT * ((count * d * d + d * d + 2 + len(exact)) * sizes @ abs(exact) + (d + 1) * abs(load))
    left = _residual(own, over, measures, stress, D, case.nodes @ strain)
    P, L, U = lu(own_part)
    backward = 3 * n * UNIT * P @ abs(L) @ abs(U)
    inverse = np.linalg.inv(own_part)
    size = float(abs(exact).max())
    spread = abs(inverse) @ backward
    error = abs(found - exact[free])
    if abs(np.linalg.eigvals(spread)).max() >= 0.5:
        return compared(error, np.full(n, np.inf), size, condition)
    signed = abs(left.sources[:, free] @ inverse.T).sum(axis=0)
    alone = UNIT * left.error[free] + rounding[free] + backward @ abs(exact[free])
    bounds = np.linalg.solve(np.eye(n) - spread, UNIT * signed + abs(inverse) @ alone)
    return compared(error, SLACK * bounds, size, condition)


def _residual(
    own: list[Rounded], over: list[Rounded], measures: Rounded, stress: Array, D: Array, exact: Array
) -> Rounded:
    """What rounding leaves of f - K d (N d,) where products round nothing: integration constraint and linear sums.

    f_iI - sum_L A_L b_jI sigma_ij, less sum_L A_L b_jI D_ijkl eta_kl with eta the error of the strain sum_I b_lI d_kI.
    """
    b, edge, d = stacked(own), stacked(over), len(own)
    A = measures.value
    constraint = edge.sources - np.einsum("L,sjLI->sjI", A, b.sources)
    unsigned = edge.error + np.einsum("L,jLI->jI", A, b.error) + np.einsum("L,jLI->jI", measures.reach, abs(b.value))
    eta, eta_alone = np.einsum("slLI,Ik->skLl", b.sources, exact), np.einsum("lLI,Ik->kLl", b.error, abs(exact))
    C = D.reshape(d, d, d, d)
    shared = np.einsum("sjI,ij->sIi", constraint, stress) - np.einsum("L,jLI,ijkl,skLl->sIi", A, b.value, C, eta, optimize=True)  # fmt: skip
    error = np.einsum("jI,ij->Ii", unsigned, abs(stress)) + np.einsum("L,jLI,ijkl,kLl->Ii", A, abs(b.value), abs(C), eta_alone, optimize=True)  # fmt: skip
    count = error.size
    return Rounded(np.zeros(count), error.ravel(), shared.reshape(len(shared), count))


def _moduli(d: int) -> Array:
    """C_ijkl = lambda delta_ij delta_kl + mu (delta_ik delta_jl + delta_il delta_jk) as a matrix (d^2, d^2)."""
    one = np.eye(d)
    C = LAME * np.einsum("ij,kl->ijkl", one, one) + SHEAR * (np.einsum("ik,jl->ijkl", one, one) + np.einsum("il,jk->ijkl", one, one))  # fmt: skip
    return C.reshape(d * d, d * d)


def _rows(parts: list[Array]) -> Array:
    """Rows (L d^2,) of du_i/dX_j from coefficients (N d,)."""
    d, (count, nodes) = len(parts), parts[0].shape
    B = np.zeros((count, d, d, nodes, d))
    for i in range(d):
        for j in range(d):
            B[:, i, j, :, i] = parts[j]
    return B.reshape(count * d * d, nodes * d)


def _free(nodes: Array) -> Array:
    """Which coefficients are free (N d,): the first node is held, in the plane also the one farthest from it, across the way."""
    count, d = nodes.shape
    free = np.ones((count, d), dtype=bool)
    free[0] = False
    if d == 2:
        away = nodes - nodes[0]
        far = int(np.argmax((away**2).sum(axis=1)))
        free[far, int(np.argmin(abs(away[far])))] = False
    return free.ravel()
