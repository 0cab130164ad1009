"""v_I' = -(1/m_I) f_I: the momentum equations of SPH on a periodic chain, vectorised, real or complex.

Kernel W(x) = phi(|x|/a) / (2 a int_0^1 phi), masses m_J, stress sigma positive in tension. Every form is a choice of
gradients b_J(x_K) of a field from its values at the particles,

  direct     w_KJ W'(x_K - x_J), with w_KJ = m_J/rho_K (weights `point`) or m_J/rho_J (`neighbour`)
  corrected  the same over sum_J w_KJ (x_J - x_K) W'(x_K - x_J), so that linear fields are exact
  smoothed   w_KJ (W(x_K^+ - x_J) - W(x_K^- - x_J)) / (x_K^+ - x_K^-), the mean over the cell half-way to the neighbours

of the strain rate L_K = sum_J b_J(x_K) (v_J - v_K), and of a pairing, with V_K = m_K/rho_K or the cell's length:

  antisymmetric  f_I = sum_K V_K sigma_K b_I(x_K) - V_I sigma_I sum_J b_J(x_I), work-conjugate to L_K
  galerkin       f_I = sum_K V_K sigma_K b_I(x_K), the weak form with Psi_I = V_I W
  difference     f_I = -V_I sum_J b_J(x_I) (sigma_J - sigma_I)

Direct, `point` and antisymmetric is the usual v_I' = sum_J m_J (sigma_I/rho_I^2 + sigma_J/rho_J^2) W'(x_I - x_J): J. W.
Swegle, D. L. Hicks, S. W. Attaway, J. Comput. Phys. 116 (1995) 123-134. Corrected and antisymmetric: J. Bonet, T.-S. L.
Lok, Comput. Methods Appl. Mech. Engrg. 180 (1999) 97-115. Corrected differences: P. W. Randles, L. D. Libersky, ibid. 139
(1996) 375-408. Density is sum_J m_J W(x_I - x_J) (`summation`), or follows rho' = -rho L (`continuity`).
"""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from rkverify.errors import BadInput, UnknownName
from rkverify.kernels import Kernel
from rkverify.readings import CONVECTIONS, Convection
from rkverify.solid.kernel_values import Array, kernel_values

Gradient = Literal["direct", "corrected", "smoothed"]
Pairing = Literal["antisymmetric", "galerkin", "difference"]
Weights = Literal["point", "neighbour"]
Volume = Literal["density", "cell"]
Density = Literal["summation", "continuity"]
SphLaw = Literal["truesdell", "cauchy-rate"]


@dataclass(frozen=True)
class SphForm:
    """One choice of everything in the module's docstring; strain None takes the gradient of the force.

    convection: the term N of (41) with the shape functions Psi_J = V_J W, V_J = m_J/rho_J: `psi-star` with V_J W' (v_K -
    v_J) as (40) has it, `true` with V_J' W besides. law: -rho dsigma/drho = C + sigma or C.
    """

    density: Density = "summation"
    pairing: Pairing = "antisymmetric"
    weights: Weights = "point"
    gradient: Gradient = "direct"
    strain: Gradient | None = None
    volume: Volume = "density"
    convection: Convection = "none"
    law: SphLaw = "truesdell"

    def __post_init__(self) -> None:
        """Raises UnknownName for an option; BadInput for a strain's gradient where no strain is computed."""
        options: tuple[tuple[str, str | None, tuple[str, ...]], ...] = (
            ("density", self.density, get_args(Density)),
            ("pairing", self.pairing, get_args(Pairing)),
            ("weights", self.weights, get_args(Weights)),
            ("gradient", self.gradient, get_args(Gradient)),
            ("strain gradient", self.strain or self.gradient, get_args(Gradient)),
            ("volume", self.volume, get_args(Volume)),
            ("convection", self.convection, CONVECTIONS),
            ("stress law", self.law, get_args(SphLaw)),
        )
        for kind, value, known in options:
            if value not in known:
                raise UnknownName(kind, str(value), known)
        if self.density == "summation" and self.strain is not None:
            raise BadInput(
                "with summation density the stress follows the density and no strain is computed: leave the strain's "
                "gradient out, or take continuity density"
            )


@dataclass(frozen=True)
class Particles:
    """Form, support radius a, masses (N,), kernel, and modulus C with the density at which the stress is `stress`."""

    form: SphForm
    support: float
    masses: Array
    kernel: Kernel
    modulus: float
    stress: float
    density: float

    def stress_at(self, rho: Array) -> Array:
        """The exact integral of the law: (C + sigma) rho = const, or sigma = sigma_0 - C log(rho/rho_0)."""
        if self.form.law == "truesdell":
            return (self.modulus + self.stress) * self.density / rho - self.modulus
        return self.stress - self.modulus * np.log(rho / self.density)


@dataclass(frozen=True)
class Cloud:
    """Positions, velocities, and densities (…, N) that count with continuity density alone; the period and its rate."""

    x: Array
    v: Array
    rho: Array
    period: float
    period_rate: float = 0.0


@dataclass(frozen=True)
class _Seen:
    """Kernel values (…, points, N) at points, with the images of the particles that are nearest to them."""

    y: Array
    images: Array
    W: Array
    slope: Array


def _seen(p: Particles, s: Cloud, points: Array) -> _Seen:
    y = points[..., :, None] - s.x[..., None, :]
    images = np.round(y.real / s.period)
    y = y - images * s.period
    norm = 2 * p.support * float(p.kernel.phi.moment(0))
    phi, slope = kernel_values(p.kernel, y, p.support, 1)
    return _Seen(y, images, phi / norm, slope / norm)


def _cells(s: Cloud) -> tuple[Array, Array]:
    following = np.roll(s.x, -1, axis=-1)
    following[..., -1] = following[..., -1] + s.period
    right = (s.x + following) / 2
    left = np.roll(right, 1, axis=-1)
    left[..., 0] = left[..., 0] - s.period
    return left, right


def density(p: Particles, s: Cloud) -> Array:
    """rho_I = sum_J m_J W(x_I - x_J), or the one carried along (…, N)."""
    if p.form.density == "continuity":
        return s.rho
    return (p.masses * _seen(p, s, s.x).W).sum(axis=-1)


def _gradient(kind: Gradient, weights: Array, here: _Seen, p: Particles, s: Cloud) -> Array:
    if kind == "smoothed":
        left, right = _cells(s)
        change = _seen(p, s, right).W - _seen(p, s, left).W
        return weights * change / (right - left)[..., :, None]
    b = weights * here.slope
    return b / (-here.y * b).sum(axis=-1, keepdims=True) if kind == "corrected" else b


def rates(p: Particles, s: Cloud) -> tuple[Array, Array, Array]:
    """x', v' and rho' (…, N); with summation density rho' is the rate of the sum."""
    f, m = p.form, p.masses
    here = _seen(p, s, s.x)
    rho = (m * here.W).sum(axis=-1) if f.density == "summation" else s.rho
    V = m / rho
    weights = V[..., None, :] if f.weights == "neighbour" else m / rho[..., :, None]
    b = _gradient(f.gradient, weights, here, p, s)
    b_strain = b if f.strain is None else _gradient(f.strain, weights, here, p, s)
    towards = s.v[..., None, :] + here.images * s.period_rate
    if f.density == "summation":
        rho_rate = (m * here.slope * (s.v[..., :, None] - towards)).sum(axis=-1)
    else:
        rho_rate = -rho * (b_strain * (towards - s.v[..., :, None])).sum(axis=-1)
    force = _internal(p, s, rho, b)
    if f.convection != "none":
        force = force + _convective(p, s, here, towards, V, rho_rate / rho)
    return s.v, -force / m, rho_rate


def _internal(p: Particles, s: Cloud, rho: Array, b: Array) -> Array:
    left, right = _cells(s)
    volume = p.masses / rho if p.form.volume == "density" else right - left
    sigma = p.stress_at(rho)
    if p.form.pairing == "difference":
        return -volume * (b * (sigma[..., None, :] - sigma[..., :, None])).sum(axis=-1)
    load = volume * sigma
    force = (load[..., :, None] * b).sum(axis=-2)
    return force - load * b.sum(axis=-1) if p.form.pairing == "antisymmetric" else force


def _convective(p: Particles, s: Cloud, here: _Seen, towards: Array, V: Array, thickening: Array) -> Array:
    """sum_J N_IJ v_J with N_IJ = sum_K m_K Psi_I(x_K) Psi*_J(x_K) (66); thickening = rho'/rho."""
    carried = V[..., None, :] * here.slope * (s.v[..., :, None] - towards)
    if p.form.convection == "true":
        carried = carried - (V * thickening)[..., None, :] * here.W
    own, total = (carried * towards).sum(axis=-1), carried.sum(axis=-1)
    # Node I sees the image of K that is nearest to it, and there every velocity is lower by as many period rates as the
    # image of I near K is periods away.
    seen = own[..., :, None] - here.images * s.period_rate * total[..., :, None]
    return V * (p.masses[:, None] * here.W * seen).sum(axis=-2)
