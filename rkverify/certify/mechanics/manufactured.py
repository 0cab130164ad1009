"""Manufactured solutions: a displacement is chosen, and the body force and tractions that hold it are computed from it.

u_1 = a sin(pi x) cos(pi y / 2), u_2 = a sin(pi x / 2 + 1/2) sin(pi y / 2 + 1) on the unit square: nothing vanishes along a side. Displacements are
given on three sides in the sense of Nitsche, tractions on the side x = 1.
"""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rkverify.certify.mechanics.patch import MODULI
from rkverify.certify.mechanics.specimens import Specimen, square
from rkverify.errors import RkverifyError
from rkverify.readings import NodalIntegration
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.law import Hyperelastic
from rkverify.solid.materials.linear_elastic import LinearElastic
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.solid.mechanics.body import Body, body
from rkverify.solid.mechanics.boundary import boundary
from rkverify.solid.mechanics.nitsche import nitsche
from rkverify.solid.mechanics.statics import Problem, equilibrium_in_steps, scaled

Row = dict[str, Any]
STEP = 1e-100
SMOOTHINGS = 3
ERRORS = ("displacement", "smoothed", "gradient")
LAWS: dict[str, tuple[Hyperelastic, float, int]] = {
    "linear elastic": (LinearElastic(MODULI), 0.1, 1),
    "neo-Hookean": (NeoHookean(MODULI), 0.05, 2),
}
"""Law, amplitude a and load steps."""


@dataclass(frozen=True)
class Solution:
    """The chosen displacement with amplitude a, for a law."""

    law: Hyperelastic
    amplitude: float

    def u(self, X: Array) -> Array:
        """The displacement (n, 2); complex X pass through."""
        x, y = np.pi * X[:, 0], np.pi * X[:, 1]
        parts = [np.sin(x) * np.cos(y / 2), np.sin(x / 2 + 0.5) * np.sin(y / 2 + 1)]
        return self.amplitude * np.stack(parts, axis=1)

    def F(self, X: Array) -> Array:
        """1 + grad u (n, 2, 2)."""
        x, y = np.pi * X[:, 0], np.pi * X[:, 1]
        first = [np.pi * np.cos(x) * np.cos(y / 2), -np.pi / 2 * np.sin(x) * np.sin(y / 2)]
        second = [
            np.pi / 2 * np.cos(x / 2 + 0.5) * np.sin(y / 2 + 1),
            np.pi / 2 * np.sin(x / 2 + 0.5) * np.cos(y / 2 + 1),
        ]
        return np.eye(2) + self.amplitude * np.stack([np.stack(first, -1), np.stack(second, -1)], axis=1)

    def stress(self, X: Array) -> Array:
        """P (n, 2, 2)."""
        return self.law.stress(self.F(X))

    def body_force(self, X: Array) -> Array:
        """b0_i = -dP_ij/dX_j (n, 2), by complex steps."""
        steps = 1j * STEP * np.eye(2)
        return -sum((self.stress(X + steps[j])[:, :, j].imag / STEP for j in range(2)), np.zeros_like(X))


@dataclass(frozen=True)
class Case:
    """What is tried: law, integration with its edge rule, order with its support ratio, kind of nodes."""

    law: str
    integration: NodalIntegration
    rule: str
    order: int
    support_ratio: float
    kind: str


def errors(case: Case, divisions: int, seed: int) -> Row:
    """Errors in L2 at the nodes, (sum_L A_L |u^h - u|^2)^(1/2) with u^h - u as it is and smoothed SMOOTHINGS times, and of F.

    Smoothing e_L -> sum_I Psi_I(X_L) e_I takes away waves of two spacings. Infinite where no equilibrium was found.
    """
    found, amplitude, steps = LAWS[case.law]
    solution = Solution(found, amplitude)
    specimen = square(case.kind, divisions, seed)
    near = specimen.cloud(case.support_ratio, case.order)
    row = {**asdict(case), "h": specimen.spacing, "count": len(near)}
    try:
        b = body(near, specimen.operator(near, case.integration, case.rule), found)
        return {**row, **_errors(solution, b, _problem(solution, b, specimen, case.rule), steps)}
    except RkverifyError:
        return {**row, **dict.fromkeys(ERRORS, float("inf"))}


def _problem(solution: Solution, b: Body, specimen: Specimen, rule: str) -> Problem:
    held = boundary(b.cloud, specimen.cells, rule, lambda X: X[:, 0] < 1 - 1e-9)
    pulled = boundary(b.cloud, specimen.cells, rule, lambda X: X[:, 0] > 1 - 1e-9)
    traction = np.einsum("qij,qj->qi", solution.stress(pulled.points), pulled.normals)
    load = b.body_force(solution.body_force(b.cloud.positions)) + pulled.traction(traction)
    return Problem((nitsche(b, held, solution.u(held.points)),), load)


def _errors(solution: Solution, b: Body, problem: Problem, steps: int) -> Row:
    d = equilibrium_in_steps(b, [scaled(problem, (n + 1) / steps) for n in range(steps)]).displacements
    X, A = b.cloud.positions, b.operator.measures
    off = smooth = b.values @ d - solution.u(X)
    for _ in range(SMOOTHINGS):
        smooth = b.values @ smooth
    slope = (b.deformation(d) - solution.F(X)).reshape(len(X), 4)
    return {
        name: float(np.sqrt(A @ (values**2).sum(axis=1)))
        for name, values in zip(ERRORS, (off, smooth, slope), strict=True)
    }
