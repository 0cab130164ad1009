"""Central differences keep what their symmetries give: momentum and angular momentum to rounding, energy up to the square of the step."""

from itertools import pairwise

import numpy as np
import pytest

from rkverify.errors import BadInput
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.mechanics.vibration import Swing, central_differences, critical_step

STEPS = 200


def spinning(made, b):
    x = made.positions - 0.5
    v = 0.4 * np.stack([-x[:, 1], x[:, 0]], axis=1) + made.small(0.02)
    return Swing(np.zeros_like(x), v, b)


def run(swing, dt, steps=STEPS):
    return [account for _, account in central_differences(swing, dt, steps)]


@pytest.mark.parametrize("integration", ["scni", "dni", "snni"])
def test_momentum_and_angular_momentum_stay(block, integration):
    """sum_I b_I = 0 and sum_I b_I x_I = F for every integration here; P F^T is symmetric. Rounding: a random walk of STEPS sums."""
    made = block()
    b = made.body(integration)
    accounts = run(spinning(made, b), 0.5 * critical_step(b))
    first = accounts[0]
    size = first.mass * 0.4
    assert max(abs(a.momentum - first.momentum).max() for a in accounts) <= 1e-13 * size
    assert max(abs(a.angular - first.angular).max() for a in accounts) <= 1e-13 * size
    assert all(a.mass == first.mass for a in accounts)


def test_the_energy_error_is_of_second_order_in_the_step(block):
    """Over one time the largest error falls by 4 with half the step: a first-order velocity in the account would show 2."""
    made = block()
    b = made.body()
    swing = spinning(made, b)
    dt = 0.4 * critical_step(b)

    def error(n):
        energy = np.array([a.energy for a in run(swing, dt / n, 60 * n)])
        return abs(energy - energy[0]).max()

    errors = [error(n) for n in (1, 2, 4)]
    assert all(3.5 < p / q < 4.5 for p, q in pairwise(errors))


def test_the_work_stands_for_the_energy_of_a_law_that_has_none(block, moduli):
    """Kinetic energy and the work of the stress stay, up to the square of the step; kinetic energy alone goes up and down."""
    made = block()
    swing = spinning(made, made.body(law=Jaumann(moduli)))
    dt = 0.4 * critical_step(made.body())
    errors = []
    for n in (1, 2):
        accounts = run(swing, dt / n, 20 * n)
        energy = np.array([a.energy for a in accounts])
        errors.append(abs(energy - energy[0]).max())
        assert errors[-1] < 0.1 * np.ptp([a.kinetic for a in accounts])
    assert 3.5 < errors[0] / errors[1] < 4.5


def test_the_critical_step_is_where_motion_starts_to_grow(block):
    made = block()
    b = made.body()
    tiny = Swing(np.zeros_like(made.positions), made.small(1e-9), b)
    for share, grows in ((0.98, False), (1.02, True)):
        kinetic = [a.kinetic for a in run(tiny, share * critical_step(b), 40)]
        assert (max(kinetic) > 50 * kinetic[0]) == grows


def test_many_unknowns_give_the_same_critical_step(block, monkeypatch):
    """Lanczos against all eigenvalues."""
    made = block()
    whole = critical_step(made.body())
    monkeypatch.setattr("rkverify.solid.mechanics.vibration.LARGEST_DENSE", 0)
    assert abs(critical_step(made.body()) - whole) <= 1e-10 * whole


def test_a_load_gives_momentum_at_its_rate(block):
    """d(momentum)/dt = total force, exactly, for forces constant in time."""
    made = block()
    b = made.body()
    load = b.body_force(np.tile([0.0, -1.0], (len(made.positions), 1)))
    dt = 0.5 * critical_step(b)
    still = Swing(np.zeros_like(made.positions), np.zeros_like(made.positions), b)
    accounts = [a for _, a in central_differences(still, dt, 50, lambda time: load)]
    for a in accounts:
        assert abs(a.momentum - a.time * load.sum(axis=0)).max() <= 1e-13


def test_bad_steps_are_refused(block):
    made = block()
    with pytest.raises(BadInput, match="time step 0"):
        list(central_differences(spinning(made, made.body()), 0.0, 1))
