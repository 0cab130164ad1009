"""Tables of the studies of waves in the plane, column by column, by a second route: eigenvalues of K(k)/m, sums by hand."""

from collections.abc import Iterator
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from rkverify.solid.materials.moduli import Moduli
from rkverify.stability.at_rest import at_rest
from rkverify.stability.bloch import degenerate, evidence, surveys, surveys_in_space
from rkverify.stability.bloch.clouds import growth, held_cloud, uneven_square
from rkverify.stability.bloch.evidence import BOX, Case
from rkverify.stability.bloch.lattices import Lattice, cubic, jittered, lattice
from rkverify.stability.bloch.linearised import Linearised, linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.surveys import STATES, Method, Row, loading
from rkverify.stability.bloch.symbol import stiffness
from rkverify.stability.bloch.zero_energy import zero_modes
from rkverify.stability.bloch.zones import commensurate
from rkverify.stability.layers import Setting

DNI, SNNI, SCNI = Method("dni"), Method("snni"), Method("scni")
R, SIZE = "1.4", 0.3
KH = np.pi * np.arange(1, 5) / 4
CLOSE = 1e-9
"""Roots of eigenvalues of size 1 that rounding moves by 1e-13 at most; a growth of 1e-3 or more is known to 1e-10."""


@cache
def of(name: str, method: Method, window: str = "radial") -> Linearised:
    return linearised(lattice(name), method.scheme(R, window))


def grows(one: Linearised, load: Loading, k: np.ndarray) -> np.ndarray:
    """Growth at every k by the eigenvalues of K(k)/m."""
    size = one.gradients.offsets.shape[1] * len(one)
    K = stiffness(one, load, k).reshape(len(k), size, size) / np.repeat(one.masses, size // len(one))[:, None]
    found = np.sqrt(-np.linalg.eigvals(K).astype(complex)).real.max(axis=1)
    return np.where(found > 1e-5, found, 0.0)


def strain(one: Linearised, k: np.ndarray) -> np.ndarray:
    """Singular values of the strains by the energy: K(k) = 2 mu a E^H E where lambda and the stress are zero."""
    K = stiffness(one, Loading((0.0, 0.0, 0.0), Moduli(0.0, 1.0)), k)[:, 0, :, 0]
    return np.sqrt(np.maximum(np.linalg.eigvalsh(K) / (2 * one.measures[0]), 0.0))


def test_methods_have_names_of_their_own() -> None:
    assert [Method("dni", "diffuse").name, DNI.name, SNNI.name, SCNI.name, Method("scni", rule="midpoint").name] == [
        "DNI diffuse", "DNI full", "SNNI", "SCNI", "SCNI midpoint",
    ]  # fmt: skip


@pytest.mark.parametrize("name", ["square", "hexagonal"])
def test_growth_over_all_waves_of_a_box(name: str) -> None:
    """The largest over the waves, where it is, and the strain of that wave; no place and no strain where nothing grows."""
    rows = surveys.growth_rows([name], [DNI], [R], SIZE, 4)
    nodes, one = lattice(name), of(name, DNI)
    assert [row["state"] for row in rows] == list(STATES)
    assert {(row["lattice"], row["method"], row["support_ratio"]) for row in rows} == {(name, "DNI full", R)}
    for row in rows:
        load, k = loading(row["state"], SIZE), np.array([[row["kx"], row["ky"]]])
        assert abs(row["growth"] - grows(one, load, commensurate(nodes, 4)).max()) <= CLOSE
        assert abs(row["growth"] - grows(one, load, k)[0]) <= CLOSE
        fits = 4 * k @ nodes.periods.T / (2 * np.pi)
        np.testing.assert_allclose(fits, np.round(fits), rtol=0, atol=1e-12)
        assert np.linalg.norm(k) <= 4.5  # the corner of the zone is at 2^(1/2) pi at most
        assert abs(row["strain"] - strain(one, k).min()) <= 1e-7  # the root of 1e-14
        assert row["strain"] == 0 or row["strain"] > 1e-3
        assert (row["growth"] > 0) == bool(k.any())
    assert {row["growth"] > 0 for row in rows} == {True, False}


def test_half_a_zone_is_mapped() -> None:
    """kx from -pi to pi, ky from 0 to pi, every combination once, each with its own growth."""
    rows = surveys.zone_rows("square", [DNI, SCNI], R, ["tension", "shear"], SIZE, 3)
    axis = [-np.pi, -np.pi / 2, 0.0, np.pi / 2, np.pi]
    assert len(rows) == 2 * 2 * 15
    for method in (DNI, SCNI):
        for state in ("tension", "shear"):
            part = [row for row in rows if (row["method"], row["state"]) == (method.name, state)]
            k = np.array([[row["kx"], row["ky"]] for row in part])
            np.testing.assert_allclose(k, [[x, y] for x in axis for y in axis[2:]], rtol=0, atol=1e-15)
            found = [row["growth"] for row in part]
            np.testing.assert_allclose(found, grows(of("square", method), loading(state, SIZE), k), rtol=0, atol=CLOSE)
    assert max(row["growth"] for row in rows) > 0.1


def chains(rows: list[Row]) -> Iterator[tuple[Row, Method, Loading, np.ndarray]]:
    """Each row with its method, its load and omega^2 of the chain's own relation, modulus 3 = lambda + 2 mu, whose growth it has."""
    settings = [(method, state) for method in (DNI, SCNI) for state in ("tension", "compression")]
    for row, (method, state) in zip(rows, settings, strict=True):
        assert (row["method"], row["state"]) == (method.name, state)
        load = loading(state, SIZE)
        relation = at_rest(Setting("semi-lagrangian", method.integration, R, layer="as-defined", convective=False))
        squared = 3 * relation.omega_squared(load.stress[0] / 3, KH)
        growth_of = np.sqrt(max(-squared.min(), 0.0))
        assert abs(row["chain"] - (growth_of if growth_of > 1e-5 else 0.0)) <= CLOSE
        yield row, method, load, squared


def test_the_chain_beside_the_plane() -> None:
    """With modulus 3 = lambda + 2 mu by the chain's own relation; along an axis the tensor window makes the plane the chain."""
    rows = surveys.chain_rows(["square", "hexagonal"], [DNI, SCNI], [R], SIZE, 4)
    for row, method, load, squared in chains(rows):
        assert row["along_axis"] <= 1e-12
        along = stiffness(of("square", method, "tensor"), load, np.stack([KH, 0 * KH], 1))
        np.testing.assert_allclose(along[:, 0, 0, 0, 0], squared, rtol=0, atol=1e-12)
        for name in ("square", "hexagonal"):
            most = grows(of(name, method), loading(row["state"], SIZE), commensurate(lattice(name), 4)).max()
            assert abs(row[name] - most) <= CLOSE
    assert {row["chain"] > 0.1 for row in rows} == {True, False}
    assert {row["square"] > 0.1 for row in rows} == {True, False}


def test_scni_grows_in_compression_beyond_the_shear_modulus() -> None:
    rows = surveys.bound_rows(["square", "hexagonal"], R, 4, [0.9, 1.1])
    assert [(row["lattice"], row["share"]) for row in rows] == [
        (name, share) for name in ("square", "hexagonal") for share in (0.9, 1.1)
    ]
    for row in rows:
        expected = grows(
            of(row["lattice"], SCNI), Loading((-row["share"], 0.0, 0.0)), commensurate(lattice(row["lattice"]), 4)
        )
        assert abs(row["growth"] - expected.max()) <= CLOSE
        assert (row["growth"] > 0) == (row["share"] > 1)


def test_measured_waves_are_those_of_their_case() -> None:
    """k . a_p = 2 pi n_p/4 for both periods of the hexagonal lattice, the growth of that wave, and the run's."""
    (row,) = evidence.measured_rows([Case("hexagonal", DNI, R, "reversed shear", (1, 2))], SIZE)
    k = np.array([row["kx"], row["ky"]])
    np.testing.assert_allclose(lattice("hexagonal").periods @ k, 2 * np.pi * np.array([1, 2]) / BOX, rtol=0, atol=1e-14)
    expected = grows(of("hexagonal", DNI), loading("reversed shear", SIZE), k[None])[0]
    assert abs(row["predicted"] - expected) <= CLOSE
    assert abs(row["measured"] - expected) < 1e-3 * expected + 1e-5
    assert 0 <= row["uncertainty"] < 1e-2 * expected
    assert [row[c] for c in ("lattice", "method", "support_ratio", "state")] == [
        "hexagonal",
        "DNI full",
        R,
        "reversed shear",
    ]


def test_modes_without_strain_are_counted_in_three_sets() -> None:
    """36 nodes each, two motions of each, less the translations; strains of the square lattice by the energy."""
    rows = evidence.zero_rows([DNI], [R], 6, 0.2, 1)
    assert [row["nodes"] for row in rows] == ["square", "hexagonal", "jittered"]
    assert {row["modes"] for row in rows} == {2 * 36 - 2}
    assert [row["without_strain"] for row in rows] == [6, 10, 0]
    values = strain(of("square", DNI), commensurate(lattice("square"), 6)).ravel()
    assert abs(rows[0]["largest"] - values.max()) <= CLOSE
    assert abs(rows[0]["least"] - values[values > 1e-6].min()) <= CLOSE
    uneven = jittered(lattice("square"), 2, 0.2, 1)
    found = zero_modes(linearised(uneven, DNI.scheme(R)), uneven, 3)
    assert (rows[2]["least"], rows[2]["largest"]) == (found.least, found.largest)
    assert found.least > 1e-3


def test_what_rounding_leaves_of_a_strain() -> None:
    """2 . 2^-52 times the number of terms times the largest sum of |b| of a cell."""
    one = of("hexagonal", DNI)
    sums = sum(abs(b[0]) + abs(b[1]) for b in one.gradients.values)
    expected = 2 * np.finfo(float).eps * len(one.gradients.values) * sums
    assert zero_modes(one, lattice("hexagonal"), 3).rounding == pytest.approx(expected, rel=1e-12, abs=0)


def test_a_quarter_of_the_zone_of_strains() -> None:
    rows = evidence.strain_map([DNI, SCNI], R, 3)
    q = [0.0, np.pi / 2, np.pi]
    for method, part in ((DNI, rows[:9]), (SCNI, rows[9:])):
        k = np.array([[row["kx"], row["ky"]] for row in part])
        np.testing.assert_allclose(k, [[x, y] for x in q for y in q], rtol=0, atol=1e-15)
        found = np.array([row["strain"] for row in part])
        np.testing.assert_allclose(found, strain(of("square", method), k).min(axis=1), rtol=0, atol=1e-7)
        assert {row["method"] for row in part} == {method.name}
        assert ((found == 0) | (found > 1e-3)).all()
        assert found[0] == 0


def test_drawn_modes_alternate() -> None:
    rows = evidence.drawn_rows(3, 0.25)
    assert len(rows) == 3 * 9
    for row in rows:
        wave, along = row["mode"].split(" along ")
        sign = (-1) ** int(row["x"] + (row["y"] if wave == "(π, π)" else 0))
        expected = (0.25 * sign, 0.0) if along == "x" else (0.0, 0.25 * sign)
        assert (row["ux"], row["uy"]) == pytest.approx(expected, abs=1e-15)
    assert {(row["x"], row["y"]) for row in rows} == {(float(x), float(y)) for x in range(3) for y in range(3)}
    assert len({row["mode"] for row in rows}) == 3


def test_finite_sets_beside_the_lattice() -> None:
    """Nine free nodes of 81; over two seeds the least and the largest, and one set where there is no jitter."""
    rows = evidence.cloud_rows([DNI], R, ["tension", "no stress"], ["0", "1/5"], SIZE, 9, 2)
    assert [(row["jitter"], row["state"]) for row in rows] == [
        (jitter, state) for jitter in ("0", "1/5") for state in ("tension", "no stress")
    ]
    for row in rows:
        j = 0.2 if row["jitter"] == "1/5" else 0.0
        seeds = range(2 if j else 1)
        clouds = [held_cloud(*uneven_square(9, j, seed), DNI.scheme(R)) for seed in seeds]
        found = [growth(cloud, loading(row["state"], SIZE)) for cloud in clouds]
        found = [g if g > 1e-5 else 0.0 for g in found]
        assert (row["least"], row["largest"]) == (min(found), max(found))
        whole = grows(of("square", DNI), loading(row["state"], SIZE), commensurate(lattice("square"), 12)).max()
        assert abs(row["lattice"] - whole) <= CLOSE
        assert row["nodes"] == 9
        assert row["method"] == DNI.name
    assert rows[0]["least"] == rows[0]["largest"] > 0.1
    assert rows[2]["least"] < rows[2]["largest"]


def test_the_fastest_mode_of_uneven_nodes() -> None:
    rows = evidence.uneven_rows([(DNI, "shear", "jaumann"), (DNI, "no stress", "truesdell")], R, 2, 0.2, SIZE, 1.5)
    one = linearised(jittered(lattice("square"), 2, 0.2, 1), DNI.scheme(R))
    expected = grows(one, Loading((0.0, 0.0, SIZE), law="jaumann"), np.zeros((1, 2)))[0]
    assert expected > 0.1
    assert abs(rows[0]["predicted"] - expected) <= CLOSE
    assert abs(rows[0]["measured"] - expected) <= 1e-3 * expected
    assert 0 <= rows[0]["uncertainty"] <= 1e-2 * expected
    assert rows[1]["predicted"] == 0
    assert [(row["method"], row["state"], row["law"]) for row in rows] == [
        ("DNI full", "shear", "jaumann"), ("DNI full", "no stress", "truesdell"),
    ]  # fmt: skip


def test_where_four_cells_meet() -> None:
    """Columns by what they must be: sums and areas zero to rounding or to the step, single gradients in doubt."""
    step = 1e-6
    (row,) = evidence.degenerate_rows(["trapezoid"], R, step)
    assert row["rule"] == "trapezoid"
    assert 0.1 < row["single"] < 10
    assert 1e-3 < row["triangulations"] <= 2 * row["single"]
    assert 1e-3 < row["sides"] <= 2 * row["single"] + 1e-3
    assert row["sum_by_steps"] < 1e-14
    assert row["areas_by_steps"] < 1e-14
    assert 0 < row["sum_by_quotients"] < 100 * 2.0**-52 / step
    assert 0 < row["areas_by_quotients"] < 2 * step
    # a smooth function would have one slope on both sides: the column is the gap between the two
    scheme = Scheme("scni", float(Fraction(R)), "trapezoid")
    patch, cells = degenerate.patch_of(lattice("square"), scheme)
    ahead, behind = (degenerate.by_difference(scheme, patch, cells, 0, h).integrals for h in (step, -step))
    assert row["sides"] == abs(ahead - behind).max()


@pytest.mark.parametrize("scheme", [Scheme("dni", 1.4), Scheme("snni", 1.4), Scheme("scni", 1.4)], ids=str)
@pytest.mark.parametrize("name", ["square", "jittered"])
def test_another_unit_of_length_changes_nothing(name: str, scheme: Scheme) -> None:
    """Nodes and support three times as far: areas and masses 9, gradients 1/3, K(k/3) the same, its rounding as well."""
    nodes = lattice("square") if name == "square" else jittered(lattice("square"), 2, 0.15, 1)
    wide = Lattice(3 * nodes.periods, 3 * nodes.nodes)
    one = linearised(nodes, scheme)
    other = linearised(wide, Scheme(scheme.integration, 3 * scheme.support))
    np.testing.assert_allclose(other.measures, 9 * one.measures, rtol=1e-13, atol=0)
    np.testing.assert_allclose(other.masses, 9 * one.masses, rtol=1e-13, atol=0)
    load, k = Loading((0.3, -0.2, 0.1)), np.array([[1.1, 0.7], [2.0, -3.0]])
    np.testing.assert_allclose(
        stiffness(other, load, k / 3), stiffness(one, load, k), rtol=0, atol=1e4 * 2.0**-52
    )  # sums of some hundred terms of size 10


def test_a_lattice_is_the_same_whichever_copies_of_its_nodes_are_given() -> None:
    """All nodes within the radius, by brute force, also where a node is named some periods away from the others."""
    periods = np.array([[1.0, 0.2], [-0.3, 1.1]])
    base = np.array([[0.1, 0.2], [0.5, 0.7]])
    for shift in ([0, 0], [9, -4], [8, 4]):
        nodes = Lattice(periods, base + np.array([[0, 0], shift]) @ periods)
        for radius in (0.3, 2.5):
            patch = nodes.around(radius)
            m = np.stack(np.meshgrid(*[np.arange(-40, 41)] * 2), axis=-1).reshape(-1, 2)
            every = (nodes.nodes[None] + (m @ periods)[:, None]).reshape(-1, 2)
            near = np.linalg.norm(every[:, None] - nodes.nodes[None], axis=2).min(axis=1) < radius
            assert len(patch.positions) == near.sum()
            np.testing.assert_array_equal(patch.positions[:2], nodes.nodes)
            np.testing.assert_array_equal(patch.basis[:2], [0, 1])
            off = (patch.positions - nodes.nodes[patch.basis]) @ np.linalg.inv(periods)
            np.testing.assert_allclose(off, np.round(off), rtol=0, atol=1e-12)
            assert len(np.unique(np.round(patch.positions, 9), axis=0)) == len(patch.positions)


@cache
def of_cubes(method: Method, window: str = "radial") -> Linearised:
    return linearised(cubic(), method.scheme(R, window))


def test_growth_in_space_is_that_of_its_state_and_place() -> None:
    """Six states written out; over the zone with the place, and along an edge, a face diagonal and a space diagonal."""
    S = SIZE
    loads = {
        "no stress": (0, 0, 0, 0, 0, 0), "tension": (S, 0, 0, 0, 0, 0), "compression": (-S, 0, 0, 0, 0, 0),
        "triaxial tension": (S, S, S, 0, 0, 0), "triaxial compression": (-S, -S, -S, 0, 0, 0), "shear": (0, 0, 0, S, 0, 0),
    }  # fmt: skip
    rows = surveys_in_space.growth_rows([DNI], [R], S, 4)
    assert [row["state"] for row in rows] == list(loads)
    one, every = of_cubes(DNI), commensurate(cubic(), 4)
    for row in rows:
        load = Loading(loads[row["state"]])
        k = np.array([[row["kx"], row["ky"], row["kz"]]])
        assert abs(row["zone"] - grows(one, load, every).max()) <= CLOSE
        assert abs(row["zone"] - grows(one, load, k)[0]) <= CLOSE
        assert (row["zone"] > 0) == bool(k.any())
        for name, direction in (("[100]", (1, 0, 0)), ("[110]", (1, 1, 0)), ("[111]", (1, 1, 1))):
            line = np.array([[np.pi * j / 4 * c for c in direction] for j in (1, 2, 3, 4)])
            assert abs(row[name] - grows(one, load, line).max()) <= CLOSE
        assert (row["method"], row["support_ratio"]) == ("DNI full", R)
    assert sum(row["zone"] > 0.1 for row in rows) >= 4
    assert any(row["kz"] != row["ky"] for row in rows)


def test_the_chain_beside_space() -> None:
    """Differences of omega^2 over the modulus 3 for both windows, and the chain's growth, by its own relation."""
    rows = surveys_in_space.chain_rows([DNI, SCNI], [R], SIZE, 4)
    for row, method, load, squared in chains(rows):
        for window in ("tensor", "radial"):
            K = stiffness(of_cubes(method, window), Loading((*load.stress, 0, 0, 0)), KH[:, None] * np.array([1, 0, 0]))
            K = K[:, 0, 0, 0, 0]
            assert abs(row[window] - abs(K - squared).max() / 3) <= 1e-12
    assert max(row["radial"] for row in rows) > 1e-2
    assert {row["chain"] > 0.1 for row in rows} == {True, False}


def test_scni_in_space_grows_in_compression_beyond_the_shear_modulus() -> None:
    rows = surveys_in_space.bound_rows(R, 4, [0.9, 1.1])
    for row in rows:
        load = Loading((-row["share"], 0, 0, 0, 0, 0))
        assert abs(row["growth"] - grows(of_cubes(SCNI), load, commensurate(cubic(), 4)).max()) <= CLOSE
    assert [(row["share"], row["growth"] > 0) for row in rows] == [(0.9, False), (1.1, True)]
