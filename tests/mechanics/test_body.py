"""The force is the derivative of the energy and the tangent that of the force: nothing else makes a solid conservative.

Complex steps leave no truncation error, so that only the rounding of sums of some hundred products remains: 1e-12 of the largest.
"""

import numpy as np
import pytest

from rkverify.errors import BadInput
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.mechanics.body import body
from rkverify.solid.mechanics.vectors import flat, nodal

STEP = 1e-100
ROUNDING = 1e-12


def along(function, at, direction):
    """The derivative of function at `at` along a direction, by a complex step."""
    return np.imag(function(at + 1j * STEP * direction)) / STEP


def energy(b, d):
    return b.law.energy(b.deformation(d)) @ b.operator.measures


@pytest.mark.decides("E21", "E18")
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("integration", ["scni", "dni", "snni"])
def test_the_internal_force_is_the_derivative_of_the_energy(block, integration, dimension):
    made = block(dimension, 5 if dimension == 2 else 3)
    b, d, w = made.body(integration), made.small(), made.small(1.0)
    force = b.internal_force(b.law.stress(b.deformation(d)))
    derivative = along(lambda u: energy(b, u), d, w)
    assert abs((force * w).sum() - derivative) <= ROUNDING * abs(force * w).sum()


def test_the_twin_a_transposed_stress_has_no_energy(block):
    """P and P^T differ where F is no symmetric stretch, and then only one of them is the energy's."""
    made = block()
    b, d, w = made.body(), made.small(), made.small(1.0)
    d = d + made.positions @ np.array([[0.0, 0.0], [0.4, 0.0]])
    wrong = b.internal_force(np.swapaxes(b.law.stress(b.deformation(d)), 1, 2))
    derivative = along(lambda u: energy(b, u), d, w)
    assert abs((wrong * w).sum() - derivative) > 1e-3 * abs(derivative)


@pytest.mark.parametrize("law", [SaintVenantKirchhoff, LinearElastic])
@pytest.mark.parametrize("dimension", [2, 3])
def test_the_stiffness_is_the_derivative_of_the_force(block, dimension, law, moduli):
    made = block(dimension, 5 if dimension == 2 else 3)
    b, d, w = made.body(law=law(moduli)), made.small(), made.small(1.0)
    A = b.operator.measures[:, None, None, None, None]
    K = b.stiffness(b.law.tangent(b.deformation(d)) * A)
    derivative = along(lambda u: b.internal_force(b.law.stress(b.deformation(u))), d, w)
    assert abs(nodal(K @ flat(w), dimension) - derivative).max() <= ROUNDING * abs(derivative).max()
    assert abs((K - K.T).toarray()).max() <= ROUNDING * abs(K.toarray()).max()


@pytest.mark.decides("E19", "E42")
def test_the_mass_is_symmetric_positive_and_whole(block):
    """(19) is a Gram matrix: x^T M x = sum_L rho A_L (sum_I Psi_I x_I)^2; row sums add up to rho times the area, as Psi does to 1."""
    made = block()
    b = made.body()
    M = b.mass().toarray()
    assert abs(M - M.T).max() == 0 or abs(M - M.T).max() <= 2**-52 * abs(M).max()
    assert np.linalg.eigvalsh(M).min() > -ROUNDING * abs(M).max()
    assert abs(M.sum() - 1.3) <= 1e-13
    assert abs(M.sum(axis=1) - b.lumped_mass()).max() <= 1e-14


@pytest.mark.decides("E20", "E44")
def test_a_uniform_body_force_adds_up(block):
    """sum_I f_ext_I = b times the area, as shape functions have sum 1."""
    made = block()
    b = made.body()
    load = b.body_force(np.tile([2.0, -3.0], (len(b.operator.measures), 1)))
    assert abs(load.sum(axis=0) - [2.0, -3.0]).max() <= 1e-13


def test_a_body_force_does_the_work_of_the_field(block):
    """sum_I f_ext_I . d_I = sum_L A_L b(X_L) . u^h(X_L) with u^h = sum_I Psi_I d_I: totals do not tell which node is loaded."""
    made = block()
    made_body, d = made.body(), made.small(1.0)
    b = made.small(3.0)
    work = (made_body.operator.measures[:, None] * b * (made_body.values @ d)).sum()
    assert abs((made_body.body_force(b) * d).sum() - work) <= ROUNDING * abs(b * d).sum()
    assert abs((made_body.operator.measures[:, None] * b * d).sum() - work) > 1e-3 * abs(work)


def test_rigid_motions_leave_a_body_without_force(block):
    """Objective energy: a rotation by any angle with any shift; linear elasticity is the twin that turns it into force."""
    made = block()
    c, s = np.cos(0.7), np.sin(0.7)
    d = made.positions @ (np.array([[c, -s], [s, c]]) - np.eye(2)).T + [0.3, -0.2]
    b = made.body()
    scale = abs(b.law.tangent(np.eye(2)[None])).max()
    assert abs(b.internal_force(b.law.stress(b.deformation(d)))).max() <= 1e-13 * scale
    linear = made.body(law=LinearElastic(b.law.moduli))
    assert abs(linear.internal_force(linear.law.stress(linear.deformation(d)))).max() > 1e-3 * scale


@pytest.mark.decides("C17")
@pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:3"])
def test_a_uniform_stress_pulls_only_at_the_boundary(block, rule):
    """The integration constraint: interior nodes feel nothing of a uniform stress under SCNI, whatever the nodes and the rule.

    The twin: under DNI and SNNI they do.
    """
    made = block(side=9)
    inner = ((made.positions > 0.35) & (made.positions < 0.65)).all(axis=1)
    stress = np.tile([[1.0, 0.3], [0.3, -2.0]], (len(made.positions), 1, 1))
    force = made.body(rule=rule).internal_force(stress)
    assert abs(force[inner]).max() <= 1e-15
    for other in ("dni", "snni"):
        assert abs(made.body(other).internal_force(stress)[inner]).max() > 1e-4


def test_bad_bodies_are_refused(block, moduli):
    made = block()
    with pytest.raises(BadInput, match="density -1"):
        body(made.cloud, made.operator(), LinearElastic(moduli), -1.0)
