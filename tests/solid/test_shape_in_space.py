"""Compiled shape functions in one to three dimensions: reproduction, derivatives by complex step, the transcription, errors."""

from collections.abc import Callable
from dataclasses import replace
from itertools import combinations_with_replacement, product

import numpy as np
import pytest
from hypothesis import example, given, target
from hypothesis import strategies as st

import rkverify.solid.blocks as block_module
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.errors import BadInput, NotDifferentiable, SingularMomentMatrix, TooFewNodes, UnknownName
from rkverify.kernels import KERNELS
from rkverify.paper import shape as paper
from rkverify.paper.approximation import approximation
from rkverify.readings import DERIVATIVES, WINDOWS, Derivative, Window
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.kinks import refuse_kinks
from rkverify.solid.neighbours import Neighbours
from rkverify.solid.shape import condition_numbers, shape

SEEDS, DIMENSIONS, ORDERS = st.integers(0, 2**32 - 1), st.integers(1, 3), st.integers(0, 2)
KERNEL_NAMES, SMOOTH = st.sampled_from(sorted(KERNELS)), st.sampled_from(sorted(set(KERNELS) - {"tent"}))
STEP = 2.0**-100
EPSILON = float(np.finfo(float).eps)
# What issue 4 allows: relative to the largest entry of the row times the condition of its moment matrix.
ALLOWED = {0: 1e-13, 1: 1e-11, 2: 1e-9}


def made(seed: int, d: int, order: int, kernel: str = "cubic", window: Window = "radial") -> tuple[Cloud, Array]:
    """A jittered lattice with supports of their own, large enough for the order, and points in its inside."""
    rng = np.random.default_rng(seed)
    per_axis = {1: 12, 2: 7, 3: 5}[d]
    X = np.array(list(product(range(per_axis), repeat=d)), dtype=float)
    X = X + rng.uniform(-0.2, 0.2, X.shape)
    supports = rng.uniform(1.7, 2.0, len(X)) + {0: 0.0, 1: 0.3, 2: 0.9 if d < 3 else 0.6}[order]
    x = rng.uniform(1, per_axis - 2, (6, d))
    x[0] = X[len(X) // 2]
    return cloud(X, supports, kernel, order, window), x


def exponents(d: int, degree: int) -> list[tuple[int, ...]]:
    return [p for p in product(range(degree + 1), repeat=d) if sum(p) == degree]


def monomial(x: Array, alpha: tuple[int, ...]) -> Array:
    value: Array = np.prod([x[:, k] ** power for k, power in enumerate(alpha)], axis=0)
    return value


@given(SEEDS, DIMENSIONS, ORDERS, KERNEL_NAMES, st.sampled_from(WINDOWS))
def test_monomials_up_to_the_order_are_reproduced(seed: int, d: int, order: int, kernel: str, window: Window) -> None:
    """sum_J Psi_J (x_J - x)^alpha = 0^alpha for |alpha| <= n, and for some of the next degree it is not: decides (3), (29).

    In units of the largest support; rounding of b and of the sums is within nnz epsilon times the condition of M.
    """
    c, x = made(seed, d, order, kernel, window)
    Psi, conditions = shape(c, x), condition_numbers(c, x)
    point, node = Psi.neighbours.points, Psi.neighbours.nodes
    y = (c.positions[node] - x[point]) / c.supports.max()
    worst = {}
    for degree in range(order + 2):
        residuals = [
            np.bincount(point, Psi.values * monomial(y, alpha), len(x)) - (degree == 0)
            for alpha in exponents(d, degree)
        ]
        worst[degree] = (np.max(np.abs(residuals), axis=0) / (conditions * EPSILON)).max()
    held = max(worst[degree] for degree in range(order + 1))
    target(float(held))
    assert held < len(node) / len(x)
    assert worst[order + 1] > 1e6


@given(SEEDS, DIMENSIONS, ORDERS, SMOOTH, st.sampled_from(WINDOWS), st.sampled_from(DERIVATIVES))
def test_derivatives_reproduce_derivatives(
    seed: int, d: int, order: int, kernel: str, window: Window, reading: Derivative
) -> None:
    """sum_J Psi_J,k y_J^alpha: full and diffuse give the derivative of the monomial up to the order, the frozen ones do not.

    Also sum_J Psi_J,kl y_J^alpha. Linear sums alone cannot see a wrong quadratic basis: all degrees up to the order are tried.
    """
    derivatives = min(2, order) if reading == "diffuse" else 2
    c, x = made(seed, d, order, kernel, window)
    x = x[1:]  # at a node of a regular set the frozen gradient may happen to be right
    Psi, cond = shape(c, x, derivatives, reading), condition_numbers(c, x)
    point, node, a = Psi.neighbours.points, Psi.neighbours.nodes, c.supports.max()
    y = (c.positions[node] - x[point]) / a
    largest = 0.0
    for alpha in (alpha for degree in range(order + 1) for alpha in exponents(d, degree)):
        for axes in (axes for r in range(1, derivatives + 1) for axes in combinations_with_replacement(range(d), r)):
            column = list(combinations_with_replacement(range(d), len(axes))).index(axes)
            entries = (Psi.gradients if len(axes) == 1 else Psi.seconds)[:, column] * a ** len(axes)
            powers = tuple(axes.count(k) for k in range(d))
            expected = np.prod([2.0 if p == 2 else 1.0 for p in powers]) if powers == alpha else 0.0
            largest = max(
                largest, (abs(np.bincount(point, entries * monomial(y, alpha), len(x)) - expected) / cond).max()
            )
    if reading in ("full", "diffuse"):
        assert largest < ALLOWED[derivatives]
    elif order or reading == "frozen-b":
        assert largest > 1e-6


@given(SEEDS, DIMENSIONS, ORDERS, SMOOTH, st.sampled_from(WINDOWS))
@example(seed=0, d=2, order=2, kernel="cubic", window="radial")
def test_every_derivative_is_the_complex_step(seed: int, d: int, order: int, kernel: str, window: Window) -> None:
    """Psi and Psi,k at x + i h e_l, through the same code: decides that what is called a derivative is one.

    Both sides carry rounding of epsilon times the condition, in units of the support.
    """
    c, x = made(seed, d, order, kernel, window)
    x = x[1:]  # not at a node, where a C2 kernel has no third derivative to step with
    Psi, cond = shape(c, x, 2), np.maximum.reduce(condition_numbers(c, x))
    pairs, a = list(combinations_with_replacement(range(d), 2)), c.supports.min()
    for l in range(d):
        stepped = shape(c, x + 1j * STEP * np.eye(d)[l], 1)
        assert abs(stepped.values.imag / STEP - Psi.gradients[:, l]).max() * a < 1e-13 * cond
        for k in range(d):
            second = Psi.seconds[:, pairs.index((min(k, l), max(k, l)))]
            assert abs(stepped.gradients.imag[:, k] / STEP - second).max() * a**2 < 1e-12 * cond


@pytest.mark.parametrize("d", [1, 2, 3])
def test_a_complex_step_of_all_nodes_is_one_of_the_points_backwards(d: int) -> None:
    """With real points: Psi depends on x - x_I alone, and what the nodes move is not lost where the points are not complex."""
    c, x = made(1, d, 1)
    Psi = shape(c, x, 1)
    for axis, along in enumerate(np.eye(d)):
        stepped = shape(replace(c, positions=c.positions + 1j * STEP * along), x).values
        allowed = 1e-13 * condition_numbers(c, x).max() / c.supports.min()
        assert abs(stepped.imag / STEP + Psi.gradients[:, axis]).max() < allowed


def test_the_complex_step_would_see_a_frozen_gradient() -> None:
    """The twin: the frozen readings are off by percents."""
    c, x = made(1, 2, 1)
    stepped = shape(c, x + 1j * STEP * np.eye(2)[0]).values.imag / STEP
    for reading in ("diffuse", "frozen-b", "frozen"):
        assert abs(shape(c, x, 1, reading).gradients[:, 0] - stepped).max() > 1e-2


def of_paper(c: Cloud, digits: int) -> tuple[object, Callable[[Array], tuple[object, ...]]]:
    K = Multiprecision(digits)
    A = approximation(c.positions.tolist(), c.supports.tolist(), K, c.kernel, c.order, c.window)
    return A, lambda x: A.point(*x.tolist())


def gap_to_paper(c: Cloud, x: Array, reading: Derivative, derivatives: int) -> list[float]:
    """For values, gradients, seconds the largest difference over the allowed one, at one point."""
    A, point = of_paper(c, 50)
    at, Psi, cond = point(x), shape(c, x[None], derivatives, reading), condition_numbers(c, x[None])[0]
    axes = [tuple(combinations_with_replacement(range(c.dimension), r)) for r in range(derivatives + 1)]
    entries = [Psi.values[:, None], Psi.gradients, Psi.seconds]
    expected = [
        [paper.shape_functions(A, at)],
        [paper.shape_gradient(A, at, k, reading) for (k,) in axes[1]] if derivatives else [],
        [paper.shape_second(A, at, pair, reading) for pair in axes[2]] if derivatives > 1 else [],
    ]
    gaps = []
    for order in range(derivatives + 1):
        ours = np.zeros((len(c), len(axes[order])))
        ours[Psi.neighbours.nodes] = entries[order]
        theirs = np.array([[float(column.get(J, 0)) for column in expected[order]] for J in range(len(c))])
        gaps.append(abs(ours - theirs).max() / (abs(theirs).max() * cond * ALLOWED[order]))
    return gaps


CASES = [(d, order, window) for d in (1, 2, 3) for order in (0, 1, 2) for window in WINDOWS]


@pytest.mark.parametrize(("d", "order", "window"), CASES)
def test_the_transcription_gives_the_same_numbers(d: int, order: int, window: Window) -> None:
    """`paper/` with 50 digits shares no line with the compiled code and uses another formula for the derivatives."""
    c, x = made(10 * d + order, d, order, window=window)
    derivatives = 1 if (d, window) == (3, "tensor") else 2  # 50 digits take long there; the complex step covers it
    for place in (x[1:4], x[1:3], x[1:2])[d - 1]:
        assert max(gap_to_paper(c, place, "full", derivatives)) < 1


@pytest.mark.parametrize("reading", DERIVATIVES[1:])
@pytest.mark.parametrize("d", [1, 2])
def test_the_readings_are_the_transcriptions(d: int, reading: Derivative) -> None:
    c, x = made(20 + d, d, 2)
    assert max(gap_to_paper(c, x[1], reading, 2)) < 1


@pytest.mark.parametrize("kernel", sorted(set(KERNELS) - {"tent"}))
def test_at_and_next_to_a_node_nothing_is_lost(kernel: str) -> None:
    """phi'/z and (phi'' - phi'/z)/z^2 lose their digits as z goes to 0 unless they are taken as polynomials there.

    At the node and 1e-12 to 1e-1 of a spacing beside it, against 50 digits.
    """
    c, x = made(5, 2, 0, kernel)
    for distance in (0.0, 1e-12, 1e-6, 1e-3, 1e-1):
        assert max(gap_to_paper(c, x[0] + distance * np.array([0.6, 0.8]), "full", 2)) < 1


def test_the_gap_would_show_a_wrong_digit() -> None:
    """The twin: a support longer by 1e-9 is seen."""
    c, x = made(5, 2, 1)
    A, point = of_paper(c, 50)
    theirs = paper.shape_functions(A, point(x[1]))
    ours = shape(c.at(c.positions, c.supports * (1 + 1e-9)), x[1:2])
    worst = max(
        abs(value - float(theirs[J])) for J, value in zip(ours.neighbours.nodes.tolist(), ours.values, strict=True)
    )
    assert worst > ALLOWED[0] * condition_numbers(c, x[1:2])[0]


def test_blocks_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    """Points taken 1, a few or all at once: the same bytes."""
    c, x = made(7, 2, 2)
    x = np.concatenate([x + shift for shift in np.linspace(0, 0.9, 8)[:, None]])
    once = shape(c, x, 2)
    for entries in (1, 100):
        monkeypatch.setattr(block_module, "_ENTRIES", entries)
        again = shape(c, x, 2)
        for one, other in zip(
            (once.values, once.gradients, once.seconds), (again.values, again.gradients, again.seconds), strict=True
        ):
            assert one.tobytes() == other.tobytes()


@given(SEEDS, DIMENSIONS, ORDERS, st.integers(-30, 30))
def test_the_unit_of_length_does_not_matter(seed: int, d: int, order: int, power: int) -> None:
    """Lengths times 2^k are exact: the same values and conditions to the last bit, gradients and seconds times 2^-k, 2^-2k."""
    c, x = made(seed, d, order)
    unit = 2.0**power
    one, other = shape(c, x, 2), shape(c.at(c.positions * unit, c.supports * unit), x * unit, 2)
    assert (one.values == other.values).all()
    assert (one.gradients == other.gradients * unit).all()
    assert (one.seconds == other.seconds * unit**2).all()
    assert (condition_numbers(c, x) == condition_numbers(c.at(c.positions * unit, c.supports * unit), x * unit)).all()


def test_conditions_are_those_of_the_matrix() -> None:
    """M assembled here, with lengths in units of the largest support over the point, and numpy's condition number."""
    c, x = made(3, 2, 2)
    found = condition_numbers(c, x)
    for p, place in enumerate(x):
        y = place - c.positions
        z = np.sqrt((y**2).sum(axis=1)) / c.supports
        y = y / c.supports[z < 1].max()
        phi = np.where(z < 1, 4 / 3 * np.maximum(1 - z, 0) ** 3 - 16 / 3 * np.maximum(0.5 - z, 0) ** 3, 0)
        H = np.array([np.ones(len(y)), y[:, 0], y[:, 1], y[:, 0] ** 2, y[:, 0] * y[:, 1], y[:, 1] ** 2])
        condition = np.linalg.cond((H * phi) @ H.T)
        # the condition number of a condition number is itself
        assert abs(found[p] - condition) < 100 * EPSILON * condition**2


def test_matrices_hold_the_entries() -> None:
    c, x = made(2, 2, 1)
    Psi = shape(c, x, 2)
    p, J = Psi.neighbours.points, Psi.neighbours.nodes
    assert (Psi.matrix().toarray()[p, J] == Psi.values).all()
    assert (Psi.gradient_matrix(1).toarray()[p, J] == Psi.gradients[:, 1]).all()
    assert (Psi.second_matrix(1, 0).toarray()[p, J] == Psi.seconds[:, 1]).all()
    assert Psi.matrix().shape == (len(x), len(c))
    for ask in (
        lambda: Psi.gradient_matrix(2),
        lambda: Psi.second_matrix(0, -1),
        lambda: shape(c, x).gradient_matrix(0),
    ):
        with pytest.raises(BadInput):
            ask()
    with pytest.raises(BadInput):
        shape(c, x, 1).second_matrix(0, 0)


def test_no_points_give_no_entries() -> None:
    Psi = shape(cloud([[0, 0], [1, 0], [0, 1]], 2), np.zeros((0, 2)), 2)
    assert Psi.values.shape == (0,)
    assert Psi.seconds.shape == (0, 3)


PLANE = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.0], [2.0, 1.0]]


def test_too_few_nodes_and_gaps_are_named() -> None:
    """Decides that a hole in the coverage is no matrix of NaN: the first point in it is named."""
    c = cloud(PLANE, 1.2)
    with pytest.raises(
        TooFewNodes, match=r"point 1 at \(5, 5\) lies in a gap that no node's support covers; order 1 needs 3"
    ):
        shape(c, np.array([[0.5, 0.5], [5.0, 5.0]]))
    with pytest.raises(
        TooFewNodes, match=r"point 0 at \(-0.9, 0\) is covered by the supports of 1 node; order 1 needs 3"
    ):
        condition_numbers(c, np.array([[-0.9, 0.0]]))


def test_the_first_of_many_bad_supports_is_named() -> None:
    """By its number and by its own radius."""
    with pytest.raises(BadInput, match=r"node 1 has support radius -2\.0: it must be positive and finite"):
        cloud(PLANE, [1.0, -2.0, 1.0, np.inf, 0.0, 1.0])


def test_the_first_of_many_gaps_is_named() -> None:
    """Decides that the message leads to one place and always the same."""
    X = np.array(list(product(range(12), repeat=2)), dtype=float)
    x = np.random.default_rng(8).permutation(np.array(list(product(np.arange(0.5, 14), repeat=2))))
    first = np.flatnonzero((x > 12).any(axis=1))[0]
    with pytest.raises(TooFewNodes, match=rf"^point {first} at .* lies in a gap"):
        shape(cloud(X, 1.2, order=0), x)


@pytest.mark.parametrize(
    ("nodes", "words"),
    [
        ([[0.1 * k, 0.2 * k] for k in range(6)], "6 nodes whose supports cover it lie on one line"),
        ([[0.1 * k, 0.5] for k in range(6)], "6 nodes whose supports cover it lie on one line"),
        ([[0.25, 0.2 * k] for k in range(5)], "5 nodes whose supports cover it lie on one line"),
        ([[0.25, 0.2 * k, 1e3] for k in range(5)], "5 nodes whose supports cover it lie on one line"),
        (
            [[i, j, i + j] for i in (0.1, 0.2, 0.4) for j in (0.5, 0.6)],
            "6 nodes whose supports cover it lie in one plane",
        ),
    ],
)
@pytest.mark.parametrize("window", ["radial", "tensor"])
def test_nodes_on_a_line_or_in_a_plane_are_said_to_be(nodes: list, words: str, window: str) -> None:
    """On a line along an axis through the point a diagonal entry is zero, and nothing is kept of it but 0/0: no number to read.

    Decides that the message names the reason. The twin: on a circle (test below) they lie on no line, and a pivot is named.
    """
    x = np.array([[0.25, 0.5, 1e3 if nodes[0][-1] == 1e3 else 0.75][: len(nodes[0])]])
    with pytest.raises(SingularMomentMatrix) as error:
        shape(cloud(nodes, 1, window=window), x)
    said = str(error.value)
    place = ", ".join(f"{c:.6g}" for c in x[0])
    assert (
        said
        == f"the moment matrix of point 0 at ({place}) is singular: the {words}: add nodes beside it, or enlarge supports"
    )


def test_a_node_that_went_astray_is_named() -> None:
    """Nodes in motion are not checked at every step: what they no longer cover is no gap, but a node without a place."""
    c = cloud(PLANE, 2)
    lost = c.positions.copy()
    lost[2] = np.nan
    with pytest.raises(BadInput, match=r"^node 2 is at \(nan, nan\): every coordinate must be finite$"):
        shape(c.at(lost), np.array([[0.5, 0.5]]), neighbours=Neighbours(np.array([0, 3]), np.array([0, 1, 2])))


def test_collinear_nodes_are_refused_and_one_beside_the_line_heals() -> None:
    line = [[0.1 * k, 0.2 * k] for k in range(6)]
    x = np.array([[0.25, 0.5]])
    with pytest.raises(
        SingularMomentMatrix, match=r"moment matrix of point 0 at \(0.25, 0.5\) is singular: the 6 nodes"
    ):
        shape(cloud(line, 1), x)
    assert condition_numbers(cloud(line, 1), x)[0] > 1 / (10 * EPSILON)
    assert abs(shape(cloud([*line, [0.3, 0.4]], 1), x).values.sum() - 1) < 1e-12


@given(SEEDS, st.integers(2, 3), st.integers(1, 2))
@example(
    seed=92, d=3, order=1
)  # nearly on a line in its plane: the last pivot is 40 times what rounding leaves elsewhere
def test_every_line_and_plane_is_refused(seed: int, d: int, order: int) -> None:
    """On a line (or in a plane) in any direction rounding leaves a pivot of either sign: it must not pass for one."""
    rng = np.random.default_rng(seed)
    flat = rng.uniform(-1, 1, (12, d - 1)) @ rng.normal(size=(d - 1, d))
    c = cloud(flat, 4 * np.sqrt((flat**2).sum(axis=1)).max(), order=order)
    with pytest.raises(SingularMomentMatrix):
        shape(c, flat[:1] / 2)
    lifted = c.at(flat + 0.3 * abs(flat).max() * rng.normal(size=flat.shape))
    assert abs(shape(lifted, flat[:1] / 2).values.sum() - 1) < 1e-13 * condition_numbers(lifted, flat[:1] / 2)[0]


def test_a_circle_is_no_place_for_a_quadratic_basis() -> None:
    """Six points on a conic cannot tell quadratic functions apart, wherever they lie: refused; five of them and the centre can."""
    circle = [[np.cos(t), np.sin(t)] for t in np.arange(7) * 0.9]
    with pytest.raises(SingularMomentMatrix, match="pivot 5"):
        shape(cloud(circle, 3, order=2), np.zeros((1, 2)))
    shape(cloud([*circle, [0, 0]], 3, order=2), np.zeros((1, 2)))


def test_what_is_not_offered_is_refused() -> None:
    c, x = cloud(PLANE, 2), np.array([[0.5, 0.5]])
    with pytest.raises(UnknownName):
        shape(c, x, 1, "complete")
    with pytest.raises(BadInput, match="choose 0, 1 or 2"):
        shape(c, x, 3)
    with pytest.raises(BadInput, match="a diffuse derivative of order 2 needs a basis of that order"):
        shape(c, x, 2, "diffuse")
    with pytest.raises(BadInput, match="the points have 1 coordinates and the nodes have 2"):
        shape(c, [[0.0]])
    known = shape(c, x).neighbours
    with pytest.raises(BadInput, match="neighbours of 1 points are given for 2 points"):
        shape(c, np.array([[0.5, 0.5], [0.5, 0.6]]), neighbours=known)
    with pytest.raises(BadInput, match="the nodes run from 0 to 2"):
        shape(cloud(PLANE[:3], 2), x, neighbours=known)
    with pytest.raises(BadInput, match="the starts of neighbours must ascend from 0 to their number"):
        shape(c, x, neighbours=Neighbours(known.starts + 1, known.nodes))


KINKS = {"at the node": 1.0, "at the edge of a support": 2.5}


@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("x", KINKS.values(), ids=KINKS)
def test_the_tent_has_no_gradient_at_its_kinks(x: float, window: Window) -> None:
    """Decides that one side's slope does not pass for the derivative, by no road; beside a kink all is well."""
    c = cloud([[0.0], [1.0], [2.0], [3.0]], 1.5, "tent", window=window)
    at = np.array([[x]])
    for reading in ("full", "frozen-b", "frozen"):
        with pytest.raises(NotDifferentiable, match=rf"kernel 'tent' of node \d .* point 0 at \({x:g}\)"):
            shape(c, at, 1, reading)
    with pytest.raises(NotDifferentiable):
        shape(c, at + 1j * STEP)
    shape(c, at)
    shape(c, at, 1, "diffuse")  # differentiates no kernel
    beside = shape(c, at + 0.01, 1)
    assert abs(shape(c, at + 0.01 + 1j * STEP).values.imag / STEP - beside.gradients[:, 0]).max() < 1e-13
    with pytest.raises(NotDifferentiable):
        shape(c, at + 0.01, 2)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_node_at_the_very_edge_of_its_support_counts_nothing(side: int) -> None:
    """One double inside a support of 26.25 the scaled offset is rounded to 1, and the weight is that of the edge, not of the node."""
    support = 26.25
    others = np.array([[0.0, 0.0], [12.0, 5.0], [-6.0, 11.0], [4.0, -13.0]])
    far = np.array([[side * np.nextafter(support, 0.0), 0.0]])
    assert abs(far[0, 0]) * (1 / support) == 1.0
    x = np.zeros((1, 2))
    few, more = (shape(cloud(X, support), x, 1) for X in (others, np.concatenate([others, far])))
    assert len(more.values) == 5
    assert abs(more.values[:4] - few.values).max() < 1e-14
    assert abs(more.values[4]) < 1e-14


def test_a_kink_beyond_the_support_is_none() -> None:
    """The tensor window ends in each axis: above the support the function is zero around, whatever the other axis does.

    The twins: at the edge itself, and below it, the joint counts.
    """
    c = cloud([[0.0, 0.0]], 1.0, "tent", window="tensor")
    for x, y, refused in ((0.0, 1.5, False), (0.3, 1.5, False), (0.0, 0.5, True), (0.3, 1.0, True), (0.3, 0.5, False)):
        if refused:
            with pytest.raises(NotDifferentiable, match="of node 0 has a joint or peak exactly at point 0"):
                refuse_kinks(c, np.array([[x, y]]), 1)
        else:
            refuse_kinks(c, np.array([[x, y]]), 1)


@pytest.mark.parametrize("x", [1.0, 1.75, 2.5], ids=["node", "joint", "edge"])
def test_the_cubics_third_derivative_is_refused_where_it_jumps(x: float) -> None:
    """A complex step of the second derivatives; the gradient's may be taken, as a linearisation at a node needs it."""
    c, at = cloud([[0.0], [1.0], [2.0], [3.0]], 1.5), np.array([[x]])
    with pytest.raises(NotDifferentiable):
        shape(c, at + 1j * STEP, 2)
    stepped, Psi = shape(c, at + 1j * STEP, 1), shape(c, at, 2)
    assert abs(stepped.gradients.imag[:, 0] / STEP - Psi.seconds[:, 0]).max() < 1e-13 * condition_numbers(c, at)[0]
