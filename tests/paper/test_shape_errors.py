"""What cannot be answered is refused in one line of our own: bad input, too few nodes, singular matrices."""

import math
from fractions import Fraction

import pytest

from rkverify.arithmetic.native import Exact, Float
from rkverify.errors import BadInput, CoincidentNodes, RkverifyError, SingularMomentMatrix, TooFewNodes, UnknownName
from rkverify.paper.approximation import Approximation, approximation, lattice
from rkverify.paper.moment import moment_matrix, solve
from rkverify.paper.shape import reproducing_residual, shape_functions, shape_gradient, shape_second

K = Exact()
LINE = [[0], [1], [2], [3]]


def made(order: int = 1) -> Approximation:
    return approximation(LINE, "5/2", K, order=order)


@pytest.mark.parametrize(
    ("nodes", "support", "changes", "message"),
    [
        ([], 1, {}, "there are no nodes"),
        ([[0], [1, 2]], 1, {}, "different numbers of coordinates"),
        ([[]], 1, {}, "coordinate"),
        (LINE, 0, {}, "node 0 has support radius 0: it must be positive"),
        (LINE, [1, 1, -1, 1], {}, "node 2 has support radius -1"),
        (LINE, [1, 1], {}, "2 support radii for 4 nodes"),
        (LINE, "nan", {}, "not a finite number"),
        ([["x"], [1]], 1, {}, "'x' is not a finite number"),
        (LINE, 1, {"order": 3}, "choose 0, 1 or 2"),
        (LINE, 1, {"order": -1}, "choose 0, 1 or 2"),
    ],
)
def test_bad_input_says_what_to_change(nodes: list, support: object, changes: dict, message: str) -> None:
    """Decides that no approximation exists whose equations have no meaning, and that its maker is told why."""
    with pytest.raises(BadInput, match=message):
        approximation(nodes, support, K, **changes)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_no_node_and_no_support_is_undefined(bad: float) -> None:
    """In doubles an undefined node would have weight 0 everywhere and vanish in silence."""
    with pytest.raises(BadInput):
        approximation([[bad], [1.0], [2.0]], 1.5, Float())
    with pytest.raises(BadInput):
        approximation([[0.0], [1.0], [2.0]], bad, Float())


def test_an_unknown_kernel() -> None:
    with pytest.raises(UnknownName, match="choose one of cubic"):
        approximation(LINE, 1, K, "cubik")


@pytest.mark.parametrize("twice", [[[0], [1], ["0/7"]], [["0.5", 1], [0, 1], [0.5, 1]]])
def test_two_nodes_at_one_place_are_named(twice: list) -> None:
    with pytest.raises(CoincidentNodes, match=r"nodes 0 and 2 are both at \("):
        approximation(twice, 1, K)


@pytest.mark.parametrize(("spacing", "ratio"), [(0, 2), (-1, 2), (1, 0), (1, -2), ("nan", 1), (1, "inf")])
def test_a_lattice_needs_lengths(spacing: object, ratio: object) -> None:
    with pytest.raises(BadInput):
        lattice(spacing, ratio, 2, K)
    with pytest.raises(BadInput):
        lattice(*(float(Fraction(v)) if isinstance(v, int) else float(v) for v in (spacing, ratio)), 2, Float())


@pytest.mark.parametrize(("order", "enough"), [(0, 1), (1, 2), (2, 3)])
def test_one_node_more_than_the_order(order: int, enough: int) -> None:
    """Order n needs n + 1 covering nodes: with n it is refused, with n + 1 it is exact. A node whose edge is at x covers not.

    Decides solvability in one dimension: distinct nodes with positive weights, n + 1 of them, make M positive definite.
    """
    x = Fraction(1, 5)
    for count in (enough - 1, enough):
        nodes = [[Fraction(n)] for n in range(count)] + [[2 + x]]  # the last one's support of 2 ends at x
        A = approximation(nodes, 2, K, order=order)
        if count < enough:
            with pytest.raises(
                TooFewNodes, match=f"{count} of the nodes' supports cover the point, order {order} needs"
            ):
                shape_functions(A, (x,))
        else:
            assert [reproducing_residual(A, (x,), (k,)) for k in range(order + 1)] == [0] * (order + 1)


def test_outside_every_support() -> None:
    with pytest.raises(TooFewNodes, match=r"at x = \(10\) 0 of the nodes"):
        shape_functions(made(), (Fraction(10),))
    with pytest.raises(TooFewNodes):
        shape_functions(approximation([[0.0], [1.0], [2.0]], 1.5, Float()), (math.nan,))


def test_a_weight_that_doubles_cannot_resolve() -> None:
    """Next to the edge of the second support, at x = 2^-53, its weight is 4/3 x^3 and the pivot 2 x of its diagonal entry.

    That is an epsilon: doubles cannot tell it from rounding and must say so, exact numbers answer.
    """
    nodes, x = [[0], [1]], Fraction(1, 2**53)
    exact = approximation(nodes, 1, K)
    assert reproducing_residual(exact, (x,), (1,)) == 0
    with pytest.raises(SingularMomentMatrix, match="enlarge the support, move nodes or lower the order"):
        shape_functions(approximation(nodes, 1, Float()), (float(x),))


def test_a_singular_matrix_is_refused_exactly() -> None:
    """The solver itself, on matrices without an inverse or without a positive pivot; next to them one that has both."""
    A, x, right = made(), (Fraction(1),), [Fraction(1), Fraction(0)]
    for M in ([[1, 2], [2, 4]], [[0, 1], [1, 1]], [[1, 2], [2, 3]]):
        with pytest.raises(SingularMomentMatrix, match=r"pivot [01] keeps"):
            solve(A, x, [list(map(Fraction, row)) for row in M], right)
    assert solve(A, x, [[Fraction(1), Fraction(2)], [Fraction(2), Fraction(5)]], right) == [5, -2]


def test_a_point_of_another_dimension() -> None:
    with pytest.raises(RkverifyError):
        shape_functions(made(), (Fraction(1), Fraction(2)))


@pytest.mark.parametrize("reading", ["full", "diffuse", "frozen-b", "frozen"])
@pytest.mark.parametrize("axis", [1, -1])
def test_a_derivative_along_an_axis_that_is_not_there(reading: str, axis: int) -> None:
    """Decides that a wrong axis is not answered by zeros, nor, with the diffuse reading, by the values themselves."""
    with pytest.raises(BadInput):
        shape_gradient(made(2), (Fraction(1),), axis, reading)
    with pytest.raises(BadInput):
        shape_second(made(2), (Fraction(1),), (0, axis), reading)


def test_the_matrix_itself_is_symmetric_and_positive() -> None:
    M = moment_matrix(made(2), (Fraction(4, 3),))
    assert all(M[i][j] == M[j][i] for i in range(3) for j in range(3))
    minors = [M[0][0], M[0][0] * M[1][1] - M[0][1] ** 2]
    assert all(minor > 0 for minor in minors)


@pytest.mark.parametrize("count", [3, 20])
def test_a_pivot_is_refused_where_rounding_of_its_sums_explains_it(count: int) -> None:
    """Both entries of the pivot's difference are off by 2 (n + 2) epsilon: half of the sum is no pivot, twice it is one, with few
    nodes and with many.
    """
    F = Float()
    A = approximation([[k / count] for k in range(count)], 2, F)
    share = 2 * 2 * (count + 2) * F.epsilon
    with pytest.raises(SingularMomentMatrix, match=f"pivot 1 .* with {count} nodes in reach"):
        solve(A, (0.5,), [[1.0, 1.0], [1.0, 1.0 + share / 2]], [1.0, 0.0])
    b = solve(A, (0.5,), [[1.0, 1.0], [1.0, 1.0 + 2 * share]], [1.0, 0.0])
    assert b[1] == pytest.approx(-1 / (2 * share), rel=0.05)
