"""The identities once more: what a theorem's name stands for, expanded here from its definition."""

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from itertools import combinations
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck.reading import field, require
from rkverify.recheck.symbols import Sum, as_sum, symbol

F = Fraction


def _total(parts: Any) -> Sum:
    return reduce(lambda p, q: p + q, parts, as_sum(0))


def _det(rows: list[list[Sum]]) -> Sum:
    if not rows:
        return as_sum(1)
    minors = ([row[:j] + row[j + 1 :] for row in rows[1:]] for j in range(len(rows)))
    return _total(rows[0][j] * _det(minor) * (-1) ** j for j, minor in enumerate(minors))


def _whole(claim: Any, name: str, most: int) -> int:
    n = field(claim, name)
    if type(n) is not int or not 1 <= n <= most:
        raise BadInput(f"{name} is {str(n)[:20]}: a whole number from 1 to {most} is checked")
    return n


def adjugate(claim: Any) -> Sum:
    """det M of a matrix of free entries, with every entry of (adj M) M - (det M) I expanded and found to be 0."""
    p = _whole(claim, "size", 4)
    M = [[symbol(f"m{i}{j}") for j in range(p)] for i in range(p)]
    det = _det(M)

    def cofactor(i: int, k: int) -> Sum:
        rows = [row[:k] + row[k + 1 :] for n, row in enumerate(M) if n != i]
        return _det(rows) * (-1) ** (i + k)

    for i in range(p):
        for j in range(p):
            entry = _total(cofactor(k, i) * M[k][j] for k in range(p))
            require(not (entry - (det if i == j else 0)).terms, f"(adj M) M is not (det M) I at {i}, {j}")
    return det


def cauchy_binet(claim: Any) -> Sum:
    """det of the moment matrix of free nodes y_J with free weights w_J, found to be sum_S (prod w) (Vandermonde)^2."""
    p, N = _whole(claim, "size", 3), _whole(claim, "nodes", 5)
    y, w = ([symbol(f"{name}{J}") for J in range(N)] for name in "yw")
    M = [[_total(w[J] * y[J] ** (i + j) for J in range(N)) for j in range(p)] for i in range(p)]
    squares = as_sum(0)
    for S in combinations(range(N), p):
        part = as_sum(1)
        for J in S:
            part = part * w[J]
        for J, K in combinations(S, 2):
            part = part * (y[K] - y[J]) ** 2
        squares = squares + part
    det = _det(M)
    require(not (det - squares).terms, "the determinant is not the sum of squares")
    return det


def telescoping(claim: Any) -> Sum:
    """sum_K B_I(x_K) a_K over cells side by side, B_I a_K = Psi_I at the right end less at the left one."""
    n = _whole(claim, "cells", 30)
    e = [symbol(f"e{K}") for K in range(n + 1)]
    return _total(e[K + 1] - e[K] for K in range(n))


def at_pi(claim: Any) -> Sum:
    """sum_n (-1)^n B_n for an even shape function with values e at the cell edges half a spacing from the nodes."""
    B = _odd_gradient(claim)
    return _total(b * (-1) ** (n % 2) for n, b in B.items())


def first_moment(claim: Any) -> Sum:
    """sum_n n B_n for the same: the sum of all values at an edge, which is 1."""
    return _total(b * n for n, b in _odd_gradient(claim).items())


def _odd_gradient(claim: Any) -> dict[int, Sum]:
    m = _whole(claim, "reach", 12)

    def e(half: int) -> Sum:
        return symbol(f"e{abs(half)}") if abs(half) < 2 * m else as_sum(0)

    return {n: e(2 * n - 1) - e(2 * n + 1) for n in range(-m, m + 1)}


def squared_modulus(claim: Any) -> Sum:
    """sum_K b_K sum_L b_L cos((K - L) kh) in E = e^(i kh), found to be (sum_K b_K E^K)(sum_K b_K E^-K)."""
    m = _whole(claim, "half_width", 4)
    b = [symbol(f"b{k}") for k in range(2 * m + 1)]

    def cosine(n: int) -> Sum:
        return (symbol("E", n) + symbol("E", -n)) * F(1, 2) if n else as_sum(1)

    left = _total(b[k] * b[j] * cosine(k - j) for k in range(2 * m + 1) for j in range(2 * m + 1))
    one, other = (_total(b[k] * (symbol("E", s * k) if k else 1) for k in range(2 * m + 1)) for s in (1, -1))
    require(not (left - one * other).terms, "(63) is not a squared modulus")
    return left


IDENTITIES: dict[str, tuple[Callable[[Any], Sum], str]] = {
    "adjugate": (adjugate, "(adj M) M = (det M) I for every {size} x {size} matrix: wherever det M is not 0 the shape functions (4) reproduce their {size} basis functions, for any nodes, kernel and dimension"),
    "cauchy-binet": (cauchy_binet, "det M of {nodes} nodes and {size} basis functions in one dimension is the sum over all choices of {size} nodes of the product of their kernels times their squared Vandermonde determinant"),
    "telescoping": (telescoping, "sum_K B_I(x_K) a_K over {cells} cells of any sizes is Psi_I at the last edge less Psi_I at the first"),
    "at-pi": (at_pi, "sum_n (-1)^n B_n = 0 for every even shape function that reaches {reach} nodes: omega(pi) = 0 with SCNI and lumped mass"),
    "first-moment": (first_moment, "sum_n n B_n is the sum of the shape functions at an edge, 1, for a reach of {reach} nodes: the long waves of SCNI are the continuum's"),
    "squared-modulus": (squared_modulus, "(63) with free gradients of half-width {half_width} is c^2 times a squared modulus"),
}  # fmt: skip

U, W = symbol("u"), 2 - symbol("u")
"""1 - cos kh and 1 + cos kh."""

SHORT = {"w": W, "j": 1 - 4 * symbol("P")}
"""Symbols of logs that stand for others: w = 1 + cos kh and j = 1 - 4 Psi(h)."""


def _printed(a: Sum, P: Sum) -> Sum:
    """(1/4) B^2 of (78) with a = Q C(h) phi'(h)/R: a^2 sin^2 kh (Psi(0) + 2 Psi(h) cos kh)^2, Psi(0) = 1 - 2 Psi(h)."""
    return a**2 * U * W * (1 - 2 * P + 2 * P * (1 - U)) ** 2


def scni_printed() -> Sum:
    """D/4 of (79) = B^2/4 + 4 a^2 (1 - cos kh) + 2 t g^2 (1 - cos 2 kh), t = (C + sigma)/(rho h^2), g = C(h/2) phi(h/2)."""
    a, g, t = symbol("a"), symbol("g"), symbol("t")
    return _printed(a, symbol("P")) + 4 * a**2 * U + 4 * t * g**2 * U * W


def dni_printed() -> Sum:
    """D/4 of (85) = B^2/4 + (4 a^2 - 2 (sigma/rho) Psi,xx) (1 - cos kh) + 4 t Psi,x^2 sin^2 kh, t = (C + sigma)/rho."""
    a, t, x = symbol("a"), symbol("t"), symbol("x")
    return _printed(a, symbol("P")) + (4 * a**2 - 2 * symbol("n") * symbol("q")) * U + 4 * t * x**2 * U * W


def _scni_at_limit() -> Sum:
    """4 t g^2 = d - 3 a^2."""
    d, a = symbol("d"), symbol("a")
    return scni_printed().put("t", symbol("l")).put("g", as_sum(1)).put("l", (d - 3 * a**2) * F(1, 4))


def _dni_at_limit() -> Sum:
    """2 (sigma/rho) Psi,xx = 4 a^2 - d."""
    return dni_printed().put("n", as_sum(1)).put("q", (4 * symbol("a") ** 2 - symbol("d")) * F(1, 2))


def _dni_compressed() -> Sum:
    """sigma/rho = -(r + y), t = -r with y = C/rho, Psi,xx = 4 Psi,x^2 + k."""
    x, r, y = symbol("x"), symbol("r"), symbol("y")
    return dni_printed().put("n", (r + y) * -1).put("t", r * -1).put("q", 4 * x**2 + symbol("k"))


SQUARES: dict[str, tuple[Callable[[], Sum], tuple[str, ...], str]] = {
    "scni-printed": (scni_printed, ("t",), "D of (79) >= 0 at every kh, for all Q of either sign, where C + sigma >= 0"),
    "scni-printed-limit": (
        _scni_at_limit, ("d", "P", "j"),
        "D of (79) >= 0 at every kh where 0 <= Psi(h) <= 1/4 and (C + sigma)/(rho h^2) [C(h/2) phi(h/2)]^2 >= -(3/4) [Q C(h) phi'(h)/R]^2, and only there: the longest waves end it",
    ),
    "dni-printed-limit": (
        _dni_at_limit, ("d", "t"),
        "where C + sigma >= 0, D of (85) >= 0 at every kh where (sigma/rho) Psi,xx(h) <= 2 [Q C(h) phi'(h)/R]^2, and only there: kh = pi ends it",
    ),
    "dni-printed-compressed": (
        _dni_compressed, ("r", "y", "k"),
        "where C + sigma <= 0 and Psi,xx(h) >= 4 Psi,x(h)^2, D of (85) >= 0 at every kh, for all Q",
    ),
}  # fmt: skip
"""Name -> D/4 of the print, the symbols that are not negative (u and w = 2 - u are not either), and what follows."""

NECESSARY: dict[str, tuple[int, Sum]] = {
    "scni-printed-limit": (0, symbol("d")),
    "dni-printed-limit": (2, symbol("d")),
}
"""Name -> u at which D/(4 u) is a positive multiple of the symbol: where that is negative, D is negative nearby."""
