"""Check of nodal gradient operators that somebody else has computed."""

from collections.abc import Iterable

import numpy as np

from rkverify.check import findings
from rkverify.check.causes import by_sums
from rkverify.check.choices import Cause, worst_and_spread
from rkverify.check.entries import Entries
from rkverify.check.held import Held, held_against, largest, unmatched
from rkverify.check.lost import lost_neighbour
from rkverify.check.report import Finding, Report, digits, listed
from rkverify.check.schemes import (
    Alternative,
    GradientClaim,
    both_changed,
    boundary_of,
    other_schemes,
    other_shapes,
    predicted_gradients,
    sizes_and_rounding,
)
from rkverify.check.shape import coarser
from rkverify.check.sums import Sum, residuals
from rkverify.errors import RkverifyError
from rkverify.solid.kernel_values import Array

ROWS = "cell"
SAMPLE = 12
"""Cells on which an alternative is tried first."""


def check_gradients(claim: GradientClaim, theirs: Entries, tolerance: float = 0.0) -> Report:
    """Whether `theirs` (bx, by, bz by cell and node, cells numbered as their nodes) are what is claimed; if not, what they are.

    tolerance: allowed besides rounding, relative to the largest number of a column. Raises what the claimed operator raises.
    """
    theirs = coarser(theirs, tolerance)
    sizes, rounding = sizes_and_rounding(claim)
    held = _hold(claim, theirs, sizes, rounding)
    positions = claim.cloud.positions
    everywhere = np.full(len(claim.cloud), rounding)
    sums = residuals(theirs, positions, positions, 1 / sizes, everywhere, min(claim.cloud.order, 1))
    found = [
        *findings.of_digits(theirs),
        *findings.of_sums(sums, ROWS),
        *_constraint(claim, theirs, held),
        *findings.of_pairs(held, theirs, ROWS),
        *findings.of_agreement(held, theirs, ROWS),
    ]
    fine = all(finding.holds for finding in found)
    cause, advice = ("", ()) if fine else _cause(claim, theirs, held, sums, (sizes, rounding))
    return Report("the gradients are", ROWS, tuple(found), cause, advice, largest(held, theirs))


def _hold(claim: GradientClaim, theirs: Entries, sizes: Array, rounding: float, chosen: Array | None = None) -> Held:
    ours = predicted_gradients(claim, theirs.columns, chosen)
    allowed = rounding * np.maximum(ours.row_sums(), sizes[:, None]) + theirs.resolution
    return held_against(ours, theirs, allowed)


def _constraint(claim: GradientClaim, theirs: Entries, held: Held) -> list[Finding]:
    """sum_L A_L b_iI^L = integral of Psi_I n_i over the boundary: asked of scni; of the others it is told that they break it."""
    if claim.cells is None:
        return []
    boundary = boundary_of(claim)
    measured = claim.measures
    volume = np.stack([theirs.matrix(c).T @ measured for c in range(len(theirs.columns))])
    if boundary is None:
        return []
    off = abs(volume - boundary)
    bound = np.zeros_like(off)
    for c in range(len(theirs.columns)):
        np.add.at(bound[c], held.gap.nodes, (measured * held.allowed[:, c])[held.gap.rows])
    # a node that no cell sees has no say
    excess = off / np.maximum(bound, np.finfo(float).tiny)
    axis, node = np.unravel_index(int(excess.argmax()), excess.shape)
    holds = bool((off <= bound).all())
    size, allowed = float(off[axis, node]), float(bound[axis, node])
    says = f"the integration constraint sum_L A_L b^L = integral of Psi n over the boundary holds, to {digits(float(off.max()))}"
    if not holds:
        says = (
            f"the integration constraint is broken: {theirs.columns[axis]} of node {node} is off by {digits(size)}, allowed "
            f"{digits(allowed)}"
        )
    return [Finding("integration constraint", holds, says, size, allowed)]


def _cause(claim: GradientClaim, theirs: Entries, held: Held, sums: list[Sum], scale: tuple[Array, float]) -> Cause:
    """What explains the numbers, the first of: the claim, another scheme, other shape functions, neighbours, both, the sums."""
    if held.fits:
        bad = [s.name for s in sums if not s.holds] or ["the boundary"]
        return f"the numbers are what is claimed, but that does not reproduce {listed(bad)}.", (
            "take another integration",
        )

    def explained(others: Iterable[Alternative], all_of_them: bool) -> Cause | None:
        return _explained(claim, theirs, held, scale, others, all_of_them)

    return (
        explained(other_schemes(claim), True)
        or explained(other_shapes(claim), False)
        or _left_out(held, theirs)
        or lost_neighbour(claim, theirs, held)
        or explained(both_changed(claim), False)
        or by_sums(sums, held, ROWS)
    )


def _explained(
    claim: GradientClaim, theirs: Entries, held: Held, scale: tuple[Array, float], others: Iterable[Alternative], all_of_them: bool
) -> Cause | None:  # fmt: skip
    """The first alternative that gives theirs, or all of them, tried on a sample of cells first."""
    sample = worst_and_spread(held, SAMPLE, claim.owners)
    some = theirs.only(sample)
    fitting: list[tuple[str, str, float]] = []
    for says, advice, other in others:
        try:
            if not _hold(other, some, *scale, sample).fits:
                continue
            again = _hold(other, theirs, *scale)
        except RkverifyError:
            continue  # such gradients do not exist here: it is not this one
        if again.fits:
            fitting.append((says, advice, again.worst))
            if not all_of_them:
                break
    if not fitting:
        return None
    names = " or ".join(says for says, _, _ in fitting)
    worst = max(worst for _, _, worst in fitting)
    return (
        f"your numbers have {names}, and what is claimed is {claim.scheme.name} and the kernel {claim.cloud.kernel.name}; so read they "
        f"agree with ours to {digits(worst)}, as claimed they are up to {digits(held.worst)} off.",
        (*(advice for _, advice, _ in fitting), f"or change the code to {claim.scheme.name}"),
    )


def _left_out(held: Held, theirs: Entries) -> Cause | None:
    missing, extra = unmatched(held, theirs)
    cells = set(np.flatnonzero((held.excess > 1).any(axis=1)).tolist())
    if extra or not missing or {cell for cell, _ in missing} != cells:
        return None
    places = listed([f"node {I} in the gradient of cell {L}" for L, I in missing], 4)
    what = "missing neighbour" if len(missing) == 1 else f"{len(missing)} missing neighbours"
    return (
        f"{what}: {places}; all other cells agree with ours.",
        (
            "look at the neighbour search on the boundary of this cell: b_I^L is not zero where the support of I covers any of it",
        ),
    )
