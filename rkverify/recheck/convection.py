"""The convective term N of (65) on the lattice for 1 < R < 2, and what it makes of a plane wave on the base v = Q x.

The symbol of the linear equations has lambda^2 - b lambda + W = 0 beside lambda = Q, with b = Q beta and
W = omega^2 at rest - Q^2 alpha. Both symbols are even in the shift: polynomials in c = cos kh. Q = 1 in what follows.
"""

from fractions import Fraction

from rkverify.errors import BadInput
from rkverify.recheck.forces import InCosine, in_cosine
from rkverify.recheck.lattice import around, first_change, jet_plus, jet_times, mixed_change
from rkverify.recheck.polynomials import Polynomial, plus, times

F = Fraction


def _rates(
    kernel: str, rate: str, z: tuple[Fraction, Fraction], u: dict[int, int], w: dict[int, int]
) -> tuple[dict[int, Polynomial], dict[int, Polynomial], dict[int, Polynomial], Polynomial]:
    """At the node 0 with v_n = n + e w(n), x_n = n + e u(n): rate of Psi_n, its change, change of Psi_n; all times D^3.

    rate: true, the material derivative, or psi-star, the correction function times the rate of the kernel (40).
    """
    local = around(kernel, z, lambda n: (-n, u.get(0, 0) - u.get(n, 0), w.get(0, 0) - w.get(n, 0)))
    D, value, change, shape = local.D, {}, {}, {}
    for n, y in local.y.items():
        A = local.shape(n)
        shape[n] = times(first_change(A, D, 2), D[0])
        if rate == "true":
            value[n], change[n] = times(first_change(A, D), D[0]), mixed_change(A, D)
        elif rate == "psi-star":
            C = jet_plus(local.m[2], jet_times(local.m[1], y), -1)
            p = local.phi[n]
            value[n] = times(times(C[0], p[1]), times(D[0], D[0]))
            both = plus(times(C[2], p[1]), times(C[0], p[3]))
            change[n] = times(plus(times(both, D[0]), times(times(C[0], p[1]), D[2]), -1), D[0])
        else:
            raise BadInput(f"the rate {str(rate)[:30]!r} is neither true nor psi-star")
    return value, change, shape, D[0]


def _acceleration(kernel: str, rate: str, z: tuple[Fraction, Fraction], m: int, of: str) -> Polynomial:
    """The change of v_0' = -sum_K Psi_0(x_K) sum_J rate_J(x_K) v_J with the position or velocity of node m; times D^4."""
    total: Polynomial = []
    for K in (-1, 0, 1):
        pattern = {m - K: 1}
        u, w = (pattern, {}) if of == "position" else ({}, pattern)
        value, change, shape, D = _rates(kernel, rate, z, u, w)
        inner: Polynomial = []  # change of sum_J rate_J v_J at K, where v_J = J there and K is 0
        base: Polynomial = []
        for n in value:
            inner = plus(inner, change[n], n + K)
            inner = plus(inner, value[n], w.get(n, 0))
            base = plus(base, value[n], n + K)
        still = around(kernel, z, lambda n: (0, 0, 0))
        Psi = still.shape(-K)[0]  # over D
        total = plus(total, times(Psi, inner), -1)
        # The base term is over D^3 and the change of Psi_0(x_K) too: one power of each to spare.
        spare = times(D, D)
        quotient = times(base, shape[-K])
        total = plus(total, _divided(quotient, spare), -1)
    return total


def _divided(p: Polynomial, by: Polynomial) -> Polynomial:
    """p / by, exact."""
    rest, quotient = list(p), [F(0)] * max(len(p) - len(by) + 1, 0)
    for k in range(len(quotient) - 1, -1, -1):
        quotient[k] = rest[k + len(by) - 1] / by[-1]
        for j, b in enumerate(by):
            rest[k + j] -= quotient[k] * b
    if any(rest):
        raise BadInput("a division of polynomials leaves a rest")
    while quotient and not quotient[-1]:
        quotient.pop()
    return quotient


def symbols(kernel: str, rate: str, z: tuple[Fraction, Fraction]) -> tuple[InCosine, InCosine, Polynomial]:
    """beta and alpha over the powers of c, both times the third, D^4; 1 < R < 2."""
    beta, alpha = (
        in_cosine({m: _acceleration(kernel, rate, z, m, of) for m in range(-3, 4)}) for of in ("velocity", "position")
    )
    D = around(kernel, z, lambda n: (0, 0, 0)).D[0]
    return beta, alpha, times(times(D, D), times(D, D))
