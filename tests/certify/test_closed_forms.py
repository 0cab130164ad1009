"""Closed forms by machine algebra against the same linearisation in numbers: a slip in either would show.

Rational functions are compared with exact rationals and with many digits, at support ratios that were not the sample.
"""

from fractions import Fraction

import numpy as np
import pytest
import sympy

from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify import derivation, links
from rkverify.certify.closed_forms import geometric_factor, largest_error, stencil_over_kernel_values, stencil_over_R
from rkverify.errors import BadInput
from rkverify.kernels import kernel
from rkverify.readings import Readings

F = Fraction
S, Q = F(1, 3), F(1, 5)


@pytest.mark.parametrize(("side", "low"), [("low", 101), ("high", 151)])
@pytest.mark.parametrize(
    "readings", [Readings("dni", "none"), Readings("dni", "none", "diffuse"), Readings("scni", "true")]
)
def test_the_forms_are_the_linearisation_at_forty_digits(readings: Readings, side: str, low: int) -> None:
    rng = np.random.default_rng(7)
    ratios = [F(int(n), 100) for n in rng.choice(np.arange(low, low + 48), size=4, replace=False)]
    assert largest_error(readings, side, ratios, S, Q, 40) < 1e-40


def test_beyond_their_range_they_are_not() -> None:
    """At R > 3/2 a cell edge sees four nodes: the form of the lower range is then another function."""
    assert largest_error(Readings("scni", "none"), "low", [F(8, 5)], S, Q, 40) > 1e-3


@pytest.mark.parametrize("derivative", ["full", "diffuse"])
def test_the_kernels_values_give_the_same_factor(derivative: str) -> None:
    """With the cubic kernel's values put in, the form for any kernel is the one for the cubic."""
    readings = Readings("dni", "none", derivative)
    of_R = geometric_factor(*stencil_over_R(readings, "high"))
    of_values = geometric_factor(*stencil_over_kernel_values(readings, "high"))
    R, z = sympy.Rational(9, 5), sympy.Rational(5, 9)
    cubic = kernel("cubic").phi
    phi = {"p_0": sympy.Rational(2, 3), "p_1": _at(cubic, z), "z_1": z}
    phi |= {"g_1": _at(cubic.derivative(), z) / z, "c_1": _at(cubic.derivative(2), z)}
    assert of_R.subs("R", R) == of_values.subs(phi)


def _at(f, z):
    K = RationalFunctions({"z": "5/9"})
    value = f(K.number(F(z.p, z.q)), K)
    exact = K.witness(value)
    return sympy.Rational(exact.numerator, exact.denominator)


def test_a_stencil_of_another_form_is_refused() -> None:
    with pytest.raises(BadInput):
        geometric_factor(*stencil_over_R(Readings("scni", "none"), "high"))


def test_decisions_are_recorded() -> None:
    """Every decision says where the form holds; all of them keep their sign between R = 3/2 and 2."""
    _, field = stencil_over_R(Readings("scni", "none"), "high")
    assert field.decisions
    for element, sign in field.decisions.items():
        for R in ("151/100", "199/100"):
            point = RationalFunctions({"R": R, "s": "1/7", "Q": "1/3"})
            point.field = field.field
            value = point.witness(element)
            assert (value > 0) - (value < 0) == sign


@pytest.mark.decides("C28", "E61")
@pytest.mark.parametrize("R", [F(11, 10), F(3, 2), F(9, 4), F(7, 2)])
def test_61_is_the_linearisation(R: Fraction) -> None:
    printed, defined, perturbed = derivation.lagrangian_link(R, S, F(6, 5))
    assert printed == defined == perturbed


@pytest.mark.decides("C36", "C37", "E75")
@pytest.mark.parametrize("R", [F(11, 10), F(3, 2), F(19, 10)])
def test_75_comes_out_when_the_direction_is_dropped_and_only_then(R: Fraction) -> None:
    printed = derivation.printed_convective_part(R, Q)
    assert derivation.convective_part(R, Q, False, False) == printed
    assert derivation.convective_part(R, Q, True, False) != printed
    whole = derivation.defined_stencil(Readings("scni", "psi-star"), R, F(0), Q)
    assert derivation.convective_part(R, Q, True, True).velocity == whole.velocity
    assert derivation.convective_part(R, Q, True, False).velocity != whole.velocity


@pytest.mark.decides("C47", "E81")
@pytest.mark.parametrize("derivative", ["full", "diffuse", "frozen-b", "frozen"])
def test_81_comes_out_with_the_moment_matrix_carried_along(derivative: str) -> None:
    R = F(7, 4)
    printed = derivation.printed_geometric_part(R, S, derivative)
    assert derivation.pairwise_geometric_part(R, S, derivative) == printed
    rows = [row for row in links.stress_rows([R], S) if row["link"].startswith("(74) -> (81)")]
    assert [row["under"] for row in rows if row["comes_out"]] == ["B_I(x_K) varied as a function of x_K - x_I alone"]
