"""The printed relations follow from one another, or do not: by machine algebra with every value free."""

import pytest
import sympy

from rkverify.certify import consequences
from rkverify.certify.consequences import MODULUS, OMEGA, SIGMA, Q, Step, steps
from rkverify.paper import printed_semi_lagrangian as semi

STEPS = {step.name: step for step in steps()}
FOLLOW = {
    "(61) -> (63), m = 1", "(61) -> (63), m = 2", "(61) -> (63), m = 3",
    "(75) -> (76), plus", "(81) -> (82), plus",
    "(76) = (77) with (78)", "(82) = (83) with (84)",
    "(79) is the discriminant of (77)", "(85) is the discriminant of (83)",
    "(76) without its Q terms -> (86)", "(82) without its Q terms -> (87)",
}  # fmt: skip
DO_NOT = {"(75) -> (76), minus", "(81) -> (82), minus"}


def test_every_step_is_listed_here() -> None:
    assert STEPS.keys() == FOLLOW | DO_NOT


@pytest.mark.decides(
    "E63", "E76", "E77", "E78", "E79", "E82", "E83", "E84", "E85", "E86", "E87", "C31", "C38", "C48", "C54"
)
@pytest.mark.parametrize("name", sorted(FOLLOW))
def test_the_step_follows(name: str) -> None:
    """Nothing is left for all values of all symbols: decides the step, whatever the kernel, R and the readings are."""
    assert STEPS[name].follows
    assert STEPS[name].residual == 0


@pytest.mark.decides("E62")
@pytest.mark.parametrize("name", sorted(DO_NOT))
def test_the_other_sign_of_the_plane_wave_does_not(name: str) -> None:
    """e^{i(kx - omega t)} leaves the term linear in Q and omega with twice its size: decides how to read (62)."""
    residual = STEPS[name].residual
    assert not STEPS[name].follows
    assert residual != 0
    assert sympy.expand(residual.subs(Q, 0)) == 0
    B = semi.linear_coefficient(consequences.VALUES, consequences.STATE, consequences.KH, consequences.K)
    assert consequences.reduced(residual - 2 * B * OMEGA) * consequences.reduced(residual + 2 * B * OMEGA) == 0


def test_a_step_with_anything_left_does_not_follow() -> None:
    assert Step("nothing", sympy.Integer(0)).follows
    assert not Step("something", SIGMA - MODULUS).follows


@pytest.mark.parametrize("m", [1, 2, 3])
@pytest.mark.decides("C34", "C67")
def test_the_lagrangian_relation_is_a_square(m: int) -> None:
    assert consequences.lagrangian_as_square(m) == 0


@pytest.mark.decides("E59", "C27")
def test_the_tangent_is_the_derivative_of_the_stress() -> None:
    assert consequences.lagrangian_tangent() == 0


@pytest.mark.parametrize("wrong", ["C", "A"])
def test_machine_algebra_sees_a_wrong_sign(wrong: str) -> None:
    """The twin: C and A with the sign of the convective part turned are caught, so that a zero above means something."""
    K, KH, s, q = consequences.K, consequences.KH, consequences.VALUES, consequences.STATE
    constant = (semi.scni_constant if wrong == "C" else semi.dni_constant)(s, q, KH, K)
    turned = constant - 2 * constant.subs({MODULUS: -SIGMA}).subs(SIGMA, 0)
    relation = (semi.scni_relation if wrong == "C" else semi.dni_relation)(s, q, KH, OMEGA, K)
    B = semi.linear_coefficient(s, q, KH, K)
    assert consequences.reduced(relation - semi.quadratic(B, constant, OMEGA)) == 0
    assert consequences.reduced(relation - semi.quadratic(B, turned, OMEGA)) != 0
