"""Waves on a base that moves: linear equations that follow it, against the nonlinear motion.

The nonlinear motion knows nothing of any linearisation. What is left between the two is the wave's own size, 1e-5, the
time steps, 1e-12 of positions of order ten over that size, and on the lattice the spline through 33 symbols, whose error
is 1e-4 where a node passes a joint of the kernel, beyond which the C2 kernel's third derivative jumps.
"""

from dataclasses import replace
from fractions import Fraction
from math import log

import numpy as np
import pytest

from rkverify.arithmetic.native import Float
from rkverify.errors import BadInput, UnknownName
from rkverify.readings import CONVECTIONS, Readings
from rkverify.solid.chain import rates
from rkverify.solid.integrate import integrate, pack
from rkverify.solid.tangent import change_of_rates, changed, follow
from rkverify.stability import jacobian_paper, passages
from rkverify.stability.jacobian_solid import base_chain
from rkverify.stability.lattice_state import Base
from rkverify.stability.layers import Setting
from rkverify.stability.moving_base import (
    Passage,
    base_at,
    finite_chain,
    starting_amplitudes,
    symbol_at,
    wave_on_chain,
    wave_on_lattice,
)
from rkverify.stability.passages import Wave, chain_rows, first_beyond, lattice_rows, validity_rows
from rkverify.stability.surveys import roots_over

QS = ("-1/10", "1/10")


@pytest.mark.decides("C43", "C56", "C58")
@pytest.mark.parametrize("integration", ["scni", "dni"])
@pytest.mark.parametrize("convection", ["none", "true", "psi-star"])
@pytest.mark.parametrize("Q", QS)
def test_the_linear_equations_follow_the_nonlinear_wave(integration: str, convection: str, Q: str) -> None:
    base = Base("3/2", Readings(integration, convection), "-1/4", Q)
    assert wave_on_chain(base, 17, 2.0, 1.0, "oscillating").error < 1e-3
    if convection != "psi-star":
        assert wave_on_lattice(base, 2.0, "oscillating", 1.0).error < 1e-3


@pytest.mark.parametrize(
    "change", [{"support_radius": "spacing"}, {"mass": "consistent"}, {"stress_law": "cauchy-rate"}]
)
def test_they_do_in_other_readings(change: dict[str, str]) -> None:
    base = Base("7/4", Readings("dni", "true", **change), "1/4", "1/10")
    assert wave_on_lattice(base, 2.0, "velocity", 1.0).error < 1e-3
    assert wave_on_chain(base, 13, 2.0, 0.5).error < 1e-3


def test_frozen_coefficients_do_not() -> None:
    """The twin: with the coefficients of the start the same wave is off by far more, so that following is what counts."""
    passage = wave_on_lattice(Base("3/2", Readings("dni", "none"), "1/2", "1/10"), 3.0, "growing")
    assert passage.error < 1e-3
    assert passage.moving_growth > 1.5 * passage.frozen_growth


@pytest.mark.parametrize("law", ["truesdell", "cauchy-rate"])
def test_the_base_moves_as_the_closed_form_says(law: str) -> None:
    """h grows as 1 + Q t; C + sigma with it, or sigma by log(1 + Q t): integrated without any of this being used."""
    base = Base("3/2", Readings("scni", "true", stress_law=law), "1/3", "1/5")
    chain, start = base_chain(base, 24)
    end, moved = integrate(chain, start, [0.0, 2.0], 1e-12)[-1], base_at(base, 2.0)
    assert np.allclose(np.diff(end.x), moved.spacing, rtol=1e-10)
    assert np.allclose(end.stress, moved.stress_ratio, rtol=1e-10)
    assert abs(moved.stress_ratio - ((4 / 3) * 1.4 - 1 if law == "truesdell" else 1 / 3 + log(1.4))) < 1e-14
    assert np.allclose(end.v, end.x * moved.velocity_gradient, atol=1e-9)


@pytest.mark.decides("E65")
def test_inside_a_finite_chain_the_equations_are_those_of_the_lattice_in_its_frame() -> None:
    """Another route to N on a base whose velocity depends on the position: duals through the transcription."""
    base = Base("7/4", Readings("dni", "psi-star"), "1/3", "1/5")
    chain, start = finite_chain(base, 31)
    node = 20
    here = replace(base, frame_velocity=float(start.v[node]))
    stencil = jacobian_paper.linearise(here, Float()).stencil
    for place, kind in enumerate(("x", "v", "stress")):
        for n in (-3, -1, 0, 2):
            change = np.zeros(5 * 31)
            change[place * 31 + node + n] = 1.0
            slope = change_of_rates(chain, start, change)[1]
            # Rounding of sums of a hundred products, times the condition number of the moment matrix, below 30.
            assert abs(slope[31 + node] - stencil["v", kind].get(n, 0.0)) < 30 * 100 * 2.0**-52, (kind, n)


def test_the_tangent_is_a_difference_quotient() -> None:
    """A complex step against central differences, whose error is (1e-5)^2 of third derivatives below 100."""
    chain, start = finite_chain(Base("3/2", Readings("scni", "psi-star"), "1/3", "1/5"), 11)
    change = np.sin(np.arange(55.0))
    moved = [pack(rates(chain, changed(start, sign * 1e-5 * change)).motion) for sign in (1, -1)]
    assert np.allclose(change_of_rates(chain, start, change)[1], (moved[0] - moved[1]) / 2e-5, atol=1e-7)


def test_dead_loads_hold_the_chain_until_n_moves_it() -> None:
    """Without N nothing accelerates at the start; with Psi* the ends of a stretching chain do."""
    for convection, still in (("none", True), ("psi-star", False)):
        chain, start = finite_chain(Base("3/2", Readings("scni", convection), "1/2", "1/5"), 15)
        assert bool(abs(rates(chain, start).motion.v).max() < 1e-14) == still


@pytest.mark.parametrize(
    "change",
    [{"convection": "psi-star"}, {"stress_law": "literal"}, {"node_motion": "field"}, {"cell_measure": "fixed"}],
)
def test_a_base_that_moves_otherwise_is_refused(change: dict[str, str]) -> None:
    readings = Readings("scni", **{"convection": "true", **change})
    with pytest.raises(BadInput, match="finite chain"):
        base_at(Base("3/2", readings, 0, "1/5"), 1.0)


def test_a_base_that_vanishes_and_an_unknown_start_are_refused() -> None:
    base = Base("3/2", Readings("scni", "true"), 0, "-1/2")
    with pytest.raises(BadInput, match="shrunk"):
        base_at(base, 2.0)
    with pytest.raises(UnknownName):
        starting_amplitudes(base, 1.0, "anything")


def test_where_a_curve_leaves_a_band() -> None:
    assert first_beyond([0.1, 0.2], [1.02, 0.98], 0.1) == float("inf")
    assert abs(first_beyond([0.1, 0.3], [1.0, 0.8], 0.1) - 0.2) < 1e-15
    # from nothing at 0 to 0.4 at the first sample, on either side
    assert abs(first_beyond([0.2, 0.3], [1.4, 1.0], 0.1) - 0.05) < 1e-15
    assert abs(first_beyond([0.2, 0.3], [0.6, 1.0], 0.1) - 0.05) < 1e-15
    assert first_beyond([0.25, 0.5], [1.0, 1.25], 0.25) == 0.5
    # from 0.05 to 0.25 on the other side: half-way the gap is 0.15
    assert abs(first_beyond([0.1, 0.3], [1.05, 1.25], 0.15) - 0.2) < 1e-15


@pytest.mark.parametrize("count", [13, 24])
def test_a_packet_is_in_the_middle_of_its_chain(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    """As large on one side as on the other and smooth, so that the free ends are not felt: 1/100 of it, or less, is there."""
    parts = []

    def seen(chain, start, part, *rest):
        parts.append(part)
        return follow(chain, start, part, *rest)

    monkeypatch.setattr("rkverify.stability.moving_base.follow", seen)
    wave_on_chain(Base("3/2", Readings("scni", "none"), "1/4", "1/10"), count, 2.0, 0.01)
    real, imaginary = (part[count : 2 * count] for part in parts)
    packet, middle = real + 1j * imaginary, count // 2
    side = np.arange(1, count - middle)
    assert packet[middle] == 1
    np.testing.assert_allclose(packet[middle + side], np.conj(packet[middle - side]), rtol=0, atol=1e-15)
    assert (np.diff(abs(packet[middle:])) < 0).all()
    assert max(abs(packet[[0, -1]])) < 0.01
    np.testing.assert_allclose(np.angle(packet[middle + side] / packet[middle + side - 1]), 2.0, rtol=0, atol=1e-12)


def test_a_change_followed_is_linear_in_its_start() -> None:
    """Its size is taken out on the way and put back: three times the change ends as three times the change."""
    chain, start = finite_chain(Base("3/2", Readings("scni", "psi-star"), "1/3", "1/5"), 11)
    change, times = np.sin(np.arange(55.0)), np.array([0.0, 0.2])
    one, three = (follow(chain, start, size * change, times)[1] for size in (1.0, 3.0))
    assert abs(one[0] - change).max() < 1e-15
    assert abs(three - 3 * one).max() < 1e-12


WAVE = Wave("dni", "3/2", "1/2", 3.0, "growing")


def test_tables_of_passages_are_those_of_their_waves() -> None:
    """Each row is the passage of its own setting: convection, Q, start and duration; the rate is the frozen root's."""
    wave = replace(WAVE, kh=2.0, start="oscillating", stress_ratio="1/4")
    rows = lattice_rows([wave], ["1/10"], 0.4)
    assert [row["convection"] for row in rows] == [c for c in CONVECTIONS if c != "psi-star"]
    long = chain_rows([wave], ["1/10"], 0.4, 11)
    assert [row["convection"] for row in long] == list(CONVECTIONS)
    for row in [*rows, *long]:
        base = Base("3/2", Readings("dni", row["convection"]), "1/4", "1/10")
        if row["domain"] == "lattice":
            passage = wave_on_lattice(base, 2.0, "oscillating", 0.4)
        else:
            passage = wave_on_chain(base, 11, 2.0, 0.4, "oscillating")
        assert (row["nonlinear"], row["moving"], row["frozen"], row["error"], row["kh"]) == (
            passage.nonlinear_growth, passage.moving_growth, passage.frozen_growth, passage.error, passage.kh,
        )  # fmt: skip
        assert row["duration"] == 0.4
        assert (row["Q"], row["support_ratio"], row["stress_ratio"], row["start"]) == (
            "1/10",
            "3/2",
            "1/4",
            "oscillating",
        )
        layer = "consistent" if row["convection"] == "true" else "as-defined"
        setting = Setting("semi-lagrangian", "dni", "3/2", layer=layer, convective=row["convection"] != "none")
        omega = roots_over(setting, np.array([row["kh"]]))(0.25, 0.1)[0]
        assert abs(row["frequency"] - abs(omega.real).max()) < 1e-9


def test_shares_of_the_frozen_growth_are_quotients(monkeypatch: pytest.MonkeyPatch) -> None:
    """Q is the share of the growth at rest, which the undamped relation knows; passages are given, so that only the table is looked at."""
    seen = []

    def passage(base: Base, kh: float, start: str) -> Passage:
        seen.append((base, kh, start))
        return Passage(kh, 2.0, 1e-5, 0.75, 0.5, 0.25, 0.25 + 1j)

    monkeypatch.setattr(passages, "wave_on_lattice", passage)
    rows = validity_rows([replace(WAVE, stress_ratio="1/3")], ["1/5", "-1/2"], ["none", "true"])
    omega = roots_over(Setting("semi-lagrangian", "dni", "3/2", layer="as-defined", convective=False), np.array([3.0]))
    at_rest = (-omega(1 / 3, 0.0).imag).max()
    for row, (base, kh, start) in zip(rows, seen, strict=True):
        assert abs(row["growth_at_rest"] - at_rest) < 1e-9
        assert abs(float(base.velocity_gradient) - float(Fraction(row["Q_over_growth"])) * at_rest) < 1e-6
        # a short rational, so that a reader can give the same Q
        assert (Fraction(base.velocity_gradient) / Fraction(row["Q_over_growth"])).denominator <= 10**6
        assert (base.readings.convection, kh, start) == (row["convection"], 3.0, "growing")
        assert (row["frozen"], row["moving"], row["nonlinear"], row["error"]) == (0.25, 2.0, 3.0, 1e-5)
    assert [(row["convection"], row["Q_over_growth"]) for row in rows] == [
        (c, share) for c in ("none", "true") for share in ("1/5", "-1/2")
    ]


@pytest.mark.parametrize("h", ["1", "1/10"])
def test_a_finite_chain_ends_at_its_last_nodes(h: str) -> None:
    """Half cells at both ends, which end where the nodes are; the inner ones are those of the lattice."""
    for edges in ("voronoi", "material"):
        base = Base("3/2", Readings("scni", "none", cell_edges=edges), "1/3", "1/5", h)
        chain, start = finite_chain(base, 9)
        spacing = 1.0 if h == "1" else 0.1
        assert abs(np.diff(start.x) - spacing).max() < 1e-14
        assert abs(start.edges[:-1] - (start.x[:-1] + start.x[1:]) / 2).max() < 1e-14
        assert start.edges[-1] == start.x[-1]
        assert abs(start.measures / spacing - np.r_[0.5, np.ones(7), 0.5]).max() < 1e-14
        assert abs(chain.masses / spacing - np.r_[0.5, np.ones(7), 0.5]).max() < 1e-14
        assert not chain.periodic
        assert (start.period, start.period_rate) == (0, 0)


def test_a_packet_on_a_base_at_rest_grows_as_its_wave() -> None:
    """A growth is that of a packet of size 1, whatever its size is: with more nodes it is nearer to the wave's own.

    A packet holds waves at other kh, which grow otherwise, within 6 over its nodes. What they do to its growth goes as
    the square of that: by 3.7 less with 25 nodes than with 13, of which a factor of 2 is asked.
    """
    base = Base("3/2", Readings("dni", "none"), "1/2")
    off = []
    for count in (13, 25):
        passage = wave_on_chain(base, count, 3.0, 0.5, "growing")
        growths = np.array([passage.nonlinear_growth, passage.moving_growth, passage.frozen_growth])
        off.append(abs(growths / passage.rate.real - 1).max())
    assert off[0] < 0.1
    assert off[1] < off[0] / 2


@pytest.mark.parametrize("start", ["growing", "oscillating"])
def test_a_start_is_the_mode_that_it_names(start: str) -> None:
    """A a = lambda a, with the largest growth or the largest frequency of the symbol, on a chain and in the endless lattice."""
    base = Base("3/2", Readings("dni", "none"), "1/2", "1/10")
    found = {}
    for count in (0, 20):
        amplitudes, rate = starting_amplitudes(base, 2 * np.pi * 9 / 20, start, count)
        A = symbol_at(base, 2 * np.pi * 9 / 20, 20)
        assert abs(A @ amplitudes - rate * amplitudes).max() < 1e-12
        values = np.linalg.eigvals(A)
        found[count] = rate
        part = (values.real, rate.real) if start == "growing" else (values.imag, rate.imag)
        assert abs(part[0].max() - part[1]) < 1e-12
    assert abs(found[0] - found[20]) < 1e-12
    assert starting_amplitudes(base, 1.0, "velocity")[0].tolist() == [0, 1, 0]


def test_the_shortest_wave_is_its_own_mirror_image() -> None:
    """At kh = pi the wave and its conjugate are one: its amplitude is counted once, at any other kh half is at -kh."""
    base = Base("3/2", Readings("dni", "none"), "1/2", "1/10")
    assert wave_on_lattice(base, np.pi, "growing", 0.1).error < 1e-3
