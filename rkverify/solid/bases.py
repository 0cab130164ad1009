"""Tables of the monomials H(y), (5), (10), (33), which compiled code of any dimension and order is specialised with."""

from dataclasses import dataclass
from functools import cache
from itertools import combinations_with_replacement

import numpy as np

from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Basis:
    """The monomials y^alpha with |alpha| <= n in d dimensions: m for the basis, and those up to 2n that its products are.

    parents, axes (s,): y^alpha is y^(alpha of the parent) times y_axis, the parent first (alpha = 0 stands at 0).
    products (m, m): where y^(alpha + beta) stands. lowered, powers (d, m): d(y^alpha)/dy_k is powers[k] times the
    monomial at lowered[k]. picks (1 + d + d(d+1)/2, m): H(0) and minus, then plus its first and second derivatives there.
    """

    dimension: int
    order: int
    size: int
    sums: int
    parents: Array
    axes: Array
    products: Array
    lowered: Array
    powers: Array
    picks: Array


def axis_pairs(dimension: int) -> list[tuple[int, int]]:
    """The pairs of axes (k, l) of second derivatives, k <= l, in the order of their columns.

    >>> axis_pairs(2)
    [(0, 0), (0, 1), (1, 1)]
    """
    return list(combinations_with_replacement(range(dimension), 2))


@cache
def basis_tables(dimension: int, order: int) -> Basis:
    """The tables for monomials up to the order, by degree.

    >>> basis_tables(2, 1).products.tolist()
    [[0, 1, 2], [1, 3, 4], [2, 4, 5]]
    """
    factors = [f for degree in range(2 * order + 1) for f in combinations_with_replacement(range(dimension), degree)]
    place = {f: i for i, f in enumerate(factors)}
    basis = [f for f in factors if len(f) <= order]
    m, axes = len(basis), range(dimension)
    lowered, powers = np.zeros((dimension, m), np.int64), np.zeros((dimension, m))
    for k in axes:
        for i, f in enumerate(basis):
            if k in f:
                rest = list(f)
                rest.remove(k)
                lowered[k, i], powers[k, i] = place[tuple(rest)], f.count(k)
    at_zero = np.eye(m)[0]
    first = [powers[k] * at_zero[lowered[k]] for k in axes]
    second = [powers[k] * first[l][lowered[k]] for k, l in axis_pairs(dimension)]
    return Basis(
        dimension,
        order,
        m,
        len(factors),
        np.array([place[f[:-1]] if f else 0 for f in factors]),
        np.array([f[-1] if f else 0 for f in factors]),
        np.array([[place[tuple(sorted(f + g))] for g in basis] for f in basis]),
        lowered,
        powers,
        np.array([at_zero, *(-row for row in first), *second]),
    )
