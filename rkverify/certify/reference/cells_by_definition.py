"""Smoothed gradients a second time: sums over the corners of a cell, where the transcription sums over its sides."""

from collections.abc import Sequence
from typing import Any

import flint

from rkverify.certify.reference.by_definition import Defined, Place

Columns = list[list[Any]]
"""One list of values of all nodes for every axis."""


def polygon_area(corners: Sequence[Place]) -> Any:
    """Half the sum of x_k y_(k+1) - x_(k+1) y_k."""
    following = [*corners[1:], corners[0]]
    return sum((p[0] * q[1] - q[0] * p[1] for p, q in zip(corners, following, strict=True)), flint.arb(0)) / 2


def in_polygon(D: Defined, corners: Sequence[Place], rule: str) -> Columns:
    """b_iI of a polygon, corners counter-clockwise.

    trapezoid: sum_k Psi_I(p_k) n_k / 2A with n_k normal to the chord from p_(k-1) to p_(k+1). midpoint, gauss:2 and gauss:3:
    points at (1 ± t)/2 of each side, with the roots of Legendre's polynomials written out.
    """
    n, A = len(corners), polygon_area(corners)
    total: Columns = [[flint.arb(0)] * len(D.nodes) for _ in range(2)]

    def add(x: Place, along: Place, weight: Any) -> None:
        normal = (along[1] * weight / A, -along[0] * weight / A)
        for I, value in enumerate(D.shape(x)):
            for i in range(2):
                total[i][I] = total[i][I] + value * normal[i]

    half = flint.fmpq(1, 2)
    for k, p in enumerate(corners):
        q = corners[(k + 1) % n]
        if rule == "trapezoid":
            chord = [b - a for a, b in zip(corners[k - 1], q, strict=True)]
            add(p, chord, half)
            continue
        side = [b - a for a, b in zip(p, q, strict=True)]
        for t, weight in _legendre(rule):
            add([a + s * (1 + t) / 2 for a, s in zip(p, side, strict=True)], side, weight)
    return total


def _legendre(rule: str) -> list[tuple[Any, Any]]:
    if rule == "midpoint":
        return [(flint.arb(0), flint.arb(1))]
    if rule == "gauss:2":
        root = 1 / flint.arb(3).sqrt()
        return [(-root, flint.fmpq(1, 2)), (root, flint.fmpq(1, 2))]
    root = (flint.arb(3) / 5).sqrt()
    return [(-root, flint.fmpq(5, 18)), (flint.arb(0), flint.fmpq(4, 9)), (root, flint.fmpq(5, 18))]


def in_box(D: Defined, low: Place, high: Place, rule: str) -> Columns:
    """b_iI of a box in 3-D: differences of the means over opposite faces, of their corners or at their middles."""
    total: Columns = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        difference = [flint.arb(0)] * len(D.nodes)
        for end, sign in ((low, -1), (high, 1)):
            if rule == "midpoint":
                places = [((low[j] + high[j]) / 2, (low[k] + high[k]) / 2)]
            else:
                places = [(a, b) for a in (low[j], high[j]) for b in (low[k], high[k])]
            for a, b in places:
                x: Place = [None] * 3
                x[i], x[j], x[k] = end[i], a, b
                difference = [d + sign * value / len(places) for d, value in zip(difference, D.shape(x), strict=True)]
        total.append([d / (high[i] - low[i]) for d in difference])
    return total


def in_interval(D: Defined, left: Any, right: Any) -> Columns:
    """(Psi_I(right) - Psi_I(left)) / length."""
    there, here = D.shape([right]), D.shape([left])
    return [[(p - q) / (right - left) for p, q in zip(there, here, strict=True)]]
