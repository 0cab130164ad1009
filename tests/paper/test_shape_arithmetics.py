"""The same lines in every arithmetic: doubles within their condition, more digits within their digits, balls around."""

from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.symbolic import Symbolic
from rkverify.certify.samples import NodeSet
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.shape import shape_functions, shape_gradient, shape_second

Build = Callable[..., Approximation]
Rounding = Callable[[Approximation, Vector], dict[int, float]]
Quantity = Callable[[Approximation, Vector], dict[int, object]]
QUANTITIES: dict[str, Quantity] = {"value": shape_functions, "gradient": shape_gradient, "second": shape_second}


def in_doubles(nodes: NodeSet) -> NodeSet:
    """The set with coordinates and supports rounded to doubles, so that every arithmetic gets the same numbers."""

    def rounded(values: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
        return tuple(Fraction(float(q)) for q in values)

    return NodeSet(nodes.name, rounded(nodes.nodes), rounded(nodes.supports), rounded(nodes.points), nodes.velocities)


def test_doubles_are_right_to_their_condition(build: Build, rounding: Rounding, nodes: NodeSet, order: int) -> None:
    """|error| <= C cond(d^-1 M d^-1) epsilon with every constant counted: decides that a double's digits are known.

    The same lines in complex doubles with zero imaginary parts obey the same bound.
    """
    doubles = in_doubles(nodes)
    for x in doubles.points:
        exact = shape_functions(build(doubles, order), (x,))
        for K in (Float(), Complex()):
            A = build(doubles, order, K)
            bounds = rounding(build(doubles, order, Float()), (float(x),))
            found = shape_functions(A, A.point(x))
            for I in exact.keys() | found.keys():
                error = abs(Fraction(K.witness(found.get(I, 0.0))) - exact.get(I, 0))
                assert error <= Fraction(K.epsilon / 2 * bounds.get(I, 0.0))


def test_the_bound_is_not_idle(build: Build, rounding: Rounding, nodes: NodeSet) -> None:
    """The twin: values rounded to half the digits break it at some point, and it is small enough to say something."""
    doubles = in_doubles(nodes)
    A, broken = build(doubles, 2, Float()), []
    for x in doubles.points:
        bounds = rounding(A, (float(x),))
        assert max(bounds.values()) * Float.epsilon / 2 < 1e-9
        exact = shape_functions(build(doubles, 2), (x,))
        for I, Psi in shape_functions(A, (float(x),)).items():
            error = abs(Fraction(float(f"{Psi:.7e}")) - exact.get(I, 0))
            broken.append(error > Fraction(bounds[I] * Float.epsilon / 2))
    assert any(broken)


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_two_precisions_agree_with_the_exact_value(build: Build, nodes: NodeSet, order: int, quantity: str) -> None:
    """mp:D promises D digits where the condition is below 10^10: 20 and 40 digits against rationals.

    Derivatives are of the size h^-1 and h^-2 with h > 1/16: two and four digits more than the values.
    """
    compute = QUANTITIES[quantity]
    size = {"value": 1, "gradient": 10**2, "second": 10**4}[quantity]
    for digits in (20, 40):
        K, wide = Multiprecision(digits), Multiprecision(60)
        A = build(nodes, order, K)
        for x in nodes.points[::2]:
            exact, found = compute(build(nodes, order), (x,)), compute(A, A.point(x))
            for I, value in exact.items():
                assert abs(wide.number(found.get(I, 0)) - wide.number(value)) <= wide.number(size) / 10**digits


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_balls_enclose_the_exact_value(build: Build, nodes: NodeSet, order: int, quantity: str) -> None:
    """Decides that a printed enclosure is a proof: it contains the rational, and is narrow enough to say something."""
    compute, B = QUANTITIES[quantity], Ball(30)
    A = build(nodes, order, B)
    for x in nodes.points[1::2]:
        exact = compute(build(nodes, order), (x,))
        for I, found in compute(A, A.point(x)).items():
            gap = found - B.number(exact.get(I, 0))
            assert not B.surely_positive(gap)
            assert not B.surely_positive(-gap)
            assert float(found.value.rad()) < 1e-20


def test_a_box_of_points_encloses_all_of_them(build: Build, nodes: NodeSet) -> None:
    """One evaluation over an interval of x contains the values at points inside, across a joint as well."""
    B = Ball(30)
    for x in nodes.points:
        box = B.between(x - Fraction(1, 10**6), x + Fraction(1, 10**6))
        enclosures = shape_functions(build(nodes, 1, B), (box,))
        for t in (-1, 0, 1):
            for I, Psi in shape_functions(build(nodes, 1), (x + Fraction(t, 10**6),)).items():
                assert not B.surely_positive(B.number(Psi) - enclosures[I])
                assert not B.surely_positive(enclosures[I] - B.number(Psi))


def test_symbols_give_the_closed_form_of_the_lattice() -> None:
    """Psi_I(x_I) and Psi_I(x_{I+1}) for free R: right for every R that satisfies the recorded conditions.

    At R = 3/2 they are the 27/31 and 2/31 that (76) uses; R = 5/4 satisfies the same conditions, R = 5/2 does not.
    """
    R = sympy.Symbol("R", positive=True)
    K = Symbolic({R: "3/2"})
    A = approximation([[-2], [-1], [0], [1], [2]], R, K, order=1)
    Psi = shape_functions(A, A.point(0))
    assert [Psi[J].subs(R, sympy.Rational(3, 2)) for J in (1, 2, 3)] == [sympy.Rational(n, 31) for n in (2, 27, 2)]
    for other, holds in ((Fraction(5, 4), True), (Fraction(5, 2), False)):
        at = {R: sympy.Rational(other.numerator, other.denominator)}
        assert all(condition.subs(at) for condition in K.conditions) == holds
        exact = shape_functions(approximation([[-2], [-1], [0], [1], [2]], other, Exact(), order=1), (Fraction(0),))
        assert (Fraction(str(Psi[2].subs(at))) == exact[2]) == holds
