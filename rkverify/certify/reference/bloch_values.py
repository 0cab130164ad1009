"""Reference values of plane waves on the square lattice: the stiffness K(k) of one node and omega^2, (41), (45) linearised.

The transcription gives smoothed or direct gradients at rest, and by duals what changes of them as one node moves; the
second route disturbs the plane by a wave and takes difference quotients of the force. With SCNI the transcription's part
of the resting stress is zero, since each side of a cell counts twice; the second route does not know that.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Dual, Duals
from rkverify.certify.reference.by_definition import number
from rkverify.certify.reference.case import Subject, Values, texts
from rkverify.certify.reference.lattice_by_definition import DisturbedPlane
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.nodal_polytopes import nodal_polytope
from rkverify.paper.polytopes import box, polygon
from rkverify.paper.smoothing import direct_gradients, smoothed_gradients
from rkverify.readings import CellMeasure, Derivative, NodalIntegration
from rkverify.stability.bloch.loading import PlaneStressLaw

Index = tuple[int, int]
WAVES = tuple(tuple(map(Fraction, k)) for k in (("1/2", "1/4"), ("3/2", "1"), ("3", "5/2")))
"""Wave vectors, rad/length; none on an axis or a diagonal, where parts of K vanish."""
RULES = {"scni": "trapezoid", "snni": "midpoint"}
AXES = (0, 1)


@dataclass(frozen=True)
class BlochCase:
    """Integration, support radius in spacings (no node and no place of evaluation is just so far), readings, stress, moduli."""

    integration: NodalIntegration
    support: str
    kernel: str = "cubic"
    derivative: Derivative = "full"
    cell_measure: CellMeasure = "edges"
    law: PlaneStressLaw = "truesdell"
    stress: tuple[str, str, str] = ("1/4", "-1/8", "1/16")
    lame: str = "3/2"
    shear: str = "1"

    def subject(self) -> Subject:
        """The case with its two routes."""
        inputs = {
            "lattice": "square", "spacing": "1", "density": "1", "kernel": self.kernel, "order": 1, "window": "radial",
            "support": self.support, "integration": self.integration, "rule": RULES.get(self.integration, ""),
            "derivative": self.derivative, "cell_measure": self.cell_measure, "stress": list(self.stress), "law": self.law,
            "lame": self.lame, "shear": self.shear, "wave_vectors": texts(WAVES),
        }  # fmt: skip
        own = {"scni": "trapezoid", "snni": f"midpoint; measure {self.cell_measure}"}
        reading = own.get(self.integration, f"{self.derivative}; measure {self.cell_measure}")
        equations = (41, 45, 80) if self.integration == "dni" else (41, 45, 47)
        name = f"square lattice, {self.integration}, {reading}, {self.kernel}, R = {self.support}, {self.law}"
        units = {"stiffness": "stress", "omega2": "1/time^2"}
        return Subject(name, equations, f"as-defined; {reading}", inputs, units, self.literal, self.defined)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        b, G, T = self._at_rest(K), self._moved(K), self._tangent(K)
        sigma = _matrix([K.number(s) for s in self.stress])
        found: dict[str, Scalar] = {}
        for w, wave in enumerate(WAVES):
            k = [K.number(c) for c in wave]
            even, odd = [K.zero(), K.zero()], [K.zero(), K.zero()]
            for r, values in b.items():
                angle = k[0] * r[0] + k[1] * r[1]
                even = [e + value * K.cos(angle) for e, value in zip(even, values, strict=True)]
                odd = [o + value * K.sin(angle) for o, value in zip(odd, values, strict=True)]
            stiffness = [[K.zero(), K.zero()], [K.zero(), K.zero()]]
            for i, m, j, n in product(AXES, repeat=4):
                stiffness[i][m] = stiffness[i][m] + T[i][j][m][n] * (even[j] * even[n] + odd[j] * odd[n])
            for r, slopes in G.items():
                cosine = K.cos(k[0] * r[0] + k[1] * r[1])
                for i, m, j in product(AXES, repeat=3):
                    stiffness[i][m] = stiffness[i][m] + sigma[i][j] * slopes[j][m] * cosine
            found |= named(w, stiffness, K.sqrt)
        return found

    def defined(self) -> Values:
        """By definition."""
        R, lame, shear, *stress = (number(Fraction(q)) for q in (self.support, self.lame, self.shear, *self.stress))
        plane = DisturbedPlane(R, self.kernel, self.integration, self.derivative, self.cell_measure, stress, lame, shear, self.law)  # fmt: skip
        found: dict[str, Scalar] = {}
        for w, wave in enumerate(WAVES):
            found |= named(w, plane.stiffness([number(c) for c in wave]), lambda x: x.sqrt())
        return found

    def _approximation(self, K: Arithmetic, moving: Index | None = None) -> tuple[list[Index], Approximation]:
        """Node (0, 0) and those that reach its cell, the nearest first; the moving one a variable of K, which are duals."""
        reach = int(Fraction(self.support)) + 1
        around = range(-reach, reach + 1)
        nodes = sorted(product(around, around), key=lambda J: (_square(J), J))
        places = [
            [K.variable(c, i) if moving == J and isinstance(K, Duals) else K.number(c) for i, c in enumerate(J)]
            for J in nodes
        ]
        return nodes, approximation(places, K.number(self.support), K, self.kernel, 1, "radial")

    def _at_rest(self, K: Arithmetic) -> dict[Index, tuple[Scalar, Scalar]]:
        """Offset r of a node from the cell of node (0, 0) -> b_r of that cell."""
        nodes, A = self._approximation(K)
        first, second = self._gradients(A, K.number(1))
        return {nodes[I]: (b, second[I]) for I, b in first.items()}

    def _gradients(self, A: Approximation, a: Scalar) -> tuple[dict[int, Scalar], ...]:
        """b_jI of the cell of node (0, 0), the first, with the measure a."""
        x = A.nodes[0]
        if self.integration == "dni":
            return direct_gradients(A, x, self.derivative)
        half = A.K.sqrt(a) / 2
        corners = [(x[0] + s * half, x[1] + t * half) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return smoothed_gradients(A, polygon(corners, A.K), RULES[self.integration])

    def _moved(self, K: Arithmetic) -> dict[Index, list[list[Scalar]]]:
        """Offset of node M from node I -> sum_L d(a_L b_jI^L)/dx_lM [j][l]; none for SCNI, where the sum is constant.

        Every cell is looked at from its own node: where M is at m and I at r, the offset is m - r.
        """
        if self.integration == "scni":
            return {}
        D, rest = Duals(K, 2), self._at_rest(K)
        total: dict[Index, list[Dual]] = {}
        beside = [m for m in rest if _square(m) <= (Fraction(self.support) + Fraction(1, 2)) ** 2]
        for m in beside:
            nodes, A = self._approximation(D, m)
            a = self._measure(A, nodes, m, rest, D)
            first, second = self._gradients(A, a)
            for I, b in first.items():
                offset = m[0] - nodes[I][0], m[1] - nodes[I][1]
                sums = total.setdefault(offset, [D.zero(), D.zero()])
                total[offset] = [sums[0] + b * a, sums[1] + second[I] * a]
        return {r: [list(s.partials) for s in sums] for r, sums in total.items()}

    def _measure(self, A: Approximation, nodes: Sequence[Index], m: Index, rest: dict[Index, Any], D: Duals) -> Dual:
        """The measure of the cell of node (0, 0) in the reading of the cell measure, as the node at m moves."""
        if self.cell_measure == "fixed":
            return D.number(1)
        if self.cell_measure == "material":
            # a' = a sum_J b_J . v_J, of which one node moves alone
            return D.along(1, rest[m]) if m in rest else D.number(1)
        near = [J for J, place in enumerate(nodes) if _square(place) <= 2]
        room = box([D.number(-1)] * 2, [D.number(1)] * 2, D)
        cell: Dual = nodal_polytope([A.nodes[J] for J in near], 0, room, D).measure
        return D.along(1, cell.partials)  # at rest it is 1 exactly, which an enclosure of a quotient would not know

    def _tangent(self, K: Arithmetic) -> Any:
        """T_ijmn with sigma'_ij = T_ijmn dv_m/dx_n."""
        s, lame, shear = _matrix([K.number(q) for q in self.stress]), K.number(self.lame), K.number(self.shear)

        def one(i: int, j: int) -> Scalar:
            return K.number(int(i == j))

        def part(i: int, j: int, m: int, n: int) -> Scalar:
            elastic = lame * one(i, j) * one(m, n) + shear * (one(i, m) * one(j, n) + one(i, n) * one(j, m))
            carried = one(i, m) * s[n][j] + one(j, m) * s[n][i]
            if self.law == "truesdell":
                return elastic + carried - s[i][j] * one(m, n)
            return elastic + (carried - one(i, n) * s[m][j] - one(j, n) * s[m][i]) / 2

        return [[[[part(i, j, m, n) for n in AXES] for m in AXES] for j in AXES] for i in AXES]


def _square(J: Index) -> int:
    return J[0] ** 2 + J[1] ** 2


def _matrix(stress: Sequence[Any]) -> list[list[Any]]:
    xx, yy, xy = stress
    return [[xx, xy], [xy, yy]]


def named(w: int, K: Sequence[Sequence[Any]], root: Any) -> dict[str, Scalar]:
    """K by its indices, and its eigenvalues, omega^2 at mass 1: both are real at the stresses of these cases."""
    found = {f"stiffness[{w}][{i}][{j}]": K[i][j] for i, j in product(AXES, repeat=2)}
    half, apart = (K[0][0] + K[1][1]) / 2, (K[0][0] - K[1][1]) / 2
    radius = root(apart * apart + K[0][1] * K[1][0])
    return found | {f"omega2[{w}][0]": half - radius, f"omega2[{w}][1]": half + radius}


def subjects() -> list[Subject]:
    """All cases."""
    cases = [
        BlochCase("scni", "7/4"),
        BlochCase("scni", "7/4", "quintic", law="jaumann"),
        BlochCase("scni", "19/8", "wendland-c4"),
        BlochCase("dni", "7/4"),
        BlochCase("dni", "7/4", derivative="diffuse", cell_measure="fixed"),
        BlochCase("dni", "19/8", "wendland-c2", cell_measure="material", law="jaumann"),
        BlochCase("snni", "7/4"),
        BlochCase("snni", "7/4", "quartic", cell_measure="material"),
    ]
    return [case.subject() for case in cases]
