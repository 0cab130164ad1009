"""The triangulation under the cells: Delaunay, valid, and the same as Qhull's where that is unique."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial import Delaunay

from rkverify.solid.triangulation import (
    GRID,
    IN_CIRCLE,
    _completed,
    _curve,
    _flipped,
    _inserted,
    _surely_inside,
    _turn,
    _two_parts,
    triangulated,
)

ANGLES = np.array([0.5, 0.5 + 2 / 3 * np.pi, 0.5 + 4 / 3 * np.pi])
FAR = 3.9 * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)


def _lattice(n: int, angle: float) -> np.ndarray:
    side = np.linspace(-0.6, 0.6, n)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2) @ np.array([[c, s], [-s, c]])


def _circle(n: int) -> np.ndarray:
    around = 2 * np.pi * np.arange(n) / n
    return 0.5 * np.stack([np.cos(around), np.sin(around)], axis=1)


@pytest.mark.parametrize("seed", range(3))
def test_the_same_triangles_as_qhull(seed: int) -> None:
    """Random points have one Delaunay triangulation: an independent program must find the same set of triangles."""
    x = np.concatenate([np.random.default_rng(seed).uniform(-0.7, 0.7, (2000, 2)), FAR])
    triangles, _, doubled = triangulated(x)
    assert doubled == -1
    assert {*map(tuple, np.sort(triangles, axis=1).tolist())} == {
        *map(tuple, np.sort(Delaunay(x).simplices, axis=1).tolist())
    }


@pytest.mark.parametrize(
    "points",
    [
        np.zeros((0, 2)),
        np.zeros((1, 2)),
        _lattice(15, 0.0),
        _lattice(15, 0.3),
        _lattice(15, 1e-15),
        _circle(400),
        np.stack([np.linspace(-0.7, 0.7, 100)] * 2, axis=1),
        np.stack([np.linspace(-0.7, 0.7, 100), 0.3 * np.linspace(-0.7, 0.7, 100)], axis=1),
        np.random.default_rng(0).random((500, 2)) ** 8,
        np.concatenate([_circle(50) * 10.0**-k for k in range(12)]),
    ],
    ids=["none", "one", "lattice", "rotated", "barely rotated", "cocircular", "diagonal", "line", "graded", "nested"],
)
def test_valid_whatever_coincides(points: np.ndarray) -> None:
    """Cocircular, collinear and graded points: 2 N + 1 triangles of positive area that fill the outer one, with mutual neighbours.

    Areas are those on the grid, where they are exact up to one rounding: a single triangle turned over would show. The
    circle through each triangle contains the vertex across each edge by no more than the bound of the determinant's error, which may be made twice: where
    an edge is kept and in the bound; it is judged from one of its sides.
    """
    x = np.concatenate([points, FAR])
    triangles, neighbours, doubled = triangulated(x)
    assert doubled == -1
    assert len(triangles) == 2 * len(points) + 1
    g = np.round(x * GRID).astype(np.int64).astype(object)  # integers of any size
    area = [
        (g[b, 0] - g[a, 0]) * (g[c, 1] - g[a, 1]) - (g[b, 1] - g[a, 1]) * (g[c, 0] - g[a, 0])
        for a, b, c in triangles.tolist()
    ]
    assert min(int(A) for A in area) > 0
    a, b, c = g[-3:]
    assert sum(area) == (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    for t, (corners, others) in enumerate(zip(triangles.tolist(), neighbours.tolist(), strict=True)):
        for k, s in enumerate(others):
            edge = {corners[(k + 1) % 3], corners[(k + 2) % 3]}
            if s < 0:
                assert edge <= {len(points), len(points) + 1, len(points) + 2}
                continue
            assert t in neighbours[s]
            (across,) = set(triangles[s].tolist()) - edge
            (own,) = set(corners) - edge
            assert min(_inside(g, corners, across), _inside(g, triangles[s].tolist(), own)) <= 2 * IN_CIRCLE


def _inside(g: np.ndarray, corners: list[int], point: int) -> float:
    """The determinant of the lifted differences over the sum of the sizes of its terms, in exact integers."""
    rows = [(int(g[v, 0] - g[point, 0]), int(g[v, 1] - g[point, 1])) for v in corners]
    (ax, ay), (bx, by), (cx, cy) = rows
    lifted = [x * x + y * y for x, y in rows]
    pairs = [(bx * cy, cx * by), (cx * ay, ax * cy), (ax * by, bx * ay)]
    determinant = sum(square * (p - q) for square, (p, q) in zip(lifted, pairs, strict=True))
    size = sum(square * (abs(p) + abs(q)) for square, (p, q) in zip(lifted, pairs, strict=True))
    return float(determinant) / float(size)


def test_a_point_at_the_place_of_another_is_named() -> None:
    """It would have a cell without area; the twin, one unit of the grid apart, is triangulated."""
    x = np.concatenate([_lattice(4, 0.1), _lattice(4, 0.1)[5:6], FAR])
    assert triangulated(x)[2] in (5, 16)
    x[16] += [4 / GRID, 0]
    assert triangulated(x)[2] == -1


def test_a_point_on_an_edge_next_to_its_end_leaves_no_triangle_without_area() -> None:
    """The flat triangle is flipped because it is flat: so near to an end of its edge no circle's determinant would say so surely."""
    rng = np.random.default_rng(3)
    unsure = 0
    far = np.round(FAR * GRID) / GRID
    for k in range(60):
        a, c = np.round(rng.uniform(-0.7, 0.7, (2, 2)) * GRID) / GRID
        b = a + np.array([1.0, k % 2]) * np.round(rng.uniform(0.1, 0.6) * GRID) / GRID
        p = a + np.array([1.0, k % 2]) * int(rng.integers(1, 8)) / GRID
        x = np.array([*((a, b) if k % 3 else (b, a)), c, p, *far])
        assert _turn(*a, *b, *p) == 0
        if _turn(*a, *b, *c) > 0:
            a, b = b, a
        unsure += not _surely_inside(*a, *b, *p, *c)  # though p is inside any circle through a and b
        v, _, found = _inserted(np.ascontiguousarray(x[:, 0]), np.ascontiguousarray(x[:, 1]))
        assert found == 4
        assert min(_turn(*x[i], *x[j], *x[m]) for i, j, m in v) > 0
    assert unsure > 10


def test_the_sign_of_an_area_is_exact() -> None:
    """Three points on a line but for the last digit: the products round to the same double, and only their low parts decide."""
    rng = np.random.default_rng(0)
    lost = 0
    for _ in range(200):
        u, v = (int(k) for k in rng.integers(2**47, 2**48, 2))
        if math.gcd(u, v) != 1:
            continue
        y = pow(u, -1, v)  # u y - v x = 1: the smallest area there is, of products near 2^96
        x = (u * y - 1) // v
        for sign, points in ((1, (u, v, x, y)), (-1, (x, y, u, v))):
            b0, b1, c0, c1 = (k / GRID for k in points)
            assert np.sign(_turn(0.0, 0.0, b0, b1, c0, c1)) == sign
            lost += b0 * c1 == b1 * c0
    assert lost > 0  # in rounded products alone


def test_a_product_is_two_doubles_without_error() -> None:
    """As rationals, for factors of all 53 digits and sizes: a splitting that is one digit off would lose the lowest bits."""
    rng = np.random.default_rng(1)
    for _ in range(2000):
        a, b = (float(k) * 2.0 ** int(e) for k, e in zip(rng.integers(-(2**53), 2**53, 2), rng.integers(-60, 4, 2), strict=True))  # fmt: skip
        high, low = _two_parts(a, b)
        assert high == a * b
        assert Fraction(high) + Fraction(low) == Fraction(a) * Fraction(b)


@pytest.mark.parametrize("digits", [1, 2, 3, 4])
def test_the_curve_goes_from_cell_to_neighbouring_cell(digits: int) -> None:
    """Through every square of 2^n by 2^n exactly once, each a neighbour of the one before: what is near on it is near in the plane."""
    side = (np.arange(2**digits) + 0.5) / 2 ** (digits - 1) - 1
    x, y = (a.ravel() for a in np.meshgrid(side, side))
    place = _curve(x, y)
    assert len(set(place.tolist())) == 4**digits
    order = np.argsort(place)
    steps = np.hypot(np.diff(x[order]), np.diff(y[order]))
    np.testing.assert_allclose(steps, 2.0 ** (1 - digits), rtol=0, atol=1e-14)
    assert (_curve(np.array([-2.0, 1.0, 5.0]), np.array([-2.0, 1.0, 5.0])) >= 0).all()


def test_the_curve_tells_points_apart_that_are_a_2_to_the_15th_apart() -> None:
    """So that a million nodes, a thousand along each side, are in order however dense they are somewhere; the twin, half as far, are not."""
    n = np.arange(-50.0, 50.0)
    for spacing, told in ((2.0**-15, 100), (2.0**-16, 50)):
        for x, y in ((n, 0 * n), (0 * n, n)):
            assert len(set(_curve((x + 0.25) * spacing, (y + 0.25) * spacing).tolist())) == told


def test_what_is_surely_inside_is_inside() -> None:
    """Against the determinant in integers: True only where it is positive, and always where it is beyond twice the bound."""
    rng = np.random.default_rng(5)
    said = {True: 0, False: 0}
    for k in range(600):
        angle = np.sort(rng.uniform(0, 2 * np.pi, 3))
        size = 1 + (0.0 if k % 3 == 0 else rng.normal() * 10.0 ** -rng.integers(1, 17))
        around = 0.5 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        last = 0.5 * size * np.array([np.cos(rng.uniform(0, 7)), 0.0])
        last[1] = np.sqrt(max(0.25 * size**2 - last[0] ** 2, 0.0))
        x = np.round((np.concatenate([around, last[None]]) + 0.1) * GRID) / GRID
        share = _inside(np.round(x * GRID).astype(np.int64).astype(object), [0, 1, 2], 3)
        found = bool(_surely_inside(*x.ravel().tolist()))
        assert not found or share > 0
        assert found or share <= 2 * IN_CIRCLE
        said[found] += 1
    assert min(said.values()) > 100


def test_any_triangulation_is_completed_to_delaunay() -> None:
    """Edges of a Delaunay triangulation flipped at random where the four points are convex: flipping back finds the same triangles."""
    rng = np.random.default_rng(11)
    x = np.round(np.concatenate([rng.uniform(-0.7, 0.7, (60, 2)), FAR]) * GRID) / GRID
    v, nb, _ = triangulated(x)
    v, nb = v.copy(), nb.copy()

    def triangles() -> set[tuple[int, ...]]:
        return {*map(tuple, np.sort(v, axis=1).tolist())}

    wanted, flips = triangles(), 0
    for t, k in zip(rng.integers(0, len(v), 400).tolist(), rng.integers(0, 3, 400).tolist(), strict=True):
        s = int(nb[t, k])
        if s < 0:
            continue
        m = nb[s].tolist().index(t)
        a, b, p, d = v[t, (k + 1) % 3], v[t, (k + 2) % 3], v[t, k], v[s, m]
        if _turn(*x[a], *x[d], *x[p]) > 0 and _turn(*x[d], *x[b], *x[p]) > 0:
            v[t] = a, b, p
            nb[t] = nb[t, (k + 1) % 3], nb[t, (k + 2) % 3], s
            _flipped(v, nb, t, s, m)
            flips += 1
    assert flips > 50
    assert len(triangles() - wanted) > 20
    _completed(np.ascontiguousarray(x[:, 0]), np.ascontiguousarray(x[:, 1]), v, nb)
    assert triangles() == wanted
    for t in range(len(v)):
        assert all(s < 0 or t in nb[s] for s in nb[t])
