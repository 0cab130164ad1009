"""The numbers that (75)-(87) are written in, for R = 3/2 and h = 1/20, from three nodes and the printed kernel."""

from fractions import Fraction
from functools import cache

import pytest
import sympy

from rkverify.arithmetic.native import Exact
from rkverify.certify.independent import cubic_kernel_as_printed
from rkverify.paper.notation import LatticeValues, lattice_values

K = Exact()
H, RATIO = Fraction(1, 20), Fraction(3, 2)
A = RATIO * H  # the support
T = sympy.Symbol("t", positive=True)


def weight(distance: Fraction) -> Fraction:
    return cubic_kernel_as_printed(distance / A)


def at_node(k: int) -> Fraction:
    """S_k at x_I: the nodes I - 1, I, I + 1 with their weights and distances; I - 2 and I + 2 are out of reach."""
    return sum((weight(abs(y)) * y**k for y in (-H, Fraction(0), H)), Fraction(0))


def values(**reading: str) -> LatticeValues:
    return lattice_values(H, RATIO, K, **reading)


def test_values_at_the_node() -> None:
    """S_1 = 0 by symmetry, so b = (1/S_0, 0), C = 1/S_0 whatever its second argument, and Psi = phi/S_0."""
    assert at_node(1) == 0
    s = values()
    assert s.C_h == 1 / at_node(0) == Fraction(81, 62)
    assert s.Psi_0 == weight(Fraction(0)) / at_node(0) == Fraction(27, 31)
    assert s.Psi_h == weight(H) / at_node(0) == Fraction(2, 31)
    assert s.Psi_0 + 2 * s.Psi_h == 1


def test_the_kernel_at_the_neighbour_and_at_the_edge() -> None:
    """z = 2/3 and 1/3: phi' is the slope -4 (1 - z)^2 of the outer piece, per unit of z as (70) has a in its denominator."""
    s = values()
    assert s.slope_h == -4 * (1 - Fraction(2, 3)) ** 2
    assert s.phi_half == weight(H / 2) == Fraction(10, 27)
    assert (s.h, s.R) == (H, RATIO)


def test_the_correction_half_way_in_both_readings() -> None:
    """At the edge only I and I + 1 are inside, at equal distance (I - 1 and I + 2 lie exactly on theirs): b = (1/(2 phi), 0).

    So C phi = Psi = 1/2 there. As printed the moment matrix is that of the node, and C phi is not a shape function.
    """
    assert weight(3 * H / 2) == 0
    assert values(half_point="edge").C_half == 1 / (2 * weight(H / 2)) == Fraction(27, 20)
    assert values(half_point="literal").C_half == 1 / at_node(0) == Fraction(81, 62)
    assert values(half_point="edge").C_half * values().phi_half == Fraction(1, 2)
    assert values(half_point="literal").C_half * values().phi_half != Fraction(1, 2)


def beside() -> tuple[list[sympy.Expr], list[sympy.Expr]]:
    """Offsets y = x - x_J and weights of the nodes I - 1, I, I + 1 at x = x_I + t, 0 < t < h/2, as expressions in t.

    z is below 1/2 for the middle node alone. The kernel is C2, so the limits t -> 0 of second derivatives are those at 0.
    """
    h, a = sympy.Rational(1, 20), sympy.Rational(3, 40)
    offsets = [T + h, T, T - h]
    z = [(T + h) / a, T / a, (h - T) / a]
    inner = sympy.Rational(2, 3) - 4 * z[1] ** 2 + 4 * z[1] ** 3
    outer = [sympy.Rational(4, 3) * (1 - v) ** 3 for v in (z[0], z[2])]
    return offsets, [outer[0], inner, outer[1]]


def sums(offsets: list[sympy.Expr], weights: list[sympy.Expr]) -> list[sympy.Expr]:
    return [sum(w * y**k for y, w in zip(offsets, weights, strict=True)) for k in range(3)]


def limit(expression: sympy.Expr) -> Fraction:
    value = expression.subs(T, 0)
    return Fraction(int(value.p), int(value.q))


@cache
def readings_by_hand() -> dict[str, tuple[Fraction, Fraction]]:
    """Psi,x(h) and Psi,xx(h) of the node I at x_{I+1}: there it is the left neighbour, at y = h + t."""
    offsets, weights = beside()
    S, y, phi = sums(offsets, weights), offsets[0], weights[0]
    determinant = S[0] * S[2] - S[1] ** 2
    b = [S[2] / determinant, -S[1] / determinant]
    held = [c.subs(T, 0) for c in b]
    Psi = (b[0] + b[1] * y) * phi
    polynomial = (held[0] + held[1] * y) * phi
    kernel_alone = (held[0] + held[1] * sympy.Rational(1, 20)) * phi
    # The slope of the straight line of best fit about x, in s = x_J - x = -y: weights phi (S_0 s - T_1)/det, T_1 = -S_1.
    fitted = phi * (S[1] - S[0] * y) / determinant
    return {
        "full": (limit(sympy.diff(Psi, T)), limit(sympy.diff(Psi, T, 2))),
        "diffuse": (limit(fitted), limit(sympy.diff(fitted, T))),
        "frozen-b": (limit(sympy.diff(polynomial, T)), limit(sympy.diff(polynomial, T, 2))),
        "frozen": (limit(sympy.diff(kernel_alone, T)), limit(sympy.diff(kernel_alone, T, 2))),
    }


@pytest.mark.parametrize("reading", ["full", "diffuse", "frozen-b", "frozen"])
def test_derivatives_in_each_reading(reading: str) -> None:
    """Cramer's rule for three nodes, differentiated by sympy: decides Psi,x(h) and the undefined Psi,xx(h) of (81)."""
    s = values(derivative=reading)
    assert (s.Psi_x_h, s.Psi_xx_h) == readings_by_hand()[reading]


def test_the_gradient_of_three_nodes_is_the_central_difference() -> None:
    """sum Psi,x = 0 and sum Psi,x x_I = 1 with three symmetric nodes leave -1/(2h), for every reading that keeps both."""
    hand = readings_by_hand()
    assert hand["full"][0] == hand["diffuse"][0] == -1 / (2 * H)
    assert hand["frozen"][0] != -1 / (2 * H)


def test_with_a_quadratic_basis_the_correction_knows_where_it_is_asked() -> None:
    """b_1 = 0 by symmetry, so that with n = 1 C(x; y) is the same for every y; with n = 2 it is b_0 + b_2 y^2.

    M b = H(0) without its odd rows: b_0 S_0 + b_2 S_2 = 1, b_0 S_2 + b_2 S_4 = 0. R = 5/2.
    """
    R, h = Fraction(5, 2), Fraction(1, 4)

    def correction(points: list[Fraction], y: Fraction) -> Fraction:
        S = [sum(cubic_kernel_as_printed(abs(p) / (R * h)) * p**k for p in points) for k in range(5)]
        assert S[1] == S[3] == 0
        b_2 = -S[2] / (S[0] * S[4] - S[2] ** 2)
        return -b_2 * S[4] / S[2] + b_2 * y**2

    from_node, from_edge = [k * h for k in range(-3, 4)], [(k + Fraction(1, 2)) * h for k in range(-3, 3)]
    edge, literal = (lattice_values(h, R, K, half_point=half, order=2) for half in ("edge", "literal"))
    assert edge.C_h == literal.C_h == correction(from_node, h) != correction(from_node, h / 2)
    assert edge.C_half == correction(from_edge, h / 2) != correction(from_edge, h)
    assert literal.C_half == correction(from_node, h / 2)


@pytest.mark.parametrize("factor", [Fraction(20), Fraction(1, 1000)])
def test_only_the_derivatives_know_the_spacing(factor: Fraction) -> None:
    """All values but h itself are functions of R alone; Psi,x and Psi,xx go with 1/h and 1/h^2."""
    one, other = values(), lattice_values(H * factor, RATIO, K)
    for name in ("R", "C_h", "C_half", "slope_h", "phi_half", "Psi_0", "Psi_h"):
        assert getattr(one, name) == getattr(other, name)
    assert (other.h, other.Psi_x_h * factor, other.Psi_xx_h * factor**2) == (H * factor, one.Psi_x_h, one.Psi_xx_h)
