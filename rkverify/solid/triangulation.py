"""Delaunay triangulations of points inside a triangle, by insertion along a space-filling curve.

Each point is found by walking from the one before it, splits its triangle in three, and edges are flipped until no
circumcircle is known to contain a point (C. L. Lawson, in: Mathematical Software III, 1977, 161-194). The sign of an area is
exact: coordinates are rounded to a grid on which differences are, and products are taken in two parts (T. J. Dekker, Numer.
Math. 18, 1971, 224-242). An edge is flipped only where the sign of the circle's determinant is sure (bound of J. R. Shewchuk,
Discrete Comput. Geom. 18, 1997, 305-363), so that every flip lowers the lifted surface and none makes a triangle overlap:
cocircular points keep one of their triangulations. The time grows as N, where Qhull's grows by its misses of the cache.
"""

import numpy as np

from rkverify.solid.compiling import compiled
from rkverify.solid.kernel_values import Array

GRID = 2.0**50
"""Coordinates below 4 in magnitude are multiples of 1/GRID, so that differences are exact doubles."""
IN_CIRCLE = 1.2e-15
"""(10 + 96 u) u with the rounding unit u = 2^-53, rounded up: the relative error of the determinant's terms."""
CURVE = 16


@compiled
def _curve(x: Array, y: Array) -> Array:
    """Where points (N,) with coordinates between -1 and 1 are along a Hilbert curve of 4^CURVE cells."""
    cells = 1 << CURVE
    place = np.empty(len(x), dtype=np.int64)
    for n in range(len(x)):
        a = min(max(int((x[n] + 1) / 2 * cells), 0), cells - 1)
        b = min(max(int((y[n] + 1) / 2 * cells), 0), cells - 1)
        at, s = 0, cells >> 1
        while s > 0:
            right, up = (a & s) > 0, (b & s) > 0
            at += s * s * ((3 * right) ^ up)
            if not up:
                if right:
                    a, b = cells - 1 - a, cells - 1 - b
                a, b = b, a
            s >>= 1
        place[n] = at
    return place


@compiled
def _two_parts(a: float, b: float) -> tuple[float, float]:
    """a b as the sum of two doubles."""
    product = a * b
    big = 134217729.0 * a
    ah = big - (big - a)
    big = 134217729.0 * b
    bh = big - (big - b)
    al, bl = a - ah, b - bh
    return product, al * bl - (((product - ah * bh) - al * bh) - ah * bl)


@compiled
def _turn(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    """A number with the exact sign of the area of a, b, c, for coordinates on the grid."""
    p, q = (bx - ax) * (cy - ay), (by - ay) * (cx - ax)
    if abs(p - q) > 4.5e-16 * (abs(p) + abs(q)):
        return p - q
    p, p_low = _two_parts(bx - ax, cy - ay)
    q, q_low = _two_parts(by - ay, cx - ax)
    return (p - q) + (p_low - q_low)


@compiled
def _surely_inside(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float) -> bool:
    """Whether d is inside the circle through a, b, c (counter-clockwise) by more than rounding."""
    ax, ay, bx, by, cx, cy = ax - dx, ay - dy, bx - dx, by - dy, cx - dx, cy - dy
    bc, cb, ca, ac, ab, ba = bx * cy, cx * by, cx * ay, ax * cy, ax * by, bx * ay
    a, b, c = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    size = a * (abs(bc) + abs(cb)) + b * (abs(ca) + abs(ac)) + c * (abs(ab) + abs(ba))
    return a * (bc - cb) + b * (ca - ac) + c * (ab - ba) > IN_CIRCLE * size


@compiled
def _located(
    x: Array, y: Array, v: Array, nb: Array, count: int, t: int, px: float, py: float
) -> tuple[int, int, bool]:
    """The triangle that contains a point, the edge that it is on or -1, and whether it is one of the vertices."""
    for _ in range(count):
        on, zeros, moved = -1, 0, False
        for k in range(3):
            a, b = v[t, (k + 1) % 3], v[t, (k + 2) % 3]
            side = _turn(x[a], y[a], x[b], y[b], px, py)
            if side < 0:
                t, moved = nb[t, k], True
                break
            if side == 0:
                on, zeros = k, zeros + 1
        if not moved:
            return t, on, zeros > 1
    return -1, -1, False


@compiled
def _linked(nb: Array, s: int, old: int, new: int) -> None:
    if s >= 0:
        k = 0 if nb[s, 0] == old else (1 if nb[s, 1] == old else 2)
        nb[s, k] = new


@compiled
def _flipped(v: Array, nb: Array, t: int, s: int, k: int) -> None:
    """(a, b, p) and (b, a, d), where d is vertex k of s, become (a, d, p) and (d, b, p)."""
    b, p, d = v[t, 1], v[t, 2], v[s, k]
    ad, db, bp = nb[s, (k + 1) % 3], nb[s, (k + 2) % 3], nb[t, 0]
    v[t, 1] = d
    v[s, 0], v[s, 1], v[s, 2] = d, b, p
    nb[t, 0], nb[t, 2] = s, ad
    nb[s, 0], nb[s, 1], nb[s, 2] = bp, t, db
    _linked(nb, ad, s, t)
    _linked(nb, bp, t, s)


@compiled
def _completed(x: Array, y: Array, v: Array, nb: Array) -> None:
    """Flip what is left: an insertion looks at the edges around the new point, and ties that were kept before may add up."""
    changed = True
    while changed:
        changed = False
        for t in range(len(v)):
            for k in range(3):
                s = nb[t, k]
                if s < t:
                    continue
                m = 0 if nb[s, 0] == t else (1 if nb[s, 1] == t else 2)
                a, b, p, d = v[t, (k + 1) % 3], v[t, (k + 2) % 3], v[t, k], v[s, m]
                if _surely_inside(x[a], y[a], x[b], y[b], x[p], y[p], x[d], y[d]):
                    v[t, 0], v[t, 1], v[t, 2] = a, b, p
                    nb[t, 0], nb[t, 1], nb[t, 2] = nb[t, (k + 1) % 3], nb[t, (k + 2) % 3], s
                    _flipped(v, nb, t, s, m)
                    changed = True
                    break


@compiled
def _inserted(x: Array, y: Array) -> tuple[Array, Array, int]:
    """Triangles and neighbours of points (N + 3,), the last three around the others and N; or the number of one that is doubled, or -1 if one was not found."""
    n = len(x) - 3
    v, nb = np.empty((2 * n + 1, 3), dtype=np.int32), np.empty((2 * n + 1, 3), dtype=np.int32)
    v[0, 0], v[0, 1], v[0, 2] = n, n + 1, n + 2
    nb[0, :] = -1
    stack = np.empty(6 * n + 64, dtype=np.int32)
    count, t = 1, 0
    for p in range(n):
        t, on, doubled = _located(x, y, v, nb, 2 * count + 16, t, x[p], y[p])
        if t < 0:
            return v, nb, -1
        if doubled:
            return v, nb, p
        # (a, b, c) becomes (a, b, p), (b, c, p), (c, a, p): the new point is always the last vertex.
        a, b, c = v[t, 0], v[t, 1], v[t, 2]
        na, nc, second, third = nb[t, 0], nb[t, 1], count, count + 1
        v[t, 2] = p
        v[second, 0], v[second, 1], v[second, 2] = b, c, p
        v[third, 0], v[third, 1], v[third, 2] = c, a, p
        nb[second, 0], nb[second, 1], nb[second, 2] = third, t, na
        nb[third, 0], nb[third, 1], nb[third, 2] = t, second, nc
        nb[t, 0], nb[t, 1] = second, third
        _linked(nb, na, t, second)
        _linked(nb, nc, t, third)
        count += 2
        flat = t if on == 2 else (second if on == 0 else (third if on == 1 else -1))
        stack[0], stack[1], stack[2] = t, second, third
        depth = 3
        while depth:
            depth -= 1
            t = stack[depth]
            s = nb[t, 2]
            if s < 0:
                continue
            k = 0 if nb[s, 0] == t else (1 if nb[s, 1] == t else 2)
            a, b, d = v[t, 0], v[t, 1], v[s, k]
            # Without area, on the edge where the point was found, the triangle has no circle.
            if t != flat and not _surely_inside(x[a], y[a], x[b], y[b], x[p], y[p], x[d], y[d]):
                continue
            if t == flat:
                flat = -1
            _flipped(v, nb, t, s, k)
            stack[depth], stack[depth + 1] = t, s
            depth += 2
    _completed(x, y, v, nb)
    return v, nb, n


def triangulated(x: Array) -> tuple[Array, Array, int]:
    """Triangles (T, 3), counter-clockwise, and their neighbours (T, 3) opposite to each vertex, -1 for none; and -1 or a doubled point.

    x (N + 3, 2): points below 1 in magnitude, then three below 4 around them, counter-clockwise. The third result is a
    point that is at the place of another one on the grid; then there are no triangles.
    """
    n = len(x) - 3
    a, b = (np.round(column * GRID) / GRID for column in x.T)
    order = np.concatenate([np.argsort(_curve(a[:n], b[:n])), [n, n + 1, n + 2]])
    triangles, neighbours, count = _inserted(a[order], b[order])
    if count < 0:
        raise AssertionError("a point is in no triangle")
    if count < n:
        return triangles[:0], neighbours[:0], int(order[count])
    return order.astype(np.int32)[triangles], neighbours, -1
