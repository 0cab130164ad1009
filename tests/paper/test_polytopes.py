"""Polytopes cut by half-spaces, and the nodal cells that are nothing else, in one to three dimensions and any arithmetic."""

from collections import Counter
from fractions import Fraction
from itertools import product

import pytest

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.certify.samples import jittered_grid
from rkverify.errors import BadInput, CoincidentNodes, NotDifferentiable
from rkverify.paper.cells import nodal_cells
from rkverify.paper.clipping import ROUNDINGS, clip, rounding_of_heights
from rkverify.paper.nodal_polytopes import nodal_polytope, nodal_polytopes
from rkverify.paper.polytopes import Polytope, box, cross, polygon
from rkverify.paper.quadrature import boundary_points

K = Exact()
SIDES = {1: 6, 2: 4, 3: 3}
SPACES = pytest.mark.parametrize("d", [1, 2, 3])


def domain(d: int, arithmetic: Arithmetic = K) -> Polytope:
    return box([-1] * d, [Fraction(2 * SIDES[d] + j, 2) for j in range(d)], arithmetic)


def nodes(d: int, arithmetic: Arithmetic = K, seed: int = 7) -> list[tuple]:
    return [tuple(map(arithmetic.number, place)) for place in jittered_grid(d, SIDES[d], seed)]


def lattice(d: int, spacing: Fraction, arithmetic: Arithmetic) -> tuple[list[tuple], Polytope]:
    places = [tuple(arithmetic.number(spacing * c) for c in place) for place in product(range(3), repeat=d)]
    return places, box([0] * d, [2 * spacing] * d, arithmetic)


def closed(P: Polytope) -> bool:
    return all(sum(P.area(f)[j] for f in range(len(P.facets))) == 0 for j in range(P.dimension))


@SPACES
def test_the_measure_of_a_box(d: int) -> None:
    """By the divergence theorem, with its facets' area vectors outward and their sum zero."""
    P = box([0] * d, [2, 3, 5][:d], K)
    assert P.measure == [2, 6, 30][d - 1]
    assert closed(P)
    middle = tuple(Fraction(s, 2) for s in (2, 3, 5)[:d])
    assert [P.cone(f, middle) for f in range(2 * d)] == [Fraction(P.measure, 2 * d)] * (2 * d)


@SPACES
def test_cells_tile_and_close_exactly(d: int) -> None:
    """Measures sum to the domain's; every cell's area vectors sum to 0; a facet is its neighbour's, the other way round."""
    cells = nodal_polytopes(nodes(d), domain(d), K)
    assert sum(cell.measure for cell in cells) == domain(d).measure
    assert all(cell.measure > 0 and closed(cell) for cell in cells)
    seen = Counter()
    for I, cell in enumerate(cells):
        for f, J in enumerate(cell.beyond):
            if J is not None:
                back = cells[J].beyond.index(I)
                assert cells[J].area(back) == tuple(-c for c in cell.area(f))
                assert sorted(cells[J].places(back)) == sorted(cell.places(f))
            else:
                seen[cell.area(f)[0] == 0] += 1
    assert len(seen) == (1 if d == 1 else 2)


@SPACES
def test_corners_are_no_nearer_to_any_other_node(d: int) -> None:
    """The definition of a Voronoi cell, at its corners, and with it everywhere in it; equally near where a facet says so."""
    places = nodes(d)
    for I, cell in enumerate(nodal_polytopes(places, domain(d), K)):

        def squared(x: tuple, J: int) -> Fraction:
            return sum((p - q) ** 2 for p, q in zip(x, places[J], strict=True))

        for x in cell.corners:
            assert squared(x, I) == min(squared(x, J) for J in range(len(places)))
        for f, J in enumerate(cell.beyond):
            assert J is None or all(squared(x, I) == squared(x, J) for x in cell.places(f))


def test_on_a_line_they_are_the_cells_between_mid_points() -> None:
    places = nodes(1)
    ends = domain(1).corners
    for P, cell in zip(
        nodal_polytopes(places, domain(1), K),
        nodal_cells([x for (x,) in places], ends[0][0], ends[1][0], K),
        strict=True,
    ):
        assert (P.places(0), P.places(1), P.measure) == ([(cell.left,)], [(cell.right,)], cell.measure)
        assert (P.area(0), P.area(1)) == ((-1,), (1,))


def test_facets_in_space_are_plane_and_turn_outwards() -> None:
    """Corners of a facet go counter-clockwise seen from outside: every turn has the sense of the area vector."""
    for cell in nodal_polytopes(nodes(3), domain(3), K):
        edges = Counter()
        for f, facet in enumerate(cell.facets):
            N, ring = cell.area(f), cell.places(f)
            for k in range(len(ring)):
                p, q, r = ring[k - 2], ring[k - 1], ring[k]
                turn = cross(
                    tuple(b - a for a, b in zip(p, q, strict=True)), tuple(b - a for a, b in zip(q, r, strict=True))
                )
                assert cross(turn, N) == (0, 0, 0)
                assert sum(s * t for s, t in zip(turn, N, strict=True)) > 0
                edges[frozenset((facet[k - 1], facet[k]))] += 1
        assert set(edges.values()) == {2}  # every edge lies between two facets
        assert len(cell.corners) - len(edges) + len(cell.facets) == 2  # Euler


@SPACES
@pytest.mark.parametrize("K", [Exact(), Float(), Multiprecision(20)], ids=lambda K: K.name)
def test_lattices_where_many_cells_meet_in_one_point(d: int, K: Arithmetic) -> None:
    """A spacing of 1/10 is no double: corners where 2^d cells meet are decided alike by all, and cells are boxes.

    Measures: d products of numbers below 1, some ten roundings.
    """
    places, whole = lattice(d, Fraction(1, 10), K)
    for x, cell in zip(places, nodal_polytopes(places, whole, K), strict=True):
        assert len(cell.facets) == 2 * d
        share = 1
        for c in x:
            share = share * (K.ratio(1, 10) if 0 < float(c) < 0.19 else K.ratio(1, 20))
        assert abs(float(cell.measure - share)) <= 20 * K.epsilon


@SPACES
def test_cells_follow_their_nodes(d: int) -> None:
    """Duals carry dA_L/dx_Ij through the cuts: against exact differences, which fall by four for half the step, and complex steps.

    The sum over the cells is 0, as the domain stays.
    """
    D, C, I = Duals(K, 1), Complex(), SIDES[d] ** d // 2
    places = nodes(d)

    def moved(arithmetic: Arithmetic, by: object) -> list[tuple]:
        return [
            tuple(arithmetic.number(c) + (by if (J, j) == (I, 0) else 0) for j, c in enumerate(x))
            for J, x in enumerate(places)
        ]

    watched = [J for J in nodal_polytope(places, I, domain(d), K).beyond if J is not None] + [I]
    with_slopes = nodal_polytopes(moved(D, D.variable(0, 0)), domain(d, D), D)
    slopes = [cell.measure.partials[0] for cell in with_slopes]
    assert sum(slopes) == 0
    errors = []
    for step in (Fraction(1, 1000), Fraction(1, 2000)):
        ahead, behind = (nodal_polytopes(moved(K, s * step), domain(d), K) for s in (1, -1))
        errors.append([(ahead[J].measure - behind[J].measure) / (2 * step) - slopes[J] for J in watched])
    if d == 1:
        assert errors == [[0] * len(watched)] * 2  # mid-points are linear in the nodes
    else:
        worst, better = (max(map(abs, error)) for error in errors)
        assert 0 < worst < Fraction(1, 10**4)
        assert abs(worst / better - 4) < Fraction(1, 100)
    stepped = nodal_polytopes(moved(C, 1e-100j), domain(d, C), C)
    assert max(abs(float(slopes[J]) - stepped[J].measure.imag / 1e-100) for J in watched) < 1e-12


@pytest.mark.parametrize("d", [2, 3])
def test_cells_of_a_lattice_follow_their_nodes(d: int) -> None:
    """Where 2^d cells meet in one point, a moved node parts them, one way or the other; measures have a derivative all the same.

    Against exact differences to one side, whose error falls by two for half the step: their second derivative jumps.
    """
    D, I = Duals(K, 1), 3**d // 2
    places, whole = lattice(d, Fraction(1), K)
    direction = tuple(Fraction(j + 1, 3) for j in range(d))

    def moved(arithmetic: Arithmetic, by: object) -> list[tuple]:
        return [
            tuple(arithmetic.number(c) + (u * by if J == I else 0) for c, u in zip(x, direction, strict=True))
            for J, x in enumerate(places)
        ]

    slopes = [
        cell.measure.partials[0]
        for cell in nodal_polytopes(moved(D, D.variable(0, 0)), lattice(d, Fraction(1), D)[1], D)
    ]
    assert sum(slopes) == 0
    assert slopes[I] == 0  # by symmetry: what it gains on one side it loses on the other
    assert any(slopes)
    at_rest = [cell.measure for cell in nodal_polytopes(places, whole, K)]
    errors = []
    for step in (Fraction(1, 1000), Fraction(1, 2000)):
        ahead = [cell.measure for cell in nodal_polytopes(moved(K, step), whole, K)]
        errors.append(max(abs((a - r) / step - s) for a, r, s in zip(ahead, at_rest, slopes, strict=True)))
    assert 0 < errors[0] < Fraction(1, 200)
    assert abs(errors[0] / errors[1] - 2) < Fraction(1, 50)


def test_a_convex_polygon_as_domain() -> None:
    """A hexagon is tiled too; a re-entrant corner or clockwise corners are refused, naming the corner."""
    corners = [(0, 0), (4, -1), (6, 2), (5, 5), (1, 6), (-1, 3)]
    hexagon = polygon(corners, K)
    assert hexagon.measure == Fraction(14 + 20 + 25 + 9, 2)  # x_k y_k+1 - x_k+1 y_k, the zeros left out
    places = [K_point(p) for p in [(0, 0), (1, 1), (4, 2), (3, 4), (2, 3), (1, 5)]]
    cells = nodal_polytopes(places, hexagon, K)
    assert sum(cell.measure for cell in cells) == hexagon.measure
    with pytest.raises(BadInput, match=r"corner 2 of the polygon at \(1, 1\) does not turn left"):
        polygon([(0, 0), (4, 0), (1, 1), (0, 4)], K)
    with pytest.raises(BadInput, match="counter-clockwise"):
        polygon(corners[::-1], K)


def K_point(place: tuple[int, int]) -> tuple[Fraction, ...]:
    return tuple(map(K.number, place))


@SPACES
def test_a_cut_and_its_complement_make_the_whole(d: int) -> None:
    """A plane through the middle, one through a corner only, and one that misses: parts add up, and what touches stays."""
    P, normal = box([0] * d, [1] * d, K), tuple(Fraction(j + 1) for j in range(d))
    middle, zero = tuple([Fraction(1, 2)] * d), tuple([Fraction(0)] * d)
    low, high = clip(P, middle, normal, 5, K), clip(P, middle, tuple(-n for n in normal), 5, K)
    assert low.measure == high.measure == P.measure / 2
    assert low.beyond.count(5) == high.beyond.count(5) == 1
    assert closed(low)
    assert low.area(low.beyond.index(5)) == tuple(-c for c in high.area(high.beyond.index(5)))
    assert clip(P, zero, tuple(-n for n in normal), 5, K) is P
    with pytest.raises(BadInput, match="leaves nothing"):
        clip(P, zero, normal, 5, K)


def test_a_cut_through_corners_and_along_an_edge() -> None:
    """Signs of 0: the diagonal plane of a cube runs through four corners and two edges, and leaves half."""
    cube = box([0] * 3, [1] * 3, K)
    half = clip(cube, K_point((0, 0, 0)), (Fraction(1), Fraction(-1), Fraction(0)), None, K)  # type: ignore[arg-type]
    assert (half.measure, len(half.corners), len(half.facets)) == (Fraction(1, 2), 6, 5)
    corner = clip(cube, (Fraction(1), Fraction(0), Fraction(0)), (Fraction(1),) * 3, None, K)
    assert (corner.measure, len(corner.corners), len(corner.facets)) == (Fraction(1, 6), 4, 4)


def test_what_cannot_be_a_set_of_cells_is_refused() -> None:
    with pytest.raises(BadInput, match=r"node 1 at \(3, 1\) lies outside the domain: move it or widen"):
        nodal_polytopes([K_point((1, 1)), K_point((3, 1))], box([0, 0], [2, 2], K), K)
    with pytest.raises(CoincidentNodes, match=r"nodes 0 and 2 are both at \(1, 1\)"):
        nodal_polytopes([K_point(p) for p in [(1, 1), (2, 1), (1, 1)]], box([0, 0], [2, 2], K), K)
    with pytest.raises(BadInput, match="is empty: give low below high"):
        box([0, 1], [1, 1], K)
    with pytest.raises(BadInput, match="4 dimensions is not offered"):
        box([0] * 4, [1] * 4, K)
    assert (
        nodal_polytopes([K_point((0, 0))], box([0, 0], [2, 2], K), K)[0].measure == 4
    )  # a node on the boundary is normal


def test_corners_part_where_a_moved_node_has_them() -> None:
    """Four cells meet in each corner inside a square lattice: of the cells that the moved node touches these corners part.

    Nothing parts where nothing moves, nor on uneven nodes, nor far away; a rule on sides that part is refused.
    """
    places, whole = lattice(2, Fraction(1), K)
    D = Duals(K, 1)
    moved = [tuple(D.number(c) + (D.variable(0, 0) if (I, j) == (0, 0) else 0) for j, c in enumerate(x)) for I, x in enumerate(places)]  # fmt: skip
    cells = nodal_polytopes(moved, lattice(2, Fraction(1), D)[1], D)
    half = Fraction(1, 2)
    parted = [{tuple(c.value for c in X) for X in cell.parting} for cell in cells]
    # places are (0, 0), (0, 1), (0, 2), (1, 0), …: node 0 meets 1, 3 and 4 in (1/2, 1/2)
    assert [(half, half) in corners for corners in parted] == [
        True,
        True,
        False,
        True,
        True,
        False,
        False,
        False,
        False,
    ]
    assert not parted[8]
    assert not any(cell.parting for cell in nodal_polytopes(places, whole, K))
    uneven = [tuple(D.number(c) + (D.variable(0, 0) if I == 7 else 0) for c in x) for I, x in enumerate(nodes(2))]
    assert not any(cell.parting for cell in nodal_polytopes(uneven, domain(2, D), D))
    with pytest.raises(NotDifferentiable, match=r"more cells than 3 meet at \(1/2 .*, 1/2 .*\)"):
        boundary_points(cells[0], "midpoint", D)
    assert boundary_points(cells[8], "midpoint", D)


def test_what_rounding_may_make_of_a_height() -> None:
    """64 epsilon, times the largest coordinate, times the sum of the normal's: in other units it is that of the units."""
    F, X = Float(), ((3.0, -5.0), (1.0, 2.0))
    found = rounding_of_heights(X, (0.5, 4.0), (0.25, -1.5), F)
    assert found == pytest.approx(ROUNDINGS * F.epsilon * 5.0 * 1.75, rel=1e-15, abs=0)
    assert ROUNDINGS == 64
    far = rounding_of_heights(X, (0.5, -7.0), (0.5, -3.0), F)
    assert far == pytest.approx(found * 7 / 5 * 2, rel=1e-15, abs=0)
    assert rounding_of_heights(X, (0, 0), (1, 1), K) == 0
