"""Which stress stands in the vector of (22): force against the exact slope of the stored energy, for one order and the other."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, cast

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.dual import Dual, Duals
from rkverify.certify.plates import MODULI, RHO_0, K, Plate, homogeneous
from rkverify.paper.approximation import Vector
from rkverify.paper.constitutive import (
    Moduli,
    linear,
    linear_energy,
    saint_venant_kirchhoff,
    saint_venant_kirchhoff_energy,
)
from rkverify.paper.lagrangian_solid import STRESS_ORDERS, LagrangianSolid, StressOrder
from rkverify.paper.moment import Matrix
from rkverify.readings import INTEGRATIONS

Row = dict[str, Any]
HALF = Fraction(1, 2)
STATES: dict[str, Matrix] = {
    "uniaxial stretch": [[Fraction(3, 2), Fraction(0)], [Fraction(0), Fraction(1)]],
    "pure shear, F symmetric": [[Fraction(5, 4), HALF], [HALF, Fraction(5, 4)]],
    "simple shear": [[Fraction(1), HALF], [Fraction(0), Fraction(1)]],
}
LAWS: dict[str, tuple[Callable[..., Matrix], Callable[..., Scalar]]] = {
    "St. Venant-Kirchhoff": (saint_venant_kirchhoff, saint_venant_kirchhoff_energy),
    "linear elastic": (linear, linear_energy),
}


def solid(plate: Plate, law: str, integration: Any) -> LagrangianSolid:
    """The plate of one of the laws."""
    stress = LAWS[law][0]
    return LagrangianSolid(
        plate.gradients(integration), plate.measures, plate.shapes, RHO_0, lambda F: stress(F, MODULI, K), K
    )


def energy_slopes(body: LagrangianSolid, law: str, d: list[Vector]) -> list[Vector]:
    """The derivatives of sum_L W(F_L) A_L with respect to every coefficient d_iI, by duals."""
    D = Duals(K, 2 * len(d))
    gradients = [tuple({I: D.number(value) for I, value in axis.items()} for axis in cell) for cell in body.gradients]
    dual = LagrangianSolid(gradients, list(map(D.number, body.measures)), (), D.zero(), lambda F: F, D)
    moduli = Moduli(D.number(MODULI.lame), D.number(MODULI.shear))
    at = [tuple(D.variable(c, 2 * I + i) for i, c in enumerate(place)) for I, place in enumerate(d)]
    slopes = cast(Dual, dual.stored_energy(at, lambda F: LAWS[law][1](F, moduli, D))).partials
    return [slopes[2 * I : 2 * I + 2] for I in range(len(d))]


def states(plate: Plate) -> dict[str, list[Vector]]:
    """Coefficients of the homogeneous states and of a random one."""
    nodes = plate.A.nodes
    return {**{name: homogeneous(nodes, F) for name, F in STATES.items()}, "random": plate.vectors(1, Fraction(1, 5))}


def convention_rows(plate: Plate) -> list[Row]:
    """For every law, integration, state and order: the largest force and its largest distance from the energy's slope.

    moment: of the internal forces about the origin, at the deformed nodes; 0 for a stress that conserves angular momentum.
    """
    rows = []
    for law in LAWS:
        for integration in INTEGRATIONS:
            body = solid(plate, law, integration)
            for state, d in states(plate).items():
                slopes = energy_slopes(body, law, d)
                for order in STRESS_ORDERS:
                    found = forces(body, d, order)
                    row = _row(law, integration, state, order, found, slopes)
                    rows.append({**row, "moment": float(moment(plate.A.nodes, d, found))})
    return rows


def moment(nodes: Sequence[Vector], d: list[Vector], found: list[Vector]) -> Fraction:
    """sum_I x_1I f_2I - x_2I f_1I at x_I = X_I + d_I."""
    total = Fraction(0)
    for X, u, f in zip(nodes, d, found, strict=True):
        total += (X[0] + u[0]) * f[1] - (X[1] + u[1]) * f[0]
    return total


def forces(body: LagrangianSolid, d: list[Vector], order: StressOrder) -> list[Vector]:
    """(21) at every node."""
    return [body.internal_force(I, d, order) for I in range(len(d))]


def _row(law: str, integration: str, state: str, order: str, found: list[Vector], slopes: list[Vector]) -> Row:
    largest = max(abs(c) for slope in slopes for c in slope)
    gap = max(abs(p - q) for one, other in zip(found, slopes, strict=True) for p, q in zip(one, other, strict=True))
    return {
        "law": law,
        "integration": integration,
        "state": state,
        "order": order,
        "force": float(largest),
        "relative": float(gap / largest),
        "agrees": gap == 0,
    }
