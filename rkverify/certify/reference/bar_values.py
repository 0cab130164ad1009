"""Reference values of the one-dimensional equations on an uneven bar: (49)-(51), (56), (65)-(68)."""

from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

import flint

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.reference.by_definition import number, slope
from rkverify.certify.reference.case import Subject, Values, indexed, texts
from rkverify.certify.reference.cells_by_definition import in_interval
from rkverify.certify.reference.nodes import Discretised, vectors
from rkverify.certify.reference.shape_values import LINE
from rkverify.paper.cells import Cell
from rkverify.paper.lagrangian_equations import LagrangianChain, gradient
from rkverify.paper.semi_lagrangian_solid import SemiLagrangianSolid, rates_at_nodes
from rkverify.paper.shape import shape_functions

ON = Discretised(LINE)
COUNT = len(LINE.places)
ALL = range(COUNT)
WATCHED = (0, 3, 4)
DENSITY, MODULUS, PRESTRESS, STRETCH = Fraction(3, 2), Fraction(1), Fraction(1, 4), Fraction(9, 8)
BODY, END = Fraction(5, 8), Fraction(-3, 4)
EDGES = [Fraction(-1, 2), *((p[0] + q[0]) / 2 for p, q in pairwise(LINE.places)), Fraction(2 * COUNT - 1, 2)]
POSITIONS = [STRETCH * X[0] + u[0] / 8 for X, u in zip(LINE.places, vectors(COUNT, 1, 31), strict=True)]
VELOCITIES = vectors(COUNT, 1, 32)
UNITS = {
    "internal_force": "force", "external_force": "force", "mass": "mass", "lumped_mass": "mass",
    "convective": "mass/time", "convective_true": "mass/time",
}  # fmt: skip


@dataclass(frozen=True)
class BarCase:
    """The bar with SCNI or DNI: mass and N are the same for both and go with SCNI."""

    integration: Any

    def subject(self) -> Subject:
        """The case with its two routes."""
        scalars = {
            "density": DENSITY, "modulus": MODULUS, "prestress": PRESTRESS, "stretch": STRETCH, "body_force": BODY,
            "end_force": END,
        }  # fmt: skip
        inputs = {
            **ON.inputs(),
            "edges": texts(EDGES),
            "positions": texts(POSITIONS),
            "velocities": texts(VELOCITIES),
            **{name: texts(value) for name, value in scalars.items()},
            "integration": self.integration,
        }
        equations = (48, 49, 50, 51, 53, 54, 55, 66, 68) if self.integration == "scni" else (49, 51, 80)
        return Subject(f"bar, {self.integration}", equations, "full" if self.integration == "dni" else "", inputs, UNITS, self.literal, self.defined, True)  # fmt: skip

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        A, number = ON.literal(K), K.number
        cells = {L: Cell(number(p), number(q)) for L, (p, q) in enumerate(pairwise(EDGES))}
        gradients = {L: gradient(A, L, cell, self.integration, "full") for L, cell in cells.items()}
        shapes = {L: shape_functions(A, A.nodes[L]) for L in cells}
        chain = LagrangianChain(
            gradients, cells, number(DENSITY), number(MODULUS), number(PRESTRESS), number(STRETCH), K, shapes
        )
        moved = [number(x - X[0]) for x, X in zip(POSITIONS, LINE.places, strict=True)]
        found = {f"internal_force[{I}]": chain.internal_force(I, moved) for I in ALL}
        if self.integration == "dni":
            return found
        at_end = shape_functions(A, A.nodes[-1])
        found |= {f"external_force[{I}]": chain.external_force(I, number(BODY), number(END), at_end) for I in ALL}
        v = [A.point(*w) for w in VELOCITIES]
        for name, true in (("convective", False), ("convective_true", True)):
            semi = SemiLagrangianSolid(
                [], [c.measure for c in cells.values()], list(shapes.values()), rates_at_nodes(A, v, true),
                [number(DENSITY)] * COUNT, [], K,
            )  # fmt: skip
            for I in WATCHED:
                found |= indexed(name, _known(semi.convective(I), K), ALL, I)
                if not true:
                    found |= indexed("mass", _known(semi.mass(I), K), ALL, I)
            if not true:
                found |= {f"lumped_mass[{I}]": sum(semi.mass(I).values(), K.zero()) for I in ALL}
        return found

    def defined(self) -> Values:
        """By definition."""
        D, edges = ON.defined(), [number(x) for x in EDGES]
        a = [q - p for p, q in pairwise(edges)]
        if self.integration == "scni":
            b = [in_interval(D, p, q)[0] for p, q in pairwise(edges)]
        else:
            b = [D.gradient(x, 0) for x in D.nodes]
        found: dict[str, Scalar] = {}
        for I in ALL:
            found[f"internal_force[{I}]"] = slope(partial(_energies, b, a, I))[0]
        if self.integration == "dni":
            return found
        Psi, v = [D.shape(x) for x in D.nodes], [[number(c) for c in w] for w in VELOCITIES]
        m = [number(DENSITY) * length for length in a]
        rates = {
            name: [D.rate(x, w, v, true) for x, w in zip(D.nodes, v, strict=True)]
            for name, true in (("convective", False), ("convective_true", True))
        }
        for I in ALL:
            pulled = Psi[-1][I] * number(END)
            found[f"external_force[{I}]"] = pulled + _sum(Psi[L][I] * number(BODY) * a[L] for L in ALL)
            found[f"lumped_mass[{I}]"] = _sum(m[L] * Psi[L][I] for L in ALL)
        for I in WATCHED:
            for J in ALL:
                found[f"mass[{I}][{J}]"] = _sum(m[L] * Psi[L][I] * Psi[L][J] for L in ALL)
                for name, rate in rates.items():
                    found[f"{name}[{I}][{J}]"] = _sum(m[L] * Psi[L][I] * rate[L][J] for L in ALL)
        return found


def _energies(b: list[list[Any]], a: list[Any], I: int, t: Any) -> list[Any]:
    """sum_L (S_0 - C E_0) E + C E^2/2, with node I moved by t."""
    x = [number(p) + (t if J == I else 0) for J, p in enumerate(POSITIONS)]
    held = number(PRESTRESS - MODULUS * (STRETCH**2 - 1) / 2)
    total = flint.arb(0)
    for row, length in zip(b, a, strict=True):
        F = _sum(p * q for p, q in zip(row, x, strict=True))
        E = (F * F - 1) / 2
        total += (held * E + number(MODULUS) * E * E / 2) * length
    return [total]


def _known(row: Any, K: Arithmetic) -> dict[int, Scalar]:
    return {J: row.get(J, K.zero()) for J in ALL}


def _sum(terms: Any) -> Any:
    return sum(terms, flint.arb(0))


def subjects() -> list[Subject]:
    """Both integrations."""
    return [BarCase("scni").subject(), BarCase("dni").subject()]
