"""Cells as formulas of the nodes' positions: their derivatives against the transport theorem and difference quotients."""

import numpy as np
import pytest

from rkverify.errors import BadInput
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.domain import Box, Domain, box, polygon_domain
from rkverify.solid.voronoi import moved, topology, voronoi

HOLED = polygon_domain([[(0, 0), (1, 0), (1, 1), (0.5, 0.6), (0, 1)], [(0.3, 0.2), (0.7, 0.2), (0.6, 0.5)]])
EPS = np.finfo(float).eps


def _nodes(domain: Domain | Box, count: int, seed: int) -> np.ndarray:
    x = np.random.default_rng(seed).random((count, 2))
    return x[domain.contains(x)]


def _transported(cells: Cells, x: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """dA_L/dt = int over the facets of L of the bisectors' normal velocity, which is linear along a facet: its value in the middle.

    From |p - x_i|^2 = |p - x_j|^2: v_n |x_j - x_i| = (p - x_i) . v_i - (p - x_j) . v_j.
    """
    inner = cells.sides[:, 1] != OUTSIDE
    i, j = cells.sides[inner].T
    p = cells.vertices[cells.corners.reshape(-1, 2)[inner]].mean(axis=1)
    speed = ((p - x[i]) * velocity[i]).sum(axis=1) - ((p - x[j]) * velocity[j]).sum(axis=1)
    flow = (cells.areas[inner] * (x[j] - x[i])).sum(axis=1) / ((x[j] - x[i]) ** 2).sum(axis=1) * speed
    return np.bincount(i, flow, len(x)) - np.bincount(j, flow, len(x))


def _thinnest(triangles: np.ndarray, x: np.ndarray) -> float:
    """The largest squared ratio of circumradius, abc / (4 area), and shortest side."""
    p = x[triangles]
    sides = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2)
    u, w = (p[:, 1] - p[:, 0]).T, (p[:, 2] - p[:, 0]).T
    return float(((sides.prod(axis=1) / (2 * abs(u[0] * w[1] - u[1] * w[0])) / sides.min(axis=1)) ** 2).max())


@pytest.mark.parametrize("domain", [box([0, 0], [1, 1]), HOLED], ids=["square", "holed"])
def test_the_rate_of_a_measure_is_what_its_facets_sweep(domain: Domain | Box) -> None:
    """A formula that knows nothing of circumcentres: it finds a wrong vertex formula, a wrong corner and a facet left out.

    Circumcentres of thin triangles lose digits with the square of circumradius over shortest side.
    """
    x = _nodes(domain, 300, 0)
    velocity = np.random.default_rng(1).normal(size=x.shape)
    t = topology(x, domain)
    stepped = moved(t, x + 1e-30j * velocity)
    rates = stepped.measures.imag / 1e-30
    expected = _transported(moved(t, x), x, velocity)
    lost = _thinnest(t.simplices, x)
    np.testing.assert_allclose(rates, expected, rtol=0, atol=lost * EPS * abs(expected).max())
    assert abs(rates.sum()) <= lost * EPS * abs(rates).max()
    measures = moved(t, x).measures
    np.testing.assert_allclose(stepped.measures.real, measures, rtol=0, atol=lost * EPS * measures.max())


def test_on_a_lattice_measures_have_a_derivative_and_vertices_one_for_each_diagonal() -> None:
    """Where four cells meet in a point a facet without length is about to grow, with an area of second order.

    So the rates of measures are those of the transport theorem, whichever diagonal the triangulation has; the twin: the
    vertices of the two ends of that facet move apart at first order.
    """
    domain = box([-0.5, -0.5], [4.5, 4.5])
    x = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0)), axis=-1).reshape(-1, 2)
    velocity = np.random.default_rng(2).normal(size=x.shape)
    t = topology(x, domain)
    cells = moved(t, x + 1e-30j * velocity)
    expected = _transported(voronoi(x, domain), x, velocity)
    np.testing.assert_allclose(cells.measures.imag / 1e-30, expected, rtol=0, atol=64 * EPS * abs(expected).max())
    short = np.linalg.norm(cells.areas.real, axis=1) < 1e-14
    assert short.sum() == 16
    assert (np.linalg.norm(cells.areas[short].imag, axis=1) > 1e-33).all()


def test_complex_steps_and_difference_quotients_of_everything() -> None:
    """Vertices, area vectors and measures: the error of a central quotient falls as the square of its step until rounding.

    With 20 nodes; each halving of the step divides the error by four, to 5 % (the next order), measured before rounding
    (EPS over the step) comes within a hundredth of it.
    """
    x = _nodes(HOLED, 20, 3)
    velocity = np.random.default_rng(4).normal(size=x.shape)
    t = topology(x, HOLED)
    stepped = moved(t, x + 1e-30j * velocity)
    for part in ("vertices", "areas", "measures"):
        exact = getattr(stepped, part).imag / 1e-30
        errors = [
            abs(
                (getattr(moved(t, x + h * velocity), part) - getattr(moved(t, x - h * velocity), part)) / (2 * h)
                - exact
            )
            for h in (1e-4, 5e-5)
        ]
        assert errors[0].max() / errors[1].max() == pytest.approx(4, rel=0.05)


def test_voronoi_at_complex_positions_is_the_topology_of_the_real_part() -> None:
    """So that a function of cells is differentiated by a complex step without knowing of topologies."""
    x = _nodes(HOLED, 50, 5)
    z = x + 1e-30j * np.random.default_rng(6).normal(size=x.shape)
    assert voronoi(z, HOLED).measures.tolist() == moved(topology(x, HOLED), z).measures.tolist()
    np.testing.assert_allclose(voronoi(z, HOLED).measures.real, voronoi(x, HOLED).measures, rtol=0, atol=16 * EPS)


def test_moved_cells_tile_and_are_voronoi_until_an_edge_turns_round() -> None:
    """A small motion keeps the topology, and the cells are those made anew; after a large one they still tile but are not."""
    domain = box([0, 0], [1, 1])
    x = 0.1 + 0.8 * _nodes(domain, 100, 7)
    velocity = np.random.default_rng(8).normal(size=x.shape)
    t = topology(x, domain)
    for step, same in ((1e-6, True), (3e-2, False)):
        there = x + step * velocity
        old, new = moved(t, there), voronoi(there, domain)
        assert abs(old.measures.sum() - 1) <= 1e3 * EPS * abs(old.measures).sum()
        assert (abs(old.measures - new.measures).max() < 1e-12) == same


def test_in_space_the_topology_is_not_kept() -> None:
    """It says so: cells at real positions, made anew."""
    b = box([0, 0, 0], [1, 1, 1])
    with pytest.raises(BadInput, match="no topology is kept"):
        topology([[0.5, 0.5, 0.5]], b)
    with pytest.raises(BadInput, match="real positions alone"):
        voronoi([[0.5 + 1e-30j, 0.5, 0.5]], b)
