"""Symbols: branches are taken at a sample, and the inequalities under which they are right are written down."""

from fractions import Fraction

import pytest
import sympy

from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.arithmetic.symbolic import Symbolic
from rkverify.errors import NotDifferentiable, RkverifyError
from rkverify.kernels import kernel

R = sympy.Symbol("R", positive=True)
X = sympy.Symbol("x", real=True)


@pytest.mark.parametrize(
    ("sample", "value", "condition"),
    [("3/2", (2 - R) ** 3, R < 2), ("5/2", sympy.Integer(0), R > 2), (2, sympy.Integer(0), sympy.Eq(R, 2))],
)
def test_a_branch_is_recorded_with_where_it_holds(sample: object, value: sympy.Expr, condition: sympy.Basic) -> None:
    """Decides that a closed form comes with its range: the same branch is right for every R that satisfies it."""
    K = Symbolic({R: sample})
    assert sympy.expand(K.pos(2 - R, 3) - value) == 0
    assert K.conditions == {condition}


def test_numbers_need_no_condition() -> None:
    K = Symbolic()
    assert K.sign(K.ratio(-1, 3)) == -1
    assert K.sign(sympy.sqrt(2) - 1) == 1
    assert K.conditions == set()


def test_a_symbol_without_a_sample_decides_nothing() -> None:
    """Decides that a branch is never guessed, and that the message is one of ours."""
    with pytest.raises(RkverifyError):
        Symbolic().sign(X)


def test_a_zero_in_disguise_is_exactly_zero() -> None:
    """is_zero is "exactly zero, whatever it stands for"; (x + 1)^2 - x^2 - 2 x - 1 is."""
    assert Symbolic().is_zero((X + 1) ** 2 - X**2 - 2 * X - 1)
    assert not Symbolic().is_zero(X)


@pytest.mark.parametrize(("sample", "others"), [("1/4", ("1/10", "2/5")), ("3/4", ("3/5", "9/10"))])
def test_the_kernel_as_a_closed_form_is_right_wherever_its_conditions_hold(
    sample: str, others: tuple[str, str]
) -> None:
    """Decides that conditions are enough: each piece of (12) agrees with exact values all over its own range."""
    K, phi = Symbolic({X: sample}), kernel("cubic").phi
    piece = phi(X, K)
    for other in (sample, *others):
        at = {X: sympy.Rational(other)}
        assert all(condition.subs(at) for condition in K.conditions)
        exact = phi(Fraction(other), Exact())
        assert piece.subs(at) == sympy.Rational(exact.numerator, exact.denominator)


def test_beyond_its_conditions_a_closed_form_is_another_functions() -> None:
    """The twin: the inner piece continued to z = 3/4 violates its conditions, and is not the kernel."""
    K, phi = Symbolic({X: "1/4"}), kernel("cubic").phi
    piece, beyond = phi(X, K), {X: sympy.Rational(3, 4)}
    assert not all(condition.subs(beyond) for condition in K.conditions)
    exact = phi(Fraction(3, 4), Exact())
    assert piece.subs(beyond) != sympy.Rational(exact.numerator, exact.denominator)


def test_functions_stay_symbols() -> None:
    K = Symbolic()
    assert K.cos(K.pi()) == -1
    assert K.sin(X) == sympy.sin(X)
    assert K.sqrt(K.number(2)) ** 2 == 2
    assert K.text(K.ratio(1, 3)) == "1/3"


def test_rational_functions_decide_at_their_sample_and_remember() -> None:
    """The other arithmetic with a free quantity: lowest terms make a zero a zero, and each sign used is kept with its element."""
    K = RationalFunctions({"R": "3/2"})
    r = K.generator("R")
    assert K.pos(2 - r, 3) == (2 - r) ** 3
    assert K.is_zero(K.pos(1 - r, 2))
    assert K.decisions == {2 - r: 1, 1 - r: -1}
    assert K.is_zero((r + 1) ** 2 - r**2 - 2 * r - 1)
    assert K.sign(K.ratio(-1, 3)) == -1
    assert len(K.decisions) == 2  # a constant needs no condition
    with pytest.raises(NotDifferentiable):
        K.pos(2 * r - 3, 0)
