"""Plane waves on the stressed simple cubic lattice: the chain, the plane and the continuum, each a route that any slip in K(k) would leave."""

from itertools import permutations, product

import numpy as np
import pytest

from rkverify.arithmetic.native import Float
from rkverify.errors import BadInput
from rkverify.readings import CELL_MEASURES
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.voronoi import voronoi
from rkverify.stability.bloch import surveys_in_space as surveys
from rkverify.stability.bloch.cell_integrals import moving, room
from rkverify.stability.bloch.continuum import acoustic_tensor, long_wave_defect
from rkverify.stability.bloch.lattices import cubic, jittered, lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.linearised_paper import slopes
from rkverify.stability.bloch.loading import PLANE_STRESS_LAWS, Loading
from rkverify.stability.bloch.measure_slopes import cells_of, measure_slopes
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.surveys import Method
from rkverify.stability.bloch.symbol import modes, stiffness, strain_waves
from rkverify.stability.bloch.zones import commensurate, into_zone
from rkverify.stability.layers import Setting, dispersion

UNEVEN = Loading((0.3, -0.2, 0.15, 0.1, -0.05, 0.2))
K = np.array([[0.7, 0.3, -0.4], [2.0, -1.1, 0.9], [np.pi, 0.0, 0.0], [np.pi, np.pi, 0.0], [2.5, 2.9, 3.0]])
SCHEMES = [Scheme("dni", 1.7), Scheme("dni", 1.7, derivative="diffuse"), Scheme("scni", 1.7), Scheme("snni", 1.7)]
schemes = pytest.mark.parametrize("scheme", SCHEMES, ids=["dni", "diffuse", "scni", "snni"])
ROUNDING = 1e3 * 10 * 2.0**-52
"""Some hundred products of terms of size 10, rounded, on either route."""


@pytest.mark.decides("C74")
@pytest.mark.parametrize("R", ["1.3", "1.8"])
@pytest.mark.parametrize(("integration", "derivative"), [("dni", "full"), ("dni", "diffuse"), ("scni", "full")])
@pytest.mark.parametrize("measure", CELL_MEASURES)
def test_in_space_a_longitudinal_wave_along_an_axis_is_the_chain_s_for_a_product_of_kernels(
    R: str, integration: str, derivative: str, measure: str
) -> None:
    """Sums over planes of nodes across the wave leave the chain's Psi of a product, and nothing like it of a radial kernel.

    So with the tensor window a wave along x under sigma_xx is the chain's with the modulus lambda + 2 mu = 1. The twin: with the
    radial window it is another one by more than a hundredth; but for SCNI where the corners of cells see the eight nodes about
    them alone, each by 1/8 from either window, up to R = 11^(1/2)/2.
    """
    kh = [0.5, 1.5, 2.5, 3.1]
    setting = Setting(
        "semi-lagrangian", integration, R, "-0.4", derivative=derivative, cell_measure=measure, layer="as-defined", convective=False
    )  # fmt: skip
    chain = np.array([b.omega.squared[0] for b in dispersion(setting, kh, Float())][::2])
    load, k = Loading((-0.4, 0, 0, 0, 0, 0), Moduli(0.3, 0.35)), np.array([[q, 0.0, 0.0] for q in kh])
    found = {
        window: stiffness(
            linearised(cubic(), Scheme(integration, float(R), derivative=derivative, cell_measure=measure, window=window)), load, k
        )[:, 0, 0, 0, 0]
        for window in ("tensor", "radial")
    }  # fmt: skip
    np.testing.assert_allclose(found["tensor"], chain, rtol=0, atol=ROUNDING)
    alike = integration == "scni" and float(R) < 11**0.5 / 2
    assert (abs(found["radial"] - chain).max() > 1e-2) == (not alike)


@pytest.mark.parametrize(
    "scheme", [Scheme(s.integration, 1.7, derivative=s.derivative, window="tensor") for s in SCHEMES[:3]]
)
def test_a_wave_in_a_plane_of_the_lattice_is_the_square_lattice_s_for_a_product_of_kernels(scheme: Scheme) -> None:
    """The same in two dimensions: motions in the plane under stresses in the plane, whatever the angle of the wave."""
    k = np.array([[0.7, 0.3], [2.0, -1.1], [2.5, 2.9]])
    plane = stiffness(linearised(lattice("square"), scheme), Loading((0.3, -0.2, 0.1)), k)[:, 0, :, 0]
    space = stiffness(linearised(cubic(), scheme), Loading((0.3, -0.2, 0, 0.1, 0, 0)), np.pad(k, ((0, 0), (0, 1))))[
        :, 0, :, 0
    ]
    np.testing.assert_allclose(space[:, :2, :2], plane, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(space[:, :2, 2], 0, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(space[:, 2, :2], 0, rtol=0, atol=ROUNDING)


@schemes
@pytest.mark.parametrize("law", PLANE_STRESS_LAWS)
@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.3, 0.5, -0.7)])
def test_long_waves_in_space_travel_as_in_a_stressed_continuum(scheme: Scheme, law: str, direction: tuple) -> None:
    """The limit knows all of T and G: k.sigma.k on each speed squared under Truesdell's rate. The twin: fixed measures lose a part."""
    loading, n = Loading(UNEVEN.stress, law=law), np.array(direction) / np.linalg.norm(direction)
    # Richardson from |k| = 0.02 leaves terms of k^4 ~ 1e-7, with coefficients of some units
    assert abs(long_wave_defect(linearised(cubic(), scheme), cubic(), loading, n)).max() < 2e-6
    if scheme.integration != "scni":
        fixed = Scheme(scheme.integration, 1.7, derivative=scheme.derivative, cell_measure="fixed")
        defect = long_wave_defect(linearised(cubic(), fixed), cubic(), loading, n)
        np.testing.assert_allclose(defect, -np.outer(loading.sigma @ n, n), rtol=0, atol=2e-6)


def test_the_acoustic_tensor_in_space_under_truesdell() -> None:
    sigma, k = UNEVEN.sigma, np.array([[0.6, 0.48, 0.64]])
    expected = 2 * np.outer(k, k) + (1 + k[0] @ sigma @ k[0]) * np.eye(3)
    np.testing.assert_allclose(acoustic_tensor(UNEVEN, k)[0], expected, rtol=1e-14)


@pytest.mark.decides("C74")
def test_scni_in_space_is_the_acoustic_tensor_of_its_own_wave_vector() -> None:
    """b(k) = i s(k): omega^2 is (lambda + 2 mu)|s|^2 + s.sigma.s once and mu |s|^2 + s.sigma.s twice, so that SCNI is stable, for
    any k, exactly where sigma + mu 1 is positive: nothing grows at -0.99 mu, a shear wave does at -1.01 mu.
    """
    of = linearised(cubic(), SCHEMES[2])
    s = strain_waves(of, K)[:, 0, 0].imag
    normal, square = np.einsum("mi,ij,mj->m", s, UNEVEN.sigma, s), (s**2).sum(axis=1)
    expected = np.stack([square + normal, square + normal, 3 * square + normal], axis=1)
    found = modes(of, UNEVEN, K)
    np.testing.assert_allclose(found.omega_squared, expected, rtol=1e-12, atol=found.rounding.max())
    k = commensurate(cubic(), 6)
    assert modes(of, Loading((-0.99, 0, 0, 0, 0, 0)), k).growth.max() == 0
    assert modes(of, Loading((-1.01, 0, 0, 0, 0, 0)), k).growth.max() > 0.05


@schemes
def test_the_cube_s_symmetries_change_nothing(scheme: Scheme) -> None:
    """Axes exchanged or reversed, in stress and wave alike: K(k) turns with them. The twin: of the stress alone it is seen."""
    of = linearised(cubic(), scheme)
    before = stiffness(of, UNEVEN, K)[:, 0, :, 0]
    for order, signs in product(permutations(range(3)), ((1, 1, 1), (1, -1, 1))):
        Q = np.eye(3)[list(order)] * np.array(signs)
        s = Q @ UNEVEN.sigma @ Q.T
        turned = Loading((s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2]))
        after = stiffness(of, turned, K @ Q.T)[:, 0, :, 0]
        np.testing.assert_allclose(after, Q @ before @ Q.T, rtol=0, atol=ROUNDING)
    assert abs(stiffness(of, turned, K)[:, 0, :, 0] - Q @ before @ Q.T).max() > 1e-2


@pytest.mark.parametrize("measure", CELL_MEASURES)
@pytest.mark.parametrize("derivative", ["full", "diffuse"])
def test_slopes_in_space_are_those_of_the_transcription(derivative: str, measure: str) -> None:
    """`paper/` with duals, cells cut by half-spaces, shares no line with `solid/`, its complex steps and the formula for volumes."""
    scheme = Scheme("dni", 1.3, derivative=derivative, cell_measure=measure)
    g = linearised(cubic(), scheme).geometric
    found = {tuple(np.round(-p, 9) + 0.0): v for p, v in zip(g.offsets, g.values, strict=True)}
    transcribed = slopes(cubic(), scheme, 0, 1.45)
    for place, value in transcribed.items():
        np.testing.assert_allclose(found.get(place, np.zeros((3, 3))), value, rtol=0, atol=1e3 * 2.0**-52)
    assert set(found) <= set(transcribed)


def test_volumes_have_the_slopes_of_difference_quotients() -> None:
    """On uneven nodes, whose facets have any form: central differences err by step^2 times some units, and rounding over the step."""
    nodes, step = jittered(cubic(), 2, 0.15, 4), 1e-4
    x = nodes.around(3.2).positions
    found = measure_slopes(x, cells_of(x), 0)
    for axis in range(3):
        volumes = []
        for side in (1, -1):
            there = x.copy()
            there[0, axis] += side * step
            volumes.append(voronoi(there, room(x)).measures)
        quotient = (volumes[0] - volumes[1]) / (2 * step)
        np.testing.assert_allclose(found[:, axis], quotient, rtol=0, atol=1e-6)
    assert abs(found).max() > 0.1


def test_a_cubic_cell_s_volume_grows_as_its_neighbours_go() -> None:
    """dV_L/dx_0 = (x_0 - x_L)/2 for the six neighbours, zero for all others, to rounding of the cells."""
    x = cubic().around(3.2).positions
    found = measure_slopes(x, cells_of(x), 0)
    distance = np.linalg.norm(x - x[0], axis=1)
    expected = np.where(abs(distance - 1)[:, None] < 1e-9, (x[0] - x) / 2, 0.0)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13)


@pytest.mark.parametrize("scheme", [SCHEMES[0], SCHEMES[3]], ids=["dni", "snni"])
def test_slopes_in_space_are_limits_of_difference_quotients(scheme: Scheme) -> None:
    """With the volumes from Voronoi cells of the moved nodes, in which nothing of the formula enters: they err by step times jumps
    of second derivatives where cells meet, some units.
    """
    step = 1e-5
    g = linearised(cubic(), scheme).geometric
    x = cubic().around(5.2).positions
    cells = np.flatnonzero(np.linalg.norm(x - x[0], axis=1) < 2.7)
    of = moving(scheme, x, cells)
    at = np.linalg.norm(-g.offsets[:, None] - x[None], axis=2).argmin(axis=1)
    for axis in range(3):
        sums = []
        for side in (1, -1):
            there = x.copy()
            there[0, axis] += side * step
            volumes = voronoi(there, room(x)).measures
            sums.append(np.stack([part.sum(axis=0) for part in of(there, volumes)], axis=1))
        quotient = (sums[0] - sums[1]) / (2 * step)
        np.testing.assert_allclose(g.values[:, :, axis], quotient[at], rtol=0, atol=3 * step)


def test_waves_in_space_fit_and_are_brought_into_the_zone() -> None:
    k = commensurate(cubic(), 4)
    assert len(k) == 64
    assert (k[0] == 0).all()
    assert abs(np.exp(4j * k) - 1).max() < 1e-13
    near = into_zone(cubic(), k)
    assert abs(near).max() <= np.pi + 1e-12
    of = linearised(cubic(), SCHEMES[0])
    np.testing.assert_allclose(stiffness(of, UNEVEN, near), stiffness(of, UNEVEN, k), rtol=0, atol=ROUNDING)


def test_a_stress_of_another_dimension_is_refused() -> None:
    with pytest.raises(BadInput, match="4 components of stress: give 3 in the plane, 6 in space"):
        Loading((1.0, 0.0, 0.0, 0.0))


@pytest.mark.decides("C74")
def test_tables_in_space_hold_the_chain_and_the_directions() -> None:
    """Rows are what a direct look gives: the chain's omega^2 by its own relation, growth along a direction by its waves alone.

    DNI with the full derivative has other verdicts than the chain at R = 1.8, SCNI the chain's: what the claim is about.
    """
    method, R, size, count = Method("dni"), "1.8", 0.3, 4
    rows = {row["state"]: row for row in surveys.growth_rows([method, Method("scni")], [R], size, count)[:6]}
    of = linearised(cubic(), method.scheme(R))
    load = Loading((-size, 0, 0, 0, 0, 0))
    for name, direction in (("[100]", (1, 0, 0)), ("[110]", (1, 1, 0)), ("[111]", (1, 1, 1))):
        k = np.array([[np.pi * j / count * c for c in direction] for j in range(1, count + 1)])
        growth = modes(of, load, k).growth.max()
        assert rows["compression"][name] == (growth if growth > 1e-5 else 0.0)
    fastest = rows["compression"]
    k = np.array([[fastest["kx"], fastest["ky"], fastest["kz"]]])
    assert modes(of, load, k).growth.max() == pytest.approx(fastest["zone"], rel=1e-9)
    assert all(fastest["zone"] >= fastest[name] - 1e-12 for name in ("[100]", "[110]", "[111]"))
    assert rows["no stress"]["zone"] == 0.0
    shear = modes(of, Loading((0, 0, 0, size, 0, 0)), commensurate(cubic(), count)).growth.max()
    assert rows["shear"]["zone"] == pytest.approx(shear, rel=1e-9)
    setting = Setting("semi-lagrangian", "dni", R, -size / 3, layer="as-defined", convective=False)
    kh = [np.pi * j / count for j in range(1, count + 1)]
    branches = dispersion(setting, kh, Float())
    (tension, compression) = surveys.chain_rows([method], [R], size, count)
    assert compression["state"] == "compression"
    growth = 3**0.5 * max(b.omega.growth for b in branches)
    assert compression["chain"] == pytest.approx(growth if growth > 1e-5 else 0.0, rel=1e-9)
    assert compression["tensor"] < 1e-12
    assert compression["radial"] > 1e-2
    assert tension["radial"] > 1e-2
    shares = {row["share"]: row["growth"] for row in surveys.bound_rows(R, count, (0.99, 1.01))}
    assert shares[0.99] == 0.0
    assert shares[1.01] > 0.01
