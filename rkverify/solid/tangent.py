"""The linear equations along a motion: what a small change of the start becomes, beside the motion itself."""

from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp

from rkverify.solid.chain import Chain, Motion, rates
from rkverify.solid.integrate import PARTS, pack, unpack
from rkverify.solid.kernel_values import Array

STEP = 1e-30


def change_of_rates(chain: Chain, motion: Motion, change: Array) -> tuple[Array, Array]:
    """The rates of a motion, and their derivative along a change of all its parts, by a complex step (5 N,) each."""
    moved = unpack(pack(motion) + 1j * STEP * change, motion, 0.0)
    slope = pack(rates(chain, moved).motion)
    return slope.real, slope.imag / STEP


def follow(chain: Chain, start: Motion, change: Array, times: Array, rtol: float = 1e-11) -> tuple[list[Motion], Array]:
    """The motion at the given times and the change (times, 5 N), whose equations have the motion in their coefficients.

    change (5 N,): of positions, velocities, stresses, edges, measures, in this order; linear, so of any size.
    """
    scale = float(abs(change).max())

    def slope(time: float, both: Array) -> Array:
        base, delta = np.split(both, 2)
        return np.concatenate(change_of_rates(chain, unpack(base, start, time), delta))

    packed = np.concatenate([pack(start), change / scale])
    done = solve_ivp(slope, (times[0], times[-1]), packed, "DOP853", times, rtol=rtol, atol=1e-13)
    bases, deltas = np.split(done.y, 2)
    return [unpack(base, start, time) for time, base in zip(times, bases.T, strict=True)], scale * deltas.T


def changed(motion: Motion, change: Array) -> Motion:
    """The motion with a change added to all its parts."""
    parts = np.split(change, len(PARTS))
    return replace(motion, **{name: getattr(motion, name) + part for name, part in zip(PARTS, parts, strict=True)})
