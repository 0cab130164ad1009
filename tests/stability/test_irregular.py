"""Uneven finite chains: eigenvalues of the whole chain against what the nonlinear equations do."""

import numpy as np
import pytest

from rkverify.readings import Readings
from rkverify.solid.chain import rates
from rkverify.stability.irregular import growth, measured, rows, uneven_chain
from rkverify.stability.lattice_state import Base


@pytest.mark.decides("C75")
def test_unevenness_turns_the_verdict_of_dni_and_not_of_scni() -> None:
    cases = [("scni", "full", "9/5"), ("dni", "full", "9/5")]
    found = {(r["integration"], r["jitter"]): r["unstable"] for r in rows(cases, ["1/2"], ["0", "1/5"], 15, 1)}
    assert found == {("scni", "0"): 0, ("scni", "1/5"): 0, ("dni", "0"): 0, ("dni", "1/5"): 1}


@pytest.mark.parametrize(("R", "s", "jitter"), [("3/2", "1/2", 0.2), ("9/5", "-1/2", 0.1), ("9/5", "1/2", 0.2)])
def test_the_chain_grows_as_its_eigenvalue(R: str, s: str, jitter: float) -> None:
    """Over four e-folding times, with an amplitude of 1e-6: its square and the time steps are far below one in a thousand."""
    chain, start = uneven_chain(Base(R, Readings("dni", "none"), s), 15, jitter, 0)
    rate, shape = growth(chain, start)
    assert rate > 0.1
    assert abs(measured(chain, start, rate, shape) / rate - 1) < 1e-3


def test_dead_loads_hold_an_uneven_chain() -> None:
    for integration in ("scni", "dni"):
        chain, start = uneven_chain(Base("9/5", Readings(integration, "none"), "1/2"), 15, 0.2, 1)
        assert abs(rates(chain, start).motion.v).max() < 1e-14
        assert abs(rates(chain, start).internal).max() > 0.1  # the ends pull


def test_cells_and_masses_fill_the_chain() -> None:
    chain, start = uneven_chain(Base("3/2", Readings("scni", "none"), 0), 11, 0.2, 3)
    assert np.isclose(start.measures.sum(), start.x[-1] - start.x[0], rtol=1e-14)
    assert np.allclose(chain.masses, start.measures)


def test_rows_are_those_of_their_seeds() -> None:
    """Least, largest and number of growing chains over two seeds, each by the growth of that chain; what is less than 1e-4 is none."""
    cases = [("dni", "diffuse", "3/2"), ("dni", "full", "9/5")]
    found = rows(cases, ["1/2"], ["0", "1/5"], 11, 2)
    assert [(r["derivative"], r["support_ratio"], r["jitter"]) for r in found] == [
        (d, R, j) for _, d, R in cases for j in ("0", "1/5")
    ]
    for row in found:
        base = Base(row["support_ratio"], Readings("dni", "none", row["derivative"]), "1/2")
        jitter = 0.2 if row["jitter"] == "1/5" else 0.0
        each = [growth(*uneven_chain(base, 11, jitter, seed))[0] for seed in (0, 1)]
        each = [rate if rate > 1e-4 else 0.0 for rate in each]
        assert (row["least"], row["largest"]) == (min(each), max(each))
        assert row["unstable"] == sum(rate > 0 for rate in each)
        assert row["measured_agrees"]
        assert (row["integration"], row["stress_ratio"]) == ("dni", "1/2")
    assert {row["unstable"] for row in found} >= {0, 2}


def test_a_seed_moves_inner_nodes_by_its_jitter_in_spacings() -> None:
    """Ends stay, offsets are below jitter h and not far below; edges half-way, but at the ends; another seed is another chain."""
    base = Base("3/2", Readings("scni", "none"), "1/3", spacing="1/10")
    chain, start = uneven_chain(base, 41, 0.2, 5)
    lattice = 0.1 * (np.arange(41) - 20)
    off = start.x - start.x[0] - (lattice - lattice[0])
    assert abs(off[[0, -1]]).max() < 1e-14
    assert 0.015 < abs(off).max() <= 0.02
    assert abs(start.edges[:-1] - (start.x[1:] + start.x[:-1]) / 2).max() < 1e-14
    assert start.edges[-1] == start.x[-1]
    assert abs(start.measures[[0, -1]] - [start.edges[0] - start.x[0], start.x[-1] - start.edges[-2]]).max() < 1e-14
    assert not chain.periodic
    assert (start.period, start.period_rate) == (0, 0)
    assert (uneven_chain(base, 41, 0.2, 6)[1].x != start.x).sum() == 39
    assert abs(start.stress - 1 / 3).max() < 1e-15
