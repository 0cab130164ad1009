"""From the semi-discrete equations to the printed stencils, link by link, in exact rationals on the uniform lattice.

A link that does not hold is rebuilt with terms dropped until the printed stencil comes out to the last rational: the
functions below say which terms these are, and what they amount to.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.paper import printed_lagrangian as lagrangian_print
from rkverify.paper import printed_semi_lagrangian as semi_print
from rkverify.paper.approximation import approximation, lattice, middle
from rkverify.paper.gradients import direct_gradient
from rkverify.paper.notation import lattice_values
from rkverify.paper.perturbed_equation import convective_terms, lagrangian_acceleration
from rkverify.paper.printed_semi_lagrangian import State
from rkverify.paper.shape import shape_gradient
from rkverify.readings import Derivative, HalfPoint, Integration, Readings
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.lagrangian import StretchedBar, stencil
from rkverify.stability.lattice_state import Base
from rkverify.stability.symbol import transform

K = Exact()
Coefficients = dict[int, Fraction]


def nonzero(coefficients: Coefficients) -> Coefficients:
    """Without the zeros, so that equal stencils compare equal."""
    return {n: c for n, c in sorted(coefficients.items()) if c != 0}


def _coefficients_of(linear: Callable[[Callable[[int], Fraction]], Fraction], reach: int) -> Coefficients:
    """The coefficients of a linear form in u_{I+n}, by putting in one unit displacement after the other."""
    return nonzero({n: linear(partial(_unit, n)) for n in range(-reach, reach + 1)})


def _unit(n: int, j: int) -> Fraction:
    return Fraction(int(j == n))


def lagrangian_link(R: Fraction, s: Fraction, F: Fraction) -> tuple[Coefficients, Coefficients, Coefficients]:
    """(61) as printed, the linearisation of (56), and (57) with (58)-(60): coefficients of u_{I+n} in u_I''."""
    b = lagrangian_print.b_hat(1, R, K)
    c_squared = lagrangian_print.tangent(Fraction(1), F, s)
    printed = _coefficients_of(lambda u: lagrangian_print.stencil_acceleration(b, c_squared, u), len(b))
    m = len(b) // 2
    perturbed = lagrangian_acceleration({n - m: value for n, value in enumerate(b)}, c_squared, Fraction(1))
    return printed, nonzero(stencil(StretchedBar(R, "scni", s, F), K)), nonzero(perturbed)


@dataclass(frozen=True)
class Printed:
    """The coefficients of u~_{I+n} and of its rate in the left-hand side of (75) or (81), without the first term."""

    displacement: Coefficients
    velocity: Coefficients


def printed_stencil(
    integration: Integration,
    R: Fraction,
    s: Fraction,
    Q: Fraction,
    half_point: HalfPoint = "edge",
    derivative: Derivative = "full",
) -> Printed:
    """(75) or (81) as printed; unit spacing, density and modulus."""
    values = lattice_values(1, R, K, half_point, derivative)
    state = State(Fraction(1), s, Fraction(1), Q)
    left = semi_print.scni_stencil if integration == "scni" else semi_print.dni_stencil

    def none(_: int) -> Fraction:
        return Fraction(0)

    return Printed(
        _coefficients_of(lambda u: left(values, state, u, none, none), 3),
        _coefficients_of(lambda w: left(values, state, none, w, none), 3),
    )


def defined_stencil(readings: Readings, R: Fraction, s: Fraction, Q: Fraction) -> Printed:
    """The same of the linearised (65), every term kept; stresses, edges and measures follow the positions (Q = 0)."""
    found = linearise(Base(R, readings, s, Q), K).stencil
    displacement: Coefficients = {n: -c for n, c in found["v", "x"].items()}
    for kind in {row for row, _ in found} - {"x", "v"}:
        for n, force in found["v", kind].items():
            for m, follows in found[kind, "v"].items():
                displacement[n + m] = displacement.get(n + m, Fraction(0)) - force * follows
    return Printed(nonzero(displacement), nonzero({n: -c for n, c in found["v", "v"].items()}))


def convective_part(R: Fraction, Q: Fraction, with_direction: bool, with_varied_rate: bool) -> Printed:
    """The terms of (73) and (74) that come from N on the lattice with the base v = Q x."""
    found = convective_terms(lattice(1, R, 4, K), Q, with_direction, with_varied_rate)
    return Printed(*map(nonzero, found))


def printed_convective_part(R: Fraction, Q: Fraction) -> Printed:
    """The second and third term of (75) and (81) as printed."""
    with_term, without = (printed_stencil("scni", R, Fraction(0), q) for q in (Q, Fraction(0)))
    shifts = with_term.displacement.keys() | without.displacement.keys()
    zero = Fraction(0)
    return Printed(
        nonzero({n: with_term.displacement.get(n, zero) - without.displacement.get(n, zero) for n in shifts}),
        with_term.velocity,
    )


def defined_convective_part(R: Fraction, Q: Fraction) -> Printed:
    """The terms that N with Psi* adds to the linearised (65): with it less without it."""
    parts = []
    for column in ("x", "v"):
        both = [linearise(Base(R, Readings("scni", c), 0, Q), K).stencil["v", column] for c in ("psi-star", "none")]
        shifts = both[0].keys() | both[1].keys()
        zero = Fraction(0)
        parts.append(nonzero({n: both[1].get(n, zero) - both[0].get(n, zero) for n in shifts}))
    return Printed(*parts)


def pairwise_slopes(R: Fraction, derivative: Derivative) -> Coefficients:
    """n -> the derivative of B_I(x_K) with respect to x_K, x_K - x_I = n h, while the lattice and its moments stay."""
    A = lattice(1, R, 3, K)
    D = Duals(K, 1)
    moved = approximation([[D.number(x) for x in node] for node in A.nodes], D.number(R), D)
    I = middle(A)
    found: Coefficients = {}
    for n in (-1, 0, 1):
        B = shape_gradient(moved, (D.variable(A.nodes[I + n][0], 0),), 0, derivative)
        found[n] = B[I].partials[0]
    return found


def rebuilt_81(readings: Readings, R: Fraction, s: Fraction) -> Coefficients:
    """The stress terms of (74) with B_I(x_K) varied as a function of x_K - x_I alone; every other term kept.

    sum_K B~ sigma a_K + B sigma~ a_K + B sigma a~_K over m_I: sigma~ from the rate of stress, a~_K from the edges.
    """
    zero = Fraction(0)
    A = lattice(1, R, 3, K)
    slope = {n: direct_gradient(A, A.nodes[middle(A) + n], readings.derivative)[middle(A)] for n in (-1, 0, 1)}
    tangent = 1 + s if readings.stress_law == "truesdell" else Fraction(1)
    total: Coefficients = {}

    def add(n: int, value: Fraction) -> None:
        total[n] = total.get(n, zero) + value

    for n, g in pairwise_slopes(R, readings.derivative).items():
        add(n, s * g)
        add(0, -s * g)
    for n, B in slope.items():
        for m, other in slope.items():
            # Node I + n - m lies as far from cell K = I + n as node I from cell I + m.
            add(n - m, tangent * B * other)
        if readings.cell_measure == "edges":
            add(n + 1, s * B / 2)
            add(n - 1, -s * B / 2)
    return nonzero(total)


def relation_error(
    readings: Readings, R: Fraction, s: Fraction, half_point: HalfPoint, wave: str = "7/5", digits: int = 40
) -> float:
    """|omega^2 of (86) or (87) - omega^2 of the linearised (65) without N| over the latter, at one kh and many digits."""
    high = Multiprecision(digits)
    values = lattice_values(1, R, high, half_point, readings.derivative)
    state = State(high.number(1), high.number(s), high.number(1), high.zero())
    formula = semi_print.scni_omega_squared if readings.integration == "scni" else semi_print.dni_omega_squared
    printed = formula(values, state, high.number(wave), high)
    coefficients = {n: high.number(c) for n, c in defined_stencil(readings, R, s, Fraction(0)).displacement.items()}
    defined = transform(coefficients, high.number(wave), high).re
    return float(high.absolute(printed - defined) / high.absolute(defined))
