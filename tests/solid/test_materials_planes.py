"""What a law does in one and two dimensions is what the three-dimensional law does there; and input that cannot be meant is refused.

Decides that plane strain, uniaxial strain and plane stress are conditions on the same solid and no materials of their own.
"""

import numpy as np
import pytest

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.materials.j2 import J2
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.kinematics import determinant, embedded, inverse
from rkverify.solid.materials.law import Law
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.moduli import Moduli, from_young
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.small_strain import SmallStrain
from rkverify.solid.materials.truesdell import Truesdell

MODULI = Moduli(1.25, 0.75)
LAWS = [
    SaintVenantKirchhoff(MODULI),
    NeoHookean(MODULI),
    LinearElastic(MODULI),
    SmallStrain(MODULI),
    Jaumann(MODULI),
    Truesdell(MODULI),
    J2(Jaumann(MODULI), 0.2, 0.1),
]
ROUNDING = 200 * 2.0**-52  # a few dozen operations on numbers near 1


def gradients(dimension: int, seed: int) -> np.ndarray:
    return np.eye(dimension) + 0.25 * np.random.default_rng(seed).uniform(-1, 1, (6, dimension, dimension))


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_plane_strain_is_the_solid_with_nothing_across(law: Law, dimension: int) -> None:
    flat, solid = law.start(6, dimension), law.start(6, 3)
    for seed in (1, 2):
        F = gradients(dimension, seed)
        A, whole = law.tangent(F, flat), law.tangent(embedded(F), solid)
        flat, solid = law.advance(F, flat), law.advance(embedded(F), solid)
        part = np.s_[:, :dimension, :dimension]
        np.testing.assert_allclose(flat.P, solid.P[part], rtol=0, atol=ROUNDING)
        np.testing.assert_allclose(flat.sigma, solid.sigma, rtol=0, atol=ROUNDING)
        np.testing.assert_allclose(A, whole[:, *[np.s_[:dimension]] * 4], rtol=0, atol=10 * ROUNDING)


@pytest.mark.parametrize("dimension", [1, 2])
def test_plane_stress_is_the_solid_with_the_strain_across_condensed(dimension: int) -> None:
    """The strain across is found from sigma_33 = 0 with the three-dimensional tangent; stress and tangent then agree."""
    solid, flat = LinearElastic(MODULI), LinearElastic(MODULI, "stress")
    F = gradients(dimension, 3)
    whole = embedded(F)
    C = solid.tangent(whole)[0]
    across = range(dimension, 3)
    free = np.array([[C[i, i, k, k] for k in across] for i in across])
    for point, P in enumerate(solid.stress(whole)):
        whole[point, across, across] -= np.linalg.solve(free, P[across, across])
    stress = solid.stress(whole)
    np.testing.assert_allclose(stress[:, across, across], 0, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(flat.stress(F), stress[:, :dimension, :dimension], rtol=0, atol=ROUNDING)
    rows = np.array([[C[:dimension, :dimension, k, k]] for k in across])[:, 0]
    condensed = C[*[np.s_[:dimension]] * 4] - np.einsum("aij,ab,bkl->ijkl", rows, np.linalg.inv(free), rows)
    np.testing.assert_allclose(flat.tangent(F)[0], condensed, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(flat.energy(F), solid.energy(whole), rtol=0, atol=ROUNDING)


def test_uniaxial_stress_has_youngs_modulus() -> None:
    """And hence lambda + 2 mu, which strains nothing across, is another number."""
    moduli = from_young(2.0, 0.3)
    F = np.array([[[1.01]]])
    assert abs(LinearElastic(moduli, "stress").stress(F).item() - 0.02) < ROUNDING
    assert abs(moduli.young - 2.0) < ROUNDING
    assert LinearElastic(moduli).stress(F).item() > 0.025


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_small_deformations_are_linear_elastic(law: Law) -> None:
    """From F = 1 every law has the tangent of linear elasticity, exactly; yield lies beyond."""
    F = np.tile(np.eye(3), (6, 1, 1))
    np.testing.assert_allclose(law.tangent(F, law.start(6, 3)), LinearElastic(MODULI).tangent(F), rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_determinant_and_inverse(dimension: int) -> None:
    F = gradients(dimension, 4)
    np.testing.assert_allclose(determinant(F), np.linalg.det(F), rtol=ROUNDING, atol=0)
    np.testing.assert_allclose(inverse(F) @ F, np.broadcast_to(np.eye(dimension), F.shape), rtol=0, atol=ROUNDING)


INVERTED = np.array([np.eye(2), [[1.0, 0.0], [0.0, -0.25]]])


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: NeoHookean(MODULI).stress(INVERTED), r"^point 1 has det F = -0\.25, not positive: take a smaller"),
        (lambda: SaintVenantKirchhoff(MODULI).advance(INVERTED), r"^point 1 has det F = -0\.25"),
        (lambda: Jaumann(MODULI).advance(INVERTED, Jaumann(MODULI).start(2, 2)), r"^point 1 has det F = -0\.25"),
        (
            lambda: Jaumann(MODULI).advance(-np.eye(2)[None], Jaumann(MODULI).start(1, 2)),
            r"^point 0 turns by half a turn in one step",
        ),
        (lambda: Jaumann(MODULI).advance(np.eye(2)[None], Jaumann(MODULI).start(2, 2)), r"the state has \(2, 2, 2\)"),
        (lambda: NeoHookean(MODULI).stress(np.ones((4, 2, 3))), r"have shape \(4, 2, 3\): give \(n, d, d\)"),
        (lambda: NeoHookean(MODULI).stress(np.ones((4, 3, 2))), r"have shape \(4, 3, 2\): give \(n, d, d\)"),
        (lambda: NeoHookean(MODULI).stress(np.ones((4, 4, 4))), r"have shape \(4, 4, 4\): give \(n, d, d\)"),
        (lambda: NeoHookean(MODULI).stress(np.eye(2)), r"have shape \(2, 2\): give \(n, d, d\)"),
        (lambda: NeoHookean(MODULI).stress(np.full((3, 2, 2), np.nan)), r"^point 0 has a deformation gradient"),
        (
            lambda: NeoHookean(MODULI).stress(np.where(np.arange(12).reshape(3, 2, 2) == 5, np.inf, np.eye(2))),
            r"^point 1 has a deformation gradient that is not finite",
        ),
        (lambda: LinearElastic(MODULI, "stress").stress(np.eye(3)[None]), r"^plane stress in 3 dimensions"),
        (lambda: Jaumann(MODULI).start(2, 4), r"^4 dimensions are not offered"),
        (lambda: from_young(1.0, 0.5), r"nu = 0\.5: give"),
    ],
)
def test_bad_input_is_named_in_one_line(call, told: str) -> None:
    with pytest.raises(BadInput, match=told) as error:
        call()
    assert "\n" not in str(error.value)


def test_an_unknown_plane_is_named() -> None:
    with pytest.raises(UnknownName, match="strain, stress"):
        LinearElastic(MODULI, "both")
