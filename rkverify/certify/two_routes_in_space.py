"""The transcription against the compiled code on the same nodes: shape functions, derivatives, cells, smoothed gradients.

Each comparison gives the largest difference and what it may be: a tolerance times the size of the quantity at the point
times the condition number of the moment matrix there. Cells are held against exact rationals.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement, product

import numpy as np

from rkverify.arithmetic.native import Exact, Float
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.nodal_polytopes import nodal_polytope, nodal_polytopes
from rkverify.paper.polytopes import box
from rkverify.paper.quadrature import boundary_points
from rkverify.paper.shape import Values, shape_functions, shape_gradient, shape_second
from rkverify.paper.smoothing import smoothed_gradients
from rkverify.readings import WINDOWS, Window
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import Box
from rkverify.solid.domain import box as solid_box
from rkverify.solid.gradients import scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.shape import condition_numbers, shape
from rkverify.solid.voronoi import voronoi

PER_SIDE = {1: 6, 2: 4, 3: 3}
GRAIN = 64
"""Coordinates are whole multiples of 1/64: doubles hold them, and cells meet in one point exactly or clearly not."""
REACH = Fraction(13, 4)
"""The least support radius, for a spacing of about 1: it covers three layers of nodes at the corners of the box."""
SMOOTH = tuple(sorted(name for name, kernel in KERNELS.items() if kernel.continuity >= 2))
TOLERANCES = {"value": 1e-13, "first": 1e-11, "second": 1e-9, "smoothed": 1e-11, "measure": 1e-13, "facet": 1e-12}
"""Relative to size times condition for the first four, and to a power of the box's side for cells."""
Place = tuple[Fraction, ...]


@dataclass(frozen=True)
class Case:
    """Nodes (N, d) about a grid of spacing 1 in a box, supports (N,), kernel, order, window; a point, a cell, its edge rule.

    axes: the pair of axes of the second derivative.
    """

    nodes: tuple[Place, ...]
    supports: tuple[Fraction, ...]
    kernel: str
    order: int
    window: Window
    point: Place
    cell: int
    rule: str
    axes: tuple[int, int]

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return len(self.point)

    @property
    def side(self) -> int:
        """The side of the box, from -1/2 on."""
        return PER_SIDE[self.dimension]


@dataclass(frozen=True)
class Disagreement:
    """The largest difference in one quantity, what it may be, and the size of the quantity."""

    quantity: str
    difference: float
    bound: float
    size: float

    @property
    def ratio(self) -> float:
        """The difference in units of its bound."""
        return self.difference / self.bound


def moved_grid(dimension: int, steps: Sequence[int]) -> tuple[Place, ...]:
    """The grid's nodes, each coordinate moved by so many 64ths (N d,)."""
    places = list(product(range(PER_SIDE[dimension]), repeat=dimension))
    by = iter(steps)
    return tuple(tuple(c + Fraction(int(next(by)), GRAIN) for c in place) for place in places)


def drawn(dimension: int, order: int, window: Window, own: bool, seed: int) -> Case:
    """A case from a seed; own: with supports of their own."""
    rng = np.random.default_rng([seed, dimension, order, window == "tensor", own])
    side = PER_SIDE[dimension]
    count = side**dimension
    more = rng.integers(0, 9, size=count) if own else np.full(count, rng.integers(0, 9))
    pairs = list(combinations_with_replacement(range(dimension), 2))
    rules = ("trapezoid", "midpoint", "gauss:2", "gauss:3")
    return Case(
        nodes=moved_grid(dimension, rng.integers(-22, 23, size=count * dimension).tolist()),
        supports=tuple(REACH + Fraction(int(m), 16) for m in more),
        kernel=SMOOTH[rng.integers(len(SMOOTH))],
        order=order,
        window=window,
        point=tuple(Fraction(int(k), GRAIN) for k in rng.integers(-GRAIN // 2, GRAIN * side - GRAIN // 2 + 1, size=dimension)),
        cell=int(rng.integers(count)),
        rule=rules[rng.integers(len(rules))],
        axes=pairs[rng.integers(len(pairs))],
    )  # fmt: skip


def _literal(case: Case) -> Approximation:
    return approximation(case.nodes, list(case.supports), Float(), case.kernel, case.order, case.window)


def _compiled(case: Case) -> Cloud:
    nodes = np.array([[float(c) for c in x] for x in case.nodes])
    return cloud(nodes, np.array([float(a) for a in case.supports]), case.kernel, case.order, case.window)


def _dense(values: Values, count: int) -> Array:
    row = np.zeros(count)
    for I, value in values.items():
        row[I] = value
    return row


def shape_disagreements(case: Case) -> list[Disagreement]:
    """Values, gradients along all axes and one second derivative at the point."""
    A, nodes = _literal(case), _compiled(case)
    x, count = A.point(*case.point), len(case.nodes)
    found = shape(nodes, np.array([x], dtype=float), 2)
    condition = float(condition_numbers(nodes, np.array([x], dtype=float))[0])
    k, l = case.axes
    gradients = np.array([_dense(shape_gradient(A, x, axis), count) for axis in range(case.dimension)])
    others = np.array([found.gradient_matrix(axis).toarray()[0] for axis in range(case.dimension)])
    return [
        _compared("value", _dense(shape_functions(A, x), count), found.matrix().toarray()[0], condition),
        _compared("first", gradients, others, condition),
        _compared(
            "second", _dense(shape_second(A, x, (k, l)), count), found.second_matrix(k, l).toarray()[0], condition
        ),
    ]


def _compared(quantity: str, one: Array, other: Array, condition: float, least: float = 0.0) -> Disagreement:
    size = max(float(abs(one).max()), least)
    return Disagreement(quantity, float(abs(one - other).max()), TOLERANCES[quantity] * size * condition, size)


def _solid_box(case: Case) -> Box:
    return solid_box([-0.5] * case.dimension, [case.side - 0.5] * case.dimension)


def gradient_disagreements(case: Case) -> list[Disagreement]:
    """The smoothed gradients of one cell by the case's rule; the condition number is the largest on its facets."""
    A, nodes, F = _literal(case), _compiled(case), Float()
    low = [Fraction(-1, 2)] * case.dimension
    domain = box(low, [c + case.side for c in low], F)
    cell = nodal_polytope(A.nodes, case.cell, domain, F)
    b = smoothed_gradients(A, cell, case.rule)
    operator = scni(nodes, voronoi(nodes.positions, _solid_box(case)), case.rule)
    visited = np.array([X for X, _ in boundary_points(cell, case.rule, F)], dtype=float)
    condition = float(condition_numbers(nodes, visited).max())
    one = np.array([_dense(b_i, len(case.nodes)) for b_i in b])
    other = np.array([part.toarray()[case.cell] for part in operator.parts])
    return [_compared("smoothed", one, other, condition)]


def cell_disagreements(case: Case) -> list[Disagreement]:
    """Measures of all cells, and the area vectors between all pairs of them and towards the outside, against rationals."""
    K, low = Exact(), [Fraction(-1, 2)] * case.dimension
    exact = nodal_polytopes(case.nodes, box(low, [c + case.side for c in low], K), K)
    cells = voronoi(_compiled(case).positions, _solid_box(case))
    measures = np.array([float(cell.measure) for cell in exact])
    areas = _areas(cells)
    worst = size = 0.0
    for L, cell in enumerate(exact):
        mine: dict[int, Array] = {}
        for f, beyond in enumerate(cell.beyond):
            other = OUTSIDE if beyond is None else beyond
            mine[other] = mine.get(other, np.zeros(case.dimension)) + np.array([float(c) for c in cell.area(f)])
        for other in mine.keys() | areas[L].keys():
            zero = np.zeros(case.dimension)
            worst = max(worst, float(abs(mine.get(other, zero) - areas[L].get(other, zero)).max()))
            size = max(size, float(abs(mine.get(other, zero)).max()))
    side = float(case.side)
    return [
        _compared("measure", measures, cells.measures, 1.0, side**case.dimension),
        Disagreement("facet", worst, TOLERANCES["facet"] * side ** (case.dimension - 1), size),
    ]


def _areas(cells: Cells) -> list[dict[int, Array]]:
    """For every cell: the cell on the other side -> the sum of the area vectors of their facets, outward."""
    found: list[dict[int, Array]] = [{} for _ in range(len(cells))]
    for (L, J), area in zip(cells.sides, cells.areas, strict=True):
        for here, there, sign in ((L, J, 1), (J, L, -1)):
            if here != OUTSIDE:
                found[here][int(there)] = found[here].get(int(there), np.zeros(cells.dimension)) + sign * area
    return found


def disagreements(case: Case) -> list[Disagreement]:
    """All quantities of a case."""
    return [*shape_disagreements(case), *gradient_disagreements(case), *cell_disagreements(case)]


@dataclass(frozen=True)
class Worst:
    """The case of a survey in which a quantity comes nearest to its bound."""

    dimension: int
    order: int
    found: Disagreement
    case: Case
    seed: int


def survey(orders: Sequence[int], seeds: Mapping[int, Sequence[int]]) -> list[Worst]:
    """The worst case of each quantity over both windows, common and own supports, and the seeds of each dimension."""
    kept = []
    for dimension, order in product(seeds, orders):
        worst: dict[str, Worst] = {}
        for window, own, seed in product(WINDOWS, (False, True), seeds[dimension]):
            case = drawn(dimension, order, window, own, seed)
            for found in disagreements(case):
                if found.quantity not in worst or found.ratio > worst[found.quantity].found.ratio:
                    worst[found.quantity] = Worst(dimension, order, found, case, seed)
        kept += list(worst.values())
    return kept
