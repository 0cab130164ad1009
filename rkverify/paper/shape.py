"""RK shape functions (2)-(4), (9), (28)-(31), and their derivatives in every reading of the word."""

from math import factorial, prod

from rkverify.arithmetic.base import Scalar
from rkverify.errors import BadInput, UnknownName
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.basis import MultiIndex, basis, basis_rate, basis_second_rate, exponents, monomial
from rkverify.paper.kernel_rates import phi, phi_rate, phi_second_rate
from rkverify.paper.moment import (
    Rates,
    coefficients,
    coefficients_rate,
    coefficients_second_rate,
)
from rkverify.paper.numbered import equation
from rkverify.readings import DERIVATIVES, Derivative

Values = dict[int, Scalar]
"""node -> value, for the nodes whose support may reach the point."""


def inner(b: list[Scalar], H: list[Scalar]) -> Scalar:
    """b . H"""
    return sum((p * q for p, q in zip(b[1:], H[1:], strict=True)), b[0] * H[0])


@equation(31)
def correction(A: Approximation, x: Vector, y: Vector) -> Scalar:
    """C(x; y) = H^T(0) M^-1(x) H(y), with y = x - x_I in (30)   (31)."""
    return inner(coefficients(A, x), basis(y, A.order, A.K))


@equation(2, 4, 9, 28, 30)
def shape_functions(A: Approximation, x: Vector) -> Values:
    """Psi_I(x) = H^T(0) M^-1(x) H(x - x_I) phi_a(x - x_I)   (2), (4), (9), (28), (30).

    Dimensionless. Raises TooFewNodes and SingularMomentMatrix.

    >>> from rkverify.arithmetic.native import Exact
    >>> from rkverify.paper.approximation import approximation
    >>> A = approximation([[0], [1], [2]], "3/2", Exact())
    >>> sum(shape_functions(A, A.point("1/3")).values())
    Fraction(1, 1)
    """
    b = coefficients(A, x)
    return {I: inner(b, basis(A.offset(x, I), A.order, A.K)) * phi(A, x, I) for I in A.neighbours(x)}


@equation(1, 8, 27, 38)
def field(A: Approximation, x: Vector, coefficients_of_nodes: list[Scalar]) -> Scalar:
    """u^h(x) = sum_I Psi_I(x) d_I   (1), (8), (27), (38)."""
    return sum((Psi * coefficients_of_nodes[I] for I, Psi in shape_functions(A, x).items()), A.K.zero())


@equation(3, 29)
def reproducing_residual(A: Approximation, x: Vector, alpha: MultiIndex) -> Scalar:
    """sum_I Psi_I(x) x_I^alpha - x^alpha, zero for |alpha| <= n   (3), (29)."""
    known = [monomial(node, alpha, A.K) for node in A.nodes]
    return field(A, x, known) - monomial(x, alpha, A.K)


def shape_rates(
    A: Approximation, x: Vector, w: Rates, right: list[Scalar] | None = None, w_kernel: Rates | None = None
) -> Values:
    """The rate of every Psi_I where each x - x_I changes at the rate w(I): db.H phi + b.dH phi + b.H dphi.

    With another `right` than H(0): the rate of the row of M^-1 H phi that it picks. w_kernel: the rate that the
    kernel sees where it is not w, as when supports change.
    """
    b, db = coefficients(A, x, right), coefficients_rate(A, x, w, right, w_kernel)
    rates = {}
    for I in A.neighbours(x):
        y = A.offset(x, I)
        H, dH = basis(y, A.order, A.K), basis_rate(y, w(I), A.order, A.K)
        rates[I] = (inner(db, H) + inner(b, dH)) * phi(A, x, I) + inner(b, H) * phi_rate(A, x, I, (w_kernel or w)(I))
    return rates


def _unit(A: Approximation, axis: int) -> Vector:
    if axis not in range(A.dimension):
        raise BadInput(f"there is no axis {axis} in {A.dimension} dimensions: choose one from 0 to {A.dimension - 1}")
    return tuple(A.K.number(int(j == axis)) for j in range(A.dimension))


def _picking(A: Approximation, alpha: MultiIndex) -> list[Scalar]:
    """The right-hand side that picks the derivative alpha: (-1)^|alpha| alpha! at the place of H_alpha.

    The basis runs in x - x_I, where the Taylor expansion about x runs in x_I - x: hence the sign.
    """
    if sum(alpha) > A.order:
        raise BadInput(
            f"a diffuse derivative of order {sum(alpha)} needs a basis of that order, not {A.order}: raise the order or "
            "choose another reading"
        )
    factor = (-1) ** sum(alpha) * prod(map(factorial, alpha))
    return [A.K.number(factor * int(beta == alpha)) for beta in exponents(A.dimension, A.order)]


def _row(A: Approximation, x: Vector, alpha: MultiIndex) -> Values:
    """The row of M^-1 H phi that belongs to the derivative alpha."""
    row = coefficients(A, x, _picking(A, alpha))
    return {I: inner(row, basis(A.offset(x, I), A.order, A.K)) * phi(A, x, I) for I in A.neighbours(x)}


def diffuse_gradient_slope(A: Approximation, x: Vector, axes: tuple[int, int] = (0, 0)) -> Values:
    """The derivative along axes[1] of the diffuse derivative along axes[0], everything differentiated; 1/length^2."""
    e = _unit(A, axes[1])
    return shape_rates(A, x, lambda _: e, _picking(A, tuple(int(j == axes[0]) for j in range(A.dimension))))


def shape_gradient(A: Approximation, x: Vector, axis: int = 0, reading: Derivative = "full") -> Values:
    """dPsi_I/dx_j at x, in one of the readings `DERIVATIVES`; 1/length.

    Raises UnknownName for the reading, BadInput for a diffuse derivative of order 0, NotDifferentiable
    where the kernel is not.
    """
    e = _unit(A, axis)
    if reading == "full":
        return shape_rates(A, x, lambda _: e)
    if reading == "diffuse":
        return _row(A, x, tuple(int(j == axis) for j in range(A.dimension)))
    b = coefficients(A, x)
    gradient = {}
    for I in A.neighbours(x):
        y = A.offset(x, I)
        frozen = inner(b, basis(y, A.order, A.K)) * phi_rate(A, x, I, e)
        if reading == "frozen":
            gradient[I] = frozen
        elif reading == "frozen-b":
            gradient[I] = frozen + inner(b, basis_rate(y, e, A.order, A.K)) * phi(A, x, I)
        else:
            raise UnknownName("derivative", reading, DERIVATIVES)
    return gradient


def shape_second(A: Approximation, x: Vector, axes: tuple[int, int] = (0, 0), reading: Derivative = "full") -> Values:
    """d2Psi_I/dx_j dx_k at x, in one of the readings `DERIVATIVES`; 1/length^2.

    Raises as `shape_gradient` does.
    """
    u, w = (_unit(A, axis) for axis in axes)
    if reading == "diffuse":
        return _row(A, x, tuple(axes.count(j) for j in range(A.dimension)))
    if reading not in DERIVATIVES:
        raise UnknownName("derivative", reading, DERIVATIVES)
    b = coefficients(A, x)
    if reading == "full":
        bu, bw = coefficients_rate(A, x, lambda _: u), coefficients_rate(A, x, lambda _: w)
        buw = coefficients_second_rate(A, x, u, w)
    second = {}
    for I in A.neighbours(x):
        y = A.offset(x, I)
        H, Hu, Hw = basis(y, A.order, A.K), basis_rate(y, u, A.order, A.K), basis_rate(y, w, A.order, A.K)
        Huw = basis_second_rate(y, u, w, A.order, A.K)
        p, pu, pw = phi(A, x, I), phi_rate(A, x, I, u), phi_rate(A, x, I, w)
        puw = phi_second_rate(A, x, I, u, w)
        value = inner(b, H) * puw
        if reading != "frozen":
            value = value + inner(b, Huw) * p + inner(b, Hu) * pw + inner(b, Hw) * pu
        if reading == "full":
            value = (
                value + inner(buw, H) * p + (inner(bu, Hw) + inner(bw, Hu)) * p + inner(bu, H) * pw + inner(bw, H) * pu
            )
        second[I] = value
    return second
