"""Neighbours are decided by distance and the source node's own support, and by nothing that makes the search fast."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rkverify.solid.neighbours as module
from rkverify.errors import BadInput
from rkverify.readings import WINDOWS, Window
from rkverify.solid.cloud import cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import Neighbours, neighbours

SEEDS, DIMENSIONS = st.integers(0, 2**32 - 1), st.integers(1, 3)


def brute_force(X: Array, a: Array, window: Window, x: Array) -> list[list[int]]:
    """The definition, for every pair."""
    y = x[:, None, :] - X[None, :, :]
    reach = np.sqrt((y**2).sum(axis=2)) if window == "radial" else abs(y).max(axis=2)
    return [np.flatnonzero(row).tolist() for row in reach < a]


def rows(found: Neighbours) -> list[list[int]]:
    return [found.of(p).tolist() for p in range(len(found))]


@given(SEEDS, DIMENSIONS, st.sampled_from(WINDOWS), st.sampled_from([0.0, 0.3, 3.0]))
def test_the_search_is_the_definition(seed: int, d: int, window: Window, spread: float) -> None:
    """Decides that no tree, class of supports or block loses or adds a pair: supports equal to differing a thousandfold."""
    rng = np.random.default_rng(seed)
    X, x = rng.normal(size=(rng.integers(1, 40), d)), rng.normal(size=(rng.integers(1, 30), d))
    a = 10 ** rng.uniform(-spread / 2, spread / 2, len(X))
    found = neighbours(cloud(X, a, window=window), x)
    assert rows(found) == brute_force(X, a, window, x)
    assert found.starts.dtype == found.nodes.dtype == np.int64
    assert found.points.tolist() == [p for p, row in enumerate(rows(found)) for _ in row]


@pytest.mark.parametrize("window", WINDOWS)
def test_the_support_is_open_and_owned_by_the_source(window: Window) -> None:
    """A node exactly a_J away is none, one double nearer is; the wide support reaches the narrow node and not conversely."""
    X = np.array([[0.0, 0.0], [3.0, 0.0]])
    c = cloud(X, [1.0, 4.0], window=window)
    x = np.array([[1.0, 0.0], [np.nextafter(1.0, 0.0), 0.0], [7.0, 0.0]])
    assert rows(neighbours(c, x)) == [[1], [0, 1], []]
    assert rows(neighbours(c, X)) == [[0, 1], [1]]


def test_the_windows_differ_in_the_corner() -> None:
    """The twin: at (0.8, 0.8) of a unit support the tensor window reaches and the radial one does not."""
    found = [rows(neighbours(cloud([[0, 0]], 1, window=w), np.array([[0.8, 0.8]]))) for w in ("radial", "tensor")]
    assert found == [[[]], [[0]]]


def test_blocks_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    """Points in blocks of 7 or all at once: the same bytes, in the order of the points."""
    rng = np.random.default_rng(3)
    X = rng.uniform(size=(200, 2))
    c = cloud(X, rng.uniform(0.05, 0.4, 200))
    once = neighbours(c, X)
    monkeypatch.setattr(module, "_BLOCK", 7)
    again = neighbours(c, X)
    assert once.nodes.tobytes() == again.nodes.tobytes()
    assert once.starts.tobytes() == again.starts.tobytes()


def test_a_complex_step_changes_no_neighbour() -> None:
    rng = np.random.default_rng(4)
    X, x = rng.uniform(size=(30, 2)), rng.uniform(size=(20, 2))
    c = cloud(X, 0.5)
    steps = neighbours(c.at(X + 1e-3j), x - 1e-2j)
    assert rows(steps) == rows(neighbours(c, x))


def test_no_points_have_no_neighbours() -> None:
    found = neighbours(cloud([[0, 0]], 1), np.zeros((0, 2)))
    assert (found.starts.tolist(), found.nodes.tolist()) == ([0], [])


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([[0.0]], "the points have 1 coordinates and the nodes have 2"),
        ([[0.0, 0.0], [0.0, np.nan]], r"point 1 is at \(0, nan\): every coordinate must be finite"),
        ([0.0, 0.0], "give \\(N, d\\)"),
        ([["x", "y"]], "no table of numbers"),
    ],
)
def test_bad_points_are_named(points: list, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        neighbours(cloud([[0, 0], [1, 0]], 1), points)


@pytest.mark.parametrize("points", [[[0.0, 0.0]], [[0.0, 0.0, 0.0]], [[0.0]]], ids=len)
def test_points_have_the_nodes_dimension(points: list[list[float]]) -> None:
    """Too many coordinates as well as too few: numpy would stretch one to the other."""
    d = {1: 2, 2: 1, 3: 2}[len(points[0])]
    with pytest.raises(BadInput, match=f"the points have {len(points[0])} coordinates and the nodes have {d}"):
        neighbours(cloud(np.eye(3)[:, :d] if d > 1 else [[0.0], [1.0]], 2.0), np.array(points))
