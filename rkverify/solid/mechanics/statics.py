"""Equilibrium of a body by Newton's method with the consistent tangent."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from rkverify.errors import BadInput, NotConverged
from rkverify.solid.kernel_values import Array
from rkverify.solid.mechanics.body import Body
from rkverify.solid.mechanics.nitsche import Nitsche
from rkverify.solid.mechanics.vectors import flat, nodal

LARGEST_COUNT = 30
"""Newton's method doubles the digits in every step once it converges: with that many steps it does not."""

ROUNDING = 16 * np.finfo(float).eps
"""Of the sum of the sizes of everything that is added up in the force on a node: rounding errors of some tens of terms, of either sign."""


@dataclass(frozen=True)
class Equilibrium:
    """Coefficients d (N, d), the body with its state there, and the largest residual force of each Newton step."""

    displacements: Array
    body: Body
    residuals: tuple[float, ...]


@dataclass(frozen=True)
class Problem:
    """Conditions in the sense of Nitsche, and dead loads (N, d) in units of force."""

    conditions: tuple[Nitsche, ...]
    load: Array


def residual(body: Body, problem: Problem, displacements: Array) -> tuple[Array, Array]:
    """f_int + conditions - f_ext (N, d), and the size of what is added up in it, so that rounding is a share of that.

    The rounding of F = 1 + sum_I b_I d_I is a share of 1 + sum_I |b_I d_I|, and reaches P multiplied by dP/dF.
    """
    F = body.deformation(displacements)
    P, moduli = body.law.advance(F, body.state).P, body.law.tangent(F, body.state)
    added = [condition.force(body, displacements, P, moduli) for condition in problem.conditions]
    total = sum(added, body.internal_force(P)) - problem.load
    sizes = [abs(part) for part in body.operator.parts]
    summed = 1 + np.stack([size @ abs(displacements) for size in sizes], axis=-1)
    stress = abs(P) + np.einsum("nijkl,nkl->nij", abs(moduli), summed)
    weighted = body.operator.measures[:, None, None] * stress
    size = sum((part.T @ weighted[:, :, j] for j, part in enumerate(sizes)), abs(problem.load))
    return total, size + sum(map(abs, added), 0 * total)


def tangent(body: Body, problem: Problem, displacements: Array, bent: bool = True) -> sp.csr_array:
    """The derivative (d N, d N) of the residual; bent: as in `Nitsche.stiffness`."""
    F = body.deformation(displacements)
    moduli = body.law.tangent(F, body.state)
    K = body.stiffness(moduli * body.operator.measures[:, None, None, None, None])
    for condition in problem.conditions:
        K = K + condition.stiffness(body, displacements, F, moduli, bent)
    return sp.csr_array(K)


def equilibrium(body: Body, problem: Problem, start: Array | None = None) -> Equilibrium:
    """The coefficients at which the residual is rounding.

    Raises NotConverged with the residual, BadInput where the tangent is singular.
    """
    d = np.zeros_like(body.cloud.positions) if start is None else np.array(start)
    history: list[float] = []
    for _ in range(LARGEST_COUNT):
        force, size = residual(body, problem, d)
        worst = float(abs(force).max())
        history.append(worst)
        allowed = ROUNDING * float(size.max())
        if worst <= allowed:
            return Equilibrium(d, body.advanced(d), tuple(history))
        if not np.isfinite(worst):
            break
        step = solve(tangent(body, problem, d, bent=len(history) > 1), flat(force))
        d = d - nodal(step, body.dimension)
    raise NotConverged(
        f"Newton's method left a residual of {history[-1]:.3g} after {len(history)} steps, {allowed:.3g} is rounding: apply the "
        "load in smaller steps"
    )


def equilibrium_in_steps(body: Body, problems: Sequence[Problem], start: Array | None = None) -> Equilibrium:
    """The equilibria of one problem after the other, each from the displacements and the state of the one before."""
    found = Equilibrium(np.zeros_like(body.cloud.positions) if start is None else start, body, ())
    for problem in problems:
        found = equilibrium(found.body, problem, found.displacements)
    return found


def solve(K: sp.csr_array, right: Array) -> Array:
    """K^-1 right with one step of iterative refinement.

    Raises BadInput where K is singular.
    """
    try:
        factors = splu(sp.csc_matrix(K))
    except RuntimeError:
        raise BadInput(
            "the tangent is singular: fix the body, or take an integration without zero-energy modes"
        ) from None
    x: Array = factors.solve(right)
    return x + factors.solve(right - K @ x)


def scaled(problem: Problem, share: float) -> Problem:
    """A share of the load and of the given displacements."""
    conditions = tuple(replace(c, given=share * c.given) for c in problem.conditions)
    return Problem(conditions, share * problem.load)
