"""Stress and tangent of every law are the derivatives that they claim to be, by complex step.

Decides that Newton's method sees the slope of the force and that force is the slope of energy. A complex step of 1e-30 has no
error but rounding, so that stresses and tangents of the size of the moduli may be off by some hundred roundings of them; a
tangent that is consistent with another stress would be off by the size of the step.
"""

import numpy as np
import pytest

from rkverify.solid.materials.j2 import J2
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.law import Hyperelastic, State
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.small_strain import SmallStrain
from rkverify.solid.materials.truesdell import Truesdell

MODULI = Moduli(1.25, 0.75)
STEP = 1e-30
ROUNDING = 500 * 2.0**-52
HYPERELASTIC = [
    SaintVenantKirchhoff(MODULI),
    NeoHookean(MODULI),
    LinearElastic(MODULI),
    LinearElastic(MODULI, "stress"),
]
INCREMENTAL = [SmallStrain(MODULI), Jaumann(MODULI), Truesdell(MODULI)]
LAWS = [*HYPERELASTIC, *INCREMENTAL, *(J2(elastic, 0.1, 0.2) for elastic in INCREMENTAL)]


def name(law: object) -> str:
    inner = getattr(law, "elastic", None)
    return f"{type(law).__name__} {type(inner).__name__ if inner else getattr(law, 'plane', '')}".strip()


def gradients(dimension: int, size: float, seed: int, count: int = 7) -> np.ndarray:
    """Deformation gradients 1 + size times random numbers in [-1, 1], far from singular for sizes up to 0.3."""
    rng = np.random.default_rng(seed)
    return np.eye(dimension) + size * rng.uniform(-1, 1, (count, dimension, dimension))


def before(law: object, dimension: int) -> State:
    """A state with a deformation, a stress and, in plasticity, some plastic strain."""
    return law.advance(gradients(dimension, 0.2, 1), law.start(7, dimension))


def planes(laws: list) -> list:
    return [(law, d) for law in laws for d in (1, 2, 3) if not (getattr(law, "plane", "") == "stress" and d == 3)]


@pytest.mark.parametrize(
    ("law", "dimension"), planes(HYPERELASTIC), ids=lambda x: name(x) if not isinstance(x, int) else x
)
def test_stress_is_the_slope_of_energy(law: Hyperelastic, dimension: int) -> None:
    F = gradients(dimension, 0.3, 2)
    P = law.stress(F)
    for k, l in np.ndindex(dimension, dimension):
        moved = F.astype(complex)
        moved[:, k, l] += 1j * STEP
        slope = law.energy(moved).imag / STEP
        np.testing.assert_allclose(P[:, k, l], slope, rtol=0, atol=ROUNDING * abs(P).max())


@pytest.mark.parametrize(("law", "dimension"), planes(LAWS), ids=lambda x: name(x) if not isinstance(x, int) else x)
def test_tangent_is_the_slope_of_stress(law: object, dimension: int) -> None:
    """Three points go a little back, and unload where there is plasticity; the others are turned inside out, and flow."""
    state, one = before(law, dimension), np.eye(dimension)
    back = np.array([0.95] * 3 + [-1.2] * 4)[:, None, None]
    F = one + back * (state.F - one)
    A = law.tangent(F, state)
    assert A.shape == (7, *[dimension] * 4)
    for k, l in np.ndindex(dimension, dimension):
        moved = F.astype(complex)
        moved[:, k, l] += 1j * STEP
        slope = law.advance(moved, state).P.imag / STEP
        np.testing.assert_allclose(A[..., k, l], slope, rtol=0, atol=ROUNDING * abs(A).max())
    if isinstance(law, J2):
        flows = law.advance(F, state).alpha > state.alpha
        assert flows[3:].any()
        assert not flows[:3].any()


@pytest.mark.parametrize("law", LAWS, ids=name)
def test_a_tangent_by_differences(law: object) -> None:
    """Without complex numbers: central differences fall with the square of their step, to what the tangent says."""
    state, F = before(law, 2), gradients(2, 0.25, 3)
    direction = np.array([[0.3, -0.7], [0.5, 0.2]])
    along = np.einsum("nijkl,kl->nij", law.tangent(F, state), direction)
    errors = []
    for h in (1e-3, 5e-4):
        difference = (law.advance(F + h * direction, state).P - law.advance(F - h * direction, state).P) / (2 * h)
        errors.append(abs(difference - along).max())
    rounded = 1e-12  # 2^-52 over the step, times stresses near 1
    assert errors[1] <= errors[0] / 3.9 + rounded


@pytest.mark.parametrize("law", [*HYPERELASTIC, J2(SmallStrain(MODULI), 0.1, 0.2)], ids=name)
def test_tangents_with_an_energy_are_symmetric(law: object) -> None:
    """Second derivatives of W commute: A_ijkl = A_klij; for associated flow at small strain too."""
    A = law.tangent(gradients(2, 0.25, 3), before(law, 2))
    np.testing.assert_allclose(A, np.einsum("nijkl->nklij", A), rtol=0, atol=ROUNDING * abs(A).max())


def test_jaumanns_tangent_is_not_symmetric() -> None:
    """The twin: no energy stands behind the Jaumann rate."""
    law = Jaumann(MODULI)
    A = law.tangent(gradients(2, 0.25, 3), before(law, 2))
    assert abs(A - np.einsum("nijkl->nklij", A)).max() > 0.01 * abs(A).max()
