"""The weak forms (7), (37) and the two forms of (24) against the strong form, the energy and each other, in rationals."""

from collections.abc import Callable
from fractions import Fraction
from itertools import product as pairs
from typing import Any

import numpy as np

from rkverify.arithmetic.dual import Duals
from rkverify.certify.plates import MODULI, RHO_0, K
from rkverify.paper.approximation import Vector
from rkverify.paper.chain_rule import determinant, inverse
from rkverify.paper.constitutive import (
    Moduli,
    cauchy_work,
    nominal_stress,
    nominal_work,
    product,
    saint_venant_kirchhoff,
    saint_venant_kirchhoff_energy,
    transpose,
)
from rkverify.paper.moment import Matrix
from rkverify.paper.weak_forms import Inside, OnBoundary, lagrangian_weak_form, updated_weak_form

Row = dict[str, Any]
PLACES = [Fraction(j, 4) for j in range(5)]
BOOLE = [Fraction(w, 90) for w in (7, 32, 12, 32, 7)]
"""Boole's rule on [0, 1]: exact up to degree 5, with rational points and weights."""
TESTS = [(p, q, i) for p in range(3) for q in range(3 - p) for i in range(2)]
"""delta u = X_1^p X_2^q e_i up to degree 2."""
BODY: Vector = (Fraction(2, 7), Fraction(-3, 5))


def _deformed(X: Vector, D: Duals) -> Matrix:
    """F of the map x = X + (X_1 X_2/3 + X_2^2/4, X_1/5 - X_1^2/7), which no rotation makes symmetric."""
    one = D.number(1)
    return [[one + X[1] / 3, X[0] / 3 + X[1] / 2], [D.ratio(1, 5) - 2 * X[0] / 7, one]]


def _nominal(X: Vector, D: Duals) -> Matrix:
    """P of (7) there, cubic in X."""
    return saint_venant_kirchhoff(_deformed(X, D), Moduli(D.number(MODULI.lame), D.number(MODULI.shear)), D)


def _cauchy(X: Vector, D: Duals) -> Matrix:
    """A symmetric stress, cubic in x."""
    shear = X[0] * X[1] / 2 - X[1] ** 3 / 3
    return [[X[0] ** 3 - X[1] / 2, shear], [shear, D.ratio(1, 3) + X[0] * X[1] * X[1]]]


def strong_form_rows() -> list[Row]:
    """What (7) and (37) leave for fields that satisfy the strong form, with the stress in its order and transposed.

    rho u_i'' = dP_ji/dX_j + b_i in the unit square, h_i = N_j P_ji on its edges, and delta u up to degree 2.
    """
    return [
        {"equation": name, "stress": order, "tests": len(TESTS), "left": str(_left(form, stress, turned))}
        for name, form, stress in (("(7)", lagrangian_weak_form, _nominal), ("(37)", updated_weak_form, _cauchy))
        for order, turned in (("as printed", False), ("transposed", True))
        if not (turned and name == "(37)")
    ]


def _left(form: Callable[..., Fraction], stress: Callable[..., Matrix], turned: bool) -> Fraction:
    worst = Fraction(0)
    D = Duals(K, 2)
    inside, boundary = _fields(stress, D)
    for test in TESTS:
        points = []
        for X, weight, P, acceleration in inside:
            delta, slope = _test(test, X)
            points.append(Inside(weight, delta, slope, RHO_0, acceleration, transpose(P) if turned else P, BODY))
        edges = [OnBoundary(weight, _test(test, X)[0], h) for X, weight, h in boundary]
        worst = max(worst, abs(form(points, edges, K)))
    return worst


def _fields(
    stress: Callable[..., Matrix], D: Duals
) -> tuple[list[tuple[Vector, Fraction, Matrix, Vector]], list[tuple[Vector, Fraction, Vector]]]:
    """Points with weight, stress and acceleration in the square; points with weight and traction on its edges."""
    inside = []
    for (x, u), (y, w) in pairs(list(zip(PLACES, BOOLE, strict=True)), repeat=2):
        P = stress((D.variable(x, 0), D.variable(y, 1)), D)
        flow = tuple(P[0][i].partials[0] + P[1][i].partials[1] for i in range(2))
        acceleration = tuple((f + b) / RHO_0 for f, b in zip(flow, BODY, strict=True))
        inside.append(((x, y), u * w, [[p.value for p in row] for row in P], acceleration))
    boundary = []
    for axis, end in pairs(range(2), range(2)):
        for place, weight in zip(PLACES, BOOLE, strict=True):
            X = (Fraction(end), place) if axis == 0 else (place, Fraction(end))
            P = stress(tuple(map(D.number, X)), D)
            boundary.append((X, weight, tuple((2 * end - 1) * P[axis][i].value for i in range(2))))
    return inside, boundary


def _test(test: tuple[int, int, int], X: Vector) -> tuple[Vector, Matrix]:
    """delta u and its gradient [i][j]."""
    p, q, i = test
    value = X[0] ** p * X[1] ** q
    slopes = [p * X[0] ** max(p - 1, 0) * X[1] ** q, q * X[0] ** p * X[1] ** max(q - 1, 0)]
    zero = Fraction(0)
    return tuple(value if j == i else zero for j in range(2)), [slopes if j == i else [zero, zero] for j in range(2)]


def _random(rng: np.random.Generator, shape: tuple[int, ...]) -> Any:
    """Random rationals between -1 and 1, as nested lists."""
    if not shape:
        return Fraction(int(rng.integers(-20, 21)), 20)
    return [_random(rng, shape[1:]) for _ in range(shape[0])]


def random_deformation(rng: np.random.Generator, d: int) -> Matrix:
    """F with a positive determinant, entries up to 2."""
    while True:
        F = [[e + int(i == j) for j, e in enumerate(row)] for i, row in enumerate(_random(rng, (d, d)))]
        if determinant(F) > Fraction(1, 20):
            return F


def work_rows(seed: int, count: int) -> list[Row]:
    """Both integrands of (24) for random F, stresses and test gradients, against each other and the energy's slope.

    The energy is St. Venant-Kirchhoff's: its derivative along the test gradient by duals knows no stress at all, and its
    Cauchy stress F S F^T/J comes from the second Piola-Kirchhoff stress S. A stress that is not symmetric tells the order
    of the indices of sigma.
    """
    rows = []
    for d in (1, 2, 3):
        rng, gaps, energy, apart, largest = np.random.default_rng((seed, d)), [], [], [], []
        for _ in range(count):
            F, slope = random_deformation(rng, d), _random(rng, (d, d))
            half = _random(rng, (d, d))
            S = [[half[i][j] + half[j][i] for j in range(d)] for i in range(d)]
            sigma = _pushed(F, S)
            right = cauchy_work(slope, F, sigma, K)
            gaps.append(abs(nominal_work(slope, product(S, transpose(F))) - right))
            apart.append(abs(nominal_work(slope, nominal_stress(F, sigma, K)) - right))
            P = saint_venant_kirchhoff(F, MODULI, K)
            of_law = _pushed(F, product(P, transpose(inverse(F, K))))
            energy.append(abs(cauchy_work(slope, F, of_law, K) - _energy_slope(F, slope, d)))
            largest.append(abs(right))
        rows.append(
            {
                "dimension": d,
                "count": count,
                "push_back": str(max(gaps)),
                "push_forward": str(max(apart)),
                "energy": str(max(energy)),
                "largest": float(max(largest)),
            }
        )
    return rows


def _pushed(F: Matrix, S: Matrix) -> Matrix:
    """sigma = F S F^T/J."""
    J = determinant(F)
    return [[s / J for s in row] for row in product(product(F, S), transpose(F))]


def _energy_slope(F: Matrix, slope: Matrix, d: int) -> Fraction:
    """dW(F + t slope)/dt at t = 0, by duals."""
    D = Duals(K, 1)
    moving = [[D.along(F[i][k], [slope[i][k]]) for k in range(d)] for i in range(d)]
    moduli = Moduli(D.number(MODULI.lame), D.number(MODULI.shear))
    value: Fraction = saint_venant_kirchhoff_energy(moving, moduli, D).partials[0]
    return value


def push_forward_rows(seed: int, count: int) -> list[Row]:
    """(7) and (37) over the same random points: volumes a = J A, rho = rho0/J, b = b0/J, gradients by F^-1, P by (24)."""
    rows = []
    for d in (2, 3):
        rng = np.random.default_rng((seed, 10 + d))
        first, second, boundary = [], [], []
        for _ in range(count):
            F, slope = random_deformation(rng, d), _random(rng, (d, d))
            half = _random(rng, (d, d))
            sigma = [[half[i][j] + half[j][i] for j in range(d)] for i in range(d)]
            delta, acceleration, b0, h0 = (tuple(_random(rng, (d,))) for _ in range(4))
            A, J = abs(_random(rng, ())) + 1, determinant(F)
            P = nominal_stress(F, sigma, K)
            first.append(Inside(A, delta, slope, RHO_0, acceleration, P, b0))
            spatial = product(slope, inverse(F, K))
            b = tuple(c / J for c in b0)
            second.append(Inside(J * A, delta, spatial, RHO_0 / J, acceleration, sigma, b))
            boundary.append(OnBoundary(A, delta, h0))
        one, other = lagrangian_weak_form(first, boundary, K), updated_weak_form(second, boundary, K)
        rows.append({"dimension": d, "points": count, "work": float(one), "apart": str(abs(one - other))})
    return rows
