"""What a semi-discrete equation in the plane or in space depends on besides its nodes."""

from dataclasses import dataclass
from math import isfinite

import numpy as np

from rkverify.errors import BadInput, UnknownName
from rkverify.kernels import KERNELS, Kernel, kernel
from rkverify.readings import (
    CELL_MEASURES,
    DERIVATIVES,
    NODAL_INTEGRATIONS,
    CellMeasure,
    Derivative,
    NodalIntegration,
    Window,
    known_window,
)
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array

DEFAULT_RULES = {"scni": "trapezoid", "snni": "midpoint", "dni": ""}

LARGEST = 20.0
"""The patch around a node has some 50 R^2 nodes, and each of its cells 3 R^2 of them."""


@dataclass(frozen=True)
class Scheme:
    """Integration, support radius (length, the spacing being 1), and the readings that are left open.

    cell_measure: a_L is the measure of the Voronoi cell of the moving nodes (edges), grows as a' = a tr L (material), or is
    fixed. SCNI has a_L b^L as one integral over the cell's boundary: for it the reading plays no part. SNNI has squares or cubes
    of measure a_L with sides along the axes. edge_rule: trapezoid (default of scni), midpoint (default of snni), gauss:N.
    derivative: of DNI. Raises BadInput, UnknownName.
    """

    integration: NodalIntegration
    support: float
    edge_rule: str | None = None
    derivative: Derivative = "full"
    cell_measure: CellMeasure = "edges"
    kernel: str = "cubic"
    order: int = 1
    window: Window = "radial"

    def __post_init__(self) -> None:
        for kind, value, known in (
            ("integration", self.integration, NODAL_INTEGRATIONS),
            ("derivative", self.derivative, DERIVATIVES),
            ("cell measure", self.cell_measure, CELL_MEASURES),
            ("kernel", self.kernel, tuple(KERNELS)),
        ):
            if value not in known:
                raise UnknownName(kind, value, known)
        known_window(self.window)
        if not (isfinite(self.support) and self.support > 0):
            raise BadInput(f"support radius {self.support:g}: it must be positive and finite")
        if self.support > LARGEST:
            raise BadInput(f"support radius {self.support:g}: choose one up to {LARGEST:g} times the spacing")
        if self.order not in (0, 1, 2):
            raise BadInput(f"order {self.order} is not offered: choose 0, 1 or 2")
        if self.integration == "dni" and self.edge_rule is not None:
            raise BadInput("an edge rule is for scni and snni: DNI takes derivatives at the node; leave it out")
        if self.integration != "dni" and self.derivative != "full":
            raise BadInput(
                f"the derivative {self.derivative} is for dni: {self.integration} takes no derivative; leave it out"
            )

    @property
    def rule(self) -> str:
        """The rule on edges."""
        return self.edge_rule or DEFAULT_RULES[self.integration]

    @property
    def of_kernel(self) -> Kernel:
        """The kernel."""
        return kernel(self.kernel)

    @property
    def reach(self) -> float:
        """How far from a node its shape function may differ from zero in the plane."""
        return self.reach_in(2)

    def reach_in(self, dimension: int) -> float:
        """The same in 2 or 3 dimensions: for the tensor window to the corner of a square or cube."""
        return self.support * (dimension**0.5 if self.window == "tensor" else 1.0)

    def cloud(self, positions: Array) -> Cloud:
        """The approximation on nodes (N, d), real or complex, unchecked."""
        return Cloud(positions, np.full(len(positions), self.support), self.of_kernel, self.order, self.window)
