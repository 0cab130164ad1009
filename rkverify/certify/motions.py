"""Motions whose inverses are as elementary as they are, so that a material point is found back exactly: functions of time t.

Each is written for the numbers of any arithmetic, and is at rest at t = 0.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from rkverify.arithmetic.base import Scalar
from rkverify.paper.approximation import Vector

Map = Callable[[Vector], Vector]


@dataclass(frozen=True)
class Motion:
    """x = forth(X) and X = back(x) at one time."""

    name: str
    forth: Map
    back: Map


Path = Callable[[Scalar], Motion]
"""A motion over time."""


def translation(t: Scalar) -> Motion:
    """x_i = X_i + (i + 1) t"""
    return Motion(
        "translation",
        lambda X: tuple(c + (i + 1) * t for i, c in enumerate(X)),
        lambda x: tuple(c - (i + 1) * t for i, c in enumerate(x)),
    )


def turn(t: Scalar) -> Motion:
    """A turn of the first two axes by the angle whose half has the tangent t: cosine and sine are rational in t."""
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    return Motion(
        "turn",
        lambda X: (c * X[0] - s * X[1], s * X[0] + c * X[1], *X[2:]),
        lambda x: (c * x[0] + s * x[1], c * x[1] - s * x[0], *x[2:]),
    )


def stretch(t: Scalar) -> Motion:
    """x_1 = (1 + t) X_1, and the others divided by it."""
    return Motion(
        "stretch",
        lambda X: ((1 + t) * X[0], *(c / (1 + t) for c in X[1:])),
        lambda x: (x[0] / (1 + t), *(c * (1 + t) for c in x[1:])),
    )


def grading(t: Scalar) -> Motion:
    """x_1 = X_1 / (1 + t X_1 / 10): a stretch that differs from place to place."""
    return Motion(
        "grading",
        lambda X: (X[0] / (1 + t * X[0] / 10), *X[1:]),
        lambda x: (x[0] / (1 - t * x[0] / 10), *x[1:]),
    )


def _sheared(name: str, t: Scalar, power: int) -> Motion:
    """x_1 = X_1 and x_i+1 = X_i+1 + t x_i^power, one axis after the other."""

    def forth(X: Vector) -> Vector:
        x = [X[0]]
        for c in X[1:]:
            x.append(c + t * x[-1] ** power)
        return tuple(x)

    def back(x: Vector) -> Vector:
        return (x[0], *(c - t * before**power for before, c in pairwise(x)))

    return Motion(name, forth, back)


def shear(t: Scalar) -> Motion:
    """Simple shear."""
    return _sheared("shear", t, 1)


def bending(t: Scalar) -> Motion:
    """Lines become parabolas."""
    return _sheared("bending", t / 4, 2)


def _one_after_the_other(name: str, parts: Sequence[Motion]) -> Motion:
    def forth(X: Vector) -> Vector:
        for part in parts:
            X = part.forth(X)
        return X

    def back(x: Vector) -> Vector:
        for part in reversed(parts):
            x = part.back(x)
        return x

    return Motion(name, forth, back)


def together(t: Scalar) -> Motion:
    """A stretch, then a turn, then bending."""
    return _one_after_the_other("stretch, turn, bending", (stretch(t), turn(t), bending(t)))


def flexure(t: Scalar) -> Motion:
    """x_1 = (1 + t) X_1, x_2 = X_2/(1 + t) + t x_1^2/6: a block is drawn out and its long lines become parabolas; det F = 1."""
    return _one_after_the_other("stretch, bending", (stretch(t), bending(2 * t / 3)))


RIGID: tuple[Callable[[Scalar], Motion], ...] = (translation, turn)
ON_A_LINE: tuple[Callable[[Scalar], Motion], ...] = (translation, stretch, grading)
IN_SPACE: tuple[Callable[[Scalar], Motion], ...] = (translation, turn, stretch, shear, bending, together)


def motions(dimension: int) -> tuple[Callable[[Scalar], Motion], ...]:
    """The motions, each a function of the time t, that there are in so many dimensions."""
    return ON_A_LINE if dimension == 1 else IN_SPACE
