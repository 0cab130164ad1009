"""Explicit integration of a chain in time (scipy's DOP853), real or complex."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.integrate import solve_ivp

from rkverify.solid.chain import Chain, Motion, rates
from rkverify.solid.kernel_values import Array

PARTS = ("x", "v", "stress", "edges", "measures")


def pack(motion: Motion) -> Array:
    """All arrays of a motion in one vector."""
    return np.concatenate([getattr(motion, part) for part in PARTS])


def unpack(vector: Array, like: Motion, time: float) -> Motion:
    """The motion that a vector holds; the period has grown with time."""
    x, v, stress, edges, measures = np.split(vector, len(PARTS))
    return Motion(x, v, stress, edges, measures, like.period + like.period_rate * time, like.period_rate)


def integrate(
    chain: Chain,
    start: Motion,
    times: Sequence[float],
    rtol: float = 1e-11,
    atol: float = 1e-14,
    stop: Callable[[Motion], float] | None = None,
) -> list[Motion]:
    """The motion at the given times, which begin at 0; fewer where stop(motion) fell below zero.

    rtol, atol: of each step, relative and in the units of the state.
    """

    def slope(time: float, vector: Array) -> Array:
        return pack(rates(chain, unpack(vector, start, time)).motion)

    events = None
    if stop is not None:

        def events(time: float, vector: Array) -> float:
            return stop(unpack(vector, start, time))

        events.terminal = True  # type: ignore[attr-defined]
    done = solve_ivp(
        slope, (times[0], times[-1]), pack(start), method="DOP853", t_eval=times, rtol=rtol, atol=atol, events=events
    )
    return [unpack(vector, start, time) for time, vector in zip(done.t, done.y.T, strict=True)]
