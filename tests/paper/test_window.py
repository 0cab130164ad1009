"""The tensor window: phi_a is a product over the axes, all distances are rational, and exact numbers work in any dimension."""

from fractions import Fraction
from itertools import product
from math import prod

import pytest

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.series import Series
from rkverify.certify.samples import jittered_grid
from rkverify.errors import NotDifferentiable, NotRepresentable, TooFewNodes, UnknownName
from rkverify.kernels import kernel
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.basis import exponents
from rkverify.paper.kernel_rates import phi, phi_rate, phi_second_rate, semi_lagrangian_kernel_rate
from rkverify.paper.material_rates import true_rate
from rkverify.paper.shape import (
    Values,
    reproducing_residual,
    shape_functions,
    shape_gradient,
    shape_second,
)

K = Exact()
NODES = {d: jittered_grid(d, side, 7) for d, side in ((1, 6), (2, 4), (3, 3))}
SUPPORTS = {d: [Fraction(25 + I % 3, 10) for I in range(len(nodes))] for d, nodes in NODES.items()}
PLACES = {1: (Fraction(11, 5),), 2: (Fraction(8, 5), Fraction(13, 10)), 3: (Fraction(6, 5), Fraction(9, 10), 1)}
SPACE = [(d, n) for d in (1, 2, 3) for n in (0, 1, 2)]


def tensor(d: int, order: int = 1, arithmetic: Arithmetic = K, kernel_name: str = "cubic") -> Approximation:
    return approximation(NODES[d], SUPPORTS[d], arithmetic, kernel_name, order, "tensor")


def gap(one: Values, other: Values) -> object:
    return max(abs(one.get(I, 0) - other.get(I, 0)) for I in one.keys() | other.keys())


@pytest.mark.parametrize("d", [1, 2, 3])
def test_phi_is_the_product_of_kernels_on_the_axes(d: int) -> None:
    """Decides what the window is, by the kernel alone; at every node, the far ones, where it is 0, as well."""
    A, x = tensor(d), PLACES[d]
    for I, (node, a) in enumerate(zip(NODES[d], SUPPORTS[d], strict=True)):
        assert phi(A, x, I) == prod(kernel("cubic").phi(abs(p - q) / a, K) for p, q in zip(x, node, strict=True))
        assert (phi(A, x, I) != 0) == (max(abs(p - q) for p, q in zip(x, node, strict=True)) < a)


@pytest.mark.decides("E3", "E29")
@pytest.mark.parametrize(("d", "order"), SPACE)
def test_reproduction_is_exact_in_space_and_stops_at_the_order(d: int, order: int) -> None:
    """Every monomial up to the order, as rationals: no tolerance can hide a wrong moment; the next degree is the twin."""
    A = tensor(d, order)
    residuals = {alpha: reproducing_residual(A, PLACES[d], alpha) for alpha in exponents(d, order + 1)}
    assert all(r == 0 for alpha, r in residuals.items() if sum(alpha) <= order)
    assert any(r != 0 for alpha, r in residuals.items() if sum(alpha) == order + 1)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_on_a_line_the_windows_are_one(order: int) -> None:
    """Values, both derivatives and rates: |x - x_I| is its own largest component; in the plane they differ."""
    A, B, x = tensor(1, order), approximation(NODES[1], SUPPORTS[1], K, order=order), PLACES[1]
    for values in (shape_functions, shape_gradient, shape_second):
        assert values(A, x) == values(B, x)
    velocities = [(Fraction(I, 3),) for I in range(len(NODES[1]))]
    assert true_rate(A, x, (Fraction(1),), velocities) == true_rate(B, x, (Fraction(1),), velocities)
    F = Float()
    square, disc = (approximation(NODES[2], SUPPORTS[2], F, order=order, window=w) for w in ("tensor", "radial"))
    place = square.point(*PLACES[2])
    assert float(gap(shape_functions(square, place), shape_functions(disc, place))) > 1e-3


def test_neighbours_are_told_by_the_largest_component() -> None:
    """A node in the corner of the square reaches the point in the one window and not in the other, whose disc ends before."""
    nodes, x = [[0, 0], [1, 1], [-1, 1], [0, -1]], (Fraction(1, 10), Fraction(0))
    square, disc = (approximation(nodes, Fraction(11, 10), Float(), window=w) for w in ("tensor", "radial"))
    assert square.neighbours(square.point(*x)) == [0, 1, 2, 3]  # -1: 1.1/1.1 is the very edge, where rounding keeps it
    assert disc.neighbours(disc.point(*x)) == [0, 3]
    assert not tensor(2).covers((NODES[2][0][0] + SUPPORTS[2][0], NODES[2][0][1]), 0)
    with pytest.raises(TooFewNodes, match="2 of the nodes' supports cover the point"):
        shape_functions(disc, disc.point(*x))


@pytest.mark.parametrize(("d", "order"), SPACE)
def test_derivatives_are_those_of_duals(d: int, order: int) -> None:
    """dPsi/dx_j and d2Psi/dx_j dx_k, exactly: duals know the product rule by multiplying, the formulas by its being written."""
    D = Duals(K, d)
    A, moving = tensor(d, order), tensor(d, order, D)
    x, y = PLACES[d], tuple(D.variable(c, axis) for axis, c in enumerate(PLACES[d]))
    values = shape_functions(moving, y)
    for j in range(d):
        slope = shape_gradient(A, x, j)
        assert gap(slope, {I: v.partials[j] for I, v in values.items()}) == 0
        if order < 2 or d < 3:
            slopes = shape_gradient(moving, y, j)
            for k in range(d):
                assert gap(shape_second(A, x, (j, k)), {I: v.partials[k] for I, v in slopes.items()}) == 0


def test_derivatives_where_the_point_shares_a_coordinate_with_a_node() -> None:
    """y_j = 0 on one axis only: g(z) = phi'(z)/z stands in for 0/0 there, and the factor on the other axis stays."""
    x = (NODES[2][5][0], Fraction(13, 10))
    D = Duals(K, 2)
    y = tuple(D.variable(c, axis) for axis, c in enumerate(x))
    for j, k in product(range(2), repeat=2):
        slopes = shape_gradient(tensor(2, 1, D), y, j)
        assert gap(shape_second(tensor(2), x, (j, k)), {I: v.partials[k] for I, v in slopes.items()}) == 0


def test_a_complex_step_finds_the_gradient() -> None:
    """h = 1e-100 has no truncation: what is left is the rounding of 30 products, of terms below 10."""
    C, x = Complex(), tuple(map(float, PLACES[2]))
    slope = shape_gradient(tensor(2, 1, Float()), x, 0)
    stepped = shape_functions(tensor(2, 1, C), (complex(x[0], 1e-100), complex(x[1])))
    assert max(abs(slope[I] - stepped[I].imag / 1e-100) for I in slope) < 300 * Float.epsilon


@pytest.mark.decides("E35")
@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_material_rate_of_the_product_is_its_series_in_time(d: int) -> None:
    """(35) on every axis times the kernels on the others, against x(t) and x_I(t) put into the product, to O(t^2)."""
    S = Series(2)
    v = tuple(Fraction(axis + 1, 3) for axis in range(d))
    velocities = [tuple(Fraction((I * (axis + 2)) % 7 - 3, 4) for axis in range(d)) for I in range(len(NODES[d]))]
    A, x = tensor(d), PLACES[d]
    places = [[S.variable(*c) for c in zip(node, w, strict=True)] for node, w in zip(NODES[d], velocities, strict=True)]
    moving = approximation(places, SUPPORTS[d], S, window="tensor")
    y = tuple(S.variable(*c) for c in zip(x, v, strict=True))
    for I in A.neighbours(x):
        rate = semi_lagrangian_kernel_rate(A, x, I, v, velocities[I])
        assert rate == S.coefficients(phi(moving, y, I))[1]
        assert rate == phi_rate(A, x, I, tuple(p - q for p, q in zip(v, velocities[I], strict=True)))
    carried = {I: S.coefficients(Psi)[1] for I, Psi in shape_functions(moving, y).items()}
    assert gap(true_rate(A, x, v, velocities), carried) == 0


def test_a_kernel_with_a_peak_has_ridges() -> None:
    """|x_j - x_jI| is not smooth where one component is 0: the tent is refused there, and not beside it."""
    A, e = tensor(2, 1, K, "tent"), (Fraction(1), Fraction(0))
    node = NODES[2][5]
    ridge, beside = (node[0], node[1] + Fraction(1, 3)), (node[0] + Fraction(1, 5), node[1] + Fraction(1, 3))
    with pytest.raises(NotDifferentiable):
        phi_rate(A, ridge, 5, e)
    assert phi_rate(A, beside, 5, e) != 0
    with pytest.raises(NotDifferentiable, match="take a smoother kernel"):
        phi_second_rate(A, ridge, 5, e, e)


def test_the_window_goes_with_the_nodes_and_is_known_by_name() -> None:
    """`at` keeps it, a third one is refused, and the radial window still says where exact numbers end."""
    A = tensor(2)
    moved = A.at([(p + 1, q) for p, q in A.nodes])
    assert moved.window == "tensor"
    x = A.point(*PLACES[2])
    assert shape_functions(moved, (x[0] + 1, x[1])) == shape_functions(A, x)
    with pytest.raises(UnknownName, match="window 'square'"):
        approximation(NODES[2], 2, K, window="square")  # type: ignore[arg-type]
    with pytest.raises(NotRepresentable):
        shape_functions(approximation(NODES[2], SUPPORTS[2], K), x)
