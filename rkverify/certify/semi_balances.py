"""What the semi-Lagrangian equations (41)-(46) must satisfy in the plane: (37), power, totals, frames, in rationals."""

from collections.abc import Sequence
from fractions import Fraction
from math import hypot
from typing import Any

from rkverify.arithmetic.dual import Duals
from rkverify.certify.plates import K, Plate
from rkverify.certify.solid_balances import (
    ZERO,
    at,
    boundary_of,
    gap,
    largest,
    load_checks,
    mass_checks,
    row,
    slope_of,
    work,
)
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.constitutive import contraction, product, transpose
from rkverify.paper.kernel_rates import phi
from rkverify.paper.lagrangian_solid import carried, plus
from rkverify.paper.material_rates import acceleration
from rkverify.paper.moment import Matrix
from rkverify.paper.semi_lagrangian_solid import SemiLagrangianSolid, rates_at_nodes
from rkverify.paper.shape import Values, shape_functions
from rkverify.paper.smoothing import over_the_boundary
from rkverify.paper.weak_forms import Inside, updated_weak_form
from rkverify.readings import Integration

Row = dict[str, Any]
TURN: Matrix = [[Fraction(3, 5), Fraction(-4, 5)], [Fraction(4, 5), Fraction(3, 5)]]
FRAME: Vector = (Fraction(3, 4), Fraction(-2, 3))
CONVECTIONS = {"Psi*": False, "true rate": True}


def velocities(plate: Plate) -> list[Vector]:
    """Random velocities of the nodes."""
    return plate.vectors(6, Fraction(1, 2))


def densities(plate: Plate) -> list[Fraction]:
    """Random densities of the cells, between 1/2 and 3/2."""
    return [1 + v[0] for v in plate.vectors(7, Fraction(1, 2))]


def current(plate: Plate, true: bool, integration: Integration = "scni") -> SemiLagrangianSolid:
    """The plate as the current configuration, with random density, stress and velocity."""
    rates = rates_at_nodes(plate.A, velocities(plate), true)
    return SemiLagrangianSolid(
        plate.gradients(integration), plate.measures, plate.shapes, rates, densities(plate), plate.symmetric(8), K
    )


def moving(A: Approximation, v: Sequence[Vector]) -> Approximation:
    """The approximation on x_I + v_I t, as duals in t."""
    D = Duals(K, 1)
    places = [tuple(D.along(c, [w]) for c, w in zip(x, u, strict=True)) for x, u in zip(A.nodes, v, strict=True)]
    return Approximation(tuple(places), tuple(map(D.number, A.supports)), A.kernel, A.order, D, A.window)


def star_by_duals(plate: Plate, v: Sequence[Vector]) -> list[Values]:
    """Psi_J/phi_J times the time derivative of phi_J at the moving nodes: (40) without its own lines."""
    later = moving(plate.A, v)
    found = []
    for x, place, Psi in zip(plate.A.nodes, later.nodes, plate.shapes, strict=True):
        rates = {J: phi(later, place, J).partials[0] for J in Psi}
        found.append({J: Psi[J] / phi(plate.A, x, J) * rates[J] for J in Psi if phi(plate.A, x, J) != 0})
    return found


def _power_of_convection(plate: Plate, delta: Sequence[Vector]) -> Fraction:
    """sum_L rho a delta u . sum_J Psi*_J v_J with Psi* by duals."""
    v, total = velocities(plate), ZERO
    stars = star_by_duals(plate, v)
    for L, (rho, a) in enumerate(zip(densities(plate), plate.measures, strict=True)):
        carried_over = at(stars[L], v)
        here = at(plate.shapes[L], delta)
        total += rho * a * sum(p * q for p, q in zip(here, carried_over, strict=True))
    return total


def semi_lagrangian_rows(plate: Plate) -> list[Row]:
    """(41)-(46) with smoothed gradients, Psi* and random coefficients."""
    body, nodes = current(plate, False), range(len(plate.A.nodes))
    v, delta, b, dv = (velocities(plate), *(plate.vectors(salt, Fraction(1, 2)) for salt in (2, 4, 3)))
    loads = plate.tractions(5)
    masses = [rho * a for rho, a in zip(body.densities, body.measures, strict=True)]
    external, internal = [body.external_force(I, loads, b) for I in nodes], [body.internal_force(I) for I in nodes]
    convection = work([carried(body.convective(I), v, K) for I in nodes], delta)
    apart = convection - _power_of_convection(plate, delta)
    return [
        _derivation(plate, body, delta, dv, b),
        *mass_checks("(42)", [body.mass(I) for I in nodes], masses, plate.shapes, v),
        row("(43)", "delta d . N v less the power of Psi*_J v_J, by duals", apart, convection),
        *load_checks("(44)", plate, external, loads, b),
        *_stress_checks(plate, body, internal),
        _voigt(body),
    ]


def _derivation(plate: Plate, body: SemiLagrangianSolid, delta: list[Vector], dv: list[Vector], b: list[Vector]) -> Row:
    """delta d . (41) against (37) at the nodes, with (38) and (39) for velocity and acceleration."""
    v, loads, inside = velocities(plate), plate.tractions(5), []
    for L, (x, Psi) in enumerate(zip(plate.A.nodes, plate.shapes, strict=True)):
        a = tuple(acceleration(plate.A, x, v[L], v, dv, i) for i in range(2))
        slope = slope_of(body.gradients[L], delta)
        inside.append(Inside(body.measures[L], at(Psi, delta), slope, body.densities[L], a, body.stresses[L], b[L]))
    whole = updated_weak_form(inside, boundary_of(loads, delta), K)
    residuals = [body.residual(I, v, dv, body.external_force(I, loads, b)) for I in range(len(v))]
    return row("(41)", "work of the residual less (37) with (38), (39)", work(residuals, delta) - whole, whole)


def _stress_checks(plate: Plate, body: SemiLagrangianSolid, internal: list[Vector]) -> list[Row]:
    """Power, total, moment, rotation and the uniform stress of (45)."""
    nodes, v = plate.A.nodes, velocities(plate)
    power = sum(
        (a * contraction(sigma, slope_of(g, v)) for a, sigma, g in zip(body.measures, body.stresses, body.gradients, strict=True)),
        ZERO,
    )  # fmt: skip
    total = largest([sum(c, ZERO) for c in zip(*internal, strict=True)])
    moment = sum((x[0] * f[1] - x[1] * f[0] for x, f in zip(nodes, internal, strict=True)), ZERO)
    size = largest([c for f in internal for c in f])
    return [
        row("(45)", "f_int . v less the power of the stress", work(internal, v) - power, power),
        row("(45)", "total of f_int", total, size),
        row("(45)", "moment of f_int", moment, size),
        row("(45)", "f_int of the turned body less f_int turned", _turned(body, internal), size),
        row("(45)", "f_int of a uniform stress less that on the boundary, SCNI", _uniform(plate, "scni"), size),
        row("(45)", "f_int of a uniform stress less that on the boundary, DNI", _uniform(plate, "dni"), size),
    ]


def _applied(Q: Matrix, vector: Vector) -> Vector:
    """Q v."""
    return tuple(sum(q * c for q, c in zip(line, vector, strict=True)) for line in Q)


def _turned(body: SemiLagrangianSolid, internal: list[Vector]) -> Fraction:
    """With gradients Q b and stress Q sigma Q^T the forces are Q f."""
    gradients = [
        tuple({I: TURN[i][0] * g[0][I] + TURN[i][1] * g[1][I] for I in g[0]} for i in range(2)) for g in body.gradients
    ]
    stresses = [product(product(TURN, sigma), transpose(TURN)) for sigma in body.stresses]
    other = SemiLagrangianSolid(gradients, body.measures, body.shapes, body.rates, body.densities, stresses, K)
    turned = [other.internal_force(I) for I in range(len(internal))]
    return gap(turned, [_applied(TURN, f) for f in internal])


def _uniform(plate: Plate, integration: Integration) -> Fraction:
    """The patch test in the current configuration: sigma times the integral of Psi_I n over the boundary is left."""
    sigma = [[Fraction(2), Fraction(-1, 3)], [Fraction(-1, 3), Fraction(1, 2)]]
    count = len(plate.A.nodes)
    body = SemiLagrangianSolid(plate.gradients(integration), plate.measures, (), (), (), [sigma] * count, K)
    edge = over_the_boundary(plate.A, plate.cells, "trapezoid")
    found = [body.internal_force(I) for I in range(count)]
    return gap(found, [_applied(sigma, tuple(n)) for n in edge])


def _voigt(body: SemiLagrangianSolid) -> Row:
    """B^T Xi of (46) against b_jI sigma_ij."""
    gaps = []
    for L, (sigma, g) in enumerate(zip(body.stresses, body.gradients, strict=True)):
        for I in g[0]:
            B, Xi = body.b_bar(I, L), body.stress_vector(sigma)
            for i in range(2):
                full = sum(sigma[i][j] * g[j][I] for j in range(2))
                gaps.append(sum((line[i] * c for line, c in zip(B, Xi, strict=True)), ZERO) - full)
    return row(
        "(46)", "B^T Xi less b_j sigma_ij", largest(gaps), largest([s for sigma in body.stresses for s in sigma[0]])
    )


def frame_rows(plate: Plate) -> list[Row]:
    """With either rate in N: what a uniform velocity adds to N v, and the balances of mass and momentum.

    m_J' is the rate of sum_L rho a Psi_J(x_L) with the cells' masses rho a kept, by duals in time; momentum sum_J m_J v_J
    changes by sum_J (m_J v_J' + m_J' v_J), of which (41) has sum_I N_IJ in place of m_J'.
    """
    later = moving(plate.A, velocities(plate))
    rates = nodal_mass_rates(later, [r * a for r, a in zip(densities(plate), plate.measures, strict=True)])
    rows, nodes, v = [], range(len(plate.A.nodes)), velocities(plate)
    for name, true in CONVECTIONS.items():
        N = [current(plate, true).convective(I) for I in nodes]
        shifted = [gap([carried(line, [plus(w, FRAME, 1) for w in v], K)], [carried(line, v, K)]) for line in N]
        columns = [sum((line.get(J, ZERO) for line in N), ZERO) for J in nodes]
        apart = [n - m for n, m in zip(columns, rates, strict=True)]
        momentum = largest([sum((c * w[i] for c, w in zip(apart, v, strict=True)), ZERO) for i in range(2)])
        rows.append(
            {
                "convection": name,
                "speed": hypot(*FRAME),
                "frame": float(max(shifted)),
                "mass": float(largest(apart)),
                "total_mass": float(sum(columns, ZERO)),
                "momentum": float(momentum),
                "largest_mass_rate": float(largest(rates)),
                "balances": max(shifted) == 0 and largest(apart) == 0 and momentum == 0,
            }
        )
    return rows


def nodal_mass_rates(later: Approximation, masses: Sequence[Fraction]) -> list[Fraction]:
    """The time derivative of m_J = sum_L m_L Psi_J(x_L), from shape functions on moving nodes."""
    rates = [ZERO] * len(later.nodes)
    for x, m in zip(later.nodes, masses, strict=True):
        for J, Psi in shape_functions(later, x).items():
            rates[J] += m * Psi.partials[0]
    return rates
