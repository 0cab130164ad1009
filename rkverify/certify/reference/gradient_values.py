"""Reference values of smoothed gradients (17), (23), (47), (52), (72) by every edge rule, and of direct ones (80)."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.reference.by_definition import number
from rkverify.certify.reference.case import Subject, Values, indexed, texts
from rkverify.certify.reference.cells_by_definition import in_box, in_interval, in_polygon, polygon_area
from rkverify.certify.reference.nodes import Discretised, Place
from rkverify.certify.reference.shape_values import LINE, PLANE, SPACE, WIDE_PLANE
from rkverify.paper.polytopes import Polytope, box, polygon
from rkverify.paper.smoothing import direct_gradients, smoothed_gradients
from rkverify.readings import DERIVATIVES, Derivative

AXES = "xyz"


def _places(rows: Sequence[Sequence[str]]) -> tuple[Place, ...]:
    return tuple(tuple(map(Fraction, row)) for row in rows)


PENTAGON = _places([("13/8", "3/2"), ("5/2", "13/8"), ("21/8", "19/8"), ("2", "11/4"), ("25/16", "9/4")])
TRIANGLE = _places([("1/2", "1/4"), ("15/8", "1/2"), ("3/4", "7/4")])
CUBOID = _places([("5/4", "9/8", "5/4"), ("15/8", "7/4", "2")])
INTERVAL = _places([("9/4",), ("27/8",)])
RULES = ("trapezoid", "midpoint", "gauss:2", "gauss:3")


@dataclass(frozen=True)
class SmoothedCase:
    """A cell as data: the corners of a polygon, or two opposite corners of an interval or a box; the rule on its sides."""

    name: str
    on: Discretised
    corners: tuple[Place, ...]
    rule: str
    keep: tuple[int, ...] = ()

    def subject(self) -> Subject:
        """The case with its two routes."""
        d = self.on.nodes.dimension
        inputs = {**self.on.inputs(), "cell": texts(self.corners), "rule": self.rule}
        exact = d == 1 or (self.on.window == "tensor" and not self.rule.startswith("gauss"))
        units = {f"b_{AXES[i]}": "1/length" for i in range(d)} | {"measure": f"length^{d}"}
        equations = (52, 72) if d == 1 else (15, 16, 17, 23, 47)
        return Subject(self.name, equations, self.rule, inputs, units, self.literal, self.defined, exact)

    def cell(self, K: Arithmetic) -> Polytope:
        """The cell for the transcription."""
        return polygon(self.corners, K) if self.on.nodes.dimension == 2 else box(self.corners[0], self.corners[1], K)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        cell = self.cell(K)
        return {"measure": cell.measure, **self._named(smoothed_gradients(self.on.literal(K), cell, self.rule))}

    def _named(self, columns: Sequence[Any]) -> dict[str, Scalar]:
        seen = {I for corner in self.corners for I in self.on.covering(corner)} if not self.keep else set(self.keep)
        found = dict[str, Scalar]()
        for i, column in enumerate(columns):
            found |= indexed(f"b_{AXES[i]}", column, sorted(seen))
        return found

    def defined(self) -> Values:
        """By definition."""
        D, ends = self.on.defined(), [[number(c) for c in x] for x in self.corners]
        sides = [q - p for p, q in zip(ends[0], ends[1], strict=True)]
        if self.on.nodes.dimension == 1:
            return {"measure": sides[0], **self._named(in_interval(D, ends[0][0], ends[1][0]))}
        if self.on.nodes.dimension == 3:
            return {"measure": sides[0] * sides[1] * sides[2], **self._named(in_box(D, ends[0], ends[1], self.rule))}
        return {"measure": polygon_area(ends), **self._named(in_polygon(D, ends, self.rule))}


@dataclass(frozen=True)
class DirectCase:
    """Direct gradients at a node in a reading of the derivative."""

    on: Discretised
    node: int
    reading: Derivative

    def subject(self) -> Subject:
        """The case with its two routes."""
        d = self.on.nodes.dimension
        inputs = {**self.on.inputs(), "points": texts([self.on.nodes.places[self.node]]), "reading": self.reading}
        units = {f"b_{AXES[i]}": "1/length" for i in range(d)}
        name = f"direct gradients in {d}-D, {self.reading}"
        return Subject(name, (80,), self.reading, inputs, units, self.literal, self.defined, d == 1)

    def _named(self, columns: Sequence[Any]) -> dict[str, Scalar]:
        keep, found = self.on.covering(self.on.nodes.places[self.node]), dict[str, Scalar]()
        for i, column in enumerate(columns):
            found |= indexed(f"b_{AXES[i]}", column, keep)
        return found

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        A = self.on.literal(K)
        return self._named(direct_gradients(A, A.nodes[self.node], self.reading))

    def defined(self) -> Values:
        """By definition."""
        D = self.on.defined()
        return self._named([D.gradient(D.nodes[self.node], i, self.reading) for i in range(self.on.nodes.dimension)])


def subjects() -> list[Subject]:
    """All cases."""
    on, wide = Discretised(PLANE), Discretised(WIDE_PLANE, order=2, window="tensor")
    smoothed = [SmoothedCase("smoothed gradients on a line", Discretised(LINE), INTERVAL, "trapezoid")]
    smoothed += [SmoothedCase(f"smoothed gradients of a pentagon, {rule}", on, PENTAGON, rule) for rule in RULES]
    smoothed += [SmoothedCase("smoothed gradients of a triangle, trapezoid", on, TRIANGLE, "trapezoid")]
    watched = tuple(wide.covering(PENTAGON[0], 8))
    smoothed += [
        SmoothedCase(f"smoothed gradients of a pentagon, order 2, {rule}", wide, PENTAGON, rule, watched)
        for rule in RULES[:2]
    ]
    solid = Discretised(SPACE)
    near = tuple(solid.covering(CUBOID[0], 8))
    smoothed += [SmoothedCase(f"smoothed gradients of a box, {rule}", solid, CUBOID, rule, near) for rule in RULES[:2]]
    direct: list[DirectCase] = [DirectCase(Discretised(LINE), 4, reading) for reading in DERIVATIVES]
    direct += [DirectCase(on, 12, reading) for reading in DERIVATIVES]
    return [*(case.subject() for case in smoothed), *(case.subject() for case in direct)]
