"""A wave on a base that moves: v = V + Q x changes spacing, stress and support ratio while the wave grows.

Three answers to one question are put side by side: the nonlinear motion with and without the wave, the linear equations
whose coefficients follow the moving base, and the linear equations with the coefficients frozen at the start. On the
periodic lattice the second is the Fourier symbol of `lattice_state.Base` at each time; on a finite chain, where N makes
the base depend on the position, it is the derivative of the equations along the computed base.
"""

from dataclasses import dataclass, replace
from math import log, pi

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.linalg import expm

from rkverify.arithmetic.native import Float, rational
from rkverify.errors import BadInput, UnknownName
from rkverify.solid.chain import Chain, Motion, rates
from rkverify.solid.integrate import PARTS, integrate, pack
from rkverify.solid.kernel_values import Array
from rkverify.solid.tangent import change_of_rates, changed, follow
from rkverify.stability import jacobian_solid
from rkverify.stability.jacobian_solid import FIELDS, base_chain
from rkverify.stability.lattice_state import Base
from rkverify.stability.simulate import fitting_wave
from rkverify.stability.symbol import symbol

AMPLITUDE = 1e-5
"""Of the wave over the spacing: its share, the error of linearity, is far below what is asked for, and so is rounding over it."""

SAMPLES = 33
"""Times at which the symbol along the moving base is computed; in between it is a cubic spline."""

RTOL = 1e-12
"""Of each time step, far below the amplitude where positions are of order ten."""


STARTS = ("velocity", "growing", "oscillating")


@dataclass(frozen=True)
class Passage:
    """Amplitudes after a duration: of the nonlinear wave, of the linear one on the moving base, and on the frozen base.

    error: |nonlinear - moving| / |nonlinear| over the whole state. The growths are means over the duration, 1/time.
    rate: growth and frequency of the frozen mode that the wave starts as; 1/time.
    """

    kh: float
    duration: float
    error: float
    nonlinear_growth: float
    moving_growth: float
    frozen_growth: float
    rate: complex


def base_at(base: Base, time: float) -> Base:
    """The base after a time: without forces on it x = (1 + Q t) x_0, so that h grows and R, rho and Q fall.

    sigma' = (C + sigma) Q makes C + sigma grow as h does; sigma' = C Q makes sigma grow by C log(1 + Q t).
    Raises BadInput for readings or convective terms under which the base does not move like this.
    """
    r = base.readings
    steady = r.convection != "psi-star" and r.stress_law != "literal" and r.node_motion == "coefficient"
    if not steady or "fixed" in (r.cell_edges, r.cell_measure):
        raise BadInput(
            "the base is followed without N or with the true rate, for nodes that move with their coefficients, a stress "
            "law in rate form and cells that move: follow a finite chain otherwise"
        )
    Q, h, R, s, rho = (
        float(rational(q))
        for q in (base.velocity_gradient, base.spacing, base.support_ratio, base.stress_ratio, base.density)
    )
    growth = 1 + Q * time
    if growth <= 0:
        raise BadInput(f"at time {time:g} the base with Q = {Q:g} has shrunk to a point: ask for a shorter duration")
    stress = (1 + s) * growth - 1 if r.stress_law == "truesdell" else s + log(growth)
    return replace(
        base,
        spacing=h * growth,
        support_ratio=R if r.support_radius == "spacing" else R / growth,
        stress_ratio=stress,
        velocity_gradient=Q / growth,
        density=rho / growth,
    )


def symbol_at(base: Base, kh: float, count: int) -> Array:
    """The matrix of the amplitudes' rates on a base (kinds, kinds), for a wave that fits on a periodic chain of count nodes.

    The derivative of the rates along the wave's cosine and its sine, at the node where its phase is zero.
    """
    chain, motion = base_chain(base, count)
    phase = kh * (np.arange(count) - count // 2)
    columns = []
    for column in base.kinds:
        response = np.zeros(len(base.kinds), dtype=complex)
        for unit, shape in ((1.0, np.cos(phase)), (1j, np.sin(phase))):
            change = np.zeros(len(PARTS) * count)
            place = PARTS.index(FIELDS[column]) * count
            change[place : place + count] = shape
            slope = change_of_rates(chain, motion, change)[1]
            response += unit * np.array([slope[PARTS.index(FIELDS[k]) * count + count // 2] for k in base.kinds])
        columns.append(response)
    return np.stack(columns, axis=1)


def wave_on_lattice(base: Base, kh: float, start: str, duration: float | None = None) -> Passage:
    """A wave near kh on a periodic chain with v = Q x, over a duration, or over 1/growth of the frozen growing mode.

    start: the amplitudes at the start, as `starting_amplitudes` names them. Raises BadInput as `base_at` does.
    """
    count, waves = fitting_wave(kh, 2 * base.reach(Float())[1] + 2)
    fitted = 2 * pi * waves / count
    amplitudes, rate = starting_amplitudes(base, fitted, start, count)
    time = 1 / rate.real if duration is None else duration
    times = np.linspace(0.0, time, SAMPLES)
    matrices = np.array([symbol_at(base_at(base, float(t)), fitted, count) for t in times])
    between = CubicSpline(times, matrices)
    done = solve_ivp(lambda t, a: between(t) @ a, (0.0, time), amplitudes, "DOP853", rtol=1e-10, atol=1e-12)
    moving, frozen = done.y[:, -1], expm(matrices[0] * time) @ amplitudes
    nonlinear = _amplitudes_after(base, count, fitted, time, amplitudes)
    return _passage(fitted, time, rate, amplitudes, (nonlinear, moving, frozen))


def starting_amplitudes(base: Base, kh: float, start: str, count: int = 0) -> tuple[Array, complex]:
    """Amplitudes (kinds,) at the start, and the rate lambda of e^{lambda t} with which they would grow on a frozen base.

    velocity: of the velocities alone, for which there is no one rate; growing: the eigenvector that grows fastest;
    oscillating: the one of the largest frequency, whose norm would stay if the base did. count: nodes of a periodic chain
    on which the wave fits, 0 where it need not. Raises UnknownName.
    """
    if start == "velocity":
        return np.array([1.0 if kind == "v" else 0.0 for kind in base.kinds], dtype=complex), complex(np.nan)
    A = symbol_at(base, kh, count) if count else symbol(base, jacobian_solid.stencil(base), kh)
    values, vectors = np.linalg.eig(A)
    if start not in STARTS:
        raise UnknownName("start", start, STARTS)
    chosen = int(np.argmax(values.real if start == "growing" else values.imag))
    return vectors[:, chosen], complex(values[chosen])


def _passage(kh: float, duration: float, rate: complex, start: Array, ends: tuple[Array, Array, Array]) -> Passage:
    nonlinear, moving, frozen = (float(np.log(np.linalg.norm(end) / np.linalg.norm(start)) / duration) for end in ends)
    error = float(np.linalg.norm(ends[0] - ends[1]) / np.linalg.norm(ends[0]))
    return Passage(kh, duration, error, nonlinear, moving, frozen, rate)


def _amplitudes_after(base: Base, count: int, kh: float, duration: float, start: Array) -> Array:
    """The nonlinear amplitudes: the motion with the wave less the motion without it, over the amplitude."""
    chain, still = base_chain(base, count)
    wave = np.exp(1j * kh * np.arange(count))
    scale = AMPLITUDE * still.period / count
    names = [FIELDS[kind] for kind in base.kinds]
    pushed = {name: getattr(still, name) + scale * (a * wave).real for name, a in zip(names, start, strict=True)}
    ends = [
        integrate(chain, motion, [0.0, duration], RTOL, 1e-9 * scale)[-1]
        for motion in (replace(still, **pushed), still)
    ]
    # The real part of a wave holds half of it at kh and its conjugate at -kh, which at kh = pi are the same place.
    share = scale * count * (1.0 if np.isclose(kh, pi) else 0.5)
    return np.array([np.conj(wave) @ (getattr(ends[0], name) - getattr(ends[1], name)) / share for name in names])


def finite_chain(base: Base, count: int) -> tuple[Chain, Motion]:
    """The base state on a chain with free ends whose dead loads balance the stress at the start."""
    chain, motion = base_chain(base, count)
    free = replace(chain, periodic=False, masses=_end_cells_halved(chain.masses))
    edges = motion.edges.copy()
    edges[-1] = motion.x[-1]
    measures = _end_cells_halved(motion.measures)
    start = replace(motion, edges=edges, measures=measures, period=0.0, period_rate=0.0)
    return replace(free, external=rates(free, start).internal), start


def _end_cells_halved(values: Array) -> Array:
    halved = values.copy()
    halved[[0, -1]] /= 2
    return halved


def wave_on_chain(base: Base, count: int, kh: float, duration: float, start: str = "velocity") -> Passage:
    """A wave packet in the middle of a finite chain with v = Q x, in any reading and with any N.

    The real and the imaginary part of the packet run one after the other, so that an eigenvector is followed as one.
    Amplitudes as `starting_amplitudes` names them.
    """
    chain, still = finite_chain(base, count)
    offsets = np.arange(count) - count // 2
    packet = np.exp(1j * kh * offsets - (offsets / (count / 6)) ** 2)
    amplitudes, rate = starting_amplitudes(base, kh, start)
    change = np.zeros(len(PARTS) * count, dtype=complex)
    for kind, amplitude in zip(base.kinds, amplitudes, strict=True):
        place = PARTS.index(FIELDS[kind]) * count
        change[place : place + count] = amplitude * packet
    scale = AMPLITUDE * float(rational(base.spacing))
    moving, nonlinear = np.zeros_like(change), np.zeros_like(change)
    for part, unit in ((change.real, 1.0), (change.imag, 1j)):
        bases, deltas = follow(chain, still, part, np.array([0.0, duration]), RTOL)
        ended = integrate(chain, changed(still, scale * part), [0.0, duration], RTOL, 1e-9 * scale)[-1]
        moving += unit * deltas[-1]
        nonlinear += unit * (pack(ended) - pack(bases[-1])) / scale
    frozen = _frozen(chain, still, change, duration)
    return _passage(kh, duration, rate, change, (nonlinear, moving, frozen))


def _frozen(chain: Chain, start: Motion, change: Array, duration: float) -> Array:
    """The change after the duration with the coefficients of the start."""
    size = len(change)
    J = np.stack([change_of_rates(chain, start, column)[1] for column in np.eye(size)], axis=1)
    return np.asarray(expm(J * duration) @ change)
