"""What the Lagrangian equations (18)-(21) must satisfy in the plane: (7), energies, totals, in rationals.

Rows have a number that is 0 where the check is passed (`apart`), rounded, the size of what is compared, and whether it is 0 exactly.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.dual import Duals
from rkverify.certify.index_convention import energy_slopes, forces, solid
from rkverify.certify.plates import RHO_0, K, Plate
from rkverify.paper.approximation import Vector
from rkverify.paper.kernel_rates import dot
from rkverify.paper.lagrangian_solid import STRESS_ORDERS, LagrangianSolid, Load, StressOrder, carried
from rkverify.paper.moment import Matrix
from rkverify.paper.shape import Values
from rkverify.paper.smoothing import displacement_gradient
from rkverify.paper.weak_forms import Inside, OnBoundary, lagrangian_weak_form

Row = dict[str, Any]
ZERO = Fraction(0)
LAW = "St. Venant-Kirchhoff"


def row(equation: str, check: str, apart: Fraction, size: Fraction) -> Row:
    """A line of the tables of balances."""
    return {"equation": equation, "check": check, "apart": float(apart), "size": float(abs(size)), "exact": apart == 0}


def largest(values: Sequence[Fraction]) -> Fraction:
    """The largest absolute value."""
    return max(map(abs, values), default=ZERO)


def gap(one: Sequence[Vector], other: Sequence[Vector]) -> Fraction:
    """The largest difference of two lists of vectors."""
    return largest([p - q for u, w in zip(one, other, strict=True) for p, q in zip(u, w, strict=True)])


def work(forces: Sequence[Vector], delta: Sequence[Vector]) -> Fraction:
    """sum_I f_I . delta d_I."""
    return sum((dot(f, w) for f, w in zip(forces, delta, strict=True)), ZERO)


def at(Psi: Values, vectors: Sequence[Vector]) -> Vector:
    """The field sum_I Psi_I v_I at the point whose shape functions are given."""
    return tuple(sum((value * vectors[I][i] for I, value in Psi.items()), ZERO) for i in range(len(vectors[0])))


def boundary_of(tractions: Sequence[Load], delta: Sequence[Vector]) -> list[OnBoundary]:
    """The loads as points of a weak form."""
    return [OnBoundary(weight, at(Psi, delta), h) for Psi, h, weight in tractions]


def slope_of(b: tuple[Values, ...], vectors: Sequence[Vector]) -> Matrix:
    """The nodal gradient of a field."""
    return displacement_gradient(b, vectors, K)


def kinetic_slopes(masses: Sequence[Fraction], shapes: Sequence[Values], v: Sequence[Vector]) -> list[Vector]:
    """The derivatives of sum_L m_L |v^h(x_L)|^2/2 with respect to the coefficients, by duals."""
    D = Duals(K, 2 * len(v))
    energy = D.zero()
    moving = [tuple(D.variable(c, 2 * I + i) for i, c in enumerate(w)) for I, w in enumerate(v)]
    for m, Psi in zip(masses, shapes, strict=True):
        for i in range(2):
            component = sum((value * moving[I][i] for I, value in Psi.items()), D.zero())
            energy = energy + component * component * (m / 2)
    return [energy.partials[2 * I : 2 * I + 2] for I in range(len(v))]


def mass_checks(equation: str, rows: Sequence[Values], masses: Sequence[Fraction], shapes: Sequence[Values], v: Sequence[Vector]) -> list[Row]:  # fmt: skip
    """Symmetry, total and kinetic energy of a mass matrix: rows M_I, masses m_L of the cells."""
    skewed = [rows[I].get(J, ZERO) - rows[J].get(I, ZERO) for I in range(len(rows)) for J in rows[I]]
    total = sum((sum(line.values(), ZERO) for line in rows), ZERO)
    momenta, slopes = [carried(line, v, K) for line in rows], kinetic_slopes(masses, shapes, v)
    return [
        row(equation, "M_IJ - M_JI", largest(skewed), largest([*rows[0].values()])),
        row(equation, "sum of M_IJ less the mass", total - sum(masses, ZERO), total),
        row(equation, "M v less the slope of the kinetic energy", gap(momenta, slopes), largest([*momenta[0]])),
    ]


def load_checks(equation: str, plate: Plate, found: Sequence[Vector], tractions: Sequence[Load], body: Sequence[Vector]) -> list[Row]:  # fmt: skip
    """The total of nodal forces, and their work in u = X, against the loads': both exact for a basis of order 1."""
    zero = (ZERO, ZERO)
    applied = [[weight * c for c in h] for _, h, weight in tractions]
    applied += [[A * c for c in b] for b, A in zip(body, plate.measures, strict=True)]
    places = [*plate.domain.corners, *plate.A.nodes]
    total = gap([tuple(sum(c) for c in zip(*found, strict=True))], [tuple(sum(c) for c in zip(*applied, strict=True))])
    moved = work(found, plate.A.nodes) - sum((dot(tuple(f), X) for f, X in zip(applied, places, strict=True)), ZERO)
    return [
        row(equation, "total force less the applied load", total, largest(found[0] or zero)),
        row(equation, "work of the forces in u = X less that of the loads", moved, work(found, plate.A.nodes)),
    ]


def weak_form_work(body: LagrangianSolid, d: list[Vector], delta: list[Vector], accelerations: list[Vector], loads: list[Load], b0: list[Vector]) -> Fraction:  # fmt: skip
    """(7) at the nodes with (8) for delta u and u''."""
    inside = []
    for L, Psi in enumerate(body.shapes):
        P = body.nominal(body.deformation_gradient(L, d))
        slope = slope_of(body.gradients[L], delta)
        inside.append(Inside(body.measures[L], at(Psi, delta), slope, body.rho_0, at(Psi, accelerations), P, b0[L]))
    left: Fraction = lagrangian_weak_form(inside, boundary_of(loads, delta), K)
    return left


def residual_row(plate: Plate, body: LagrangianSolid, order: StressOrder) -> Row:
    """delta d . (18) against (7), integrated at the nodes, for random coefficients."""
    d, delta, accelerations, b0 = (plate.vectors(salt, Fraction(1, 5)) for salt in (1, 2, 3, 4))
    loads = plate.tractions(5)
    residuals = []
    for I in range(len(d)):
        external = body.external_force(I, loads, b0)
        residuals.append(body.residual(I, d, accelerations, external, order))
    whole = weak_form_work(body, d, delta, accelerations, loads, b0)
    return row("(18)", f"work of the residual less (7), {order} in (22)", work(residuals, delta) - whole, whole)


def lagrangian_rows(plate: Plate) -> list[Row]:
    """(18)-(21) for St. Venant-Kirchhoff with smoothed gradients and random coefficients."""
    body = solid(plate, LAW, "scni")
    d, v, b0 = (plate.vectors(salt, Fraction(1, 5)) for salt in (1, 6, 4))
    loads, nodes = plate.tractions(5), range(len(d))
    masses = [RHO_0 * A for A in plate.measures]
    external = [body.external_force(I, loads, b0) for I in nodes]
    internal, slopes = forces(body, d, "first"), energy_slopes(body, LAW, d)
    return [
        *(residual_row(plate, body, order) for order in STRESS_ORDERS),
        *mass_checks("(19)", [body.mass(I) for I in nodes], masses, plate.shapes, v),
        *load_checks("(20)", plate, external, loads, b0),
        row("(21)", "f_int less the slope of the stored energy", gap(internal, slopes), largest(internal[0])),
    ]
