"""The linearised equations of one node through `solid/`, by complex steps on a periodic chain."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np

from rkverify.arithmetic.native import Float, rational
from rkverify.kernels import kernel
from rkverify.solid.chain import Chain, Motion, consistent_mass, rates, unbalanced
from rkverify.stability.lattice_state import Base

STEP = 1e-30
"""Imaginary step: no difference is formed, so that it may be far below rounding."""

FIELDS = {"x": "x", "v": "v", "stress": "stress", "edge": "edges", "measure": "measures"}


def base_chain(base: Base, count: int) -> tuple[Chain, Motion]:
    """The base state on a periodic chain of `count` nodes, node 0 at x = 0, modulus 1."""
    R, S, Q, h, V, rho = (
        float(rational(q))
        for q in (
            base.support_ratio,
            base.stress_ratio,
            base.velocity_gradient,
            base.spacing,
            base.frame_velocity,
            base.density,
        )
    )
    x = (np.arange(count) - count // 2) * h
    ones = np.ones(count)
    origin, period = (1 - S) * x, count * h
    chain = Chain(
        support=R * h,
        modulus=1.0,
        masses=rho * h * ones,
        kernel=kernel(base.kernel) if isinstance(base.kernel, str) else base.kernel,
        order=base.order,
        readings=base.readings,
        periodic=True,
        origin=origin,
        origin_period=(1 - S) * period,
        support_ratio=R,
    )
    return chain, Motion(x, V + Q * x, S * ones, x + h / 2, h * ones, period, Q * period)


def stencil(base: Base) -> dict[tuple[str, str], dict[int, float]]:
    """(rate, variable) -> shift -> derivative at the middle node, as `linearise` of the other route gives it."""
    _, reach = base.reach(Float())
    count = 2 * reach + 2 * int(Fraction(rational(base.support_ratio))) + 6
    chain, motion = base_chain(base, count)
    middle, shifts = count // 2, range(-reach, reach + 1)
    rate = _with_lumped_mass if base.readings.mass == "lumped" else _with_consistent_mass
    of = rate(chain, motion)
    found: dict[tuple[str, str], dict[int, float]] = {(row, column): {} for row in base.kinds for column in base.kinds}
    for column in base.kinds:
        for n in shifts:
            values = getattr(motion, FIELDS[column]).astype(complex)
            values[middle + n] += 1j * STEP
            changed = of(replace(motion, **{FIELDS[column]: values}))
            for row in base.kinds:
                found[row, column][n] = float(getattr(changed, FIELDS[row])[middle].imag / STEP)
    if base.readings.mass == "consistent":
        M = consistent_mass(chain, motion)[middle] / chain.masses[middle]
        found["mass", "v"] = {n: float(M[middle + n]) for n in shifts}
    return found


def _with_lumped_mass(chain: Chain, motion: Motion) -> Callable[[Motion], Motion]:
    return lambda changed: rates(chain, changed).motion


def _with_consistent_mass(chain: Chain, motion: Motion) -> Callable[[Motion], Motion]:
    """The rates with -(f + N v + M v') / m in place of v', the accelerations of the base held."""
    lumped = replace(chain, readings=replace(chain.readings, mass="lumped"))
    still = rates(lumped, motion).motion.v
    period = (still[len(still) // 2 + 1] - still[len(still) // 2]) * len(still)

    def of(changed: Motion) -> Motion:
        left = unbalanced(lumped, changed, still, period) / chain.masses
        return replace(rates(lumped, changed).motion, v=left)

    return of
