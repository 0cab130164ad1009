"""df_I/dx_J of a periodic node set through `paper/`, by duals: what `linearised` finds by complex steps through `solid/`."""

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.dual import Dual, Duals
from rkverify.arithmetic.native import Float
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.kernel_rates import minus
from rkverify.paper.nodal_polytopes import nodal_polytope
from rkverify.paper.polytopes import Polytope, box
from rkverify.paper.shape import Values
from rkverify.paper.smoothing import direct_gradients, smoothed_gradients
from rkverify.stability.bloch.lattices import Lattice
from rkverify.stability.bloch.scheme import Scheme

Slopes = dict[tuple[float, ...], list[list[float]]]
"""Place of node I, to 9 decimals, to the derivatives of sum_L a_L b_jI^L with respect to x_lJ [j][l]."""


def slopes(lattice: Lattice, scheme: Scheme, J: int, radius: float) -> Slopes:
    """sum_L d(a_L b_jI^L)/dx_lJ for node J of the period, of DNI, and of SNNI in the plane, from the nodes within 2 radii of it.

    radius: more than how far cells are that the node reaches, and than how far their nodes are from them.
    """
    d = lattice.dimension
    D = Duals(Float(), d)
    centre = [float(c) for c in lattice.nodes[J]]
    patch = [p for p in lattice.around(2 * radius).positions.tolist() if _apart(p, centre) < 2 * radius]
    nodes = [_place(p, centre, D) for p in patch]
    A = approximation(nodes, scheme.support, D, scheme.kernel, scheme.order, scheme.window)
    domain = box([c - 3 * radius for c in centre], [c + 3 * radius for c in centre], D)
    total: dict[int, list[Dual]] = {}
    for L, place in enumerate(patch):
        if _apart(place, centre) < radius:
            b = _gradients(scheme, A, L, domain, D)
            for I in b[0]:
                sums = total.setdefault(I, [D.zero() for _ in range(d)])
                total[I] = [s + part.get(I, D.zero()) for s, part in zip(sums, b, strict=True)]
    return {
        tuple(round(c, 9) for c in patch[I]): [[float(p) for p in s.partials] for s in sums]
        for I, sums in total.items()
    }


def _place(p: list[float], centre: list[float], D: Duals) -> Vector:
    if _apart(p, centre) > 1e-9:
        return tuple(D.number(c) for c in p)
    return tuple(D.variable(c, axis) for axis, c in enumerate(p))


def _apart(p: list[float], q: list[float]) -> float:
    return float(sum((a - b) ** 2 for a, b in zip(p, q, strict=True)) ** 0.5)


def _gradients(scheme: Scheme, A: Approximation, L: int, domain: Polytope, K: Duals) -> list[Values]:
    """a_L b_jI^L for every axis."""
    x = A.nodes[L]
    # Nearest nodes cut first: cuts far away would leave corners that are only known to their own rounding.
    near = sorted(A.nodes, key=lambda p: sum(K.witness(c) ** 2 for c in minus(p, x)))
    a = nodal_polytope(near, 0, domain, K).measure
    if scheme.cell_measure != "edges":
        a = K.number(a.value)
    if scheme.cell_measure == "material":
        # a' = a tr L = a sum_J b_lJ v_lJ: the moving node's share, with the gradients of the state at rest
        rest = _at_measure(scheme, A, x, a)
        a = K.along(a.value, [_of_mover(b, A) * a.value for b in rest])
    return [{I: value * a for I, value in b.items()} for b in _at_measure(scheme, A, x, a)]


def _of_mover(b: Values, A: Approximation) -> float:
    return sum(float(value.value) for I, value in b.items() if any(any(map(float, c.partials)) for c in A.nodes[I]))


def _at_measure(scheme: Scheme, A: Approximation, x: Vector, a: Scalar) -> tuple[Values, ...]:
    if scheme.integration == "dni":
        return direct_gradients(A, x, scheme.derivative)
    half = A.K.sqrt(a) / 2
    square = Polytope(
        tuple(
            tuple(c + s * half for c, s in zip(x, signs, strict=True)) for signs in ((-1, -1), (1, -1), (1, 1), (-1, 1))
        ),
        ((0, 1), (1, 2), (2, 3), (3, 0)),
        (None,) * 4,
    )
    return smoothed_gradients(A, square, scheme.rule)
