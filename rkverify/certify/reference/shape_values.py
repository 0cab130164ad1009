"""Reference values of shape functions (2)-(6), (28)-(33) and of their derivatives in every reading, in 1-D to 3-D."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.reference.by_definition import number
from rkverify.certify.reference.case import Subject, Values, indexed, texts
from rkverify.certify.reference.nodes import Discretised, Place, jittered, uniform
from rkverify.kernels import KERNELS
from rkverify.paper.shape import shape_functions, shape_gradient, shape_second
from rkverify.readings import Derivative

AXES = "xyz"
UNIFORM, ENDS = uniform(7, "5/2"), ("1/4", "3", "7/2", "17/4")
LINE = jittered(1, 8, "2", 1)
PLANE, SPACE = jittered(2, 5, "3/2", 2), jittered(3, 4, "3/2", 3)
WIDE_PLANE, WIDE_SPACE = jittered(2, 5, "9/4", 4), jittered(3, 4, "2", 5)
MOST = 6
"""Nodes whose values are printed at a point in space, the nearest; every node that covers it enters the moment matrix."""


@dataclass(frozen=True)
class ShapeCase:
    """Points, the reading of the derivative, the highest derivative, and how many nodes are printed at a point."""

    name: str
    on: Discretised
    points: tuple[Place, ...]
    reading: Derivative = "full"
    highest: int = 2
    most: int = 99

    def subject(self) -> Subject:
        """The case with its two routes."""
        inputs = {**self.on.inputs(), "points": texts(self.points), "reading": self.reading}
        units = {"psi": "1"}
        for name, _ in self.derivatives():
            units[name] = "1/length" if name.startswith("dpsi") else "1/length^2"
        exact = self.on.nodes.dimension == 1 or self.on.window == "tensor"
        equations = (2, 4, 5, 6, 9, 28, 30, 31, 32)
        return Subject(self.name, equations, self.reading, inputs, units, self.literal, self.defined, exact)

    def derivatives(self) -> list[tuple[str, tuple[int, ...]]]:
        """Names and axes of the derivatives."""
        d = self.on.nodes.dimension
        first = [(f"dpsi_d{AXES[j]}", (j,)) for j in range(d)] if self.highest else []
        pairs = list(combinations_with_replacement(range(d), 2)) if self.highest > 1 else []
        return [*first, *((f"d2psi_d{AXES[j]}d{AXES[k]}", (j, k)) for j, k in pairs)]

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        A, found = self.on.literal(K), dict[str, Scalar]()
        for p, place in enumerate(self.points):
            x, keep = A.point(*place), self.on.covering(place, self.most)
            if self.reading == "full":
                found |= indexed("psi", shape_functions(A, x), keep, p)
            for name, axes in self.derivatives():
                at = shape_gradient(A, x, axes[0], self.reading) if len(axes) == 1 else shape_second(A, x, (axes[0], axes[1]), self.reading)  # fmt: skip
                found |= indexed(name, at, keep, p)
        return found

    def defined(self) -> Values:
        """By definition."""
        D, found = self.on.defined(), dict[str, Scalar]()
        for p, place in enumerate(self.points):
            x, keep = [number(c) for c in place], self.on.covering(place, self.most)
            if self.reading == "full":
                found |= indexed("psi", D.shape(x), keep, p)
            for name, axes in self.derivatives():
                at = D.gradient(x, axes[0], self.reading) if len(axes) == 1 else D.second(x, (axes[0], axes[1]), self.reading)  # fmt: skip
                found |= indexed(name, at, keep, p)
        return found


def _point(*coordinates: str) -> Place:
    return tuple(map(Fraction, coordinates))


def _line() -> list[ShapeCase]:
    ends = tuple(_point(x) for x in ENDS)
    inside = (_point("45/16"), LINE.places[3])
    cases = [
        ShapeCase(f"line, uniform nodes, order {n}", Discretised(UNIFORM, order=n), ends, highest=2 if n == 1 else 1)
        for n in (1, 2)
    ]
    cases += [ShapeCase(f"line, own supports, order {n}", Discretised(LINE, order=n), inside) for n in (0, 1, 2)]
    readings: Sequence[tuple[Derivative, int, int]] = [
        ("diffuse", 1, 1), ("diffuse", 2, 2), ("frozen-b", 1, 2), ("frozen-b", 2, 1), ("frozen", 1, 2), ("frozen", 2, 1)
    ]  # fmt: skip
    cases += [
        ShapeCase(f"line, own supports, order {n}, {reading}", Discretised(LINE, order=n), inside, reading, highest)
        for reading, n, highest in readings
    ]
    return cases + [
        ShapeCase(f"line, {name}", Discretised(LINE, name), inside[:1], highest=min(2, kernel.continuity + 1))
        for name, kernel in KERNELS.items()
        if name != "cubic"
    ]


def _plane() -> list[ShapeCase]:
    x, at_node = _point("29/16", "37/16"), PLANE.places[12]
    cases = [ShapeCase("plane, order 0", Discretised(PLANE, order=0), (x,))]
    cases += [ShapeCase("plane, order 1", Discretised(PLANE), (x, at_node))]
    cases += [ShapeCase("plane, order 2", Discretised(WIDE_PLANE, order=2), (x,), most=10)]
    cases += [
        ShapeCase(f"plane, tensor window, order {n}", Discretised(WIDE_PLANE if n == 2 else PLANE, order=n, window="tensor"), (x,), most=10)
        for n in (1, 2)
    ]  # fmt: skip
    readings: tuple[Derivative, ...] = ("diffuse", "frozen-b", "frozen")
    return cases + [
        ShapeCase(f"plane, order 1, {reading}", Discretised(PLANE), (x,), reading, 1 if reading == "diffuse" else 2)
        for reading in readings
    ]


def _space() -> list[ShapeCase]:
    x = _point("25/16", "22/16", "29/16")
    return [
        ShapeCase("space, order 0", Discretised(SPACE, order=0), (x,), highest=1, most=MOST),
        ShapeCase("space, order 1", Discretised(SPACE), (x,), most=MOST),
        ShapeCase("space, order 1, diffuse", Discretised(SPACE), (x,), "diffuse", 1, MOST),
        ShapeCase("space, order 2", Discretised(WIDE_SPACE, order=2), (x,), highest=1, most=MOST),
        ShapeCase("space, tensor window, order 1", Discretised(SPACE, window="tensor"), (x,), highest=1, most=MOST),
    ]


def subjects() -> list[Subject]:
    """All cases."""
    return [case.subject() for case in (*_line(), *_plane(), *_space())]
