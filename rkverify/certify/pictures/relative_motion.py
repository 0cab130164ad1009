"""Figure 3: the motion of neighbours relative to a kernel's centre, n.(v - v_I), against the rate of the distance."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import hypot, pi
from typing import Any

import numpy as np

from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.certify.motions import Path
from rkverify.certify.pictures.block import Block, squared
from rkverify.paper.approximation import Approximation, Vector, approximation
from rkverify.paper.kernel_rates import direction, dot, minus

Row = dict[str, Any]
STEP = 1e-30
"""Of the complex step; any so small that its square is below a double's rounding gives the same digits."""


@dataclass(frozen=True)
class Snapshot:
    """Exact places x_I and velocities v_I of the block's nodes at one time of a motion, and the approximation on them in doubles."""

    x: list[Vector]
    v: list[Vector]
    A: Approximation

    def projection(self, I: int, J: int) -> tuple[Vector, float]:
        """n and n.(v_J - v_I) with n = (x_J - x_I)/|x_J - x_I| of (36)."""
        n = direction(self.A, self.A.nodes[J], I)
        return n, float(dot(n, tuple(map(float, minus(self.v[J], self.v[I])))))


def snapshot(block: Block, path: Path, t: Fraction) -> Snapshot:
    """Places and velocities dx/dt at fixed X, exactly, by duals in t."""
    D = Duals(Exact(), 1)
    now = [path(D.variable(t, 0)).forth(tuple(map(D.number, X))) for X in block.nodes]
    x = [tuple(c.value for c in place) for place in now]
    return Snapshot(x, [tuple(c.partials[0] for c in place) for place in now], approximation(x, block.support, Float()))


def distance_rate(block: Block, path: Path, t: Fraction, I: int, J: int) -> float:
    """d|x_J - x_I|/dt by a complex step in t through the motion alone; no velocity is formed."""
    K = Complex()
    at = path(complex(float(t), STEP))
    x, y = (at.forth(tuple(map(K.number, block.nodes[node]))) for node in (I, J))
    return float(K.sqrt(squared(y, x)).imag / STEP)


def difference_quotient(block: Block, path: Path, t: Fraction, step: Fraction, I: int, J: int) -> float:
    """(|x_J - x_I|(t + s) - |x_J - x_I|(t - s)) / (2 s), from exact places: off by s^2/6 times the third derivative."""
    lengths = [
        hypot(*map(float, minus(at.forth(block.nodes[J]), at.forth(block.nodes[I]))))
        for at in (path(t + step), path(t - step))
    ]
    return float((lengths[0] - lengths[1]) / (2 * float(step)))


def _pairs(block: Block, there: Snapshot, centres: Sequence[int]) -> Iterator[tuple[int, int]]:
    for I in centres:
        for J, place in enumerate(there.x):
            if J != I and squared(place, there.x[I]) < block.support**2:
                yield I, J


def neighbours(block: Block, centre: int, path: Path, t: Fraction, step: Fraction) -> list[Row]:
    """For each node under the kernel: place and velocity relative to the centre, n, n.(v - v_I), and the rate of the distance by two ways."""
    there, rows = snapshot(block, path, t), []
    for I, J in _pairs(block, there, [centre]):
        n, projection = there.projection(I, J)
        offset, relative = minus(there.x[J], there.x[I]), minus(there.v[J], there.v[I])
        vectors = {"offset": offset, "v": there.v[J], "relative": relative, "n": n}
        rows.append(
            {
                "node": J,
                **{f"{name}_{j + 1}": float(c) for name, vector in vectors.items() for j, c in enumerate(vector)},
                "projection": projection,
                "complex_step": distance_rate(block, path, t, I, J),
                "difference": difference_quotient(block, path, t, step, I, J),
                "moves": _word(there, I, J),
            }
        )
    return rows


def _word(there: Snapshot, I: int, J: int) -> str:
    """away, towards or neither, by the sign of (x - x_I).(v - v_I), which is exact."""
    rate = dot(minus(there.x[J], there.x[I]), minus(there.v[J], there.v[I]))
    return {1: "away", -1: "towards", 0: "neither"}[Exact().sign(rate)]


def every_pair(block: Block, paths: Sequence[Path], times: Sequence[Fraction], step: Fraction) -> list[Row]:
    """All pairs of a node and its neighbours: how many part, approach or do neither, and how well n.(v - v_I) tells.

    wrong: pairs whose distance, from its exact squares a little before and after, does otherwise than the sign says. without:
    pairs for which n.v, the centre's velocity being left out, has another sign. Gaps are the largest |n.(v - v_I) - rate|.
    """
    rows = []
    for path in paths:
        for t in times:
            there = snapshot(block, path, t)
            row: Row = {"motion": path(t).name, "time": str(t), "pairs": 0, "away": 0, "towards": 0, "neither": 0}
            row |= {"wrong": 0, "without": 0, "speed": 0.0, "complex_step": 0.0, "coarse": 0.0, "fine": 0.0}
            little = Fraction(1, 10**6)
            before, after = ([path(t + s * little).forth(X) for X in block.nodes] for s in (-1, 1))
            for I, J in _pairs(block, there, range(len(block.nodes))):
                word, projection = _word(there, I, J), there.projection(I, J)[1]
                grows = Exact().sign(squared(after[J], after[I]) - squared(before[J], before[I]))
                alone = Exact().sign(dot(minus(there.x[J], there.x[I]), there.v[J]))
                sign = {"away": 1, "towards": -1, "neither": 0}[word]
                row["pairs"] += 1
                row[word] += 1
                row["wrong"] += grows != sign
                row["without"] += alone != sign
                row["speed"] = max(row["speed"], abs(projection))
                gap = abs(projection - distance_rate(block, path, t, I, J))
                row["complex_step"] = max(row["complex_step"], gap)
                for name, s in (("coarse", step), ("fine", step / 2)):
                    gap = abs(projection - difference_quotient(block, path, t, s, I, J))
                    row[name] = max(row[name], gap)
            rows.append(row)
    return rows


def field(block: Block, centre: int, path: Path, t: Fraction, radii: int, angles: int) -> list[Row]:
    """n.(v - v_I) at points x about the centre, on circles up to the support's edge: the material there is found by back(x)."""
    D, there = Duals(Exact(), 1), snapshot(block, path, t)
    x_I, v_I = ([float(c) for c in vector[centre]] for vector in (there.x, there.v))
    rows = []
    for circle in range(radii):
        r = float(block.support) * (circle + 1) / radii
        for point in range(angles + 1):
            n = np.cos(2 * pi * point / angles), np.sin(2 * pi * point / angles)
            X = path(t).back(tuple(Fraction(float(c + r * m)) for c, m in zip(x_I, n, strict=True)))
            v = [float(c.partials[0]) for c in path(D.variable(t, 0)).forth(tuple(map(D.number, X)))]
            value = sum(m * (c - b) for m, c, b in zip(n, v, v_I, strict=True))
            offset = {"offset_1": float(r * n[0]), "offset_2": float(r * n[1])}
            rows.append({"circle": circle, "point": point, **offset, "projection": float(value)})
    return rows
