"""A kernel of which only its values at a few places are known, each by a name: closed forms for any kernel.

At the nodes and cell edges of a uniform lattice only phi(0), phi(h/a), phi(h/2a), … and their derivatives occur.
With these as generators of a field of rational functions the same lines of `paper/` give the closed form.
"""

from dataclasses import dataclass
from fractions import Fraction

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Dual, Duals
from rkverify.errors import BadInput


@dataclass(frozen=True)
class NamedFunction:
    """A function of z known by a value and a slope at each of some places; zero from z = 1 on.

    places: z in terms of the sample -> generator of the value, generator of the slope.
    """

    places: dict[Fraction, tuple[Scalar, Scalar]]
    over: "NamedFunction | None" = None

    def __call__(self, z: Scalar, K: Arithmetic) -> Scalar:
        """The named value; through duals, with its named slope."""
        base = K.base if isinstance(K, Duals) else K
        value = z.value if isinstance(z, Dual) else z
        place = base.witness(value)
        if place >= 1:
            return K.zero()
        if place not in self.places:
            raise BadInput(f"the kernel has no name for its value at z = {place}: add the place")
        known, slope = self.places[place]
        return z.scaled(known, slope) if isinstance(z, Dual) else known

    def derivative(self, order: int = 1) -> "NamedFunction":
        """The slope as a function; only `over_z` of it is ever used by a first-order linearisation."""
        if order != 1 or self.over is None:
            raise BadInput("a named kernel has its first derivative over z and no other")
        return self.over

    def over_z(self, z: Scalar, K: Arithmetic) -> Scalar:
        """The value of the function that stands for phi'(z)/z."""
        return self(z, K)


@dataclass(frozen=True)
class NamedKernel:
    """Stands in for a `Kernel` in an `Approximation`."""

    name: str
    phi: NamedFunction
    continuity: int = 2
    smoothness_at_node: int = 2
