"""Identities of polynomials in free symbols, expanded by sympy."""

from fractions import Fraction
from itertools import combinations
from typing import Any

import sympy

from rkverify.arithmetic.symbolic import Symbolic
from rkverify.certify.theorems.isolation import NotProved
from rkverify.certify.theorems.logs import Theorem, text
from rkverify.paper.printed_lagrangian import omega_squared


def terms(expression: sympy.Expr) -> list[list[Any]]:
    """The expanded expression as a list of [coefficient, {symbol: exponent}], in a fixed order."""
    found = []
    for product, c in sympy.expand(expression).as_coefficients_dict().items():
        exponents = {str(base): int(e) for base, e in product.as_powers_dict().items() if base != 1}
        found.append([text(Fraction(int(c.p), int(c.q))), dict(sorted(exponents.items()))])
    return sorted((t for t in found if t[0]), key=lambda t: list(t[1].items()))


def _symbols(letter: str, count: int) -> list[sympy.Symbol]:
    return [sympy.Symbol(f"{letter}{k}") for k in range(count)]


def prove_identity(
    name: str, words: str, tried: str, claim: dict[str, Any], left: sympy.Expr, right: sympy.Expr, equals: str
) -> Theorem:
    """The theorem that both sides are one polynomial; raises NotProved where they are not."""
    rest = sympy.expand(left - right)
    if rest != 0:
        raise NotProved(f"{name}: both sides differ by {str(rest)[:80]}")
    listed = terms(left)
    full = {"kind": "identity", **claim, "equals": equals}
    return Theorem(name, words, tried, full, {"sum": listed}, "identity of polynomials", max(len(listed), 1), True)


def reproduction(size: int) -> Theorem:
    """(adj M) M = (det M) I for free entries: the reproducing conditions (3) for any node positions where det M is not 0."""
    M = sympy.Matrix(size, size, lambda i, j: sympy.Symbol(f"m{i}{j}"))
    rest = (M.adjugate() * M - M.det() * sympy.eye(size)).expand()
    if rest != sympy.zeros(size):
        raise NotProved("(adj M) M is not (det M) I")
    det = M.det()
    return prove_identity(
        f"reproduction-{size}",
        f"sum_I Psi_I(x) H(x - x_I) = H(0) with {size} basis functions, wherever det M(x) is not 0: b = M^-1 H(0) makes it (M b)^T",
        "any nodes, supports, kernel and dimension",
        {"identity": "adjugate", "size": size},
        det,
        det,
        "the sum listed",
    )


def singular(size: int, nodes: int) -> Theorem:
    """det M = sum_S (prod_S phi) (Vandermonde)^2 in one dimension: 0 exactly where fewer nodes than functions have phi > 0."""
    y, w = _symbols("y", nodes), _symbols("w", nodes)
    M = sympy.Matrix(size, size, lambda i, j: sum(w[J] * y[J] ** (i + j) for J in range(nodes)))
    squares: sympy.Expr = sympy.Integer(0)
    for S in combinations(range(nodes), size):
        weight = sympy.prod([w[J] for J in S])
        squares += weight * sympy.prod([(y[K] - y[J]) ** 2 for J, K in combinations(S, 2)])
    few = nodes < size
    return prove_identity(
        f"moment-matrix-{size}-functions-{nodes}-nodes",
        f"det M is {'0' if few else 'a sum of products of kernels times squares'}: {nodes} nodes under the kernels, {size} basis functions",
        "any distinct nodes in one dimension, any positive weights",
        {"identity": "cauchy-binet", "size": size, "nodes": nodes},
        M.det(method="berkowitz"),
        squares,
        "0" if few else "the sum listed",
    )


def integration_constraint(cells: int) -> Theorem:
    """sum_K B_I(x_K) a_K telescopes: 0 for a node whose support ends inside, so that a uniform stress has no resultant."""
    e = _symbols("e", cells + 1)
    left = sum((e[K + 1] - e[K] for K in range(cells)), sympy.Integer(0))
    return prove_identity(
        f"scni-telescopes-{cells}",
        f"sum_K B_I(x_K) a_K = Psi_I(last edge) - Psi_I(first edge) over {cells} cells side by side (one more cell adds and takes away one edge, so it holds for every number of cells): "
        "a uniform stress has no resultant at a node inside, whatever the nodes and cells are, and no part of the tangent",
        "any nodes and cells in one dimension",
        {"identity": "telescoping", "cells": cells},
        left,
        e[cells] - e[0],
        "last - first",
    )


def _gradient(reach: int) -> dict[int, sympy.Expr]:
    def e(half: int) -> sympy.Expr:
        return sympy.Symbol(f"e{abs(half)}") if abs(half) < 2 * reach else sympy.Integer(0)

    return {n: e(2 * n - 1) - e(2 * n + 1) for n in range(-reach, reach + 1)}


def zero_at_pi(reach: int) -> Theorem:
    """sum_n (-1)^n B_n = 0 for smoothed gradients of an even kernel: they are odd in n, and (-1)^n is even."""
    left = sum(((-1) ** (n % 2) * B for n, B in _gradient(reach).items()), sympy.Integer(0))
    return prove_identity(
        f"scni-zero-at-pi-{reach}",
        f"With SCNI and lumped mass omega(pi) = 0 on the uniform lattice: any even kernel that reaches {reach} nodes to a side",
        f"every even kernel, {reach} - 1/2 < R <= {reach} + 1/2",
        {"identity": "at-pi", "reach": reach},
        left,
        sympy.Integer(0),
        "0",
    )


def long_waves(reach: int) -> Theorem:
    """sum_n n B_n = sum of the shape functions at an edge = 1: omega^2/(kh)^2 -> 1 + sigma/C for the longest waves."""
    left = sum((n * B for n, B in _gradient(reach).items()), sympy.Integer(0))
    total = 2 * sum((sympy.Symbol(f"e{2 * k + 1}") for k in range(reach)), sympy.Integer(0))
    return prove_identity(
        f"scni-long-waves-{reach}",
        f"With SCNI at rest omega^2/(kh)^2 -> (C + sigma)/(rho h^2), as the continuum has: any even kernel that reaches {reach} nodes to a side",
        f"every even kernel, {reach} - 1/2 < R <= {reach} + 1/2",
        {"identity": "first-moment", "reach": reach},
        left,
        total,
        "sum at an edge",
    )


def squared_modulus(half_width: int) -> Theorem:
    """(63) = c^2 |sum_K b_K E^K|^2 with free gradients: its sign is that of c^2 = (C^SE F^2 + S)/rho_0."""
    b, E, kh = _symbols("b", 2 * half_width + 1), sympy.Symbol("E"), sympy.Symbol("kh")
    cosine = {sympy.cos(n * kh): (E**n + E**-n) / 2 for n in range(1, 2 * half_width + 1)}
    printed = omega_squared(b, sympy.Integer(1), kh, Symbolic())
    left = sympy.expand(printed).subs(cosine)
    one, other = (sum((b[k] * E ** (s * k) for k in range(len(b))), sympy.Integer(0)) for s in (1, -1))
    return prove_identity(
        f"lagrangian-square-{half_width}",
        f"(63) is (C^SE F^2 + S)/rho_0 times a squared modulus, for any gradients of half-width {half_width}: omega^2 >= 0 at every kh where C^SE F^2 + S >= 0",
        f"every kernel and R with half-width {half_width}, all kh",
        {"identity": "squared-modulus", "half_width": half_width},
        left,
        one * other,
        "the sum listed",
    )
