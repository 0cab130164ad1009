"""Why shape functions are not as claimed: another choice, missing neighbours, or, with no such reason, the sums that they break."""

import numpy as np

from rkverify.check.choices import Cause, other_choice
from rkverify.check.claim import Claim, predicted, without
from rkverify.check.entries import Entries
from rkverify.check.findings import few_wrong
from rkverify.check.held import Held, hold, unmatched
from rkverify.check.report import digits, listed
from rkverify.check.sums import Sum
from rkverify.errors import RkverifyError


def cause_of(claim: Claim, theirs: Entries, held: Held, sums: list[Sum]) -> Cause:
    """What explains the numbers, the first of: the claim itself, other choices, neighbours, sums; with advice."""
    if held.fits:
        bad = listed(sorted({s.monomial for s in sums if not s.holds}))
        return (
            f"the numbers are what is claimed, but this reading of the derivative does not reproduce {bad}.",
            ("take full or diffuse derivatives where gradients are to be consistent",),
        )
    return other_choice(claim, theirs, held) or _left_out(claim, theirs, held) or by_sums(sums, held, "point")


def _left_out(claim: Claim, theirs: Entries, held: Held) -> Cause | None:
    """Nodes missing at some points, and whether the sums at these points were made without them."""
    missing, extra = unmatched(held, theirs)
    gone: dict[int, list[int]] = {}
    for point, node in missing:
        gone.setdefault(point, []).append(node)
    bad = np.flatnonzero((held.excess > 1).any(axis=1))
    if extra or claim.owner != "source" or not missing or set(gone) != set(bad.tolist()):
        return None
    places = listed([f"node {J} at point {p}" for p, J in missing], 4)
    listed_by_them = ~np.isin(held.gap.keys, [p * theirs.size + J for p, J in missing])
    if not held.wrong[listed_by_them].any():
        return (
            f"the table leaves out {places}; all its numbers agree with ours, so that the sums were made with it.",
            ("complete the table: the computation is right",),
        )
    try:
        again = hold(claim, theirs, predicted(claim, theirs.columns, without(claim.cloud, claim.points, gone)))
    except RkverifyError:
        return None
    if not again.fits:
        return None
    one = "a neighbour is" if len(missing) == 1 else f"{len(missing)} neighbours are"
    return (
        f"{one} missing from the sums: {places}; without it our numbers are yours, to {digits(again.worst)}.",
        ("look at the neighbour search near this point: every node with |x - x_J| < a_J belongs to the sums",),
    )


def by_sums(sums: list[Sum], held: Held, rows: str) -> Cause:
    """No choice that was tried explains the numbers: say which are wrong, or which sums they break."""
    few = few_wrong(held, rows)
    if few:
        return few, ("look at how this number is computed: nothing else is wrong",)
    bad = [s for s in sums if not s.holds]
    columns = held.gap.columns
    agreeing = [name for c, name in enumerate(columns) if (held.excess[:, c] <= 1).all()]
    if not bad:
        wrong = listed([name for name in columns if name not in agreeing])
        return (
            f"{wrong} differ from ours by up to {digits(held.worst)}, and no other choice that we tried gives your numbers; yet they "
            "reproduce all that they should: they may be another consistent choice.",
            ("say which weights you use, and compare with what `rkverify shape` or `rkverify gradients` prints",),
        )
    kinds = {"values" if s.column == "psi" else "gradients" for s in bad}
    lower = min(s.degree for s in bad)
    passing = ("", "constants", "constants and linear functions")[lower]
    although = f", although the sums of {passing} pass" if passing else ""
    monomials = listed(sorted({s.monomial for s in bad}))
    mixed = {s.monomial for s in bad} <= {"xy", "xz", "yz"}
    what = f" The mixed function {monomials} of the basis is at fault." if mixed else ""
    right = f" {listed(agreeing)} agree{'s' * (len(agreeing) == 1)} with ours." if agreeing else ""
    wrong_rows, count = np.unique(held.gap.rows[held.wrong.any(axis=1)]), int(held.wrong.any(axis=1).sum())
    if 2 * count < len(held.gap.rows):
        places = listed([str(row) for row in wrong_rows], 8)
        right += f" Only {count} of {len(held.gap.rows)} pairs differ, at {rows}s {places}: look for a rule that treats them apart."
    return (
        f"the {listed(sorted(kinds, reverse=True))} do not reproduce {listed([s.name for s in bad])}{although}: off by up to "
        f"{digits(max(s.residual for s in bad))}.{what}{right}",
        (
            f"look at how {monomials} and its derivatives enter H, M and the derivative of M: linear sums cannot see it"
            if lower == 2
            else f"begin at the {rows} named above: "
            + (
                "solve M b = H(0) there by hand"
                if "values" in kinds
                else "compare your derivative with a difference quotient of your own values"
            ),
        ),
    )
