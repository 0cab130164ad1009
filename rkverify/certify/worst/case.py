"""A named worst case: what goes in, to the last bit, what is measured, and which search found it."""

from dataclasses import dataclass

import numpy as np

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.paper.approximation import Approximation, approximation
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.domain import Box, box
from rkverify.solid.kernel_values import Array

APPROXIMATION = ("supports", "kernel", "order", "window")
DIGITS = 40
"""Of the reference, and ten more in hand: condition numbers up to 10^16 leave more than twice a double's."""

KNOWN = 1e-30
"""Of the largest bound of a case: what the reference, with 10^-34 of a double's unit, may itself be off. Kernels at the very edge

of a support, (1 - z)^6 = 10^-96, are below that."""


@dataclass(frozen=True)
class Kind:
    """What is measured: in words, its unit, and which inputs it takes beside the nodes."""

    words: str
    unit: str
    takes: tuple[str, ...]


KINDS: dict[str, Kind] = {
    "value": Kind("shape functions", "1", (*APPROXIMATION, "point")),
    "first": Kind("first derivatives", "1/length", (*APPROXIMATION, "reading", "point")),
    "second": Kind("second derivatives", "1/length^2", (*APPROXIMATION, "reading", "point")),
    "eigenvalue": Kind("smallest eigenvalue of the moment matrix", "1", (*APPROXIMATION, "point")),
    "pivot": Kind("what is left of a pivot that is zero", "1", (*APPROXIMATION, "point")),
    "psi_star": Kind("Psi*, two routes", "1/time", (*APPROXIMATION, "point", "velocity", "node_velocities")),
    "true_rate": Kind("material rate, two routes", "1/time", (*APPROXIMATION, "point", "velocity", "node_velocities")),
    "smoothed": Kind("smoothed gradients, two routes", "1/length", (*APPROXIMATION, "cell")),
    "measures": Kind("sum of the cells' measures", "length^d", ("low", "high")),
    "closure": Kind("sum of a cell's area vectors", "length^(d-1)", ("low", "high")),
    "patch": Kind("linear patch test", "length", (*APPROXIMATION, "low", "high")),
}
"""quantity -> what it is. Each has a bound of its own, which some case of it must come near to."""


@dataclass(frozen=True, eq=False)
class WorstCase:
    """The largest error when it was found; nodes (N, d), and what the quantity takes: supports (N,), kernel, order, window, reading, a point (d,), velocities of the

    material there (d,) and of the nodes (N, d), a cell's corners (n, d), the lowest and highest corner (d,) of a box. Any
    unit of length and of time.
    """

    name: str
    quantity: str
    found_by: str
    error: float
    nodes: Array
    supports: Array | None = None
    kernel: str | None = None
    order: int | None = None
    window: str | None = None
    reading: str | None = None
    point: Array | None = None
    velocity: Array | None = None
    node_velocities: Array | None = None
    cell: Array | None = None
    low: Array | None = None
    high: Array | None = None

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return int(self.nodes.shape[1])

    def array(self, name: str) -> Array:
        """An input that the quantity takes."""
        found: Array = np.asarray(getattr(self, name), dtype=float)
        return found

    def cloud(self) -> Cloud:
        """The approximation in double precision."""
        assert self.kernel is not None
        assert self.order is not None
        return cloud(self.nodes, self.array("supports"), self.kernel, self.order, self.window or "radial")  # type: ignore[arg-type]

    def literal(self, K: Multiprecision | None = None) -> Approximation:
        """The transcription with many digits, on the same doubles."""
        given = self.cloud()
        many = Multiprecision(DIGITS) if K is None else K
        return approximation(given.positions.tolist(), given.supports.tolist(), many, given.kernel, given.order, given.window)  # fmt: skip

    def box(self) -> Box:
        """The domain of the cells."""
        return box(self.array("low"), self.array("high"))


ARRAYS = ("nodes", "supports", "point", "velocity", "node_velocities", "cell", "low", "high")
"""The inputs that are arrays of doubles."""
