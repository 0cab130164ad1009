"""Plates of a law with memory, led through cycles in the reference configuration: Lagrangian equilibrium in load steps with SCNI.

J2 plasticity with Jaumann's rate, plane strain. The boundary is held in the sense of Nitsche without the term that an energy would need.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.certify.mechanics.patch import MODULI
from rkverify.certify.mechanics.specimens import Specimen
from rkverify.solid.cells import Cells
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.j2 import J2
from rkverify.solid.materials.jaumann import Jaumann
from rkverify.solid.materials.kinematics import green_strain
from rkverify.solid.materials.law import Law, State
from rkverify.solid.mechanics.body import Body, body
from rkverify.solid.mechanics.boundary import Boundary, boundary
from rkverify.solid.mechanics.nitsche import nitsche
from rkverify.solid.mechanics.statics import Equilibrium, Problem, equilibrium

Row = dict[str, Any]
YIELD, HARDENING = 0.02, 0.1
"""sigma_y and H in units of mu."""
LAW = J2(Jaumann(MODULI), YIELD, HARDENING)
SUPPORT_RATIO = 2.3
ZERO = 1e-12
"""Plastic strain that has grown by less has not: rounding."""
EDGE = 1e-9
NEWTON_STEPS = 20
GUESSED = 0.5
"""The share of a step of unloading that Newton's method begins with: at its start the tangent would still be that of plastic flow."""


@dataclass(frozen=True)
class Plate:
    """A body with its cells and the parts of the boundary that are held."""

    body: Body
    cells: Cells
    held: Boundary

    def led(self, found: Equilibrium, given: Array) -> Problem:
        """The condition u = given (Q, 2) on the held part, without loads."""
        condition = nitsche(found.body, self.held, given, symmetric=False)
        return Problem((condition,), np.zeros_like(self.body.cloud.positions))

    @property
    def start(self) -> Equilibrium:
        """Nothing is displaced."""
        return Equilibrium(np.zeros_like(self.body.cloud.positions), self.body, ())


def homogeneous(specimen: Specimen, law: Law, where: Callable[[Array], Array] | None = None) -> Plate:
    """The specimen held all around, or where `where` says."""
    near = specimen.cloud(SUPPORT_RATIO)
    made = body(near, specimen.operator(near, "scni"), law)
    return Plate(made, specimen.cells, boundary(near, specimen.cells, where=where))


def follow(plate: Plate, path: Sequence[Array]) -> list[Equilibrium]:
    """Equilibria with u = (F - 1) X on the held part for one F (2, 2) after the other."""
    found, all_found = plate.start, []
    for F in path:
        problem = plate.led(found, plate.held.points @ (F - np.eye(2)).T)
        found = equilibrium(found.body, problem, found.displacements)
        all_found.append(found)
    return all_found


def cycle(kind: str, amplitude: float, steps: int) -> list[Array]:
    """A stretch along x_1 (1 + e, 1 - e/2), or a shear e, with e = amplitude sin t through one whole turn; back at F = 1 at the end."""
    found = []
    for n in range(1, steps + 1):
        e = amplitude * np.sin(2 * np.pi * n / steps) if n < steps else 0.0
        found.append(np.array([[1 + e, 0], [0, 1 - e / 2]]) if kind == "tension" else np.array([[1, e], [0, 1]]))
    return found


def material_point(law: Law, path: Sequence[Array]) -> list[State]:
    """The states of one point alone along the path."""
    state, found = law.start(1, 2), []
    for F in path:
        state = law.advance(F[None], state)
        found.append(state)
    return found


def against_the_point(specimen: Specimen, law: Law, kind: str, amplitude: float, steps: int) -> list[Row]:
    """Along a cycle: stress and plastic strain of the point, their largest difference in the body, and the yield function in the body.

    Differences of stress over mu. yield_function: the largest f, and the largest |f| where plastic strain has grown in the step.
    """
    path = cycle(kind, amplitude, steps)
    rows, before = [], np.zeros(len(specimen.positions))
    for F, point, found in zip(path, material_point(law, path), follow(homogeneous(specimen, law), path), strict=True):
        state = found.body.state
        row: Row = {
            "path": kind,
            "strain": float(F[0, 0] - 1 if kind == "tension" else F[0, 1]),
            "stress": float(point.sigma[0, 0, 0] if kind == "tension" else point.sigma[0, 0, 1]) / MODULI.shear,
            "plastic_strain": float(point.alpha[0]),
            "stress_difference": float(abs(state.sigma - point.sigma).max()) / MODULI.shear,
            "plastic_difference": float(abs(state.alpha - point.alpha).max()),
        }
        f = law.yield_function(state) / MODULI.shear if isinstance(law, J2) else np.zeros(1)
        grown = state.alpha > before + ZERO
        row["yield_function"] = float(f.max()) if isinstance(law, J2) else np.nan
        row["off_the_surface"] = float(abs(f[grown]).max()) if grown.any() else 0.0
        rows.append(row)
        before = state.alpha
    return rows


def released(law: Law, loaded: State, steps: int) -> list[Array]:
    """F (2, 2) on the way to where one point has P = 0: steps along a straight line to a first guess of it, and one that corrects it."""
    guess, state, found = _without_stress(law, loaded), loaded, []
    for n in range(1, steps + 1):
        found.append(loaded.F[0] + (guess - loaded.F[0]) * n / steps)
        state = law.advance(found[-1][None], state)
    return [*found, _without_stress(law, state)]


def _without_stress(law: Law, before: State) -> Array:
    """F (2, 2) at which P = 0 in one step, by Newton's method; a turn about it leaves P at 0, so that the least step is taken."""
    F = before.F.copy()
    for _ in range(NEWTON_STEPS):
        P, A = law.advance(F, before).P, law.tangent(F, before)[0].reshape(4, 4)
        F = F - np.linalg.lstsq(A, P[0].ravel(), rcond=1e-9)[0].reshape(1, 2, 2)
    return F[0]


def residual_strain(specimen: Specimen, law: Law, kind: str, amplitude: float, steps: int) -> Row:
    """A body loaded to the amplitude, then held on one side and let go by tractions on the others: what stays, of strain and of stress.

    loaded, stays: the largest component of the Green strain of the point before and after; difference: the largest of the body's F from it.
    """
    loading = cycle(kind, amplitude, 4 * steps)[:steps]
    found = follow(homogeneous(specimen, law), loading)[-1]
    state = material_point(law, loading)[-1]
    side = homogeneous(specimen, law, where=lambda x: x[:, 0] < EDGE)
    rest = boundary(side.body.cloud, side.cells, where=lambda x: x[:, 0] > EDGE)
    before = loading[-1]
    for F in released(law, state, steps):
        state = law.advance(F[None], state)
        held = side.led(found, side.held.points @ (F - np.eye(2)).T)
        load = rest.traction(rest.normals @ state.P[0].T)
        step = side.body.cloud.positions @ (F - before).T
        found = equilibrium(found.body, Problem(held.conditions, load), found.displacements + GUESSED * step)
        before = F
    return {
        "path": kind,
        "law": type(law).__name__,
        "loaded": float(abs(green_strain(loading[-1])).max()),
        "stays": float(abs(green_strain(F)).max()),
        "difference": float(abs(found.body.state.F - F).max()),
        "stress": float(abs(found.body.state.P).max()) / MODULI.shear,
    }


def uniaxial(specimen: Specimen, stretches: Sequence[float], steps: int) -> Row:
    """F = diag(lambda, 1) led from stretch to stretch with as many steps each, against the closed form in e = ln lambda.

    sigma_11 = kappa e + 2/3 q:  q = 2 mu (e - e_0) + q_0 between - and + (sigma_y + H alpha), which moves with 3 mu + H beyond.
    """
    path, first = [], 1.0
    for last in stretches:
        path += [np.diag([first + (last - first) * n / steps, 1.0]) for n in range(1, steps + 1)]
        first = last
    state = follow(homogeneous(specimen, LAW), path)[-1].body.state
    mu, q, alpha, e = MODULI.shear, 0.0, 0.0, 0.0
    for last in stretches:
        q, e = q + 2 * mu * (np.log(last) - e), float(np.log(last))
        more = max(float(abs(q)) - YIELD - HARDENING * alpha, 0.0) / (3 * mu + HARDENING)
        q, alpha = q - float(np.sign(q)) * 3 * mu * more, alpha + more
    exact = MODULI.bulk * e + 2 / 3 * q
    return {
        "steps": steps,
        "stress": float(exact) / mu,
        "stress_error": float(abs(state.sigma[:, 0, 0] - exact).max()) / mu,
        "plastic_strain": alpha,
        "plastic_error": float(abs(state.alpha - alpha).max()),
    }
