"""The printed relations against their own printed consequences, by machine algebra with every value a free symbol.

The lines that are compared are those of `paper/`, run with symbols; a residual that is identically zero proves
the step for all values, and one that is not shows that it does not follow.
"""

from collections.abc import Callable
from dataclasses import dataclass

import sympy

from rkverify.arithmetic.symbolic import Symbolic
from rkverify.paper import printed_lagrangian as lagrangian
from rkverify.paper import printed_semi_lagrangian as semi
from rkverify.paper.notation import LatticeValues
from rkverify.paper.plane_wave import phase_sign
from rkverify.paper.printed_semi_lagrangian import State

KH, OMEGA, Q = sympy.symbols("kh omega Q", real=True)
MODULUS, SIGMA = sympy.symbols("C^sigma sigma", real=True)
RHO, H, R = sympy.symbols("rho h R", positive=True)
VALUES = LatticeValues(h=H, R=R, **{name: sympy.Symbol(name, real=True) for name in (
    "C_h", "C_half", "slope_h", "phi_half", "Psi_0", "Psi_h", "Psi_x_h", "Psi_xx_h",
)})  # fmt: skip
STATE = State(MODULUS, SIGMA, RHO, Q)
STILL = State(MODULUS, SIGMA, RHO, sympy.Integer(0))
K = Symbolic()
_E = sympy.Symbol("E")


@dataclass(frozen=True)
class Step:
    """A step from one printed relation to another: what is left when both are subtracted, 0 if it follows."""

    name: str
    residual: sympy.Expr

    @property
    def follows(self) -> bool:
        """Whether nothing is left, for all values of all symbols."""
        return bool(self.residual == 0)


def reduced(expression: sympy.Expr) -> sympy.Expr:
    """The expression with every function of kh written in E = e^{i kh}, in lowest terms: 0 only if identically 0."""
    exponential = sympy.expand(expression.rewrite(sympy.exp), power_exp=False)
    in_powers = exponential.replace(
        lambda e: isinstance(e, sympy.exp), lambda e: _E ** sympy.expand(e.args[0] / (sympy.I * KH))
    )
    return sympy.factor(sympy.together(sympy.expand(in_powers)))


def wave(sign: int, derivatives: int) -> Callable[[int], sympy.Expr]:
    """n -> the time derivative of u~_{I+n} / u~_I for the plane wave (62) with the given sign of omega t."""
    return lambda n: (sympy.I * sign * OMEGA) ** derivatives * sympy.exp(sympy.I * n * KH)


def stencil_to_relation(
    stencil: Callable[..., sympy.Expr], relation: Callable[..., sympy.Expr], reading: str
) -> sympy.Expr:
    """What is left of stencil + relation after the plane wave is put in (the stencil carries -omega^2)."""
    sign = phase_sign(reading)
    put_in = stencil(VALUES, STATE, wave(sign, 0), wave(sign, 1), wave(sign, 2))
    return reduced(put_in + relation(VALUES, STATE, KH, OMEGA, K))


def lagrangian_stencil_to_relation(m: int) -> sympy.Expr:
    """(61) with a plane wave against (63), for free gradients b of half-width m."""
    b = list(sympy.symbols(f"b_1:{2 * m + 2}", real=True))
    c_squared = sympy.Symbol("c2", real=True)
    acceleration = lagrangian.stencil_acceleration(b, c_squared, wave(1, 0))
    return reduced(acceleration + lagrangian.omega_squared(b, c_squared, KH, K))


def steps() -> list[Step]:
    """Every step between printed relations that needs nothing but the print."""
    B = semi.linear_coefficient(VALUES, STATE, KH, K)
    C, A = semi.scni_constant(VALUES, STATE, KH, K), semi.dni_constant(VALUES, STATE, KH, K)
    roots = {name: (-B + sympy.sqrt(semi.discriminant(B, last))) / 2 for name, last in (("C", C), ("A", A))}
    still_scni = semi.scni_relation(VALUES, STILL, KH, OMEGA, K)
    still_dni = semi.dni_relation(VALUES, STILL, KH, OMEGA, K)
    found = [Step(f"(61) -> (63), m = {m}", lagrangian_stencil_to_relation(m)) for m in (1, 2, 3)]
    for reading in ("plus", "minus"):
        found += [
            Step(f"(75) -> (76), {reading}", stencil_to_relation(semi.scni_stencil, semi.scni_relation, reading)),
            Step(f"(81) -> (82), {reading}", stencil_to_relation(semi.dni_stencil, semi.dni_relation, reading)),
        ]
    return [
        *found,
        Step(
            "(76) = (77) with (78)",
            reduced(semi.scni_relation(VALUES, STATE, KH, OMEGA, K) - semi.quadratic(B, C, OMEGA)),
        ),
        Step(
            "(82) = (83) with (84)",
            reduced(semi.dni_relation(VALUES, STATE, KH, OMEGA, K) - semi.quadratic(B, A, OMEGA)),
        ),
        Step("(79) is the discriminant of (77)", sympy.expand(semi.quadratic(B, C, roots["C"]))),
        Step("(85) is the discriminant of (83)", sympy.expand(semi.quadratic(B, A, roots["A"]))),
        Step(
            "(76) without its Q terms -> (86)",
            reduced(OMEGA**2 - semi.scni_omega_squared(VALUES, STATE, KH, K) - still_scni),
        ),
        Step(
            "(82) without its Q terms -> (87)",
            reduced(OMEGA**2 - semi.dni_omega_squared(VALUES, STATE, KH, K) - still_dni),
        ),
    ]


def lagrangian_tangent() -> sympy.Expr:
    """dP/dF of (53)-(55) less the factor of f~ in (59)."""
    F = sympy.Symbol("F", positive=True)
    S = lagrangian.second_piola_kirchhoff(MODULUS, lagrangian.green_strain(F))
    return sympy.expand(sympy.diff(lagrangian.first_piola_kirchhoff(S, F), F) - lagrangian.tangent(MODULUS, F, S))


def lagrangian_as_square(m: int) -> sympy.Expr:
    """(63) less c^2 times the squared modulus of sum_K b^_K e^{i K kh}, for free gradients b of half-width m."""
    b = list(sympy.symbols(f"b_1:{2 * m + 2}", real=True))
    c_squared = sympy.Symbol("c2", real=True)
    total = sum(value * sympy.exp(sympy.I * n * KH) for n, value in enumerate(b))
    other = sum(value * sympy.exp(-sympy.I * n * KH) for n, value in enumerate(b))
    return reduced(lagrangian.omega_squared(b, c_squared, KH, K) - c_squared * total * other)


def scni_discriminant() -> sympy.Expr:
    """D of (79) with every value a symbol."""
    B = semi.linear_coefficient(VALUES, STATE, KH, K)
    return semi.discriminant(B, semi.scni_constant(VALUES, STATE, KH, K))


def dni_discriminant() -> sympy.Expr:
    """D of (85) with every value a symbol."""
    B = semi.linear_coefficient(VALUES, STATE, KH, K)
    return semi.discriminant(B, semi.dni_constant(VALUES, STATE, KH, K))


def convective_gain(discriminant: sympy.Expr) -> sympy.Expr:
    """D with the convective term less D without it, less the squares B^2 + (4 Q C(h) phi'(h)/R)^2 (1 - cos kh)."""
    B = semi.linear_coefficient(VALUES, STATE, KH, K)
    squares = B**2 + (4 * Q * VALUES.C_h * VALUES.slope_h / R) ** 2 * (1 - sympy.cos(KH))
    return reduced(discriminant - discriminant.subs(Q, 0) - squares)


def scni_as_squares() -> sympy.Expr:
    """D of (79) less a sum of terms that are none of them negative where C^sigma + sigma >= 0."""
    B = semi.linear_coefficient(VALUES, STATE, KH, K)
    squares = (
        B**2
        + 2 * (4 * Q * VALUES.C_h * VALUES.slope_h / R * sympy.sin(KH / 2)) ** 2
        + (MODULUS + SIGMA) * (4 * VALUES.C_half * VALUES.phi_half * sympy.sin(KH)) ** 2 / (RHO * H**2)
    )
    return sympy.simplify(sympy.expand_trig(sympy.expand(scni_discriminant() - squares)))


def dni_at_pi(without_convection: bool) -> sympy.Expr:
    """D of (85) at kh = pi, a multiple of 2 Q^2 [C(h) phi'(h)/R]^2 - sigma Psi,xx(h)/rho."""
    D = dni_discriminant().subs(KH, sympy.pi)
    return sympy.factor(D.subs(Q, 0) if without_convection else D)


IN_PRINT = {"**": "^", "Psi_xx_h": "Psi,xx(h)", "Psi_x_h": "Psi,x(h)", "slope_h": "phi'(h)", "C_h": "C(h)", "*": " "}
"""How an expression names the values on the lattice -> how the paper does."""


def as_printed(expression: sympy.Expr) -> str:
    """An expression with the names that the paper has for its symbols.

    >>> as_printed(-16 * VALUES.Psi_xx_h * SIGMA / RHO)
    '-16 Psi,xx(h) sigma/rho'
    """
    words = str(expression)
    for ours, theirs in IN_PRINT.items():
        words = words.replace(ours, theirs)
    return words


def dni_still_over_one_minus_cosine() -> sympy.Expr:
    """D of (85) at Q = 0 over 1 - cos kh, as an expression in c = cos kh."""
    c = sympy.Symbol("c", real=True)
    D = sympy.expand(dni_discriminant().subs(Q, 0)).subs(sympy.sin(KH) ** 2, 1 - c**2).subs(sympy.cos(KH), c)
    return sympy.cancel(D / (1 - c))


def dni_vanishes_with_the_stress_term() -> bool:
    """Whether, at Q = 0, the sign of sigma Psi,xx(h) decides the sign of D where C^sigma + sigma >= 0.

    D/(1 - cos kh) is affine in cos kh with the slope 16 (C^sigma + sigma) Psi,x^2 / rho, hence least at kh = pi,
    where D is -16 sigma Psi,xx / rho: both are checked as identities.
    """
    c = sympy.Symbol("c", real=True)
    quotient = dni_still_over_one_minus_cosine()
    slope = 16 * (MODULUS + SIGMA) * VALUES.Psi_x_h**2 / RHO
    affine = sympy.expand(quotient - slope * (c + 1) - dni_at_pi(True) / 2) == 0
    return bool(affine and sympy.expand(dni_at_pi(True) + 16 * SIGMA * VALUES.Psi_xx_h / RHO) == 0)


def stress_sign_alone_decides() -> bool:
    """Whether D at kh = pi is a multiple of sigma Psi,xx(h) whatever Q is."""
    return bool(sympy.expand(dni_at_pi(False) - dni_at_pi(True)) == 0)


def is_even_in(expression: sympy.Expr, symbol: sympy.Symbol) -> bool:
    """Whether the expression does not change with the symbol's sign, for all values."""
    return bool(reduced(expression - expression.subs(symbol, -symbol)) == 0)


def real_frequencies_keep_amplitudes() -> bool:
    """Whether |e^{i omega t}| = 1 for all real omega and t."""
    omega, t = sympy.symbols("omega t", real=True)
    return bool(sympy.Abs(sympy.exp(sympy.I * omega * t)) == 1)


def double_root_drifts() -> bool:
    """Whether with D = 0 t e^{i omega t} solves the equation of motion that has the polynomial of (77), beside e^{i omega t}.

    The polynomial omega^2 + B omega + C stands for -u'' - i B u' + C u = 0.
    """
    t, B = sympy.symbols("t B", real=True)
    u = t * sympy.exp(-sympy.I * B / 2 * t)
    return bool(sympy.simplify(-sympy.diff(u, t, 2) - sympy.I * B * sympy.diff(u, t) + B**2 / 4 * u) == 0)
