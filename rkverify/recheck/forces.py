"""Forces on the lattice with direct nodal integration, and what they make of plane waves: polynomials in c = cos kh.

u_I'' = sum_n (coefficient of n) u_(I+n); omega^2 = -sum_n (coefficient) cos(n kh), over 1 - c. Density, modulus, spacing 1.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from rkverify.errors import BadInput
from rkverify.recheck.lattice import around, first_change, mixed_change
from rkverify.recheck.polynomials import Polynomial, plus, times
from rkverify.recheck.reading import require

F = Fraction
InCosine = list[Polynomial]
"""Coefficients of the powers of c."""


@dataclass(frozen=True)
class Forces:
    """B_n a at the node 0, and its change under a pattern of displacements; values times D^2, changes times D^3."""

    values: dict[int, Polynomial]
    changes: dict[int, Polynomial]
    D: Polynomial


def forces(kernel: str, derivative: str, z: tuple[Fraction, Fraction], u: Mapping[int, int]) -> Forces:
    """The forces while node n is displaced by e u(n) (0 where u does not name it); the cell ends half-way."""
    stretch = F(u.get(1, 0) - u.get(-1, 0), 2)  # change of a
    if derivative not in ("full", "diffuse"):
        raise BadInput(f"the derivative {str(derivative)[:30]!r} is neither full nor diffuse")
    local = around(kernel, z, lambda n: (1, u.get(0, 0) - u.get(n, 0), 0))
    D = local.D
    values, changes = {}, {}
    for n in local.y:
        if derivative == "full":
            A = local.shape(n)
            values[n], change = first_change(A, D), mixed_change(A, D)
        else:
            N = local.diffuse(n)
            values[n], change = times(N[0], D[0]), times(first_change(N, D, 2), D[0])
        changes[n] = plus(change, times(values[n], D[0]), stretch)
    return Forces(values, changes, D[0])


def alternating(reach: int) -> dict[int, int]:
    """The wave kh = pi."""
    return {n: (-1) ** (n % 2) for n in range(-reach - 2, reach + 3)}


def at_pi(kernel: str, derivative: str, z: tuple[Fraction, Fraction]) -> tuple[Polynomial, Polynomial]:
    """omega^2(pi)/sigma as numerator and denominator in z."""
    found = forces(kernel, derivative, z, alternating(int(1 / z[0])))
    total: Polynomial = []
    for n, change in found.changes.items():
        total = plus(total, change, (-1) ** (n % 2))
    return total, times(found.D, times(found.D, found.D))


def in_cosine(coefficients: Mapping[int, Polynomial]) -> InCosine:
    """sum_n c_n cos(n kh) over the powers of c; raises Rejected where c_n and c_-n differ."""
    size = max(coefficients) + 1
    T = [[1], [0, 1]]
    while len(T) < size:
        shifted, before = [0, *[2 * a for a in T[-1]]], [*T[-2], 0, 0]
        T.append([a - b for a, b in zip(shifted, before, strict=True)])
    powers: InCosine = [[] for _ in range(size)]
    for n, value in coefficients.items():
        require(not plus(value, coefficients.get(-n, []), -1), "a stencil is not even in the shift")
        for k, weight in enumerate(T[abs(n)]):
            powers[k] = plus(powers[k], value, weight)
    return powers


def over_one_minus_cosine(coefficients: Mapping[int, Polynomial]) -> InCosine:
    """-sum_n c_n cos(n kh) divided by 1 - c; raises Rejected where it does not divide."""
    quotient: InCosine = []
    for p in in_cosine(coefficients):
        quotient.append(plus(quotient[-1] if quotient else [], p, -1))
    require(not quotient[-1], "a uniform displacement has a force")
    while len(quotient) > 1 and not quotient[-1]:
        quotient.pop()
    return quotient


def at_rest(kernel: str, derivative: str, z: tuple[Fraction, Fraction]) -> tuple[InCosine, InCosine, Polynomial]:
    """S and G with omega^2 = (1 - c) [(1 + s) S + s G], both times the third, D^4."""
    reach = int(1 / z[0])
    material: dict[int, Polynomial] = {}
    geometric: dict[int, Polynomial] = {}
    for m in range(-reach - 1, reach + 2):
        found = forces(kernel, derivative, z, {m: 1})
        for n, change in found.changes.items():
            geometric[m - n] = plus(geometric.get(m - n, []), times(change, found.D), -1)
        if m in found.values:
            for n, b in found.values.items():
                material[m - n] = plus(material.get(m - n, []), times(b, found.values[m]), -1)
    D2 = times(found.D, found.D)
    return over_one_minus_cosine(material), over_one_minus_cosine(geometric), times(D2, D2)
