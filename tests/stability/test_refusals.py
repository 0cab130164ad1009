"""Settings for which the paper prints no relation, and lattices that have none, are refused in our words."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from rkverify.arithmetic.native import Exact
from rkverify.errors import BadInput, NotDifferentiable, NotRepresentable, RkverifyError, TooFewNodes, UnknownName
from rkverify.readings import Readings
from rkverify.stability.lattice_state import Base
from rkverify.stability.layers import Setting, dispersion
from rkverify.stability.printed import gradients_are_odd, stencil_half_width

SEMI = Setting("semi-lagrangian", "scni", "3/2")
LAGRANGIAN = Setting("lagrangian", "scni", "3/2")


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        (replace(LAGRANGIAN, integration="dni"), "choose --integration scni"),
        (replace(LAGRANGIAN, velocity_gradient=1), "leave --velocity-gradient"),
        (replace(SEMI, stretch="11/10"), "leave --stretch out"),
        (replace(SEMI, spacing=0), "spacing .* must be positive"),
        (replace(SEMI, support_ratio=-1), "support ratio .* must be positive"),
        (replace(SEMI, support_ratio="wide"), "'wide' is not a finite number"),
        (replace(SEMI, derivative="diffuse", order=0), "raise the order"),
    ],
)
def test_what_the_paper_does_not_print_is_refused(setting: Setting, message: str) -> None:
    """Decides that no curve is drawn from a relation that the paper does not have; each message says what to change."""
    with pytest.raises(BadInput, match=message):
        dispersion(setting, [1.0])


@pytest.mark.parametrize("option", ["formulation", "integration", "layer", "half_point", "derivative"])
def test_unknown_options_are_refused_when_the_setting_is_made(option: str) -> None:
    with pytest.raises(UnknownName, match=f"unknown {option.split('_')[0]}.*'other'.*choose one of"):
        replace(SEMI, **{option: "other"})


@pytest.mark.parametrize(
    ("setting", "error"),
    [
        (replace(SEMI, kernel="other"), UnknownName),
        (replace(LAGRANGIAN, kernel="other"), UnknownName),
        (replace(SEMI, support_ratio=1), TooFewNodes),
        (replace(LAGRANGIAN, support_ratio="1/2"), TooFewNodes),
        (replace(SEMI, order=2), TooFewNodes),
        (replace(SEMI, kernel="tent"), NotDifferentiable),
    ],
)
def test_lattices_without_the_relation_are_refused(setting: Setting, error: type[RkverifyError]) -> None:
    with pytest.raises(error):
        dispersion(setting, [1.0])


def test_rationals_have_no_sines() -> None:
    with pytest.raises(NotRepresentable, match="float or mp:DIGITS"):
        dispersion(SEMI, [1], Exact())


@pytest.mark.parametrize("option", ["support_ratio", "stress_ratio", "stretch", "velocity_gradient", "spacing"])
@pytest.mark.parametrize("setting", [SEMI, LAGRANGIAN], ids=["semi-lagrangian", "lagrangian"])
@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_an_undefined_number_is_no_setting(setting: Setting, option: str, bad: float) -> None:
    """Decides that a curve without values is not drawn in silence: sign(nan) is 0, so that nan would pass for stable."""
    with pytest.raises(RkverifyError):
        dispersion(replace(setting, **{option: bad}), [1.0])


@pytest.mark.parametrize("bad", [math.nan, math.inf, "nan"])
def test_an_undefined_wave_number_is_refused(bad: object) -> None:
    for setting in (SEMI, LAGRANGIAN):
        with pytest.raises(BadInput):
            dispersion(setting, [bad])


def test_no_wave_numbers_no_branches() -> None:
    assert dispersion(SEMI, []) == dispersion(LAGRANGIAN, []) == []


def test_a_base_needs_a_kernel_that_can_be_linearised() -> None:
    """Said before anything is computed, with the kernels that can: a node between the joints would let the tent pass."""
    with pytest.raises(BadInput, match="kernel 'tent' is not of class C2"):
        Base("11/10", Readings("scni"), kernel="tent")
    assert Base("11/10", Readings("scni"), kernel="wendland-c2").kernel == "wendland-c2"


@pytest.mark.decides("C29")
@pytest.mark.parametrize("R", ["11/10", "3/2", "7/4", "2", "5/2", "14/5", "7/2"])
def test_the_printed_half_width_holds_every_gradient(R: str) -> None:
    """A cell |J| has a gradient where its inner edge (|J| - 1/2) h is within R h: |J| < R + 1/2, hence m of (61).

    Where R + 1/2 is an integer the last one is zero and m is one too large, which costs nothing; never too small.
    """
    m, real = stencil_half_width(R, Exact())
    reach = Fraction(R) + Fraction(1, 2)
    assert m == int(reach)
    assert real == (m - 1 if reach == m else m)


def test_gradients_on_the_lattice_are_odd() -> None:
    """Exactly; the reason why (61) may be read with I - J or I + J."""
    assert all(gradients_are_odd(R, Exact()) for R in ("11/10", "3/2", "2", "5/2", "7/2"))
