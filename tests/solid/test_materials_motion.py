"""Stress follows rotations, cycles and closed forms: what tells one law from another where small strains cannot.

Decides objectivity, which a law in the wrong stress measure or with the wrong spin loses, and energy on closed paths.
"""

from itertools import pairwise

import numpy as np
import pytest

from rkverify.solid.materials.incremental import Incremental
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.law import Hyperelastic, Law, State
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.small_strain import SmallStrain
from rkverify.solid.materials.truesdell import Truesdell

MODULI = Moduli(1.25, 0.75)
OBJECTIVE = [SaintVenantKirchhoff(MODULI), NeoHookean(MODULI)]
RATES = [Jaumann(MODULI), Truesdell(MODULI)]
ROUNDING = 200 * 2.0**-52  # products of 3 x 3 matrices near 1, a few dozen operations each


def turn(angle: float, dimension: int = 2) -> np.ndarray:
    Q = np.eye(dimension)
    Q[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    if dimension == 3:
        c, s = np.cos(angle / 3), np.sin(angle / 3)
        Q = Q @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return Q


def gradients(dimension: int) -> np.ndarray:
    rng = np.random.default_rng(dimension)
    return np.eye(dimension) + 0.3 * rng.uniform(-1, 1, (9, dimension, dimension))


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("law", OBJECTIVE, ids=lambda law: type(law).__name__)
def test_hyperelastic_stress_turns_with_the_body(law: Hyperelastic, dimension: int) -> None:
    """W(Q F) = W(F), P(Q F) = Q P(F), sigma(Q F) = Q sigma Q^T."""
    F, Q = gradients(dimension), turn(2.1, dimension)
    state, turned = law.advance(F), law.advance(Q @ F)
    scale = abs(state.sigma).max() + MODULI.shear
    np.testing.assert_allclose(law.energy(Q @ F), law.energy(F), rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(turned.P, Q @ state.P, rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(turned.cauchy, Q @ state.cauchy @ Q.T, rtol=0, atol=ROUNDING * scale)


def test_linear_elasticity_does_not_turn() -> None:
    """The twin: the small strain of a rotation by 0.1 is cos(0.1) - 1 in place of 0, and makes a stress."""
    sigma = LinearElastic(MODULI).advance(turn(0.1)[None]).cauchy[0]
    pressure = 2 * (MODULI.lame + MODULI.shear) * (np.cos(0.1) - 1)
    np.testing.assert_allclose(sigma, pressure * np.eye(2), rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("law", RATES, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("angle", [0.01, 1.0, 3.0, -2.5])
def test_a_step_that_turns_turns_the_stress(law: Incremental, dimension: int, angle: float) -> None:
    """Incremental objectivity: sigma = Q sigma_old Q^T exactly, however far one step turns below half a turn."""
    before = law.advance(gradients(dimension), law.start(9, dimension))
    Q = turn(angle, dimension)
    after = law.advance(Q @ before.F, before)
    # (H + 1)^-1 amplifies rounding as the turn comes near half a turn: 1/(1 + cos) = 100 at 3.0.
    allowed = ROUNDING * abs(before.sigma).max() * 4 / (1 + np.cos(angle))
    np.testing.assert_allclose(after.cauchy, Q @ before.cauchy @ Q.T, rtol=0, atol=allowed)


def test_small_strain_increments_do_not_turn() -> None:
    law = SmallStrain(MODULI)
    before = law.advance(gradients(2), law.start(9, 2))
    after = law.advance(turn(1.0) @ before.F, before)
    assert abs(after.cauchy - turn(1.0) @ before.cauchy @ turn(1.0).T).max() > 0.1


def shear(gamma: float) -> np.ndarray:
    return np.array([[[1.0, gamma], [0.0, 1.0]]])


def sheared(law: Law, gamma: float, steps: int) -> State:
    state = law.start(1, 2)
    for n in range(1, steps + 1):
        state = law.advance(shear(gamma * n / steps), state)
    return state


@pytest.mark.parametrize("gamma", [1.0, np.pi / 2, 3.0, 6.0])
def test_simple_shear_with_the_jaumann_rate_oscillates(gamma: float) -> None:
    """sigma_12 = mu sin gamma, sigma_11 = mu (1 - cos gamma): reached with the square of the step, from Dienes' solution."""
    mu, errors = MODULI.shear, []
    exact = mu * np.array([[1 - np.cos(gamma), np.sin(gamma)], [np.sin(gamma), np.cos(gamma) - 1]])
    for steps in (40, 80, 160):
        errors.append(abs(sheared(Jaumann(MODULI), gamma, steps).cauchy[0] - exact).max())
    # Order 2 with a next term of relative size (gamma/steps)^2/12 or so, below 0.2 % here.
    assert 3.9 < errors[0] / errors[1] < 4.1
    assert 3.9 < errors[1] / errors[2] < 4.1


@pytest.mark.parametrize("steps", [1, 3, 50])
@pytest.mark.parametrize("gamma", [1.0, 3.0, 6.0])
def test_simple_shear_with_the_truesdell_rate_does_not(gamma: float, steps: int) -> None:
    """sigma_12 = mu gamma, sigma_11 = mu gamma^2, sigma_22 = 0: exact in any number of steps."""
    found = sheared(Truesdell(MODULI), gamma, steps).cauchy[0]
    exact = MODULI.shear * np.array([[gamma**2, gamma], [gamma, 0.0]])
    np.testing.assert_allclose(found, exact, rtol=0, atol=steps * ROUNDING * gamma**2)


@pytest.mark.parametrize(
    ("law", "exact"),
    [
        (Jaumann(MODULI), lambda C, J: C * np.log(J)),
        (Truesdell(MODULI), lambda C, J: C * (J - 1)),
    ],
    ids=["Jaumann", "Truesdell"],
)
def test_one_dimension_is_the_papers_stress_law(law: Incremental, exact) -> None:
    """sigma' = C L gives C ln J; sigma' = (C + sigma) L gives C (J - 1): the readings `cauchy-rate` and `truesdell`."""
    C, J, errors = MODULI.lame + 2 * MODULI.shear, 1.8, []
    for steps in (20, 40):
        state = law.start(1, 1)
        for n in range(1, steps + 1):
            state = law.advance(np.array([[[1 + (J - 1) * n / steps]]]), state)
        errors.append(abs(state.cauchy.item() - exact(C, J)))
    assert 3.9 < errors[0] / errors[1] < 4.1


def circle(steps: int) -> list[np.ndarray]:
    """A closed path of stretches and shears that begins and ends at F = 1."""
    t = np.linspace(0, 2 * np.pi, steps + 1)
    return [np.array([[[1 + 0.3 * (1 - np.cos(s)), 0.5 * np.sin(s)], [0.0, 1.0]]]) for s in t]


def work(law: Law, steps: int) -> tuple[float, State]:
    """The integral of P : dF on the path, by the trapezoid rule, and the state at its end."""
    path = circle(steps)
    state, total = law.start(1, 2), 0.0
    for old, F in pairwise(path):
        after = law.advance(F, state)
        total += float(((state.P + after.P) / 2 * (F - old)).sum())
        state = after
    return total, state


@pytest.mark.parametrize("law", OBJECTIVE, ids=lambda law: type(law).__name__)
def test_no_work_is_left_on_a_closed_path(law: Hyperelastic) -> None:
    """The trapezoid rule on a closed smooth path converges faster than any power, so that 200 steps leave rounding."""
    total, end = work(law, 200)
    assert abs(total) < 200 * ROUNDING
    assert abs(end.P).max() < ROUNDING


def test_the_jaumann_rate_makes_work_on_a_closed_path() -> None:
    """The twin: a hypoelastic cycle ends with a stress and with work, both of which stay as the steps get finer."""
    coarse, fine = work(Jaumann(MODULI), 200), work(Jaumann(MODULI), 400)
    for total, end in (coarse, fine):
        assert abs(total) > 1e-3
        assert abs(end.cauchy).max() > 1e-2
    assert abs(fine[0] / coarse[0] - 1) < 1e-2


def test_objectivity_under_superposed_turns_only_to_third_order_for_jaumann() -> None:
    """Where exactness stops: with strain and a superposed turn in one step, the update errs by h^3."""
    law, errors = Jaumann(MODULI), []
    before = law.advance(gradients(2), law.start(9, 2))
    A = np.array([[0.4, -0.3], [0.2, 0.1]])
    for h in (0.2, 0.1, 0.05):
        plain = law.advance((np.eye(2) + h * A) @ before.F, before)
        Q = turn(h)
        turned = law.advance(Q @ (np.eye(2) + h * A) @ before.F, before)
        errors.append(abs(turned.cauchy - Q @ plain.cauchy @ Q.T).max())
    assert errors[2] > 1e-6
    assert 7 < errors[1] / errors[2] < 9
