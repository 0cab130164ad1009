"""Growth measured in nonlinear computations: a small wave on a periodic chain, integrated in time.

Nothing of the linearisation enters: the propagator of the wave's amplitudes over a short time is fitted to the
computed motion, and its eigenvalues are e^{i omega t}.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from scipy.integrate import solve_ivp

from rkverify.arithmetic.native import Float, rational
from rkverify.errors import BadInput
from rkverify.solid.bar import Bar
from rkverify.solid.chain import Chain, Motion, rates
from rkverify.solid.integrate import integrate
from rkverify.solid.kernel_values import Array
from rkverify.stability.jacobian_solid import base_chain
from rkverify.stability.lagrangian import StretchedBar, bar
from rkverify.stability.lattice_state import Base
from rkverify.stability.roots import Root

AMPLITUDE = 1e-6
"""Velocity of the wave over the wave speed: its square, the error of linearity, is far below the accuracy asked for."""

RTOL, ACCURACY = 1e-12, 1e-8
"""Errors of a time step: of the state, and of the wave over its amplitude, which stays above the rounding of forces."""

SAMPLES = 41
LARGEST_CHAIN = 96
GROWTH_LIMIT = 1e2

OTHERS_LIMIT = 1e-2
"""What other waves may reach, in the wave's amplitude: they grow from rounding, and their squares act on the wave."""


@dataclass(frozen=True)
class Measured:
    """The two roots of a wave with the kh that fits on the chain, and the uncertainty of their growth (1/time)."""

    kh: float
    roots: tuple[Root, Root]
    uncertainty: float


def fitting_wave(kh: float, least: int) -> tuple[int, int]:
    """Nodes N and periods n of the chain whose wave number 2 pi n / N comes nearest to kh."""
    candidates = [(N, round(kh * N / (2 * pi))) for N in range(least, LARGEST_CHAIN + 1)]
    return min(candidates, key=lambda c: (round(abs(2 * pi * c[1] / c[0] - kh), 12), c[0]))


def _room(velocities: Array, kh: float, push: float) -> float:
    """How far the wave is from too large a growth, or other waves from being felt, in units of velocity."""
    wave = np.exp(1j * kh * np.arange(len(velocities)))
    # Waves kh and -kh are one where their sum is a whole turn, as at kh = pi.
    real = np.stack([wave.real, wave.imag], axis=1)
    own = real @ np.linalg.lstsq(real, velocities, rcond=None)[0]
    return min(
        GROWTH_LIMIT * push - float(abs(velocities).max()), OTHERS_LIMIT * push - float(abs(velocities - own).max())
    )


def _amplitudes(motions: list[Motion], start: Motion, kh: float) -> Array:
    """Amplitudes of the wave e^{i kh I} in positions and velocities (times, 2)."""
    wave = np.exp(-1j * kh * np.arange(len(start.x))) / len(start.x)
    return np.array([[wave @ (m.x - start.x), wave @ (m.v - start.v)] for m in motions])


def _propagator_roots(amplitudes: Array, interval: float) -> Array:
    """omega of the two eigenvalues e^{i omega t} of the matrix that takes the amplitudes over the interval."""
    scale = abs(amplitudes).max(axis=0)
    series = amplitudes / scale
    propagator = np.linalg.lstsq(series[:-1], series[1:], rcond=None)[0]
    omega = -1j * np.log(np.linalg.eigvals(propagator).astype(complex)) / interval
    return np.array(sorted(omega, key=lambda w: (round(w.imag, 9), -w.real)))


def measure(base: Base, kh: float) -> Measured:
    """Roots omega of a wave near kh about a base without velocity gradient, from the nonlinear equations.

    Raises BadInput for a velocity gradient: the base then changes while the wave grows, and has no rate.
    """
    if rational(base.velocity_gradient) != 0:
        raise BadInput(
            "with a velocity gradient the base itself changes in time and a wave has no constant rate to measure: "
            "leave --velocity-gradient out, or choose another layer"
        )
    least = 2 * base.reach(Float())[1] + 2
    count, waves = fitting_wave(kh, least)
    fitted = 2 * pi * waves / count
    chain, still = base_chain(base, count)
    push = AMPLITUDE * np.cos(fitted * np.arange(count))
    start = replace(still, v=still.v + push)
    interval = _interval(chain, start, still, fitted, AMPLITUDE)

    def small(motion: Motion) -> float:
        return _room(motion.v - still.v, fitted, AMPLITUDE)

    times = [interval * j for j in range(SAMPLES)]
    motions = integrate(chain, start, times, RTOL, ACCURACY * AMPLITUDE, small)
    drifting = [replace(m, x=m.x - still.v * t) for m, t in zip(motions, times, strict=False)]
    series = _amplitudes(drifting, still, fitted)
    return _measured(series, interval, fitted)


def _interval(chain: Chain, start: Motion, still: Motion, kh: float, amplitude: float) -> float:
    """A sampling interval that resolves the wave's own time scale, found by moving nodes and looking at the forces."""
    shape = np.cos(kh * np.arange(len(still.x)))
    spacing = still.period / len(still.x)
    moved = rates(chain, replace(still, x=still.x + amplitude * spacing * shape)).motion.v
    stress = rates(chain, start).motion.stress
    pulled = rates(chain, replace(still, stress=still.stress + stress)).motion.v
    fastest = np.sqrt(abs(moved).max() / (amplitude * spacing) + abs(pulled).max() / amplitude)
    return float(0.3 / max(fastest, 0.3 / spacing))


def measure_bar(base: StretchedBar, kh: float) -> Measured:
    """Roots omega of a wave near kh on the Lagrangian bar, from its nonlinear equations."""
    count, waves = fitting_wave(kh, 4 * base.reach + 4)
    return measure_displacements(bar(base, count), 2 * pi * waves / count)


def measure_displacements(chain: Bar, kh: float) -> Measured:
    """Roots omega of the wave kh, which fits on the given bar, from its nonlinear equations."""
    count = len(chain.gradients)
    shape = np.cos(kh * np.arange(count))
    push = AMPLITUDE * chain.spacing
    fastest = np.sqrt(abs(chain.acceleration(push * shape)).max() / push)

    def slope(_: float, z: Array) -> Array:
        return np.concatenate([z[count:], chain.acceleration(z[:count])])

    return measure_flow(slope, np.zeros(2 * count), count, kh, float(0.3 / max(fastest, 0.3 / chain.spacing)), push)


def measure_flow(
    slope: Callable[[float, Array], Array],
    still: Array,
    count: int,
    kh: float,
    interval: float,
    push: float,
    accuracy: float = 1e-10,
) -> Measured:
    """Roots omega of the wave kh about the rest state `still` of z' = slope(t, z), sampled at the given interval.

    z holds the positions and the velocities of `count` particles, then whatever follows from these; the wave starts with
    the velocity `push`. accuracy: absolute error of a time step over `push`; below the rounding of the positions over
    `push` the steps only become small.
    """
    nodes = np.arange(count)
    start = still.copy()
    start[count : 2 * count] += push * np.cos(kh * nodes)

    def small(_: float, z: Array) -> float:
        return _room(z[count : 2 * count], kh, push)

    small.terminal = True  # type: ignore[attr-defined]
    times = interval * np.arange(SAMPLES)
    done = solve_ivp(slope, (0, times[-1]), start, "DOP853", times, events=small, rtol=1e-11, atol=accuracy * push)
    wave = np.exp(-1j * kh * nodes) / count
    moved = done.y - still[:, None]
    return _measured(np.stack([wave @ moved[:count], wave @ moved[count : 2 * count]], axis=1), interval, kh)


def _measured(series: Array, interval: float, kh: float) -> Measured:
    """The roots that fit the whole series, and how far the growth that fits either half is from theirs."""
    omega = _propagator_roots(series, interval)
    half = len(series) // 2
    parts = [_propagator_roots(part, interval) for part in (series[: half + 1], series[half:])]
    spread = max(abs(float(part[0].imag - omega[0].imag)) for part in parts)
    first, second = (Root(float(w.real), float(w.imag)) for w in omega)
    return Measured(kh, (first, second), spread)
