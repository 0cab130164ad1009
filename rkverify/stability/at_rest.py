"""The undamped relation at rest for every stress and every wave: omega^2 is affine in the stress, a polynomial in cos kh.

Everything is in the units h = rho = C = 1 (C^sigma, or C^SE for the Lagrangian bar): frequencies are omega h / c with
c^2 = C/rho, a time step is dt c / h.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import acos, inf, pi, sqrt

import numpy as np
from numpy.polynomial import chebyshev

from rkverify.arithmetic.native import Float
from rkverify.errors import BadInput
from rkverify.paper import printed_lagrangian
from rkverify.paper.notation import lattice_values
from rkverify.solid.kernel_values import Array
from rkverify.stability import jacobian_solid, lagrangian
from rkverify.stability.layers import Setting
from rkverify.stability.printed import PrintedQuadratic

SAMPLES = 480
"""Waves kh = pi n / SAMPLES at which a range of stresses is taken, beside its turning points."""

ROUNDING = 1e-8
"""Share of the largest value below which a sum of products of order 1 is called zero."""


@dataclass(frozen=True)
class AtRest:
    """omega^2 = sum_n (p_n + s q_n) cos(n kh) at Q = 0, with s = sigma/C^sigma (or S/C^SE): for every s and kh.

    free, per_stress: p and q (terms,). Extremes over all waves come from the polynomial in cos kh, without sampling.
    """

    free: Array
    per_stress: Array

    def omega_squared(self, s: float, kh: Array) -> Array:
        """omega^2 at every kh."""
        return chebyshev.chebval(np.cos(kh), self.free + s * self.per_stress)

    def _extreme_places(self, s: float) -> tuple[Array, Array]:
        """cos kh at the ends and where omega^2 has a horizontal tangent, and omega^2 there."""
        series = self.free + s * self.per_stress
        places = np.array([-1.0, 1.0, *_roots_inside(chebyshev.chebder(series))])
        return places, chebyshev.chebval(places, series)

    def extremes(self, s: float) -> tuple[float, float]:
        """The least and the largest omega^2 over all waves 0 <= kh <= pi."""
        _, values = self._extreme_places(s)
        return float(values.min()), float(values.max())

    def wave_of_largest(self, s: float) -> float:
        """The kh of the largest omega^2."""
        places, values = self._extreme_places(s)
        return acos(places[int(values.argmax())])

    def critical_step(self, s: float) -> float:
        """dt = 2 / omega_max, beyond which central differences grow; every step grows where the least omega^2 < 0.

        Infinite where no wave oscillates.
        """
        largest = self.extremes(s)[1]
        return 2 / sqrt(largest) if largest > ROUNDING else inf

    def stable_stresses(self) -> tuple[float, float]:
        """The s for which omega^2 >= 0 at every kh: an interval around s = 0; infinite where no wave ends it.

        No square is negative without stress, and each wave bounds s on one side, by p + s q >= 0. At kh = 0 both p and q
        vanish; divided by 1 - cos kh they leave the long-wave limit. Waves whose p and q vanish together bound nothing.
        """
        p, q = (chebyshev.chebdiv(series, [1.0, -1.0])[0] for series in (self.free, self.per_stress))
        turns = chebyshev.chebsub(
            chebyshev.chebmul(chebyshev.chebder(p), q), chebyshev.chebmul(p, chebyshev.chebder(q))
        )
        places = np.array([*np.cos(pi * np.arange(SAMPLES + 1) / SAMPLES), *_roots_inside(turns)])
        here, rise = chebyshev.chebval(places, p), chebyshev.chebval(places, q)
        scale = max(abs(here).max(), abs(rise).max())
        here = np.where(abs(here) < ROUNDING * scale, 0.0, here)
        up, down = rise > ROUNDING * scale, rise < -ROUNDING * scale
        low = max(-here[up] / rise[up], default=-np.inf)
        high = min(-here[down] / rise[down], default=np.inf)
        # Adding 0 turns -0 into 0.
        return float(low) + 0.0, float(high) + 0.0


def _roots_inside(series: Array) -> list[float]:
    """Real parts of the roots near (-1, 1): places to look at, of which too many do no harm."""
    trimmed = chebyshev.chebtrim(series, 1e-14 * max(abs(series).max(), 1e-300))
    if len(trimmed) < 2:
        return []
    return [float(r.real) for r in chebyshev.chebroots(trimmed) if abs(r.imag) < 1e-2 and -1 < r.real < 1]


def at_rest(setting: Setting) -> AtRest:
    """The relation of a setting's layer for every stress: two stencils, or the formula in print, at s = 0 and s = 1.

    The setting's own stress, velocity gradient and spacing do not count. Raises BadInput for the layer `simulated`, for
    DNI in print on the Lagrangian bar, for the consistent mass, whose relation is no polynomial in cos kh, and for nodes
    that move with the field, whose relation is not undamped.
    """
    if setting.layer == "simulated" or setting.node_motion != "coefficient" or setting.mass != "lumped":
        raise BadInput("a survey needs an analytic layer, the lumped mass, and nodes that move with their coefficients")
    still = replace(setting, velocity_gradient=0, spacing=1, frame_velocity=0)
    series = [_rest_series(replace(still, stress_ratio=s)) for s in (0, 1)]
    size = max(map(len, series))
    zero, one = (np.pad(values, (0, size - len(values))) for values in series)
    return AtRest(zero, one - zero)


def _rest_series(setting: Setting) -> Array:
    if setting.layer == "printed":
        return _printed_series(setting)
    if setting.formulation == "lagrangian":
        return _cosines(_laurent(lagrangian.stencil_by_complex_step(setting.bar())))
    base = setting.base()
    found = jacobian_solid.stencil(base)
    total = _laurent(found["v", "x"])
    for kind in base.kinds[2:]:
        # Stress, edges and measures follow the positions as their rates follow the velocities.
        product = np.convolve(_laurent(found["v", kind]), _laurent(found[kind, "v"]))
        total = _centred_sum(total, product)
    return _cosines(total)


def _laurent(coefficients: dict[int, float]) -> Array:
    """c_n for n = -reach, …, reach."""
    reach = max(abs(n) for n in coefficients)
    return np.array([coefficients.get(n, 0.0) for n in range(-reach, reach + 1)])


def _centred_sum(a: Array, b: Array) -> Array:
    reach = max(len(a), len(b)) // 2
    return np.pad(a, reach - len(a) // 2) + np.pad(b, reach - len(b) // 2)


def _cosines(total: Array) -> Array:
    """-sum_n c_n e^{i n kh} as a series of cosines; the lattice is its own mirror image, so that it is real."""
    reach = len(total) // 2
    return -np.array([total[reach], *(total[reach + n] + total[reach - n] for n in range(1, reach + 1))])


def _printed_series(setting: Setting) -> Array:
    K = Float()
    if setting.formulation == "lagrangian":
        if setting.integration == "dni":
            raise BadInput("the paper prints no Lagrangian relation with DNI: choose scni or layer as-defined")
        b = printed_lagrangian.b_hat(1, setting.support_ratio, K, setting.kernel, setting.order)
        F, S = K.number(setting.stretch), K.number(setting.stress_ratio)
        c_squared = printed_lagrangian.tangent(1.0, F, S)
        return _interpolated(lambda kh: printed_lagrangian.omega_squared(b, c_squared, kh, K), len(b))
    relation = printed_relation(setting)
    state = relation.state(setting.stress_ratio, 0)
    return _interpolated(lambda kh: relation.discriminant(state, kh) / 4, 2)


def printed_relation(setting: Setting) -> PrintedQuadratic:
    """(76), (82), (86) or (87) at unit spacing, in double precision."""
    K = Float()
    reading = (setting.half_point, setting.derivative, setting.kernel, setting.order)
    values = lattice_values(1, setting.support_ratio, K, *reading)
    return PrintedQuadratic(values, setting.integration, K, setting.convective)


def _interpolated(omega_squared: Callable[[float], float], degree: int) -> Array:
    def on_cosines(y: Array) -> Array:
        return np.array([omega_squared(acos(value)) for value in np.clip(y, -1, 1)])

    return chebyshev.chebinterpolate(on_cosines, degree)
