"""Finite chains of uneven nodes at rest: growth by the eigenvalues of the whole chain's linear equations.

Dead loads hold the state at the start, whatever forces a uniform stress leaves on uneven nodes.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from rkverify.arithmetic.native import rational
from rkverify.readings import Derivative, Integration, Readings
from rkverify.solid.chain import Chain, Motion, rates
from rkverify.solid.integrate import PARTS, integrate, pack
from rkverify.solid.kernel_values import Array
from rkverify.solid.tangent import change_of_rates, changed
from rkverify.stability.jacobian_solid import base_chain
from rkverify.stability.lattice_state import Base

Row = dict[str, Any]

AMPLITUDE = 1e-6
"""Velocity of the disturbance over the wave speed."""

NONE = 1e-4
"""Growth below this (c/h) is none: eigenvalue 0 is a multiple one, and known to a root of rounding."""

E_FOLDINGS = 4.0
"""How many times the growing disturbance grows by e before it is measured."""


def uneven_chain(base: Base, count: int, jitter: float, seed: int) -> tuple[Chain, Motion]:
    """A chain with free ends whose inner nodes are off the lattice by up to jitter h, under dead loads at rest.

    Supports are R h for all nodes, cells reach half-way to the neighbours, masses are those of the cells.
    """
    chain, still = base_chain(base, count)
    h = float(rational(base.spacing))
    offsets = np.random.default_rng(seed).uniform(-jitter, jitter, count) * h
    offsets[[0, -1]] = 0.0
    x = still.x + offsets
    middles = np.concatenate([x[:1], (x[:-1] + x[1:]) / 2, x[-1:]])
    lengths = np.diff(middles)
    start = replace(still, x=x, edges=middles[1:], measures=lengths, period=0.0, period_rate=0.0)
    free = replace(chain, periodic=False, masses=lengths.copy())
    return replace(free, external=rates(free, start).internal), start


def growth(chain: Chain, start: Motion) -> tuple[float, Array]:
    """The largest growth (1/time) of a disturbance of the chain, and its shape (5 N,), complex where it oscillates."""
    size = len(PARTS) * len(start.x)
    J = np.stack([change_of_rates(chain, start, column)[1] for column in np.eye(size)], axis=1)
    values, vectors = np.linalg.eig(J)
    fastest = int(np.argmax(values.real))
    return float(values[fastest].real), vectors[:, fastest]


def measured(chain: Chain, start: Motion, rate: float, shape: Array) -> float:
    """The growth (1/time) of that disturbance in the nonlinear equations over some e-folding times.

    Its real and its imaginary part run one after the other.
    """
    scale, time = AMPLITUDE / abs(shape).max(), E_FOLDINGS / rate

    def after(push: Array) -> Array:
        return pack(integrate(chain, changed(start, push), [0.0, time], 1e-12, 1e-14)[-1])

    still = after(np.zeros_like(shape.real))
    left = sum(unit * (after(scale * part) - still) for unit, part in ((1.0, shape.real), (1j, shape.imag)))
    return float(np.log(np.linalg.norm(left) / np.linalg.norm(scale * shape)) / time)


def rows(
    cases: Sequence[tuple[Integration, Derivative, str]],
    stresses: Sequence[str],
    jitters: Sequence[str],
    count: int,
    seeds: int,
) -> list[Row]:
    """Growth h/c for every method, stress and jitter: the least and the largest over the seeds, the first one measured.

    unstable: in how many of the seeds the chain grows.
    """
    found = []
    for (integration, derivative, R), s, jitter in product(cases, stresses, jitters):
        base = Base(R, Readings(integration, "none", derivative), s)
        chains = [uneven_chain(base, count, float(rational(jitter)), seed) for seed in range(seeds)]
        modes = [growth(chain, start) for chain, start in chains]
        rates_found = [rate if rate > NONE else 0.0 for rate, _ in modes]
        agrees = rates_found[0] == 0.0 or abs(measured(*chains[0], *modes[0]) / rates_found[0] - 1) <= 1e-3
        found.append(
            {
                "integration": integration,
                "derivative": derivative,
                "support_ratio": R,
                "stress_ratio": s,
                "jitter": jitter,
                "least": min(rates_found),
                "largest": max(rates_found),
                "unstable": sum(rate > 0 for rate in rates_found),
                "measured_agrees": agrees,
            }
        )
    return found
