"""A chain's motion in time: what the integrator's own tolerances are good for, and where it stops."""

from dataclasses import replace

import numpy as np
import pytest

from rkverify.readings import Integration, Readings
from rkverify.solid.chain import Chain, Motion, consistent_mass, rates, unbalanced
from rkverify.solid.integrate import integrate
from rkverify.stability.jacobian_solid import base_chain
from rkverify.stability.lattice_state import Base

AMPLITUDE = 1e-6
TIMES = [0.0, 1.0, 2.5, 4.0]


def wave() -> tuple[Chain, Motion]:
    """A stressed chain of 12 nodes at rest, and the velocities of a wave of two periods in it."""
    chain, still = base_chain(Base("3/2", Readings("scni"), "1/3"), 12)
    push = AMPLITUDE * np.cos(2 * np.pi * 2 * np.arange(12) / 12)
    return chain, Motion(still.x, push, still.stress, still.edges, still.measures, still.period)


def test_a_small_wave_has_six_digits_with_the_tolerances_as_they_are() -> None:
    """Velocities against a run a hundred times finer: some ten steps of 1e-14 times sqrt(60), the root of the state's size.

    Positions of order 1 would be good to 1e-11 of themselves: it is the absolute tolerance that sees a wave of 1e-6.
    """
    chain, start = wave()
    found, fine = integrate(chain, start, TIMES), integrate(chain, start, TIMES, 1e-13, 1e-16)
    assert len(found) == len(fine) == len(TIMES)
    assert abs(found[0].v - start.v).max() == 0
    assert max(abs(one.v - other.v).max() for one, other in zip(found, fine, strict=True)) < 1e-6 * AMPLITUDE
    assert abs(fine[-1].v - start.v).max() > AMPLITUDE


def test_it_stops_where_it_is_told_to() -> None:
    """The velocity of the first node falls to half of what it was just after the second time: two motions are left of four."""
    chain, start = wave()
    assert len(integrate(chain, start, TIMES, stop=lambda motion: float(motion.v[0]) - AMPLITUDE / 2)) == 2
    assert len(integrate(chain, start, TIMES, stop=lambda motion: 1.0)) == len(TIMES)


def test_the_period_grows_at_its_rate_and_the_rate_stays() -> None:
    """What the integrator does not integrate: a period is linear in time, and `rates` says so."""
    chain, moving = base_chain(Base("3/2", Readings("scni"), "1/3", "1/5"), 12)
    motion = rates(chain, moving).motion
    assert (motion.period, motion.period_rate) == (moving.period_rate, 0)
    assert abs(integrate(chain, moving, [0.0, 1.0])[-1].period - (12 + 12 / 5)) < 1e-14


@pytest.mark.parametrize("integration", ["scni", "dni"])
def test_a_node_s_image_has_the_equation_of_the_node(integration: Integration) -> None:
    """The first node's image one period further on may stand for it in any state: the forces on the others are the same.

    Those on the image are not: it is accelerated by more, which takes that much times its row of the consistent mass.
    """
    rng = np.random.default_rng(7)
    chain, still = base_chain(Base("7/4", Readings(integration, "true"), "1/3", "1/5"), 12)
    push = rng.uniform(-0.1, 0.1, (4, 12))
    chain = replace(chain, masses=1 + rng.random(12) / 2)
    motion = replace(
        still,
        x=still.x + push[0],
        v=still.v + push[1],
        stress=still.stress + push[2],
        measures=still.measures + push[3],
    )

    def renumbered(values: np.ndarray, further: float = 0.0) -> np.ndarray:
        return np.append(values[1:], values[0] + further)

    after = replace(
        motion,
        x=renumbered(motion.x, motion.period),
        v=renumbered(motion.v, motion.period_rate),
        stress=renumbered(motion.stress),
        edges=renumbered(motion.edges, motion.period),
        measures=renumbered(motion.measures),
    )
    accelerations, more = rng.uniform(-1, 1, 12), 0.7
    one = unbalanced(chain, motion, accelerations, more)
    other = unbalanced(replace(chain, masses=renumbered(chain.masses)), after, renumbered(accelerations, more), more)
    expected = renumbered(one, -more * consistent_mass(chain, motion)[0].sum())
    # a dozen products of numbers of order 1
    np.testing.assert_allclose(other, expected, rtol=0, atol=64 * np.finfo(float).eps)
    assert abs(other - renumbered(one)).max() > 0.5
