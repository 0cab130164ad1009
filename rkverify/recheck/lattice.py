"""The uniform lattice once more: shape functions with a linear basis, their changes, and forces, as polynomials in z = h/a.

Spacing 1. Psi_J = A_J / D with A_J = (m_2 - m_1 y_J) phi_J, D = m_0 m_2 - m_1^2, m_k = sum_J y_J^k phi_J, y_J = x - x_J.
A jet holds a quantity, its changes along two directions, and the mixed change.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import ceil

from rkverify.recheck.kernels import along
from rkverify.recheck.polynomials import Polynomial, plus, times

F = Fraction
Jet = tuple[Polynomial, Polynomial, Polynomial, Polynomial]
Move = Callable[[int], tuple[int, int, int]]
"""n -> changes of y_n = x - x_n along the first and the second direction, and the mixed one."""


def jet_plus(p: Jet, q: Jet, factor: int = 1) -> Jet:
    """p + factor q."""
    a, b, c, d = (plus(u, v, factor) for u, v in zip(p, q, strict=True))
    return a, b, c, d


def jet_times(p: Jet, q: Jet) -> Jet:
    """p q."""
    both = plus(plus(times(p[0], q[3]), times(p[3], q[0])), plus(times(p[1], q[2]), times(p[2], q[1])))
    return (
        times(p[0], q[0]),
        plus(times(p[0], q[1]), times(p[1], q[0])),
        plus(times(p[0], q[2]), times(p[2], q[0])),
        both,
    )


ZERO: Jet = ([], [], [], [])


@dataclass(frozen=True)
class Around:
    """Everything at a node of the lattice while its neighbours move: jets by shift n of the node at x_n = n, y_n = -n.

    y, phi, A: per node; m: the moments; D: the determinant. Polynomials in z on an interval of it.
    """

    y: dict[int, Jet]
    phi: dict[int, Jet]
    m: tuple[Jet, Jet, Jet]
    D: Jet

    def shape(self, n: int) -> Jet:
        """A_n."""
        return jet_times(jet_plus(self.m[2], jet_times(self.m[1], self.y[n]), -1), self.phi[n])

    def diffuse(self, n: int) -> Jet:
        """(m_1 - m_0 y) phi, the diffuse derivative times D."""
        return jet_times(jet_plus(self.m[1], jet_times(self.m[0], self.y[n]), -1), self.phi[n])


def around(kernel: str, z: tuple[Fraction, Fraction], move: Move) -> Around:
    """The jets for an interval of z that holds no joint of any neighbour."""
    reach = ceil(1 / z[0]) - 1
    y: dict[int, Jet] = {}
    phi: dict[int, Jet] = {}
    total = [ZERO, ZERO, ZERO]
    for n in range(-reach, reach + 1):
        first, second, mixed = ([F(w)] if w else [] for w in move(n))
        y[n] = ([F(-n)] if n else [], first, second, mixed)
        side = (n < 0) - (n > 0)
        value = along(kernel, F(abs(n)), z)
        slope = [F(0), *(side * a for a in along(kernel, F(abs(n)), z, 1))] if n else []
        curved = [F(0), F(0), *along(kernel, F(abs(n)), z, 2)]
        phi[n] = (
            value,
            times(slope, first),
            times(slope, second),
            plus(times(slope, mixed), times(curved, times(first, second))),
        )
        part = phi[n]
        for k in range(3):
            total[k] = jet_plus(total[k], part)
            part = jet_times(part, y[n])
    m = (total[0], total[1], total[2])
    return Around(y, phi, m, jet_plus(jet_times(m[0], m[2]), jet_times(m[1], m[1]), -1))


def first_change(A: Jet, D: Jet, direction: int = 1) -> Polynomial:
    """The change of A/D along one direction, times D^2."""
    return plus(times(A[direction], D[0]), times(A[0], D[direction]), -1)


def mixed_change(A: Jet, D: Jet) -> Polynomial:
    """The mixed change of A/D, times D^3."""
    straight = times(A[3], times(D[0], D[0]))
    crossed = plus(plus(times(A[1], D[2]), times(A[2], D[1])), times(A[0], D[3]))
    double = times(A[0], times(D[1], D[2]))
    return plus(plus(straight, times(crossed, D[0]), -1), double, 2)
