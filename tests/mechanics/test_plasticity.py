"""Bodies with memory in equilibrium: what a material point does is what a homogeneous body does, and Newton needs the right tangent.

Decides that the state before a load step is kept at every cell, that it is the only thing kept, and that the return is differentiated.
"""

from itertools import pairwise

import numpy as np
import pytest

from rkverify.certify.mechanics import cyclic, holed_plate
from rkverify.certify.mechanics.patch import MODULI
from rkverify.certify.mechanics.specimens import square
from rkverify.solid.materials.j2 import J2, mises_stress
from rkverify.solid.materials.small_strain import SmallStrain
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.statics import equilibrium_in_steps

# Rounding of each of some ten steps, times the condition of the stiffness in plastic flow, some 1e4 (H is a twentieth of 3 mu).
STATES = 1e-11


@pytest.fixture(scope="module")
def jittered():
    return square("jittered", 4, 3)


@pytest.mark.parametrize(
    "elastic", [SmallStrain(MODULI), cyclic.LAW.elastic, Truesdell(MODULI)], ids=lambda e: type(e).__name__
)
@pytest.mark.parametrize("kind", ["tension", "shear"])
@pytest.mark.decides("C14")
def test_a_homogeneous_body_follows_the_material_point(jittered, elastic, kind):
    """Through a whole cycle, with flow in both directions; f = 0 where it flows."""
    law = J2(elastic, 0.02, 0.1)
    rows = cyclic.against_the_point(jittered, law, kind, 0.1, 8)
    assert max(row["stress_difference"] for row in rows) <= STATES
    assert max(row["plastic_difference"] for row in rows) <= STATES
    assert max(row["yield_function"] for row in rows) <= STATES
    assert max(row["off_the_surface"] for row in rows) <= STATES
    strains = [row["plastic_strain"] for row in rows]
    assert sum(b > a for a, b in pairwise([0.0, *strains])) >= 4
    assert abs(rows[-1]["stress"]) > 0.1 * 0.02


def test_the_twin_that_forgets_does_not(jittered):
    """The same body without the state of the steps before is off from the second step on by more than the yield stress."""
    path = cyclic.cycle("tension", 0.1, 8)
    plate = cyclic.homogeneous(jittered, cyclic.LAW)
    points = cyclic.material_point(cyclic.LAW, path)
    found = cyclic.follow(plate, path[1:2])[0]
    assert abs(found.body.state.sigma - points[1].sigma).max() > 1e-4
    backwards = cyclic.follow(plate, path[3:4])[0]
    assert abs(backwards.body.state.sigma - points[3].sigma).max() > cyclic.YIELD


def test_load_steps_hand_on_the_state(jittered):
    """`equilibrium_in_steps` ends where the point does after the whole path; in one step to the same place it does not."""
    path = cyclic.cycle("tension", 0.1, 8)[:5]
    plate = cyclic.homogeneous(jittered, cyclic.LAW)
    problems = [plate.led(plate.start, plate.held.points @ (F - np.eye(2)).T) for F in path]
    point = cyclic.material_point(cyclic.LAW, path)[-1]
    found = equilibrium_in_steps(plate.body, problems)
    assert abs(found.body.state.sigma - point.sigma).max() <= STATES
    # The way is 0.27 long, the straight one 0.07: less than half of the plastic strain, and of the hardening.
    alone = equilibrium_in_steps(plate.body, problems[-1:]).body.state
    assert alone.alpha.max() < point.alpha[0] / 2
    assert (
        abs(
            mises_stress(point.sigma) - mises_stress(alone.sigma) - cyclic.HARDENING * (point.alpha - alone.alpha)
        ).max()
        <= STATES
    )


@pytest.mark.decides("C14")
def test_unloading_leaves_what_the_yield_stress_allows(jittered):
    """The plastic body keeps a strain and no stress. Below yield it keeps none in small strain, and with Jaumann's rate what its steps are off.

    Back in other steps than those there, increments from the middle of a step leave the cube of the strain.
    """
    beyond = cyclic.residual_strain(jittered, cyclic.LAW, "tension", 0.1, 3)
    assert beyond["stays"] > 0.03
    assert beyond["difference"] <= STATES
    assert beyond["stress"] <= STATES
    within = cyclic.residual_strain(jittered, J2(SmallStrain(MODULI), 0.02, 0.1), "tension", 0.005, 3)
    assert within["loaded"] > 0.004
    assert within["difference"] <= STATES
    assert within["stays"] <= STATES
    assert STATES < cyclic.residual_strain(jittered, cyclic.LAW, "tension", 0.005, 3)["stays"] <= 0.005**3


def test_newton_doubles_its_digits_with_the_consistent_tangent_alone():
    """In a plate with a hole amid plastic flow. The elastic tangent gains less than a digit in each step."""
    plate = holed_plate.plate_with_hole(8, cyclic.LAW)
    found = holed_plate.pulled(plate, [0.005, 0.01])[-1][1]
    assert 0 < (found.body.state.alpha > 0).sum() < len(plate.body.cloud)
    rows = holed_plate.tangents_compared(plate, found, 0.015, 12)
    consistent, elastic = ([r["residual"] for r in rows if r["tangent"] == name] for name in ("consistent", "elastic"))
    # Once the flowing cells no longer change: r_(k+1) <= c r_k^2 with c the size of the second derivative over that of the stiffness.
    late = [(a, b) for a, b in pairwise(consistent) if a < 1e-4]
    assert late
    assert all(b <= 1e3 * a**2 + 1e-13 for a, b in late)
    assert consistent[-1] <= 1e-13
    assert all(b > 0.1 * a for a, b in pairwise(elastic[2:]))
    assert elastic[-1] > 1e-7


def test_the_closed_form_is_reached_with_the_square_of_the_step(jittered):
    """Stretch to 1.2 and back to 0.9, flow in both directions: a known state at large strain, and no exactness where none is."""
    errors = [cyclic.uniaxial(jittered, (1.2, 0.9), steps)["stress_error"] for steps in (4, 8)]
    assert 3.5 < errors[0] / errors[1] < 4.5
    assert errors[1] > 1e-6


def test_the_plate_has_its_area_and_its_force_balances():
    """Cells tile the square without its polygonal hole; what pulls the top pulls the bottom."""
    plate = holed_plate.plate_with_hole(8, cyclic.LAW)
    ring = plate.body.cloud.positions[np.isclose(np.linalg.norm(plate.body.cloud.positions, axis=1), 0.4, atol=1e-12)]
    hole = len(ring) / 2 * 0.4**2 * np.sin(2 * np.pi / len(ring))
    assert abs(plate.cells.measures.sum() - (4 - hole)) <= 1e-12
    force, found = holed_plate.pulled(plate, [0.004])[0]
    edge, P = plate.held, found.body.state.P
    low = edge.points[:, 1] < 0
    assert force > 0
    # The penalty of Nitsche's condition carries a share of the force; lattice and hole are symmetric, so that top and bottom have the same.
    assert abs((edge.weights[low] * P[edge.cells[low], 1, 1]).sum() / MODULI.shear / 2 - force) <= 1e-11
