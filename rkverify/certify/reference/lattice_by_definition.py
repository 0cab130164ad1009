"""The square lattice a second time: forces of a plane that is disturbed by a wave, on one node, as difference quotients.

Nodes are at all pairs of whole numbers. Cells are bounded by the circumcentres of the triangles into which one diagonal
cuts every square of nodes: of the four corners of a Voronoi cell two are double, and open as nodes move. A cell's
stress follows its smoothed or direct gradient at rest; measures and gradients at the disturbed places are made anew.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import product
from typing import Any

import flint

from rkverify.certify.reference.by_definition import Defined, Place, slope

Index = tuple[int, int]
RING = ((0, 0, 0), (0, 0, 1), (-1, 0, 0), (-1, -1, 1), (-1, -1, 0), (0, -1, 1))
"""The triangles around node (0, 0), counter-clockwise: lower left corner of the square, below (0) or above (1) its diagonal."""


@dataclass(frozen=True)
class DisturbedPlane:
    """Support R, kernel, integration, reading of the derivative and of the cell measure, stress (xx, yy, xy), moduli, stress law."""

    R: Any
    kernel: str
    integration: str
    derivative: str
    cell_measure: str
    stress: Sequence[Any]
    lame: Any
    shear: Any
    law: str

    def stiffness(self, k: Sequence[Any]) -> list[list[Any]]:
        """K_il: the force on node (0, 0) along i when every node J moves by cos(k . x_J) along l, per unit of the motion."""
        columns = [slope(partial(self.force, k, axis)) for axis in range(2)]
        return [[columns[axis][i] for axis in range(2)] for i in range(2)]

    def force(self, k: Sequence[Any], axis: int, t: Any) -> list[Any]:
        """sum_L sigma_ij(x_L) a_L b_j0^L with every node moved by t cos(k . x_J) along an axis."""
        reach = int(float(self.R)) + 1
        total = [flint.arb(0)] * 2
        around = range(-reach - 1, reach + 2)
        for L in product(around, around):
            gradient = self._moved_gradient(L, k, axis)
            sigma = self._stress([[t * g for g in row] for row in gradient])
            growth = t * (gradient[0][0] + gradient[1][1])
            B = self._integral(L, partial(self._place, k, axis, t), growth)
            total = [f + sigma[i][0] * B[0] + sigma[i][1] * B[1] for i, f in enumerate(total)]
        return total

    def _place(self, k: Sequence[Any], axis: int, t: Any, J: Index) -> Place:
        x: Place = [flint.arb(J[0]), flint.arb(J[1])]
        # Exact middles: the distance of a node from itself is 0, and no ball about it, of which no root is taken.
        x[axis] = (x[axis] + t * (k[0] * J[0] + k[1] * J[1]).cos()).mid()
        return x

    def _moved_gradient(self, L: Index, k: Sequence[Any], axis: int) -> list[list[Any]]:
        """du_i/dx_j of cell L for u = cos(k . x) along the axis, by the gradients of node (0, 0) at rest in all cells around."""
        row = [flint.arb(0)] * 2
        for r, b in self._at_rest.items():
            # Node J = L - r sees cell L as node (0, 0) sees cell r.
            wave = (k[0] * (L[0] - r[0]) + k[1] * (L[1] - r[1])).cos()
            row = [g + b[j] * wave for j, g in enumerate(row)]
        zero = [flint.arb(0)] * 2
        return [row, zero] if axis == 0 else [zero, row]

    @cached_property
    def _at_rest(self) -> dict[Index, list[Any]]:
        """The gradients of node (0, 0) in all cells around, at rest; their measure is 1."""
        reach, nothing = int(float(self.R)) + 2, flint.arb(0)
        still = partial(self._place, [nothing] * 2, 0, nothing)
        around = range(-reach, reach + 1)
        return {L: self._integral(L, still, nothing) for L in product(around, around)}

    def _stress(self, L: list[list[Any]]) -> list[list[Any]]:
        """sigma + what a small motion with the gradient L adds to it."""
        xx, yy, xy = self.stress
        s = [[xx, xy], [xy, yy]]
        trace = L[0][0] + L[1][1]
        spin = [[(L[i][j] - L[j][i]) / 2 for j in range(2)] for i in range(2)]
        turning = L if self.law == "truesdell" else spin
        found = []
        for i in range(2):
            line = []
            for j in range(2):
                elastic = self.shear * (L[i][j] + L[j][i]) + (self.lame * trace if i == j else flint.arb(0))
                turned = sum((turning[i][m] * s[m][j] + s[i][m] * turning[j][m] for m in range(2)), flint.arb(0))
                stretched = trace * s[i][j] if self.law == "truesdell" else flint.arb(0)
                line.append(s[i][j] + elastic + turned - stretched)
            found.append(line)
        return found

    def _integral(self, L: Index, place: Any, growth: Any) -> list[Any]:
        """a_L b_j of node (0, 0) in cell L at the given places."""
        x = place(L)
        if self.integration == "scni":
            return self._around(L, place)
        a = {"edges": lambda: _area(_ring(L, place)), "material": lambda: 1 + growth, "fixed": lambda: flint.arb(1)}[
            self.cell_measure
        ]()
        if self.integration == "dni":
            D, own = self._near(x, place)
            if own is None:
                return [flint.arb(0)] * 2
            return [a * D.gradient(x, j, self.derivative)[own] for j in range(2)]
        half = a.sqrt() / 2
        found = []
        for j in range(2):
            ends = [[c + (side * half if i == j else 0) for i, c in enumerate(x)] for side in (-1, 1)]
            low, high = (self._psi(end, place) for end in ends)
            found.append(2 * half * (high - low))
        return found

    def _around(self, L: Index, place: Any) -> list[Any]:
        """int over the cell's boundary of Psi n_j by the trapezoid: sum_k Psi(p_k) times half the chord's normal."""
        ring = _ring(L, place)
        found = [flint.arb(0)] * 2
        for before, p, after in zip([ring[-1], *ring[:-1]], ring, [*ring[1:], ring[0]], strict=True):
            Psi = self._psi(p, place)
            found[0] = found[0] + Psi * (after[1] - before[1]) / 2
            found[1] = found[1] - Psi * (after[0] - before[0]) / 2
        return found

    def _psi(self, x: Place, place: Any) -> Any:
        D, own = self._near(x, place)
        return flint.arb(0) if own is None else D.shape(x)[own]

    def _near(self, x: Place, place: Any) -> tuple[Defined, int | None]:
        """The nodes whose supports may cover x, and which of them is node (0, 0)."""
        centre, reach = [round(float(c)) for c in x], int(float(self.R)) + 1
        indices = [(centre[0] + m, centre[1] + n) for m, n in product(range(-reach, reach + 1), repeat=2)]
        near = [J for J in indices if sum((float(c) - j) ** 2 for c, j in zip(x, J, strict=True)) < float(self.R) ** 2]
        D = Defined([place(J) for J in near], [self.R] * len(near), self.kernel, 1, "radial")
        return D, near.index((0, 0)) if (0, 0) in near else None


def _ring(L: Index, place: Any) -> list[Place]:
    """The corners of cell L, counter-clockwise: the circumcentres of the six triangles around its node."""
    found = []
    for m, n, above in RING:
        i, j = L[0] + m, L[1] + n
        third = (i, j + 1) if above else (i + 1, j)
        found.append(_circumcentre(place((i, j)), place((i + 1, j + 1)), place(third)))
    return found


def _circumcentre(p: Place, q: Place, r: Place) -> Place:
    """The place at the same distance from three: two linear equations by Cramer's rule."""
    a, b = [q[i] - p[i] for i in range(2)], [r[i] - p[i] for i in range(2)]
    u, w = (a[0] * a[0] + a[1] * a[1]) / 2, (b[0] * b[0] + b[1] * b[1]) / 2
    D = a[0] * b[1] - a[1] * b[0]
    return [p[0] + (u * b[1] - w * a[1]) / D, p[1] + (a[0] * w - b[0] * u) / D]


def _area(ring: list[Place]) -> Any:
    return sum((p[0] * q[1] - q[0] * p[1] for p, q in zip(ring, [*ring[1:], ring[0]], strict=True)), flint.arb(0)) / 2
