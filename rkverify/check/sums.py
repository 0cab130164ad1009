"""sum_I Psi_I(x) (x_I - x)^alpha = 0^alpha and its gradient: what shape functions of order n satisfy for every |alpha| <= n, (3).

The monomials are about the point and in units of its support, so that the sums are pure numbers of size 1 wherever the
nodes are. Those of the gradient in k are 1 for alpha = e_k and 0 otherwise: this is sum_I dPsi_I/dx_k x_I^alpha = d x^alpha/dx_k.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

from rkverify.check.entries import Entries
from rkverify.solid.kernel_values import Array

AXES = "xyz"


@dataclass(frozen=True)
class Sum:
    """The worst residual of one monomial in one column, over its bound, with the row where it is."""

    monomial: str
    degree: int
    column: str
    residual: float
    bound: float
    row: int

    @property
    def name(self) -> str:
        """The monomial, or its derivative, that is summed."""
        return self.monomial if self.column == "psi" else f"d({self.monomial})/d{self.column[-1]}"

    @property
    def holds(self) -> bool:
        """Whether rounding explains the residual, in every row."""
        return self.residual <= self.bound


def monomials(dimension: int, order: int) -> list[tuple[int, ...]]:
    """The exponents alpha with |alpha| <= order, by degree.

    >>> monomials(2, 2)
    [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
    """
    everything = product(range(order + 1), repeat=dimension)
    return sorted((a for a in everything if sum(a) <= order), key=lambda a: (sum(a), tuple(-p for p in a)))


def name_of(alpha: tuple[int, ...]) -> str:
    """The monomial as it is written.

    >>> name_of((0, 0)), name_of((1, 1)), name_of((0, 2))
    ('1', 'xy', 'y^2')
    """
    return "".join(f"{axis}^{p}" if p > 1 else axis for axis, p in zip(AXES, alpha) if p) or "1"


def residuals(theirs: Entries, points: Array, nodes: Array, lengths: Array, rounding: Array, order: int) -> list[Sum]:
    """Every sum up to the order, of every column: psi of the values, any other of the derivative along an axis, in their order.

    points (P, d), nodes (N, d), lengths (P,): the support at each point; rounding (P,): relative error that double
    precision leaves in a sum.
    """
    d = points.shape[1]
    y = (nodes[theirs.nodes] - points[theirs.rows]) / lengths[theirs.rows, None]
    present = np.zeros(theirs.count, dtype=bool)
    present[theirs.rows] = True
    found = []
    for alpha in monomials(d, order):
        power = np.prod(y ** np.array(alpha), axis=1)
        for c, column in enumerate(theirs.columns):
            axis = column_axis(column)
            unit = np.ones(theirs.count) if axis is None else lengths
            wanted = float(sum(alpha) == 0) if axis is None else float(sum(alpha) == 1 and alpha[axis] == 1)
            terms = theirs.numbers[:, c] * power
            total = unit * np.bincount(theirs.rows, terms, theirs.count) - wanted
            size = unit * np.bincount(theirs.rows, abs(terms), theirs.count)
            digits = unit * theirs.resolution[c] * np.bincount(theirs.rows, abs(power), theirs.count)
            # the gradient's errors come with those of the values: 1/length times theirs
            bound = rounding * np.maximum(size, 1.0) + digits
            excess = np.where(present, abs(total) / bound, 0.0)
            row = int(excess.argmax())
            found.append(Sum(name_of(alpha), sum(alpha), column, float(abs(total[row])), float(bound[row]), row))
    return found


def column_axis(column: str) -> int | None:
    """The axis of a derivative's column, such as dpsi_dx or bx; None for psi."""
    return None if column == "psi" else AXES.index(column[-1])
