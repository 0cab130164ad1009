"""From the closed forms to relations between omega and kh: at rest, and with N about a base with velocity gradient Q.

At rest omega^2 is a polynomial in c = cos kh with the factor 1 - c. In motion the symbol from (x, v, stress) to their
rates has a cubic characteristic polynomial. Everything is an identity of rational functions; unit spacing and density.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.errors import BadInput
from rkverify.stability.jacobian_paper import Stencil

Coefficients = dict[int, Any]
COSINE = sympy.Symbol("c")
"""c = cos kh."""


def domain(K: RationalFunctions, name: str = "R") -> tuple[Fraction, Fraction]:
    """The open interval of a generator around its sample in which no decision that was taken changes its sign.

    Inside it every form of the field is the linearisation, not only at the sample. Raises BadInput where a decision
    involves another generator, or the interval ends at an irrational number or nowhere.
    """
    x, sample = sympy.Symbol(name), sympy.Rational(K.sample[name].numerator, K.sample[name].denominator)
    low: sympy.Expr = -sympy.oo
    high: sympy.Expr = sympy.oo
    for element in K.decisions:
        for part in (element.numer.as_expr(), element.denom.as_expr()):
            if part.free_symbols - {x}:
                raise BadInput(f"the decision on {part} involves more than {name}: there is no interval to give")
            for root in sympy.real_roots(sympy.Poly(part, x)) if part.free_symbols else ():
                low, high = (root, high) if low < root < sample else (low, root if sample < root < high else high)
    if not (low.is_Rational and high.is_Rational):
        raise BadInput(f"the forms hold between {low} and {high}, which are not both rational numbers")
    return Fraction(int(low.p), int(low.q)), Fraction(int(high.p), int(high.q))


def following(stencil: Stencil, K: Arithmetic) -> Coefficients:
    """Coefficients of u_{I+n} in u_I'' at rest, where stresses, edges and measures follow the displacements."""
    total: Coefficients = dict(stencil["v", "x"])
    for kind in {row for row, _ in stencil} - {"x", "v", "mass"}:
        for n, force in stencil["v", kind].items():
            for m, follows in stencil[kind, "v"].items():
                total[n + m] = total.get(n + m, K.zero()) + force * follows
    return {n: c for n, c in sorted(total.items()) if not K.is_zero(c)}


def in_cosine(coefficients: Coefficients, K: Arithmetic) -> list[Any]:
    """sum_n c_n cos(n kh) of coefficients even in n, as coefficients of the powers of c = cos kh.

    Raises BadInput where they are not even.
    """
    if any(not K.is_zero(value - coefficients.get(-n, K.zero())) for n, value in coefficients.items()):
        raise BadInput("the coefficients are not even in the shift: their symbol is no polynomial in cos kh")
    powers = [K.zero()] * (max(coefficients, default=0) + 1)
    for n, value in coefficients.items():
        chebyshev = np.polynomial.chebyshev.cheb2poly([0] * abs(n) + [1])
        for k, weight in enumerate(chebyshev):
            powers[k] = powers[k] + value * int(weight)
    return powers


def over_one_minus_cosine(coefficients: Coefficients, K: Arithmetic) -> list[Any]:
    """omega^2 / (1 - c) for u_I'' = sum_n c_n u_{I+n}, as coefficients of the powers of c.

    Raises BadInput where a uniform displacement has a force, so that 1 - c does not divide.
    """
    quotient: list[Any] = []
    for p in in_cosine(coefficients, K):
        quotient.append(-p + quotient[-1] if quotient else -p)
    if not K.is_zero(quotient[-1]):
        raise BadInput("a uniform displacement has a force: omega^2 does not vanish at kh = 0")
    while len(quotient) > 1 and K.is_zero(quotient[-1]):
        quotient.pop()
    return quotient


@dataclass(frozen=True)
class AtRest:
    """omega^2 = (1 - c) q(c): q(1) is twice the long-wave limit of omega^2/(kh)^2, q(-1) half of omega^2 at kh = pi.

    Where q is affine, omega^2 >= 0 at every kh exactly when both are >= 0.
    """

    quotient: list[Any]
    K: Arithmetic

    @property
    def is_affine(self) -> bool:
        """Whether q has no higher power of c than the first."""
        return len(self.quotient) <= 2

    @property
    def long_wave(self) -> Any:
        """The limit of omega^2/(kh)^2 as kh -> 0; h = rho = C^sigma = 1."""
        return sum(self.quotient[1:], self.quotient[0]) / 2

    @property
    def at_pi(self) -> Any:
        """omega^2 at kh = pi."""
        return 2 * sum((value * (-1) ** k for k, value in enumerate(self.quotient)), self.K.zero())


def at_rest(stencil: Stencil, K: Arithmetic) -> AtRest:
    """The relation of the base at rest from its stencil."""
    return AtRest(over_one_minus_cosine(following(stencil, K), K), K)


def is_sine_and_geometric_factor(found: AtRest, s: Any) -> bool:
    """Whether omega^2 = (1 + s) sin^2 kh + s G (1 - c)^2 with G = omega^2(pi)/(4 s), identically."""
    K = found.K
    padded = [*found.quotient, K.zero(), K.zero()][:2]
    half = found.at_pi / 4
    return found.is_affine and K.is_zero(padded[0] - (1 + s) - half) and K.is_zero(padded[1] - (1 + s) + half)


def is_square_of_gradient(found: AtRest, stencil: Stencil, s: Any) -> bool:
    """Whether omega^2 = (1 + s) [2 B_1 sin kh + 2 B_2 sin 2kh]^2 with B_n the gradient in the stencil, identically."""
    K = found.K
    gradient = stencil["v", "stress"]
    one, two = (2 * gradient[n] if n in gradient else K.zero() for n in (1, 2))
    # sin kh (one + 2 two c) squared is (1 - c)(1 + c)(one + 2 two c)^2.
    square = [one * one, 4 * one * two, 4 * two * two]
    expected = [a + b for a, b in zip([*square, K.zero()], [K.zero(), *square], strict=True)]
    padded = [*found.quotient, *[K.zero()] * 4][:4]
    fits = all(K.is_zero(q - (1 + s) * e) for q, e in zip(padded, expected, strict=True))
    return fits and len(found.quotient) <= 4


@dataclass(frozen=True)
class InMotion:
    """The cubic of the symbol over lambda = i omega, with b, W the symbols of v' with respect to v and, less, the positions.

    factors: whether it is (lambda - Q)(lambda^2 - b lambda + W), so that omega^2 + i b omega - W = 0 stands against
    (77) and (83); W is omega^2 at rest less the symbol of N's displacement terms. even: whether the coefficients of the
    velocities are even in the shift, so that b is real. galilean: whether N's terms are those of v - Q x, and vanish
    for a uniform velocity.
    """

    factors: bool
    even: bool
    galilean: bool


def in_motion(stencil: Stencil, convective: Stencil, K: RationalFunctions) -> InMotion:
    """What the characteristic polynomial is like; stencil with every term, convective the part of N in it."""
    Q = K.generator("Q")
    velocity, position = convective["v", "v"], convective["v", "x"]
    from_stress = {n: -Q * c for n, c in stencil["stress", "v"].items()}
    # With stress' = p x + q v + Q stress and p = -Q q the cubic factors whatever a, b, f and q are.
    L, a, b, f, q, g = sympy.symbols("lambda a b f q Q")
    matrix = sympy.Matrix([[L, -1, 0], [-a, L - b, -f], [g * q, -q, L - g]])
    identity = sympy.expand(matrix.det() - (L - g) * (L**2 - b * L - (a + f * q))) == 0
    factors = identity and from_stress == stencil["stress", "x"] and stencil["stress", "stress"] == {0: Q}
    even = all(velocity.get(-n, K.zero()) == c for n, c in velocity.items())
    galilean = {n: -Q * c for n, c in velocity.items()} == position and K.is_zero(sum(velocity.values(), K.zero()))
    return InMotion(bool(factors), even, galilean)


def text_in_cosine(coefficients: Coefficients, K: RationalFunctions) -> sympy.Expr:
    """sum_n c_n cos(n kh), factored, in c = cos kh and the generators."""
    powers = in_cosine(coefficients, K)
    return sympy.factor(sum((p.as_expr() * COSINE**k for k, p in enumerate(powers)), sympy.Integer(0)))
