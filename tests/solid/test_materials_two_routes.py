"""`paper/constitutive` and `solid/materials` import nothing from each other: stresses, rates and plastic flow agree.

The transcription gives nominal stresses and rate equations at one point, in rationals or doubles; the vectorised laws give first
Piola-Kirchhoff stresses and finite steps, whose derivative at the start of a step is the rate.
"""

import numpy as np
import pytest

from rkverify.arithmetic.native import Float
from rkverify.paper import constitutive as literal
from rkverify.solid.materials.incremental import Incremental
from rkverify.solid.materials.j2 import J2
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.kinematics import cauchy_stress
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.small_strain import SmallStrain
from rkverify.solid.materials.truesdell import Truesdell

K = Float()
MODULI, C = Moduli(1.25, 0.75), literal.Moduli(1.25, 0.75)
ROUNDING = 200 * 2.0**-52  # a few dozen operations on numbers near 1


def gradients(dimension: int, seed: int = 1) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return np.eye(dimension) + 0.3 * rng.uniform(-1, 1, (5, dimension, dimension))


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize(
    ("law", "nominal", "energy"),
    [
        (SaintVenantKirchhoff(MODULI), literal.saint_venant_kirchhoff, literal.saint_venant_kirchhoff_energy),
        (LinearElastic(MODULI), literal.linear, literal.linear_energy),
        (NeoHookean(MODULI), literal.neo_hookean, lambda F, C, K: literal.neo_hookean_energy(F, C, np.log)),
    ],
    ids=["St. Venant-Kirchhoff", "linear", "neo-Hookean"],
)
def test_stress_and_energy_agree(law, nominal, energy, dimension: int) -> None:
    """The one is the transpose of the other."""
    F = gradients(dimension)
    P, W = law.stress(F), law.energy(F)
    for point, each in enumerate(F.tolist()):
        np.testing.assert_allclose(np.transpose(nominal(each, C, K)), P[point], rtol=0, atol=ROUNDING)
        np.testing.assert_allclose(energy(each, C, K), W[point], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_cauchy_stress_agrees_with_24(dimension: int) -> None:
    F = gradients(dimension)
    P = NeoHookean(MODULI).stress(F)
    for point, sigma in enumerate(cauchy_stress(P, F).tolist()):
        back = literal.nominal_stress(F[point].tolist(), sigma, K)
        np.testing.assert_allclose(np.transpose(back), P[point], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize(
    ("law", "rate"),
    [(Jaumann(MODULI), literal.jaumann_rate), (Truesdell(MODULI), literal.truesdell_rate)],
    ids=["Jaumann", "Truesdell"],
)
def test_the_first_derivative_of_a_step_is_the_rate(law: Incremental, rate) -> None:
    """By complex step along L F from a state with stress: at the start of a step the update is the rate equation."""
    rng = np.random.default_rng(4)
    state = law.advance(gradients(3), law.start(5, 3))
    L = rng.uniform(-1, 1, (5, 3, 3))
    after = law.advance((np.eye(3) + 1e-30j * L) @ state.F, state)
    for point in range(5):
        expected = rate(state.cauchy[point].tolist(), L[point].tolist(), C, K)
        np.testing.assert_allclose(after.cauchy[point].imag / 1e-30, expected, rtol=0, atol=ROUNDING)


def test_plastic_flow_is_the_rate_of_j2() -> None:
    """From a state just beyond yield; the yield stress is a part in 1e9 too low, so that every point flows."""
    low = 1 - 1e-9
    elastic = SmallStrain(MODULI)
    loaded = J2(elastic, 0.1, 0.3).advance(gradients(3), elastic.start(5, 3))
    assert (loaded.alpha > 0).all()
    D = np.random.default_rng(5).uniform(-1, 1, (5, 3, 3))
    D += np.swapaxes(D, 1, 2)
    strength = 0.1 + 0.3 * loaded.alpha
    for point in range(5):
        law = J2(elastic, low * strength[point], 0.3)
        state = type(loaded)(*(a[[point]] for a in (loaded.F, loaded.P, loaded.sigma)), np.zeros(1))
        after = law.advance(state.F + 1e-30j * D[[point]], state)
        expected = literal.plastic_rate(state.sigma[0].tolist(), D[point].tolist(), C, 0.3, K)
        # q is above the yield stress by 1e-9 of it, which the return and its slope see.
        np.testing.assert_allclose(after.sigma[0].imag / 1e-30, expected, rtol=0, atol=2e-8)
        assert after.alpha[0].real > 0


def test_a_step_along_the_yield_surface_is_elastic() -> None:
    """The twin: where D unloads, s : D < 0, the rate of plastic flow is not the law's; C : D is."""
    law = J2(SmallStrain(MODULI), 0.1, 0.3)
    loaded = law.advance(gradients(3), law.start(5, 3))
    back = 1e-6 * (np.eye(3) - loaded.F)
    after = law.advance(loaded.F + back, loaded)
    np.testing.assert_allclose(after.sigma - loaded.sigma, MODULI.of(back), rtol=0, atol=ROUNDING)
