"""Surveys: that a few stencils give every setting, and that the critical step is the one at which a computation turns.

The surveys' numbers come from two (at rest) or six (in motion) stencils each; they are held against the stencils of
`paper/` in exact rationals, against `dispersion` one setting at a time, and against central differences in time.
"""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import pi, sqrt
from typing import Any

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.errors import BadInput
from rkverify.solid.chain import rates
from rkverify.stability.at_rest import AtRest, at_rest, printed_relation
from rkverify.stability.jacobian_paper import Stencil, linearise
from rkverify.stability.jacobian_solid import base_chain
from rkverify.stability.lagrangian import bar
from rkverify.stability.layers import Setting, dispersion
from rkverify.stability.roots import Root
from rkverify.stability.side_by_side import ANALYTIC, Case, _measured_row, lagrangian_rows, semi_lagrangian_rows
from rkverify.stability.simulate import Measured
from rkverify.stability.stability_sets import (
    FORMULATIONS,
    motion_rows,
    moving_rows,
    reading_rows,
    relations,
    step_rows,
    stress_rows,
    wave_rows,
)
from rkverify.stability.surveys import frequency, growth, roots_over
from rkverify.stability.two_forms import (
    constant_moduli_rows,
    measured_constant_moduli,
    measured_rows,
    same_material_rows,
)

KH = np.array([0.3, 1.0, 2.0, 3.0])

SETTINGS = [
    Setting("semi-lagrangian", "scni", "7/4", layer="as-defined"),
    Setting("semi-lagrangian", "scni", "7/4"),
    Setting("semi-lagrangian", "scni", "7/4", half_point="literal"),
    Setting("semi-lagrangian", "dni", "3/2", layer="consistent"),
    Setting("semi-lagrangian", "dni", "5/2", layer="as-defined", derivative="diffuse"),
    Setting("semi-lagrangian", "dni", "3/2", derivative="diffuse"),
    Setting("semi-lagrangian", "dni", "7/4", layer="as-defined", stress_law="literal", cell_measure="fixed"),
    Setting("semi-lagrangian", "scni", "5/2", layer="as-defined", stress_law="cauchy-rate", cell_measure="material"),
    Setting("semi-lagrangian", "scni", "3/2", layer="as-defined", support_radius="spacing"),
]
BARS = [
    Setting("lagrangian", "scni", "5/2", stretch="6/5"),
    Setting("lagrangian", "dni", "5/2", stretch="6/5", layer="as-defined"),
]


def _exact(setting: Setting, s: str, Q: str) -> Stencil:
    return linearise(replace(setting, stress_ratio=s, velocity_gradient=Q).base(), Exact()).stencil


def _interpolated(setting: Setting, s: Fraction, Q: Fraction, nodes: tuple[int, ...]) -> Stencil:
    """The stencil at (s, Q) from those at s = 0, 1 and Q in nodes, by Lagrange's formula."""
    weights = {}
    for q in nodes:
        weight = Fraction(1)
        for other in nodes:
            if other != q:
                weight *= (Q - other) / Fraction(q - other)
        weights[0, q], weights[1, q] = (1 - s) * weight, s * weight
    total: dict[Any, dict[int, Any]] = {}
    for (node_s, q), weight in weights.items():
        for key, values in _exact(setting, str(node_s), str(q)).items():
            for n, c in values.items():
                block = total.setdefault(key, {})
                block[n] = block.get(n, 0) + c * Exact().number(weight)
    return total


def _same(one: Stencil, other: Stencil) -> bool:
    keys = one.keys() | other.keys()
    return all(
        one.get(k, {}).get(n, 0) == other.get(k, {}).get(n, 0)
        for k in keys
        for n in one.get(k, {}).keys() | other.get(k, {}).keys()
    )


@pytest.mark.parametrize("setting", [s for s in SETTINGS if s.layer != "printed"], ids=str)
def test_six_stencils_are_all_stencils_and_four_are_not(setting: Setting) -> None:
    """In exact rationals, so that a term of higher degree in s or Q could not hide; N needs the square of Q."""
    s, Q = Fraction(-5, 7), Fraction(3, 5)
    direct = _exact(setting, str(s), str(Q))
    assert _same(direct, _interpolated(setting, s, Q, (-1, 0, 1)))
    assert not _same(direct, _interpolated(setting, s, Q, (0, 1)))


@pytest.mark.parametrize("setting", SETTINGS, ids=str)
def test_surveyed_roots_are_those_of_each_setting(setting: Setting) -> None:
    """To 1e-12: eigenvalues that are apart by 0.1 or more move by ten times the rounding of their matrix, at most 1e-14."""
    roots = roots_over(setting, KH)
    for s, Q in ((-0.7, 0.4), (0.6, -0.3)):
        omega = roots(s, Q)
        one = dispersion(replace(setting, stress_ratio=s, velocity_gradient=Q), KH.tolist())
        each = [[b.omega for b in one if b.kh == theta] for theta in KH]
        assert np.allclose(growth(omega), [max(r.growth for r in roots) for roots in each], rtol=0, atol=1e-12)
        assert np.allclose(frequency(omega), [max(abs(r.re) for r in roots) for roots in each], rtol=0, atol=1e-12)


@pytest.mark.parametrize("setting", [*SETTINGS, *BARS], ids=str)
def test_surveyed_relations_at_rest_are_those_at_many_digits(setting: Setting) -> None:
    """Through `paper/` at 30 digits; sums of some tens of products of order 1 to 100 leave 1e-12."""
    relation, K = at_rest(setting), Multiprecision(30)
    for s in ("-7/10", "2/5"):
        one = dispersion(replace(setting, stress_ratio=s), [str(theta) for theta in KH], K)
        squared = [float(b.omega.squared[0]) for b in one[::2]]
        assert np.allclose(relation.omega_squared(float(Fraction(s)), KH), squared, rtol=1e-12, atol=1e-12)


def test_the_layers_are_one_at_rest_and_two_in_motion() -> None:
    kh = np.array([2.0])
    layers = [replace(SETTINGS[0], layer=layer) for layer in ("as-defined", "consistent")]
    still, moving = ([growth(roots_over(one, kh)(-1.5, Q))[0] for one in layers] for Q in (0.0, 0.1))
    assert abs(still[0] - still[1]) <= 1e-14
    assert abs(moving[0] - moving[1]) > 1e-3


@pytest.mark.parametrize("name", FORMULATIONS)
def test_extremes_need_no_samples(name: str) -> None:
    """No sample goes beyond the extremes, and the nearest of n samples misses them by O(1/n^2) of the range."""
    relation = at_rest(replace(FORMULATIONS[name], support_ratio="19/10"))
    for s in (-1.5, 0.5):
        least, largest = relation.extremes(s)
        values = relation.omega_squared(s, pi * np.arange(2001) / 2000)
        span = largest - least
        for missed in (values.min() - least, largest - values.max()):
            assert -1e-13 * (1 + span) <= missed <= 1e-5 * span
        assert abs(relation.omega_squared(s, np.array([relation.wave_of_largest(s)]))[0] - largest) <= 1e-13 * (
            1 + span
        )


@pytest.mark.parametrize("setting", [*SETTINGS, *BARS], ids=str)
def test_the_stable_stresses_end_where_a_square_turns_negative(setting: Setting) -> None:
    """Just inside no square is negative beyond rounding, just outside one is: by 1e-3 in s, far from rounding."""
    relation = at_rest(setting)
    low, high = relation.stable_stresses()
    assert low <= 0 <= high
    for end, outward in ((low, -1e-3), (high, 1e-3)):
        if np.isinf(end):
            assert relation.extremes(np.sign(end) * 50)[0] >= -1e-10
            continue
        assert relation.extremes(end - outward * (low < 0 < high))[0] >= -1e-10
        assert relation.extremes(end + outward)[0] < -1e-10


@pytest.mark.decides("C46", "C71")
def test_scni_is_stable_down_to_minus_the_modulus_for_every_support_and_dni_changes_sides() -> None:
    """With G of the closed form of DNI: tension is unstable where G < 0 (R = 3/2) and compression where G > 0 (R = 7/4)."""
    for R in ("11/10", "7/4", "5/2", "7/2"):
        low, high = at_rest(replace(FORMULATIONS["SCNI"], support_ratio=R)).stable_stresses()
        assert abs(low + 1) <= 1e-7
        assert high == np.inf
    for R, stable in (("3/2", (-1.0, 0.0)), ("7/4", (0.0, np.inf))):
        assert at_rest(replace(FORMULATIONS["DNI full"], support_ratio=R)).stable_stresses() == pytest.approx(stable)


def test_motion_moves_the_printed_boundary_of_scni_by_the_long_wave_formula() -> None:
    """D/(kh)^2 -> 4 (1 + s) + 12 Q^2 c^2 as kh -> 0, with c = C(h) phi'(h)/R; the cubic kernel at R = 3/2 by hand."""
    p0, p1, slope = 2 / 3, 4 / 81, -4 / 9
    c = slope / (p0 + 2 * p1) / 1.5
    (row,) = (r for r in motion_rows([Case("scni", "3/2")], [0.1], [0.0], 512) if r["layer"] == "printed")
    # C(h/2) phi(h/2) = 1/2: two nodes see the edge. The first sampled wave is kh = pi/512, its square 4e-5.
    assert row["turn"] == pytest.approx(-1 - 3 * 0.01 * c * c, abs=1e-5)


LEAPT = [
    ("Lagrangian SCNI", "5/2", 0.5),
    ("Lagrangian DNI", "5/2", 0.5),
    ("SCNI", "7/4", 0.5),
    ("SCNI", "5/2", -0.5),
    ("DNI full", "7/4", 0.5),
    ("DNI full", "3/2", -0.5),
    ("DNI diffuse", "3/2", -0.5),
]
NODES = 48


@pytest.mark.parametrize(("name", "R", "s"), LEAPT)
def test_central_differences_turn_at_the_critical_step(name: str, R: str, s: float) -> None:
    """One per cent below nothing grows by more than the 1/sqrt(1 - 0.99^2) of a bounded leapfrog; above, it does without end.

    The run knows the nonlinear equations alone. Its waves are 2 pi n/48, whose largest frequency is within 1 % of the
    largest of all; the step above is taken from it.
    """
    setting = replace(FORMULATIONS[name], support_ratio=R, stress_ratio=s)
    relation = at_rest(setting)
    step = relation.critical_step(s)
    own = 2 / sqrt(relation.omega_squared(s, 2 * pi * np.arange(NODES) / NODES).max())
    assert step <= own <= 1.01 * step
    start = 1e-8 * np.random.default_rng(7).standard_normal(NODES)
    assert _largest_gain(setting, 0.99 * step, start, 800) < 100
    assert _largest_gain(setting, 1.01 * own, start, 200) > 1e4


def test_where_a_square_is_negative_no_step_is_short_enough() -> None:
    setting = replace(FORMULATIONS["DNI full"], support_ratio="3/2", stress_ratio=0.5)
    relation = at_rest(setting)
    assert relation.extremes(0.5)[0] < 0
    start = 1e-8 * np.random.default_rng(7).standard_normal(NODES)
    assert _largest_gain(setting, 0.2 * relation.critical_step(0.5), start, 200) > 1e4


def _largest_gain(setting: Setting, dt: float, start: np.ndarray, steps: int) -> float:
    """The largest velocity in `steps` central differences over the largest at the start; ends where it passes 1e5."""
    advance = _bar_step(setting, dt) if setting.formulation == "lagrangian" else _chain_step(setting, dt)
    v, top = start, 1.0
    for _ in range(steps):
        v = advance(v)
        top = max(top, abs(v).max() / abs(start).max())
        if top > 1e5:
            break
    return float(top)


def _bar_step(setting: Setting, dt: float) -> Callable[[np.ndarray], np.ndarray]:
    chain = bar(setting.bar(), NODES)
    u = np.zeros(NODES)

    def advance(v: np.ndarray) -> np.ndarray:
        nonlocal u
        u = u + dt * v
        return v + dt * chain.acceleration(u)

    return advance


def _chain_step(setting: Setting, dt: float) -> Callable[[np.ndarray], np.ndarray]:
    """Stress and positions at whole steps, velocities at half steps."""
    chain, motion = base_chain(setting.base(), NODES)

    def advance(v: np.ndarray) -> np.ndarray:
        nonlocal motion
        rate = rates(chain, replace(motion, v=v)).motion.stress
        motion = replace(motion, x=motion.x + dt * v, v=v, stress=motion.stress + dt * rate)
        return v + dt * rates(chain, motion).motion.v

    return advance


@pytest.mark.decides("C70")
def test_both_forms_are_one_where_the_modulus_is_pushed_forward_and_not_otherwise() -> None:
    """omega_L^2 = F^2 omega_S^2 in their own units when C^sigma = F^3 C^SE; with constant moduli F = 1/2 tells them apart."""
    rows = same_material_rows(("as-defined",), ("7/4", "5/2"), ("4/5", "2"), ("-11/10", "-9/10", "3"))
    assert all(row["difference"] == 0 for row in rows)
    assert all((row["lagrangian_least"] < 0) == (row["stress_ratio"] == "-11/10") for row in rows)
    # Where C + sigma is zero so is every omega^2, and there is nothing to divide by.
    (none,) = same_material_rows(("as-defined",), ("3/2",), ("1",), ("-1",))
    assert none["difference"] == none["lagrangian_least"] == none["semi_lagrangian_least"] == 0
    (row,) = constant_moduli_rows(("as-defined",), "3/2", ("1/2",))
    assert row["lagrangian_least"] == pytest.approx(-1 / 8)  # (3 F^2 - 1)/2 times the largest |b|^2 = 1
    assert row["semi_lagrangian_least"] == 0


def test_measured_points_lie_on_the_curves_of_the_method_and_not_on_a_print_that_is_off() -> None:
    """At R = 7/4 (76) leaves the cell edge at 3h/2 out. The table's values are rounded to 1e-7."""
    semi = semi_lagrangian_rows([Case("scni", "7/4")], "1/2", ["0"], "1/20", 8, [4])
    (printed, defined, consistent) = (
        r["frequency"] for r in semi if r["kh"] == round(pi / 2, 10) and r["layer"] in ANALYTIC
    )
    measured = semi[-1]["frequency"]
    assert abs(defined - consistent) <= 2e-7
    assert abs(measured - defined) <= 1e-6
    assert abs(measured - printed) > 1e-3
    bar_rows = lagrangian_rows(["dni"], ["5/2"], "6/5", "1/3", 8, [4])
    of = {r["layer"]: r["frequency"] for r in bar_rows if r["kh"] == round(pi / 2, 10)}
    assert abs(of["simulated"] - of["as-defined"]) <= 1e-6
    # Over c, stretch and stress drop out.
    unstressed = at_rest(replace(BARS[1], stretch=1)).omega_squared(0.0, np.array([pi / 2]))[0]
    assert abs(of["as-defined"] - sqrt(unstressed)) <= 1e-7


def test_tables_say_what_the_relations_say() -> None:
    """Each column is what its name says, and a formula in print is asked for the supports alone for which it is printed."""
    found = relations(["printed SCNI", "DNI full"], ["3/2", "5/2"])
    assert list(found) == [("printed SCNI", "3/2"), ("DNI full", "3/2"), ("DNI full", "5/2")]
    for row in stress_rows(found):
        assert row["stable_from"] <= 0 <= row["stable_to"]
        assert row["stable_from"] < row["stable_to"]
    for row in step_rows(found, ["-1/2", "1/2"]):
        assert abs(row["critical_step"] * row["omega_max"] - 2) < 1e-7
        low, high = found[row["formulation"], row["support_ratio"]].extremes(float(Fraction(row["stress_ratio"])))
        assert abs(row["least_squared"] - low) <= 1e-9
        assert abs(row["omega_max"] ** 2 - high) <= 1e-8
    rows = moving_rows([Case("scni", "3/2")], [0.5], [0.25], 8)
    (printed,) = (row["discriminant"] for row in rows if row["layer"] == "printed")
    relation = printed_relation(Setting("semi-lagrangian", "scni", "3/2"))
    least = min(relation.discriminant(relation.state(0.25, 0.5), pi * n / 8) for n in range(1, 9))
    assert abs(printed - least) <= 1e-7


def test_rows_are_those_of_their_case_and_of_q_times_h() -> None:
    """The roots of one setting at Q h, not at Q, and in the case's own reading: both change the growth by more than rounding."""
    case, kh = Case("dni", "3/2", "diffuse"), pi * np.arange(1, 9) / 8
    rows = semi_lagrangian_rows([case], "1/2", ["2"], "1/20", 8, [])
    for layer in ANALYTIC:
        setting = Setting("semi-lagrangian", "dni", "3/2", derivative="diffuse", layer=layer)
        found = np.array([r["growth"] for r in rows if r["layer"] == layer])
        assert abs(found - growth(roots_over(setting, kh)(0.5, 0.1))).max() <= 1e-7
        for other, Q in ((setting, 2.0), (replace(setting, derivative="full"), 0.1)):
            assert abs(found - growth(roots_over(other, kh)(0.5, Q))).max() > 1e-4, (layer, Q)


@pytest.mark.parametrize(
    "setting",
    [
        replace(SETTINGS[0], layer="simulated"),
        replace(SETTINGS[0], node_motion="field"),
        replace(SETTINGS[0], mass="consistent"),
        Setting("lagrangian", "dni", "3/2"),
    ],
    ids=str,
)
def test_what_has_no_undamped_relation_is_refused(setting: Setting) -> None:
    with pytest.raises(BadInput):
        at_rest(setting)


def test_a_relation_without_motion_has_no_critical_step() -> None:
    assert AtRest(np.zeros(3), np.zeros(3)).critical_step(0.0) == np.inf


@pytest.mark.parametrize("s", [-2.0, 0.5])
@pytest.mark.parametrize("Q", [0.0, 0.25, -0.25])
def test_printed_roots_are_those_of_the_quadratic(s: float, Q: float) -> None:
    """As complex numbers: growth and frequency alone do not tell the sign of B, nor one root from two."""
    setting = Setting("semi-lagrangian", "scni", "3/2", stress_ratio=str(s), velocity_gradient=str(Q))
    found = roots_over(setting, KH)(s, Q)
    for theta, pair in zip(KH.tolist(), found, strict=True):
        of_layer = [complex(b.omega.re, b.omega.im) for b in dispersion(setting, [theta])]
        for omega in of_layer:
            assert abs(pair - omega).min() < 1e-7
        assert abs(pair.sum() - sum(of_layer)) < 1e-7


def test_growth_and_frequency_are_the_largest_of_their_roots() -> None:
    """e^{i omega t} grows at -Im omega, and a frequency has no sign; at rest roots come in pairs of opposite sign."""
    omega = np.array([[1 + 2j, -3 - 0.5j, 0.1j], [-0.2 + 1j, 0.1 + 3j, 0.05 + 0.25j]])
    assert growth(omega).tolist() == [0.5, -0.25]
    assert frequency(omega).tolist() == [3.0, 0.2]
    pairs = roots_over(SETTINGS[1], KH)(0.5, 0.0)
    assert abs(pairs.sum(axis=1)).max() == 0 < abs(pairs).min()


def _rounded_to(rows: list[dict[str, Any]], column: str, digits: int) -> None:
    """All values of a column have so many digits, and some no fewer: what is printed is what the study says that it prints."""
    values = [row[column] for row in rows if np.isfinite(row[column])]
    assert all(round(value, digits) == value for value in values), column
    assert any(round(value, digits - 1) != value for value in values), column


def test_every_column_has_its_digits_and_its_value() -> None:
    """Half a unit of the last digit from a value by another function, for all formulations."""
    found = relations(list(FORMULATIONS), ["19/10", "5/2"])
    assert ("printed SCNI", "19/10") in found
    assert ("printed SCNI", "5/2") not in found
    stresses = ["-7/10", "3/5"]
    steps, waves, ends = step_rows(found, stresses), wave_rows(found, stresses, 5), stress_rows(found)
    assert len(steps) == 2 * len(found)
    assert len(waves) == 5 * len(steps)
    for row in steps:
        relation, s = found[row["formulation"], row["support_ratio"]], float(Fraction(row["stress_ratio"]))
        grid = relation.omega_squared(s, np.linspace(0, pi, 2001))
        assert abs(row["omega_max"] - sqrt(max(grid.max(), 0))) <= 1e-5
        # The largest is at least what a fine grid sees; above it by a parabola's height between two samples.
        top = relation.omega_squared(s, np.array([relation.wave_of_largest(s)]))[0]
        assert abs(row["omega_max"] - sqrt(top)) <= 0.51e-9
        assert abs(row["critical_step"] - 2 / sqrt(top)) <= 0.51e-9
        assert abs(row["least_squared"] - relation.extremes(s)[0]) <= 0.51e-9
    for row in waves:
        relation, s = found[row["formulation"], row["support_ratio"]], float(Fraction(row["stress_ratio"]))
        exact = relation.omega_squared(s, np.array([row["kh"]]))[0]
        assert abs(row["omega_squared"] - exact) <= 0.51e-9 + 1e-9  # kh has ten digits
    assert {row["kh"] for row in waves} == {round(pi * (2 * n - 1) / 10, 10) for n in range(1, 6)}
    for row in ends:
        low, high = found[row["formulation"], row["support_ratio"]].stable_stresses()
        for value, exact in ((row["stable_from"], low), (row["stable_to"], high)):
            assert value == exact or abs(value - exact) <= 0.51e-6
    for rows, column, digits in (
        (steps, "omega_max", 9), (steps, "critical_step", 9), (steps, "least_squared", 9), (waves, "omega_squared", 9),
        (waves, "kh", 10),
    ):  # fmt: skip
        _rounded_to(rows, column, digits)


def test_readings_have_intervals_of_their_own() -> None:
    """For each law and measure the relation of that setting; they differ, and infinite ends stay infinite."""
    rows = reading_rows(["DNI full", "SCNI"], ["7/4"], ["truesdell", "cauchy-rate"], ["edges", "fixed"])
    assert len(rows) == 8
    for row in rows:
        setting = replace(
            FORMULATIONS[row["formulation"]],
            support_ratio=row["support_ratio"], stress_law=row["stress_law"], cell_measure=row["cell_measure"],
        )  # fmt: skip
        for column, exact in zip(("stable_from", "stable_to"), at_rest(setting).stable_stresses(), strict=True):
            assert row[column] == exact or abs(row[column] - exact) <= 0.51e-6
    assert len({(row["stable_from"], row["stable_to"]) for row in rows}) >= 3
    assert any(np.isinf(row["stable_to"]) for row in rows)


def test_moving_and_motion_rows_are_those_of_their_settings() -> None:
    """Growth, D, the change per |Q| and the growth at s >= -1, for DNI, from the roots at each (s, Q)."""
    case, samples = Case("dni", "3/2"), 6
    kh = pi * np.arange(1, samples + 1) / samples
    gradients, stresses = [0.3, -0.2], [-1.4, -1.0, 0.35]

    roots = cache(lambda case, layer: roots_over(case.setting(layer), kh))

    def largest(layer: str, s: float, Q: float) -> float:
        return float(growth(roots(case, layer)(s, Q)).max())

    moving = moving_rows([case], gradients, stresses, samples)
    assert len(moving) == 3 * 2 * 3
    for row in moving:
        s, Q = row["stress_ratio"], row["Q"]
        assert abs(row["growth"] - largest(row["layer"], s, Q)) <= 0.51e-7
        assert row["case"] == "DNI full, R = 3/2"
        if row["layer"] == "printed":
            relation = printed_relation(Setting("semi-lagrangian", "dni", "3/2"))
            least = min(relation.discriminant(relation.state(s, Q), theta) for theta in kh)
            assert abs(row["discriminant"] - least) <= 0.51e-7
        else:
            assert np.isnan(row["discriminant"])
    _rounded_to(moving, "growth", 7)
    _rounded_to(moving, "discriminant", 7)
    motion = motion_rows([case, Case("dni", "5/2"), Case("scni", "7/4")], gradients, stresses, samples)
    assert [(row["case"], row["layer"]) for row in motion[::2]] == [
        *[(case.label, layer) for layer in ANALYTIC],
        ("DNI full, R = 5/2", "as-defined"),
        ("DNI full, R = 5/2", "consistent"),
        *[("SCNI, R = 7/4", layer) for layer in ANALYTIC],
    ]
    turns = []
    for row in motion[:6] + motion[-6:]:
        Q, layer = row["Q"], row["layer"]
        case = Case("scni", "7/4") if row["case"].startswith("SCNI") else Case("dni", "3/2")
        change = max(abs(largest(layer, s, Q) - largest(layer, s, 0.0)) for s in stresses) / abs(Q)
        stable = max(largest(layer, s, Q) for s in stresses if s >= -1) / abs(Q)
        assert abs(row["change"] - change) <= 0.51e-5
        assert abs(row["stable_growth"] - stable) <= 0.51e-5
        if layer == "printed" and case.integration == "dni":
            assert row["turn"] == -100  # the end of the range that is looked at: nothing grows there
        elif layer == "printed":
            turns.append(row["turn"])
            # some growth just below the turn, none just above, by more than a unit of its last digit
            assert largest(layer, row["turn"] - 1e-4, Q) > 1e-6 >= largest(layer, row["turn"] + 1e-4, Q)
        else:
            assert np.isnan(row["turn"])
    assert all(round(turn, 6) == turn != round(turn, 5) for turn in turns)
    assert len(set(turns)) == 2
    _rounded_to(motion, "change", 5)
    _rounded_to(motion, "stable_growth", 5)


def test_both_forms_in_print_and_their_digits() -> None:
    """Rows for R < 2 alone in print; least values against the relations' own, in the units of each."""
    rows = same_material_rows(("printed", "as-defined"), ("7/4", "2"), ("4/5", "3/2"), ("-6/5", "1/3"))
    assert [(row["layer"], row["support_ratio"]) for row in rows[::4]] == [
        ("printed", "7/4"), ("as-defined", "7/4"), ("as-defined", "2"),
    ]  # fmt: skip
    for row in rows:
        F, s = float(Fraction(row["stretch"])), float(Fraction(row["stress_ratio"]))
        R, layer = row["support_ratio"], row["layer"]
        semi = at_rest(Setting("semi-lagrangian", "scni", R, layer=layer)).extremes(s)[0]
        one = at_rest(Setting("lagrangian", "scni", R, stretch=row["stretch"], layer=layer)).extremes(s * F**2)[0]
        assert abs(row["semi_lagrangian_least"] - semi) <= 0.51e-9
        assert abs(row["lagrangian_least"] - one) <= 0.51e-9
        # In print the two forms have stencils of their own.
        assert (row["difference"] > 1e-3) == (layer == "printed")
    kh = pi * np.arange(65) / 64
    bar_squares = at_rest(Setting("lagrangian", "scni", "7/4", stretch="3/2")).omega_squared(0.75, kh)
    semi_squares = at_rest(Setting("semi-lagrangian", "scni", "7/4")).omega_squared(1 / 3, kh)
    (row,) = (r for r in rows if (r["layer"], r["stretch"], r["stress_ratio"]) == ("printed", "3/2", "1/3"))
    assert abs(row["difference"] - abs(bar_squares - 2.25 * semi_squares).max() / bar_squares.max()) <= 0.51e-9
    constant = constant_moduli_rows(("as-defined",), "7/4", ("1/2", "1/10"))
    for row in constant:
        F = float(Fraction(row["stretch"]))
        one = at_rest(Setting("lagrangian", "scni", "7/4", stretch=row["stretch"], layer="as-defined"))
        semi = at_rest(Setting("semi-lagrangian", "scni", "7/4", layer="as-defined"))
        assert abs(row["lagrangian_least"] - one.extremes((F * F - 1) / 2)[0]) <= 0.51e-9
        assert abs(row["semi_lagrangian_least"] - semi.extremes(F - 1)[0]) <= 0.51e-9
    _rounded_to(rows, "lagrangian_least", 9)
    _rounded_to(constant, "lagrangian_least", 9)


def test_both_forms_measured_grow_as_their_relations() -> None:
    """Near kh = pi/2, on the same material at a stretch of 6/5 one growth in two units; with constant moduli two."""
    (same,) = measured_rows([("7/4", "-3/2")], "6/5")
    (calm,) = measured_rows([("7/4", "1/2")], "6/5")
    (constant,) = measured_constant_moduli("7/4", "1/2")
    assert calm["lagrangian_growth"] == calm["semi_lagrangian_growth"] == 0
    kh = np.array([pi / 2])
    semi = at_rest(Setting("semi-lagrangian", "scni", "7/4", layer="as-defined"))
    assert abs(same["semi_lagrangian_growth"] - sqrt(-semi.omega_squared(-1.5, kh)[0])) <= 1e-5
    assert abs(same["lagrangian_growth"] - same["semi_lagrangian_growth"]) <= 1e-5
    one = at_rest(Setting("lagrangian", "scni", "7/4", stretch="1/2", layer="as-defined"))
    assert abs(constant["lagrangian_growth"] * 0.5 - sqrt(-one.omega_squared(-0.375, kh)[0])) <= 1e-5
    assert constant["semi_lagrangian_growth"] == 0
    assert [(row["moduli"], row["stretch"], row["stress_ratio"]) for row in (same, constant)] == [
        ("same material", "6/5", -1.5), ("constant moduli", "1/2", -0.5),
    ]  # fmt: skip
    assert round(same["lagrangian_growth"], 6) == same["lagrangian_growth"]


def test_curves_have_their_digits_and_every_case() -> None:
    """Seven digits, kh with ten; the growth of an unstable bar over c, and what a measurement cannot tell from zero is zero."""
    rows = semi_lagrangian_rows([Case("scni", "7/4"), Case("dni", "7/4")], "-1/2", ["0", "1"], "1/10", 6, [])
    rows += semi_lagrangian_rows([Case("dni", "7/4")], "-1/2", [], "1/10", 6, [2])
    kh = pi * np.arange(1, 7) / 6
    roots = cache(lambda setting: roots_over(setting, kh))
    for row in rows:
        if row["layer"] == "simulated":
            continue
        integration = "scni" if row["case"].startswith("SCNI") else "dni"
        setting = Setting("semi-lagrangian", integration, "7/4", layer=row["layer"])
        omega = roots(setting)(-0.5, 0.1 * float(row["Q"]))[[round(row["kh"] / pi * 6) - 1]]
        assert abs(row["growth"] - growth(omega)[0]) <= 1e-6
        assert abs(row["frequency"] - frequency(omega)[0]) <= 1e-6
        assert row["uncertain_below"] == 0
    assert {row["kh"] for row in rows} == {round(pi * n / 6, 10) for n in range(1, 7)} | {round(pi / 4, 10)}
    _rounded_to(rows, "growth", 7)
    _rounded_to(rows, "frequency", 7)
    measured = [row for row in rows if row["layer"] == "simulated"]
    assert [row["case"] for row in measured] == ["DNI full, R = 7/4"]
    assert all(row["growth"] == 0 or row["frequency"] == 0 for row in measured)
    assert all(row["uncertain_below"] in (1e-5, 1e-3) for row in measured)
    bars = lagrangian_rows(["scni", "dni"], ["7/4"], "6/5", "1/3", 4, [3])
    c = sqrt(1.44 + 1 / 3)
    for row in bars:
        layer = row["layer"] if row["layer"] != "simulated" else "as-defined"
        integration = "scni" if row["case"].startswith("SCNI") else "dni"
        setting = Setting("lagrangian", integration, "7/4", stretch="6/5", layer=layer)
        squared = at_rest(setting).omega_squared(1 / 3, np.array([row["kh"]]))[0]
        assert row["growth"] == 0
        assert abs(row["frequency"] - sqrt(max(squared, 0)) / c) <= 1e-6
        assert row["uncertain_below"] == (1e-5 if row["layer"] == "simulated" else 0)
    assert [(row["case"], row["layer"]) for row in bars] == [
        *[("SCNI, R = 7/4", "printed")] * 4, *[("SCNI, R = 7/4", "as-defined")] * 4, ("SCNI, R = 7/4", "simulated"),
        *[("DNI, R = 7/4", "as-defined")] * 4, ("DNI, R = 7/4", "simulated"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("uncertainty", "bound"),
    [(0, 1e-5), (1.9e-5, 1e-5), (2e-5, 1e-3), (1.9e-3, 1e-3), (2e-3, 0.1), (0.19, 0.1), (0.2, 1), (1.9, 1)],
)
def test_a_measured_row_says_the_round_number_above_its_uncertainty(uncertainty: float, bound: float) -> None:
    """The least of them, over c = 2; and what is not above ten times that number is zero."""
    for size, seen in ((21 * bound, round(10.5 * bound, 7)), (19 * bound, 0)):
        found = Measured(1.0, (Root(-size, 0.0), Root(0.0, -size)), uncertainty)
        row = _measured_row("case", "0", found, 2.0)
        assert row["uncertain_below"] == bound
        assert row["growth"] == row["frequency"] == seen


def test_the_stress_of_a_measured_row_has_nine_digits(monkeypatch: pytest.MonkeyPatch) -> None:
    """And growths are over F in the Lagrangian form; nothing is measured here."""
    found = Measured(1.0, (Root(0.0, -0.6), Root(0.0, 0.6)), 1e-4)
    monkeypatch.setattr("rkverify.stability.simulate.measure", lambda base, kh: found)
    monkeypatch.setattr("rkverify.stability.simulate.measure_bar", lambda base, kh: found)
    (row,) = measured_rows([("7/4", "-2/3")], "6/5")
    assert row["stress_ratio"] == -0.666666667
    assert (row["lagrangian_growth"], row["semi_lagrangian_growth"]) == (0.5, 0.6)
