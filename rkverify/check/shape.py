"""Check of shape functions and gradients that somebody else has computed."""

from dataclasses import replace

from rkverify.check import findings
from rkverify.check.causes import cause_of
from rkverify.check.claim import Claim
from rkverify.check.entries import Entries
from rkverify.check.held import hold, largest
from rkverify.check.report import Report
from rkverify.check.rounding import lengths_at, relative_rounding
from rkverify.check.sums import residuals
from rkverify.solid.neighbours import neighbours

ROWS = "point"


def check_shape(claim: Claim, theirs: Entries, tolerance: float = 0.0) -> Report:
    """Whether `theirs` (psi, derivatives, or both, at every point of the claim) are what is claimed; if not, what they are.

    tolerance: allowed besides rounding, relative to the largest number of a column. Raises what the claim's own shape
    functions raise, such as TooFewNodes.

    >>> import numpy as np
    >>> from rkverify.check.claim import predicted
    >>> from rkverify.solid.cloud import cloud
    >>> claim = Claim(cloud(np.arange(8.0)[:, None], 2.5), np.array([[3.3], [4.1]]))
    >>> sold = predicted(replace(claim, derivative="diffuse"), ("psi", "dpsi_dx"))
    >>> check_shape(claim, sold).verdict.partition(";")[0]
    'FAIL: your numbers have diffuse derivatives, and what is claimed is full derivatives'
    """
    theirs = coarser(theirs, tolerance)
    known = neighbours(claim.cloud, claim.points)
    held = hold(claim, theirs)
    lengths, rounding = lengths_at(claim.cloud, known), relative_rounding(claim.cloud, claim.points, known)
    sums = residuals(theirs, claim.points, claim.cloud.positions, lengths, rounding, claim.cloud.order)
    found = [
        *findings.of_digits(theirs),
        *findings.of_sums(sums, ROWS),
        *findings.of_pairs(held, theirs, ROWS),
        *findings.of_agreement(held, theirs, ROWS),
    ]
    fine = all(finding.holds for finding in found)
    cause, advice = ("", ()) if fine else cause_of(claim, theirs, held, sums)
    return Report("the shape functions are", ROWS, tuple(found), cause, advice, largest(held, theirs))


def coarser(theirs: Entries, tolerance: float) -> Entries:
    """The same numbers, taken for right within a tolerance relative to the largest of their column."""
    return replace(theirs, resolution=theirs.resolution + tolerance * abs(theirs.numbers).max(axis=0, initial=0.0))
