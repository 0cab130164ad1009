"""Separation and folding: what the study tells apart is held against what can be said without running it."""

from fractions import Fraction

import numpy as np
import pytest

from rkverify.arithmetic.native import Exact
from rkverify.certify.mechanics import folding, lost_digits, separation
from rkverify.errors import BadInput, SingularMomentMatrix, TooFewNodes
from rkverify.paper.approximation import approximation
from rkverify.paper.chain_rule import spatial_gradients
from rkverify.paper.shape import shape_functions, shape_gradient

R = 2.3


@pytest.fixture(scope="module")
def plate():
    return separation.halves(4, 6, R, 1)


@pytest.mark.decides("C7", "C8")
def test_the_chain_rule_needs_an_inverse_and_the_kernel_of_x_does_not():
    """In exact rationals: a map that folds the line X = 0 has F = 0 there; (25) is refused, functions of x reproduce 1 and x.

    x = X - s/3 X (4 - X^2) turns around at X = 0 for s = 3/4 if F is direct; the discrete F is set to 0 by the choice of s.
    """
    K = Exact()
    X = [Fraction(k, 2) for k in range(-4, 5)]
    a = Fraction(6, 5)
    A = approximation([[x] for x in X], a, K)
    place = (Fraction(0),)
    slope = shape_gradient(A, place)
    u = [x**3 / 8 - x for x in X]
    s = -1 / sum(slope[I] * u[I] for I in slope)
    x = [p + s * q for p, q in zip(X, u, strict=True)]
    F = [[sum(slope[I] * x[I] for I in slope)]]
    assert F == [[0]]
    with pytest.raises(BadInput, match="determinant 0"):
        spatial_gradients([slope], F, K)
    # Three sheets lie over the middle, and every node that is near in x counts.
    moved = approximation([[p] for p in [q + Fraction(k, 10**6) for k, q in enumerate(x)]], a, K)
    Psi = shape_functions(moved, place)
    assert sum(Psi.values()) == 1
    assert sum(value * moved.nodes[I][0] for I, value in Psi.items()) == 0


@pytest.mark.parametrize("motion", lost_digits.MOTIONS)
def test_lost_digits_are_those_of_the_condition(motion):
    """Error of F^-1 is at most some roundings of F's entries times cond F; its twin, a bound with det F, is broken by the shear.

    F has 20 products, each rounded once: 20 units times cond F times the share 3 of |x| |dPsi/dX| in F is the bound.
    """
    p = lost_digits.patch(4)
    for k in (0, 5, 10):
        x = lost_digits.moved(p, motion, 10.0**-k)
        J, condition, error = lost_digits.of_chain_rule(p, x)
        assert error <= 60 * lost_digits.UNIT * condition
        assert condition == pytest.approx(10.0**k, rel=2)
        if motion == "shear":
            assert abs(J - 1) <= 1e-6
    assert error > 1e4 * lost_digits.UNIT
    if motion == "shear":
        assert error > 1e4 * lost_digits.UNIT / J


def test_functions_of_x_see_no_fold_but_a_flattening():
    """cond M stays where nodes crowd from two sides, and grows as 1/thickness^2 where all lie near a line: then it is refused."""
    p = lost_digits.patch(4)

    def seen(motion, k):
        return lost_digits.of_semi_lagrangian(p, lost_digits.moved(p, motion, 10.0**-k))

    assert seen("fold", 12)[0] == pytest.approx(seen("fold", 6)[0], rel=1e-4)
    assert seen("fold", 12)[1] <= 60 * lost_digits.UNIT * seen("fold", 12)[0]
    assert seen("flattening", 4)[0] == pytest.approx(1e4 * seen("flattening", 2)[0], rel=1e-2)
    assert seen("flattening", 9)[2] == SingularMomentMatrix.__name__
    assert seen("shear", 6)[2] == TooFewNodes.__name__


@pytest.mark.decides("C22", "C65")
def test_a_lagrangian_gap_never_opens_and_never_closes(plate):
    """Far apart F is linear in the gap, so that the force of neo-Hookean halves is as well: doubled with the gap, not gone.

    F of a rigid shift of the right half is 1 + gap (e_1 x g), g a fixed vector of each cell: for 1000 and 2000 spacings the terms without
    the gap are a share of 1e-3.
    """
    one, two = separation.lagrangian_gap(plate, 0.0, [1000.0, 2000.0])
    assert one["pairs"] == two["pairs"] == plate.across(plate.positions) > 0
    assert two["neo_hookean"] / one["neo_hookean"] == pytest.approx(2, rel=1e-2)
    assert two["neo_hookean"] < 0
    for row in separation.lagrangian_gap(plate, 2 * R, [2 * R, R, 0.0, -1.5]):
        assert row["pairs"] == 0
        assert abs(row["neo_hookean"]) <= 1e-12
        assert row["least_det_F"] == pytest.approx(1, abs=1e-13)
    assert row["overlap"] > 0


@pytest.mark.decides("C66")
@pytest.mark.parametrize("integration", ["dni", "snni"])
def test_nothing_acts_across_a_gap_wider_than_the_support(plate, integration):
    """Nodes of one half alone have functions that sum to 1: forces on it sum to 0. Closer than the support they do not."""
    rows = separation.semi_lagrangian_gap(plate, integration, 0.0, 2 * R, 60, 1)
    assert not rows[-1]["stopped"]
    # DNI takes functions at the nodes, SNNI on boxes about them, which reach half their side further: the gap lets them grow to at most 1.5.
    reach = R - 1 if integration == "dni" else R - 0.25
    beyond = [row for row in rows if row["gap"] * R > reach]
    assert max(abs(row["force"]) for row in beyond) <= 1e-12
    assert min(row["force"] for row in rows) < -0.1
    assert all((row["pairs"] > 0) == (row["gap"] * R + 1 < R) for row in rows)
    assert all(row["condition_nodes"] == pytest.approx(rows[0]["condition_nodes"], rel=0.5) for row in rows)
    assert np.isinf(rows[-1]["condition_middle"])


@pytest.mark.decides("C66")
def test_cells_across_a_gap_hold_it_together_until_it_is_uncovered(plate):
    """SCNI over one outline: the pull grows with the gap, and ends with a facet's end without nodes before the middle is a support away."""
    rows = separation.semi_lagrangian_gap(plate, "scni", 0.0, 3 * R, 60, 1)
    pull = [-row["force"] for row in rows[:-1]]
    assert np.all(np.diff(pull) > 0)
    assert rows[-1]["stopped"] == TooFewNodes.__name__
    assert 1 < rows[-1]["gap"] < 2


@pytest.mark.decides("C66")
def test_a_stretch_by_the_support_ratio_ends_the_functions():
    """On a square lattice the next column is out of reach at stretch R, and for SCNI's vertices half-way up a cell at sqrt(R^2 - 1/4)."""
    assert folding.largest_stretch(7, R, "dni") == pytest.approx(1, abs=1e-6)
    assert folding.largest_stretch(7, R, "scni") == pytest.approx(np.sqrt(R**2 - 0.25) / R, abs=1e-6)
    last = folding.stretch(7, R, [0.99, 1.01])
    assert np.isfinite(last[0]["fixed"])
    assert np.isinf(last[1]["fixed"])
    assert last[1]["grown"] < 100


def test_a_fold_is_where_the_determinant_of_the_first_cell_vanishes():
    """A law with F^-1 exists up to there and not beyond, one without it on both sides; DNI goes on in x."""
    b = folding.block(6, R, 1)
    s = folding.fold_starts(b)
    before, after = folding.lagrangian_fold(b, [s * (1 - 1e-9), s * (1 + 1e-9)])
    assert before["least_det_F"] > 0 > after["least_det_F"]
    assert (before["neo_hookean"], after["neo_hookean"]) == (True, False)
    assert before["st_venant_kirchhoff"]
    assert after["st_venant_kirchhoff"]
    assert before["condition_F"] > 1e7
    assert before["condition_M"] < 1e4
    assert folding.semi_lagrangian_fold(b, "dni", 1.5 * s, 40)["stopped"] == ""
    assert folding.semi_lagrangian_fold(b, "scni", 1.5 * s, 40)["stopped"]
