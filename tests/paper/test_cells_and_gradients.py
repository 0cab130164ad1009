"""Nodal cells tile; smoothed gradients are the means over them, and differentiate linear fields exactly."""

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.samples import NodeSet
from rkverify.errors import BadInput
from rkverify.paper.approximation import Approximation, lattice, middle
from rkverify.paper.cells import Cell, lattice_cell, nodal_cells
from rkverify.paper.gradients import direct_gradient, smoothed_gradient
from rkverify.paper.shape import shape_functions, shape_gradient

Build = Callable[..., Approximation]
Points = Callable[[NodeSet], list[Fraction]]
K = Exact()
ENDS = (Fraction(-1, 7), Fraction(6, 5))


def cells(nodes: NodeSet) -> list[Cell]:
    return nodal_cells(nodes.nodes, nodes.nodes[0], nodes.nodes[-1], K)


def test_cells_tile_the_domain(nodes: NodeSet) -> None:
    """End to end, the measures add up to the domain's, each node in its own cell, edges half-way: exactly."""
    found = nodal_cells(nodes.nodes, *ENDS, K)
    assert (found[0].left, found[-1].right) == ENDS
    assert all(p.right == q.left for p, q in pairwise(found))
    assert all(p.right == (x + y) / 2 for p, (x, y) in zip(found, pairwise(nodes.nodes), strict=False))
    assert sum(cell.measure for cell in found) == ENDS[1] - ENDS[0]
    assert all(cell.left <= x <= cell.right and cell.measure > 0 for x, cell in zip(nodes.nodes, found, strict=True))


def test_cells_belong_to_nodes_in_any_order(nodes: NodeSet) -> None:
    shuffled = [*nodes.nodes[1::2], *reversed(nodes.nodes[::2])]
    ordered = dict(zip(nodes.nodes, nodal_cells(nodes.nodes, *ENDS, K), strict=True))
    assert nodal_cells(shuffled, *ENDS, K) == [ordered[x] for x in shuffled]


def test_a_lattices_cell_is_its_voronoi_cell() -> None:
    nodes = [Fraction(n, 20) for n in range(-3, 4)]
    found = nodal_cells(nodes, Fraction(-1), Fraction(1), K)
    assert lattice_cell(nodes[3], Fraction(1, 20)) == found[3] == Cell(Fraction(-1, 40), Fraction(1, 40))


@pytest.mark.parametrize(
    ("nodes", "left", "right", "message"),
    [
        ([-1, 2], 0, 1, r"node 0 at -1 lies outside the domain \[0, 1\]"),
        ([0, 2], 0, 1, "node 1 at 2 lies outside"),
        ([0], 0, 0, "the cell of node 0 at 0 has length 0"),
        ([0, 0, 0], -1, 1, "separate the nodes|both at"),
        ([0, 0], -1, 1, "separate the nodes|both at"),
        ([-1, 0, 0, 1], -1, 1, "separate the nodes|both at"),
        ([], -1, 1, "no nodes"),
    ],
)
def test_what_has_no_cells_is_refused(nodes: list[int], left: int, right: int, message: str) -> None:
    """Decides that every cell has a length and a node of its own: two nodes at one place have no Voronoi cells."""
    with pytest.raises(BadInput, match=message):
        nodal_cells([Fraction(x) for x in nodes], Fraction(left), Fraction(right), K)


@pytest.mark.decides("E52", "E72", "C17")
def test_smoothed_gradients_differentiate_constant_and_linear_fields(build: Build, nodes: NodeSet, order: int) -> None:
    """sum_I b_I^L = 0 in every cell, and sum_I b_I^L x_I = 1 from order 1 on: exactly, in boundary cells as well."""
    A = build(nodes, order)
    linear = []
    for cell in cells(nodes):
        b = smoothed_gradient(A, cell)
        assert sum(b.values()) == 0
        linear.append(sum(value * nodes.nodes[I] for I, value in b.items()))
    assert (linear == [1] * len(linear)) == (order >= 1)


def test_the_twin_with_a_quadratic_field(build: Build, nodes: NodeSet) -> None:
    """The mean of (x^2)' over a cell is 2 x_mid: exact from order 2 on, and at order 1 not."""
    for order in (1, 2):
        A = build(nodes, order)
        off = []
        for cell in cells(nodes):
            b = smoothed_gradient(A, cell)
            off.append(sum(value * nodes.nodes[I] ** 2 for I, value in b.items()) - (cell.left + cell.right))
        assert any(off) == (order == 1)


def mean_gradient(A: Approximation, cell: Cell, cuts: list[Fraction], points: int) -> dict[int, float]:
    """The mean of Psi,x over the cell by Gauss-Legendre with so many points between the cuts."""
    total: dict[int, float] = {}
    places, weights = np.polynomial.legendre.leggauss(points)
    for low, high in pairwise(cuts):
        for place, weight in zip(places, weights, strict=True):
            x = A.K.number(low) + A.K.number(high - low) * (1 + A.K.number(float(place))) / 2
            share = float(weight) * float((high - low) / cell.measure) / 2
            for I, slope in direct_gradient(A, (x,)).items():
                total[I] = total.get(I, 0.0) + share * float(slope)
    return total


@pytest.mark.decides("E52")
def test_a_smoothed_gradient_is_the_mean_of_the_gradient(build: Build, nodes: NodeSet) -> None:
    """The integral of Psi,x over the cell, cut at every node, joint and edge: between them it is one rational function.

    Two degrees of the rule agree to 1e-11, which bounds its error; values have 12 digits, slopes are below 100.
    """
    A, exact, cell = build(nodes, 1, Multiprecision(12)), build(nodes, 1), cells(nodes)[len(nodes.nodes) // 2]
    b = smoothed_gradient(exact, cell)
    corners = {x + s * q * a for x, a in zip(nodes.nodes, nodes.supports, strict=True)
               for s in (-1, 1) for q in (0, Fraction(1, 2), 1)}  # fmt: skip
    cuts = [cell.left, *sorted(c for c in corners if cell.left < c < cell.right), cell.right]
    coarse, fine = (mean_gradient(A, cell, cuts, points) for points in (9, 13))
    for I, mean in fine.items():
        assert abs(mean - coarse[I]) < 1e-11
        assert abs(mean - float(b.get(I, 0))) < 1e-10


def test_on_a_lattice_smoothed_gradients_are_odd(order: int) -> None:
    """b_I^{I+n} = -b_I^{I-n} and b_I^I = 0, exactly: why the frequencies of (63) are sines."""
    A = lattice("1/20", "5/2", 4, K, order=order)
    h, I = Fraction(1, 20), middle(A)
    b = {n: smoothed_gradient(A, lattice_cell(n * h, h)).get(I, Fraction(0)) for n in range(-4, 5)}
    assert b[0] == 0
    assert all(b[n] == -b[-n] for n in range(1, 5))
    assert b[1] != 0


def test_on_other_nodes_they_are_not(build: Build, nodes: NodeSet) -> None:
    """The twin: on irregular nodes the matrix of smoothed gradients is not antisymmetric."""
    A, found = build(nodes, 1), cells(nodes)
    b = [smoothed_gradient(A, cell) for cell in found]
    odd = all(b[K_].get(I, 0) == -b[I].get(K_, 0) for I in (3, 4, 5) for K_ in (3, 4, 5))
    assert odd == (nodes.name == "uniform")


@pytest.mark.decides("E80")
def test_the_direct_gradient_is_the_shape_functions(build: Build, generic: Points, nodes: NodeSet) -> None:
    """(80) in each reading, and that it is not the smoothed one: the two integrations are different operators."""
    A, x = build(nodes, 1), generic(nodes)[0]
    for reading in ("full", "diffuse", "frozen-b", "frozen"):
        assert direct_gradient(A, (x,), reading) == shape_gradient(A, (x,), 0, reading)
    L = len(nodes.nodes) // 2
    assert direct_gradient(A, A.nodes[L]) != smoothed_gradient(A, cells(nodes)[L])


def test_a_shrinking_cell_gives_the_direct_gradient(build: Build, nodes: NodeSet) -> None:
    """(52) over a cell of length e around x tends to Psi,x with the error e^2: a quarter for half the length."""
    A, L = build(nodes, 1), len(nodes.nodes) // 2
    x = nodes.nodes[L] + Fraction(37, 1010) * (nodes.nodes[L + 1] - nodes.nodes[L])
    slope = direct_gradient(A, (x,))
    errors = []
    for e in (Fraction(1, 10**6), Fraction(1, 2 * 10**6)):
        b = smoothed_gradient(A, Cell(x - e / 2, x + e / 2))
        errors.append([b[I] - slope[I] for I in slope if A.distance((x,), I) < 1])
    # The next term is e^2 = 1e-12 times a ratio of derivatives below 1e7 for spacings of 1/8.
    assert all(abs(p / q - 4) < Fraction(1, 10**5) for p, q in zip(*errors, strict=True))


def test_cells_of_undefined_nodes_are_refused() -> None:
    with pytest.raises(BadInput):
        nodal_cells([float("nan"), 0.5], 0.0, 1.0, Float())


def test_a_node_out_of_reach_of_both_edges_is_not_listed(build: Build, nodes: NodeSet) -> None:
    A, cell = build(nodes, 1), cells(nodes)[0]
    reached = shape_functions(A, (cell.left,)).keys() | shape_functions(A, (cell.right,)).keys()
    assert smoothed_gradient(A, cell).keys() == reached < set(range(len(nodes.nodes)))
