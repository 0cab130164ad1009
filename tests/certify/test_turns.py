"""Turns of the verdict: the isolated zeros against the whole linearisation, and functions of which the zeros are known."""

from fractions import Fraction

import pytest

from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.closed_relations import at_rest
from rkverify.certify.stress_range import ends_in_stress, stress_range
from rkverify.certify.turn_tables import agreement_rows
from rkverify.certify.turns import method_at_pi, pieces, printed_at_pi, signs
from rkverify.errors import BadInput
from rkverify.paper.notation import lattice_values
from rkverify.readings import Readings
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.lattice_state import Base
from rkverify.stability.layers import Setting, dispersion

F = Fraction
K = Exact()
KERNELS = ("cubic", "quartic", "quintic", "wendland-c2", "wendland-c4")


@pytest.mark.parametrize("kernel", ["cubic", "wendland-c4"])
@pytest.mark.parametrize("derivative", ["full", "diffuse"])
@pytest.mark.parametrize("R", ["7/5", "5/2"])
def test_the_function_is_the_linearisation(kernel: str, derivative: str, R: str) -> None:
    """One cell's gradients against every derivative of the equations: the same rational, without the stress."""
    s = F(1, 3)
    stencil = linearise(Base(R, Readings("dni", "none", derivative), s, kernel=kernel), K).stencil
    assert at_rest(stencil, K).at_pi == s * method_at_pi(F(R), K, kernel, derivative)


@pytest.mark.parametrize("derivative", ["full", "diffuse", "frozen-b", "frozen"])
def test_the_printed_function_is_that_of_the_notation(derivative: str) -> None:
    assert (
        printed_at_pi(F(7, 4), K, "cubic", derivative) == -4 * lattice_values(1, "7/4", K, "edge", derivative).Psi_xx_h
    )


@pytest.mark.decides("C49", "C60")
def test_the_verdict_turns_between_the_ends_of_the_enclosure() -> None:
    """10^-20 apart, the whole linearisation in exact rationals has opposite signs: the digits are certain."""
    ((zero, before, behind),) = signs(method_at_pi, "cubic", "full", F(2)).turns
    assert zero.high - zero.low <= F(1, 10**20)
    for R, sign in ((zero.low, before), (zero.high, behind)):
        value = at_rest(linearise(Base(R, Readings("dni", "none"), 1), K).stencil, K).at_pi
        assert (value > 0) - (value < 0) == sign


def test_a_measured_growth_turns_there() -> None:
    """Nothing of the search enters a simulation: in tension kh = pi grows below the turn and does not above it."""
    growth = [
        max(
            b.omega.growth
            for b in dispersion(
                Setting("semi-lagrangian", "dni", R, stress_ratio="1/2", layer="simulated", convective=False),
                [3.141592653589793],
            )
        )
        for R in ("1.55", "1.60")
    ]
    assert growth[0] > 0.1
    assert growth[1] < 1e-3


@pytest.mark.parametrize("kernel", KERNELS)
def test_with_the_diffuse_derivative_nothing_turns(kernel: str) -> None:
    found = signs(method_at_pi, kernel, "diffuse", F(4))
    assert found.signs[0] == -1
    assert found.turns == []


def _of_R(f):
    return lambda R, K, kernel, derivative: f(R)


def test_known_zeros_are_told_apart() -> None:
    """A double zero and one on a piece's end are found; only the sign's changes are turns."""
    found = signs(_of_R(lambda R: (2 * R - 3) ** 2 * (4 * R - 7) * (R - 2) * (R * R - 8)), "cubic", "full", F(3))
    assert [z.digits for z in found.zeros] == [
        "1.50000000000000",
        "1.75000000000000",
        "2.00000000000000",
        "2.82842712474619",
    ]
    assert found.signs == (-1, -1, 1, -1, 1)
    assert [float(z.low) for z in found.touches] == [1.5]
    assert len(found.turns) == 3
    assert [found.at(R) for R in (F(5, 4), F(8, 5), F(19, 10), F(5, 2), F(29, 10))] == [-1, -1, 1, -1, 1]


def test_a_pole_and_a_jump_are_refused() -> None:
    with pytest.raises(BadInput, match="pole"):
        signs(_of_R(lambda R: 1 / (2 * R - 3)), "cubic", "full", F(2))

    def jumping(R, K, kernel, derivative):
        return K.number(1 if K.sign(R - 2) > 0 else -1)

    with pytest.raises(BadInput, match="jumps"):
        signs(jumping, "cubic", "full", F(3))


def test_pieces_end_where_a_node_meets_a_joint() -> None:
    assert pieces("cubic", F(4)) == [(1, 2), (2, 3), (3, 4)]
    assert pieces("quartic", F(2)) == [(1, F(5, 3)), (F(5, 3), 2)]


@pytest.mark.decides("C49", "C60")
def test_signs_agree_with_the_print_for_the_diffuse_derivative_alone() -> None:
    same = {row["derivative"]: row["same"] for row in agreement_rows("cubic", ("full", "diffuse", "frozen"), F(2))}
    assert same == {"full": False, "diffuse": True, "frozen": False}


@pytest.mark.parametrize("R", ["3/2", "7/4", "5/2"])
def test_growth_starts_beyond_the_range_of_stress(R: str) -> None:
    """Just inside every kh is stable; just outside one is not: by eigenvalues in double precision."""
    found = stress_range(F(R))
    waves = [3.141592653589793 * j / 40 for j in range(1, 41)]

    def growth(s: Fraction) -> float:
        setting = Setting("semi-lagrangian", "dni", R, stress_ratio=s, layer="as-defined", convective=False)
        return max(b.omega.growth for b in dispersion(setting, waves))

    for end, outwards in ((found.lowest, -1), (found.highest, 1)):
        if end is not None:
            assert growth(end + outwards * F(1, 20)) > 1e-2
    middle = F(1) if found.highest is None else (found.lowest + found.highest) / 2
    assert growth(middle) < 1e-6


def test_ends_per_reading_as_functions_of_the_stress() -> None:
    """The stress law moves the turn of long waves; that of kh = pi stays at s = 0, with the same factor."""
    found = {
        law: ends_in_stress(Readings("dni", "none", "diffuse", law), F(13, 10))
        for law in ("truesdell", "cauchy-rate", "literal")
    }
    assert {law: str(long_wave) for law, (long_wave, _) in found.items()} == {
        "truesdell": "1 + s",
        "cauchy-rate": "1",
        "literal": "1 - s",
    }
    assert [long_wave.turn for long_wave, _ in found.values()] == [-1, None, 1]
    assert len({at_pi for _, at_pi in found.values()}) == 1
    assert {at_pi.turn for _, at_pi in found.values()} == {0}


def test_a_form_over_R_is_the_same_function() -> None:
    field = RationalFunctions({"R": "5/2"})
    form = method_at_pi(field.generator("R"), field, "cubic", "full")
    for R in (F(21, 10), F(29, 10)):
        moved = RationalFunctions({"R": R})
        assert moved.witness(form) == method_at_pi(R, K, "cubic", "full")
