"""A body in motion in its reference configuration (18): central differences, their critical step, accounts on the way."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import eigsh

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.law import Hyperelastic
from rkverify.solid.mechanics.accounts import Account, account
from rkverify.solid.mechanics.body import Body

LARGEST_DENSE = 400
"""Unknowns up to which all eigenvalues are computed at once."""


@dataclass(frozen=True)
class Swing:
    """Coefficients d (N, d), their velocities half a step before (N, d), the body with its state at d, and the time."""

    displacements: Array
    half_velocities: Array
    body: Body
    time: float = 0.0


def critical_step(body: Body, displacements: Array | None = None) -> float:
    """dt = 2/omega_max of the lumped mass and the tangent at the given displacements, beyond which central differences grow."""
    d = np.zeros_like(body.cloud.positions) if displacements is None else displacements
    F = body.deformation(d)
    K = body.stiffness(body.law.tangent(F, body.state) * body.operator.measures[:, None, None, None, None])
    root = sp.diags_array(1 / np.sqrt(np.tile(body.lumped_mass(), body.dimension)))
    A = root @ K @ root
    if A.shape[0] <= LARGEST_DENSE:
        largest = float(np.linalg.eigvalsh(A.toarray())[-1])
    else:
        start = np.random.default_rng(0).standard_normal(A.shape[0])
        largest = float(eigsh(A, 1, which="LA", v0=start, return_eigenvectors=False)[0])
    if not largest > 0:
        raise BadInput("no mode has a stiffness: every time step is stable")
    return float(2 / np.sqrt(largest))


def central_differences(
    swing: Swing, dt: float, steps: int, load: Callable[[float], Array] | None = None
) -> Iterator[tuple[Swing, Account]]:
    """The body after each step of M u'' = f_ext - f_int with the lumped mass, with the account at the step's beginning.

    half_velocities of the first swing are taken at its own time. Velocities in an account are the mean of those half a step before and
    after. load: time -> nodal forces (N, d).

    Raises BadInput for a step that is not positive.
    """
    if not dt > 0:
        raise BadInput(f"time step {dt:g}: it must be positive")
    mass = swing.body.lumped_mass()
    before, first, worked = swing.half_velocities, True, 0.0
    for _ in range(steps):
        body = swing.body
        force = -body.internal_force(body.state.P)
        if load is not None:
            force = force + load(swing.time)
        push = force / mass[:, None] * dt
        # The first half step leads from the given velocities to the middle of the step.
        now, after = (before, before + push / 2) if first else (before + push / 2, before + push)
        positions = body.cloud.positions + swing.displacements
        entry = account(swing.time, mass, positions, now, stored_energy(body) if _elastic(body) else worked)
        step = dt * after
        moved = body.advanced(swing.displacements + step)
        if not _elastic(body):
            P = (body.state.P + moved.state.P) / 2
            worked += float((P * (moved.state.F - body.state.F) * body.operator.measures[:, None, None]).sum())
        swing = replace(
            swing, displacements=swing.displacements + step, half_velocities=after, body=moved, time=swing.time + dt
        )
        before, first = after, False
        yield swing, entry


def _elastic(body: Body) -> bool:
    return isinstance(body.law, Hyperelastic)


def stored_energy(body: Body) -> float:
    """sum_L W(F_L) A_L of a hyperelastic body at its state.

    Raises BadInput for a law without energy.
    """
    if not isinstance(body.law, Hyperelastic):
        raise BadInput(f"{type(body.law).__name__} has no stored energy: take a hyperelastic law")
    return float(body.law.stored_energy(body.state) @ body.operator.measures)
