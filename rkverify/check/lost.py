"""One neighbour that was lost at one point: at a node (DNI), or at a point of the rule on the boundary of cells (SCNI).

Smoothed gradients of several cells change together then, all their sums still hold, and the lost node may still be a neighbour of
each of these cells by another point.
"""

import numpy as np

from rkverify.check.choices import Cause
from rkverify.check.claim import Claim, predicted, without
from rkverify.check.entries import Entries
from rkverify.check.held import Held
from rkverify.check.report import digits, listed
from rkverify.check.schemes import GradientClaim
from rkverify.errors import RkverifyError
from rkverify.solid.cloud import shown
from rkverify.solid.edge_rules import facet_rule
from rkverify.solid.gradients import facets_alone
from rkverify.solid.kernel_values import Array

MOST = 12
"""More wrong cells than meet at a point are not looked at."""


def lost_neighbour(claim: GradientClaim, theirs: Entries, held: Held) -> Cause | None:
    """The point and the node without which our gradients are theirs; None where there is no such pair."""
    wrong = np.flatnonzero((held.excess > 1).any(axis=1))
    if not 0 < len(wrong) <= MOST:
        return None
    gap = np.stack([held.gap.matrix(c)[wrong].toarray() for c in range(len(theirs.columns))], axis=2)
    allowed = held.allowed[wrong][:, None, :]
    places = _places(claim, wrong, theirs.columns)
    for point, weights in places:
        for node, change in _changes(claim, point, theirs.columns):
            # weights (L, c) times the change of the values (N, 1), or of the derivatives (N, c) with weights of one
            if (abs(gap - weights[:, None, :] * change[None]) <= allowed).all():
                cells = f"cell{'s' * (len(wrong) > 1)} {listed([str(L) for L in wrong], MOST)}"
                return (
                    f"a neighbour is missing from the sums: node {node} at the point ({shown(point)}), which {cells} use; without it our "
                    f"numbers are yours, to {digits(float(abs(gap - weights[:, None, :] * change[None]).max()))}.",
                    (
                        "look at the neighbour search near this point: every node with |x - x_J| < a_J belongs to the sums",
                    ),
                )
    return None


def _places(claim: GradientClaim, wrong: Array, columns: tuple[str, ...]) -> list[tuple[Array, Array]]:
    """Points that all the wrong cells use, with the weights (L, c) of their shape functions in the cells' gradients."""
    if claim.scheme.integration == "dni":
        return [(claim.cloud.positions[wrong[0]], np.ones((1, len(columns))))] if len(wrong) == 1 else []
    if claim.scheme.integration != "scni" or claim.cells is None:
        return []
    row = {int(node): number for number, node in enumerate(claim.numbers)}
    own = np.array([row[int(node)] for node in wrong])
    touching = np.flatnonzero(np.isin(claim.cells.sides, own).any(axis=1))
    facets = facets_alone(claim.cells, touching)
    rule = facet_rule(facets, claim.scheme.rule)
    means = rule.matrix().toarray()
    outward = np.array([(facets.sides[:, 0] == L) * 1.0 - (facets.sides[:, 1] == L) * 1.0 for L in own])
    weights = np.einsum("lf,fi,fq->qli", outward, facets.areas, means) / claim.cells.measures[own][:, None]
    used = np.flatnonzero((abs(weights).max(axis=2) > 0).all(axis=1))
    return [(rule.points[q], weights[q]) for q in used]


def _changes(claim: GradientClaim, point: Array, columns: tuple[str, ...]) -> list[tuple[int, Array]]:
    """For each neighbour of a point, what the shape functions there lose without it: values (N, 1), for dni derivatives (N, c)."""
    direct = claim.scheme.integration == "dni"
    asked = ("dpsi_dx", *columns[1:]) if direct else ("psi",)
    here = Claim(claim.cloud, point[None], claim.scheme.derivative)
    whole = _dense(predicted(here, asked), len(claim.cloud))
    found = []
    for node in predicted(here, asked).nodes.tolist():
        try:
            less = predicted(here, asked, without(claim.cloud, here.points, {0: [node]}))
        except RkverifyError:
            continue  # too few are left: it was not lost
        found.append((node, _dense(less, len(claim.cloud)) - whole))
    return found


def _dense(entries: Entries, size: int) -> Array:
    full = np.zeros((size, len(entries.columns)))
    full[entries.nodes] = entries.numbers
    return full
