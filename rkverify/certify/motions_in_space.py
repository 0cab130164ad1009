"""Checks of the chain rule (25) and of what supports and shape functions do in motions, in one to three dimensions.

Each function returns rows (plain dicts) for a study's table; exact rationals are given as text.
"""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.certify.motions import Motion, motions
from rkverify.certify.samples import jittered_grid
from rkverify.paper.approximation import Vector, approximation
from rkverify.paper.chain_rule import spatial_gradients
from rkverify.paper.kernel_rates import direction, dot, minus
from rkverify.paper.shape import Values, shape_functions
from rkverify.paper.smoothing import direct_gradients

Row = dict[str, Any]
K = Exact()
PER_SIDE = {1: 6, 2: 4, 3: 3}
SUPPORT = Fraction(5, 2)


def deformation_gradient(motion: Callable[[Scalar], Motion], t: Fraction, X: Vector) -> list[list[Fraction]]:
    """F_ij = dx_i/dX_j, exactly, by duals."""
    D = Duals(K, len(X))
    image = motion(t).forth(tuple(D.variable(c, j) for j, c in enumerate(X)))
    return [list(x_i.partials) for x_i in image]


def chain_rule(dimensions: Sequence[int], orders: Sequence[int], seed: int) -> list[Row]:
    """(25) against the derivative of x -> Psi_I(back(x)) by duals, exactly; and what comes out without F^-1."""
    rows, t = [], Fraction(1, 3)
    for dimension in dimensions:
        nodes, D = jittered_grid(dimension, PER_SIDE[dimension], seed), Duals(K, dimension)
        X = tuple(Fraction(PER_SIDE[dimension] - 1, 2) + Fraction(j + 1, 7) for j in range(dimension))
        for order in orders:
            A, B = (approximation(nodes, SUPPORT, L, "cubic", order, "tensor") for L in (K, D))
            slopes = direct_gradients(A, X)
            for motion in motions(dimension):
                x = motion(t).forth(X)
                mapped = motion(t).back(tuple(D.variable(c, i) for i, c in enumerate(x)))
                true = shape_functions(B, mapped)
                spatial = spatial_gradients(slopes, deformation_gradient(motion, t, X), K)
                rows.append(
                    {
                        "dimension": dimension,
                        "order": order,
                        "motion": motion(t).name,
                        "difference": str(max(_gaps(spatial, true))),
                        "without": float(max(_gaps(slopes, true))),
                    }
                )
    return rows


def _gaps(slopes: Sequence[Values], true: Values) -> Iterator[Fraction]:
    return (abs(slopes[i][I] - p) for I, Psi in true.items() for i, p in enumerate(Psi.partials))


def supports(dimensions: Sequence[int], per_axis: int, seed: int, digits: int) -> list[Row]:
    """Material particles under one kernel before and after, and shape functions at material points, in every motion.

    Particles are points of a fine grid; a particle is found back from its current position. Counts are exact. Values
    belong to the radial window, whose distances are not rational, and have `digits` digits.
    """
    rows = []
    for dimension in dimensions:
        nodes: list[Vector] = list(jittered_grid(dimension, PER_SIDE[dimension], seed))
        centre = nodes[len(nodes) // 2]
        steps = [2 * SUPPORT * Fraction(2 * k - per_axis + 1, 2 * per_axis - 2) for k in range(per_axis)]
        particles = [
            tuple(c + s for c, s in zip(centre, place, strict=True)) for place in product(steps, repeat=dimension)
        ]
        before = {X for X in particles if _inside(X, centre)}
        for motion in motions(dimension):
            for t in (Fraction(1, 4), Fraction(1, 2)):
                at = motion(t)
                now = [at.forth(X) for X in particles]
                lagrangian = {X for X, x in zip(particles, now, strict=True) if _inside(at.back(x), centre)}
                semi = {X for X, x in zip(particles, now, strict=True) if _inside(x, at.forth(centre))}
                rows.append(
                    {
                        "dimension": dimension,
                        "motion": at.name,
                        "time": str(t),
                        "particles": len(before),
                        "lagrangian_entered": len(lagrangian - before),
                        "lagrangian_left": len(before - lagrangian),
                        "entered": len(semi - before),
                        "left": len(before - semi),
                        **_changes(nodes, at, digits),
                    }
                )
    return rows


def _inside(x: Vector, centre: Vector) -> bool:
    y = minus(x, centre)
    return bool(dot(y, y) < SUPPORT**2)


def _changes(nodes: Sequence[Vector], at: Motion, digits: int) -> Row:
    """The largest change of a shape function at material points: on material coordinates, and on current ones."""
    M = Multiprecision(digits)
    undeformed = approximation(nodes, SUPPORT, M)
    deformed = approximation([at.forth(X) for X in nodes], SUPPORT, M)
    middle = sum((X[0] for X in nodes), Fraction(0)) / len(nodes)
    lagrangian, semi = [], []
    for k in range(3):
        X = tuple(middle + Fraction(2 * k - 2 + j, 9) for j in range(len(nodes[0])))
        x = at.forth(X)
        first = shape_functions(undeformed, undeformed.point(*X))
        lagrangian.append(_change(first, shape_functions(undeformed, undeformed.point(*at.back(x))), M))
        semi.append(_change(first, shape_functions(deformed, deformed.point(*x)), M))
    return {"lagrangian_change": float(max(lagrangian)), "change": float(max(semi))}


def _change(one: Values, other: Values, K: Arithmetic) -> Scalar:
    both = one.keys() | other.keys()
    first, second = ({I: values[I] if I in values else K.zero() for I in both} for values in (one, other))
    return max(abs(first[I] - second[I]) for I in both)


def signs(dimensions: Sequence[int], seed: int, digits: int) -> list[Row]:
    """The sign of n.(v - v_I) against whether the distance grows from a little before to a little after, for pairs of nodes.

    The distances are compared by their exact squares; n has `digits` digits, and is taken as 0 within half of them.
    """
    M, D, rows = Multiprecision(digits), Duals(K, 1), []
    small, none = Fraction(1, 10**6), Fraction(1, 10 ** (digits // 2))
    for dimension in dimensions:
        nodes = jittered_grid(dimension, PER_SIDE[dimension], seed)
        rng = np.random.default_rng(seed)
        for motion in motions(dimension):
            t = Fraction(int(rng.integers(1, 30)), 60)
            moving = motion(D.variable(t, 0))
            paths = [moving.forth(tuple(map(D.number, X))) for X in nodes]
            x = [tuple(c.value for c in path) for path in paths]
            v = [tuple(c.partials[0] for c in path) for path in paths]
            before, after = ([motion(t + s * small).forth(X) for X in nodes] for s in (-1, 1))
            A = approximation(x, SUPPORT, M)
            told = {"away": 0, "towards": 0, "neither": 0}
            wrong = 0
            for I, J in product(range(len(nodes)), repeat=2):
                if I == J:
                    continue
                n = direction(A, A.nodes[J], I)
                rate = dot(n, tuple(M.number(c) for c in minus(v[J], v[I])))
                sign = 0 if abs(rate) < float(none) else M.sign(rate)
                gaps = [minus(y[J], y[I]) for y in (before, after)]
                grows = K.sign(dot(gaps[1], gaps[1]) - dot(gaps[0], gaps[0]))
                told[{1: "away", -1: "towards", 0: "neither"}[sign]] += 1
                wrong += sign != grows
            rows.append({"dimension": dimension, "motion": motion(t).name, "time": str(t), **told, "wrong": wrong})
    return rows
