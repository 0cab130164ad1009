"""Which other choice explains shape functions that are not as claimed: hypotheses tried one after another."""

from dataclasses import replace

import numpy as np

from rkverify.check.claim import Claim, predicted
from rkverify.check.entries import Entries
from rkverify.check.held import Held, hold
from rkverify.check.hypotheses import DERIVATIVE_HYPOTHESES, HYPOTHESES, SLIPS, Hypothesis, Slip, variants
from rkverify.check.report import digits, listed
from rkverify.check.rounding import lengths_at
from rkverify.errors import RkverifyError
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours

SAMPLE = 60
"""Rows on which a hypothesis is tried first; one that holds there is then held against all."""

Cause = tuple[str, tuple[str, ...]]
"""What explains the numbers, and what to do."""


def other_choice(claim: Claim, theirs: Entries, held: Held) -> Cause | None:
    """The fewest changes of the claim that give theirs, in words; None where no hypothesis does."""
    rows = worst_and_spread(held, SAMPLE, np.arange(theirs.count))
    few, some = claim.at(rows), _renumbered(theirs, rows)
    values = [c for c, name in enumerate(theirs.columns) if name == "psi"]
    slopes = [c for c, name in enumerate(theirs.columns) if name != "psi"]
    # The values do not depend on the reading of the derivative: with them the choices are found first, the reading after.
    stages = [variants(few, HYPOTHESES, 2)] if values else [variants(few, (*HYPOTHESES, *DERIVATIVE_HYPOTHESES), 2)]
    for changes, changed in stages[0]:
        if values and _fits(changed, some.part(values)) is None:
            continue
        if not slopes:
            return _named(claim, theirs, held, changes, None)
        readings = variants(changed, DERIVATIVE_HYPOTHESES, 1) if values else iter([((), changed)])
        for reading, final in readings:
            if _fits(final, some) is not None:
                return _named(claim, theirs, held, (*changes, *reading), None)
            slip = _slip(final, some)
            if slip is not None:
                return _named(claim, theirs, held, (*changes, *reading), slip)
    return None


def _fits(claim: Claim, theirs: Entries) -> Held | None:
    try:
        held = hold(claim, theirs)
    except (RkverifyError, np.linalg.LinAlgError):
        return None  # such shape functions do not exist here: the hypothesis is not it
    return held if held.fits else None


def _slip(claim: Claim, theirs: Entries) -> Slip | None:
    try:
        right = predicted(claim, theirs.columns)
        lengths = lengths_at(claim.cloud, neighbours(claim.cloud, claim.points))
        fitting = (slip for slip in SLIPS if hold(claim, theirs, slip.act(right, lengths)).fits)
        return next(fitting, None)
    except (RkverifyError, np.linalg.LinAlgError):
        return None


def _named(
    claim: Claim, theirs: Entries, held: Held, changes: tuple[Hypothesis, ...], slip: Slip | None
) -> Cause | None:
    """The words for an explanation, after it was held against all rows."""
    changed = claim
    for hypothesis in changes:
        changed = hypothesis.change(changed)
    ours = predicted(changed, theirs.columns)
    if slip is not None:
        ours = slip.act(ours, lengths_at(changed.cloud, neighbours(changed.cloud, claim.points)))
    final = hold(changed, theirs, ours)
    if not final.fits:
        return None
    said = [*(h.says for h in changes), *([f"gradients with {slip.says}"] if slip else [])]
    advice = (*(h.advice for h in changes), *([slip.advice] if slip else []))
    claimed = listed([_claimed(claim, h.group) for h in changes] or ["none of that"])
    return (
        f"your numbers have {listed(said)}, and what is claimed is {claimed}; so read they agree with ours to {digits(final.worst)}, "
        f"as claimed they are up to {digits(held.worst)} off.",
        advice,
    )


def _claimed(claim: Claim, group: str) -> str:
    words = {
        "kernel": f"the kernel {claim.cloud.kernel.name}",
        "order": f"a basis of order {claim.cloud.order}",
        "owner": "supports owned by the nodes (source)",
        "window": f"{claim.cloud.window} windows",
        "support": "the support radius that was given",
        "scaling": "kernels of z alone",
        "derivative": f"{claim.derivative} derivatives",
    }
    return words[group]


def worst_and_spread(held: Held, most: int, rows: Array) -> Array:
    """Of the given rows the worst, and others spread over them, at most so many."""
    worst = rows[np.argsort(-held.excess[rows].max(axis=1), kind="stable")[: most // 2]]
    spread = rows[np.linspace(0, len(rows) - 1, most // 2).astype(int)]
    return np.unique(np.concatenate([worst, spread]))


def _renumbered(theirs: Entries, rows: Array) -> Entries:
    some = theirs.only(rows)
    return replace(some, rows=np.searchsorted(rows, some.rows), count=len(rows))
