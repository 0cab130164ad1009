"""The semi-Lagrangian equations in motion: what each choice of the convective term keeps, and what all of them share."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import logm

from rkverify.errors import BadInput, UnknownName
from rkverify.solid.domain import polygon_domain
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.moving import Matter, Motion, forces, operator_now, step
from rkverify.solid.voronoi import voronoi

SIDE = 5
TIME = 0.4


def outline(side=SIDE):
    grid = np.arange(side * side).reshape(side, side)  # node numbers with x along the first axis
    return (np.concatenate([grid[:-1, 0], grid[-1, :-1], grid[:0:-1, -1], grid[0, :0:-1]]),)


def matter(made, integration, convection="true", law=None):
    law = law or Truesdell(made.body().law.moduli)
    masses = 1.3 * made.cells.measures
    return Matter(
        made.cloud, law, masses, integration, convection, outline=outline() if integration == "scni" else None
    )


def still(made, m, v=None):
    x = made.positions
    v = np.zeros_like(x) if v is None else v
    return Motion(x, v, m.law.start(len(x), 2), made.cells.measures.copy())


def run(m, motion, dt, steps):
    accounts = []
    for n in range(steps):
        motion, account = step(m, motion, dt, n == 0)
        accounts.append(account)
    return motion, accounts


@pytest.mark.parametrize("integration", ["scni", "dni", "snni"])
def test_a_homogeneous_motion_has_its_gradient_and_its_stress(block, integration):
    """x = F X in one step for stretch and shear: L is uniform, and so is the stress, to rounding; quadratic motion is the twin."""
    made = block(side=SIDE)
    m = matter(made, integration)
    operator = operator_now(m, still(made, m))
    G = np.array([[0.2, 0.1], [-0.3, 0.1]])
    assert abs(operator.apply(made.positions @ G.T) - G).max() <= 1e-12
    curved = made.positions**2
    exact = 2 * made.positions[:, :, None] * np.eye(2)
    assert abs(operator.apply(curved) - exact).max() > 1e-3


@pytest.mark.decides("C11")
@pytest.mark.parametrize("integration", ["scni", "dni", "snni"])
def test_momentum_needs_the_true_rate(block, integration):
    """d/dt sum m_I v_I = sum_I (m_I' v_I - (N v)_I) is zero for the true rate alone; half a step of delay leaves the first order in dt.

    With half the step its drift is half as large; without N, and with Psi*, the drift stays: it belongs to the equations.
    """
    made = block(side=SIDE)
    v = 0.3 * np.sin(3 * made.positions[:, ::-1])

    def drift(convection, dt):
        m = matter(made, integration, convection)
        accounts = run(m, still(made, m, v), dt, round(TIME / dt))[1]
        return abs(accounts[-1].momentum - accounts[0].momentum).max()

    coarse, fine = drift("true", 0.01), drift("true", 0.005)
    assert 1.6 < coarse / fine < 2.6
    for other in ("none", "psi-star"):
        assert drift(other, 0.005) > 5 * fine
        assert 0.8 < drift(other, 0.01) / drift(other, 0.005) < 1.25


@pytest.mark.parametrize("convection", ["none", "true", "psi-star"])
def test_galilean_invariance_holds_without_psi_star_alone(block, convection):
    """A velocity added to all nodes adds nothing to the force where sum_J Psi_J' = 0; Psi* does not add up to zero."""
    made = block(side=SIDE)
    m = matter(made, "dni", convection)
    v = 0.3 * np.sin(3 * made.positions[:, ::-1])
    own, moved = (forces(m, still(made, m, v + shift)).convective for shift in (0.0, np.array([5.0, -2.0])))
    assert (abs(moved - own).max() <= 1e-12) == (convection != "psi-star")


@pytest.mark.decides("C70")
@pytest.mark.parametrize("integration", ["scni", "dni", "snni"])
def test_both_formulations_agree_in_the_first_step_from_rest(block, integration):
    """From rest, under a small uniform stress, forces and masses of both formulations are the same numbers: x is X.

    On the same cells: the outline through the nodes has corners where the square has none, and the edge rule sees them.
    """
    made = block(side=SIDE)
    made.cells = voronoi(made.positions, polygon_domain([made.positions[outline()[0]]]))
    m = matter(made, integration)
    stress = np.array([[0.2, 0.05, 0], [0.05, -0.1, 0], [0, 0, 0.1]])
    motion = replace(still(made, m), state=m.law.start(len(made.positions), 2, stress))
    now = forces(m, motion)
    b = made.body(integration)
    P = np.tile(stress[:2, :2], (len(made.positions), 1, 1))
    assert abs(now.internal - b.internal_force(P)).max() <= 1e-14
    assert abs(now.mass - b.lumped_mass()).max() <= 1e-14
    assert not now.convective.any()


@pytest.mark.parametrize("law", [Truesdell, Jaumann])
def test_a_turning_body_stays_without_stress(block, law):
    """Objective updates: nodes turned rigidly step by step strain nothing, whatever the angle of a step."""
    made = block(side=SIDE)
    moduli = made.body().law.moduli
    m = matter(made, "scni", "none", law(moduli))
    state, x = m.law.start(len(made.positions), 2), made.positions
    c, s = np.cos(0.6), np.sin(0.6)
    turn = np.array([[c, -s], [s, c]])
    for _ in range(5):
        H = np.eye(2) + operator_now(m, replace(still(made, m), x=x)).apply(x @ turn.T - x)
        state, x = m.law.advance(H @ state.F, state), x @ turn.T
    assert abs(state.sigma).max() <= 1e-12


def test_measures_without_cells_grow_with_the_volume(block):
    """a' = a tr L: over small steps of a homogeneous stretch, the measures grow by det F to rounding."""
    made = block(side=SIDE)
    m = matter(made, "snni")
    motion = still(made, m, made.positions @ np.array([[0.5, 0.0], [0.0, 0.0]]))
    moved, _ = step(m, replace(motion), 0.1, first=True)
    assert abs(moved.measures / motion.measures - 1.05).max() <= 1e-12


def test_unknown_choices_are_refused(block):
    made = block(side=SIDE)
    m = matter(made, "dni")
    with pytest.raises(UnknownName, match="convection"):
        replace(m, convection="some")
    with pytest.raises(BadInput, match="outline"):
        replace(m, integration="scni")


@pytest.mark.parametrize("integration", ["scni", "dni", "snni"])
def test_the_work_of_a_step_is_stress_times_the_logarithm_of_its_stretch(block, integration):
    """sum_L a_L (sigma + sigma')/2 : log H_L but for third powers of H - 1; its squares, which the stretch has, are seen."""
    made = block(side=SIDE)
    m = matter(made, integration, "none")
    stress = np.array([[0.2, 0.05, 0], [0.05, -0.1, 0], [0, 0, 0.1]])
    v = 0.3 * np.sin(3 * made.positions[:, ::-1]) + made.positions * [0.9, 0.2]
    start = replace(still(made, m, v), state=m.law.start(len(made.positions), 2, stress), worked=0.7)
    dt, operator = 0.01, operator_now(m, start)
    moved, _ = step(m, start, dt, first=True)
    H = np.eye(2) + operator.apply(dt * moved.v)
    mean = (start.state.cauchy + moved.state.cauchy) / 2
    work = sum(a * (s * logm(h)).sum() for a, s, h in zip(operator.measures, mean, H, strict=True))
    allowed = operator.measures.sum() * abs(mean).max() * 4 * abs(H - np.eye(2)).max() ** 3
    assert abs(moved.worked - 0.7 - work) <= allowed
    assert abs(work) > 20 * allowed
    early = sum(a * (s * (h - np.eye(2))).sum() for a, s, h in zip(operator.measures, mean, H, strict=True))
    assert abs(early - work) > 2 * allowed  # the twin: H - 1, the strain as seen from the step's beginning
    assert abs(moved.x - start.x - dt * moved.v).max() <= 1e-15
    assert moved.time == dt
    assert abs(moved.measures - start.measures * np.linalg.det(H)).max() <= 1e-15


def test_velocities_in_an_account_are_those_of_its_time(block):
    """At the first step the given ones, later the mean of half a step before and after: momentum is sum m v of these.

    F becomes H F, in that order.
    """
    made = block(side=SIDE)
    m = matter(made, "dni", "none")
    v = 0.3 * np.sin(3 * made.positions[:, ::-1])
    stress = np.array([[0.2, 0.05, 0], [0.05, -0.1, 0], [0, 0, 0.1]])
    start = replace(still(made, m, v), state=m.law.start(len(v), 2, stress))
    now = forces(m, start)
    assert abs(now.acceleration()).max() > 0.1
    one, entry = step(m, start, 0.01, first=True)
    assert abs(entry.momentum - now.mass @ v).max() <= 1e-15
    assert abs(one.v - v - 0.005 * now.acceleration()).max() <= 1e-15
    later = forces(m, one)
    two, entry = step(m, one, 0.01)
    assert abs(entry.momentum - later.mass @ (one.v + two.v) / 2).max() <= 1e-15
    assert abs(two.v - one.v - 0.01 * later.acceleration()).max() <= 1e-15
    assert entry.time == 0.01
    assert entry.stored == one.worked
    H = np.eye(2) + operator_now(m, one).apply(0.01 * two.v)
    assert abs(two.state.F - H @ one.state.F).max() <= 1e-15
    assert abs(two.state.F - one.state.F @ H).max() > 1e-6
