"""Gradient operators that are not what they are sold as; every rule satisfies the linear sums, so that sums alone tell nothing.

All edge rules pass the patch test and give different numbers: a code that changes its rule unnoticed changes its results.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rkverify.check.claim import Claim, predicted, without
from rkverify.check.gradients import check_gradients
from rkverify.check.schemes import GradientClaim, Scheme, predicted_gradients
from rkverify.readings import DERIVATIVES
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.cloud import cloud, shown
from rkverify.solid.domain import box
from rkverify.solid.edge_rules import facet_rule
from rkverify.solid.neighbours import neighbours
from rkverify.solid.shape import shape
from rkverify.solid.voronoi import voronoi

RULES = ("trapezoid", "midpoint", "gauss:2", "gauss:3", "gauss:4")


@pytest.fixture
def claim(jittered):
    """claim(dimension, scheme) -> a claim on cells of a box, all supports large enough for its corners."""

    def make(dimension: int, scheme: Scheme) -> GradientClaim:
        nodes = jittered(dimension)
        cells = voronoi(nodes, box(nodes.min(axis=0) - 0.3, nodes.max(axis=0) + 0.3))
        return GradientClaim(cloud(nodes, 2.4), scheme, cells, np.arange(len(nodes)))

    return make


def columns(claim: GradientClaim) -> tuple[str, ...]:
    return tuple(f"b{axis}" for axis in "xyz"[: claim.cloud.dimension])


def sold(claim: GradientClaim, **change: object):
    return predicted_gradients(replace(claim, **change), columns(claim))


@pytest.mark.parametrize(
    "scheme", [Scheme("scni"), Scheme("scni", "gauss:2"), Scheme("dni"), Scheme("snni", "midpoint")]
)
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_honest_operators_pass(dimension, scheme, claim):
    one = claim(dimension, scheme)
    report = check_gradients(one, sold(one))
    assert report.passed, report.text()


@pytest.mark.parametrize(
    ("dimension", "claimed", "used"),
    [
        *((2, *pair) for pair in [*pairwise(RULES), *pairwise(RULES[::-1])]),
        (3, "trapezoid", "midpoint"),
        (3, "midpoint", "trapezoid"),
    ],
)
def test_an_edge_rule_other_than_claimed(dimension, claimed, used, claim):
    one = claim(dimension, Scheme("scni", claimed))
    report = check_gradients(one, sold(one, scheme=Scheme("scni", used)))
    sums = [f for f in report.findings if f.name.startswith("gradients")]
    assert sums
    assert all(f.holds for f in sums)
    assert f"scni with the edge rule {used}" in report.verdict
    assert f"what is claimed is scni with the edge rule {claimed}" in report.verdict


def test_rules_that_are_one_and_the_same_are_both_named(claim):
    """On an edge the midpoint is the Gauss rule of one point."""
    one = claim(2, Scheme("scni"))
    verdict = check_gradients(one, sold(one, scheme=Scheme("scni", "midpoint"))).verdict
    assert "edge rule midpoint or scni with the edge rule gauss:1" in verdict
    honest = claim(2, Scheme("scni", "gauss:1"))
    assert check_gradients(honest, sold(honest, scheme=Scheme("scni", "midpoint"))).passed


def test_the_integration_constraint_breaks_with_the_rule_inside_alone(claim):
    """Boundary by one rule and interior by another: the constraint is what links the two."""
    one = claim(2, Scheme("scni"))
    held = {f.name: f for f in check_gradients(one, sold(one, scheme=Scheme("scni", "midpoint"))).findings}
    assert not held["integration constraint"].holds
    assert {f.name: f for f in check_gradients(one, sold(one)).findings}["integration constraint"].holds


@pytest.mark.parametrize("used", [Scheme("dni"), Scheme("snni", "midpoint"), Scheme("dni", derivative="diffuse")])
def test_another_integration(used, claim):
    one = claim(2, Scheme("scni"))
    assert used.name in check_gradients(one, sold(one, scheme=used)).verdict


@pytest.mark.parametrize("reading", [reading for reading in DERIVATIVES if reading != "full"])
def test_direct_gradients_in_another_reading(reading, claim):
    one = replace(claim(2, Scheme("dni")), cells=None)
    assert (
        f"dni with {reading} derivatives"
        in check_gradients(one, sold(one, scheme=Scheme("dni", derivative=reading))).verdict
    )


def test_another_kernel_and_another_rule_at_once(claim):
    one = claim(2, Scheme("scni"))
    other = sold(one, cloud=cloud(one.cloud.positions, 2.4, "quintic"), scheme=Scheme("scni", "gauss:2"))
    verdict = check_gradients(one, other).verdict
    assert "the kernel quintic and scni with the edge rule gauss:2" in verdict


@pytest.mark.parametrize("rule", ["trapezoid", "gauss:2"])
@pytest.mark.parametrize("dimension", [1, 2])
def test_a_neighbour_lost_at_one_point_of_the_boundary(dimension, rule, claim):
    """All cells at this point are wrong, all their sums hold, and the node is still in every row."""
    one = claim(dimension, Scheme("scni", rule))
    honest = sold(one)
    points = facet_rule(one.cells, rule)
    q = len(points.points) // 2
    known = neighbours(one.cloud, points.points)
    node = int(known.of(q)[1])
    values = [
        shape(one.cloud, points.points, neighbours=n).matrix().toarray()
        for n in (known, without(one.cloud, points.points, {q: [node]}))
    ]
    change = points.matrix() @ (values[1] - values[0])
    numbers = honest.numbers.copy()
    for c in range(dimension):
        wrong = np.zeros((len(one.cloud), len(one.cloud)))
        for f, (left, right) in enumerate(one.cells.sides):
            wrong[left] += one.cells.areas[f, c] * change[f] / one.cells.measures[left]
            if right != OUTSIDE:
                wrong[right] -= one.cells.areas[f, c] * change[f] / one.cells.measures[right]
        numbers[:, c] += wrong[honest.rows, honest.nodes]
    report = check_gradients(one, replace(honest, numbers=numbers))
    assert all(f.holds for f in report.findings if f.name.startswith("gradients"))
    assert f"missing from the sums: node {node} at the point ({shown(points.points[q])})" in report.verdict


def test_a_neighbour_lost_at_a_node(claim):
    one = replace(claim(2, Scheme("dni")), cells=None)
    places = one.cloud.positions
    node = int(neighbours(one.cloud, places).of(40)[3])
    lost = predicted(Claim(one.cloud, places), ("dpsi_dx", "dpsi_dy"), without(one.cloud, places, {40: [node]}))
    verdict = check_gradients(one, replace(lost, columns=("bx", "by"))).verdict
    assert f"node {node}" in verdict
    assert "cell 40" in verdict


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_a_missing_neighbour_of_a_cell(dimension, claim):
    one = claim(dimension, Scheme("scni"))
    honest = sold(one)
    kept = np.arange(len(honest.rows)) != 30
    spoilt = replace(honest, rows=honest.rows[kept], nodes=honest.nodes[kept], numbers=honest.numbers[kept])
    verdict = check_gradients(one, spoilt).verdict
    assert f"missing neighbour: node {honest.nodes[30]} in the gradient of cell {honest.rows[30]}" in verdict
