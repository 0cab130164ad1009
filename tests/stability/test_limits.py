"""Both ends of the axis of kh: exact sums of the stencil against the relations themselves at the smallest and largest kh."""

import itertools
from fractions import Fraction
from math import pi, sin

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.limit_tables import agreement_rows, lagrangian_rows
from rkverify.errors import BadInput
from rkverify.paper.approximation import approximation
from rkverify.paper.shape import shape_functions
from rkverify.readings import Readings
from rkverify.stability import limits
from rkverify.stability.conditioning import irregular_spectrum, periodic_spectrum
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.lattice_state import Base
from rkverify.stability.layers import Setting, dispersion

F = Fraction
K = Exact()
HIGH = Multiprecision(60)
SMALL = "1e-12"
S = F(1, 3)


def _omega_squared(setting: Setting, kh) -> Fraction:
    return dispersion(setting, [kh], HIGH)[0].omega.squared[0]


SETTINGS = [
    (Setting("semi-lagrangian", "scni", "7/4", S, convective=False), limits.printed_scni_ends("7/4", K, "edge")),
    (
        Setting("semi-lagrangian", "scni", "7/4", S, convective=False, half_point="literal"),
        limits.printed_scni_ends("7/4", K, "literal"),
    ),
    (Setting("semi-lagrangian", "dni", "7/4", S, convective=False), limits.printed_dni_ends("7/4", K, "full")),
    (
        Setting("semi-lagrangian", "dni", "5/2", S, convective=False, derivative="diffuse"),
        limits.printed_dni_ends("5/2", K, "diffuse"),
    ),
    (Setting("lagrangian", "scni", "5/2", S), limits.printed_lagrangian_ends("5/2", K)),
    (Setting("lagrangian", "dni", "5/2", S, layer="as-defined"), limits.lagrangian_ends("5/2", K, "dni")),
    (Setting("semi-lagrangian", "dni", "7/4", S, layer="as-defined"), limits.method_ends("7/4", K, "dni")),
    (Setting("semi-lagrangian", "scni", "5/2", S, layer="as-defined"), limits.method_ends("5/2", K, "scni")),
    (
        Setting("semi-lagrangian", "dni", "7/4", S, layer="as-defined", derivative="frozen"),
        limits.method_ends("7/4", K, "dni", "frozen"),
    ),
]


@pytest.mark.decides("E86", "E87")
@pytest.mark.parametrize(("setting", "ends"), SETTINGS)
def test_the_ends_are_those_of_the_relation(setting: Setting, ends: limits.Ends) -> None:
    """omega^2/(kh)^2 differs from its limit by a few (kh)^2 = 1e-24, with 60 digits in hand."""
    near = _omega_squared(setting, SMALL) / HIGH.number(SMALL) ** 2
    assert abs(near - HIGH.number((1 + S) * ends.material + S * ends.geometric)) < 1e-20
    at_pi = _omega_squared(setting, HIGH.pi())
    assert abs(at_pi - HIGH.number((1 + S) * ends.material_at_pi + S * ends.geometric_at_pi)) < 1e-40


@pytest.mark.decides("E63")
def test_the_lagrangian_relation_is_the_linearisation() -> None:
    rows = lagrangian_rows(["7/4", "7/2"], ["cubic", "quintic"], S, F(6, 5))
    assert len(rows) == 4
    assert all(row["equal"] for row in rows)


def test_one_cell_tells_what_all_cells_do() -> None:
    """Seen from another cell a parabola is a parabola and a stretch: the whole sum over the cells is the same rational."""
    rows = agreement_rows(["13/10", "5/2"], ["cubic"], S)
    assert all(row["long_wave"] and row["at_pi"] for row in rows)


@pytest.mark.decides("C52", "C53")
@pytest.mark.parametrize("kernel", ["cubic", "quartic", "wendland-c2"])
@pytest.mark.parametrize("R", ["21/20", "7/4", "2", "7/2"])
def test_the_method_has_the_continuums_long_waves(kernel: str, R: str) -> None:
    for derivative in ("full", "diffuse"):
        ends = limits.method_ends(R, K, "dni", derivative, kernel)
        assert (ends.material, ends.geometric, ends.material_at_pi) == (1, 0, 0)
    ends = limits.method_ends(R, K, "scni", kernel=kernel)
    assert ends == limits.Ends(1, 0, 0, 0)


def test_a_gradient_that_does_not_reproduce_has_not() -> None:
    assert limits.method_ends("7/4", K, "dni", "frozen").material != 1
    assert limits.printed_dni_ends("7/4", K, "full").geometric != 0


def test_the_geometric_stencil_is_the_linearisations() -> None:
    """From unit displacements seen by one cell: the coefficients of v' over the stress, to the last rational."""
    for integration in ("dni", "scni"):
        forces = limits.nodal_forces("5/2", K, [limits.unit(m) for m in range(-4, 5)], integration)
        found = limits.geometric_stencil(forces, 4, K)
        whole = linearise(Base("5/2", Readings(integration, "none"), 1), K).stencil["v", "x"]
        assert found == dict(sorted(whole.items()))


@pytest.mark.parametrize(
    "base",
    [
        Base("7/4", Readings("dni"), velocity_gradient="1/5"),
        Base("7/4", Readings("dni", node_motion="field")),
        Base("7/4", Readings("dni"), frame_velocity="1/5"),
        Base("7/4", Readings("dni", mass="consistent")),
    ],
)
def test_only_a_base_at_rest_has_a_response(base: Base) -> None:
    with pytest.raises(BadInput, match="at rest"):
        limits.response(base, limits.alternating, K)


@pytest.mark.parametrize(
    "change",
    [
        {},
        {"integration": "scni"},
        {"derivative": "frozen-b"},
        {"stress_law": "cauchy-rate"},
        {"stress_law": "literal"},
        {"cell_edges": "material"},
        {"cell_edges": "material", "integration": "scni"},
        {"cell_edges": "fixed", "integration": "scni"},
        {"cell_measure": "material"},
        {"cell_measure": "fixed"},
        {"support_radius": "spacing"},
    ],
    ids=str,
)
def test_every_reading_responds_as_its_relation_says(change: dict[str, str]) -> None:
    """The forces summed cell by cell with everything that follows the positions, in units h = 1/2, against omega^2 of that reading:
    at kh = pi to the last rational, under a parabola by the limit at kh = 1e-12.
    """
    of = {"integration": "dni", **change}
    setting = Setting("semi-lagrangian", support_ratio="7/4", stress_ratio=S, spacing="1/2", layer="as-defined", **of)
    base = Base("7/4", Readings(**{"convection": "none", **of}), S, spacing="1/2")
    at_pi = limits.response(base, limits.alternating, K)
    assert abs(_omega_squared(setting, HIGH.pi()) + HIGH.number(at_pi)) < 1e-40
    long = limits.response(base, lambda J: F(J * J, 2), K)
    assert abs(_omega_squared(setting, SMALL) / HIGH.number(SMALL) ** 2 - HIGH.number(long)) < 1e-20
    assert long > 0


@pytest.mark.decides("C33")
def test_the_lattices_stiffness_is_known_for_small_supports() -> None:
    """For R <= 3/2 omega^2 = sin^2 kh: eigenvalues from sin^2(2 pi/64) to 1, and two zeros, kh = 0 and pi."""
    found = periodic_spectrum("3/2", 64)
    assert found.zeros == 2
    assert abs(found.eigenvalues[-1] - 1) < 1e-14
    assert abs(found.condition * sin(2 * pi / 64) ** 2 - 1) < 1e-11


@pytest.mark.decides("C33")
def test_a_large_support_is_worse_on_both_sets() -> None:
    assert periodic_spectrum("7/2", 64).condition > 100 * periodic_spectrum("3/2", 64).condition
    wide, usual = (irregular_spectrum(R, 64, 0.2, 7) for R in (3.5, 1.5))
    assert wide.zeros == usual.zeros == 1
    assert wide.condition > 100 * usual.condition


def test_spectra_are_those_of_the_stiffness() -> None:
    """Eigenvalues of B^T A B itself, for a lattice by its symbol sin^2 and for uneven nodes by a matrix written out."""
    found = periodic_spectrum("3/2", 12)
    assert abs(found.eigenvalues - np.sort(np.sin(2 * pi * np.arange(12) / 12) ** 2)[2:]).max() < 1e-14
    count, shift, seed = 9, 0.2, 3
    irregular = irregular_spectrum(1.7, count, shift, seed, "quintic")
    x = np.arange(count) + shift * np.random.default_rng(seed).uniform(-1, 1, count)
    ends = [x[0], *((a + b) / 2 for a, b in itertools.pairwise(x)), x[-1]]
    A = approximation([[float(c)] for c in x], 1.7, Float(), "quintic", 1)
    K_matrix = np.zeros((count, count))
    for left, right in itertools.pairwise(ends):
        b = np.zeros(count)
        for sign, end in ((1, right), (-1, left)):
            for J, value in shape_functions(A, (float(end),)).items():
                b[J] += sign * value / (right - left)
        K_matrix += (right - left) * np.outer(b, b)
    values = np.linalg.eigvalsh(K_matrix)
    assert irregular.zeros == 1
    assert abs(irregular.eigenvalues - values[1:]).max() < 1e-13
    assert abs(irregular.condition - values[-1] / values[1]) < 1e-10 * irregular.condition
