"""Derivatives of forces in the plane: complex steps against difference quotients and against duals through the transcription."""

import numpy as np
import pytest

from rkverify.readings import CELL_MEASURES
from rkverify.solid.voronoi import voronoi
from rkverify.stability.bloch import degenerate
from rkverify.stability.bloch.cell_integrals import moving, room
from rkverify.stability.bloch.lattices import Lattice, jittered, lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.linearised_paper import slopes
from rkverify.stability.bloch.scheme import Scheme

NODES = {
    "square": lattice("square"),
    "hexagonal": lattice("hexagonal"),
    "jittered": jittered(lattice("square"), 2, 0.15, 1),
}
RULES = pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:3"])


def of_node(nodes: Lattice, scheme: Scheme, J: int) -> tuple[np.ndarray, np.ndarray]:
    """Places of the nodes whose forces node J changes, and the slopes."""
    g = linearised(nodes, scheme).geometric
    mine = g.columns == J
    return nodes.nodes[J] - g.offsets[mine], g.values[mine]


CASES = [
    *[(name, "dni", "full", measure) for name in NODES for measure in CELL_MEASURES],
    *[("square", "dni", derivative, "edges") for derivative in ("diffuse", "frozen-b", "frozen")],
    ("square", "snni", "full", "edges"),
    ("hexagonal", "snni", "full", "material"),
    ("jittered", "snni", "full", "fixed"),
]


@pytest.mark.parametrize(("name", "integration", "derivative", "measure"), CASES)
def test_slopes_are_those_of_the_transcription(name: str, integration: str, derivative: str, measure: str) -> None:
    """`paper/` with duals shares no line with `solid/` and its complex steps."""
    nodes = NODES[name]
    scheme = Scheme(integration, 1.5, derivative=derivative, cell_measure=measure)
    J = len(nodes) - 1
    places, values = of_node(nodes, scheme, J)
    transcribed = slopes(nodes, scheme, J, 1.75 if integration == "dni" else 2.4)
    found = {tuple(np.round(p, 9) + 0.0): v for p, v in zip(places.tolist(), values, strict=True)}
    for place, value in transcribed.items():
        # sums of some hundred rounded terms of size up to 10
        np.testing.assert_allclose(found.get(place, np.zeros((2, 2))), value, rtol=0, atol=1e3 * 2.0**-52)
    assert set(found) <= set(transcribed)


@pytest.mark.parametrize("name", NODES)
@pytest.mark.parametrize("scheme", [Scheme("dni", 1.7), Scheme("snni", 1.7), Scheme("dni", 1.7, window="tensor")])
def test_slopes_are_limits_of_difference_quotients(name: str, scheme: Scheme) -> None:
    """Central differences err by step^2 times a third derivative, here below 1e-10 times some hundreds.

    Where four cells meet, or nodes are in line along an axis of a tensor window, second derivatives jump, by some units:
    there they err by step times that.
    """
    nodes, step = NODES[name], 1e-5
    allowed = 3 * step if name == "square" or scheme.window == "tensor" else 1e-7
    places, values = of_node(nodes, scheme, 0)
    patch = nodes.around(7.0)
    x = patch.positions
    cells = np.flatnonzero(np.linalg.norm(x - x[0], axis=1) < 3.5)
    of = moving(scheme, x, cells)
    for axis in range(2):
        sums = []
        for side in (1, -1):
            there = x.copy()
            there[0, axis] += side * step
            areas = voronoi(there, room(x)).measures
            sums.append(np.stack([part.sum(axis=0) for part in of(there, areas)], axis=1))
        quotient = (sums[0] - sums[1]) / (2 * step)
        at = np.linalg.norm(places[:, None] - x[None], axis=2).argmin(axis=1)
        np.testing.assert_allclose(values[:, :, axis], quotient[at], rtol=0, atol=allowed)


@RULES
@pytest.mark.parametrize("axis", [0, 1])
def test_four_cells_in_a_point_leave_no_trace_in_the_force_of_a_uniform_stress(rule: str, axis: int) -> None:
    """The derivative that SCNI takes on the square lattice: zero, along either side and with either triangulation.

    Single b_I^L have two one-sided derivatives there, so that a derivative taken cell by cell would be one of several.
    """
    scheme = Scheme("scni", 1.7, rule)
    patch, cells = degenerate.patch_of(lattice("square"), scheme)
    either = [degenerate.by_complex_step(scheme, patch, cells, axis, tilt) for tilt in (1e-6, -1e-6)]
    step = 1e-6
    sides = [degenerate.by_difference(scheme, patch, cells, axis, h) for h in (step, -step)]
    assert max(abs(m.resultant).max() for m in either) < 1e-14
    # each difference rounds some ten terms of size 1 by 2^-52
    assert max(abs(m.resultant).max() for m in sides) < 100 * 2.0**-52 / step
    assert abs(either[0].integrals - either[1].integrals).max() > 1e-3
    assert abs(sides[0].integrals - sides[1].integrals).max() > 1e-3


def test_the_better_the_rule_the_less_single_gradients_jump() -> None:
    """Exact cell integrals are C1 where four cells meet: what differs is the rule's error."""
    jumps = []
    for rule in ("trapezoid", "gauss:2", "gauss:4", "gauss:8"):
        scheme = Scheme("scni", 1.7, rule)
        patch, cells = degenerate.patch_of(lattice("square"), scheme)
        one, two = (degenerate.by_complex_step(scheme, patch, cells, 0, tilt).integrals for tilt in (1e-6, -1e-6))
        jumps.append(abs(one - two).max())
    assert jumps[1] < jumps[0] / 10
    assert jumps[3] < jumps[2] < jumps[1]
    assert jumps[3] < 1e-3 * jumps[0]


@pytest.mark.parametrize("name", ["square", "hexagonal"])
def test_areas_have_derivatives_where_four_cells_meet(name: str) -> None:
    """Both triangulations, both sides and the closed form agree; the forces of DNI and SNNI need no more of the cells."""
    scheme = Scheme("scni", 1.7)
    patch, cells = degenerate.patch_of(lattice(name), scheme)
    for axis in range(2):
        closed = degenerate.area_slopes(patch, cells)[:, axis]
        assert abs(closed).max() > 0.2
        for tilt in (1e-6, -1e-6):
            stepped = degenerate.by_complex_step(scheme, patch, cells, axis, tilt).areas
            np.testing.assert_allclose(stepped, closed, rtol=0, atol=1e-14)
        for step in (1e-6, -1e-6):
            quotient = degenerate.by_difference(scheme, patch, cells, axis, step).areas
            np.testing.assert_allclose(
                quotient, closed, rtol=0, atol=2e-6
            )  # one-sided: a step times a second derivative
