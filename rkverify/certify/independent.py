"""Independent routes to kernels and shape functions: other algebra, other transcriptions, libraries.

Nothing here calls the functions that it is held against.
"""

from collections.abc import Sequence
from fractions import Fraction

import flint
import numpy as np
from scipy.interpolate import BSpline


def cubic_kernel_as_printed(z: Fraction) -> Fraction:
    """The pieces of (12), one after the other, as the paper prints them.

    >>> cubic_kernel_as_printed(Fraction(1, 2))
    Fraction(1, 6)
    """
    if z <= Fraction(1, 2):
        return Fraction(2, 3) - 4 * z**2 + 4 * z**3
    if z <= 1:
        return Fraction(4, 3) - 4 * z + 4 * z**2 - Fraction(4, 3) * z**3
    return Fraction(0)


def b_spline_from_library(order: int, z: Sequence[float]) -> np.ndarray:
    """The cardinal B-spline of the given order with support |z| < 1, from scipy's basis elements."""
    knots = np.linspace(-1, 1, order + 1)
    spline = BSpline.basis_element(knots, extrapolate=False)
    values: np.ndarray = np.nan_to_num(spline(np.asarray(z)))
    return values


def shape_functions_by_minimisation(
    nodes: Sequence[Fraction], supports: Sequence[Fraction], x: Fraction, order: int
) -> dict[int, Fraction]:
    """The Psi_I with the least sum of Psi_I^2 / phi_a(x - x_I) among those that reproduce x^0, …, x^n at x.

    Solved exactly from the stationarity conditions with multipliers, in the monomials of x itself: neither the
    moment matrix nor the shifted basis appears. The kernel is (12), from its printed pieces.
    """
    weight = {I: cubic_kernel_as_printed(abs(x - node) / supports[I]) for I, node in enumerate(nodes)}
    inside = [I for I, w in weight.items() if w > 0]
    size = len(inside) + order + 1
    matrix = flint.fmpq_mat(size, size)
    right = flint.fmpq_mat(size, 1)
    for row, I in enumerate(inside):
        matrix[row, row] = _fmpq(1 / weight[I])
        for power in range(order + 1):
            matrix[row, len(inside) + power] = matrix[len(inside) + power, row] = _fmpq(nodes[I] ** power)
    for power in range(order + 1):
        right[len(inside) + power, 0] = _fmpq(x**power)
    solution = matrix.solve(right)
    return {I: _fraction(solution[row, 0]) for row, I in enumerate(inside)}


def linear_shape_functions_in_closed_form(
    nodes: Sequence[Fraction], supports: Sequence[Fraction], x: Fraction
) -> dict[int, Fraction]:
    """Psi_I = phi_I (S_2 - S_1 (x - x_I)) / (S_0 S_2 - S_1^2) with S_k = sum_I (x - x_I)^k phi_I: order 1 by Cramer."""
    weight = {I: cubic_kernel_as_printed(abs(x - node) / supports[I]) for I, node in enumerate(nodes)}
    S = [sum((w * (x - nodes[I]) ** k for I, w in weight.items()), Fraction(0)) for k in range(3)]
    determinant = S[0] * S[2] - S[1] ** 2
    return {I: w * (S[2] - S[1] * (x - nodes[I])) / determinant for I, w in weight.items() if w > 0}


def _fmpq(value: Fraction) -> flint.fmpq:
    return flint.fmpq(value.numerator, value.denominator)


def _fraction(value: flint.fmpq) -> Fraction:
    return Fraction(int(value.p), int(value.q))
