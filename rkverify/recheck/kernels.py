"""The kernels once more, from their definitions: B-splines by recursion, Wendland's functions multiplied out."""

from fractions import Fraction
from functools import cache

from rkverify.errors import BadInput
from rkverify.recheck.polynomials import Polynomial, derivative, plus, power, stretched, times, trimmed, value
from rkverify.recheck.reading import require

F = Fraction
ORDERS = {"tent": 2, "cubic": 4, "quartic": 5, "quintic": 6}
WENDLAND = {
    "wendland-c2": times(power([F(1), F(-1)], 4), [F(1), F(4)]),
    "wendland-c4": times(power([F(1), F(-1)], 6), [F(1), F(6), F(35, 3)]),
}
KERNELS = (*ORDERS, *WENDLAND)


@cache
def joints(kernel: str) -> tuple[Fraction, ...]:
    """0, the joints between, and 1."""
    if kernel in WENDLAND:
        return (F(0), F(1))
    if kernel not in ORDERS:
        raise BadInput(f"there is no kernel {str(kernel)[:40]!r}: it is one of {', '.join(KERNELS)}")
    n = ORDERS[kernel]
    return tuple(sorted({F(0), *(1 - F(2 * j, n) for j in range((n + 1) // 2))}))


def _spline(n: int, q: Fraction) -> Fraction:
    """The cardinal B-spline M_n(q): M_n = [(n/2 + q) M_(n-1)(q + 1/2) + (n/2 - q) M_(n-1)(q - 1/2)]/(n - 1)."""
    if n == 1:
        return F(int(-F(1, 2) <= q < F(1, 2)))
    half = F(n, 2)
    return ((half + q) * _spline(n - 1, q + F(1, 2)) + (half - q) * _spline(n - 1, q - F(1, 2))) / (n - 1)


def _through(places: list[Fraction], values: list[Fraction]) -> Polynomial:
    """The polynomial through these points (Newton's form)."""
    table, base = list(values), [F(1)]
    total: Polynomial = []
    for k, at in enumerate(places):
        total = plus(total, base, table[k])
        base = times(base, [-at, F(1)])
        for i in range(len(table) - 1, k, -1):
            table[i] = (table[i] - table[i - 1]) / (places[i] - places[i - k - 1])
    return trimmed(total)


@cache
def piece(kernel: str, low: Fraction, high: Fraction, order: int = 0) -> tuple[Fraction, ...]:
    """phi or a derivative on an interval of z that no joint divides, as a polynomial in z; empty beyond 1.

    Raises Rejected where a joint lies inside.
    """
    ends = joints(kernel)
    if low >= 1:
        return ()
    k = max(i for i, end in enumerate(ends) if end <= low)
    require(high <= ends[k + 1], f"a joint of the {kernel} kernel lies inside a piece")
    if kernel in WENDLAND:
        p = WENDLAND[kernel]
    else:
        n = ORDERS[kernel]
        a, b = ends[k], ends[k + 1]
        places = [a + (b - a) * F(j + 1, n + 1) for j in range(n)]
        p = _through(places, [_spline(n, z * n / 2) for z in places])
    for _ in range(order):
        p = derivative(p)
    return tuple(p)


def along(kernel: str, distance: Fraction, z: tuple[Fraction, Fraction], order: int = 0) -> Polynomial:
    """phi^(order)(distance z) as a polynomial in z, for z in an open interval."""
    return stretched(list(piece(kernel, distance * z[0], distance * z[1], order)), distance)


def jump(kernel: str, joint: Fraction, order: int) -> Fraction:
    """The jump of a derivative at a joint, from the left to the right; at 0 that of phi(|z|)."""
    ends = joints(kernel)
    at = ends.index(joint)
    right = value(piece(kernel, ends[at], ends[at + 1], order), joint) if at + 1 < len(ends) else F(0)
    if at == 0:
        return right - (-1) ** order * right
    return right - value(piece(kernel, ends[at - 1], ends[at], order), joint)
