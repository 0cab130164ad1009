"""The linearised equations of one node through `solid/`, by complex steps on a periodic chain."""

from dataclasses import replace
from fractions import Fraction

import numpy as np

from rkverify.arithmetic.native import Float, rational
from rkverify.kernels import kernel
from rkverify.solid.chain import Chain, Motion, rates
from rkverify.stability.lattice_state import Base

STEP = 1e-30
"""Imaginary step: no difference is formed, so that it may be far below rounding."""

FIELDS = {"x": "x", "v": "v", "stress": "stress", "edge": "edges", "measure": "measures"}


def base_chain(base: Base, count: int) -> tuple[Chain, Motion]:
    """The base state on a periodic chain of `count` nodes, node 0 at x = 0, densities and modulus 1."""
    R, S, Q, h, V = (
        float(rational(q))
        for q in (base.support_ratio, base.stress_ratio, base.velocity_gradient, base.spacing, base.frame_velocity)
    )
    x = (np.arange(count) - count // 2) * h
    ones = np.ones(count)
    origin, period = (1 - S) * x, count * h
    chain = Chain(
        support=R * h,
        modulus=1.0,
        masses=h * ones,
        kernel=kernel(base.kernel) if isinstance(base.kernel, str) else base.kernel,
        order=base.order,
        readings=base.readings,
        periodic=True,
        origin=origin,
        origin_period=(1 - S) * period,
    )
    return chain, Motion(x, V + Q * x, S * ones, x + h / 2, h * ones, period, Q * period)


def stencil(base: Base) -> dict[tuple[str, str], dict[int, float]]:
    """(rate, variable) -> shift -> derivative at the middle node, as `linearise` of the other route gives it."""
    _, reach = base.reach(Float())
    count = 2 * reach + 2 * int(Fraction(rational(base.support_ratio))) + 6
    chain, motion = base_chain(base, count)
    middle = count // 2
    found: dict[tuple[str, str], dict[int, float]] = {(row, column): {} for row in base.kinds for column in base.kinds}
    for column in base.kinds:
        for n in range(-reach, reach + 1):
            values = getattr(motion, FIELDS[column]).astype(complex)
            values[middle + n] += 1j * STEP
            changed = rates(chain, replace(motion, **{FIELDS[column]: values})).motion
            for row in base.kinds:
                found[row, column][n] = float(getattr(changed, FIELDS[row])[middle].imag / STEP)
    return found
