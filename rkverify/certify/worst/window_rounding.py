"""What rounding does to scaled offsets, to phi_a and to its derivatives at one point, as `solid/` computes them."""

from dataclasses import dataclass

import numpy as np

from rkverify.certify.worst.kernel_rounding import KernelRounding, kernel_rounding
from rkverify.certify.worst.running import Book, Rounded, rounded, stacked
from rkverify.solid.bases import axis_pairs, basis_tables
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array

REACH = 1 + 1e-14
"""A node may be a neighbour for one route and not for the other as long as rounding decides: one part in 10^14."""


@dataclass(frozen=True)
class Window:
    """At one point: the nodes (n,), the unit of length a, offsets over a (d,) of (n,), phi and its derivatives in them (1 + …).

    H (m,) of (n,): the monomials of the offsets. book: offsets, phi and derivatives are sources of errors, each by itself.
    """

    nodes: Array
    scale: float
    y: list[Rounded]
    phi: Rounded
    slopes: list[Rounded]
    seconds: list[Rounded]
    H: list[Rounded]
    book: Book


def window(cloud: Cloud, x: Array) -> Window:
    """The operations of `compiled_weights` and the monomials of `compiled_shape` for a point (d,)."""
    d, radial = cloud.dimension, cloud.window == "radial"
    apart = abs(x - cloud.positions)
    length = np.sqrt((apart**2).sum(axis=1)) if radial else apart.max(axis=1)
    nodes = np.flatnonzero(length < cloud.supports * REACH)
    a = cloud.supports[nodes]
    scale = float(a.max())
    offsets = [rounded(x[k]) - rounded(cloud.positions[nodes, k]) for k in range(d)]
    per_a = rounded(1.0) / rounded(scale)
    y = [offset * per_a for offset in offsets]
    share = rounded(scale) / rounded(a)
    same = a == scale
    ratio = Rounded(share.value**2, np.where(same, 0.0, (share * share).reach))
    if radial:
        square = offsets[0] * offsets[0]
        for offset in offsets[1:]:
            square = square + offset * offset
        parts = _radial(kernel_rounding(cloud.kernel, square.sqrt() / rounded(a)), ratio, y)
    else:
        parts = _tensor([kernel_rounding(cloud.kernel, abs(o) / rounded(a)) for o in offsets], ratio, y)
    book = Book()
    y = [book.own(part) for part in y]
    phi, slopes, seconds = parts
    return Window(
        nodes,
        scale,
        y,
        book.own(phi),
        [book.own(p) for p in slopes],
        [book.own(p) for p in seconds],
        monomials(cloud, y),
        book,
    )


def monomials(cloud: Cloud, y: list[Rounded]) -> list[Rounded]:
    """H(y), each monomial from the one before it."""
    table = basis_tables(cloud.dimension, cloud.order)
    H = [rounded(np.ones_like(y[0].value))]
    for i in range(1, table.size):
        H.append(H[table.parents[i]] * y[table.axes[i]])
    return H


def _radial(k: KernelRounding, ratio: Rounded, y: list[Rounded]) -> tuple[Rounded, list[Rounded], list[Rounded]]:
    slopes = [k.g * ratio * y_k for y_k in y]
    seconds = []
    for i, j in axis_pairs(len(y)):
        second = k.s * ratio * y[i] * y[j]
        seconds.append(ratio * (second + k.g if i == j else second))
    return k.f, slopes, seconds


def _tensor(ks: list[KernelRounding], ratio: Rounded, y: list[Rounded]) -> tuple[Rounded, list[Rounded], list[Rounded]]:
    axes = range(len(y))

    def times_others(part: Rounded, *without: int) -> Rounded:
        for other in axes:
            if other not in without:
                part = part * ks[other].f
        return part

    slopes = [times_others(ks[i].g * ratio * y[i], i) for i in axes]
    seconds = []
    for i, j in axis_pairs(len(y)):
        if i == j:
            own = ratio * (ks[i].g + ks[i].s * ratio * y[i] * y[i])
        else:
            own = ks[i].g * ratio * y[i] * ks[j].g * ratio * y[j]
        seconds.append(times_others(own, i, j))
    return times_others(ks[0].f, 0), slopes, seconds


def moment_rounding(cloud: Cloud, near: Window) -> Rounded:
    """The moment matrix (m, m) with lengths in units of a: sums of phi times monomials, node after node."""
    table = basis_tables(cloud.dimension, cloud.order)
    terms = [near.phi]
    for c in range(1, table.sums):
        terms.append(terms[table.parents[c]] * near.y[table.axes[c]])
    return stacked(terms).total()[table.products]
