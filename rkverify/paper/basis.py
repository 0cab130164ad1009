"""H(y) with y = x - x_I: the monomials up to order n, (5), (10), (33), and their rates of change."""

from itertools import combinations_with_replacement

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.approximation import Vector
from rkverify.paper.numbered import equation

MultiIndex = tuple[int, ...]


def exponents(dimension: int, order: int) -> list[MultiIndex]:
    """The multi-indices (i, j, …) with i + j + … <= n, in the order in which (5) lists them.

    >>> exponents(2, 2)
    [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
    """
    return [
        tuple(axes.count(axis) for axis in range(dimension))
        for degree in range(order + 1)
        for axes in combinations_with_replacement(range(dimension), degree)
    ]


def monomial(y: Vector, alpha: MultiIndex, K: Arithmetic) -> Scalar:
    """y_1^i y_2^j …"""
    value = K.number(1)
    for component, power in zip(y, alpha, strict=True):
        if power:
            value = value * component**power
    return value


@equation(5, 10, 33)
def basis(y: Vector, order: int, K: Arithmetic) -> list[Scalar]:
    """H^T(y) = [1, y_1, y_2, y_1^2, …, y_2^n]   (5), (10), (33)."""
    return [monomial(y, alpha, K) for alpha in exponents(len(y), order)]


def _partial(y: Vector, alpha: MultiIndex, axis: int, K: Arithmetic) -> Scalar:
    if alpha[axis] == 0:
        return K.zero()
    lowered = tuple(power - (j == axis) for j, power in enumerate(alpha))
    return alpha[axis] * monomial(y, lowered, K)


def basis_rate(y: Vector, w: Vector, order: int, K: Arithmetic) -> list[Scalar]:
    """dH(y)/dt where y changes at the rate w: sum_j w_j dH/dy_j."""
    axes = range(len(y))
    return [sum((w[j] * _partial(y, alpha, j, K) for j in axes), K.zero()) for alpha in exponents(len(y), order)]


def basis_second_rate(y: Vector, u: Vector, w: Vector, order: int, K: Arithmetic) -> list[Scalar]:
    """The second derivative of H(y) along u and w: sum_jk u_j w_k d2H/dy_j dy_k."""
    d = len(y)
    total = []
    for alpha in exponents(d, order):
        value = K.zero()
        for j in range(d):
            if alpha[j]:
                lowered = tuple(power - (axis == j) for axis, power in enumerate(alpha))
                for k in range(d):
                    value = value + u[j] * w[k] * alpha[j] * _partial(y, lowered, k, K)
        total.append(value)
    return total
