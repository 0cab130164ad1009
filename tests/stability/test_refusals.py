"""Settings for which the paper prints no relation, and lattices that have none, are refused in our words."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from rkverify.arithmetic.native import Exact
from rkverify.errors import BadInput, NotDifferentiable, NotRepresentable, RkverifyError, TooFewNodes, UnknownName
from rkverify.readings import Readings
from rkverify.solid.sph import SphForm
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.lagrangian import StretchedBar
from rkverify.stability.lattice_state import Base
from rkverify.stability.layers import Setting, dispersion
from rkverify.stability.printed import gradients_are_odd, stencil_half_width
from rkverify.stability.sph import SphBase

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


def test_what_is_not_said_is_rest_without_stress_in_unit_spacing() -> None:
    """A default is a statement: the relation of a setting that leaves it out is that of these values and of no others."""
    assert Base("3/2", Readings("scni")) == Base("3/2", Readings("scni"), 0, 0, 1, 0, "cubic", 1, 1)
    assert Base("3/2", Readings("scni")).is_at_rest(Exact())
    assert StretchedBar("3/2", "scni") == StretchedBar("3/2", "scni", 0, 1, 1, "full", "cubic", 1, "lumped")
    assert SphBase(SphForm(), "3/2") == SphBase(SphForm(), "3/2", 0, 0, "cubic")
    assert Scheme("dni", 1.5) == Scheme("dni", 1.5, None, "full", "edges", "cubic", 1, "radial")
    assert Setting("semi-lagrangian", "scni", "3/2", 0, 1, 0, 1, 0, True, "edge", order=1, layer="printed") == SEMI


@pytest.mark.parametrize(("Q", "V", "motion", "still"), [(0, 0, "coefficient", True), ("1/9", 0, "coefficient", False), (0, "-1/9", "coefficient", False), (0, 0, "field", False)])  # fmt: skip
def test_rest_is_no_motion_of_the_base_nor_of_nodes_with_a_field(
    Q: object, V: object, motion: str, still: bool
) -> None:
    base = Base("3/2", Readings("scni", node_motion=motion), 0, Q, 1, V)
    assert base.is_at_rest(Exact()) == still


@pytest.mark.parametrize(
    ("R", "cells", "nodes"), [("11/10", 2, 5), ("3/2", 3, 6), ("7/4", 3, 6), ("2", 3, 7), ("5/2", 4, 8)]
)
def test_the_reach_of_an_equation(R: str, cells: int, nodes: int) -> None:
    """int(R + 1/2) + 1 cells see the node, and their edges see nodes int(R) + 2 farther."""
    assert Base(R, Readings("scni")).reach(Exact()) == (cells, nodes)
