"""Plane waves in a stressed plane: limits, symmetries and the chain, each of which any slip in K(k) would break."""

import numpy as np
import pytest

from rkverify.arithmetic.native import Float
from rkverify.errors import UnknownName
from rkverify.paper import constitutive
from rkverify.paper.constitutive import jaumann_rate, truesdell_rate
from rkverify.readings import CELL_MEASURES
from rkverify.solid.materials.moduli import Moduli
from rkverify.stability.bloch.continuum import acoustic_tensor, long_wave_defect
from rkverify.stability.bloch.lattices import LATTICES, jittered, lattice, rotation, supercell, turned
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import PLANE_STRESS_LAWS, Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.symbol import modes, stiffness
from rkverify.stability.bloch.zero_energy import strains
from rkverify.stability.bloch.zones import commensurate, worst
from rkverify.stability.layers import Setting, dispersion

UNEVEN = Loading((0.3, -0.2, 0.1))
K = np.array([[0.7, 0.3], [2.0, -1.1], [np.pi, 0.0], [np.pi, np.pi], [2.5, 2.9]])
SCHEMES = [Scheme("dni", 1.7), Scheme("dni", 1.7, derivative="diffuse"), Scheme("scni", 1.7), Scheme("snni", 1.7)]
names = pytest.mark.parametrize("name", LATTICES)
schemes = pytest.mark.parametrize("scheme", SCHEMES, ids=["dni", "diffuse", "scni", "snni"])


@pytest.mark.decides("C74")
@pytest.mark.parametrize("R", ["1.3", "1.8", "2.6"])
@pytest.mark.parametrize(("integration", "derivative"), [("dni", "full"), ("dni", "diffuse"), ("scni", "full")])
@pytest.mark.parametrize("measure", CELL_MEASURES)
def test_a_longitudinal_wave_along_an_axis_is_the_chain_s(
    R: str, integration: str, derivative: str, measure: str
) -> None:
    """With the tensor window Psi at places on lines of nodes is a product of the chain's, and a wave along x under a stress
    sigma_xx is the chain's with modulus lambda + 2 mu = 1: a route to K_xx that shares no line with the plane's.
    """
    kh = [0.5, 1.5, 2.5, 3.1]
    setting = Setting(
        "semi-lagrangian", integration, R, "-0.4", derivative=derivative, cell_measure=measure, layer="as-defined", convective=False
    )  # fmt: skip
    chain = [b.omega.squared[0] for b in dispersion(setting, kh, Float())][::2]
    scheme = Scheme(integration, float(R), derivative=derivative, cell_measure=measure, window="tensor")
    of = linearised(lattice("square"), scheme)
    found = stiffness(of, Loading((-0.4, 0, 0), Moduli(0.3, 0.35)), np.array([[q, 0.0] for q in kh]))[:, 0, 0, 0, 0]
    # some hundred products of terms of size 10, rounded, on either route
    np.testing.assert_allclose(found, chain, rtol=0, atol=1e3 * 10 * 2.0**-52)


@names
@schemes
@pytest.mark.parametrize("law", PLANE_STRESS_LAWS)
@pytest.mark.parametrize("angle", [0.0, 0.4, 1.1])
def test_long_waves_travel_as_in_a_stressed_continuum(name: str, scheme: Scheme, law: str, angle: float) -> None:
    """The initial stress adds k.sigma.k to both speeds squared: what a wrong sign or transposition in T or G would change."""
    nodes = lattice(name)
    loading = Loading(UNEVEN.stress, law=law)
    defect = long_wave_defect(linearised(nodes, scheme), nodes, loading, np.array([np.cos(angle), np.sin(angle)]))
    # Richardson from |k| = 0.02 leaves terms of k^4 ~ 1e-7, with coefficients of some units
    assert abs(defect).max() < 2e-6


@pytest.mark.parametrize("integration", ["dni", "snni"])
def test_fixed_measures_lose_a_part_of_the_initial_stress(integration: str) -> None:
    """The twin: without a' = a tr L long waves lack sigma k times (k.u), so that the limit above is no matter of course."""
    nodes, n = lattice("square"), np.array([0.6, 0.8])
    defect = long_wave_defect(linearised(nodes, Scheme(integration, 1.7, cell_measure="fixed")), nodes, UNEVEN, n)
    np.testing.assert_allclose(defect, -np.outer(UNEVEN.sigma @ n, n), rtol=0, atol=2e-6)


def test_the_acoustic_tensor_under_truesdell() -> None:
    sigma, k = UNEVEN.sigma, np.array([[0.6, 0.8]])
    expected = 2 * np.outer(k, k) + (1 + k[0] @ sigma @ k[0]) * np.eye(2)
    np.testing.assert_allclose(acoustic_tensor(UNEVEN, k)[0], expected, rtol=1e-14)


@names
def test_scni_is_the_acoustic_tensor_of_its_own_wave_vector(name: str) -> None:
    """No geometric part, and b(k) = i s(k) on a lattice: omega^2 = (lambda + 2 mu)|s|^2 + s.sigma.s and mu |s|^2 + s.sigma.s,
    so that SCNI is stable, for any k, exactly where sigma + mu 1 is positive. DNI's geometric part is not zero: the twin.
    """
    from rkverify.stability.bloch.symbol import strain_waves

    of = linearised(lattice(name), Scheme("scni", 1.7))
    s = strain_waves(of, K)[:, 0, 0].imag
    normal, square = np.einsum("mi,ij,mj->m", s, UNEVEN.sigma, s), (s**2).sum(axis=1)
    expected = np.stack([square + normal, 3 * square + normal], axis=1)
    found = modes(of, UNEVEN, K)
    np.testing.assert_allclose(found.omega_squared, expected, rtol=1e-12, atol=found.rounding.max())
    assert abs(modes(of, UNEVEN, K, "geometric").omega_squared).max() == 0
    other = modes(linearised(lattice(name), Scheme("dni", 1.7)), UNEVEN, K, "geometric")
    assert abs(other.omega_squared).max() > 0.05


@pytest.mark.parametrize("beyond", [1e-2, 1e-9])
def test_scni_grows_once_the_stress_is_below_minus_mu(beyond: float) -> None:
    """The sharp end of the statement above: at -0.99 mu nothing grows, at -1.01 mu a shear wave does, with omega^2 =
    (mu + sigma) s_x^2 where s_y = 0; also a billionth beyond, where what counts as rounding must be less than that.
    """
    from rkverify.stability.bloch.symbol import strain_waves

    of, k = linearised(lattice("square"), Scheme("scni", 1.7)), commensurate(lattice("square"), 8)
    assert modes(of, Loading((beyond - 1, 0, 0)), k).growth.max() == 0
    found = modes(of, Loading((-beyond - 1, 0, 0)), k)
    along = abs(strain_waves(of, k[k[:, 1] == 0])[:, 0, 0, 0]).max()
    # squares are known to their rounding
    assert abs(found.growth.max() ** 2 - beyond * along**2) <= found.rounding.max() < 1e-3 * beyond


@names
@schemes
def test_the_parts_make_the_whole(name: str, scheme: Scheme) -> None:
    of = linearised(lattice(name), scheme)
    parts = stiffness(of, UNEVEN, K, "geometric") + stiffness(of, UNEVEN, K, "material")
    np.testing.assert_allclose(parts, stiffness(of, UNEVEN, K), rtol=0, atol=1e-14)
    no_stress = Loading((0.0, 0.0, 0.0))
    assert abs(stiffness(of, no_stress, K, "geometric")).max() == 0


@names
@schemes
def test_a_lattice_has_real_stiffnesses_and_without_stress_symmetric_ones(name: str, scheme: Scheme) -> None:
    """Every lattice is its own image under inversion: K(k) is real. Without stress it is B^T C B, symmetric and not negative."""
    of = linearised(lattice(name), scheme)
    assert abs(stiffness(of, UNEVEN, K).imag).max() < 1e-13
    free = stiffness(of, Loading((0.0, 0.0, 0.0)), K)[:, 0, :, 0].real
    np.testing.assert_allclose(free, free.transpose(0, 2, 1), rtol=0, atol=1e-13)
    found = modes(of, Loading((0.0, 0.0, 0.0)), K)
    assert (found.omega_squared.real >= 0).all()
    assert (found.growth == 0).all()


def test_forces_that_have_no_potential_may_grow_while_they_oscillate() -> None:
    """DNI's geometric part under shear is not symmetric: omega^2 may be a complex pair, whose growth is Re (-omega^2)^(1/2)."""
    of = linearised(lattice("square"), Scheme("dni", 1.7))
    k = commensurate(lattice("square"), 12)
    G = stiffness(of, Loading((0.5, 0.0, 0.3)), k, "geometric")[:, 0, :, 0]
    assert abs(G - G.conj().transpose(0, 2, 1)).max() > 0.01
    found = modes(of, Loading((0.5, 0.0, 0.3)), k, "geometric")
    pairs = abs(found.omega_squared.imag) > 0
    np.testing.assert_allclose(found.growth, np.sqrt(-found.omega_squared).real, rtol=1e-12)
    assert (found.growth[pairs] > 0).all()


@names
@pytest.mark.parametrize("scheme", SCHEMES[:3], ids=["dni", "diffuse", "scni"])
def test_turning_lattice_stress_and_wave_changes_nothing(name: str, scheme: Scheme) -> None:
    """Radial kernels and Voronoi cells know no axes. The twin: SNNI's boxes do."""
    angle = 0.37
    Q = rotation(angle)
    s = Q @ UNEVEN.sigma @ Q.T
    loading, nodes = Loading((s[0, 0], s[1, 1], s[0, 1])), turned(lattice(name), angle)
    before = modes(linearised(lattice(name), scheme), UNEVEN, K)
    after = modes(linearised(nodes, scheme), loading, K @ Q.T)
    np.testing.assert_allclose(after.omega_squared, before.omega_squared, rtol=0, atol=5 * before.rounding.max())
    boxes = [
        modes(linearised(n, SCHEMES[3]), load, k)
        for n, load, k in ((lattice(name), UNEVEN, K), (nodes, loading, K @ Q.T))
    ]
    assert abs(boxes[0].omega_squared - boxes[1].omega_squared).max() > 1e-2


@names
@schemes
def test_a_period_of_four_nodes_folds_the_zone(name: str, scheme: Scheme) -> None:
    """A lattice described with a larger period has the modes of all wave vectors that fold onto one, and no others."""
    nodes = lattice(name)
    large = supercell(nodes, 2)
    k = np.array([0.4, -0.7])
    folded = np.array([k + m @ large.reciprocal for m in ((0, 0), (1, 0), (0, 1), (1, 1))])
    one = modes(linearised(nodes, scheme), UNEVEN, folded).omega_squared.ravel()
    four = modes(linearised(large, scheme), UNEVEN, k[None])
    np.testing.assert_allclose(np.sort(four.omega_squared[0].real), np.sort(one.real), rtol=0, atol=1e-12)
    moved = modes(linearised(jittered(nodes, 2, 0.1, 3), scheme), UNEVEN, k[None])
    assert abs(np.sort(moved.omega_squared[0].real) - np.sort(one.real)).max() > 1e-2  # the twin: jitter is seen


@pytest.mark.parametrize("scheme", SCHEMES, ids=["dni", "diffuse", "scni", "snni"])
def test_an_uneven_period_folds_as_well(scheme: Scheme) -> None:
    """Uneven nodes are no image of themselves: phases of the two parts with opposite signs would pass on lattices, not here."""
    nodes = jittered(lattice("square"), 2, 0.1, 3)
    large = supercell(nodes, 2)
    k = np.array([0.4, -0.7])
    folded = np.array([k + m @ large.reciprocal for m in ((0, 0), (1, 0), (0, 1), (1, 1))])
    one = modes(linearised(nodes, scheme), UNEVEN, folded).omega_squared.ravel()
    four = modes(linearised(large, scheme), UNEVEN, k[None]).omega_squared[0]
    # each finds its own among the others: of simple eigenvalues, known to some 1e-13
    assert abs(four[:, None] - one[None]).min(axis=1).max() < 1e-10
    assert abs(one[:, None] - four[None]).min(axis=1).max() < 1e-10


def test_orders_and_kernels() -> None:
    """Order 2 and other kernels have the same long waves: the linear reproduction is all that they take."""
    n = np.array([0.6, 0.8])
    for scheme in (
        Scheme("dni", 2.6, order=2),
        Scheme("dni", 1.9, kernel="quintic"),
        Scheme("snni", 2.3, kernel="wendland-c2", edge_rule="gauss:3"),
    ):
        defect = long_wave_defect(linearised(lattice("square"), scheme), lattice("square"), UNEVEN, n)
        assert abs(defect).max() < 5e-6


@pytest.mark.parametrize("law", PLANE_STRESS_LAWS)
def test_the_tangent_is_the_rate_of_the_law(law: str) -> None:
    """T : L against the rate equations of the transcription, for a gradient without any symmetry."""
    load, L = Loading((0.3, -0.2, 0.1), Moduli(1.5, 0.8), law), np.array([[0.3, 0.7], [-0.4, 0.2]])
    rate = {"truesdell": truesdell_rate, "jaumann": jaumann_rate}[law]
    expected = rate(load.sigma.tolist(), L.tolist(), constitutive.Moduli(1.5, 0.8), Float())
    np.testing.assert_allclose(np.einsum("ijkl,kl->ij", load.tangent, L), expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("integration", "default", "other"), [("scni", "trapezoid", "midpoint"), ("snni", "midpoint", "trapezoid")]
)
def test_the_default_rule_is_the_named_one(integration: str, default: str, other: str) -> None:
    found = {
        rule: stiffness(linearised(lattice("hexagonal"), Scheme(integration, 1.7, rule)), UNEVEN, K)
        for rule in (None, default, other)
    }
    assert (found[None] == found[default]).all()
    assert abs(found[None] - found[other]).max() > 1e-3


def test_an_unknown_part_is_refused() -> None:
    with pytest.raises(UnknownName, match="geometric, material, total"):
        stiffness(linearised(lattice("square"), Scheme("scni", 1.7)), UNEVEN, K, "whole")


@names
def test_strains_are_the_energy_without_lambda(name: str) -> None:
    """K(k) = 2 mu a E^H E for lambda = 0 and no stress: shear counts, rotation does not."""
    of, load = linearised(lattice(name), Scheme("scni", 1.7)), Loading((0.0, 0.0, 0.0), Moduli(0.0, 1.0))
    E = strains(of, K)
    expected = 2 * of.measures.mean() * E.conj().transpose(0, 2, 1) @ E
    np.testing.assert_allclose(stiffness(of, load, K)[:, 0, :, 0], expected, rtol=0, atol=1e-13)


def test_the_worst_wave_has_the_worst_growth() -> None:
    of, k = linearised(lattice("square"), Scheme("scni", 1.7)), commensurate(lattice("square"), 8)
    load = Loading((-1.5, 0.0, 0.0))
    found = worst(of, load, k)
    assert found.growth > 0.05
    assert abs(modes(of, load, found.k[None]).growth.max() - found.growth) <= 1e-9 * found.growth


@names
@schemes
def test_long_waves_have_the_strain_of_their_gradient(name: str, scheme: Scheme) -> None:
    """b(k) -> i k: the sign of the wave, which no omega^2 of a lattice shows; the error is of third order, as b is odd."""
    from rkverify.stability.bloch.symbol import strain_waves

    of, n = linearised(lattice(name), scheme), np.array([0.6, -0.8])
    off = [abs(strain_waves(of, h * n[None])[0, 0, 0] - 1j * h * n).max() for h in (0.2, 0.1)]
    assert off[0] < 0.2**3
    assert 7 < off[0] / off[1] < 9
