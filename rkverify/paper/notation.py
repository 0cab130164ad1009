"""The notation before Section 4.1 on a uniform lattice: C(h), C(h/2), phi_a(h/2), Psi_I(0), Psi_I,x(h), ….

The paper prints C(h/2) = C(x_I; x_{I+1/2} - x_I), with the moment matrix at x_I; (72) evaluates shape functions
at the cell's edge x_{I+1/2}. Both are offered: `literal` and `edge`.
"""

from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import UnknownName
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.kernel_rates import phi
from rkverify.paper.shape import (
    correction,
    diffuse_gradient_slope,
    shape_functions,
    shape_gradient,
    shape_second,
)
from rkverify.readings import HALF_POINTS, Derivative, HalfPoint


@dataclass(frozen=True)
class LatticeValues:
    """The numbers that (75)-(87) are written in, for one spacing h, support ratio R and reading.

    C_h, C_half, phi_half, Psi_0, Psi_h are dimensionless; slope_h is phi' = dphi/dz at z = h/a; Psi_x_h is in
    1/length and Psi_xx_h in 1/length^2.
    """

    h: Scalar
    R: Scalar
    C_h: Scalar
    C_half: Scalar
    slope_h: Scalar
    phi_half: Scalar
    Psi_0: Scalar
    Psi_h: Scalar
    Psi_x_h: Scalar
    Psi_xx_h: Scalar


def lattice_values(
    spacing: Scalar,
    support_ratio: Scalar,
    K: Arithmetic,
    half_point: HalfPoint = "edge",
    derivative: Derivative = "full",
    kernel_name: str = "cubic",
    order: int = 1,
) -> LatticeValues:
    """The notation's values on the uniform lattice with spacing h and support R h.

    Psi_xx_h is never defined in the paper. It enters (81) as the change of B_I(x_K) with x_K, so that for the diffuse
    reading it is the derivative of the diffuse derivative; the row of M^-1 H phi would need a basis of order 2.
    Raises UnknownName for a reading or kernel; TooFewNodes where R is too small for the order.
    """
    if half_point not in HALF_POINTS:
        raise UnknownName("half-point reading", half_point, HALF_POINTS)
    A = lattice(spacing, support_ratio, 2, K, kernel_name, order)
    h, I, zero = K.number(spacing), middle(A), K.zero()
    at_node, at_edge, at_next = A.point(0), (h / 2,), (h,)
    if derivative == "diffuse":
        second = diffuse_gradient_slope(A, at_next)
    else:
        second = shape_second(A, at_next, (0, 0), derivative)
    where = at_node if half_point == "literal" else at_edge
    return LatticeValues(
        h=h,
        R=K.number(support_ratio),
        C_h=correction(A, at_node, (h,)),
        C_half=correction(A, where, (h / 2,)),
        slope_h=A.kernel.phi.derivative()(h / A.supports[I], K),
        phi_half=phi(A, at_edge, I),
        Psi_0=shape_functions(A, at_node)[I],
        Psi_h=shape_functions(A, at_next).get(I, zero),
        Psi_x_h=shape_gradient(A, at_next, 0, derivative).get(I, zero),
        Psi_xx_h=second.get(I, zero),
    )
