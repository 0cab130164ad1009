"""What rounding in double precision can do to a formula, computed: the width of its enclosure with 53 bits.

A ball of 53 bits carries the rounding of every operation to the result, multiplied by the condition of what follows. It
holds for the transcription's own sequence of operations; another sequence of about as many operations has a bound of the
same size, and both grow with the same condition number. Data that doubles hold exactly enter without error.
"""

from collections.abc import Callable, Mapping

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.certified import interval


class InDoubles(Ball):
    """Enclosures that round as doubles do: 53 bits, and a unit of rounding that decisions know of."""

    def __init__(self) -> None:
        super().__init__(13)
        self.bits = 53
        self.name = "ball of 53 bits"
        self.epsilon = 2.0**-52


def rounding_bounds(formula: Callable[[Arithmetic], Mapping[str, Scalar]]) -> dict[str, float]:
    """For every number that a formula gives: the largest distance of its enclosure from its middle.

    >>> bounds = rounding_bounds(lambda K: {"third": K.number(1) / 3, "half": K.number(1) / 2})
    >>> bounds["half"] == 0, 2**-56 < bounds["third"] < 2**-52
    (True, True)
    """
    widths = {}
    for name, value in formula(InDoubles()).items():
        low, high = interval(value)
        widths[name] = float((high - low) / 2)
    return widths
