"""Equilibrium: what Nitsche's condition adds is consistent, and the patch test is passed to rounding or not at all.

A patch test decides, because a method that cannot hold a homogeneous deformation converges to something else.
"""

import numpy as np
import pytest

from rkverify.errors import BadInput, NotConverged
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.mechanics.at_nodes import AtNodes, equilibrium_with_nodes
from rkverify.solid.mechanics.boundary import boundary
from rkverify.solid.mechanics.nitsche import nitsche
from rkverify.solid.mechanics.statics import Problem, equilibrium, equilibrium_in_steps, residual, scaled, tangent
from rkverify.solid.mechanics.vectors import flat, nodal

STEP = 1e-100


def conditions(made, b, G, rule="trapezoid", **options):
    edge = boundary(made.cloud, made.cells, rule)
    return Problem((nitsche(b, edge, edge.points @ np.transpose(G), **options),), np.zeros_like(made.positions))


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("dimension", [2, 3])
def test_the_tangent_is_the_derivative_of_the_residual(block, dimension, symmetric):
    """All terms, the third derivative of the energy included, by a complex step: else Newton would not double its digits."""
    made = block(dimension, 5 if dimension == 2 else 3)
    b = made.body()
    problem = conditions(made, b, 0.1 * np.eye(dimension), symmetric=symmetric)
    d, w = made.small(), made.small(1.0)

    def force(u):
        F = b.deformation(u)
        P, moduli = b.law.stress(F), b.law.tangent(F)
        return sum((c.force(b, u, P, moduli) for c in problem.conditions), b.internal_force(P))

    derivative = np.imag(force(d + 1j * STEP * w)) / STEP
    found = nodal(tangent(b, problem, d) @ flat(w), dimension)
    assert abs(found - derivative).max() <= 1e-11 * abs(derivative).max()
    if symmetric:
        without = nodal(tangent(b, problem, d, bent=False) @ flat(w), dimension)
        assert abs(without - derivative).max() > 1e-4 * abs(derivative).max()


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("rule", ["trapezoid", "midpoint", "gauss:2"])
@pytest.mark.decides("C17", "C19")
def test_scni_holds_homogeneous_deformations(block, rule, dimension):
    """Linear elasticity and a stretch of 2 with shear 1/2: coefficients are F X to rounding times the condition of K, some 1e3."""
    made = block(dimension, 5 if dimension == 2 else 3)
    F = np.eye(dimension)
    F[0, :2] = 2.0, 0.5
    for law, G, steps in (
        (LinearElastic(made.body().law.moduli), 0.1 * F, 1),
        (NeoHookean(made.body().law.moduli), F - np.eye(dimension), 8),
    ):
        b = made.body(law=law, rule=rule)
        problem = conditions(made, b, G, rule)
        found = equilibrium_in_steps(b, [scaled(problem, (n + 1) / steps) for n in range(steps)])
        assert abs(found.displacements - made.positions @ G.T).max() <= 1e-12


@pytest.mark.decides("C17")
def test_the_twins_that_do_not_hold_them(block):
    """DNI and SNNI break the integration constraint, a mismatched rule breaks its balance, nodes are not the boundary."""
    made = block()
    law = LinearElastic(made.body().law.moduli)
    G = np.array([[0.1, 0.05], [0.0, -0.1]])
    exact = made.positions @ G.T

    def error(b, rule):
        found = equilibrium(b, conditions(made, b, G, rule))
        return abs(found.displacements - exact).max() / abs(exact).max()

    assert error(made.body("dni", law), "trapezoid") > 1e-3
    assert error(made.body("snni", law), "trapezoid") > 1e-3
    assert error(made.body("scni", law, "midpoint"), "trapezoid") > 1e-6
    outer = np.flatnonzero(((made.positions == 0) | (made.positions == 1)).any(axis=1))
    b = made.body("scni", law)
    found = equilibrium_with_nodes(b, AtNodes(outer, exact[outer]), np.zeros_like(exact))
    assert abs(b.values[outer] @ found.displacements - exact[outer]).max() <= 1e-13
    assert abs(found.displacements - exact).max() > 1e-4


def test_newton_doubles_its_digits(block):
    """From the first iterates near the solution the residual falls with its square: a tangent that is not the derivative fails here."""
    made = block()
    b = made.body()
    load = 0.02 * np.tile([0.3, -1.0], (len(made.positions), 1)) * (made.positions[:, :1] > 0.9)
    edge = boundary(made.cloud, made.cells, where=lambda x: x[:, 0] < 1e-9)
    problem = Problem((nitsche(b, edge, np.zeros_like(edge.points)),), load)
    r = equilibrium(b, problem).residuals
    falling = [k for k in range(1, len(r) - 1) if 1e-9 < r[k] < 1e-2 * r[0]]
    assert falling
    assert all(r[k + 1] <= 1e3 * r[k] ** 2 / r[0] + 1e-15 for k in falling)


def test_what_has_no_equilibrium_says_so(block):
    made = block()
    b = made.body()
    with pytest.raises(BadInput, match="factor 1"):
        conditions(made, b, np.eye(2), factor=1.0)
    with pytest.raises(BadInput, match="no facet"):
        boundary(made.cloud, made.cells, where=lambda x: x[:, 0] > 5)
    edge = boundary(made.cloud, made.cells, where=lambda x: x[:, 0] < 1e-9)
    torn = Problem((nitsche(b, edge, np.zeros_like(edge.points)),), 50.0 * (made.positions - [0, 0.5]))
    with pytest.raises((NotConverged, BadInput)):
        equilibrium(b, torn)
    force, size = residual(b, torn, np.zeros_like(made.positions))
    assert (abs(force) <= size).all()


@pytest.mark.parametrize("unit", [1e-9, 1e9])
def test_other_units_of_stress_have_the_same_equilibrium(block, unit):
    """Rounding is that of the forces: in pascals or in gigapascals Newton ends after the same steps at the same displacements."""
    made, moduli = block(), block().body().law.moduli
    outer = np.flatnonzero(((made.positions == 0) | (made.positions == 1)).any(axis=1))
    given = made.positions[outer] @ np.array([[0.1, 0.0], [0.05, -0.1]]) + 0.05 * made.positions[outer] ** 2
    found = []
    for size in (1.0, unit):
        b = made.body(law=NeoHookean(Moduli(size * moduli.lame, size * moduli.shear)))
        load = size * 0.01 * np.tile([0.3, -1.0], (len(made.positions), 1))
        edge = boundary(made.cloud, made.cells, where=lambda x: x[:, 0] < 1e-9)
        problem = Problem((nitsche(b, edge, np.zeros_like(edge.points)),), load)
        found.append((equilibrium_with_nodes(b, AtNodes(outer, given), load), equilibrium(b, problem)))
    for one, other in zip(*found, strict=True):
        assert abs(one.displacements - other.displacements).max() <= 1e-12
        assert len(one.residuals) == len(other.residuals)


def test_a_small_load_moves_a_body_as_its_linear_stiffness_says(block):
    """K d = f in the limit: a load that is not scaled, of the wrong sign, or a Newton iteration that ends early is none of it."""
    made = block()
    b = made.body()
    load = 0.02 * np.tile([0.3, -1.0], (len(made.positions), 1)) * (made.positions[:, :1] > 0.9)
    edge = boundary(made.cloud, made.cells, where=lambda x: x[:, 0] < 1e-9)
    problem = Problem((nitsche(b, edge, np.zeros_like(edge.points)),), load)
    K = tangent(b, problem, np.zeros_like(load)).toarray()
    linear = nodal(np.linalg.solve(K, flat(load)), 2)
    share = 1e-3
    small, whole = equilibrium(b, scaled(problem, share)), equilibrium(b, problem)
    # the second order is a share of the strains, some tenths at the whole load
    assert abs(small.displacements / share - linear).max() <= share * abs(linear).max()
    assert abs(whole.displacements - linear).max() > share * abs(linear).max()
    for found in (small, whole):  # forces of size 1, of some ten terms
        assert found.residuals[-1] <= 1e-14


@pytest.mark.parametrize("factor", [2.0, 4.0])
def test_the_penalty_is_the_stiffness_of_a_cell_over_its_depth(block, factor):
    """beta_q = gamma |dP/dF| |Gamma_L|/A_L, with 2 (lambda + mu) for |dP/dF| at rest in the plane: a stress over a length."""
    made = block()
    b = made.body()
    edge = boundary(made.cloud, made.cells)
    outer = made.cells.sides[:, 1] < 0
    lengths = np.zeros(len(made.positions))
    np.add.at(lengths, made.cells.sides[outer, 0], np.linalg.norm(made.cells.areas[outer], axis=1))
    assert abs(lengths.sum() - 4) <= 1e-14
    moduli = b.law.moduli
    expected = factor * 2 * (moduli.lame + moduli.shear) * (lengths / made.cells.measures)[edge.cells]
    found = nitsche(b, edge, np.zeros_like(edge.points), factor=factor).penalties
    np.testing.assert_allclose(found, expected, rtol=1e-13, atol=0)
