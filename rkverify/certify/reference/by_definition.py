"""A second route to every reference value: definitions only, in absolute coordinates, by difference quotients.

It shares no line with `kernels`, `paper/` or `solid/`. Kernels come from the recursion of B-splines or their printed
polynomials; Psi_I(x) = w_I p(x)^T A^-1 p(x_I) with A = sum_I w_I p(x_I) p(x_I)^T and w_I = phi_a(x - x_I) solves (2), (3)
for monomials p of the coordinates themselves; every derivative is a quotient of differences over 2^-170, some 50 digits.
Numbers are enclosures of some 190 digits (python-flint), or rationals where a function is rational.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import flint

from rkverify.arithmetic.ball import Ball
from rkverify.errors import UnknownName

HOME = Ball(190)
STEP = flint.fmpq(1, 2**170)
ORDERS = {"tent": 2, "cubic": 4, "quartic": 5, "quintic": 6}
"""Orders n of the B-splines M_n; (12) is M_4 on |z| < 1."""
Place = list[Any]


def b_spline(n: int, q: Any, at: flint.fmpq) -> Any:
    """M_n(q) by M_n = ((n/2 + q) M_(n-1)(q + 1/2) + (n/2 - q) M_(n-1)(q - 1/2)) / (n - 1), M_1 = 1 on [-1/2, 1/2[.

    at: an exact rational in q that says on which side of a knot it is.
    """
    half = flint.fmpq(1, 2)
    if n == 1:
        return flint.fmpz(int(-half <= at < half))
    if abs(at) > flint.fmpq(n, 2):
        return flint.fmpz(0)
    left, right = b_spline(n - 1, q + half, at + half), b_spline(n - 1, q - half, at - half)
    return ((q + flint.fmpq(n, 2)) * left + (flint.fmpq(n, 2) - q) * right) / (n - 1)


def middle(x: Any) -> flint.fmpq:
    """The exact middle of an enclosure, or the rational itself."""
    if isinstance(x, flint.fmpq):
        return x
    man, exponent = x.mid().man_exp()
    return flint.fmpq(man) * flint.fmpq(2) ** int(exponent)


def power(x: Any, count: int) -> Any:
    """x^count by products: python-flint's own power of an enclosure that contains 0 has no bounds."""
    value: Any = x
    for _ in range(count - 1):
        value = value * x
    return value


def vanishes(x: Any) -> bool:
    """Whether a number is exactly zero; an enclosure that only contains 0 is not."""
    return bool(x == 0)


def phi(kernel: str, z: Any) -> Any:
    """The kernel at z, even in z: a B-spline of q = n z/2, or Wendland's polynomials as he prints them."""
    if kernel in ORDERS:
        q = z * flint.fmpq(ORDERS[kernel], 2)
        return b_spline(ORDERS[kernel], q, middle(q))
    z = abs(z)
    if middle(z) > 1:
        return flint.fmpz(0)
    if kernel == "wendland-c2":
        return power(1 - z, 4) * (4 * z + 1)
    if kernel == "wendland-c4":
        return power(1 - z, 6) * (35 * z * z + 18 * z + 3) / 3
    raise UnknownName("kernel", kernel, [*ORDERS, "wendland-c2", "wendland-c4"])


@dataclass(frozen=True)
class Defined:
    """Nodes (N, d), supports (N,), kernel, order of the basis and window; enclosures."""

    nodes: list[Place]
    supports: list[Any]
    kernel: str
    order: int
    window: str

    def moved(self, velocities: Sequence[Place], t: Any) -> "Defined":
        """The same with the nodes at x_I + v_I t."""
        return replace(self, nodes=[shifted(x, v, t) for x, v in zip(self.nodes, velocities, strict=True)])

    def monomials(self, x: Place) -> list[Any]:
        """p(x): all products of powers of the coordinates up to the order."""
        d = len(x)
        powers = [e for e in product(range(self.order + 1), repeat=d) if sum(e) <= self.order]
        found = []
        for e in powers:
            value: Any = flint.arb(1)
            for c, k in zip(x, e, strict=True):
                for _ in range(k):
                    value = value * c
            found.append(value)
        return found

    def weights(self, x: Place) -> list[Any]:
        """w_I = phi_a(x - x_I) for all nodes."""
        return [self.weight(x, I) for I in range(len(self.nodes))]

    def weight(self, x: Place, I: int) -> Any:
        """phi_a(x - x_I)."""
        y = [c - n for c, n in zip(x, self.nodes[I], strict=True)]
        if self.window == "tensor":
            value: Any = flint.arb(1)
            for c in y:
                value = value * phi(self.kernel, abs(c) / self.supports[I])
            return value
        length = abs(y[0]) if len(y) == 1 else sum((c * c for c in y), flint.arb(0)).sqrt()
        return phi(self.kernel, length / self.supports[I])

    def multipliers(self, at: Place, target: Place) -> list[Any]:
        """A^-1(at) p(target)."""
        w = self.weights(at)
        rows = [(value, self.monomials(x)) for value, x in zip(w, self.nodes, strict=True) if not vanishes(value)]
        size = len(self.monomials(at))
        A = [[sum((v * p[i] * p[j] for v, p in rows), flint.arb(0)) for j in range(size)] for i in range(size)]
        solved = flint.arb_mat(A).solve(flint.arb_mat([[c] for c in self.monomials(target)]))
        return [solved[i, 0] for i in range(size)]

    def shape(self, x: Place) -> list[Any]:
        """Psi_I(x) for all nodes."""
        return self.with_multipliers(self.multipliers(x, x), x)

    def with_multipliers(self, lam: list[Any], x: Place, moved: Place | None = None) -> list[Any]:
        """w_I(x) times lam . p(x_I - moved): the polynomial times the kernel, the nodes seen from elsewhere by `moved`."""
        found = []
        for I, node in enumerate(self.nodes):
            w = self.weight(x, I)
            place = node if moved is None else [c - m for c, m in zip(node, moved, strict=True)]
            found.append(w * _dot(lam, self.monomials(place)) if not vanishes(w) else flint.arb(0))
        return found

    def along(self, x: Place, reading: str, steps: Place) -> list[Any]:
        """Psi_I where x has moved by `steps` and only what the reading of the derivative lets follow has followed."""
        there = [c + s for c, s in zip(x, steps, strict=True)]
        if reading == "full":
            return self.shape(there)
        if reading == "diffuse":
            return self.with_multipliers(self.multipliers(x, there), x)
        lam = self.multipliers(x, x)
        return self.with_multipliers(lam, there, steps if reading == "frozen-b" else None)

    def gradient(self, x: Place, axis: int, reading: str = "full") -> list[Any]:
        """dPsi_I/dx_axis."""
        return slope(lambda t: self.along(x, reading, _unit(len(x), {axis: t})))

    def second(self, x: Place, axes: tuple[int, int], reading: str = "full") -> list[Any]:
        """d2Psi_I/dx_j dx_k."""
        j, k = axes
        if j == k:
            return curvature(lambda t: self.along(x, reading, _unit(len(x), {j: t})))
        return slope(lambda s: slope(lambda t: self.along(x, reading, _unit(len(x), {j: s, k: t}))))

    def rate(self, x: Place, v: Place, velocities: Sequence[Place], true: bool) -> list[Any]:
        """The rate of Psi_I at a material point, of all of it, or of the kernel alone with C held (40)."""
        if true:
            return slope(lambda t: self.moved(velocities, t).shape(shifted(x, v, t)))
        held = [_dot(self.multipliers(x, x), self.monomials(node)) for node in self.nodes]
        changes = slope(lambda t: self.moved(velocities, t).weights(shifted(x, v, t)))
        return [C * change for C, change in zip(held, changes, strict=True)]


def slope(f: Callable[[Any], list[Any]]) -> list[Any]:
    """(f(e) - f(-e)) / 2e"""
    return [(p - q) / (2 * STEP) for p, q in zip(f(STEP), f(-STEP), strict=True)]


def curvature(f: Callable[[Any], list[Any]]) -> list[Any]:
    """(f(e) - 2 f(0) + f(-e)) / e^2"""
    zero = STEP * 0
    return [(p - 2 * m + q) / STEP**2 for p, m, q in zip(f(STEP), f(zero), f(-STEP), strict=True)]


def shifted(x: Place, v: Place, t: Any) -> Place:
    """x + v t"""
    return [c + w * t for c, w in zip(x, v, strict=True)]


def number(text: Any) -> Any:
    """The enclosure of an exact rational."""
    return flint.arb(flint.fmpq(text.numerator, text.denominator))


def _dot(u: list[Any], w: list[Any]) -> Any:
    return sum((p * q for p, q in zip(u, w, strict=True)), flint.arb(0))


def _unit(d: int, steps: dict[int, Any]) -> Place:
    return [steps.get(j, STEP * 0) for j in range(d)]
