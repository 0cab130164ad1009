"""Patch tests: bodies that must hold a polynomial displacement given on their boundary, or a homogeneous motion."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.certify.mechanics.specimens import Specimen
from rkverify.errors import RkverifyError
from rkverify.readings import NodalIntegration
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import Cloud
from rkverify.solid.domain import polygon_domain
from rkverify.solid.gradients import GradientOperator, dni, scni, snni
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.law import Law
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.at_nodes import AtNodes, equilibrium_with_nodes
from rkverify.solid.mechanics.body import Body, body
from rkverify.solid.mechanics.boundary import boundary
from rkverify.solid.mechanics.nitsche import nitsche
from rkverify.solid.mechanics.statics import Problem, equilibrium, equilibrium_in_steps, scaled
from rkverify.solid.voronoi import voronoi

Row = dict[str, Any]
MODULI = Moduli(1.5, 1.0)
LARGE = np.array([[2.0, 0.5], [0.0, 1.0]])
"""A stretch of 2 with a shear of 1/2."""
SMALL = np.array([[0.02, 0.03], [-0.01, -0.02]])
LOAD_STEPS = 10


@dataclass(frozen=True)
class Polynomial:
    """A displacement field u(X) (n, 2) and the body force that linear elasticity needs to hold it."""

    name: str
    u: Callable[[Array], Array]
    force: Array


def polynomials() -> list[Polynomial]:
    """Constant, linear and quadratic fields. div sigma = (lambda + mu) grad div u + mu lap u of the quadratic one is uniform."""
    shift = np.array([0.3, -0.2])
    bend = np.array([[0.02, 0.03, -0.01], [0.01, -0.02, 0.03]])  # u = bend (x^2, x y, y^2)

    def quadratic(X: Array) -> Array:
        return np.stack([X[:, 0] ** 2, X[:, 0] * X[:, 1], X[:, 1] ** 2], axis=1) @ bend.T

    laplacian = 2 * (bend[:, 0] + bend[:, 2])
    grad_div = np.array([2 * bend[0, 0] + bend[1, 1], bend[0, 1] + 2 * bend[1, 2]])
    force = -((MODULI.lame + MODULI.shear) * grad_div + MODULI.shear * laplacian)
    none = np.zeros(2)
    return [
        Polynomial("constant", lambda X: np.tile(shift, (len(X), 1)), none),
        Polynomial("linear", lambda X: X @ SMALL.T, none),
        Polynomial("quadratic", quadratic, force),
    ]


def _made(
    specimen: Specimen, integration: NodalIntegration, order: int, support_ratio: float, rule: str, law: Law
) -> Body:
    near = specimen.cloud(support_ratio, order)
    return body(near, specimen.operator(near, integration, rule), law)


def small(
    specimen: Specimen, integration: NodalIntegration, order: int, support_ratio: float, rule: str, condition: str
) -> list[Row]:
    """Linear elasticity with each polynomial on the boundary: the largest error of the field at the nodes over its largest value.

    condition: nitsche, or nodes (the values are held at boundary nodes alone).
    """
    found = []
    for field in polynomials():
        b = _made(specimen, integration, order, support_ratio, rule, LinearElastic(MODULI))
        X = specimen.positions
        load = b.body_force(np.tile(field.force, (len(X), 1)))
        if condition == "nitsche":
            edge = boundary(b.cloud, specimen.cells, rule)
            d = equilibrium(b, Problem((nitsche(b, edge, field.u(edge.points)),), load)).displacements
        else:
            held = specimen.on_boundary
            d = equilibrium_with_nodes(b, AtNodes(held, field.u(X[held])), load).displacements
        error = abs(b.values @ d - field.u(X)).max() / abs(field.u(X)).max()
        found.append(
            _row(
                specimen, "lagrangian", integration, rule, order, condition, field.name, "linear elastic", float(error)
            )
        )
    return found


def large(specimen: Specimen, integration: NodalIntegration, support_ratio: float, rule: str) -> list[Row]:
    """Hyperelastic bodies stretched to 2 and sheared by 1/2 by their boundary: the error of the coefficients over their largest.

    Infinite where no equilibrium was found on the way.
    """
    found = []
    G = LARGE - np.eye(2)
    for law in (NeoHookean(MODULI), SaintVenantKirchhoff(MODULI)):
        b = _made(specimen, integration, 1, support_ratio, rule, law)
        edge = boundary(b.cloud, specimen.cells, rule)
        problem = Problem((nitsche(b, edge, edge.points @ G.T),), np.zeros_like(specimen.positions))
        exact = specimen.positions @ G.T
        try:
            steps = [scaled(problem, (n + 1) / LOAD_STEPS) for n in range(LOAD_STEPS)]
            d = equilibrium_in_steps(b, steps).displacements
            error = float(abs(b.values @ (d - exact)).max() / abs(exact).max())
        except RkverifyError:
            error = float("inf")
        name = "neo-Hookean" if isinstance(law, NeoHookean) else "St. Venant-Kirchhoff"
        found.append(_row(specimen, "lagrangian", integration, rule, 1, "nitsche", "stretch 2, shear 1/2", name, error))
    return found


def current(specimen: Specimen, integration: NodalIntegration, support_ratio: float, rule: str, steps: int = 10) -> Row:
    """The semi-Lagrangian body, its nodes moved along x = F(t) X to the large deformation in steps, cells rebuilt.

    The error: the largest force on a node that its uniform stress and the traction on its boundary leave together, over the largest
    that the traction alone has. The stress is that of the Truesdell law in as many steps, uniform to rounding.
    """
    law, X = Truesdell(MODULI), specimen.positions
    near = specimen.cloud(support_ratio)
    # Fixed supports, wide enough for the stretched body.
    near = near.at(X, near.supports * max(np.linalg.svd(LARGE, compute_uv=False)))
    state, before = law.start(len(X), 2), np.eye(2)
    for n in range(1, steps + 1):
        after = np.eye(2) + n / steps * (LARGE - np.eye(2))
        operator = _moved(specimen, near, before, integration, rule)[0]
        H = np.eye(2) + operator.apply(X @ (after - before).T)
        state, before = law.advance(H @ state.F, state), after
    operator, cloud, cells = _moved(specimen, near, before, integration, rule)
    stress = state.cauchy * operator.measures[:, None, None]
    force = sum((part.T @ stress[:, :, j] for j, part in enumerate(operator.parts)), 0 * X)
    edge = boundary(cloud, cells, rule)
    traction = edge.traction(edge.normals @ state.cauchy.mean(axis=0).T)
    error = float(abs(force - traction).max() / abs(traction).max())
    return _row(
        specimen, "semi-lagrangian", integration, rule, 1, "traction", "stretch 2, shear 1/2", "Truesdell", error
    )


def _moved(
    specimen: Specimen, near: Cloud, F: Array, integration: NodalIntegration, rule: str
) -> tuple[GradientOperator, Cloud, Cells]:
    """The operator on the cells of the nodes at F X in the domain F Omega."""
    x = specimen.positions @ F.T
    cloud = near.at(x)
    cells = voronoi(x, polygon_domain([ring @ F.T for ring in specimen.domain.rings]))
    if integration == "scni":
        return scni(cloud, cells, rule), cloud, cells
    return (dni if integration == "dni" else snni)(cloud, cells.measures), cloud, cells


def _row(
    specimen: Specimen, formulation: str, integration: str, rule: str, order: int, condition: str, field: str, law: str,
    error: float,
) -> Row:  # fmt: skip
    return {
        "domain": specimen.name,
        "nodes": specimen.kind,
        "count": len(specimen.positions),
        "formulation": formulation,
        "integration": integration,
        "rule": rule,
        "order": order,
        "condition": condition,
        "field": field,
        "law": law,
        "error": error,
    }


def errors(rows: Sequence[Row], **chosen: Any) -> list[float]:
    """The errors of the rows whose columns have the chosen values."""
    return [row["error"] for row in rows if all(row[name] == value for name, value in chosen.items())]
