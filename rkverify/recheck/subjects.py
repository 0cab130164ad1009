"""What the theorems are about, built anew by name: rational functions of R = a/h, of c = cos kh, and of both.

Spacing, density and modulus are 1. Every function is a numerator and a denominator; those of R hold on one piece of R, on
which no node crosses a joint of the kernel.
"""

from fractions import Fraction
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck import convection, forces
from rkverify.recheck.kernels import along
from rkverify.recheck.lattice import around, first_change
from rkverify.recheck.polynomials import Polynomial, Surface, plus, reversed_to, times, value
from rkverify.recheck.reading import field, rational

F = Fraction
Ends = tuple[Fraction, Fraction]
Quotient = tuple[Polynomial, Polynomial]


def in_R(above: list[Polynomial], below: Polynomial) -> tuple[list[Polynomial], Polynomial]:
    """Numerators and denominator in z = 1/R as polynomials in R."""
    degree = max(map(len, [*above, below])) - 1
    return [reversed_to(p, degree) for p in above], reversed_to(below, degree)


def _in_z(piece: Ends) -> Ends:
    return 1 / piece[1], 1 / piece[0]


def _one_away(kernel: str, piece: Ends, reading: str) -> tuple[Polynomial, Polynomial, Polynomial, Polynomial]:
    """D^3 Psi(h), D^3 Psi,x(h), D^3 Psi,xx(h) in a reading of the derivative, and D^3."""
    z = _in_z(piece)
    local = around(kernel, z, lambda n: (1, 1, 0))
    D, J = local.D, -1  # the node at -1 is one spacing to the left of the point
    A, N = local.shape(J), local.diffuse(J)
    D2 = times(D[0], D[0])
    Psi, D3 = times(A[0], D2), times(D2, D[0])
    if reading == "full":
        # Along the lattice D has no first change: Psi,xx = A,xx/D - A D,xx/D^2.
        second = plus(times(times(A[3], D[0]), D[0]), times(times(A[0], D[3]), D[0]), -1)
        return Psi, times(first_change(A, D), D[0]), second, D3
    if reading == "diffuse":
        return Psi, times(N[0], D2), times(first_change(N, D), D[0]), D3
    if reading in ("frozen", "frozen-b"):
        # At a node m_1 = 0, so that C(x; y) = m_2/D whatever y is, and its polynomial in y is constant.
        C = times(local.m[2][0], D2)
        return Psi, times(C, local.phi[J][1]), times(C, local.phi[J][3]), D3
    raise BadInput(f"there is no reading {str(reading)[:30]!r} of the derivative")


def function_of_R(subject: Any, piece: Ends) -> Quotient:
    """The function of R that a subject names, on a piece; raises BadInput for an unknown one."""
    name, kernel = field(subject, "function"), field(subject, "kernel")
    if name == "omega^2(pi)/sigma":
        above, below = forces.at_pi(kernel, field(subject, "derivative"), _in_z(piece))
    elif name in ("Psi(h)", "1 - 4 Psi(h)", "Psi,xx(h)", "Psi,xx(h) - 4 Psi,x(h)^2"):
        Psi, slope, second, below = _one_away(kernel, piece, subject.get("derivative", "full"))
        if name == "Psi(h)":
            above = Psi
        elif name == "1 - 4 Psi(h)":
            above = plus(below, Psi, -4)
        elif name == "Psi,xx(h)":
            above = second
        else:
            above, below = plus(times(second, below), times(slope, slope), -4), times(below, below)
    elif name == "beta at kh = pi/2":
        beta, _, below = convection.symbols(kernel, field(subject, "rate"), _in_z(piece))
        above = beta[0]
    else:
        raise BadInput(f"there is no function {str(name)[:40]!r} of R")
    (p,), q = in_R([above], below)
    return p, q


def printed_discriminant(subject: Any) -> Polynomial:
    """D of (79) or (85) over 16 (1 - c) as a polynomial in c, at rational R, C, sigma and Q; h = rho = 1."""
    R, C, sigma, Q = (rational(field(subject, name)) for name in ("R", "C", "sigma", "Q"))
    kernel, reading = field(subject, "kernel"), subject.get("derivative", "full")
    small = F(1, 10**6)
    piece = (R, R + small)
    z = 1 / R
    *above, below = _one_away(kernel, piece, reading)
    Psi, Psi_x, Psi_xx = (value(p, z) / value(below, z) for p in above)
    local = around(kernel, _in_z(piece), lambda n: (0, 0, 0))
    C_h = value(local.m[2][0], z) / value(local.D[0], z)
    a = Q * C_h * value(along(kernel, F(1), _in_z(piece), 1), z) / R
    q = [1 - 4 * Psi + 2 * Psi, 2 * Psi]  # Psi(0) + 2 Psi(h) c with Psi(0) = 1 - 2 Psi(h)
    wave = times([F(1), F(1)], [a * a / 4 * x for x in times(q, q)])
    if field(subject, "integration") == "scni":
        g = _half(kernel, z)
        wave = plus(wave, [(C + sigma) * g * g, (C + sigma) * g * g])
        return plus(wave, [a * a])
    wave = plus(wave, [(C + sigma) * Psi_x**2, (C + sigma) * Psi_x**2])
    return plus(wave, [a * a - sigma * Psi_xx / 2])


def _half(kernel: str, z: Fraction) -> Fraction:
    """C(h/2) phi(h/2) with the moment matrix at the edge, where m_1 = 0: phi(h/2) over the sum of phi."""
    total, n = F(0), 0
    beside = value(_edge_value(kernel, F(1, 2), z), z)
    while (n + F(1, 2)) * z < 1:
        total += 2 * value(_edge_value(kernel, n + F(1, 2), z), z)
        n += 1
    return beside / total


def _edge_value(kernel: str, distance: Fraction, z: Fraction) -> Polynomial:
    small = F(1, 10**6)
    return along(kernel, distance, (z, z + small) if distance * (z + small) <= 1 else (z - small, z))


def surface(subject: Any, piece: Ends) -> tuple[Surface, Polynomial]:
    """P(c, R) as surface[i][j] of c^i R^j, and the denominator in R, on a piece of R."""
    name, kernel = field(subject, "function"), field(subject, "kernel")
    z = _in_z(piece)
    if name == "gradient of scni over sin kh":
        above, below = _scni_gradient(kernel, z)
    elif name == "room for growth":
        beta, alpha, below = convection.symbols(kernel, field(subject, "rate"), z)
        k, sign = rational(field(subject, "growth")), {"Q > 0": -1, "Q < 0": 1}[field(subject, "motion")]
        above = [[] for _ in range(max(len(beta), len(alpha)))]
        for i, p in enumerate(beta):
            above[i] = plus(above[i], p, sign * k)
        for i, p in enumerate(alpha):
            above[i] = plus(above[i], p, -1)
        above[0] = plus(above[0], below, k * k)
    elif name == "room for damping":
        beta, _, below = convection.symbols(kernel, field(subject, "rate"), z)
        k, sign = rational(field(subject, "growth")), {"Q > 0": -1, "Q < 0": 1}[field(subject, "motion")]
        above = [[F(sign, 2) * x for x in p] for p in beta]
        above[0] = plus(above[0], below, k)
    elif name == "S + G":
        S, G, below = forces.at_rest(kernel, field(subject, "derivative"), z)
        size = max(len(S), len(G))
        above = [plus(S[i] if i < len(S) else [], G[i] if i < len(G) else []) for i in range(size)]
    else:
        raise BadInput(f"there is no function {str(name)[:40]!r} of c and R")
    return in_R(above, below)


def _scni_gradient(kernel: str, z: Ends) -> tuple[list[Polynomial], Polynomial]:
    """sum_n 2 B_n sin(n kh) / sin kh over the powers of c, with Psi_n(1/2) = phi/(sum of phi) at a cell's edge."""
    values: dict[int, Polynomial] = {}
    n = 0
    while (n + F(1, 2)) * z[0] < 1:
        values[n] = along(kernel, n + F(1, 2), z)
        n += 1
    total: Polynomial = []
    for p in values.values():
        total = plus(total, p, 2)
    U = [[1], [0, 2]]
    while len(U) <= n:
        shifted, before = [0, *[2 * a for a in U[-1]]], [*U[-2], 0, 0]
        U.append([a - b for a, b in zip(shifted, before, strict=True)])
    above: list[Polynomial] = [[] for _ in range(n)]
    for k in range(1, n + 1):
        B = plus(values[k - 1], values.get(k, []), -1)
        for i, weight in enumerate(U[k - 1]):
            above[i] = plus(above[i], B, 2 * weight)
    return above, total


def tension_at(subject: Any) -> Surface:
    """S + w G at a rational R as surface[i][j] of c^i w^j, times a positive number: w = s/(1 + s)."""
    R = rational(field(subject, "R"))
    S, G, below = forces.at_rest(field(subject, "kernel"), field(subject, "derivative"), _in_z((R, R + F(1, 10**6))))
    z = 1 / R
    D = value(below, z)
    size = max(len(S), len(G))
    return [
        [value(S[i], z) / D if i < len(S) else F(0), value(G[i], z) / D if i < len(G) else F(0)] for i in range(size)
    ]
