"""The moving block of Figures 2 and 3: jittered nodes about the origin, with rational places, and its node that is looked at."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from rkverify.arithmetic.base import Scalar
from rkverify.certify.samples import jittered_grid
from rkverify.paper.approximation import Vector
from rkverify.paper.kernel_rates import dot, minus


@dataclass(frozen=True)
class Block:
    """per_side by per_side nodes about spacing 1 apart, each moved by up to a quarter; support radius a for all of them."""

    per_side: int
    support: Fraction
    seed: int

    @cached_property
    def nodes(self) -> list[Vector]:
        """X_I, the block's middle being the origin."""
        middle = Fraction(self.per_side - 1, 2)
        return [tuple(c - middle for c in X) for X in jittered_grid(2, self.per_side, self.seed)]

    @property
    def half(self) -> Fraction:
        """Half the block's side: it ends half a spacing beyond the grid."""
        return Fraction(self.per_side, 2)

    def node_at(self, place: Vector) -> int:
        """The node nearest to a place."""
        return min(range(len(self.nodes)), key=lambda I: squared(self.nodes[I], place))


def squared(x: Vector, y: Vector) -> Scalar:
    """|x - y|^2"""
    offset = minus(x, y)
    return dot(offset, offset)
