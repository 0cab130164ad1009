"""Finite irregular sets of nodes in a stressed plane whose rim is held, by the eigenvalues of all their equations at once.

Held are the nodes near the boundary, whose shape functions reach it, or cells at the rim: a body with free edges under dead loads has instabilities of its
own, as its rotation under compression, that say nothing about the discretisation. Dead loads take what a uniform stress leaves on
uneven nodes.
"""

from dataclasses import dataclass

import numpy as np

from rkverify.solid.domain import Box, box
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import topology, voronoi
from rkverify.stability.bloch.cell_integrals import conforming, dense, moving
from rkverify.stability.bloch.linearised import node_slopes
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme

RIM = 1.7
"""Nodes nearer to the boundary than the support and this are held: what the others see lies well inside."""


@dataclass(frozen=True)
class HeldCloud:
    """Positions (N, 2) in a box, and the F free nodes; b_jI^L of all cells (N, F, 2), a (N,), m (F,), geometric (F, 2, F, 2)."""

    positions: Array
    free: Array
    gradients: Array
    measures: Array
    masses: Array
    geometric: Array


def uneven_square(count: int, jitter: float, seed: int) -> tuple[Array, Box]:
    """count by count nodes with spacing 1, every coordinate off its place by up to the jitter, and the box half a spacing beyond."""
    places = np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), axis=-1).reshape(-1, 2)
    offsets = np.random.default_rng(seed).uniform(-jitter, jitter, places.shape)
    return places + offsets, box([-0.5, -0.5], [count - 0.5, count - 0.5])


def held_cloud(positions: Array, domain: Box, scheme: Scheme) -> HeldCloud:
    """The linear equations of the nodes that are farther than support and RIM from the boundary of the domain."""
    low, high = domain.bounds
    inside = np.minimum(positions - low, high - positions).min(axis=1)
    free = np.flatnonzero(inside >= scheme.reach + RIM)
    cells = voronoi(positions, domain)
    a = cells.measures
    Psi = dense(scheme.cloud(positions), positions)
    # The others see no free node; at the rim boxes leave the domain and corners may lie where nothing is defined.
    apart = np.linalg.norm(positions[:, None] - positions[None, free], axis=2).min(axis=1)
    near = np.flatnonzero(apart < scheme.reach + 1.0)
    b = np.zeros((len(positions), len(positions), 2))
    if scheme.integration == "scni":
        # facets between cells count twice with opposite signs: the sum over cells has no derivative but zero
        b[near] = conforming(scheme, positions, cells, near)
        geometric = np.zeros((len(free), 2, len(free), 2))
    else:
        b[near] = np.stack([p.toarray() for p in moving(scheme, positions, near)(positions, a)], axis=2)
        geometric = _geometric(positions, domain, scheme, a, free)
    b[near] /= a[near, None, None]
    return HeldCloud(positions, free, b[:, free], a, (a @ Psi)[free], geometric)


def _geometric(x: Array, domain: Box, scheme: Scheme, a: Array, free: Array) -> Array:
    cells = topology(x, domain) if scheme.cell_measure == "edges" else None
    reach = scheme.reach + (0.0 if scheme.integration == "dni" else float(a.max() / 2) ** 0.5)
    reach = max(reach, 2.0 * float(a.max()) ** 0.5)
    slopes = [node_slopes(scheme, x, a, J, reach, cells)[free] for J in free.tolist()]
    return np.stack(slopes, axis=2)


def growth(cloud: HeldCloud, loading: Loading) -> float:
    """The largest Re (-omega^2)^(1/2) over the modes of the free nodes, 1/time."""
    size = 2 * len(cloud.free)
    stressed = np.einsum("ijkl,LJl->LijJk", loading.tangent, cloud.gradients, optimize=True)
    K = np.einsum("L,LIj,LijJk->IiJk", cloud.measures, cloud.gradients, stressed, optimize=True)
    K = K + np.einsum("ij,IjJl->IiJl", loading.sigma, cloud.geometric, optimize=True)
    values = np.linalg.eigvals(K.reshape(size, size) / np.repeat(cloud.masses, 2)[:, None])
    return float(np.sqrt(-values.astype(complex)).real.max())
