"""The weak forms (7) and (37) over points with weights, in any dimension: what is left of left side less right side.

Every value is that at the point; which points and weights is the integration's matter, nodal or other.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.approximation import Vector
from rkverify.paper.kernel_rates import dot
from rkverify.paper.moment import Matrix
from rkverify.paper.numbered import equation


@dataclass(frozen=True)
class Inside:
    """A point of the domain: weight, delta u_i and its gradient [i][j], density, acceleration, stress, body force.

    For (7) gradient and weight belong to the undeformed domain and the stress is P[j][i] = P_ji; for (37) they belong to
    the deformed domain, the stress is the Cauchy stress, and density and body force are per deformed volume.
    """

    weight: Scalar
    delta_u: Vector
    gradient: Matrix
    density: Scalar
    acceleration: Vector
    stress: Matrix
    body_force: Vector


@dataclass(frozen=True)
class OnBoundary:
    """A point of the natural boundary: weight, delta u_i, traction h_i."""

    weight: Scalar
    delta_u: Vector
    traction: Vector


def _loads(inside: Sequence[Inside], boundary: Sequence[OnBoundary], K: Arithmetic) -> Scalar:
    """The virtual work of body forces and tractions."""
    body = sum((p.weight * dot(p.delta_u, p.body_force) for p in inside), K.zero())
    return body + sum((p.weight * dot(p.delta_u, p.traction) for p in boundary), K.zero())


def _inertia(inside: Sequence[Inside], K: Arithmetic) -> Scalar:
    """The virtual work of rho times the acceleration."""
    return sum((p.weight * p.density * dot(p.delta_u, p.acceleration) for p in inside), K.zero())


@equation(7)
def lagrangian_weak_form(inside: Sequence[Inside], boundary: Sequence[OnBoundary], K: Arithmetic) -> Scalar:
    """int delta u_i rho0 u_i'' + int delta F_ij P_ji - int delta u_i b0_i - int delta u_i h0_i   (7)."""
    internal = K.zero()
    for p in inside:
        axes = range(len(p.delta_u))
        for i in axes:
            for j in axes:
                internal = internal + p.weight * p.gradient[i][j] * p.stress[j][i]
    return _inertia(inside, K) + internal - _loads(inside, boundary, K)


@equation(37)
def updated_weak_form(inside: Sequence[Inside], boundary: Sequence[OnBoundary], K: Arithmetic) -> Scalar:
    """int delta u_(i,j) sigma_ij + int delta u_i rho u_i'' - int delta u_i b_i - int delta u_i h_i   (37)."""
    internal = K.zero()
    for p in inside:
        axes = range(len(p.delta_u))
        for i in axes:
            for j in axes:
                internal = internal + p.weight * (p.gradient[i][j] + p.gradient[j][i]) / 2 * p.stress[i][j]
    return internal + _inertia(inside, K) - _loads(inside, boundary, K)
