"""Nodal gradient operators in one dimension: smoothed over a cell (52), (72) or direct at the node (80)."""

from rkverify.arithmetic.base import Scalar
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.cells import Cell
from rkverify.paper.numbered import equation
from rkverify.paper.shape import Values, shape_functions, shape_gradient
from rkverify.readings import Derivative


@equation(52, 72)
def smoothed_gradient(A: Approximation, cell: Cell) -> Values:
    """b_I^L = (Psi_I(X_L^+) - Psi_I(X_L^-)) / A_L   (52), (72); 1/length."""
    right, left = shape_functions(A, (cell.right,)), shape_functions(A, (cell.left,))
    either = sorted(right.keys() | left.keys())
    return {I: (_at(right, I, A) - _at(left, I, A)) / cell.measure for I in either}


def _at(values: Values, node: int, A: Approximation) -> Scalar:
    return values[node] if node in values else A.K.zero()


@equation(80)
def direct_gradient(A: Approximation, x: Vector, reading: Derivative = "full") -> Values:
    """B_I(x_K) = Psi_I,x(x_K)   (80); 1/length."""
    return shape_gradient(A, x, 0, reading)
