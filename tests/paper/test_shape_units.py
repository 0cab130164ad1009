"""Units: the same shape functions whatever unit of length the coordinates are written in."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.samples import NodeSet
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.cells import Cell
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.moment import moment_matrix
from rkverify.paper.shape import DERIVATIVES, shape_functions, shape_gradient, shape_second

Build = Callable[..., Approximation]
UNITS = [Fraction(1000), Fraction(1, 10**6)]


def scaled(nodes: NodeSet, unit: Fraction, order: int, K: Arithmetic | None = None) -> Approximation:
    supports = [unit * a for a in nodes.supports]
    return approximation([[unit * x] for x in nodes.nodes], supports, K or Exact(), "cubic", order)


def times(values: dict[int, Fraction], factor: Fraction) -> dict[int, Fraction]:
    return {I: factor * value for I, value in values.items()}


@pytest.mark.parametrize("unit", UNITS, ids=str)
def test_values_keep_and_derivatives_scale(build: Build, nodes: NodeSet, order: int, unit: Fraction) -> None:
    """Psi is dimensionless, Psi,x is 1/length, Psi,xx 1/length^2: exactly, for metres as for millimetres.

    Decides that nothing in the transcription has a hidden length, such as a cut-off or an added constant.
    """
    A, B = build(nodes, order), scaled(nodes, unit, order)
    for x in (nodes.points[1 if unit > 1 else 3],):  # half-way between nodes, and on the edge of a support
        here, there = (x,), (unit * x,)
        assert shape_functions(B, there) == shape_functions(A, here)
        for reading in DERIVATIVES:
            if reading != "diffuse" or order >= 1:
                assert times(shape_gradient(B, there, 0, reading), unit) == shape_gradient(A, here, 0, reading)
            if reading != "diffuse" or order == 2:
                assert times(shape_second(B, there, (0, 0), reading), unit**2) == shape_second(A, here, (0, 0), reading)
        cell, other = Cell(x, x + Fraction(1, 50)), Cell(unit * x, unit * (x + Fraction(1, 50)))
        assert times(smoothed_gradient(B, other), unit) == smoothed_gradient(A, cell)


@pytest.mark.parametrize("exponent", [10, -20, 60, -60])
def test_powers_of_two_leave_every_bit_of_a_double(build: Build, nodes: NodeSet, order: int, exponent: int) -> None:
    """A power of two is no rounding: also the pivots' test for singular matrices must not see the unit."""
    K, unit = Float(), Fraction(2) ** exponent
    for x in nodes.points:
        A, B = build(nodes, order, K), scaled(nodes, unit, order, K)
        here = (float(x),)
        there = (float(x) * 2.0**exponent,)
        assert shape_functions(B, there) == shape_functions(A, here)
        gradient = shape_gradient(B, there)
        assert {I: value * 2.0**exponent for I, value in gradient.items()} == shape_gradient(A, here)


def test_the_twin_that_is_not_free_of_units(build: Build, nodes: NodeSet) -> None:
    """The moment matrix has entries of different units, and scaling the nodes alone is another approximation."""
    x, unit = nodes.points[-1], Fraction(1000)
    A, B = build(nodes, 1), scaled(nodes, unit, 1)
    M, N = moment_matrix(A, (x,)), moment_matrix(B, (unit * x,))
    assert [N[i][j] / M[i][j] for i, j in ((0, 0), (0, 1), (1, 1))] == [1, unit, unit**2]
    stretched = approximation([[2 * n] for n in nodes.nodes], [3 * a for a in nodes.supports], Exact())
    assert shape_functions(stretched, (2 * x,)) != shape_functions(A, (x,))
