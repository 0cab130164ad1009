"""The printed discriminants (79) and (85) as sums of squares: where they are not negative, and exactly where they are."""

from collections.abc import Sequence

import sympy

from rkverify.arithmetic.symbolic import Symbolic
from rkverify.certify.theorems.identities import terms
from rkverify.certify.theorems.isolation import NotProved
from rkverify.certify.theorems.logs import Theorem
from rkverify.paper import printed_semi_lagrangian as semi
from rkverify.paper.notation import LatticeValues
from rkverify.paper.printed_semi_lagrangian import State

u, w, a, P, t, g, x, d, j, k, r, y = sympy.symbols("u w a P t g x d j k r y")
q = 1 - 2 * P * u
"""Psi(0) + 2 Psi(h) cos kh, with u = 1 - cos kh and Psi(0) + 2 Psi(h) = 1."""


def printed_discriminant(integration: str) -> sympy.Expr:
    """D/4 of (79) or (85) through `paper/`, in u = 1 - cos kh, a = Q C(h) phi'(h)/R, t = C + sigma over rho (h^2)."""
    K, kh = Symbolic(), sympy.Symbol("kh")
    names = {name: sympy.Symbol(name) for name in ("sigma", "rho", "Psi_xx")}
    R, Q, C_h, slope, modulus = sympy.symbols("R Q C_h slope C")
    values = LatticeValues(sympy.Integer(1), R, C_h, sympy.Integer(1), slope, g, 1 - 2 * P, P, x, names["Psi_xx"])
    state = State(modulus, names["sigma"], names["rho"], Q)
    constant = semi.scni_constant if integration == "scni" else semi.dni_constant
    D = semi.discriminant(semi.linear_coefficient(values, state, kh, K), constant(values, state, kh, K))
    D = sympy.expand(sympy.expand_trig(sympy.expand(D / 4).subs(Q, a * R / (C_h * slope))))
    D = D.subs(modulus, t * names["rho"] - names["sigma"])
    D = sympy.expand(sympy.expand(D).subs(sympy.sin(kh) ** 2, u * (2 - u)).subs(sympy.cos(kh), 1 - u))
    # sigma/rho and Psi,xx enter as a product alone: n q.
    return sympy.expand(sympy.simplify(D).subs(names["sigma"], sympy.Symbol("n") * names["rho"]))


Part = tuple[sympy.Expr, sympy.Expr]


def prove_squares(
    name: str,
    words: str,
    tried: str,
    relation: str,
    D: sympy.Expr,
    parts: Sequence[Part],
    holds: bool | None = None,
) -> Theorem:
    """The theorem that D/4 is the sum of weight times square; raises NotProved where it is not."""
    total = sum((weight * square**2 for weight, square in parts), sympy.Integer(0))
    rest = sympy.expand((total - D).subs({w: 2 - u, j: 1 - 4 * P}))
    if rest != 0:
        raise NotProved(f"{name}: the squares leave {str(rest)[:80]}")
    if any(terms(weight)[0][0] == 0 or str(terms(weight)[0][0]).startswith("-") for weight, _ in parts):
        raise NotProved(f"{name}: a weight is negative")
    listed = [{"weight": terms(weight)[0], "square": terms(square)} for weight, square in parts]
    claim = {"kind": "sum of squares", "relation": relation}
    return Theorem(name, words, tried, claim, {"parts": listed}, "sum of squares, expanded", len(parts), holds)


def printed_squares() -> list[Theorem]:
    """The four relations of the print: where D >= 0, and exactly where it is not."""
    n, xx = sympy.Symbol("n"), sympy.Symbol("Psi_xx")
    scni, dni = (printed_discriminant(kind) for kind in ("scni", "dni"))
    still = [(u * w, a * q), (4 * u, a)]
    at_limit = scni.subs(t, (d - 3 * a**2) / (4 * g**2))
    dni_limit = dni.subs(n, (4 * a**2 - d) / (2 * xx))
    pressed = dni.subs({n: -(r + y), t: -r}).subs(xx, 4 * x**2 + k)
    everywhere = "any kernel with Psi(0) + 2 Psi(h) = 1, all kh, R, Q, sigma"
    one = sympy.Integer(1)
    return [
        prove_squares(
            "printed-scni-not-negative",
            "D of (79) is a sum of squares where C + sigma >= 0, the same for Q and -Q",
            everywhere,
            "scni-printed",
            scni,
            [*still, (4 * t * u * w, g)],
            True,
        ),
        prove_squares(
            "printed-scni-exact-set",
            "D of (79) >= 0 at every kh exactly where (C + sigma)/(rho h^2) [C(h/2) phi(h/2)]^2 >= -(3/4) [Q C(h) phi'(h)/R]^2: in motion the print calls stable what the continuum is not",
            "any kernel with 0 <= Psi(h) <= 1/4, all kh, Q, sigma",
            "scni-printed-limit",
            at_limit,
            [(d * u * w, one), (2 * j * u**2, a), (4 * P * u**3, a), (4 * u**3 * w, a * P)],
            False,
        ),
        prove_squares(
            "printed-dni-exact-set",
            "Where C + sigma >= 0, D of (85) >= 0 at every kh exactly where (sigma/rho) Psi,xx(h) <= 2 [Q C(h) phi'(h)/R]^2: without Q the sign of sigma Psi,xx(h) decides, with Q it does not",
            everywhere,
            "dni-printed-limit",
            dni_limit,
            [(u * w, a * q), (4 * t * u * w, x), (d * u, one)],
        ),
        prove_squares(
            "printed-dni-compressed",
            "Where C + sigma <= 0 and Psi,xx(h) >= 4 Psi,x(h)^2, D of (85) >= 0 at every kh, for all Q",
            "any kernel with Psi,xx(h) >= 4 Psi,x(h)^2, all kh, Q and sigma <= -C",
            "dni-printed-compressed",
            pressed,
            [*still, (4 * r * u**2, x), (8 * y * u, x), (2 * r * k * u, one), (2 * y * k * u, one)],
            True,
        ),
    ]
