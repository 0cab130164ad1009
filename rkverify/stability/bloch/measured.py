"""Growth measured in nonlinear computations in the plane: a small wave on a periodic box of nodes, integrated in time.

Nothing of the linearisation enters: the propagator of the wave's amplitudes in positions and velocities over a short time is
fitted to two computed motions, one pushed along either axis, and its eigenvalues are e^{i omega t}.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eig

from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.periodic_plane import PeriodicPlane, PlaneMotion, held, rates, surroundings
from rkverify.stability.bloch.cell_integrals import areas
from rkverify.stability.bloch.lattices import Lattice, supercell
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.symbol import stiffness

AMPLITUDE = 1e-6
"""Velocity of the wave, the wave speed being about 1: its square, the error of linearity, is far below the accuracy asked for."""

ACCURACY = 1e-8
"""Error of a time step over the wave's amplitude."""

SAMPLES = 25
GROWTH_LIMIT = 1e2
OTHERS_LIMIT = 1e-2
"""What other waves may reach, in the wave's amplitude: they grow from rounding, and their squares act on the wave."""


@dataclass(frozen=True)
class MeasuredGrowth:
    """The largest growth of the four roots (1/time), how far that of either half of the run is from it, e-foldings seen."""

    growth: float
    uncertainty: float
    foldings: float


def box_of(lattice: Lattice, scheme: Scheme, loading: Loading, count: int) -> tuple[PeriodicPlane, PlaneMotion]:
    """A periodic box of count by count periods at rest under the uniform stress, with dead loads where these are needed."""
    whole = supercell(lattice, count)
    x = whole.nodes
    a = np.tile(areas(lattice)[0], count * count)
    margin = 0.2
    radius = scheme.reach + 2 * float(a.max()) ** 0.5 + margin
    owners, shifts = surroundings(x, whole.periods, radius)
    plane = PeriodicPlane(
        whole.periods,
        scheme.cloud(x),
        a,
        owners,
        shifts,
        scheme.integration,
        scheme.rule,
        scheme.derivative,
        scheme.cell_measure,
        loading.moduli,
        loading.law,
    )
    still = PlaneMotion(x, np.zeros_like(x), np.tile(loading.sigma, (len(x), 1, 1)), a)
    return held(plane, still), still


def measure(lattice: Lattice, scheme: Scheme, loading: Loading, count: int, waves: tuple[int, int]) -> MeasuredGrowth:
    """The growth of the wave that fits `waves` times into the count periods of either direction.

    Raises BadInput for the wave without wave length.
    """
    k = np.array(waves) / count @ lattice.reciprocal
    if not any(n % count for n in waves):
        raise BadInput(f"the wave {waves} on {count} periods is a translation: take one with a wave length")
    plane, still = box_of(lattice, scheme, loading, count)
    shape = np.cos(still.x @ k)
    interval = _interval(plane, still, shape)
    runs = [_run(plane, still, np.outer(shape, axis), k, interval) for axis in np.eye(2)]
    length = min(map(len, runs))
    omega = _roots([run[:length] for run in runs], interval)
    half = length // 2
    halves = [_roots([run[part] for run in runs], interval) for part in (slice(half + 1), slice(half, length))]
    growth = float((-omega.imag).max())
    spread = max(abs(float((-part.imag).max()) - growth) for part in halves)
    return MeasuredGrowth(growth, spread, growth * interval * (length - 1))


def _interval(plane: PeriodicPlane, still: PlaneMotion, shape: Array) -> float:
    """A sampling interval that resolves the wave's own time scale, found by moving nodes and looking at the forces."""
    fastest = 0.3
    for axis in np.eye(2):
        push = AMPLITUDE * np.outer(shape, axis)
        moved = PlaneMotion(still.x + push, still.v, still.stress, still.measures)
        pulled = rates(plane, PlaneMotion(still.x, push, still.stress, still.measures)).stress
        stressed = PlaneMotion(still.x, still.v, still.stress + pulled, still.measures)
        accelerations = [abs(rates(plane, m).v).max() / AMPLITUDE for m in (moved, stressed)]
        fastest = max(fastest, float(sum(accelerations)) ** 0.5)
    return 0.3 / fastest


def _run(plane: PeriodicPlane, still: PlaneMotion, push: Array, k: Array, interval: float) -> Array:
    """Amplitudes of the wave in positions and velocities (times, 4), until it or others are too large."""
    start = PlaneMotion(still.x, AMPLITUDE * push, still.stress, still.measures)
    wave = np.exp(-1j * still.x @ k) / len(still.x)
    # Waves k and -k are one where their sum is a wave that repeats at every node.
    real = np.stack([wave.real, wave.imag], axis=1)

    def slope(_: float, z: Array) -> Array:
        return rates(plane, still.like(z)).packed()

    def small(_: float, z: Array) -> float:
        v = still.like(z).v
        own = real @ np.linalg.lstsq(real, v, rcond=None)[0]
        room = GROWTH_LIMIT - abs(v).max() / AMPLITUDE, OTHERS_LIMIT - abs(v - own).max() / AMPLITUDE
        return float(min(room))

    small.terminal = True  # type: ignore[attr-defined]
    times = interval * np.arange(SAMPLES)
    done = solve_ivp(
        slope, (0, times[-1]), start.packed(), "DOP853", times, events=small, rtol=1e-9, atol=ACCURACY * AMPLITUDE
    )
    motions = [still.like(z) for z in done.y.T]
    return np.array([np.concatenate([wave @ (m.x - still.x), wave @ m.v]) for m in motions])


def _roots(runs: list[Array], interval: float) -> Array:
    """omega of the eigenvalues e^{i omega t} of the matrix that takes the amplitudes of all runs over the interval."""
    scale = abs(np.concatenate(runs)).max(axis=0)
    scale[scale == 0] = 1.0
    before = np.concatenate([run[:-1] for run in runs]) / scale
    after = np.concatenate([run[1:] for run in runs]) / scale
    propagator = np.linalg.lstsq(before, after, rcond=None)[0]
    return np.asarray(-1j * np.log(np.linalg.eigvals(propagator).astype(complex)) / interval)


def measure_fastest(lattice: Lattice, scheme: Scheme, loading: Loading, time: float) -> tuple[float, MeasuredGrowth]:
    """The largest growth of waves that repeat with the period, by K(0), and what the nonlinear equations make of that mode.

    The mode's amplitude is what the left eigenvector sees of the positions, so that other modes of the linear equations do
    not enter; over `time` in 25 samples.
    """
    plane, still = box_of(lattice, scheme, loading, 1)
    of = linearised(lattice, scheme)
    size = 2 * len(lattice)
    K = stiffness(of, loading, np.zeros((1, 2)))[0].reshape(size, size) / np.repeat(of.masses, 2)[:, None]
    squares, left, right = eig(K, left=True)
    omega = np.sqrt(squares.astype(complex))
    omega = np.where(omega.imag > 0, -omega, omega)  # e^{i omega t} grows
    fastest = int(np.argmin(omega.imag))
    w, u = omega[fastest], right[:, fastest]
    moved, pushed = (AMPLITUDE * part.real.reshape(-1, 2) for part in (u, 1j * w * u))
    start = PlaneMotion(still.x + moved, pushed, still.stress + _stress_of(plane, still, moved), still.measures)
    times = time / (SAMPLES - 1) * np.arange(SAMPLES)

    def slope(_: float, z: Array) -> Array:
        return rates(plane, still.like(z)).packed()

    done = solve_ivp(slope, (0, time), start.packed(), "DOP853", times, rtol=1e-11, atol=1e-10 * AMPLITUDE)
    seen = np.array([(still.like(z).x - still.x).ravel() for z in done.y.T]) @ left[:, fastest].conj()
    amplitude = np.log(abs(seen))
    half = SAMPLES // 2
    fits = [
        float(np.polyfit(times[part], amplitude[part], 1)[0]) for part in (slice(None), slice(half), slice(half, None))
    ]
    uncertainty = max(abs(f - fits[0]) for f in fits[1:])
    return float(-w.imag), MeasuredGrowth(fits[0], uncertainty, fits[0] * time)


def _stress_of(plane: PeriodicPlane, still: PlaneMotion, moved: Array) -> Array:
    """What a small displacement (N, 2) adds to the stresses: the rates that it has as a velocity."""
    return rates(plane, replace(still, v=moved)).stress
