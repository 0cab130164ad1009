"""Growth of small waves in nonlinear SPH computations; nothing of the linearisation enters."""

from dataclasses import dataclass
from math import log

import numpy as np
from scipy.integrate import solve_ivp

from rkverify.arithmetic.native import rational
from rkverify.errors import BadInput
from rkverify.solid.kernel_values import Array
from rkverify.solid.sph import Cloud, Particles, rates
from rkverify.stability.simulate import AMPLITUDE, Measured, fitting_wave, measure_displacements, measure_flow
from rkverify.stability.sph import SphBase, lagrangian_bar, lattice_cloud

INTERVAL = 0.2
"""Time between samples in units of h (rho/C)^(1/2): no wave of the settings tried turns by more than a quarter in it."""

ACCURACY = 1e-7
"""Absolute error of a time step over the wave's amplitude: 1e-14, where positions of order ten are rounded to 1e-15."""


def measure(base: SphBase, kh: float) -> Measured:
    """Roots omega of a wave near kh about a base at rest. Raises BadInput for a velocity gradient."""
    if rational(base.velocity_gradient) != 0:
        raise BadInput("with a velocity gradient a wave has no constant rate to measure: take `packet_gain`")
    count, waves = fitting_wave(kh, 2 * base.reach + 2)
    fitted = 2 * np.pi * waves / count
    particles, still = lattice_cloud(base, count)

    def slope(_: float, z: Array) -> Array:
        x, v, rho = np.split(z, 3)
        return np.concatenate(rates(particles, Cloud(x, v, rho, still.period)))

    rest = np.concatenate([still.x, still.v, still.rho])
    return measure_flow(slope, rest, count, fitted, INTERVAL, AMPLITUDE, ACCURACY)


def measure_lagrangian(base: SphBase, kh: float) -> Measured:
    """The same with the kernel kept in material coordinates."""
    count, waves = fitting_wave(kh, 2 * base.reach + 2)
    return measure_displacements(lagrangian_bar(base, count), 2 * np.pi * waves / count)


@dataclass(frozen=True)
class Packet:
    """A packet of the wave kh = pi in velocity: its half-width in particles, how many may move, and for how long."""

    width: float = 4.0
    inner: int = 20
    duration: float = 1.5


def packet_gain(base: SphBase, packet: Packet) -> float:
    """log of the growth of the packet's largest velocity over its duration, on a chain that stretches at the rate Q.

    The particles beyond the inner ones follow the affine motion of the base, which is integrated besides: with N a base
    is not without acceleration. Continuity density alone. Raises BadInput for summation density.
    """
    if base.form.density != "continuity":
        raise BadInput("a packet is followed with continuity density alone")
    outer = 2 * base.reach
    half = packet.inner + outer
    count = 2 * half + 2
    particles, still = lattice_cloud(base, count)
    labels = still.x
    inside = abs(labels) <= packet.inner
    push = AMPLITUDE * (-1.0) ** labels * np.exp(-((labels / packet.width) ** 2))
    Q, moving = float(rational(base.velocity_gradient)), int(inside.sum())

    def slope(_: float, z: Array) -> Array:
        spacing, rate, rho = z[:3]
        acceleration, rho_rate = _affine(particles, labels, spacing, rate, rho)
        parts = np.split(z[3:], 3)
        filled = [labels * spacing, labels * rate, np.full(count, rho)]
        for whole, part in zip(filled, parts, strict=True):
            whole[inside] = part
        x, v, density = filled
        changed = rates(particles, Cloud(x, v, density, count * spacing, count * rate))
        return np.concatenate([[rate, acceleration, rho_rate], *(c[inside] for c in changed)])

    start = np.concatenate([[1.0, Q, 1.0], still.x[inside], still.v[inside] + push[inside], np.ones(moving)])
    done = solve_ivp(slope, (0.0, packet.duration), start, "DOP853", rtol=1e-12, atol=ACCURACY * AMPLITUDE)
    end = done.y[:, -1]
    drift = end[3 + moving : 3 + 2 * moving] - labels[inside] * end[1]
    return log(float(abs(drift).max()) / AMPLITUDE)


def _affine(particles: Particles, labels: Array, spacing: float, rate: float, rho: float) -> tuple[float, float]:
    """Acceleration per label, and rate of density, of the chain with x = label * spacing."""
    count = len(labels)
    cloud = Cloud(labels * spacing, labels * rate, np.full(count, rho), count * spacing, count * rate)
    _, acceleration, rho_rate = rates(particles, cloud)
    middle = count // 2
    return float(acceleration[middle + 1]), float(rho_rate[middle])
