"""J2 plasticity: the return lands on the yield surface along its normal, unloading is elastic, and known solutions come out.

Decides that the update is the closest-point projection and no other map onto the surface.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rkverify.errors import BadInput
from rkverify.solid.materials.incremental import Incremental
from rkverify.solid.materials.j2 import J2, deviator, mises_stress
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.law import State
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.small_strain import SmallStrain
from rkverify.solid.materials.truesdell import Truesdell

MODULI = Moduli(1.25, 0.75)
YIELD, HARDENING = 0.01, 0.05
LAWS = [
    J2(elastic, YIELD, H)
    for elastic in (SmallStrain(MODULI), Jaumann(MODULI), Truesdell(MODULI))
    for H in (0.0, HARDENING)
]
# q and the strength are sums of a dozen products of trial stresses below 1.
ROUNDING = 50 * 2.0**-52


def names(law: J2) -> str:
    return f"{type(law.elastic).__name__}, H = {law.hardening:g}"


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("law", LAWS, ids=names)
@given(st.integers(0, 10**6))
def test_no_stress_leaves_the_yield_surface(law: J2, dimension: int, seed: int) -> None:
    """Along a random path of eight steps: f <= 0 always, f = 0 where alpha grows, alpha never falls."""
    rng = np.random.default_rng(seed)
    state = law.start(5, dimension)
    for _ in range(8):
        F = state.F + 0.02 * rng.uniform(-1, 1, state.F.shape)
        after = law.advance(F, state)
        f = law.yield_function(after)
        assert f.max() <= ROUNDING
        grows = after.alpha > state.alpha
        assert (after.alpha >= state.alpha).all()
        assert abs(f[grows]).max(initial=0) <= ROUNDING
        state = after


@pytest.mark.parametrize("law", LAWS, ids=names)
def test_the_return_is_the_closest_point(law: J2) -> None:
    """The plastic strain C^-1 : (trial - sigma) is 3/2 s/q dalpha: along the normal, without volume."""
    F = np.eye(3) + 0.1 * np.random.default_rng(2).uniform(-1, 1, (6, 3, 3))
    state = law.start(6, 3)
    trial, after = law.elastic.predicted(F, state), law.advance(F, state)
    gap = trial - after.sigma
    strain = deviator(gap) / (2 * MODULI.shear)
    q = mises_stress(after.sigma)[:, None, None]
    assert (after.alpha > 0).all()
    np.testing.assert_allclose(np.trace(gap, axis1=1, axis2=2), 0, rtol=0, atol=ROUNDING)
    # Divided by q = 0.01, of which rounding of trial stresses near 0.3 is a part.
    np.testing.assert_allclose(
        strain, 1.5 * deviator(after.sigma) / q * after.alpha[:, None, None], rtol=0, atol=ROUNDING / YIELD
    )


@pytest.mark.parametrize("law", LAWS, ids=names)
def test_unloading_is_elastic(law: J2) -> None:
    """A step back from the yield surface is the elastic law's own step, to the last bit, and alpha stays."""
    loaded = law.advance(np.array([[[1.05, 0.04], [0.0, 0.97]]]), law.start(1, 2))
    F = loaded.F + 0.05 * (np.eye(2) - loaded.F)
    back, elastic = law.advance(F, loaded), law.elastic.advance(F, loaded)
    assert loaded.alpha > 0
    assert back.alpha == loaded.alpha
    assert (back.sigma == elastic.sigma).all()


def test_uniaxial_strain_has_its_closed_form() -> None:
    """sigma_11 = kappa eps + 2/3 q with q = 2 mu eps - 3 mu alpha = sigma_y + H alpha beyond yield, in any number of steps."""
    law, eps = J2(SmallStrain(MODULI), YIELD, HARDENING), 0.03
    mu = MODULI.shear
    alpha = (2 * mu * eps - YIELD) / (3 * mu + HARDENING)
    exact = MODULI.bulk * eps + 2 / 3 * (YIELD + HARDENING * alpha)
    for steps in (1, 7):
        state = law.start(1, 1)
        for n in range(1, steps + 1):
            state = law.advance(np.array([[[1 + eps * n / steps]]]), state)
        assert abs(state.sigma[0, 0, 0] - exact) < steps * ROUNDING
        assert abs(state.alpha[0] - alpha) < steps * ROUNDING


def test_a_closed_cycle_dissipates_sigma_y_times_alpha() -> None:
    """Work of a closed cycle in small strain, less the energy left, is int sigma_y dalpha: never negative, and that value.

    With the trapezoid rule the error falls with the square of the step except where flow begins, which costs one order.
    """
    law, errors = J2(SmallStrain(MODULI), YIELD, HARDENING), []
    for steps in (400, 1600):
        state, work = law.start(1, 2), 0.0
        for n in range(1, steps + 1):
            s = 2 * np.pi * n / steps
            F = np.array([[[1 + 0.02 * np.sin(s), 0.03 * (1 - np.cos(s))], [0.0, 1.0]]])
            after = law.advance(F, state)
            work += float(((state.P + after.P) / 2 * (F - state.F)).sum())
            state = after
        dissipated = work - float(law.stored_energy(state)[0])
        assert state.alpha[0] > 0.01
        assert dissipated > 0
        errors.append(abs(dissipated / (YIELD * float(state.alpha[0])) - 1))
    assert errors[1] < errors[0] / 3.5
    assert errors[1] < 0.01


def turned(Q: np.ndarray, state: State) -> tuple[np.ndarray, np.ndarray]:
    return Q @ state.F, Q @ state.cauchy @ Q.T


@pytest.mark.parametrize("elastic", [Jaumann(MODULI), Truesdell(MODULI)], ids=lambda law: type(law).__name__)
def test_a_turn_leaves_the_plastic_state(elastic: Incremental) -> None:
    """A stress on the yield surface is turned and stays on it: alpha does not grow by more than rounding."""
    law = J2(elastic, YIELD, HARDENING)
    loaded = law.advance(np.array([[[1.05, 0.04], [0.0, 0.97]]]), law.start(1, 2))
    c, s = np.cos(1.1), np.sin(1.1)
    Q = np.array([[c, -s], [s, c]])
    F, sigma = turned(Q, loaded)
    after = law.advance(F, loaded)
    np.testing.assert_allclose(after.cauchy, sigma, rtol=0, atol=ROUNDING)
    assert after.alpha - loaded.alpha < ROUNDING / MODULI.shear


def test_a_step_in_two_halves_is_not_one_step() -> None:
    """Where exactness stops: off a radial path the return of one step is not that of two, which differ by the step squared."""
    law = J2(SmallStrain(MODULI), YIELD)
    loaded = law.advance(np.array([[[1.05, 0.0], [0.0, 1.0]]]), law.start(1, 2))
    gaps = []
    for h in (0.004, 0.002):
        F = loaded.F + h * np.array([[0.0, 1.0], [1.0, 0.0]])
        one = law.advance(F, loaded)
        two = law.advance(F, law.advance((loaded.F + F) / 2, loaded))
        gaps.append(abs(one.sigma - two.sigma).max())
    assert gaps[1] > 1e-6
    assert 3 < gaps[0] / gaps[1] < 5


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: J2(SmallStrain(MODULI), 0.0), r"^yield stress 0: it must be positive"),
        (lambda: J2(SmallStrain(MODULI), 1.0, -3.0), r"^hardening -3: it must be above -3 mu = -2.25$"),
        (lambda: Moduli(-1.0, 1.0), r"^lambda = -1, mu = 1: give a positive mu"),
    ],
)
def test_parameters_that_no_material_has_are_refused(make, told: str) -> None:
    with pytest.raises(BadInput, match=told):
        make()
