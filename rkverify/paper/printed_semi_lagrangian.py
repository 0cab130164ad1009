"""Section 4.2 and 4.3 as printed: the stencils (75), (81), the quadratics (76)-(79), (82)-(85), and (86), (87).

Every function takes the lattice's numbers (`LatticeValues`) and a `State`; omega goes with the plane wave
e^{i(kx + omega t)}, the reading of (62) under which (76) follows from (75).
"""

from collections.abc import Callable
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.notation import LatticeValues
from rkverify.paper.numbered import equation

Wave = Callable[[int], Scalar]
"""n -> the value at node I + n."""


@dataclass(frozen=True)
class State:
    """C^sigma and sigma (stress), rho (mass per length) and the velocity gradient Q (1/time)."""

    modulus: Scalar
    sigma: Scalar
    rho: Scalar
    Q: Scalar


def _convective_stencil(s: LatticeValues, q: State, u: Wave, u_dot: Wave) -> Scalar:
    """The second and third term of (75), which (81) repeats."""
    slope = q.Q * s.C_h * s.slope_h / s.R
    return -2 * slope**2 * (u(1) - 2 * u(0) + u(-1)) + slope * (
        s.Psi_0 * (-u_dot(1) + u_dot(-1)) + s.Psi_h * (-u_dot(2) + u_dot(-2))
    )


@equation(75)
def scni_stencil(s: LatticeValues, q: State, u: Wave, u_dot: Wave, u_ddot: Wave) -> Scalar:
    """The left-hand side of (75), zero for a solution; length/time^2."""
    stiffness = (q.modulus + q.sigma) / (q.rho * s.h**2) * (s.C_half * s.phi_half) ** 2
    return u_ddot(0) + _convective_stencil(s, q, u, u_dot) + stiffness * (-u(2) + 2 * u(0) - u(-2))


@equation(81)
def dni_stencil(s: LatticeValues, q: State, u: Wave, u_dot: Wave, u_ddot: Wave) -> Scalar:
    """The left-hand side of (81), zero for a solution; length/time^2."""
    return (
        u_ddot(0)
        + _convective_stencil(s, q, u, u_dot)
        + q.sigma / q.rho * s.Psi_xx_h * (u(1) - 2 * u(0) + u(-1))
        - (q.modulus + q.sigma) / q.rho * s.Psi_x_h**2 * (u(2) - 2 * u(0) + u(-2))
    )


@equation(78)
def linear_coefficient(s: LatticeValues, q: State, kh: Scalar, K: Arithmetic) -> Scalar:
    """B = -2 Q C(h) phi'(h)/R [Psi(0) sin kh + Psi(h) sin 2kh]   (78); 1/time."""
    return -2 * q.Q * s.C_h * s.slope_h / s.R * (s.Psi_0 * K.sin(kh) + s.Psi_h * K.sin(2 * kh))


def _convective_constant(s: LatticeValues, q: State) -> Scalar:
    return -4 * q.Q**2 * (s.C_h * s.slope_h) ** 2 / s.R**2


@equation(78)
def scni_constant(s: LatticeValues, q: State, kh: Scalar, K: Arithmetic) -> Scalar:
    """C = -4 Q^2 [C(h) phi'(h)]^2/R^2 (1 - cos kh) - 2 (C^s + s)/(rho h^2) [C(h/2) phi(h/2)]^2 (1 - cos 2kh)   (78)."""
    stiffness = 2 * (q.modulus + q.sigma) / (q.rho * s.h**2) * (s.C_half * s.phi_half) ** 2
    return _convective_constant(s, q) * (1 - K.cos(kh)) - stiffness * (1 - K.cos(2 * kh))


@equation(84)
def dni_constant(s: LatticeValues, q: State, kh: Scalar, K: Arithmetic) -> Scalar:
    """A = {-4 Q^2 [C(h) phi'(h)]^2/R^2 + 2 s/rho Psi,xx(h)} (1 - cos kh) - 4 (C^s + s)/rho Psi,x(h)^2 sin^2 kh   (84)."""
    return (_convective_constant(s, q) + 2 * q.sigma / q.rho * s.Psi_xx_h) * (1 - K.cos(kh)) - 4 * (
        q.modulus + q.sigma
    ) / q.rho * s.Psi_x_h**2 * K.sin(kh) ** 2


@equation(76)
def scni_relation(s: LatticeValues, q: State, kh: Scalar, omega: Scalar, K: Arithmetic) -> Scalar:
    """The left-hand side of (76), written out as printed; 1/time^2."""
    return (
        omega**2
        - 4 * q.Q**2 * (s.C_h * s.slope_h) ** 2 / s.R**2 * (1 - K.cos(kh))
        - 2 * q.Q * omega * s.C_h * s.slope_h / s.R * (s.Psi_0 * K.sin(kh) + s.Psi_h * K.sin(2 * kh))
        - 2 * (q.modulus + q.sigma) / (q.rho * s.h**2) * (s.C_half * s.phi_half) ** 2 * (1 - K.cos(2 * kh))
    )


@equation(82)
def dni_relation(s: LatticeValues, q: State, kh: Scalar, omega: Scalar, K: Arithmetic) -> Scalar:
    """The left-hand side of (82), written out as printed; 1/time^2."""
    return (
        omega**2
        - 4 * q.Q**2 * (s.C_h * s.slope_h) ** 2 / s.R**2 * (1 - K.cos(kh))
        - 2 * q.Q * omega * s.C_h * s.slope_h / s.R * (s.Psi_0 * K.sin(kh) + s.Psi_h * K.sin(2 * kh))
        + 2 * q.sigma / q.rho * s.Psi_xx_h * (1 - K.cos(kh))
        - 4 * (q.modulus + q.sigma) / q.rho * s.Psi_x_h**2 * K.sin(kh) ** 2
    )


@equation(77, 83)
def quadratic(B: Scalar, constant: Scalar, omega: Scalar) -> Scalar:
    """omega^2 + B omega + C (77), with A for C (83); 1/time^2."""
    return omega**2 + B * omega + constant


@equation(79, 85)
def discriminant(B: Scalar, constant: Scalar) -> Scalar:
    """D = B^2 - 4 C (79), B^2 - 4 A (85); 1/time^2."""
    return B**2 - 4 * constant


@equation(86)
def scni_omega_squared(s: LatticeValues, q: State, kh: Scalar, K: Arithmetic) -> Scalar:
    """omega^2 = 2 (C^s + s)/(rho h^2) [C(h/2) phi(h/2)]^2 (1 - cos 2kh)   (86), without the convective term."""
    return 2 * (q.modulus + q.sigma) / (q.rho * s.h**2) * (s.C_half * s.phi_half) ** 2 * (1 - K.cos(2 * kh))


@equation(87)
def dni_omega_squared(s: LatticeValues, q: State, kh: Scalar, K: Arithmetic) -> Scalar:
    """omega^2 = 2 (C^s + s)/rho Psi,x(h)^2 (1 - cos 2kh) - 2 s/rho Psi,xx(h) (1 - cos kh)   (87), without the term."""
    return 2 * (q.modulus + q.sigma) / q.rho * s.Psi_x_h**2 * (1 - K.cos(2 * kh)) - 2 * q.sigma / q.rho * s.Psi_xx_h * (
        1 - K.cos(kh)
    )
