"""The solutions to the exercises: each answer is held against what it must be for a reason of its own."""

from fractions import Fraction

import numpy as np
import pytest

from rkverify.stability.verdicts import NOTICED


def test_start_here(solutions) -> None:
    solved = solutions("start_here")
    assert [value == 0 for value in solved.exercise_1()] == [True, True, True, False]
    least = solved.exercise_2()
    # Two nodes must lie strictly nearer than the support: the largest distance to the second nearest node decides.
    places = np.array([float(Fraction(x)) for x in solved.NODES])
    second = np.sort(abs(np.linspace(0, 1, 4001)[:, None] - places), axis=1)[:, 1].max()
    assert least - Fraction(1, 20) <= second < least
    assert solved.dense_check(float(least))
    assert not solved.dense_check(float(least - Fraction(1, 20)))
    before, after, slope, slope_after = solved.exercise_3()
    assert after == before
    assert slope_after == {I: value / 2 for I, value in slope.items()}


def test_scni_and_dni_on_a_patch_test(solutions) -> None:
    solved = solutions("scni_and_dni_on_a_patch_test")
    rounding, seen = 1e-11, 1e-4  # the condition of the stiffness times rounding; an error of the method
    assert solved.exercise_1() > seen
    uniform, jittered = solved.exercise_2()
    assert seen < uniform < jittered
    linear, quadratic = solved.exercise_3()
    assert linear < rounding
    assert quadratic > seen


def test_lagrangian_and_semi_lagrangian_kernels(solutions) -> None:
    solved = solutions("lagrangian_and_semi_lagrangian_kernels")
    # The next column is one stretch away: it leaves when that is the support.
    assert solved.exercise_1(2.2) == pytest.approx(2.2, abs=1e-8)
    assert solved.exercise_1(2.6) == pytest.approx(2.6, abs=1e-8)
    assert solved.exercise_2() == [0, 0, 0]
    ratio, determinant = solved.exercise_3()
    assert ratio == pytest.approx(determinant, rel=1e-12)  # one linear map of one polygon: rounding alone


def test_the_convective_term(solutions) -> None:
    solved = solutions("the_convective_term")
    sums = solved.exercise_1()
    assert len({star for star, _ in sums.values()}) == len(sums)
    assert all(star != 0 and true == 0 for star, true in sums.values())
    without, with_velocity = solved.exercise_2()
    assert without == with_velocity
    assert solved.exercise_3() != 0


def test_von_neumann_in_four_layers(solutions) -> None:
    solved = solutions("von_neumann_in_four_layers")
    grows = solved.exercise_1()
    assert grows["1/2"] == {"printed": True, "as-defined": False, "consistent": False, "simulated": False}
    assert grows["-1/2"] == {"printed": False, "as-defined": True, "consistent": True, "simulated": True}
    # The growth at kh = pi of the notebook's figure, whose square this is: 0.7862 c/h.
    assert float(-solved.exercise_2()) ** 0.5 == pytest.approx(solved.growth(_dni()), rel=1e-12)
    assert all(omega < solved.NOTICED for omega in solved.exercise_3().values())


def _dni():
    from rkverify.stability.layers import Setting

    return Setting("semi-lagrangian", "dni", "3/2", "1/2", layer="as-defined")


def test_tensile_instability(solutions) -> None:
    from rkverify.certify import turns

    solved = solutions("tensile_instability")
    for digits in solved.exercise_1():
        around = [
            turns.method_at_pi(Fraction(digits) + step, turns.Exact(), "quintic", "full")
            for step in (Fraction(-1, 10**6), Fraction(1, 10**6))
        ]
        assert around[0] * around[1] < 0, "the sign turns there"
    found = solved.exercise_2()
    assert (found["quantity"], found["agrees"]) == ("frequency", True)
    assert found["measured"] > NOTICED
    assert set(solved.exercise_3().values()) == {0}


def test_certificates(solutions) -> None:
    solved = solutions("certificates")
    digits = solved.exercise_1()
    many = solved.frequency(60)
    certain = solved.frequency(digits)
    assert len(certain.lstrip("0.")) >= 20 > len(solved.frequency(digits - 1).lstrip("0."))
    # Right to one unit of the last place, as `certain_digits` says.
    unit = Fraction(1, 10 ** len(certain.partition(".")[2]))
    assert abs(Fraction(certain) - Fraction(many)) <= unit
    for low, high in solved.exercise_2():
        assert low < 0 < high
    assert "class C^0" in solved.exercise_3()
