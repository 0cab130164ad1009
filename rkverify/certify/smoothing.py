"""Checks of the smoothed deformation gradient (13)-(17), (23), (47) and of the linear patch that it is made for.

Each function returns rows (plain dicts) for a study's table; exact rationals are given as text.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.samples import jittered_grid
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.moment import Matrix
from rkverify.paper.nodal_polytopes import nodal_polytope, nodal_polytopes
from rkverify.paper.polytopes import Polytope, box
from rkverify.paper.quadrature import cell_points
from rkverify.paper.shape import Values
from rkverify.paper.smoothing import (
    approximated,
    boundary_average,
    deformation_from_boundary,
    deformation_from_cell,
    direct_gradients,
    displacement_gradient,
    integration_constraint,
    over_the_boundary,
    smoothed_gradients,
)
from rkverify.readings import Window

Row = dict[str, Any]
K = Exact()
PER_SIDE = {1: 5, 2: 3, 3: 2}
RULES = ("trapezoid", "midpoint")
SUPPORT = Fraction(5, 2)
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Covered:
    """An approximation and the cells of its nodes, which tile the domain."""

    A: Approximation
    cells: list[Polytope]
    domain: Polytope


def stretched(x: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """A homogeneous deformation with stretch, shear and turn: x_i = X_i + sum_j (i + 2 j + 1) X_j / 8."""
    return tuple(
        x[i] + sum((Fraction(i + 2 * j + 1, 8) * c for j, c in enumerate(x)), Fraction(0)) for i in range(len(x))
    )


def covered(dimension: int, order: int, seed: int, deformed: bool) -> Covered:
    """Nodes of a jittered grid in a box, with the tensor window; deformed: both carried along, and the cells made anew."""
    per_side = PER_SIDE[dimension]
    # Eighths: rationals that differ little keep small denominators.
    nodes = [tuple(Fraction(round(8 * c), 8) for c in x) for x in jittered_grid(dimension, per_side, seed)]
    domain = box([-HALF] * dimension, [per_side - HALF] * dimension, K)
    if deformed:
        nodes = [stretched(x) for x in nodes]
        domain = Polytope(tuple(map(stretched, domain.corners)), domain.facets, domain.beyond)
    support = SUPPORT * 2 if deformed else SUPPORT
    A = approximation(nodes, support, K, "cubic", order, "tensor")
    # One object for one corner: what is known of a point is kept by the approximation for the point itself.
    same: dict[Vector, Vector] = {}
    cells = [
        Polytope(tuple(same.setdefault(x, x) for x in cell.corners), cell.facets, cell.beyond)
        for cell in nodal_polytopes(A.nodes, domain, K)
    ]
    return Covered(A, cells, domain)


def _largest(values: Iterator[Scalar]) -> Scalar:
    return max((abs(value) for value in values), default=Fraction(0))


def _entries(M: Matrix) -> Iterator[Scalar]:
    return (entry for row in M for entry in row)


def _apart(one: Matrix, other: Matrix) -> Scalar:
    return _largest(p - q for p, q in zip(_entries(one), _entries(other), strict=True))


def _identity_residual(A: Approximation, b: tuple[Values, ...]) -> tuple[Scalar, Scalar]:
    """The largest |sum_I b_iI| and |sum_I b_iI X_jI - delta_ij|."""
    axes = range(A.dimension)
    constant = _largest(sum(b_i.values(), Fraction(0)) for b_i in b)
    linear = displacement_gradient(b, A.nodes, A.K)
    return constant, _largest(linear[j][i] - int(i == j) for i in axes for j in axes)


def sums(dimensions: Sequence[int], seed: int) -> list[Row]:
    """Exact sums of smoothed gradients over the nodes and over the cells, in both configurations and with both rules."""
    rows = []
    for dimension in dimensions:
        for deformed in (False, True):
            at = covered(dimension, 1, seed, deformed)
            for rule in RULES:
                gradients = [smoothed_gradients(at.A, cell, rule) for cell in at.cells]
                residuals = [_identity_residual(at.A, b) for b in gradients]
                over_cells = integration_constraint(gradients, at.cells, K)
                rows.append(
                    {
                        "dimension": dimension,
                        "configuration": "deformed" if deformed else "undeformed",
                        "rule": rule,
                        "constant": str(_largest(c for c, _ in residuals)),
                        "linear": str(_largest(r for _, r in residuals)),
                        "measures": str(abs(sum(cell.measure for cell in at.cells) - at.domain.measure)),
                        "constraint": str(_apart(over_cells, over_the_boundary(at.A, at.cells, rule))),
                    }
                )
    return rows


def patches(dimensions: Sequence[int], seed: int) -> list[Row]:
    """A linear displacement with each of the two conditions met or withheld: what is out of balance, exactly.

    The stress is P_ji = e_ij (a modulus of 1). On the boundary the tractions of the exact stress act, by the same rule; the
    linear displacement solves the discrete equations where every node is in balance.
    """
    rows = []
    for dimension in dimensions:
        axes = range(dimension)
        for order in (1, 0):
            at = covered(dimension, order, seed, False)
            e = [[Fraction(i + 2 * j + 1, 5) for j in axes] for i in axes]
            d = [tuple(sum((e[i][j] * X[j] for j in axes), Fraction(0)) for i in axes) for X in at.A.nodes]
            boundary = over_the_boundary(at.A, at.cells, "trapezoid")
            for integration in ("scni", "dni"):
                if integration == "scni":
                    gradients = [smoothed_gradients(at.A, cell) for cell in at.cells]
                else:
                    gradients = [direct_gradients(at.A, x) for x in at.A.nodes]
                found = [displacement_gradient(b, d, K) for b in gradients]
                rows.append(
                    {
                        "dimension": dimension,
                        "order": order,
                        "integration": integration,
                        "completeness": float(max(_apart(e_L, e) for e_L in found)),
                        "constraint": float(_apart(integration_constraint(gradients, at.cells, K), boundary)),
                        "unbalanced": float(_unbalanced(at, gradients, found, e, boundary)),
                    }
                )
    return rows


def _unbalanced(
    at: Covered, gradients: Sequence[tuple[Values, ...]], found: Sequence[Matrix], e: Matrix, boundary: Matrix
) -> Fraction:
    """The largest |sum_L b_jI^L e_ij^L A_L - int Psi_I N_j dGamma e_ij| over nodes and components."""
    axes, worst = range(at.A.dimension), Fraction(0)
    for I in range(len(at.A.nodes)):
        for i in axes:
            force = -sum((boundary[I][j] * e[i][j] for j in axes), Fraction(0))
            for b, e_L, cell in zip(gradients, found, at.cells, strict=True):
                force += sum((b[j].get(I, Fraction(0)) * e_L[i][j] for j in axes), Fraction(0)) * cell.measure
            worst = max(worst, abs(force))
    return worst


def polynomials(dimensions: Sequence[int], seed: int) -> list[Row]:
    """(13) against (14) for a linear and a quadratic displacement, both exact but for the rule on the boundary."""
    rows = []
    for dimension in dimensions:
        cell = covered(dimension, 1, seed, False).cells[0]
        points = cell_points(cell, 1, K)  # exact for the gradients of both
        for degree in (1, 2):
            average = deformation_from_cell(cell, partial(_slope, degree), points, K)
            for rule in RULES:
                e = boundary_average(cell, partial(_polynomial, degree), rule, K)
                gap = _apart(deformation_from_boundary(e, K), average)
                rows.append({"dimension": dimension, "degree": degree, "rule": rule, "difference": _shown(gap)})
            if dimension == 2:
                simpson = [boundary_average(cell, partial(_polynomial, degree), rule, K) for rule in RULES]
                e = [[(t + 2 * m) / 3 for t, m in zip(*both, strict=True)] for both in zip(*simpson, strict=True)]
                gap = _apart(deformation_from_boundary(e, K), average)
                rows.append({"dimension": dimension, "degree": degree, "rule": "simpson", "difference": _shown(gap)})
    return rows


def _shown(q: Fraction) -> str:
    """0 for the rational 0 alone; of any other one six digits."""
    return f"{float(q):.6g}" if q else "0"


def _polynomial(degree: int, X: Vector) -> Vector:
    """u_i = (sum_j (i + j + 1) X_j) X_i^(degree - 1)"""
    axes = range(len(X))
    return tuple(sum((i + j + 1) * X[j] for j in axes) * X[i] ** (degree - 1) for i in axes)


def _slope(degree: int, X: Vector) -> Matrix:
    axes = range(len(X))
    own = [sum((i + j + 1) * X[j] for j in axes) for i in axes]
    lower = [(degree - 1) * X[i] ** max(degree - 2, 0) for i in axes]
    return [[(i + k + 1) * X[i] ** (degree - 1) + int(i == k) * own[i] * lower[i] for k in axes] for i in axes]


def averages(dimension: int, window: Window, counts: Sequence[int], seed: int) -> list[Row]:
    """The three forms of the smoothed deformation of an approximated displacement, as the quadrature gets finer.

    One cell, coefficients of every sign, and supports that reach over all nodes, so that only the own kernel has a point
    in the cell where it is no polynomial of the distances.
    """
    F = Float()
    nodes = jittered_grid(dimension, PER_SIDE[dimension], seed)
    A = approximation(nodes, 2 * PER_SIDE[dimension], F, "wendland-c4", 1, window)
    domain = box([-HALF] * dimension, [PER_SIDE[dimension] - HALF] * dimension, F)
    middle = len(nodes) // 2
    cell = nodal_polytope(A.nodes, middle, domain, F)
    d = [tuple(((5 * I + 3 * i) % 7 - 3) / 4 for i in range(dimension)) for I in range(len(nodes))]
    inside = {n: [(X, w, direct_gradients(A, X)) for X, w in cell_points(cell, n, F)] for n in counts}
    rows = []
    for rule, count in [*((rule, 0) for rule in RULES), *((f"gauss:{n}", n) for n in counts)]:
        points = inside[count or max(counts)]
        slopes = {id(X): slope for X, _, slope in points}
        b = smoothed_gradients(A, cell, rule)
        summed = displacement_gradient(b, d, F)
        boundary = boundary_average(cell, approximated(A, d), rule, F)

        def du(X: Vector, slopes: dict[int, tuple[Values, ...]] = slopes) -> Matrix:
            return displacement_gradient(slopes[id(X)], d, F)

        average = deformation_from_cell(cell, du, [(X, w) for X, w, _ in points], F)
        rows.append(
            {
                "dimension": dimension,
                "window": window,
                "rule": rule,
                "points": count,
                "boundary_and_sum": float(_apart(boundary, summed)),
                "boundary_and_average": float(_apart(deformation_from_boundary(boundary, F), average)),
                "gradients": max(_from_mean(b, points, cell.measure)),
                "size": float(_largest(_entries(summed))),
            }
        )
    return rows


def _from_mean(
    b: tuple[Values, ...], points: Sequence[tuple[Vector, Scalar, tuple[Values, ...]]], measure: Scalar
) -> list[float]:
    """|b_iI - (1/A_L) int Psi_I,i dOmega| for every node and axis."""
    return [
        abs(b_i.get(I, 0.0) - sum(w * slopes[i].get(I, 0.0) for _, w, slopes in points) / measure)
        for i, b_i in enumerate(b)
        for I in range(1 + max(b_i))
    ]
