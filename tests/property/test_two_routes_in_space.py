"""The transcription and the compiled code on random nodes in one to three dimensions: two sets of lines, one set of numbers."""

from dataclasses import replace
from fractions import Fraction
from itertools import combinations_with_replacement

import pytest
from hypothesis import assume, example, given, target
from hypothesis import strategies as st

from rkverify.certify import two_routes_in_space
from rkverify.certify.two_routes_in_space import (
    GRAIN,
    PER_SIDE,
    REACH,
    SMOOTH,
    Case,
    Disagreement,
    cell_disagreements,
    disagreements,
    drawn,
    gradient_disagreements,
    moved_grid,
    shape_disagreements,
)
from rkverify.solid.cloud import Cloud

RULES = ("trapezoid", "midpoint", "gauss:2", "gauss:3")


@st.composite
def cases(draw: st.DrawFn, dimensions: tuple[int, ...] = (1, 1, 1, 2, 2, 2, 2, 3)) -> Case:
    """Nodes within a third of a spacing of a grid's: no cell can lose its node, and nothing is nearly singular for order 2.

    Many steps of 0 are wanted: nodes in rows, and cells that meet by four and by eight. Three dimensions are rarer, as
    they take a second.
    """
    d = draw(st.sampled_from(dimensions))
    side = PER_SIDE[d]
    count = side**d
    steps = draw(st.lists(st.integers(-22, 22), min_size=count * d, max_size=count * d))
    common = draw(st.booleans())
    more = (
        [draw(st.integers(0, 8))] * count
        if common
        else draw(st.lists(st.integers(0, 8), min_size=count, max_size=count))
    )
    nodes = moved_grid(d, steps)
    anywhere = tuple(Fraction(draw(st.integers(-GRAIN // 2, GRAIN * side - GRAIN // 2)), GRAIN) for _ in range(d))
    at_node = draw(st.booleans())
    return Case(
        nodes=nodes,
        supports=tuple(REACH + Fraction(m, 16) for m in more),
        kernel=draw(st.sampled_from(SMOOTH)),
        order=draw(st.integers(0, 2)),
        window=draw(st.sampled_from(["radial", "tensor"])),
        point=nodes[draw(st.integers(0, count - 1))] if at_node else anywhere,
        cell=draw(st.integers(0, count - 1)),
        rule=draw(st.sampled_from(RULES)),
        axes=draw(st.sampled_from(list(combinations_with_replacement(range(d), 2)))),
    )  # fmt: skip


def ratios(found: list[Disagreement]) -> dict[str, float]:
    return {each.quantity: each.ratio for each in found}


@given(case=cases())
@example(case=drawn(1, 0, "radial", True, 2))
@example(case=drawn(2, 2, "tensor", True, 2))
@example(case=drawn(3, 1, "radial", True, 1))
def test_both_routes_give_the_same_numbers(case: Case) -> None:
    """Values, first and second derivatives, smoothed gradients, cells: neither file imports the other, so that a mistake
    would have to be made twice. hypothesis climbs towards the largest difference over its bound.

    The bounds: 1e-13, 1e-11, 1e-9 of the size times the condition number of the moment matrix, each further derivative
    being built on one more solution with it; cells to 1e-13 and 1e-12 of the box.
    """
    found = ratios(disagreements(case))
    for quantity, ratio in found.items():
        target(ratio, label=quantity)
    assert max(found.values()) <= 1, found


def test_lattices_too() -> None:
    """No node moved: rows of nodes, points on the edges of supports, and 2^d cells in one point, in every dimension."""
    for d in (1, 2, 3):
        for window in ("radial", "tensor"):
            nodes = moved_grid(d, [0] * (PER_SIDE[d] ** d * d))
            supports = (Fraction(7, 2),) * len(nodes)
            case = Case(nodes, supports, "cubic", 1, window, (Fraction(1),) * d, 0, "trapezoid", (0, d - 1))
            assert max(ratios(disagreements(case)).values()) <= 1


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("d", [2, 3])
def test_every_rule_on_facets_of_every_form(d: int, rule: str) -> None:
    """Polygons of a lattice are squares, on which rules with mistaken weights agree: here they have unequal sides."""
    case = replace(drawn(d, 1, "tensor", True, 4), rule=rule)
    assert ratios(gradient_disagreements(case))["smoothed"] <= 1


@given(case=cases((1, 2, 2)), node=st.integers(0, 5))
def test_the_twin_that_they_do_not_agree_with(case: Case, node: int) -> None:
    """One support larger by a 64th in one of the routes: where its kernel reaches, the numbers leave their bounds.

    So the bounds would see a support of another owner, one neighbour forgotten, or a kernel mistaken for another. Not with
    order 2 on a line, where three nodes leave the shape functions no choice; nor at the node, where phi(0) has no support.
    """
    case = replace(case, order=min(case.order, 1))
    original = two_routes_in_space._compiled

    def changed(given_case: Case) -> Cloud:
        right = original(given_case)
        supports = right.supports.copy()
        supports[node] += 1 / GRAIN
        return replace(right, supports=supports)

    reach = max(abs(p - q) for p, q in zip(case.point, case.nodes[node], strict=True))
    assume(Fraction(1, 4) < reach < case.supports[node] / 2)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(two_routes_in_space, "_compiled", changed)
        found = ratios(shape_disagreements(case))
    assert max(found.values()) > 1


def test_another_rule_is_seen() -> None:
    """The twin for smoothed gradients: trapezoid in one route and midpoint in the other differ by far more than the bound."""
    case = replace(drawn(2, 1, "radial", False, 0), rule="trapezoid")
    assert ratios(gradient_disagreements(case))["smoothed"] <= 1
    original = two_routes_in_space.scni
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(two_routes_in_space, "scni", lambda nodes, cells, rule: original(nodes, cells, "midpoint"))
        assert ratios(gradient_disagreements(case))["smoothed"] > 1


def test_a_moved_node_is_seen_in_the_cells() -> None:
    """The twin for cells: one node moved by 1e-9, a millionth of a pixel of what a drawing would show."""
    case = drawn(3, 1, "radial", False, 0)
    assert max(ratios(cell_disagreements(case)).values()) <= 1
    original = two_routes_in_space._compiled

    def moved(given_case: Case) -> Cloud:
        right = original(given_case)
        positions = right.positions.copy()
        positions[13, 0] += 1e-9
        return replace(right, positions=positions)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(two_routes_in_space, "_compiled", moved)
        assert min(ratios(cell_disagreements(case)).values()) > 1
