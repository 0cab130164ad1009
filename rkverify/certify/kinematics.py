"""Exact and independent checks of shape functions, their derivatives, rates and gradients in one dimension.

Each function returns rows (plain dicts) for a study's table; differences are exact rationals, given as text.
"""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.arithmetic.series import Series
from rkverify.certify.independent import (
    linear_shape_functions_in_closed_form,
    shape_functions_by_minimisation,
)
from rkverify.certify.samples import NodeSet, jittered_grid
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.basis import exponents
from rkverify.paper.cells import nodal_cells
from rkverify.paper.gradients import direct_gradient, smoothed_gradient
from rkverify.paper.kernel_rates import lagrangian_kernel_rate, phi, semi_lagrangian_kernel_rate
from rkverify.paper.material_rates import acceleration, psi_star, true_rate
from rkverify.paper.shape import (
    Values,
    reproducing_residual,
    shape_functions,
    shape_gradient,
    shape_second,
)
from rkverify.readings import DERIVATIVES, Derivative

ORDERS = (0, 1, 2)
GAUSS_POINTS = 16
Row = dict[str, Any]
K = Exact()


def build(nodes: NodeSet, order: int, arithmetic: Arithmetic = K) -> Approximation:
    """The approximation on a set's nodes."""
    return approximation([[x] for x in nodes.nodes], list(nodes.supports), arithmetic, "cubic", order)


def _cases(sets: Sequence[NodeSet]) -> Iterator[tuple[NodeSet, int]]:
    return ((nodes, order) for nodes in sets for order in ORDERS)


def _largest(values: Iterator[Fraction]) -> Fraction:
    return max((abs(value) for value in values), default=Fraction(0))


def _gap(one: Values, other: Values) -> Fraction:
    return _largest(one.get(I, Fraction(0)) - other.get(I, Fraction(0)) for I in one.keys() | other.keys())


def reproduction(sets: Sequence[NodeSet]) -> list[Row]:
    """The largest residual of the reproducing conditions (3), (29) for every degree up to one beyond the order."""
    return [
        {
            "nodes": nodes.name,
            "order": order,
            "degree": degree,
            "residual": str(_largest(reproducing_residual(build(nodes, order), (x,), (degree,)) for x in nodes.points)),
        }
        for nodes, order in _cases(sets)
        for degree in range(order + 2)
    ]


def reproduction_in_space(dimension: int, per_side: int, seed: int, digits: int) -> list[Row]:
    """The largest residual of (3) over all monomials of each degree, with a radial kernel in 2-D or 3-D, at many digits.

    Distances are not rational there: the residual is a rounding error where the condition holds.
    """
    high = Multiprecision(digits)
    nodes = jittered_grid(dimension, per_side, seed)
    centre = [Fraction(per_side - 1, 2) + Fraction(axis + 1, 7) for axis in range(dimension)]
    rows = []
    for order in ORDERS:
        A = approximation(nodes, Fraction(23, 10), high, "cubic", order)
        x = A.point(*centre)
        for degree in range(order + 2):
            monomials = [alpha for alpha in exponents(dimension, degree) if sum(alpha) == degree]
            worst = max(high.absolute(reproducing_residual(A, x, alpha)) for alpha in monomials)
            rows.append({"dimension": dimension, "order": order, "degree": degree, "residual": f"{float(worst):.3g}"})
    return rows


def _routes(nodes: NodeSet, order: int) -> dict[str, Callable[[Fraction], Values]]:
    """The independent routes that there are for an order: name -> x -> shape functions."""
    routes: dict[str, Callable[[Fraction], Values]] = {
        "constrained minimisation": partial(_minimised, nodes=nodes, order=order)
    }
    if order == 1:
        routes["Cramer's rule"] = partial(linear_shape_functions_in_closed_form, nodes.nodes, nodes.supports)
    return routes


def _minimised(x: Fraction, nodes: NodeSet, order: int) -> Values:
    return shape_functions_by_minimisation(nodes.nodes, nodes.supports, x, order)


def shape_routes(sets: Sequence[NodeSet]) -> list[Row]:
    """The largest difference of (4) from constrained minimisation, and for order 1 from the closed form."""
    rows = []
    for nodes, order in _cases(sets):
        A = build(nodes, order)
        for name, route in _routes(nodes, order).items():
            gap = _largest(_gap(shape_functions(A, (x,)), route(x)) for x in nodes.points)
            rows.append({"nodes": nodes.name, "order": order, "route": name, "difference": str(gap)})
    return rows


def digits_against_exact(sets: Sequence[NodeSet], digits: int) -> list[Row]:
    """The largest error of Psi at the given precision against the exact rationals, in units of 10^-digits."""
    rows = []
    high = Multiprecision(digits)
    wide = Multiprecision(2 * digits)
    for nodes, order in _cases(sets):
        worst = wide.zero()
        for x in nodes.points:
            exact = shape_functions(build(nodes, order), (x,))
            rounded = shape_functions(build(nodes, order, high), (high.number(x),))
            for I, value in exact.items():
                error = wide.absolute(wide.number(rounded.get(I, 0)) - wide.number(value))
                worst = max(worst, error)
        rows.append({"nodes": nodes.name, "order": order, "error": float(worst * 10**digits)})
    return rows


def derivative_routes(sets: Sequence[NodeSet]) -> list[Row]:
    """The largest difference of the full first and second derivative from the coefficients of Psi(x + t)."""
    series = Series(4)
    rows = []
    for nodes, order in _cases(sets):
        A, S = build(nodes, order), build(nodes, order, series)
        first, second = [], []
        for x in nodes.points:
            terms = {I: series.coefficients(Psi) for I, Psi in shape_functions(S, (series.variable(x),)).items()}
            first.append(_gap(shape_gradient(A, (x,)), {I: c[1] for I, c in terms.items()}))
            second.append(_gap(shape_second(A, (x,)), {I: 2 * c[2] for I, c in terms.items()}))
        rows.append({"nodes": nodes.name, "order": order, "first": str(max(first)), "second": str(max(second))})
    return rows


def readings_of_the_derivative(sets: Sequence[NodeSet]) -> list[Row]:
    """For each reading: the exact residuals of sum_I dPsi_I = 0 and sum_I dPsi_I x_I = 1, and how far it is from full."""
    rows = []
    for nodes, order in _cases(sets):
        A = build(nodes, order)
        for reading in DERIVATIVES:
            if reading == "diffuse" and order == 0:
                continue
            rows.append({"nodes": nodes.name, "order": order, "reading": reading, **_reading(A, nodes, reading)})
    return rows


def _reading(A: Approximation, nodes: NodeSet, reading: Derivative) -> Row:
    constant, linear, away = [], [], []
    for x in nodes.points:
        slope = shape_gradient(A, (x,), 0, reading)
        full = shape_gradient(A, (x,))
        constant.append(sum(slope.values(), Fraction(0)))
        linear.append(sum((s * nodes.nodes[I] for I, s in slope.items()), Fraction(0)) - 1)
        away.append(_gap(slope, full) / _largest(iter(full.values())))
    return {
        "constant": _rounded(constant),
        "linear": _rounded(linear),
        "from_full": _rounded(away),
    }


def _rounded(values: list[Fraction]) -> float:
    return float(_largest(iter(values)))


def kernel_rates(sets: Sequence[NodeSet]) -> list[Row]:
    """(35) against the time series of phi_a for moving points and nodes, and (34) for points at rest in X."""
    series = Series(2)
    rows = []
    for nodes in sets:
        A = build(nodes, 1)
        moving = A_moving(nodes, 1, series)
        for x, v in _material_points(nodes):
            gaps, sizes, frozen = [], [], []
            for I in A.neighbours((x,)):
                printed = semi_lagrangian_kernel_rate(A, (x,), I, (v,), (nodes.velocities[I],))
                in_time = series.coefficients(phi(moving, (series.variable(x, v),), I))
                gaps.append(printed - in_time[1])
                sizes.append(printed)
                frozen.append(lagrangian_kernel_rate(A, (x,), I))
            rows.append(
                {
                    "nodes": nodes.name,
                    "x": str(x),
                    "difference": str(_largest(iter(gaps))),
                    "semi_lagrangian": _rounded(sizes),
                    "lagrangian": str(_largest(iter(frozen))),
                }
            )
    return rows


def A_moving(nodes: NodeSet, order: int, series: Series) -> Approximation:
    """The approximation on nodes x_I + v_I t, as series in time."""
    moving = [[series.variable(x, v)] for x, v in zip(nodes.nodes, nodes.velocities, strict=True)]
    return approximation(moving, list(nodes.supports), series, "cubic", order)


def _material_points(nodes: NodeSet) -> list[tuple[Fraction, Fraction]]:
    """The set's points, each with a velocity of its own."""
    return [(x, Fraction(2 * j - 3, 7)) for j, x in enumerate(nodes.points)]


def shape_function_rates(sets: Sequence[NodeSet]) -> list[Row]:
    """The true material rate against the time series of Psi, and Psi* of (40) against the true rate, with their sums."""
    series = Series(2)
    rows = []
    for nodes, order in _cases(sets):
        A, moving = build(nodes, order), A_moving(nodes, order, series)
        v_nodes = [(v,) for v in nodes.velocities]
        true_gap, star_gap, true_sum, star_sum, kernel_gap = [], [], [], [], []
        for x, v in _material_points(nodes):
            in_time = shape_functions(moving, (series.variable(x, v),))
            true, star = true_rate(A, (x,), (v,), v_nodes), psi_star(A, (x,), (v,), v_nodes)
            true_gap.append(_gap(true, {I: series.coefficients(Psi)[1] for I, Psi in in_time.items()}))
            star_gap.append(_gap(true, star))
            kernel_gap.append(_gap(star, _star_by_other_routes(nodes, order, moving, series, x, v)))
            true_sum.append(sum(true.values(), Fraction(0)))
            star_sum.append(sum(star.values(), Fraction(0)))
        rows.append(
            {
                "nodes": nodes.name,
                "order": order,
                "true_against_series": str(max(true_gap)),
                "star_against_series": str(max(kernel_gap)),
                "sum_of_true": str(_largest(iter(true_sum))),
                "star_against_true": _rounded(star_gap),
                "sum_of_star": _rounded(star_sum),
            }
        )
    return rows


def _star_by_other_routes(
    nodes: NodeSet, order: int, moving: Approximation, series: Series, x: Fraction, v: Fraction
) -> Values:
    """Psi_I / phi_I from constrained minimisation, times the time series of the kernel: (40) without its own lines."""
    found = {}
    for I, Psi in shape_functions_by_minimisation(nodes.nodes, nodes.supports, x, order).items():
        phi_I, rate = series.coefficients(phi(moving, (series.variable(x, v),), I))
        found[I] = Psi / phi_I * rate
    return found


def accelerations(sets: Sequence[NodeSet]) -> list[Row]:
    """(39) with Psi* against the time derivative of (38), for nodes with velocities and accelerations."""
    series = Series(2)
    rows = []
    for nodes, order in _cases(sets):
        A, moving = build(nodes, order), A_moving(nodes, order, series)
        v_nodes = [(v,) for v in nodes.velocities]
        a_nodes = [(Fraction(I % 5 - 2, 3),) for I in range(len(nodes.nodes))]
        gaps, sizes = [], []
        for x, v in _material_points(nodes):
            printed = acceleration(A, (x,), (v,), v_nodes, a_nodes)
            in_time = sum(
                (Psi * series.variable(v_nodes[I][0], a_nodes[I][0])
                 for I, Psi in shape_functions(moving, (series.variable(x, v),)).items()),
                series.zero(),
            )  # fmt: skip
            true = series.coefficients(in_time)[1]
            gaps.append(printed - true)
            sizes.append(true)
        rows.append(
            {"nodes": nodes.name, "order": order, "difference": _rounded(gaps), "acceleration": _rounded(sizes)}
        )
    return rows


def smoothed_gradients(sets: Sequence[NodeSet]) -> list[Row]:
    """Sums of the smoothed gradients (52), (72) over the nodes, and their distance from the mean of Psi,x over the cell.

    The mean is taken by Gauss-Legendre quadrature between the kernels' joints, in double precision.
    """
    rows = []
    for nodes in sets:
        A = build(nodes, 1)
        cells = nodal_cells(nodes.nodes, nodes.nodes[0], nodes.nodes[-1], K)
        constant, linear, means = [], [], []
        for L, cell in enumerate(cells):
            b = smoothed_gradient(A, cell)
            constant.append(sum(b.values(), Fraction(0)))
            linear.append(sum((value * nodes.nodes[I] for I, value in b.items()), Fraction(0)) - 1)
            if len(cells) // 2 == L:
                means.append(_distance_from_mean(nodes, cell.left, cell.right, b))
        rows.append(
            {
                "nodes": nodes.name,
                "constant": str(_largest(iter(constant))),
                "linear": str(_largest(iter(linear))),
                "from_mean": max(means),
            }
        )
    return rows


def _distance_from_mean(nodes: NodeSet, left: Fraction, right: Fraction, b: Values) -> float:
    A = build(nodes, 1, Float())
    joints = {
        x + s * a * q
        for x, a in zip(nodes.nodes, nodes.supports, strict=True)
        for s in (-1, 1)
        for q in (1, Fraction(1, 2))
    }
    cuts = [float(q) for q in (left, *sorted({q for q in joints | set(nodes.nodes) if left < q < right}), right)]
    places, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    mean = dict.fromkeys(b, 0.0)
    for low, high in pairwise(cuts):
        for place, weight in zip(places, weights, strict=True):
            x = (low + high) / 2 + (high - low) / 2 * float(place)
            for I, slope in direct_gradient(A, (x,)).items():
                mean[I] = mean.get(I, 0.0) + slope * float(weight) * (high - low) / 2 / float(right - left)
    return max(abs(mean[I] - float(b.get(I, 0))) for I in mean)
