"""Functions of c = cos kh and R = a/h on one piece of R, as polynomials over a common denominator."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

import flint
import numpy as np

from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.closed_forms import convective_part
from rkverify.certify.closed_relations import in_cosine, over_one_minus_cosine
from rkverify.certify.theorems.isolation import rational
from rkverify.certify.theorems.support_functions import quotient
from rkverify.kernels import kernel
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.cells import lattice_cell
from rkverify.paper.gradients import smoothed_gradient
from rkverify.readings import Convection, Derivative
from rkverify.stability.limits import geometric_stencil, nodal_forces, unit

Surface = tuple[list[Any], Any]
"""Coefficients of the powers of c, and the denominator: fmpq polynomials in R with whole coefficients."""
Make = Callable[[Fraction, Fraction], Surface]


@dataclass(frozen=True)
class SurfaceSubject:
    """A function of c and R by the name that logs have for it, and how the project computes it on a piece of R."""

    data: dict[str, str]
    make: Make


def over_common_denominator(values: Sequence[Any]) -> Surface:
    """Elements of Q(R) over their least common denominator, whole numbers in lowest terms."""
    pairs = [quotient(value) for value in values]
    below = flint.fmpq_poly([1])
    for _, q in pairs:
        below = below * q / flint.fmpq_poly(below.gcd(q))
    above = [p * (below / q) for p, q in pairs]
    scale = flint.fmpz(1)
    for p in [*above, below]:
        scale = scale * p.denom() / scale.gcd(p.denom())
    factor = flint.fmpq(scale)
    whole = [int(c) for p in [*above, below] for c in (p * factor).numer().coeffs()]
    factor /= flint.fmpq(int(np.gcd.reduce(np.array(whole, dtype=object))))
    return [p * factor for p in above], below * factor


def scni_cuts(kernel_name: str, low: Fraction, high: Fraction) -> list[Fraction]:
    """Every R at which a cell's edge enters a support or crosses a joint of the kernel."""
    cuts = {Fraction(2 * n + 1, 2) / joint for joint in kernel(kernel_name).joints for n in range(int(high) + 1)}
    return sorted({low, high, *(R for R in cuts if low < R < high)})


def scni_gradient(kernel_name: str) -> SurfaceSubject:
    """sum_n 2 B_n sin(n kh) / sin kh with the smoothed gradients B_n of (52)."""

    def make(low: Fraction, high: Fraction) -> Surface:
        K = RationalFunctions({"R": (low + high) / 2})
        reach = int(high) + 2
        A = lattice(1, K.generator("R"), reach, K, kernel_name)
        b = smoothed_gradient(A, lattice_cell(K.zero(), K.number(1)))
        powers: dict[int, Any] = {}
        for n in range(1, reach + 1):
            chebyshev = np.polynomial.chebyshev.chebder(np.polynomial.chebyshev.Chebyshev.basis(n).coef)
            for i, weight in enumerate(np.polynomial.chebyshev.cheb2poly(chebyshev)):  # T_n' = n U_(n-1)
                value = b.get(middle(A) + n, K.zero()) * (2 * round(weight / n))
                powers[i] = powers.get(i, K.zero()) + value
        return over_common_denominator(_without_zeros([powers[i] for i in sorted(powers)], K))

    return SurfaceSubject({"function": "gradient of scni over sin kh", "kernel": kernel_name}, make)


def _without_zeros(values: list[Any], K: RationalFunctions) -> list[Any]:
    while K.is_zero(values[-1]):
        values = values[:-1]
    return values


@cache
def motion_symbols(convection: Convection) -> tuple[list[Any], list[Any], RationalFunctions]:
    """beta and alpha over the powers of c, with b = Q beta and W = omega^2 at rest - Q^2 alpha; cubic kernel, 1 < R < 2."""
    part, K = convective_part(convection, "low")
    Q = K.generator("Q")
    beta = in_cosine({n: c / Q for n, c in part["v", "v"].items()}, K)
    alpha = in_cosine({n: c / Q**2 for n, c in part["v", "x"].items()}, K)
    return beta, alpha, K


def room(function: str, convection: Convection, growth: Fraction, motion: str) -> SurfaceSubject:
    """k^2 -+ k beta - alpha (room for growth) or k -+ beta/2 (room for damping), for Q > 0 or Q < 0."""

    def make(low: Fraction, high: Fraction) -> Surface:
        beta, alpha, K = motion_symbols(convection)
        sign, k, zero = (-1 if motion == "Q > 0" else 1), K.number(growth), K.zero()
        size = max(len(beta), len(alpha))
        beta, alpha = ([*part, *[zero] * (size - len(part))] for part in (beta, alpha))
        if function == "room for growth":
            values = [sign * k * b - a for b, a in zip(beta, alpha, strict=True)]
            values[0] = values[0] + k**2
        else:
            values = [b * sign / 2 for b in beta]
            values[0] = values[0] + k
        return over_common_denominator(_without_zeros(values, K))

    data = {"function": function, "kernel": "cubic", "rate": convection, "growth": str(growth), "motion": motion}
    return SurfaceSubject(data, make)


def dni_parts(kernel_name: str, derivative: Derivative, R: Any, K: Any, reach: int) -> tuple[list[Any], list[Any]]:
    """S and G of omega^2 = (1 - c)[(1 + s) S + s G], coefficients of the powers of c, of one length."""
    found = nodal_forces(R, K, [unit(m) for m in range(-reach, reach + 1)], "dni", derivative, kernel_name)
    material: dict[int, Any] = {}
    for I, b in found.values.items():
        for m, d in found.values.items():
            material[m - I] = material.get(m - I, K.zero()) - b * d
    S, G = over_one_minus_cosine(material, K), over_one_minus_cosine(geometric_stencil(found, reach, K), K)
    size = max(len(S), len(G))
    return [*S, *[K.zero()] * (size - len(S))], [*G, *[K.zero()] * (size - len(G))]


def high_tension(kernel_name: str, derivative: Derivative) -> SurfaceSubject:
    """S + G, whose sign is that of omega^2 in high tension, where DNI is stable at every tension if it is not negative."""

    def make(low: Fraction, high: Fraction) -> Surface:
        K = RationalFunctions({"R": (low + high) / 2})
        S, G = dni_parts(kernel_name, derivative, K.generator("R"), K, int((low + high) / 2) + 1)
        return over_common_denominator(_without_zeros([a + b for a, b in zip(S, G, strict=True)], K))

    return SurfaceSubject({"function": "S + G", "kernel": kernel_name, "derivative": derivative}, make)


def polynomial_in_second(rows: Sequence[Sequence[Fraction]]) -> list[Any]:
    """Rows of rationals as polynomials in the second variable."""
    return [flint.fmpq_poly([rational(x) for x in row]) for row in rows]
