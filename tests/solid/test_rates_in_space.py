"""Psi* of (40) and the true material rate in one to three dimensions, against motion itself and against the transcription."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, target
from hypothesis import strategies as st

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.errors import BadInput, NotDifferentiable
from rkverify.kernels import KERNELS
from rkverify.paper import material_rates as paper
from rkverify.paper.approximation import approximation
from rkverify.readings import WINDOWS, Window
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.rates import psi_star, true_rate
from rkverify.solid.shape import condition_numbers, shape

SEEDS, DIMENSIONS, ORDERS = st.integers(0, 2**32 - 1), st.integers(1, 3), st.integers(0, 2)
SMOOTH, SOME_WINDOW = st.sampled_from(sorted(set(KERNELS) - {"tent"})), st.sampled_from(WINDOWS)
STEP = 2.0**-100


def made(
    seed: int, d: int, order: int, kernel: str = "cubic", window: Window = "radial"
) -> tuple[Cloud, Array, Array, Array]:
    """A jittered lattice with supports of their own, points inside, velocities of both; one point at a node."""
    rng = np.random.default_rng(seed)
    per_axis = {1: 12, 2: 7, 3: 5}[d]
    X = np.array(list(product(range(per_axis), repeat=d)), dtype=float)
    X = X + rng.uniform(-0.2, 0.2, X.shape)
    supports = rng.uniform(1.7, 2.0, len(X)) + {0: 0.0, 1: 0.3, 2: 0.9 if d < 3 else 0.6}[order]
    x = rng.uniform(1, per_axis - 2, (5, d))
    x[0] = X[len(X) // 2]
    return cloud(X, supports, kernel, order, window), x, rng.normal(size=x.shape), rng.normal(size=X.shape)


def in_motion(c: Cloud, x: Array, v: Array, v_nodes: Array, t: complex) -> Array:
    """Psi after the time t, as a matrix (P, N), since neighbours may change."""
    moved: Array = shape(c.at(c.positions + t * v_nodes), x + t * v).matrix().toarray()
    return moved


@given(SEEDS, DIMENSIONS, ORDERS, SMOOTH, SOME_WINDOW)
def test_the_true_rate_is_the_complex_step_of_the_motion(
    seed: int, d: int, order: int, kernel: str, window: Window
) -> None:
    """Psi at x + i h v among nodes at x_J + i h v_J: decides the material derivative for any motion, at a node as well."""
    c, x, v, v_nodes = made(seed, d, order, kernel, window)
    pattern = shape(c, x)
    rate = pattern.sparse(true_rate(c, x, v, v_nodes)).toarray()
    gap = abs(in_motion(c, x, v, v_nodes, 1j * STEP).imag / STEP - rate).max(axis=1) / condition_numbers(c, x)
    target(float(gap.max()))
    assert gap.max() < 1e-13 * abs(v_nodes).max()


@given(SEEDS, DIMENSIONS, ORDERS, SMOOTH, SOME_WINDOW)
def test_psi_star_is_what_the_kernel_does(seed: int, d: int, order: int, kernel: str, window: Window) -> None:
    """(40) with C = Psi / phi and the rate of phi by a complex step: the kernel alone moves, C stays."""
    c, x, v, v_nodes = made(seed, d, order, kernel, window)
    Psi, star = shape(c, x), psi_star(c, x, v, v_nodes)
    p, J = Psi.neighbours.points, Psi.neighbours.nodes

    def phi(t: complex) -> Array:
        y = x[p] + t * v[p] - c.positions[J] - t * v_nodes[J]
        if window == "radial":
            z = np.sqrt((y**2).sum(axis=1, keepdims=True))
            z[(y.real == 0).all(axis=1)] = 0
        else:
            z = np.where(y.real < 0, -y, y)
        z = z / c.supports[J][:, None]
        total = np.zeros_like(z)
        for term in c.kernel.phi.terms:
            left = float(term.end) - z
            total = total + np.where(left.real > 0, float(term.coefficient) * left**term.power, 0)
        value: Array = total.prod(axis=1)
        return value

    weight = phi(0j).real
    seen = weight > 1e-3  # C = Psi / phi keeps its digits there
    expected = Psi.values[seen] / weight[seen] * phi(1j * STEP).imag[seen] / STEP
    error = abs(star[seen] - expected) / condition_numbers(c, x)[p[seen]]
    assert error.max() < 1e-12 * abs(v_nodes).max()


@given(SEEDS, DIMENSIONS, ORDERS)
def test_rates_are_limits_of_differences_in_time(seed: int, d: int, order: int) -> None:
    """Central differences in time: the error falls as the square of the step until rounding, epsilon / step, takes over."""
    c, x, v, v_nodes = made(seed, d, order, "quintic")
    rate = shape(c, x).sparse(true_rate(c, x, v, v_nodes)).toarray()
    errors = []
    for t in (1e-3, 5e-4):
        difference = (in_motion(c, x, v, v_nodes, t) - in_motion(c, x, v, v_nodes, -t)) / (2 * t)
        errors.append(abs(difference - rate).max())
    assert errors[1] < 0.3 * errors[0] + 1e-16 / 5e-4 * 100 * condition_numbers(c, x).max()


@given(SEEDS, DIMENSIONS, ORDERS, SOME_WINDOW)
def test_the_true_rates_sum_to_zero_and_psi_star_does_not(seed: int, d: int, order: int, window: Window) -> None:
    """The unity of the partition stays under the true rate; Psi* leaves out the rate of C and with it this property."""
    c, x, v, v_nodes = made(seed, d, order, window=window)
    pattern, conditions = shape(c, x), condition_numbers(c, x)
    true = pattern.sparse(true_rate(c, x, v, v_nodes)).toarray().sum(axis=1)
    star = pattern.sparse(psi_star(c, x, v, v_nodes)).toarray().sum(axis=1)
    assert (abs(true) < 1e-13 * conditions * abs(v_nodes).max()).all()
    assert abs(star).max() > 1e-4


@given(SEEDS, DIMENSIONS, ORDERS, SOME_WINDOW)
def test_a_common_velocity_changes_nothing(seed: int, d: int, order: int, window: Window) -> None:
    """Galilean invariance: with all at one velocity both rates are 0, and adding one to a motion leaves both as they are.

    The velocities are 64ths, so that their differences are exact.
    """
    c, x, v, v_nodes = made(seed, d, order, window=window)
    v, v_nodes = np.round(v * 64) / 64, np.round(v_nodes * 64) / 64
    common = np.arange(1, d + 1) / 4
    for rate in (psi_star, true_rate):
        assert not rate(c, x, 0 * v + common, 0 * v_nodes + common).any()
        assert (rate(c, x, v, v_nodes) == rate(c, x, v + common, v_nodes + common)).all()


@pytest.mark.parametrize(("d", "order"), [(1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2), (3, 1)])
@pytest.mark.parametrize("window", WINDOWS)
def test_the_transcription_gives_the_same_rates(d: int, order: int, window: Window) -> None:
    """50 digits of `paper/`; rates are first derivatives: 1e-11 of the row's largest entry times the condition (issue 4)."""
    c, x, v, v_nodes = made(d + 10 * order, d, order, window=window)
    K = Multiprecision(50)
    A = approximation(c.positions.tolist(), c.supports.tolist(), K, c.kernel, order, window)
    pattern, speeds = shape(c, x), [A.point(*w) for w in v_nodes.tolist()]
    for ours, theirs in ((psi_star, paper.psi_star), (true_rate, paper.true_rate)):
        found = pattern.sparse(ours(c, x, v, v_nodes)).toarray()
        for p in (0, 1) if d < 3 else (1,):
            values = theirs(A, A.point(*x[p].tolist()), A.point(*v[p].tolist()), speeds)
            row = np.array([float(values.get(J, 0)) for J in range(len(c))])
            assert abs(found[p] - row).max() < 1e-11 * abs(row).max() * condition_numbers(c, x[p : p + 1])[0]


def test_velocities_must_be_there_for_everybody() -> None:
    c, x, v, v_nodes = made(1, 2, 1)
    with pytest.raises(BadInput, match=r"velocities of the points have shape \(4, 2\), the points \(5, 2\)"):
        psi_star(c, x, v[1:], v_nodes)
    with pytest.raises(BadInput, match=r"velocities of the nodes have shape \(49, 1\)"):
        true_rate(c, x, v, v_nodes[:, :1])
    v_nodes[3, 1] = np.nan
    with pytest.raises(BadInput, match="the velocity of node 3 is not finite"):
        true_rate(c, x, v, v_nodes)


def test_a_peak_has_no_rate_unless_it_rests() -> None:
    """The tent at its node: refused for a relative motion, and 0 without one, as nothing is differentiated then."""
    c, x = cloud([[0.0], [1.0], [2.0], [3.0]], 1.5, "tent"), np.array([[1.0]])
    moving = np.array([[0.5], [1.0], [0.5], [0.5]])
    for rate in (psi_star, true_rate):
        with pytest.raises(NotDifferentiable, match="node 1 has a joint or peak exactly at point 0"):
            rate(c, x, np.zeros((1, 1)), moving)
        assert np.isfinite(rate(c, x, np.ones((1, 1)), moving)).all()
