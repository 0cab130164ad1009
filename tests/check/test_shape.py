"""Shape functions that are not what they are sold as are found out, and by name; honest ones pass.

A check that says "differs" is no help, and one that never says it is none either: each fault here is one that passes a
weaker test (a sum, a plot, an agreement at most places), and each has a twin without it.
"""

from dataclasses import replace

import numpy as np
import pytest

from rkverify.arithmetic.native import Float
from rkverify.check.claim import predicted, without
from rkverify.check.entries import entries
from rkverify.check.held import hold
from rkverify.check.rounding import lengths_at
from rkverify.check.shape import check_shape
from rkverify.check.sums import monomials, name_of
from rkverify.kernels import KERNELS
from rkverify.paper.approximation import approximation
from rkverify.paper.shape import shape_functions, shape_gradient
from rkverify.readings import DERIVATIVES
from rkverify.solid.cloud import cloud
from rkverify.solid.kernel_values import kernel_values
from rkverify.solid.neighbours import neighbours

DIMENSIONS = (1, 2, 3)


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_honest_numbers_pass(dimension, order, own, case):
    one = case(dimension, order, own, points=8)
    report = check_shape(one.claim, one.numbers())
    assert report.passed, report.text()
    assert report.verdict.startswith("PASS")


@pytest.mark.parametrize("reading", ["full", "diffuse"])
def test_both_consistent_derivatives_pass_under_their_own_name(reading, plane):
    assert check_shape(replace(plane.claim, derivative=reading), plane.numbers(derivative=reading)).passed


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_diffuse_gradients_sold_as_full(dimension, order, case):
    """Every sum holds for them: only a comparison tells."""
    one = case(dimension, order)
    report = check_shape(one.claim, one.numbers(derivative="diffuse"))
    assert all(f.holds for f in report.findings if "gradients" in f.name)
    assert "diffuse derivatives, and what is claimed is full derivatives" in report.verdict
    assert any("--derivative diffuse" in step for step in report.advice)


@pytest.mark.parametrize("sold", DERIVATIVES)
@pytest.mark.parametrize("claimed", DERIVATIVES)
def test_each_reading_is_told_from_each(claimed, sold, plane):
    report = check_shape(replace(plane.claim, derivative=claimed), plane.numbers(derivative=sold))
    if claimed != sold:
        assert f"have {sold} derivatives, and what is claimed is {claimed} derivatives" in report.verdict
    elif claimed in ("full", "diffuse"):
        assert report.passed
    else:  # as claimed, and still no derivative that reproduces
        assert "what is claimed, but" in report.verdict


@pytest.mark.parametrize(("dimension", "monomial"), [(2, "xy"), (3, "xz")])
def test_a_mixed_gradient_that_is_wrong_although_the_linear_sums_pass(dimension, monomial, case):
    """M c = -H_,x(0) solved with a wrong entry for one mixed function: all other sums stay, to rounding."""
    one = case(dimension, 2)
    numbers = one.numbers()
    spoilt = replace(numbers, numbers=_with_wrong_entry(one.claim, numbers, monomial))
    report = check_shape(one.claim, spoilt)
    held = {f.name: f.holds for f in report.findings}
    assert held["gradients: constants"]
    assert held["gradients: linear functions"]
    assert not held["gradients: quadratic functions"]
    assert (
        f"do not reproduce d({monomial})/dx, although the sums of constants and linear functions pass" in report.verdict
    )
    assert f"mixed function {monomial} of the basis is at fault" in report.verdict
    assert check_shape(one.claim, numbers).passed


def _with_wrong_entry(claim, numbers, monomial):
    """Gradients along x plus M^-1 e H phi for the unit vector e of the monomial: what one wrong entry does."""
    exponents = monomials(claim.cloud.dimension, 2)
    unit = np.array([float(name_of(alpha) == monomial) for alpha in exponents])
    out = numbers.numbers.copy()
    for point, place in enumerate(claim.points):
        here = numbers.rows == point
        y = place - claim.cloud.positions[numbers.nodes[here]]
        phi = kernel_values(claim.cloud.kernel, np.sqrt((y**2).sum(axis=1)), claim.cloud.supports[0], 0)[0]
        H = np.prod(y[:, None] ** np.array(exponents), axis=2)
        out[here, 1] += 0.3 * phi * (H @ np.linalg.solve((H * phi[:, None]).T @ H, unit))
    return out


@pytest.mark.parametrize("dimension", DIMENSIONS)
@pytest.mark.parametrize("reading", ["full", "diffuse"])
def test_supports_owned_by_the_target(reading, dimension, case):
    """With supports of their own all sums hold as well, whoever owns them."""
    one = case(dimension, own=True)
    sold = one.numbers(owner="target", derivative=reading)
    report = check_shape(replace(one.claim, derivative=reading), sold)
    assert all(f.holds for f in report.findings if "values:" in f.name)
    assert "have supports owned by the point (target), and what is claimed" in report.verdict
    assert "owned by the nodes (source)" in report.verdict


def test_supports_that_are_all_alike_belong_to_nobody(plane):
    assert check_shape(plane.claim, plane.numbers(owner="target")).passed


@pytest.mark.parametrize(("owner", "normalised"), [("mean", False), ("mean", True), ("source", True)])
def test_supports_and_kernels_of_smoothed_particle_hydrodynamics(owner, normalised, case):
    one = case(2, own=True)
    verdict = check_shape(one.claim, one.numbers(owner=owner, normalised=normalised)).verdict
    assert ("mean of the node's and the point's" in verdict) == (owner == "mean")
    assert ("kernels divided by a^d" in verdict) == normalised


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_one_missing_neighbour(dimension, order, case):
    """Sums without it are consistent in themselves: the node and the point are named all the same."""
    one = case(dimension, order)
    honest = one.numbers()
    point = 7
    node = int(honest.only(np.array([point])).nodes[2])
    sold = predicted(one.claim, one.columns, without(one.claim.cloud, one.claim.points, {point: [node]}))
    report = check_shape(one.claim, sold)
    assert f"missing from the sums: node {node} at point {point}" in report.verdict
    assert all(f.holds for f in report.findings if "constants" in f.name)


def test_a_row_that_is_left_out_is_told_from_a_neighbour_that_is_missing(plane):
    honest = plane.numbers()
    kept = np.arange(len(honest.rows)) != 50
    sold = replace(honest, rows=honest.rows[kept], nodes=honest.nodes[kept], numbers=honest.numbers[kept])
    verdict = check_shape(plane.claim, sold).verdict
    assert f"the table leaves out node {honest.nodes[50]} at point {honest.rows[50]}" in verdict


@pytest.mark.parametrize("name", [name for name in KERNELS if name not in ("cubic", "tent")])
def test_another_kernel(name, plane):
    sold = plane.numbers(cloud=replace(plane.claim.cloud, kernel=KERNELS[name]))
    assert f"have the kernel {name}, and what is claimed is the kernel cubic" in check_shape(plane.claim, sold).verdict


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"order": 0}, "a basis of order 0"),
        ({"order": 2}, "a basis of order 2"),
        ({"window": "tensor"}, "tensor windows"),
        ({"supports": np.full(81, 6.6)}, "twice the support radius"),
    ],
)
def test_another_order_window_or_support(change, words, case):
    one = case(2)
    one = replace(one, claim=replace(one.claim, cloud=cloud(one.claim.cloud.positions, 3.3)))
    assert words in check_shape(one.claim, one.numbers(cloud=replace(one.claim.cloud, **change))).verdict


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda n: n * [1, -1, -1], "the opposite sign"),
        (lambda n: n * [1, 2.3, 2.3], "derivatives by z"),
        (lambda n: n[:, [0, 2, 1]], "axes in the opposite order"),
    ],
)
def test_slips_in_the_gradient(spoil, words, plane):
    honest = plane.numbers()
    assert words in check_shape(plane.claim, replace(honest, numbers=spoil(honest.numbers))).verdict


@pytest.mark.parametrize("error", [1e-9, -1e-9])
def test_one_wrong_number_is_named(error, plane):
    """Too large or too small: a bound on one side alone would let half of all errors pass."""
    honest = plane.numbers()
    numbers = honest.numbers.copy()
    numbers[40, 2] += error
    report = check_shape(plane.claim, replace(honest, numbers=numbers))
    assert f"dpsi_dy of node {honest.nodes[40]} at point {honest.rows[40]}" in report.verdict
    (constants,) = (f for f in report.findings if f.name == "gradients: constants")
    assert not constants.holds
    assert f"at point {honest.rows[40]}," in constants.says
    length = plane.claim.cloud.supports[0]  # gradients are summed in its units
    assert constants.size == pytest.approx(1e-9 * length, rel=1e-4)  # beside the rounding of some 1e-15


def test_points_without_rows_are_accused_of_no_sum(plane):
    """Sums over nothing are zero and not one: they are no wrong sums, while the pairs that are not there are missing."""
    honest = plane.numbers()
    kept = honest.rows != 7
    sold = replace(honest, rows=honest.rows[kept], nodes=honest.nodes[kept], numbers=honest.numbers[kept])
    held = {f.name: f.holds for f in check_shape(plane.claim, sold).findings}
    assert all(holds for name, holds in held.items() if name.startswith(("values:", "gradients:")))
    assert not held["missing pairs"]


def test_the_unit_of_length_is_the_largest_support_over_a_point(case):
    """What the moment matrix is scaled by: with any smaller unit the bound of a gradient, 1/length, would be too wide."""
    claim = case(2, own=True).claim
    found = lengths_at(claim.cloud, neighbours(claim.cloud, claim.points))
    apart = np.linalg.norm(claim.points[:, None] - claim.cloud.positions[None], axis=2)
    over = np.where(apart < claim.cloud.supports, claim.cloud.supports, 0.0)
    np.testing.assert_array_equal(found, over.max(axis=1))
    assert len(set(found.tolist())) > 3


def test_what_is_allowed_at_a_point_is_a_matter_of_its_own_neighbours(case):
    """Of a point alone, or among others: with the bounds of another point one wrong number would be let pass, or a right one not."""
    one = case(2, own=True)
    together = hold(one.claim, one.numbers())
    assert np.ptp(together.allowed / together.allowed.min(axis=0)) > 0.5
    for point in (0, 3, 19):
        alone = replace(one, claim=one.claim.at(np.array([point])))
        np.testing.assert_allclose(hold(alone.claim, alone.numbers()).allowed[0], together.allowed[point], rtol=1e-9)


def test_values_alone_and_gradients_alone_are_checked(plane):
    honest, diffuse = plane.numbers(), plane.numbers(derivative="diffuse")
    assert check_shape(plane.claim, honest.part([0])).passed
    assert check_shape(plane.claim, honest.part([1, 2])).passed
    assert check_shape(plane.claim, diffuse.part([0])).passed
    assert "diffuse derivatives" in check_shape(plane.claim, diffuse.part([1, 2])).verdict


def test_rounded_numbers_pass_to_their_digits_and_no_further(plane):
    """Six decimals are checked to six decimals, and an error of ten units in the last one is seen."""
    honest = plane.numbers()
    rounded = replace(honest, numbers=np.round(honest.numbers, 6), resolution=np.full(3, 5e-7))
    assert check_shape(plane.claim, rounded).passed
    assert not check_shape(plane.claim, replace(rounded, resolution=np.zeros(3))).passed
    off = rounded.numbers + 1e-5 * (np.arange(len(honest.rows)) == 40)[:, None]
    assert not check_shape(plane.claim, replace(rounded, numbers=off)).passed


def test_numbers_of_the_literal_transcription_pass(plane):
    """By another route to the same numbers, so that the check is not held against itself."""
    A = approximation(plane.claim.cloud.positions.tolist(), 2.3, Float())
    rows = []
    for point, place in enumerate(plane.claim.points.tolist()):
        slopes = [shape_gradient(A, A.point(*place), axis) for axis in range(2)]
        rows += [(point, I, Psi, *(s[I] for s in slopes)) for I, Psi in shape_functions(A, A.point(*place)).items()]
    ids, numbers = np.array(rows)[:, :2].astype(int), np.array(rows)[:, 2:]
    theirs = entries(ids[:, 0], ids[:, 1], numbers, plane.columns, len(plane.claim.points), len(plane.claim.cloud))
    assert check_shape(plane.claim, theirs).passed


def test_what_nothing_explains_is_said_so(plane):
    noise = np.random.default_rng(1).normal(size=plane.numbers().numbers.shape)
    report = check_shape(plane.claim, replace(plane.numbers(), numbers=noise))
    assert not report.passed
    assert "do not reproduce" in report.verdict


def test_the_largest_difference_has_its_place(plane):
    honest = plane.numbers()
    numbers = honest.numbers.copy()
    numbers[13, 0] += 0.5
    place = check_shape(plane.claim, replace(honest, numbers=numbers)).largest
    assert (place.row, place.node, place.column) == (honest.rows[13], honest.nodes[13], "psi")
    assert place.theirs - place.ours == pytest.approx(0.5, abs=1e-12)
