"""Figures 1 to 3 are drawn from what the definitions say, and what must not look right does not."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Exact
from rkverify.certify.motions import flexure, shear, translation, turn
from rkverify.certify.motions_in_space import deformation_gradient
from rkverify.certify.pictures import cells, relative_motion, supports
from rkverify.certify.pictures.block import Block
from rkverify.solid.cloud import cloud
from rkverify.solid.neighbours import neighbours

BLOCK = Block(6, Fraction(5, 2), 3)
T = Fraction(3, 5)
PLACES = st.fractions(-5, 5, max_denominator=50)


@pytest.fixture(scope="module")
def picture():
    return cells.picture("jittered", 0.25, 2.5, 104)


def test_flexure_is_undone_exactly_and_keeps_areas() -> None:
    """The support of a Lagrangian kernel is found by back(x); an inverse that is off would lose nodes and look like physics."""

    @given(X1=PLACES, X2=PLACES, t=st.fractions(0, 1, max_denominator=20))
    def check(X1: Fraction, X2: Fraction, t: Fraction) -> None:
        at = flexure(t)
        assert at.back(at.forth((X1, X2))) == (X1, X2)
        F = deformation_gradient(flexure, t, (X1, X2))
        assert F[0][0] * F[1][1] - F[0][1] * F[1][0] == 1

    check()


@pytest.mark.decides("F1")
def test_steps_along_normals_tell_a_normal_that_points_in(picture) -> None:
    """The check of the normals is worth something only if one turned edge shows: twice, on the way out and on the way back."""
    assert cells.whole(picture, 1e-3)["wrong"] == 0
    turned = picture.nodes.cells.areas.copy()
    turned[5] *= -1
    false = replace(picture.nodes, cells=replace(picture.nodes.cells, areas=turned))
    assert cells.whole(cells.Picture(false), 1e-3)["wrong"] == 2


@pytest.mark.decides("F1")
def test_the_drawn_edges_are_the_cell(picture) -> None:
    """What the picture shows: the edges close around an area that is A_L, by the divergence theorem with the drawn normals."""
    for name, L in picture.chosen.items():
        edges = [edge for edge in cells.edges(picture) if edge["cell"] == name]
        middle = np.array([[(e[f"start_{j}"] + e[f"end_{j}"]) / 2 for j in (1, 2)] for e in edges])
        outward = np.array([[e["n1"] * e["length"], e["n2"] * e["length"]] for e in edges])
        # A dozen products of numbers below 2.
        rounding = 12 * 4 * 2.0**-52
        assert abs(outward.sum(axis=0)).max() <= rounding
        assert abs((middle * outward).sum() / 2 - picture.nodes.cells.measures[L]) <= rounding
        assert any(e["beyond"] < 0 for e in edges) == (name == "clipped")
        shares = [p["share"] for p in cells.rule_points(picture, ("gauss:2",)) if p["cell"] == name]
        assert len(shares) == 2 * len(edges)
        assert abs(sum(shares) - 1) <= rounding


def test_the_clipped_cell_is_the_one_that_is_not_convex(picture) -> None:
    assert cells.hollow(picture.polygons[picture.clipped]) > 0.1
    assert abs(cells.hollow(picture.polygons[picture.interior])) < 1e-12  # a sum of a few products of numbers below 2


@pytest.mark.decides("F2", "C23")
@pytest.mark.parametrize("motion", [flexure, turn, shear])
def test_members_are_those_that_the_compiled_search_finds(motion) -> None:
    """Exact squares against a k-d tree in double precision, before and after: the same nodes under every kernel."""
    places = supports.moved(BLOCK, motion(T))
    for where, which in ((places.X, 0), (places.back, 1), (places.x, 2)):
        x = np.array(where, dtype=float)
        found = neighbours(cloud(x, float(BLOCK.support)), x)
        for I in range(len(x)):
            # who covers x_I is whom x_I's own support covers, as all supports are the same
            assert places.members(I, BLOCK.support)[which] == set(found.of(I).tolist())


@pytest.mark.decides("F2", "C23")
def test_only_a_deformation_exchanges_nodes_and_only_in_the_semi_lagrangian_support() -> None:
    rows = supports.counts(BLOCK, 14, (flexure, turn, translation), (Fraction(0), T))
    for row in rows:
        assert row["lagrangian_kept"] == row["before"] == row["semi_kept"] + row["semi_lost"]
        assert row["lagrangian_lost"] == row["lagrangian_gained"] == row["image_differs"] == 0
        deforms = row["motion"] == flexure(T).name and row["time"] != "0"
        assert (row["semi_lost"] + row["semi_gained"] > 0) == deforms


def test_the_image_of_the_circle_is_another_set_than_the_moved_circle() -> None:
    """The twin of image_differs = 0: held against the semi-Lagrangian members the polygon must differ."""
    import shapely

    places = supports.moved(BLOCK, flexure(T))
    polygon = shapely.Polygon(supports.image(BLOCK, 14, flexure, T))
    inside = set(np.flatnonzero(shapely.contains_xy(polygon, np.array(places.x, dtype=float))).tolist())
    _, lagrangian, semi = places.members(14, BLOCK.support)
    assert inside == lagrangian != semi


@pytest.mark.decides("F3", "C24")
def test_the_projection_is_the_rate_of_the_distance_and_without_v_I_it_is_not() -> None:
    """The complex step knows no velocity, so that v, v_I and n are all under test; a translation shows what v_I is for."""
    moving, carried = relative_motion.every_pair(BLOCK, (flexure, translation), (T,), Fraction(1, 50))
    # Some twenty operations on numbers below 20.
    assert moving["complex_step"] <= 400 * 2.0**-52
    assert 3.5 < moving["coarse"] / moving["fine"] < 4.5  # error of a central difference: the step squared
    assert moving["wrong"] == carried["wrong"] == 0
    assert moving["away"] > 0 < moving["towards"]
    assert carried["neither"] == carried["pairs"]
    assert carried["without"] > carried["pairs"] / 2


@pytest.mark.decides("F3")
def test_the_dashed_lines_are_where_material_keeps_its_distance() -> None:
    """Each point around the node is a particle: carried on for a little time, its distance grows where the value is positive."""
    centre, step = 14, Fraction(1, 10**6)
    X_I = BLOCK.nodes[centre]
    x_I = flexure(T).forth(X_I)
    for row in relative_motion.field(BLOCK, centre, flexure, T, 3, 8):
        x = tuple(c + Fraction(row[f"offset_{j}"]) for j, c in enumerate(x_I, start=1))
        X = flexure(T).back(x)
        before, after = (
            float(relative_motion.squared(at.forth(X), at.forth(X_I))) ** 0.5
            for at in (flexure(T - step), flexure(T + step))
        )
        # Rounding of two distances below 3 over 2e-6, and the third derivative (below 100) times step^2.
        assert abs((after - before) / (2 * float(step)) - row["projection"]) <= 4 * 3 * 2.0**-52 / 2e-6 + 1e-10


def test_velocities_are_derivatives_at_fixed_X() -> None:
    D = Duals(Exact(), 1)
    there = relative_motion.snapshot(BLOCK, flexure, T)
    path = flexure(D.variable(T, 0)).forth(tuple(map(D.number, BLOCK.nodes[4])))
    assert there.v[4] == tuple(c.partials[0] for c in path)
    h = Fraction(1, 10**9)
    early, late = (flexure(T + s * h).forth(BLOCK.nodes[4]) for s in (-1, 1))
    for v, a, b in zip(there.v[4], early, late, strict=True):
        assert abs((b - a) / (2 * h) - v) <= 100 * h**2  # the third derivative is below 100
