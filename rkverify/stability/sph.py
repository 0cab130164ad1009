"""SPH on the uniform lattice, linearised by complex steps: stencil, symbol, omega^2 at rest, growth in a moving frame.

Unit spacing, unit m/h and unit modulus C; s = sigma/C. With continuity density the base has rho = m/h, with summation
density rho = m sum_n W(nh), which is another number: the error of the sum as a quadrature stays in every result.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.native import rational
from rkverify.errors import BadInput
from rkverify.kernels import kernel
from rkverify.solid.bar import Bar
from rkverify.solid.kernel_values import Array, kernel_values
from rkverify.solid.sph import Cloud, Particles, SphForm, density, rates

STEP = 1e-30

FORMS: dict[str, SphForm] = {
    "symmetric, summation density": SphForm(),
    "symmetric, continuity density": SphForm("continuity"),
    "corrected gradient": SphForm("continuity", weights="neighbour", gradient="corrected"),
    "corrected gradient, summation density": SphForm(weights="neighbour", gradient="corrected"),
    "corrected differences": SphForm("continuity", "difference", "neighbour", "corrected"),
    "Galerkin": SphForm("continuity", "galerkin", "neighbour"),
    "Galerkin, smoothed over cells": SphForm("continuity", "galerkin", "neighbour", "smoothed", volume="cell"),
}
"""The forms that are compared, by name; `rkverify.solid.sph` writes them down and names their sources."""


@dataclass(frozen=True)
class SphBase:
    """A form on the uniform lattice: R = a/h, sigma/C, and Q in units of (C/rho)^(1/2)/h. Strings are exact."""

    form: SphForm
    support_ratio: Scalar
    stress_ratio: Scalar = 0
    velocity_gradient: Scalar = 0
    kernel: str = "cubic"

    def __post_init__(self) -> None:
        """Raises UnknownName for a kernel; BadInput where it has no second derivative or reaches no neighbour."""
        if kernel(self.kernel).continuity < 2:
            raise BadInput(f"kernel {self.kernel!r} is not of class C2: there is no linearisation")
        if rational(self.support_ratio) <= 1:
            raise BadInput(f"R = {self.support_ratio}: no neighbour under the kernel, take R > 1")

    @property
    def reach(self) -> int:
        """How many neighbours to each side a particle's equation involves.

        The force, or N, reaches one radius, and density, gradient or Psi* of the particles there another; where the
        density enters the correction of the gradient, or its rate enters N, it is three.
        """
        f = self.form
        radii = 3 if f.convection == "true" or (f.density, f.gradient) == ("summation", "corrected") else 2
        return radii * (int(rational(self.support_ratio) + Fraction(1, 2)) + 1)

    @property
    def kinds(self) -> tuple[str, ...]:
        """The parts of the state."""
        return ("x", "v", "rho") if self.form.density == "continuity" else ("x", "v")


def lattice_cloud(base: SphBase, count: int) -> tuple[Particles, Cloud]:
    """The base state on a periodic chain of `count` particles, the middle one at x = 0."""
    R, s, Q = (float(rational(q)) for q in (base.support_ratio, base.stress_ratio, base.velocity_gradient))
    x, ones = np.arange(count) - float(count // 2), np.ones(count)
    cloud = Cloud(x, Q * x, ones, float(count), Q * count)
    trial = Particles(base.form, R, ones, kernel(base.kernel), 1.0, s, 1.0)
    rho = density(trial, cloud)
    particles = Particles(base.form, R, ones, kernel(base.kernel), 1.0, s, float(rho[count // 2]))
    return particles, cloud


def stencil(base: SphBase) -> dict[tuple[str, str], Array]:
    """(rate, variable) -> derivative of the middle particle's rate by the variable at shifts -reach, …, reach."""
    shifts = np.arange(-base.reach, base.reach + 1)
    count = 2 * base.reach + 2
    particles, cloud = lattice_cloud(base, count)
    middle, found = count // 2, {}
    state = {kind: getattr(cloud, kind) for kind in ("x", "v", "rho")}
    for column in base.kinds:
        moved = np.tile(state[column].astype(complex), (len(shifts), 1))
        moved[np.arange(len(shifts)), middle + shifts] += 1j * STEP
        parts = {**state, column: moved}
        changed = rates(particles, Cloud(**parts, period=cloud.period, period_rate=cloud.period_rate))
        for row, rate in zip(("x", "v", "rho"), changed, strict=True):
            if row in base.kinds:
                found[row, column] = np.broadcast_to(rate, moved.shape)[:, middle].imag / STEP
    return found


def symbol(base: SphBase, kh: Array) -> Array:
    """A(kh) (len(kh), kinds, kinds) with d/dt of the amplitudes of x, v and rho = A times the amplitudes."""
    whole = stencil(base)
    waves = np.exp(1j * np.outer(kh, np.arange(-base.reach, base.reach + 1)))
    columns = [[waves @ whole[row, column] for column in base.kinds] for row in base.kinds]
    return np.moveaxis(np.array(columns), -1, 0)


def omega_squared(base: SphBase, kh: Array) -> Array:
    """omega^2 rho h^2 / C about a base at rest (len(kh),); density follows the positions as its rate the velocities.

    Raises BadInput for a velocity gradient, with which omega^2 is not real.
    """
    if rational(base.velocity_gradient) != 0:
        raise BadInput("with a velocity gradient omega is complex: take `growth`")
    A = symbol(base, kh)
    total = A[:, 1, 0]
    if "rho" in base.kinds:
        total = total + A[:, 1, 2] * A[:, 2, 1]
    return -total.real


def growth(base: SphBase, kh: Array) -> Array:
    """The largest real part of the eigenvalues of A (len(kh),); the base is taken as frozen where it moves."""
    if rational(base.velocity_gradient) == 0:
        return np.sqrt(np.maximum(-omega_squared(base, kh), 0.0))
    return np.linalg.eigvals(symbol(base, kh)).real.max(axis=1)


def lagrangian_bar(base: SphBase, count: int) -> Bar:
    """The particles with the kernel kept in material coordinates: F_I = 1 + sum_J b_J(X_I) u_J with b = h W'.

    The stress ratio is S/C of the second Piola-Kirchhoff stress, which is sigma/C at F = 1.
    """
    X = np.arange(count, dtype=float)
    y = X[:, None] - X[None, :]
    y = y - np.round(y / count) * count
    R = float(rational(base.support_ratio))
    chosen = kernel(base.kernel)
    slope = kernel_values(chosen, y, R, 1)[1] / (2 * R * float(chosen.phi.moment(0)))
    if base.form.gradient == "corrected":
        slope = slope / (-y * slope).sum(axis=1, keepdims=True)
    return Bar(slope, 1.0, 1.0, float(rational(base.stress_ratio)), 1.0)


def bar_omega_squared(bar: Bar, kh: Array) -> Array:
    """omega^2 rho h^2 / C of the bar by a complex step of the middle particle (len(kh),)."""
    count = len(bar.gradients)
    u = np.zeros(count, dtype=complex)
    u[count // 2] = 1j * STEP
    column = bar.acceleration(u).imag / STEP
    return -np.real(np.exp(-1j * np.outer(kh, np.arange(count) - count // 2)) @ column)
