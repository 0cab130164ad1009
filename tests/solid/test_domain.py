"""Domains: what is inside, what has which area, and what is refused before it can spoil a cell."""

import re

import numpy as np
import pytest

from rkverify.errors import BadInput
from rkverify.solid.domain import Box, Domain, box, checked_domain, polygon_domain

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
HOLE = [(1, 1), (2, 1), (2, 2), (1, 2)]


def test_rings_are_turned_so_that_the_domain_is_on_their_left() -> None:
    """Everything that walks along a boundary takes the left for inside: in whatever order a file lists the vertices."""
    for outline in (SQUARE, SQUARE[::-1]):
        for hole in (HOLE, HOLE[::-1], [*HOLE, HOLE[0]]):
            domain = polygon_domain([outline, hole])
            areas = [_area(ring) for ring in domain.rings]
            assert areas == [16.0, -1.0]
            assert domain.measure == 15.0
            assert [len(ring) for ring in domain.rings] == [4, 4]


def _area(ring: np.ndarray) -> float:
    x, y = ring.T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


def test_inside_on_the_boundary_and_outside() -> None:
    """Nodes on the boundary, on corners and on a hole's edge are normal; in the hole or a millionth outside is out."""
    domain = polygon_domain([SQUARE, HOLE])
    inside = [(0.5, 0.5), (0, 0), (4, 2), (1, 1.5), (2, 2), (3, 3)]
    outside = [(1.5, 1.5), (4 + 1e-6, 2), (-1, 0), (1 + 1e-6, 1.5)]
    assert domain.contains(np.array(inside, dtype=float)).all()
    assert not domain.contains(np.array(outside)).any()
    turned = np.array([[0.6, 0.8], [-0.8, 0.6]])  # its corners are rounded: the middle of an edge is on it all the same
    slanted = polygon_domain([np.array(SQUARE) @ turned * 0.1])
    assert slanted.contains(np.array([(0.0, 1.3)]) @ turned * 0.1).all()


@pytest.mark.parametrize("d", [1, 2, 3])
def test_a_box_measures_the_product_of_its_sides(d: int) -> None:
    """In every dimension; its corners are in it, a point a millionth further is not."""
    b = box([0.0, -1, 2][:d], [2.0, 2, 2.5][:d])
    assert b.measure == np.prod([2, 3, 0.5][:d])
    assert b.contains(np.array([b.low, b.high])).all()
    assert not b.contains(np.array([b.low - 1e-6, b.high + 1e-6])).any()


def test_the_box_in_the_plane_is_the_polygon_of_its_corners() -> None:
    """So that cells in a box and in the same polygon are the same."""
    b = box([0, 1], [4, 3])
    assert polygon_domain(b.rings).measure == b.measure
    assert isinstance(b, Box)
    assert isinstance(polygon_domain(b.rings), Domain)


@pytest.mark.parametrize(
    ("rings", "message"),
    [
        ([], "no ring"),
        ([[(0, 0), (1, 0)]], "ring 0 of the domain has 2 different vertices"),
        ([[(0, 0), (1, 0), (0, 0)]], "ring 0 of the domain has 2 different vertices"),
        ([[(0, 0), (1, 0), (1, float("nan"))]], r"ring 0 of the domain has vertex 2 at \(1, nan\)"),
        ([[(0, 0), (1, 0), (1, 0), (1, 1)]], r"ring 0 of the domain has vertex 1 at \(1, 0\) twice"),
        ([[(0, 0), (1, 0), (2, 0)]], "ring 0 of the domain has no area"),
        ([[(0, 0, 0), (1, 0, 0), (2, 1, 0)]], r"ring 0 of the domain has shape \(3, 3\)"),
        ([[(0, 0), (1, 0), ("a", 1)]], "ring 0 of the domain is no table of numbers"),
        (
            [[(0, 0), (1, 1), (1, 0), (0, 1)]],
            r"ring 0 of the domain is not simple: its edge from vertex 0 meets .* 2 at \(0.5, 0.5\)",
        ),
        ([[(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)]], r"ring 0 of the domain is not simple: .* at \(2, 0\)"),
        ([[(0, 0), (4, 0), (2, 0), (2, 4)]], "ring 0 of the domain is not simple"),
        ([SQUARE, [(5, 5), (6, 5), (6, 6)]], r"vertex \d of ring 1 of the domain, at .* is outside the outline"),
        ([SQUARE, [(3, 3), (6, 3), (6, 3.5)]], "its edge from vertex 1 meets the edge from vertex . of ring 1"),
        ([SQUARE, HOLE, [(1.2, 1.2), (1.8, 1.2), (1.5, 1.6)]], "rings 1 and 2 of the domain overlap"),
        ([SQUARE, HOLE, [(1.5, 1.5), (3, 1.5), (3, 3)]], "not simple"),
    ],
)
def test_an_unusable_polygon_is_refused_in_one_line(rings: list, message: str) -> None:
    """Ring and vertex are named: a file of ten thousand vertices cannot be searched by eye."""
    with pytest.raises(BadInput, match=message) as raised:
        polygon_domain(rings)
    assert "\n" not in str(raised.value)


def test_rings_may_touch_in_a_point() -> None:
    """The twin of the refused ones: a hole with a corner on the outline, or on another hole's corner, leaves a domain."""
    touching = [(0, 2), (1, 1.5), (1, 2.5)]
    assert polygon_domain([SQUARE, touching]).measure == 15.5
    assert polygon_domain([SQUARE, HOLE, [(2, 2), (3, 2), (3, 3)]]).measure == 14.5


@pytest.mark.parametrize(
    ("low", "high", "message"),
    [
        ([0, 0], [1], "shapes"),
        ([0], [1, 1], "shapes"),
        ([0, 0], [1, 0], "goes from 0 to 0 along axis 1"),
        ([0, 0], [1, float("inf")], "goes from 0 to inf along axis 1"),
        ([0] * 4, [1] * 4, "1, 2 or 3 coordinates"),
    ],
)
def test_an_unusable_box_is_refused(low: list[float], high: list[float], message: str) -> None:
    """An empty or infinite box has no cells."""
    with pytest.raises(BadInput, match=message):
        box(low, high)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_a_domain_of_fewer_or_of_more_dimensions_than_the_nodes_is_refused(d: int) -> None:
    """Cells of nodes in the plane in a box in space, or on a line, would have measures of another unit."""
    for other in (1, 2, 3):
        if other == d:
            checked_domain(box([0] * d, [1] * d), d)
            continue
        with pytest.raises(BadInput, match=f"^the nodes have {other} coordinates and the domain {d}: give both"):
            checked_domain(box([0] * d, [1] * d), other)


def test_the_place_of_a_crossing_is_that_of_its_edges() -> None:
    """Two places where this ring crosses itself: the one that is named belongs to the two edges that are named."""
    ring = np.array([(0, 0), (6, 0), (6, 2), (5, -1), (3, -1), (2, 2), (0, 2)], dtype=float)
    with pytest.raises(BadInput, match="not simple") as raised:
        polygon_domain([ring])
    said = re.search(r"from vertex (\d) meets the edge from its vertex (\d) at \((.*), (.*)\)", str(raised.value))
    assert said
    for number in said.groups()[:2]:
        a, b = ring[int(number)], ring[(int(number) + 1) % 7]
        p = np.array([float(c) for c in said.groups()[2:]])
        assert abs((b - a)[0] * (p - a)[1] - (b - a)[1] * (p - a)[0]) < 1e-9
        assert 0 < (p - a) @ (b - a) < (b - a) @ (b - a)
