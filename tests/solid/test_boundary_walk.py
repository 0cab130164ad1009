"""The walk along a domain's boundary against the definition: who is nearest, place by place, among all nodes."""

import numpy as np
import pytest

from rkverify.solid.boundary_walk import _nearest, walk, winding
from rkverify.solid.kernel_values import Array
from rkverify.solid.triangulation import triangulated

ANGLES = np.array([0.5, 0.5 + 2 / 3 * np.pi, 0.5 + 4 / 3 * np.pi])
FAR = 3.9 * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
RINGS = (
    np.array([[-0.7, -0.7], [0.7, -0.7], [0.7, 0.7], [-0.7, 0.7]]),
    np.array([[-0.2, -0.3], [-0.25, 0.31], [0.3, 0.2]]),
)


def points(count: int, seed: int) -> tuple[Array, Array, Array]:
    x = np.concatenate([np.random.default_rng(seed).uniform(-0.7, 0.7, (count, 2)), FAR])
    triangles, neighbours, _ = triangulated(x)
    return x, triangles, neighbours


def one_of_each(x: Array, triangles: Array) -> Array:
    """A triangle of every point."""
    found = np.empty(len(x), dtype=triangles.dtype)
    for t, corners in enumerate(triangles):
        found[corners] = t
    return found


def test_the_nearest_node_is_found_from_any_other() -> None:
    """On Delaunay triangulations no node but the nearest has no nearer neighbour."""
    for seed, count in ((0, 300), (1, 40), (2, 5)):
        x, triangles, neighbours = points(count, seed)
        rng = np.random.default_rng(seed + 10)
        for place, start in zip(rng.uniform(-0.7, 0.7, (120, 2)), rng.integers(0, count, 120), strict=True):
            found = _nearest(x, triangles, neighbours, one_of_each(x, triangles), int(start), *place)
            assert found == np.linalg.norm(x - place, axis=1).argmin()


@pytest.mark.parametrize(("count", "seed"), [(1, 0), (2, 3), (12, 1), (150, 2), (900, 5)])
def test_every_piece_of_the_boundary_has_its_nearest_node(count: int, seed: int) -> None:
    """Corners and bisectors in order around each ring; half-way between two of them the owner is the nearest of all nodes."""
    x, triangles, neighbours = points(count, seed)
    found = walk(x, triangles, neighbours, count, RINGS)
    corners = np.concatenate(RINGS)
    after = np.array([1, 2, 3, 0, 5, 6, 4])
    assert found.turn.tolist()[0] == 0
    assert found.turn[-1] == len(found.corner)
    steps = 0
    for r, (first, last) in enumerate(zip(found.turn[:-1], found.turn[1:], strict=True)):
        met = range(first, last)
        own = [0, 1, 2, 3] if r == 0 else [4, 5, 6]
        assert [found.corner[n] for n in met if found.corner[n] >= 0] == own
        at, edge = 0.0, -1
        for n in met:
            A = corners[found.edge[n]]
            d = corners[after[found.edge[n]]] - A
            if found.corner[n] >= 0:
                assert found.edge[n] == found.corner[n] != edge
                assert found.triangle[n] == found.side[n] == -1  # a corner crosses no edge of a triangle
                at, edge = 0.0, found.edge[n]
            else:
                i, j = x[found.before[n]], x[found.owner[n]]
                where = (j - i) @ ((i + j) / 2 - A) / ((j - i) @ d)
                assert at <= where <= 1
                at, steps = where, steps + 1
                t = found.triangle[n]
                ends = {triangles[t, (found.side[n] + 1) % 3], triangles[t, (found.side[n] + 2) % 3]}
                assert ends == {found.before[n], found.owner[n]}
            following = n + 1 if n + 1 < last else first
            until = 1.0
            if found.corner[following] < 0:
                i, j = x[found.before[following]], x[found.owner[following]]
                until = (j - i) @ ((i + j) / 2 - A) / ((j - i) @ d)
            assert found.before[following] == found.owner[n]
            middle = A + (at + until) / 2 * d
            assert np.linalg.norm(x[:count] - middle, axis=1).argmin() == found.owner[n]
    assert (steps > 96) == (count == 900)  # more than there is room for at first


def test_the_walk_through_a_triangulation_of_other_points_is_noticed() -> None:
    """Owners that do not come back to where they began are no cells: an error, not a wrong table. The twin: the right points."""
    closed = []
    for seed in range(40):
        x, triangles, neighbours = points(12, seed)
        assert _closes(x, triangles, neighbours)
        mixed = np.concatenate([np.random.default_rng(seed).permutation(x[:12]), FAR])
        closed.append(_closes(mixed, triangles, neighbours))
    assert not all(closed)


def _closes(x: Array, triangles: Array, neighbours: Array) -> bool:
    try:
        walk(x, triangles, neighbours, 12, RINGS)
    except AssertionError as error:
        return "the owners of a ring do not close" not in str(error)
    return True


def test_winding_numbers_are_known_from_their_changes() -> None:
    """Any numbers that are zero outside, from their differences over the edges; one difference changed is noticed."""
    _x, triangles, neighbours = points(60, 4)
    outer = int(np.flatnonzero((neighbours < 0).any(axis=1))[0])
    number = np.random.default_rng(7).integers(0, 2, len(triangles))
    number[outer] = 0
    net = np.where(neighbours < 0, 0, number[:, None] - number[neighbours]).astype(np.int8)
    found, same = winding(neighbours, net, outer)
    assert same
    assert found.tolist() == number.tolist()
    inner = int(np.flatnonzero((neighbours >= 0).all(axis=1))[3])
    net[inner, 0] += 1
    net[neighbours[inner, 0], neighbours[neighbours[inner, 0]].tolist().index(inner)] -= 1
    assert not winding(neighbours, net, outer)[1]
