"""The control: essential conditions at boundary nodes alone, sum_J Psi_J(X_I) d_J = g(X_I), by the transformation of coefficients.

Between the nodes neither the displacement nor its variation is what it should be, and the patch test is not passed.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from rkverify.errors import NotConverged
from rkverify.solid.kernel_values import Array
from rkverify.solid.mechanics.body import Body
from rkverify.solid.mechanics.statics import LARGEST_COUNT, ROUNDING, Equilibrium, Problem, residual, solve, tangent
from rkverify.solid.mechanics.vectors import flat, nodal


@dataclass(frozen=True)
class AtNodes:
    """The field has the values g (n, d) at the chosen nodes (n,)."""

    nodes: Array
    given: Array


def equilibrium_with_nodes(body: Body, held: AtNodes, load: Array) -> Equilibrium:
    """Coefficients that meet the condition at the nodes, in equilibrium for all variations that are zero there.

    Raises NotConverged, and BadInput where the system is singular.
    """
    problem = Problem((), load)
    rows = sp.csr_array(body.values[held.nodes])
    G = sp.csr_array(sp.block_diag([rows] * body.dimension))
    none = sp.csr_array((G.shape[0], G.shape[0]))
    d, multipliers = np.zeros_like(body.cloud.positions), np.zeros(G.shape[0])
    history: list[float] = []
    for _ in range(LARGEST_COUNT):
        force, size = residual(body, problem, d)
        reaction = G.T @ multipliers
        unmet = flat(held.given - rows @ d)
        out = flat(force) - reaction
        history.append(float(abs(out).max()))
        allowed = ROUNDING * float((size + abs(nodal(reaction, body.dimension))).max())
        if history[-1] <= allowed and abs(unmet).max() <= ROUNDING * (1 + abs(held.given).max()):
            return Equilibrium(d, body.advanced(d), tuple(history))
        system = sp.csr_array(sp.block_array([[tangent(body, problem, d), -G.T], [G, none]]))
        step = solve(system, np.concatenate([-out, unmet]))
        d = d + nodal(step[: d.size], body.dimension)
        multipliers = multipliers + step[d.size :]
    raise NotConverged(
        f"Newton's method left a residual of {history[-1]:.3g} after {len(history)} steps, {allowed:.3g} is rounding: apply the "
        "load in smaller steps"
    )
