"""Nonlinear runs, finite sets and zero-energy modes in the plane against what K(k) says of them."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from scipy.linalg import eig

from rkverify.errors import BadInput, TooFewNodes
from rkverify.readings import DERIVATIVES
from rkverify.solid.boxes import boxes
from rkverify.solid.cloud import cloud
from rkverify.solid.gradients import facets_alone, scni
from rkverify.solid.periodic_plane import rates, surroundings
from rkverify.solid.voronoi import voronoi
from rkverify.stability.bloch.cell_integrals import facets_of
from rkverify.stability.bloch.clouds import growth, held_cloud, uneven_square
from rkverify.stability.bloch.evidence import BOX, Case
from rkverify.stability.bloch.lattices import jittered, lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.measured import _interval, _roots, box_of, measure, measure_fastest
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.surveys import Method, loading
from rkverify.stability.bloch.symbol import modes, strain_waves
from rkverify.stability.bloch.zero_energy import zero_modes
from rkverify.stability.bloch.zones import commensurate, into_zone, worst

FULL, SNNI, SCNI = Method("dni"), Method("snni"), Method("scni")
CASES = [
    Case("square", FULL, "1.4", "tension", (2, 0)),
    Case("square", FULL, "1.8", "tension", (2, 0)),
    Case("square", FULL, "1.8", "compression", (2, 0)),
    Case("square", SNNI, "1.7", "shear", (2, 2)),
    Case("square", SCNI, "1.7", "shear", (1, 1)),
]


@pytest.mark.decides("C74")
@pytest.mark.parametrize("case", CASES)
def test_nonlinear_runs_grow_as_the_lattice_says(case: Case) -> None:
    """No derivative enters a run: forces, cells and stresses are those of the moving nodes.

    The two runs of DNI along (pi, 0) in tension are on either side of the support ratio at which its sign turns.
    """
    nodes, scheme = lattice(case.lattice), case.method.scheme(case.support_ratio)
    k = np.array(case.waves) / BOX @ nodes.reciprocal
    predicted = modes(linearised(nodes, scheme), loading(case.state, 0.3), k[None]).growth.max()
    seen = measure(nodes, scheme, loading(case.state, 0.3), BOX, case.waves)
    assert (predicted > 0.3) == (case.method != SCNI and (case.support_ratio, case.state) != ("1.8", "tension"))
    # the wave's square, 1e-6 after a hundredfold growth 1e-4 of it, and the runs' own steps
    assert abs(seen.growth - predicted) < 1e-3 * predicted + 1e-5


def test_a_translation_is_no_wave() -> None:
    with pytest.raises(BadInput, match=r"\(4, 0\) on 4 periods is a translation"):
        measure(lattice("square"), FULL.scheme("1.7"), loading("tension", 0.3), BOX, (4, 0))


@pytest.mark.parametrize("method", [FULL, SNNI, SCNI], ids=["dni", "snni", "scni"])
@pytest.mark.parametrize("measure_of", ["edges", "material", "fixed"])
def test_the_box_s_own_slopes_are_those_of_the_symbol(method: Method, measure_of: str) -> None:
    """v' after a small wave in the positions, with the stress that the same wave has made: -K(k)/m, on another code path."""
    nodes, load = lattice("hexagonal"), Loading((0.2, -0.1, 0.15))
    scheme = Scheme(method.integration, 1.7, cell_measure=measure_of)
    plane, still = box_of(nodes, scheme, load, 3)
    k = np.array([1, 2]) / 3 @ nodes.reciprocal
    of, e = linearised(nodes, scheme), np.array([0.6, -0.8])
    from rkverify.stability.bloch.symbol import stiffness

    K = stiffness(of, load, k[None])[0, 0, :, 0] / of.masses[0]
    step = 1e-6
    cos = np.cos(still.x @ k)
    sides = []
    for h in (step, -step):
        made = rates(plane, type(still)(still.x, h * np.outer(cos, e), still.stress, still.measures))
        a = still.measures + (made.measures if measure_of == "material" else 0.0)
        sides.append(
            rates(plane, type(still)(still.x + h * np.outer(cos, e), still.v, still.stress + made.stress, a)).v
        )
    slope = (sides[0] - sides[1]) / (2 * step)
    # rounding of forces of size 1 over the step
    np.testing.assert_allclose(slope, -np.outer(cos, (K @ e).real), rtol=0, atol=50 * 2.0**-52 / step)


@pytest.mark.decides("C75")
@pytest.mark.parametrize(("method", "least"), [(SCNI, 1e-3), (FULL, 0.5)], ids=["scni", "dni"])
def test_on_uneven_nodes_all_grow_under_shear_scni_slowly_while_it_oscillates(method: Method, least: float) -> None:
    """Truesdell's tangent under a stress is not symmetric; on a lattice what is not symmetric cancels, on uneven nodes not.

    Nonlinear runs show what the eigenvalues have, of SCNI a complex pair of omega^2. The twin: without stress nothing grows.
    """
    nodes, scheme = jittered(lattice("square"), 4, 0.2, 1), method.scheme("1.7")
    predicted, seen = measure_fastest(nodes, scheme, Loading((0.1, 0, 0.3)), 4.0)
    assert predicted > least
    assert abs(seen.growth / predicted - 1) < 1e-3
    assert modes(linearised(nodes, scheme), Loading((0, 0, 0)), np.zeros((1, 2))).growth.max() == 0


@pytest.mark.decides("C75")
def test_a_finite_set_keeps_the_verdicts_of_dni_and_scni_while_it_is_even() -> None:
    even = uneven_square(11, 0.0, 0)
    assert growth(held_cloud(*even, SCNI.scheme("1.4")), loading("tension", 0.3)) < 1e-6
    whole = worst(
        linearised(lattice("square"), FULL.scheme("1.4")), loading("tension", 0.3), commensurate(lattice("square"), 8)
    )
    part = growth(held_cloud(*even, FULL.scheme("1.4")), loading("tension", 0.3))
    assert 0.5 * whole.growth < part < whole.growth  # a held rim leaves less room


@pytest.mark.parametrize("method", [FULL, SNNI], ids=["dni", "snni"])
def test_forces_of_a_finite_set_have_these_slopes(method: Method) -> None:
    """The geometric part by complex steps against difference quotients of all forces, on uneven nodes."""
    from rkverify.solid.voronoi import voronoi
    from rkverify.stability.bloch.cell_integrals import moving

    x, domain = uneven_square(11, 0.15, 2)
    scheme = method.scheme("1.4")
    cloud = held_cloud(x, domain, scheme)
    J, step = cloud.free[len(cloud.free) // 2], 1e-6
    near = np.flatnonzero(np.linalg.norm(x - x[J], axis=1) < 3.5)
    of = moving(scheme, x, near)
    for axis in range(2):
        sums = []
        for h in (step, -step):
            there = x.copy()
            there[J, axis] += h
            sums.append(
                np.stack([p.sum(axis=0) for p in of(there, voronoi(there, domain).measures)], axis=1)[cloud.free]
            )
        quotient = (sums[0] - sums[1]) / (2 * step)
        found = cloud.geometric[:, :, list(cloud.free).index(J), axis]
        assert abs(found).max() > 0.1
        np.testing.assert_allclose(
            found, quotient, rtol=0, atol=1e-7
        )  # step^2 times 1e3, and 1e-15 over the step times ten


@pytest.mark.decides("C13")
@pytest.mark.parametrize(("method", "square", "hexagonal"), [(FULL, 6, 10), (SNNI, 6, 6), (SCNI, 46, 10), (Method("scni", rule="midpoint"), 6, 10)])  # fmt: skip
@pytest.mark.parametrize("R", ["1.4", "2.1"])
def test_zero_energy_modes_are_counted(method: Method, square: int, hexagonal: int, R: str) -> None:
    """Two for each half of a reciprocal vector (b is odd about a node), and two for each corner of the hexagonal zone where the
    cells have its threefold symmetry; the trapezoid rule, half the sum of two vertices, has all waves that alternate along an axis.
    """
    counts = {}
    for name in ("square", "hexagonal"):
        nodes = lattice(name)
        found = zero_modes(linearised(nodes, method.scheme(R)), nodes, 12)
        counts[name] = found.count
        assert found.least > 1e6 * found.rounding
    assert counts == {"square": square, "hexagonal": hexagonal}


def test_modes_without_strain_have_no_frequency_and_the_others_have() -> None:
    """Counted by strains, and by omega^2: the same modes. On jittered nodes there is none."""
    nodes = lattice("square")
    of = linearised(nodes, FULL.scheme("1.7"))
    found = zero_modes(of, nodes, 6)
    squares = modes(of, Loading((0, 0, 0)), found.k).omega_squared.real
    assert int((squares == 0).sum()) == found.count + 2
    uneven = jittered(nodes, 4, 0.2, 1)
    assert zero_modes(linearised(uneven, FULL.scheme("1.7")), uneven, 2).count == 0
    b = strain_waves(of, np.array([[np.pi, 0.0], [np.pi, np.pi / 3]]))
    assert abs(b[0]).max() < 1e-14 < 0.1 < abs(b[1]).max()


def test_wave_vectors_are_brought_into_the_zone() -> None:
    """The nearest equivalent: none of the 24 around is nearer to zero, and e^{i k.x} is the same at every node."""
    for name in ("square", "hexagonal"):
        nodes = lattice(name)
        k = commensurate(nodes, 5)
        inside = into_zone(nodes, k)
        np.testing.assert_allclose(np.exp(1j * (k - inside) @ nodes.periods.T), 1, rtol=0, atol=1e-13)
        shifts = np.array([[p, q] for p in (-1, 0, 1) for q in (-1, 0, 1)]) @ nodes.reciprocal
        lengths = np.linalg.norm(inside[:, None] + shifts, axis=2)
        assert (np.linalg.norm(inside, axis=1) <= lengths.min(axis=1) + 1e-12).all()


def test_support_ratios_are_exact_numbers() -> None:
    assert FULL.scheme("9/5").support == float(Fraction(9, 5))


@pytest.mark.parametrize("method", [FULL, SNNI, SCNI], ids=["dni", "snni", "scni"])
def test_the_loads_hold_an_uneven_box(method: Method) -> None:
    """Under a uniform stress uneven nodes have forces, which dead loads take: nothing moves, and without them all does."""
    nodes = jittered(lattice("square"), 3, 0.15, 4)
    plane, still = box_of(nodes, method.scheme("1.7"), Loading((0.3, -0.2, 0.1)), 1)
    assert abs(rates(plane, still).v).max() < 1e-13
    if method != SCNI:  # whose forces from a uniform stress are zero
        assert abs(rates(replace(plane, external=0.0), still).v).max() > 1e-3


def test_a_finite_set_has_the_gradients_and_modes_of_its_parts() -> None:
    """b_jI^L is SCNI's of the same cells, and growth solves K u = m omega^2 u with K from these parts, on uneven nodes."""
    x, domain = uneven_square(11, 0.15, 2)
    scheme, load = SCNI.scheme("1.4"), loading("compression", 1.3)
    cloud = held_cloud(x, domain, scheme)
    cells, near = voronoi(x, domain), cloud.free[len(cloud.free) // 2]
    inner = facets_alone(cells, facets_of(cells, np.array([near])))
    rows = [part[[near]].toarray()[0][cloud.free] for part in scni(scheme.cloud(x), inner, scheme.rule).parts]
    np.testing.assert_allclose(cloud.gradients[near], np.stack(rows, axis=1), rtol=0, atol=1e-13)
    b = cloud.gradients.reshape(len(x), -1, 2)
    K = np.einsum("L,LIj,ijkl,LJl->IiJk", cloud.measures, b, load.tangent, b, optimize=True)
    squares = eig(K.reshape(len(b[0]) * 2, -1), np.diag(np.repeat(cloud.masses, 2)), right=False).real
    assert abs(growth(cloud, load) - np.sqrt(-squares.min())) < 1e-9
    assert cloud.masses.std() > 0.02


def test_states_and_methods_are_told_apart() -> None:
    assert loading("shear", 0.3).stress == (0.0, 0.0, 0.3)
    assert loading("compression", 0.3).stress == (-0.3, 0.0, 0.0)
    assert len({Method("dni", reading).name for reading in DERIVATIVES}) == len(DERIVATIVES)
    assert Method("scni", rule="midpoint").name != Method("scni").name


def test_an_amplitude_that_stays_zero_is_no_root() -> None:
    """A wave along an axis leaves the other axis at rest exactly: its two roots are those of the one that moves."""
    t = 0.1 * np.arange(25)
    run = np.stack([np.cos(2 * t), 0 * t, -2 * np.sin(2 * t), 0 * t], axis=1)
    with np.errstate(
        divide="ignore", invalid="ignore"
    ):  # of what is never there the propagator is zero, and its logarithm without end
        omega = _roots([run], 0.1)
    moving = omega[np.isfinite(omega)]
    np.testing.assert_allclose(np.sort(moving.real), [-2, 2], rtol=0, atol=1e-10)
    assert abs(moving.imag).max() < 1e-10


def test_e_foldings_are_growth_times_time() -> None:
    nodes, scheme = jittered(lattice("square"), 2, 0.2, 1), FULL.scheme("1.4")
    _, seen = measure_fastest(nodes, scheme, Loading((0.1, 0, 0.3)), 1.5)
    assert seen.foldings == seen.growth * 1.5
    assert seen.growth > 0.1
    case = Case("square", FULL, "1.4", "tension", (2, 2))
    run = measure(lattice("square"), case.method.scheme("1.4"), loading("tension", 0.3), 2, (1, 1))
    # 25 samples at most, every 0.3 of the wave's own time, to a hundredfold amplitude at most
    assert 0.5 < run.foldings < np.log(220)
    assert run.foldings / run.growth < 25


def test_the_surroundings_are_all_images_within_the_radius() -> None:
    """By brute force over many periods: one image that is missed is a neighbour less, for which no shape function would ask."""
    nodes = jittered(lattice("hexagonal"), 3, 0.2, 5)
    x, periods, radius = nodes.nodes, nodes.periods, 2.9
    owners, shifts = surroundings(x, periods, radius)
    assert (owners[: len(x)] == np.arange(len(x))).all()
    assert not shifts[: len(x)].any()
    steps = np.stack(np.meshgrid(*[np.arange(-6, 7)] * 2), axis=-1).reshape(-1, 2) @ periods
    near = np.linalg.norm((x[:, None] + steps)[:, :, None] - x[None, None], axis=3).min(axis=2) < radius
    found = {(o, *np.round(s, 6) + 0.0) for o, s in zip(owners.tolist(), shifts, strict=True)}
    assert found == {(o, *np.round(steps[k], 6) + 0.0) for o, k in np.argwhere(near).tolist()}
    assert len(found) == len(owners) > 5 * len(x)


def test_times_are_sampled_in_units_of_the_wave_s_own() -> None:
    """Four times the mass is twice the period, to the last bit: an interval that did not follow would see too little, or aliases."""
    plane, still = box_of(lattice("square"), SCNI.scheme("1.4"), Loading((0.2, 0.0, 0.0)), 4)
    shape = np.cos(np.pi / 2 * still.x[:, 0])
    one = _interval(plane, still, shape)
    assert 0 < one < 0.5
    assert _interval(replace(plane, masses=4 * plane.masses), still, shape) == 2 * one


@pytest.mark.parametrize("seed", [0, 1])
def test_what_a_free_node_moves_is_looked_at_and_nothing_at_the_rim(seed: int) -> None:
    """With a jitter of a quarter, boxes at the rim leave what is covered; cells that see no free node are not asked."""
    x, domain = uneven_square(9, 0.25, seed)
    with pytest.raises(TooFewNodes, match="facet"):
        scni(cloud(x, 1.4), boxes(x, voronoi(x, domain).measures), "midpoint")
    slopes = held_cloud(x, domain, Scheme("snni", 1.4, cell_measure="material")).geometric
    assert slopes.shape[:2] == (9, 2)
    assert abs(slopes).max() > 0.1


def test_the_gradients_of_scni_have_no_slopes_and_those_have_a_zero_for_each_component() -> None:
    """A facet adds to one cell what it takes from the next: of the sum, nothing moves with a node. (F, 2, F, 2) as others.

    The twin is direct integration, whose gradients move with the node.
    """
    x, domain = uneven_square(7, 0.15, 1)
    for scheme, moves in ((SCNI.scheme("1.4"), False), (FULL.scheme("1.4"), True)):
        cloud = held_cloud(x, domain, scheme)
        count = len(cloud.free)
        assert count > 0
        assert cloud.geometric.shape == (count, 2, count, 2)
        assert bool(cloud.geometric.any()) == moves
