"""Reference values of the semi-discrete equations: masses, N and nodal forces of a bar and of a plate whose cells are data.

The second route sums (19), (42), (43), (20) with its own shape functions and rates; Lagrangian forces are slopes of the
stored energy, not sums of B^T P; the forces (45) are the virtual power of the stresses in unit motions of the nodes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

import flint

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.reference.by_definition import Defined, Place, number, slope
from rkverify.certify.reference.case import Subject, Values, indexed, texts
from rkverify.certify.reference.cells_by_definition import Columns, in_polygon, polygon_area
from rkverify.certify.reference.nodes import Discretised, Nodes, vectors
from rkverify.paper.constitutive import Moduli, saint_venant_kirchhoff
from rkverify.paper.lagrangian_solid import LagrangianSolid
from rkverify.paper.polytopes import polygon
from rkverify.paper.semi_lagrangian_solid import SemiLagrangianSolid, rates_at_nodes, shapes_at_nodes
from rkverify.paper.shape import shape_functions
from rkverify.paper.smoothing import direct_gradients, smoothed_gradients

PER_SIDE = 3
LAME, SHEAR, DENSITY = Fraction(5, 4), Fraction(3, 4), Fraction(3, 2)
WATCHED = (0, 4, 5)
"""Nodes whose rows of M and N are printed."""


def corners() -> list[tuple[Fraction, Fraction]]:
    """A grid of corners, those inside the square moved."""
    moved = iter(vectors(4, 2, 21))
    found = []
    for i in range(PER_SIDE + 1):
        for j in range(PER_SIDE + 1):
            by = next(moved) if 0 < i < PER_SIDE and 0 < j < PER_SIDE else (Fraction(0), Fraction(0))
            found.append((i + by[0] / 4, j + by[1] / 4))
    return found


def quadrilaterals() -> list[list[tuple[Fraction, Fraction]]]:
    """The cells, counter-clockwise, from left to right and within it upwards."""
    places, n = corners(), PER_SIDE + 1
    return [
        [places[i * n + j], places[(i + 1) * n + j], places[(i + 1) * n + j + 1], places[i * n + j + 1]]
        for i in range(PER_SIDE)
        for j in range(PER_SIDE)
    ]


def _nodes() -> Nodes:
    by = vectors(PER_SIDE**2, 2, 22)
    places = [(i + Fraction(1, 2), j + Fraction(1, 2)) for i in range(PER_SIDE) for j in range(PER_SIDE)]
    moved = tuple(tuple(c + m / 8 for c, m in zip(x, y, strict=True)) for x, y in zip(places, by, strict=True))
    return Nodes(moved, tuple(Fraction(9, 4) + Fraction(I % 4, 16) for I in range(len(places))))


ON = Discretised(_nodes())
ALL = range(PER_SIDE**2)


def state() -> dict[str, Any]:
    """Displacement coefficients, velocities, Cauchy stresses (11, 22, 12), body forces by cell, one traction by edge's end."""
    stresses = [(a, b, (a - b) / 2 + Fraction(1, 8)) for a, b in vectors(len(ALL), 2, 25)]
    return {
        "displacements": [tuple(c / 4 for c in v) for v in vectors(len(ALL), 2, 23)],
        "velocities": vectors(len(ALL), 2, 24),
        "stresses": stresses,
        "body_forces": vectors(len(ALL), 2, 26),
        "traction_points": [(Fraction(3), Fraction(0)), (Fraction(3), Fraction(1))],
        "tractions": vectors(2, 2, 27),
        "traction_weights": [Fraction(1, 2), Fraction(1, 2)],
    }


UNITS = {
    "mass": "density*length^2", "lumped_mass": "density*length^2", "convective": "density*length^2/time",
    "convective_true": "density*length^2/time", "external_force": "stress*length", "internal_force": "stress*length",
    "cauchy_force": "stress*length", "measure": "length^2",
}  # fmt: skip


@dataclass(frozen=True)
class PlateCase:
    """The plate with smoothed gradients by the trapezoid, or with direct ones."""

    integration: str

    def subject(self) -> Subject:
        """The case with its two routes."""
        material = {"lame": texts(LAME), "shear": texts(SHEAR), "density": texts(DENSITY)}
        given = {name: texts(value) for name, value in state().items()}
        inputs = {**ON.inputs(), "cells": texts(quadrilaterals()), **material, **given, "integration": self.integration}
        numbers = (18, 19, 20, 21, 22, 41, 42, 43, 44, 45, 46)
        reading = (
            "trapezoid; first Piola-Kirchhoff stress in (22)"
            if self.integration == "scni"
            else "full; first Piola-Kirchhoff stress in (22)"
        )
        return Subject(f"plate, {self.integration}", numbers, reading, inputs, UNITS, self.literal, self.defined)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        A, given = ON.literal(K), state()

        def all_of(name: str) -> list[tuple[Scalar, ...]]:
            return [A.point(*row) for row in given[name]]

        cells = [polygon(cell, K) for cell in quadrilaterals()]
        measures = [cell.measure for cell in cells]
        smoothed = self.integration == "scni"
        gradients = [smoothed_gradients(A, cell) if smoothed else direct_gradients(A, A.nodes[L]) for L, cell in enumerate(cells)]  # fmt: skip
        shapes, C, rho = shapes_at_nodes(A), Moduli(K.number(LAME), K.number(SHEAR)), K.number(DENSITY)
        lagrangian = LagrangianSolid(gradients, measures, shapes, rho, lambda F: saint_venant_kirchhoff(F, C, K), K)
        stresses = [[[s[0], s[2]], [s[2], s[1]]] for s in all_of("stresses")]
        semi = [
            SemiLagrangianSolid(gradients, measures, shapes, rates_at_nodes(A, all_of("velocities"), true), [rho] * len(cells), stresses, K)
            for true in (False, True)
        ]  # fmt: skip
        weights = [K.number(w) for w in given["traction_weights"]]
        at = [shape_functions(A, x) for x in all_of("traction_points")]
        tractions = list(zip(at, all_of("tractions"), weights, strict=True))
        found = indexed("measure", measures, ALL)
        for I in ALL:
            found |= _vector("internal_force", I, lagrangian.internal_force(I, all_of("displacements"), "first"))
            found |= _vector("cauchy_force", I, semi[0].internal_force(I))
        if smoothed:
            for I in ALL:
                found |= _vector("external_force", I, semi[0].external_force(I, tractions, all_of("body_forces")))
                found[f"lumped_mass[{I}]"] = sum(semi[0].mass(I).values(), K.zero())
            for I in WATCHED:
                found |= indexed("mass", lagrangian.mass(I), ALL, I)
                found |= indexed("convective", semi[0].convective(I), ALL, I)
                found |= indexed("convective_true", semi[1].convective(I), ALL, I)
        return found

    def defined(self) -> Values:
        """By definition."""
        D = ON.defined()
        given = {k: _enclosed(value) for k, value in state().items()}
        cells = _enclosed(quadrilaterals())
        a = [polygon_area(cell) for cell in cells]
        smoothed = self.integration == "scni"
        b = [in_polygon(D, cell, "trapezoid") if smoothed else [D.gradient(D.nodes[L], i) for i in range(2)] for L, cell in enumerate(cells)]  # fmt: skip
        found = indexed("measure", a, ALL)
        for I in ALL:
            for i in range(2):
                found[f"internal_force[{I}][{i}]"] = slope(partial(_energies, b, a, given["displacements"], I, i))[0]
            powers = [_power(given["stresses"], b, a, I, i) for i in range(2)]
            found |= _vector("cauchy_force", I, powers)
        return found | _inertia(D, a, given) if smoothed else found


def _inertia(D: Defined, a: list[Any], given: dict[str, Any]) -> dict[str, Scalar]:
    Psi = [D.shape(x) for x in D.nodes]
    rho = number(DENSITY)
    rates = [
        [D.rate(x, v, given["velocities"], true) for x, v in zip(D.nodes, given["velocities"], strict=True)]
        for true in (False, True)
    ]
    at = [D.shape(x) for x in given["traction_points"]]
    found: dict[str, Scalar] = {}
    for I in ALL:
        found[f"lumped_mass[{I}]"] = rho * _sum(Psi[L][I] * a[L] for L in ALL)
        body = [_sum(Psi[L][I] * given["body_forces"][L][i] * a[L] for L in ALL) for i in range(2)]
        ends = range(len(at))
        pulled = [_sum(at[k][I] * given["tractions"][k][i] * given["traction_weights"][k] for k in ends) for i in range(2)]  # fmt: skip
        found |= _vector("external_force", I, [p + q for p, q in zip(body, pulled, strict=True)])
    for I in WATCHED:
        for J in ALL:
            found[f"mass[{I}][{J}]"] = rho * _sum(Psi[L][I] * Psi[L][J] * a[L] for L in ALL)
            for name, rate in zip(("convective", "convective_true"), rates, strict=True):
                found[f"{name}[{I}][{J}]"] = rho * _sum(Psi[L][I] * rate[L][J] * a[L] for L in ALL)
    return found


def _energies(b: list[Columns], a: list[Any], d: list[Place], I: int, i: int, t: Any) -> list[Any]:
    """sum_L (lambda/2 (tr E)^2 + mu E:E) A_L with the coefficient i of node I changed by t."""
    moved = [[c + (t if (J, j) == (I, i) else 0) for j, c in enumerate(row)] for J, row in enumerate(d)]
    total = flint.arb(0)
    for columns, measure in zip(b, a, strict=True):
        F = [[(i == j) + _sum(columns[j][J] * moved[J][i] for J in ALL) for j in range(2)] for i in range(2)]
        E = [[(F[0][i] * F[0][j] + F[1][i] * F[1][j] - (i == j)) / 2 for j in range(2)] for i in range(2)]
        trace = E[0][0] + E[1][1]
        squares = sum((E[i][j] * E[i][j] for i in range(2) for j in range(2)), flint.arb(0))
        total += (number(LAME) / 2 * trace * trace + number(SHEAR) * squares) * measure
    return [total]


def _power(stresses: list[Place], b: list[Columns], a: list[Any], I: int, i: int) -> Any:
    """sum_L sigma_ij b_jI a_L."""
    total = flint.arb(0)
    for s, columns, measure in zip(stresses, b, a, strict=True):
        row = (s[0], s[2]) if i == 0 else (s[2], s[1])
        total += (row[0] * columns[0][I] + row[1] * columns[1][I]) * measure
    return total


def _enclosed(numbers: Any) -> Any:
    return number(numbers) if isinstance(numbers, Fraction) else [_enclosed(n) for n in numbers]


def _sum(terms: Any) -> Any:
    return sum(terms, flint.arb(0))


def _vector(name: str, I: int, vector: Sequence[Scalar]) -> dict[str, Scalar]:
    return {f"{name}[{I}][{i}]": c for i, c in enumerate(vector)}


def subjects() -> list[Subject]:
    """The plate with both integrations; the bar is in `bar_values`."""
    return [PlateCase("scni").subject(), PlateCase("dni").subject()]
