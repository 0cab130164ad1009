"""Reference values of material rates: Psi* of (40) and the true rate of Psi, where nodes and material move."""

from dataclasses import dataclass
from fractions import Fraction

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.reference.by_definition import number
from rkverify.certify.reference.case import Subject, Values, indexed, texts
from rkverify.certify.reference.nodes import Discretised, Place, vectors
from rkverify.certify.reference.shape_values import LINE, PLANE, SPACE
from rkverify.paper.material_rates import psi_star, true_rate


@dataclass(frozen=True)
class RateCase:
    """A point, and from the seed the velocities of the nodes and of the material there."""

    name: str
    on: Discretised
    point: Place
    seed: int
    most: int = 99

    @property
    def velocities(self) -> list[Place]:
        """Of the nodes (N, d), and of the material last."""
        return vectors(len(self.on.nodes.places) + 1, self.on.nodes.dimension, self.seed)

    def subject(self) -> Subject:
        """The case with its two routes."""
        moving = {"velocity": texts(self.velocities[-1]), "node_velocities": texts(self.velocities[:-1])}
        inputs = {**self.on.inputs(), "points": texts([self.point]), **moving}
        exact = self.on.nodes.dimension == 1 or self.on.window == "tensor"
        units = {"psi_star": "1/time", "true_rate": "1/time"}
        return Subject(self.name, (35, 36, 39, 40, 68), "", inputs, units, self.literal, self.defined, exact)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        A = self.on.literal(K)
        moving = [A.point(*v) for v in self.velocities]
        x, keep, found = A.point(*self.point), self.on.covering(self.point, self.most), dict[str, Scalar]()
        for name, rate in (("psi_star", psi_star), ("true_rate", true_rate)):
            found |= indexed(name, rate(A, x, moving[-1], moving[:-1]), keep, 0)
        return found

    def defined(self) -> Values:
        """By definition."""
        D, moving = self.on.defined(), [[number(c) for c in v] for v in self.velocities]
        x, keep, found = [number(c) for c in self.point], self.on.covering(self.point, self.most), dict[str, Scalar]()
        for name, true in (("psi_star", False), ("true_rate", True)):
            found |= indexed(name, D.rate(x, moving[-1], moving[:-1], true), keep, 0)
        return found


def subjects() -> list[Subject]:
    """All cases."""
    x, y, z = Fraction(45, 16), Fraction(37, 16), Fraction(29, 16)
    cases = [
        RateCase("rates on a line, order 1", Discretised(LINE), (x,), 11),
        RateCase("rates on a line, order 2", Discretised(LINE, order=2), (x,), 12),
        RateCase("rates on a line, at a node", Discretised(LINE, "quintic"), LINE.places[4], 13),
        RateCase("rates in the plane", Discretised(PLANE), (z, y), 14),
        RateCase("rates in the plane, tensor window", Discretised(PLANE, window="tensor"), (z, y), 15),
        RateCase("rates in space", Discretised(SPACE), (z, z - Fraction(5, 16), z), 16, 10),
    ]
    return [case.subject() for case in cases]
