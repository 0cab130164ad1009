"""Closed forms by machine algebra against the same linearisation in numbers: a slip in either would show.

Rational functions are compared with exact rationals and with many digits, at support ratios that were not the sample.
"""

from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
import sympy

from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify import closed_relations, derivation, links
from rkverify.certify.closed_forms import (
    convective_part,
    geometric_factor,
    largest_error,
    random_ratios,
    stencil_over_kernel_values,
    stencil_over_R,
    together,
    values_over_R,
)
from rkverify.certify.kernel_forms import in_kernel_values, names_of_kernel
from rkverify.errors import BadInput
from rkverify.kernels import kernel
from rkverify.readings import Readings
from rkverify.stability.lattice_state import Base

F = Fraction
S, Q = F(1, 3), F(1, 5)
SCNI = Readings("scni", "none")
forms_of_ratio, in_values = cache(stencil_over_R), cache(stencil_over_kernel_values)
"""Each takes seconds, and several tests look at the same ones."""


@pytest.mark.parametrize(("side", "low"), [("low", 101), ("high", 151)])
@pytest.mark.parametrize(
    "readings", [Readings("dni", "none"), Readings("dni", "none", "diffuse"), Readings("scni", "true")]
)
def test_the_forms_are_the_linearisation_at_forty_digits(readings: Readings, side: str, low: int) -> None:
    rng = np.random.default_rng(7)
    ratios = [F(int(n), 100) for n in rng.choice(np.arange(low, low + 48), size=4, replace=False)]
    assert largest_error(readings, side, ratios, S, Q, 40, forms_of_ratio(readings, side)[0]) < 1e-40


def test_beyond_their_range_they_are_not() -> None:
    """At R > 3/2 a cell edge sees four nodes: the form of the lower range is then another function."""
    assert largest_error(SCNI, "low", [F(8, 5)], S, Q, 40, forms_of_ratio(SCNI, "low")[0]) > 1e-3


@pytest.mark.parametrize("derivative", ["full", "diffuse"])
def test_the_kernels_values_give_the_same_factor(derivative: str) -> None:
    """With the cubic kernel's values put in, the form for any kernel is the one for the cubic."""
    readings = Readings("dni", "none", derivative)
    of_R = geometric_factor(*forms_of_ratio(readings, "high"))
    of_values = geometric_factor(*in_values(readings, "high"))
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
        geometric_factor(*forms_of_ratio(SCNI, "high"))


def test_decisions_are_recorded() -> None:
    """Every decision says where the form holds; all of them keep their sign between R = 3/2 and 2."""
    _, field = forms_of_ratio(SCNI, "high")
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
@pytest.mark.parametrize("R", [F(11, 10), F(7, 4)])
def test_81_comes_out_with_the_moment_matrix_carried_along_and_only_then(R: Fraction) -> None:
    """The slope of B_I is taken by duals with the lattice fixed: nothing of the print enters the rebuilt stencil."""
    rows = [row for row in links.stress_rows([R], S) if row["link"] == "(74) -> (81)"]
    found = {row["under"].rpartition("alone; ")[2] for row in rows if row["comes_out"]}
    assert all("alone" in row["under"] for row in rows if row["comes_out"])
    assert found == {
        f"{rest}, measure {measure}"
        for derivative in ("full", "diffuse")
        for rest, measure in ((f"cauchy-rate, {derivative}", "edges"), (f"truesdell, {derivative}", "fixed"))
    }


@pytest.mark.decides("E76", "E82")
@pytest.mark.parametrize("convection", ["psi-star", "true"])
@pytest.mark.parametrize(
    "change", [{}, {"node_motion": "field"}, {"mass": "consistent"}, {"support_radius": "spacing"}]
)
def test_no_reading_gives_the_printed_terms_of_n(convection: str, change: dict[str, str]) -> None:
    """Among them the rates of the velocities, odd in the shift in print, even in the equations, whatever the reading."""
    for R in (F(3, 2), F(7, 4)):
        printed = derivation.printed_convective_part(R, Q).velocity
        velocity = derivation.linearise(Base(R, Readings("scni", convection, **change), 0, Q), Exact()).stencil[
            "v", "v"
        ]
        assert {n: -c for n, c in velocity.items()} != printed
        assert all(printed.get(-n) == -c for n, c in printed.items())
        assert all(velocity.get(-n, 0) == c for n, c in velocity.items())


def test_the_forms_hold_wherever_no_decision_changes() -> None:
    """Rational functions that come from the same decisions are one function: this is the proof for every R of a range."""
    ranges = {}
    for readings, side in ((Readings("dni", "none"), "low"), (SCNI, "low"), (SCNI, "high")):
        ranges[readings.integration, side] = closed_relations.domain(forms_of_ratio(readings, side)[1])
    assert ranges == {("dni", "low"): (1, 2), ("scni", "low"): (1, F(3, 2)), ("scni", "high"): (F(3, 2), 2)}


def test_a_decision_on_two_generators_gives_no_range() -> None:
    K = RationalFunctions({"R": "3/2", "s": "1/7"})
    K.sign(K.generator("R") - K.generator("s"))
    with pytest.raises(BadInput, match="more than R"):
        closed_relations.domain(K)
    with pytest.raises(BadInput, match="rational"):
        closed_relations.domain(RationalFunctions({"R": "3/2"}))


@pytest.mark.decides("E86", "E87", "C59")
@pytest.mark.parametrize(
    ("readings", "side", "geometric", "square"),
    [
        (Readings("dni", "none"), "low", True, False),
        (Readings("dni", "none", "diffuse"), "high", True, False),
        (SCNI, "low", True, True),
        (SCNI, "high", False, True),
    ],
)
def test_relations_at_rest_are_identities(readings: Readings, side: str, geometric: bool, square: bool) -> None:
    """Each relation holds as an identity where it should, and fails as one where the other holds."""
    stencil, field = forms_of_ratio(readings, side)
    found, s = closed_relations.at_rest(stencil, field), field.generator("s")
    assert closed_relations.is_sine_and_geometric_factor(found, s) == geometric
    assert closed_relations.is_square_of_gradient(found, stencil, s) == square
    assert found.long_wave == 1 + s
    assert (found.at_pi == 0) == (readings.integration == "scni")


def test_omega_squared_needs_an_even_stencil_that_rests_under_a_translation() -> None:
    K = Exact()
    assert closed_relations.over_one_minus_cosine({-1: F(1), 0: F(-2), 1: F(1)}, K) == [2]
    with pytest.raises(BadInput, match="even"):
        closed_relations.over_one_minus_cosine({-1: F(-1), 1: F(1)}, K)
    with pytest.raises(BadInput, match="uniform"):
        closed_relations.over_one_minus_cosine({0: F(-1)}, K)


@pytest.mark.decides("E76", "E82")
@pytest.mark.parametrize("convection", ["psi-star", "true"])
def test_in_motion_the_cubic_has_the_factor_lambda_less_Q(convection: str) -> None:
    """The stress is a state of its own and adds exactly the root Q; what is left is a quadratic with a real b."""
    stress, field = forms_of_ratio(Readings("dni", "none"), "low")
    N, _ = convective_part(convection, "low", forms_of_ratio)
    kind = closed_relations.in_motion(together(stress, N, field), N, field)
    assert (kind.factors, kind.even, kind.galilean) == (True, True, convection == "true")
    law, field = forms_of_ratio(Readings("dni", "none", "diffuse", "cauchy-rate"), "low")
    assert not closed_relations.in_motion(together(law, N, field), N, field).factors


def test_what_N_adds_knows_nothing_of_integration_and_derivative() -> None:
    """Taken with the diffuse derivative below R = 3/2, it completes SCNI and DNI on both sides."""
    N, _ = convective_part("psi-star", "low", forms_of_ratio)
    for readings, side, R in ((SCNI, "high", F(17, 10)), (Readings("dni", "none"), "low", F(19, 10))):
        stress, field = forms_of_ratio(readings, side)
        whole, with_N = together(stress, N, field), replace(readings, convection="psi-star")
        assert largest_error(with_N, side, [R], S, Q, 40, whole) < 1e-40
        assert largest_error(with_N, side, [R], S, Q, 40, stress) > 1e-3


@pytest.mark.parametrize("convection", ["psi-star", "true"])
def test_forms_in_kernel_values_are_those_over_R(convection: str) -> None:
    """Psi* takes phi' itself, not phi'/z: with the cubic kernel's values put in both forms are the same rational."""
    functions, _ = convective_part(convection, "low", forms_of_ratio)
    named, _ = convective_part(convection, "low", in_values)
    z = F(5, 7)
    values = names_of_kernel("cubic", z) | {"Q": sympy.Rational(1, 5)}
    at = values_over_R(functions, S, F(1, 5))(1 / z)
    for key, coefficients in named.items():
        for n, form in coefficients.items():
            exact = in_kernel_values(form.as_expr()).subs(values)
            assert F(int(exact.p), int(exact.q)) == at[key][n]


def test_random_ratios_are_inside_their_range() -> None:
    drawn = random_ratios("high", 50, 3)
    assert len(set(drawn)) == 50
    assert all(F(3, 2) < R < 2 for R in drawn)
    assert random_ratios("high", 50, 3) == drawn
