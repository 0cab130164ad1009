"""The semi-discrete semi-Lagrangian equations on a chain of nodes, vectorised; periodic, or finite with free ends.

A periodic chain repeats after `period`, and its images move away at the rate `period_rate`, so that an affine base
motion v = Q x fits on it.
"""

from dataclasses import dataclass, replace

import numpy as np

from rkverify.kernels import Kernel
from rkverify.readings import Readings
from rkverify.solid.kernel_values import Array
from rkverify.solid.line import Line, line


@dataclass(frozen=True)
class Chain:
    """Support radius a (length), modulus (stress), cell masses (N,), kernel, order, readings; period None if finite.

    origin (N,): the X_J from which the literal stress (69) counts displacements, with its own period. support_ratio:
    the R of supports that follow the spacing. external (N,): nodal forces.
    """

    support: float
    modulus: float
    masses: Array
    kernel: Kernel
    order: int
    readings: Readings
    periodic: bool
    origin: Array | None = None
    origin_period: float = 0.0
    support_ratio: float = 0.0
    external: Array | float = 0.0


@dataclass(frozen=True)
class Motion:
    """Positions, velocities, stresses, right ends of the cells and cell measures (N,); the period and its rate."""

    x: Array
    v: Array
    stress: Array
    edges: Array
    measures: Array
    period: float = 0.0
    period_rate: float = 0.0


@dataclass(frozen=True)
class _At:
    """The approximation at some points, with the image of every node that is nearest to each point."""

    line: Line
    images: Array
    v: Array


def _at(chain: Chain, motion: Motion, points: Array) -> _At:
    y = points[:, None] - motion.x[None, :]
    images = np.round(y.real / motion.period) if chain.periodic else np.zeros(y.shape)
    supports = _supports(chain, motion)
    near = line(y - images * motion.period, supports, chain.kernel, chain.order)
    return _At(near, images, motion.v[None, :] + images * motion.period_rate)


def _following_spacing(chain: Chain, values: Array, period: float) -> Array:
    """R times half the distance between the neighbours, of positions; or its rate, of velocities; one-sided at free ends."""
    if chain.periodic:
        after, before = np.roll(values, -1), np.roll(values, 1)
        after[-1], before[0] = after[-1] + period, before[0] - period
        return chain.support_ratio * (after - before) / 2
    return chain.support_ratio * np.gradient(values)


def _supports(chain: Chain, motion: Motion) -> Array:
    if chain.readings.support_radius == "fixed":
        return np.full(len(motion.x), chain.support)
    return _following_spacing(chain, motion.x, motion.period)


def _cells(chain: Chain, motion: Motion) -> tuple[Array, Array]:
    """Left and right ends of the cells; the ends of a finite chain's outer cells are at its outer nodes."""
    if chain.readings.cell_edges == "voronoi":
        following = np.roll(motion.x, -1)
        if chain.periodic:
            following[-1] = following[-1] + motion.period
            right = (motion.x + following) / 2
        else:
            right = np.append((motion.x[:-1] + motion.x[1:]) / 2, motion.x[-1:])
    else:
        right = motion.edges
    left = np.roll(right, 1)
    left[0] = right[-1] - motion.period if chain.periodic else motion.x[0]
    return left, right


@dataclass(frozen=True)
class Rates:
    """The rates of everything in a `Motion`, and the parts of the nodal force."""

    motion: Motion
    internal: Array
    convective: Array
    mass: Array


def rates(chain: Chain, motion: Motion) -> Rates:
    """Time derivatives of positions, velocities, stresses, edges and measures."""
    r = chain.readings
    here = _at(chain, motion, motion.x)
    Psi = here.line.shape()
    left, right = _cells(chain, motion)
    length = right - left
    measure = length if r.cell_measure == "edges" else motion.measures
    if r.integration == "scni":
        at_right, at_left = _at(chain, motion, right), _at(chain, motion, left)
        PsiR, PsiL = at_right.line.shape(), at_left.line.shape()
        B_measure = PsiR - PsiL
        B = B_measure / measure[:, None]
        # An image of a node may be another one at the two ends of a cell: each end takes its own.
        flux = (PsiR * at_right.v).sum(axis=1) - (PsiL * at_left.v).sum(axis=1)
        L = flux / measure
    else:
        B = here.line.gradient(r.derivative)
        B_measure = B * measure[:, None]
        L = (B * here.v).sum(axis=1)
    stress = (
        _literal_stress(chain, motion, here, B, left, right, measure) if r.stress_law == "literal" else motion.stress
    )
    internal = B_measure.T @ stress
    mass = Psi.T @ chain.masses
    x_rate = motion.v if r.node_motion == "coefficient" else (Psi * here.v).sum(axis=1)
    convective = np.zeros_like(internal)
    if r.convection != "none":
        w = x_rate[:, None] - here.v
        seen = w
        if r.support_radius == "spacing":
            growth = _following_spacing(chain, motion.v, motion.period_rate) / _supports(chain, motion)
            seen = w - here.line.y * growth[None, :]
        carried = here.line.kernel_rate(seen) if r.convection == "psi-star" else here.line.rate(w, seen)
        own, total = (carried * here.v).sum(axis=1), carried.sum(axis=1)
        # Node I sees the image of cell K that is nearest to it: all velocities there are lower by as many period rates
        # as the image of I near K is periods away. It matters unless the carried rates sum to zero.
        lower = (Psi * here.images).T @ (chain.masses * total) * motion.period_rate
        convective = Psi.T @ (chain.masses * own) - lower
    tangent = chain.modulus + (motion.stress if r.stress_law == "truesdell" else 0.0)
    edge_rate = np.zeros_like(motion.edges)
    if r.cell_edges == "material":
        at_edges = _at(chain, motion, motion.edges)
        edge_rate = (at_edges.line.shape() * at_edges.v).sum(axis=1)
    force = chain.external - internal - convective
    done = replace(
        motion,
        x=x_rate,
        v=force / mass if r.mass == "lumped" else np.linalg.solve(consistent_mass(chain, motion), force),
        stress=tangent * L,
        edges=edge_rate,
        measures=motion.measures * L if r.cell_measure == "material" else np.zeros_like(motion.measures),
        period=motion.period_rate,
        period_rate=0.0,
    )
    return Rates(done, internal, convective, mass)


def consistent_mass(chain: Chain, motion: Motion) -> Array:
    """M_IJ = sum_K m_K Psi_I(x_K) Psi_J(x_K) (42) integrated at the nodes (N, N)."""
    Psi = _at(chain, motion, motion.x).line.shape()
    return Psi.T @ (chain.masses[:, None] * Psi)


def unbalanced(chain: Chain, motion: Motion, accelerations: Array, period_acceleration: float) -> Array:
    """f_ext - (f_int + N v + M v') with the consistent mass for given accelerations (N,), of whose images each is farther by a period."""
    here = _at(chain, motion, motion.x)
    Psi, now = here.line.shape(), rates(chain, motion)
    # As for N: node I sees the image of cell K that is nearest to it.
    at_cells = Psi @ accelerations + (Psi * here.images).sum(axis=1) * period_acceleration
    lower = (Psi * here.images).T @ (chain.masses * Psi.sum(axis=1)) * period_acceleration
    return chain.external - (now.internal + now.convective + Psi.T @ (chain.masses * at_cells) - lower)


def _literal_stress(
    chain: Chain, motion: Motion, here: _At, B: Array, left: Array, right: Array, measure: Array
) -> Array:
    """C sum_J B_J u_J (69), every image with the displacement of its own."""
    if chain.origin is None:
        raise ValueError("the literal stress needs the origin of the displacements")
    u = motion.x - chain.origin
    growth = motion.period - chain.origin_period
    if chain.readings.integration == "dni":
        return chain.modulus * (B * (u[None, :] + here.images * growth)).sum(axis=1)
    ends = [_at(chain, motion, points) for points in (right, left)]
    values = [(end.line.shape() * (u[None, :] + end.images * growth)).sum(axis=1) for end in ends]
    return chain.modulus * (values[0] - values[1]) / measure
