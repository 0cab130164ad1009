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
