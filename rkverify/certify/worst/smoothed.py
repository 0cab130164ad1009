"""Smoothed gradients of one cell by both routes, and what rounding may do to them."""

from dataclasses import dataclass

import numpy as np

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import Float
from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.measures import Measured, compared, in_arithmetic, transcription_bounds
from rkverify.certify.worst.running import Rounded, rounded, stacked
from rkverify.certify.worst.shape_rounding import shape_rounding
from rkverify.certify.worst.tiling import area_rounding, measure_rounding
from rkverify.paper.polytopes import Polytope, polygon
from rkverify.paper.smoothing import smoothed_gradients
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.given_cells import polygon_cells
from rkverify.solid.gradients import scni
from rkverify.solid.kernel_values import Array


def one_cell(corners: Array) -> Cells:
    """An interval between two ends (2, 1), or a polygon (n, 2), counter-clockwise, as the only cell."""
    if corners.shape[1] == 2:
        return polygon_cells([[corners]])
    sides = np.array([[0, OUTSIDE], [0, OUTSIDE]])
    return Cells(corners, np.arange(3), np.arange(2), sides, np.array([[-1.0], [1.0]]), corners[1] - corners[0])


def literal_cell(corners: Array, K: Arithmetic) -> Polytope:
    """The same in the transcription."""
    if corners.shape[1] == 2:
        return polygon(corners.tolist(), K)
    ends = tuple((K.number(c),) for c in corners[:, 0].tolist())
    return Polytope(ends, ((0,), (1,)), (None, None))


@dataclass(frozen=True)
class VertexShapes:
    """Psi at the vertices of cells, with its rounding (V, N), and the condition numbers of the moment matrices (V,)."""

    values: Rounded
    conditions: Array


def vertex_shapes(case: WorstCase, cells: Cells) -> VertexShapes:
    """Of the case's approximation; each vertex has sources of errors of its own."""
    made, A, used = case.cloud(), case.literal(), np.unique(cells.corners)
    found = [shape_rounding(made, A, cells.vertices[q], 0) for q in used]
    value, error = (np.zeros((len(cells.vertices), len(made))) for _ in range(2))
    counts = [len(of.values.sources) for of in found]
    shared, first = np.zeros((sum(counts), len(cells.vertices), len(made))), 0
    conditions = np.ones(len(cells.vertices))
    for q, of, count in zip(used, found, counts, strict=True):
        value[q, of.nodes], error[q, of.nodes] = of.values.value, of.values.error
        shared[first : first + count, q, of.nodes] = of.values.sources
        conditions[q] = of.systems.condition
        first += count
    return VertexShapes(Rounded(value, error, shared), conditions)


def gradient_rounding(cells: Cells, measures: Rounded, at: VertexShapes) -> list[Rounded]:
    """b_iI^L (L, N) for every axis: sums over facets and corners of Psi / 2 or Psi, area vectors and 1/A_L, in any order.

    The trapezoidal rule on a line or in the plane: it visits the vertices alone, which are data.
    """
    per, areas = rounded(1.0) / measures, area_rounding(cells)
    return [
        stacked([_over_facets(cells, at, [(per[L] * areas[k][f] * sign, f) for f, sign in facets]) for L, facets in enumerate(_facets_of(cells))])
        for k in range(cells.dimension)
    ]  # fmt: skip


def boundary_rounding(cells: Cells, at: VertexShapes) -> list[Rounded]:
    """The integrals of Psi_I n_i over the boundary (N,) for every axis."""
    areas = area_rounding(cells)
    return [_over_facets(cells, at, [(areas[k][f], int(f)) for f in cells.boundary]) for k in range(cells.dimension)]


def _facets_of(cells: Cells) -> list[list[tuple[int, float]]]:
    """The facets of every cell, with the sign of their area vectors."""
    found: list[list[tuple[int, float]]] = [[] for _ in range(len(cells))]
    for f, (one, other) in enumerate(cells.sides):
        found[one].append((f, 1.0))
        if other != OUTSIDE:
            found[other].append((f, -1.0))
    return found


def _over_facets(cells: Cells, at: VertexShapes, weights: list[tuple[Rounded, int]]) -> Rounded:
    d = cells.dimension
    ends = cells.corners.reshape(-1, d)
    terms = stacked([weight * (1 / d) * at.values[q] for weight, f in weights for q in ends[f]])
    return terms.T.total_in_any_order()


def smoothed_case(case: WorstCase) -> Measured:
    """b_iI^L of (17) for one cell: the two routes in doubles against each other. The bound is the sum of the two routes' own."""
    corners = case.array("cell")
    made, cells = case.cloud(), one_cell(corners)
    # About its first corner, as both take it, the measure of a single polygon is a sum of products as of a node there.
    measures = measure_rounding(cells, corners[:1])
    at = vertex_shapes(case, cells)
    own = gradient_rounding(cells, measures, at)
    one = scni(made, cells, "trapezoid")

    def literal(K: Arithmetic) -> dict[str, Scalar]:
        b = smoothed_gradients(in_arithmetic(case, K), literal_cell(corners, K), "trapezoid")
        return {f"{k} {I}": value for k, part in enumerate(b) for I, value in part.items()}

    other, nodes = literal(Float()), range(len(made))
    names = [f"{k} {I}" for k in range(case.dimension) for I in nodes]
    found = np.concatenate([part.toarray()[0] for part in one.parts])
    errors = abs(found - np.array([other.get(name, 0.0) for name in names]))
    bounds = np.concatenate([part.bound[0] for part in own]) + transcription_bounds(literal, names)
    size = max(map(abs, other.values()))
    return compared(errors, bounds, size, float(at.conditions.max()))
