"""The base state of Section 4: a uniform infinite lattice with spacing h, stress sigma and velocity v = V + Q x."""

from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput
from rkverify.kernels import Kernel, kernel
from rkverify.readings import Readings

KINDS = ("x", "v", "stress", "edge", "measure")
"""What a chain's state consists of, in the order of its rates."""


@dataclass(frozen=True)
class Base:
    """The base state: R = a/h and sigma/C^sigma dimensionless, Q in 1/time, h a length, V a velocity; C^sigma = 1.

    Numbers may be strings such as "3/2", which are exact.
    """

    support_ratio: Scalar
    readings: Readings
    stress_ratio: Scalar = 0
    velocity_gradient: Scalar = 0
    spacing: Scalar = 1
    frame_velocity: Scalar = 0
    kernel: str | Kernel = "cubic"
    order: int = 1
    density: Scalar = 1

    def __post_init__(self) -> None:
        """Raises BadInput for a kernel whose second derivative jumps, which has no linearisation; UnknownName."""
        chosen = kernel(self.kernel) if isinstance(self.kernel, str) else self.kernel
        if chosen.continuity < 2:
            raise BadInput(
                f"kernel {chosen.name!r} is not of class C2, and nodes or cell edges may sit on its joints: there is no "
                "linearisation; choose cubic, quartic, quintic, wendland-c2 or wendland-c4"
            )

    @property
    def kinds(self) -> tuple[str, ...]:
        """The parts of the state that change in these readings."""
        r = self.readings
        wanted = {
            "x": True,
            "v": True,
            "stress": r.stress_law != "literal",
            "edge": r.cell_edges == "material",
            "measure": r.cell_measure == "material",
        }
        return tuple(kind for kind in KINDS if wanted[kind])

    def is_at_rest(self, K: Arithmetic) -> bool:
        """Whether nothing moves in the base, and nodes move with their own coefficients."""
        still = K.sign(K.number(self.velocity_gradient)) == 0 and K.sign(K.number(self.frame_velocity)) == 0
        return still and self.readings.node_motion == "coefficient"

    def reach(self, K: Arithmetic) -> tuple[int, int]:
        """How many cells to each side a node's equation involves, and how many nodes these involve in turn."""
        R = K.witness(K.number(self.support_ratio))
        cells = int(R + K.witness(K.ratio(1, 2))) + 1
        return cells, cells + int(R) + 2
