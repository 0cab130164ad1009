"""How far Voronoi cells in doubles are from tiling a box: the sum of their measures, and the sum of each cell's area vectors.

The computed vertices are data: whatever they are, facets that two cells share cancel exactly from both sums, and vertices on
the sides of a box have a coordinate that nothing rounded. What is left is the rounding of each facet's share.
"""

from fractions import Fraction
from math import fsum, prod

import numpy as np

from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.measures import Measured, compared
from rkverify.certify.worst.running import Rounded, rounded, stacked
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi import voronoi


def area_rounding(cells: Cells) -> list[Rounded]:
    """The area vectors, (d,) of (F,), from the facets' corners."""
    v = [rounded(column) for column in cells.vertices.T]
    if cells.dimension == 1:
        return [rounded(cells.areas[:, 0])]
    if cells.dimension == 2:
        a, b = cells.corners.reshape(-1, 2).T
        return [v[1][b] - v[1][a], v[0][a] - v[0][b]]
    first, last = cells.starts[:-1], cells.starts[1:]
    parts: list[list[Rounded]] = [[], [], []]
    for start, end in zip(first, last, strict=True):
        ring = cells.corners[start:end]
        spoke = [c[ring] - c[ring[:1]] for c in v]
        onward = [c[np.roll(ring, -1)] - c[ring[:1]] for c in v]
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            # Facets may have been turned round after the sum, which then ran over the corners the other way.
            halves = (spoke[i] * onward[j] - spoke[j] * onward[i]) / 2.0
            parts[k].append(halves.total_in_any_order())
    return [stacked(each) for each in parts]


def measure_rounding(cells: Cells, positions: Array) -> Rounded:
    """The measures (N,): for each cell the sum over its facets of (v - x_L) . A / d with v the facet's first corner."""
    d = cells.dimension
    areas = area_rounding(cells)
    place = cells.vertices[cells.corners[cells.starts[:-1]]]
    sizes, errors = np.zeros(len(positions)), np.zeros(len(positions))
    values, many = np.zeros(len(positions)), np.zeros(len(positions))
    for side, sign in ((0, 1.0), (1, -1.0)):
        has = cells.sides[:, side] != OUTSIDE
        cell = cells.sides[has, side]
        terms = [(rounded(place[has, k]) - rounded(positions[cell, k])) * areas[k][has] for k in range(d)]
        share = terms[0]
        for term in terms[1:]:
            share = share + term
        share = share / float(d)
        np.add.at(values, cell, sign * share.value)
        np.add.at(sizes, cell, abs(share.value))
        np.add.at(errors, cell, share.reach)
        np.add.at(many, cell, 1.0)
    # Sums in any order: one rounding of at most the sum of sizes for each addition.
    return Rounded(values, errors + many * sizes)


def measures_case(case: WorstCase) -> Measured:
    """The sum of the measures against the measure of the box, both exact sums. The condition number: sizes of all shares over it."""
    domain = case.box()
    cells = voronoi(case.nodes, domain)
    of = measure_rounding(cells, case.nodes)
    exact = prod((Fraction(q) - Fraction(p) for p, q in zip(domain.low.tolist(), domain.high.tolist(), strict=True)), start=Fraction(1))  # fmt: skip
    error = abs(sum(map(Fraction, cells.measures.tolist()), Fraction(0)) - exact)
    return compared(float(error), fsum(of.bound), float(exact), cell_condition(cells, case.nodes))


def cell_condition(cells: Cells, positions: Array) -> float:
    """The largest sum of |(v - x_L) . A| / d over a cell's facets, over its measure: what cancels from it."""
    sizes = np.zeros(len(positions))
    place = cells.vertices[cells.corners[cells.starts[:-1]]]
    for side in (0, 1):
        has = cells.sides[:, side] != OUTSIDE
        cell = cells.sides[has, side]
        np.add.at(sizes, cell, (abs(place[has] - positions[cell]) * abs(cells.areas[has])).sum(axis=1) / cells.dimension)  # fmt: skip
    return float((sizes / cells.measures).max())


def closure_case(case: WorstCase) -> Measured:
    """The sum of the outward area vectors of each cell, exactly 0, summed exactly; component by component."""
    cells = voronoi(case.nodes, case.box())
    areas = area_rounding(cells)
    count, d = len(cells), cells.dimension
    net = [[Fraction(0)] * d for _ in range(count)]
    bounds = np.zeros((count, d))
    for side, sign in ((0, 1), (1, -1)):
        for f in np.flatnonzero(cells.sides[:, side] != OUTSIDE):
            L = int(cells.sides[f, side])
            for k in range(d):
                net[L][k] += sign * Fraction(float(cells.areas[f, k]))
                bounds[L, k] += areas[k].bound[f]
    errors = np.array([[float(abs(c)) for c in row] for row in net])
    return compared(errors, bounds, float(abs(cells.areas).max()), cell_condition(cells, case.nodes))
