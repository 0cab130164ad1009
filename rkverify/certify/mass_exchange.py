"""Nodal masses m_J = sum_L m_L Psi_J(x_L) of moving nodes, their rates by duals in time, and what N of (43) has for them.

The masses m_L = rho a_L of the cells are the material's and stay; the kernel is the paper's own, with a radial support.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Float
from rkverify.certify.plates import RHO_0, Plate
from rkverify.paper.approximation import Vector, approximation
from rkverify.paper.semi_lagrangian_solid import SemiLagrangianSolid, rates_at_nodes, shapes_at_nodes
from rkverify.paper.shape import shape_functions

Row = dict[str, Any]
SUPPORT = Fraction(5, 2)
FLOWS = ("translation", "rotation", "stretch", "simple shear", "random")


@dataclass(frozen=True)
class Flow:
    """A plate's nodes with a velocity each; the flow is steady, x_I(t) = x_I + v_I t."""

    plate: Plate
    name: str

    def velocities(self) -> list[tuple[Fraction, Fraction]]:
        """v_I (NP, 2), up to about 1."""
        middle = Fraction(self.plate.per_side - 1, 2)
        size = 1 / (2 * middle)
        from_middle = [((x - middle) * size, (y - middle) * size) for x, y in self.plate.A.nodes]
        zero, one = Fraction(0), Fraction(1)
        return {
            "translation": [(one, Fraction(1, 2))] * len(from_middle),
            "rotation": [(-y, x) for x, y in from_middle],
            "stretch": [(x, -y / 2) for x, y in from_middle],
            "simple shear": [(y, zero) for _, y in from_middle],
            "random": [(v[0], v[1]) for v in self.plate.vectors(9, one)],
        }[self.name]

    def masses(self) -> list[Fraction]:
        """m_L = rho a_L with the Voronoi cells at t = 0."""
        return [RHO_0 * a for a in self.plate.measures]

    def rates(self, base: Arithmetic) -> tuple[list[Scalar], list[Scalar]]:
        """m_J and dm_J/dt at t = 0, by duals in time."""
        D = Duals(base, 1)
        places = [[D.along(c, [w]) for c, w in zip(x, v, strict=True)] for x, v in zip(self.plate.A.nodes, self.velocities(), strict=True)]  # fmt: skip
        later = approximation(places, SUPPORT, D)
        total = [D.zero() for _ in places]
        for x, m in zip(later.nodes, self.masses(), strict=True):
            for J, Psi in shape_functions(later, x).items():
                total[J] = total[J] + Psi * D.number(m)
        return [m.value for m in total], [m.partials[0] for m in total]

    def column_sums(self, base: Arithmetic, true: bool) -> list[Scalar]:
        """sum_I N_IJ of (43) with Psi*, or with the true rate."""
        A = approximation(self.plate.A.nodes, SUPPORT, base)
        v: list[Vector] = [A.point(*w) for w in self.velocities()]
        ones = [base.number(1)] * len(v)
        masses = list(map(base.number, self.masses()))
        body = SemiLagrangianSolid((), ones, shapes_at_nodes(A), rates_at_nodes(A, v, true), masses, (), base)
        total = [base.zero() for _ in v]
        for I in range(len(v)):
            for J, N in body.convective(I).items():
                total[J] = total[J] + N
        return total

    def followed(self, times: Sequence[float]) -> list[list[float]]:
        """m_J(t) by time and node, in double precision."""
        found = []
        for t in times:
            places = [[float(c) + float(w) * t for c, w in zip(x, v, strict=True)] for x, v in zip(self.plate.A.nodes, self.velocities(), strict=True)]  # fmt: skip
            A = approximation(places, SUPPORT, Float())
            total = [0.0] * len(places)
            for x, m in zip(A.nodes, self.masses(), strict=True):
                for J, Psi in shape_functions(A, x).items():
                    total[J] += float(m) * Psi
            found.append(total)
        return found


def flow_rows(plate: Plate, digits: int) -> list[Row]:
    """For every flow: how fast nodal masses change, and how far N's column sums are from that; zero below 10^-digits/2."""
    K = Multiprecision(digits)
    rows = []
    for name in FLOWS:
        flow = Flow(plate, name)
        masses, rates = flow.rates(K)
        star, true = flow.column_sums(K, False), flow.column_sums(K, True)
        rows.append(
            {
                "flow": name,
                "rate": _rounded(max(K.absolute(r / m) for r, m in zip(rates, masses, strict=True)), digits),
                "total": _rounded(sum(rates, K.zero()), digits),
                "true_apart": _rounded(max(K.absolute(p - q) for p, q in zip(true, rates, strict=True)), digits),
                "star_apart": _rounded(max(K.absolute(p - q) for p, q in zip(star, rates, strict=True)), digits),
                "star_total": _rounded(sum(star, K.zero()), digits),
            }
        )
    return rows


def _rounded(x: Scalar, digits: int) -> float:
    """x as a double; 0 where it is below 10^-(digits/2), far above rounding at that many digits and far below all else."""
    return 0.0 if abs(x) < 10 ** -(digits // 2) else float(x)


def node_rows(plate: Plate) -> list[Row]:
    """Node by node in the random flow: mass, its rate, and the column sums of N."""
    flow, K = Flow(plate, "random"), Float()
    masses, rates = flow.rates(K)
    columns = zip(masses, rates, flow.column_sums(K, True), flow.column_sums(K, False), strict=True)
    return [{"node": J, "mass": m, "rate": r, "true": t, "star": s} for J, (m, r, t, s) in enumerate(columns)]


def time_rows(plate: Plate, steps: int, end: float) -> list[Row]:
    """The nodal masses and their total in the random flow up to the time `end`."""
    times = list(np.linspace(0, end, steps + 1))
    return [
        {"time": float(t), "total": sum(masses), **{f"m_{J}": m for J, m in enumerate(masses)}}
        for t, masses in zip(times, Flow(plate, "random").followed(times), strict=True)
    ]
