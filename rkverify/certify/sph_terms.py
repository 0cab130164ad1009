"""(41) with Psi_I = V_I W against the momentum equations of SPH, term by term, in exact rationals on uneven nodes.

V_I = m_I/rho_I with rho_I = sum_J m_J W(x_I - x_J), stress from (C + sigma) rho = const; unit modulus and masses.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.native import Exact
from rkverify.certify.sph_relations import kernel_derivative
from rkverify.paper.approximation import approximation
from rkverify.paper.shape import shape_gradient

Row = dict[str, Any]
K = Exact()


def uneven_nodes(count: int, step: Fraction) -> list[Fraction]:
    """x_I = I + step (I^2 mod 5 - 2): uneven for all to see, without chance."""
    return [I + step * (I * I % 5 - 2) for I in range(count)]


def _W(R: str, y: Fraction, order: int) -> Fraction:
    value = kernel_derivative("cubic", R, abs(y), order, K)
    return -value if order == 1 and y < 0 else value


def term_rows(nodes: Sequence[Fraction], support_ratio: str, stress: Fraction, reach: int) -> list[Row]:
    """Masses and forces at the nodes that are farther than `reach` from the ends, with v_I = (I mod 3) - 1 in N.

    force_41: sum_K V_K sigma_K Psi_I,x(x_K); force_sph: -m_I sum_J m_J (sigma_I + sigma_J)/(rho_I rho_J) W'(x_I - x_J);
    missing: -V_I sigma_I sum_J V_J W'(x_I - x_J); corrected: the same force with the corrected gradients; rk: sum_K V_K
    sigma_K Psi_I,x(x_K) with the RK shape functions of order 1 and the full derivative.
    """
    N = range(len(nodes))
    W = [[_W(support_ratio, nodes[K_] - nodes[J], 0) for J in N] for K_ in N]
    slope = [[_W(support_ratio, nodes[K_] - nodes[J], 1) for J in N] for K_ in N]
    rho = [sum(row, Fraction(0)) for row in W]
    V = [1 / r for r in rho]
    middle = len(nodes) // 2
    sigma = [(1 + stress) * rho[middle] / r - 1 for r in rho]
    L = [sum((V[J] * (nodes[J] - nodes[I]) * slope[I][J] for J in N), Fraction(0)) for I in N]
    v = [Fraction(I % 3 - 1) for I in N]
    carried = [sum((V[J] * slope[K_][J] * (v[K_] - v[J]) * v[J] for J in N), Fraction(0)) for K_ in N]
    A = approximation([[x] for x in nodes], Fraction(support_ratio), K)
    gradients = [shape_gradient(A, A.nodes[K_], 0, "full") for K_ in N]
    rows = []
    for I in range(reach, len(nodes) - reach):
        force_41 = sum((V[K_] * sigma[K_] * V[I] * slope[K_][I] for K_ in N), Fraction(0))
        force_sph = -sum(((sigma[I] + sigma[J]) * V[I] * V[J] * slope[I][J] for J in N), Fraction(0))
        symmetric = -sum(((sigma[I] / rho[I] ** 2 + sigma[J] / rho[J] ** 2) * slope[I][J] for J in N), Fraction(0))
        missing = -V[I] * sigma[I] * sum((V[J] * slope[I][J] for J in N), Fraction(0))
        corrected = -sum(((sigma[I] / L[I] + sigma[J] / L[J]) * V[I] * V[J] * slope[I][J] for J in N), Fraction(0))
        rk = sum((V[K_] * sigma[K_] * gradients[K_].get(I, Fraction(0)) for K_ in N), Fraction(0))
        rows.append(
            {
                "node": I,
                "mass": float(sum((V[I] * W[K_][I] for K_ in N), Fraction(0))),
                "force_41": float(force_41),
                "force_sph": float(force_sph),
                "missing": float(missing),
                "equal": force_sph == force_41 + missing,
                "symmetric": float(symmetric),
                "corrected": float(corrected),
                "rk": float(rk),
                "convective": float(sum((V[I] * W[K_][I] * carried[K_] for K_ in N), Fraction(0))),
            }
        )
    return rows
