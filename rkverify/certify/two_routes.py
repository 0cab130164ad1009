"""Two routes to the same semi-discrete equations: the transcription with duals, and vectorised code with complex steps."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, cast

import numpy as np

from rkverify.arithmetic.dual import Dual, Duals
from rkverify.arithmetic.native import Exact, Float
from rkverify.kernels import kernel
from rkverify.paper.approximation import approximation
from rkverify.paper.cells import Cell
from rkverify.paper.lagrangian_equations import LagrangianChain, gradient
from rkverify.paper.shape import shape_functions
from rkverify.readings import (
    CELL_EDGES,
    CELL_MEASURES,
    CONVECTIONS,
    DERIVATIVES,
    MASSES,
    NODE_MOTIONS,
    STRESS_LAWS,
    SUPPORT_RADII,
    Derivative,
    Integration,
    Readings,
)
from rkverify.solid.bar import periodic_bar
from rkverify.stability import jacobian_paper, jacobian_solid
from rkverify.stability.lagrangian import StretchedBar, stencil, stencil_by_complex_step
from rkverify.stability.lattice_state import Base

Row = dict[str, Any]
AGREEMENT = 1e-12
"""What is asked for, relative to the largest coefficient; rounding alone leaves some 1e-15."""

BAR = "Lagrangian bar"

CHOICES: dict[str, Sequence[str]] = {
    "convection": CONVECTIONS,
    "derivative": DERIVATIVES,
    "stress_law": STRESS_LAWS,
    "node_motion": NODE_MOTIONS,
    "cell_edges": CELL_EDGES,
    "cell_measure": CELL_MEASURES,
    "support_radius": SUPPORT_RADII,
    "mass": MASSES,
}


def reading_changes() -> dict[str, dict[str, str]]:
    """The default readings, every other option by itself with N and without, and all choices changed at once."""
    changes: dict[str, dict[str, str]] = {"default": {}, "no N": {"convection": "none"}}
    for choice, options in CHOICES.items():
        for option in options[1:]:
            changes[f"{choice} = {option}"] = {choice: option}
            if choice != "convection":
                changes[f"{choice} = {option}, no N"] = {choice: option, "convection": "none"}
    return changes | {"all changed": {choice: options[1] for choice, options in CHOICES.items()}}


def stencil_rows(ratios: Sequence[str], s: str, Q: str, V: str, only: Sequence[str] = ()) -> list[Row]:
    """Whether the stencils of the two routes agree, for every reading, or those named, SCNI and DNI, every R."""
    rows = []
    changes = reading_changes()
    for name, change in {name: changes[name] for name in only or changes}.items():
        for integration in ("scni", "dni"):
            for R in ratios:
                base = Base(R, Readings(integration, **cast(Any, change)), s, Q, frame_velocity=V)
                one, other = jacobian_paper.linearise(base, Float()).stencil, jacobian_solid.stencil(base)
                rows.append(_row(name, integration, R, _apart(one, other), sum(map(len, other.values()))))
    return rows


def _apart(one: jacobian_paper.Stencil, other: jacobian_paper.Stencil) -> float:
    largest = max(abs(c) for part in other.values() for c in part.values())
    gaps = [
        abs(one[key].get(n, 0.0) - other[key].get(n, 0.0)) for key in other for n in one[key].keys() | other[key].keys()
    ]
    return float(max(gaps) / largest)


def _row(name: str, integration: str, R: str, gap: float, count: int) -> Row:
    return {
        "reading": name,
        "integration": integration,
        "support_ratio": R,
        "coefficients": count,
        "agree": gap <= AGREEMENT,
    }


def bar_rows(ratios: Sequence[str], s: str, F: str) -> list[Row]:
    """The same for the Lagrangian bar, DNI in every reading of the derivative."""
    rows = []
    for integration, derivative, R in [("scni", "full", R) for R in ratios] + [
        ("dni", derivative, R) for derivative in DERIVATIVES for R in ratios
    ]:
        base = StretchedBar(R, cast(Any, integration), s, F, derivative=cast(Any, derivative))
        one, other = stencil(base, Float()), stencil_by_complex_step(base)
        largest = max(map(abs, other.values()))
        gap = max(abs(one.get(n, 0.0) - c) for n, c in other.items()) / largest
        name = BAR if derivative == "full" else f"{BAR}, derivative = {derivative}"
        rows.append(_row(name, integration, R, gap, len(other)))
    return rows


UNEVEN = tuple(Fraction(n, 10) for n in (0, 10, 19, 30, 38, 50, 60, 69, 80))


def exact_chain(integration: Integration) -> tuple[LagrangianChain, list[Fraction]]:
    """A finite Lagrangian bar on uneven nodes with cells between their middles, and uneven displacements, in rationals."""
    K = Exact()
    A = approximation([[X] for X in UNEVEN], Fraction(7, 4), K)
    middles = [UNEVEN[0], *((p + q) / 2 for p, q in pairwise(UNEVEN)), UNEVEN[-1]]
    cells = {L: Cell(middles[L], middles[L + 1]) for L in range(len(UNEVEN))}
    gradients = {L: gradient(A, L, cell, integration, "full") for L, cell in cells.items()}
    shapes = {L: shape_functions(A, A.nodes[L]) for L in cells}
    chain = LagrangianChain(gradients, cells, Fraction(3, 2), Fraction(1), Fraction(1, 3), Fraction(6, 5), K, shapes)
    return chain, [X / 5 + X * (8 - X) / 97 for X in UNEVEN]


def force_is_energy_slope(integration: Integration) -> bool:
    """Whether (49) with (51) is the derivative of the stored energy with respect to every coefficient, exactly."""
    chain, u = exact_chain(integration)
    D = Duals(chain.K, len(u))
    dual = LagrangianChain(
        {L: {I: D.number(b) for I, b in row.items()} for L, row in chain.gradients.items()},
        {L: Cell(D.number(cell.left), D.number(cell.right)) for L, cell in chain.cells.items()},
        rho_0=D.number(chain.rho_0),
        modulus=D.number(chain.modulus),
        prestress=D.number(chain.prestress),
        stretch=D.number(chain.stretch),
        K=D,
    )
    energy = cast(Dual, dual.stored_energy([D.variable(p, I) for I, p in enumerate(u)]))
    return all(energy.partials[I] == chain.internal_force(I, u) for I in range(len(u)))


def load_totals() -> dict[str, bool]:
    """Whether (50) has the load's total, and does the virtual work of the load in u = X: sum_L b0 X_L A_L + h0 X_h."""
    chain, _ = exact_chain("scni")
    A = approximation([[X] for X in UNEVEN], Fraction(7, 4), chain.K)
    end = shape_functions(A, A.nodes[-1])
    b0, h0 = Fraction(5, 7), Fraction(-2, 3)
    forces = [chain.external_force(I, b0, h0, end) for I in range(len(UNEVEN))]
    total = b0 * (UNEVEN[-1] - UNEVEN[0]) + h0
    work = sum(b0 * X * chain.cells[L].measure for L, X in enumerate(UNEVEN)) + h0 * UNEVEN[-1]
    return {
        "total": sum(forces) == total,
        "virtual work": sum(f * X for f, X in zip(forces, UNEVEN, strict=True)) == work,
    }


def bar_residual(
    mass: str,
    R: float = 1.75,
    count: int = 14,
    integration: Integration = "scni",
    derivative: Derivative = "full",
    stretch: float = 1.2,
) -> float:
    """The largest residual of (48), or of (56) for the lumped mass, for accelerations of the vectorised bar, over them."""
    rng = np.random.default_rng(11)
    u = 0.05 * rng.standard_normal(count)
    state = (1.0, 1 / 3, stretch)
    bar = periodic_bar(count, 1.0, R, integration, derivative, kernel("cubic"), 1, state, cast(Any, mass))
    given = bar.acceleration(u)
    # Copies of the bar to both sides stand in for its periodicity.
    K, offset = Float(), count
    X = [float(J - offset) for J in range(3 * count)]
    A = approximation([[p] for p in X], R, K)
    around = range(offset - 6, offset + count + 6)
    cells = {L: Cell(X[L] - 0.5, X[L] + 0.5) for L in around}
    chain = LagrangianChain(
        {L: gradient(A, L, cell, integration, derivative) for L, cell in cells.items()},
        cells,
        1.0,
        state[0],
        state[1],
        state[2],
        K,
        {L: shape_functions(A, A.nodes[L]) for L in around},
    )
    displacements = [(state[2] - 1) * p + float(u[J % count]) for J, p in enumerate(X)]
    repeated = [float(given[J % count]) for J in range(3 * count)]
    if mass == "lumped":
        gaps = [chain.acceleration(I, displacements) - repeated[I] for I in range(offset, offset + count)]
    else:
        still = [0.0] * len(displacements)
        # Without acceleration the internal force is left, which the lumped bar turns into accelerations.
        lumped = periodic_bar(count, 1.0, R, integration, derivative, kernel("cubic"), 1, state).acceleration(u)
        gaps = [chain.residual(offset + I, displacements, repeated, 0.0) for I in range(count)]
        gaps += [chain.residual(offset + I, displacements, still, 0.0) + float(lumped[I]) for I in range(count)]
    return float(max(map(abs, gaps)) / abs(given).max())
