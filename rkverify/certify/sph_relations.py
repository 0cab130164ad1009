"""omega^2 of SPH on the uniform lattice in closed form, in any arithmetic: a route that differentiates nothing.

Unit spacing and m = C = 1, E = -rho dsigma/drho, theta = kh, sums over all n != 0 under the kernel:
  A = sum W'(n) sin n theta,  B = sum W''(n) (1 - cos n theta),  M = -sum n W'(n),
  D = sum n W''(n) sin n theta,  Gamma = sum n W'(n) cos n theta.
"""

from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput
from rkverify.kernels import TruncatedPowers, kernel
from rkverify.solid.sph import SphForm


@dataclass(frozen=True)
class Sums:
    """The sums at one kh; A_cell is A with W'(n) replaced by W(n + 1/2) - W(n - 1/2); rho is m sum_n W(n)."""

    rho: Scalar
    A: Scalar
    B: Scalar
    M: Scalar
    D: Scalar
    Gamma: Scalar
    A_cell: Scalar


def kernel_derivative(name: str, support_ratio: Scalar, place: Scalar, order: int, K: Arithmetic) -> Scalar:
    """The derivative of W of the given order at a distance >= 0, in units of h."""
    chosen, R = kernel(name), K.number(support_ratio)
    f: TruncatedPowers = chosen.phi.derivative(order) if order else chosen.phi
    mean = 2 * chosen.phi.moment(0)
    return f(place / R, K) / (R ** (order + 1) * K.ratio(mean.numerator, mean.denominator))


def sums(name: str, support_ratio: Scalar, kh: Scalar, K: Arithmetic) -> Sums:
    """Every sum at one kh, over all n with n - 1/2 under the kernel."""
    R = K.number(support_ratio)

    def W(place: Scalar, order: int = 0) -> Scalar:
        return kernel_derivative(name, R, place, order, K)

    rho, A, B, M, D, Gamma, A_cell = W(K.zero()), *(K.zero() for _ in range(6))
    for n in range(1, int(K.witness(R) + K.witness(K.ratio(1, 2))) + 2):
        place = K.number(n)
        slope, curvature, sine, cosine = W(place, 1), W(place, 2), K.sin(n * kh), K.cos(n * kh)
        rho = rho + 2 * W(place)
        A = A + 2 * slope * sine
        B = B + 2 * curvature * (1 - cosine)
        M = M - 2 * n * slope
        D = D + 2 * n * curvature * sine
        Gamma = Gamma + 2 * n * slope * cosine
        A_cell = A_cell + 2 * (W(place + K.ratio(1, 2)) - W(place - K.ratio(1, 2))) * sine
    return Sums(rho, A, B, M, D, Gamma, A_cell)


def omega_squared(
    form: SphForm, name: str, support_ratio: Scalar, stress_ratio: Scalar, kh: Scalar, K: Arithmetic
) -> Scalar:
    """omega^2 rho h^2 / C at rest at one kh. Raises BadInput where `relation` does."""
    return relation(form, sums(name, support_ratio, kh, K), stress_ratio, K)


def relation(form: SphForm, q: Sums, stress_ratio: Scalar, K: Arithmetic) -> Scalar:
    """omega^2 h^2 m/(h C) at rest.

      direct, antisymmetric  (E + 2 sigma) A^2 / rho^3 - 2 sigma B / rho^2
      direct, Galerkin       (E + sigma) A^2 / rho^3 - sigma B / rho^2
      corrected differences  E A^2 / (rho^3 L^2), L = M/rho
      corrected, antisymmetric, weights m_J/rho_J
        A/(rho^2 L) ((E + 2 sigma) r/rho + sigma l/L) - 2 sigma B/(rho^2 L), with the amplitudes of density r = A/L (continuity)
        or A (summation), and of L, l = (r Gamma/rho - A - D)/rho
      smoothed, Galerkin over cells  E A_cell^2 / rho^2

    Raises BadInput for another form.
    """
    sigma = K.number(stress_ratio)
    rho = q.rho if form.density == "summation" else K.number(1)
    E = 1 + sigma if form.law == "truesdell" else K.number(1)
    kind = (form.pairing, form.gradient)
    if form.convection != "none" or form.strain not in (None, form.gradient):
        raise BadInput("there is no closed form for this choice: linearise it")
    if kind == ("antisymmetric", "direct") and form.volume == "density":
        return (E + 2 * sigma) * q.A**2 / rho**3 - 2 * sigma * q.B / rho**2
    if kind == ("galerkin", "direct") and form.volume == "density" and form.weights == "neighbour":
        return (E + sigma) * q.A**2 / rho**3 - sigma * q.B / rho**2
    if kind == ("galerkin", "smoothed") and form.volume == "cell" and form.density == "continuity":
        return E * q.A_cell**2 / rho**2
    L = q.M / rho
    if kind == ("difference", "corrected") and form.density == "continuity" and form.volume == "density":
        return E * q.A**2 / (rho**3 * L**2)
    if kind == ("antisymmetric", "corrected") and form.weights == "neighbour" and form.volume == "density":
        r = q.A if form.density == "summation" else q.A / L
        change = (r * q.Gamma / rho - q.A - q.D) / rho
        return (q.A * ((E + 2 * sigma) * r / rho + sigma * change / L) - 2 * sigma * q.B) / (rho**2 * L)
    raise BadInput("there is no closed form for this choice: linearise it")


def criterion(name: str, support_ratio: Scalar, stress_ratio: Scalar, rho: Scalar, K: Arithmetic) -> Scalar:
    """omega^2 = -8 m sigma W''(h)/rho^2 of the symmetric form at kh = pi, for 1 < R <= 3: unstable where W'' sigma > 0.

    Sums over even n vanish at kh = pi, and n = 3 is beyond the kernel.
    """
    return -8 * K.number(stress_ratio) * kernel_derivative(name, support_ratio, K.number(1), 2, K) / rho**2
