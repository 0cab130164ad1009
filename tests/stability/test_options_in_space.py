"""What an option does in the plane is zero for the default and, where theory says so, for others too."""

import numpy as np
import pytest

from rkverify.readings import NODAL_INTEGRATIONS
from rkverify.stability.bloch.lattices import lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import DEFAULT_RULES, Scheme
from rkverify.stability.bloch.zones import commensurate, worst
from rkverify.stability.options_in_space import RULES, frequencies, option_rows_in_space, variants

TENSION = {"tension": (0.3, 0.0, 0.0)}


def test_the_first_option_is_the_default_of_the_library_and_moves_nothing() -> None:
    base = Scheme("scni", 1.4)
    assert RULES[0] == DEFAULT_RULES["scni"]
    for integration in NODAL_INTEGRATIONS:
        for choice, options in variants(integration).items():
            first = next(iter(options.values()))(Scheme(integration, 1.4))
            assert first.rule == Scheme(integration, 1.4).rule, choice
            assert (first.window, first.integration) == (base.window, integration)
    rows = option_rows_in_space(["1.4"], TENSION, 4)
    firsts = {choice: next(iter(options)) for choice, options in variants("scni").items()}
    assert all(row["away"] == 0 for row in rows if row["option"] == firsts[row["choice"]])
    assert {row["choice"] for row in rows if row["away"] > 1e-3} == {"window", "edge_rule", "integration"}


def test_waves_along_an_axis_do_not_see_the_edge_rule_of_a_tensor_window() -> None:
    """A product of kernels leaves a wave along x the functions of a line, which have no edge. The twin: a radial kernel does not."""
    k, pull = np.array([[0.7, 0.0], [2.1, 0.0]]), Loading(TENSION["tension"])

    def found(window: str, rule: str) -> np.ndarray:
        scheme = Scheme("scni", 1.8, rule, window=window)  # type: ignore[arg-type]
        return np.sort(np.abs(frequencies(linearised(lattice("square"), scheme), pull, k)), axis=1)[:, -1]

    # Longitudinal waves; 1e-9: the root of an omega^2 that two ways of adding the same terms give to some 1e-15.
    assert found("tensor", "trapezoid") == pytest.approx(found("tensor", "gauss:4"), rel=1e-9)
    assert found("radial", "trapezoid") != pytest.approx(found("radial", "gauss:4"), rel=1e-3)


def test_rows_have_the_growth_of_the_worst_wave_of_their_own_scheme() -> None:
    """Each row by its integration, option, support and stress: a scheme taken for another would grow otherwise."""
    states = {"tension": (0.3, 0.0, 0.0), "compression": (-1.5, 0.0, 0.0)}
    nodes = lattice("square")
    k = commensurate(nodes, 4)
    seen = set()
    for row in option_rows_in_space(["1.4", "1.7"], states, 4):
        if row["choice"] != "window":
            continue
        scheme = Scheme(row["integration"], float(row["support_ratio"]), window=row["option"])
        growth = worst(linearised(nodes, scheme), Loading(states[row["state"]]), k).growth
        assert abs(row["growth"] - growth) <= 1e-9
        seen.add(round(growth, 6))
    assert min(seen) == 0
    assert len(seen) > 12  # of 24 rows
