"""What a check reports about any table: digits, sums, pairs, agreement."""

import numpy as np

from rkverify.check.entries import Entries
from rkverify.check.held import Held, unmatched
from rkverify.check.report import Finding, digits, listed
from rkverify.check.sums import Sum

_DEGREES = ("constants", "linear functions", "quadratic functions")


def of_digits(theirs: Entries) -> list[Finding]:
    """How finely the numbers of the table can be looked at, where that is coarser than double precision."""
    most = abs(theirs.numbers).max(axis=0, initial=0.0)
    relative = float((theirs.resolution / np.maximum(most, 1e-300)).max(initial=0.0))
    if relative < 1e-13:
        return []
    says = (
        f"your numbers are taken to {relative:.0e} of the largest in their column: finer differences are not looked for"
    )
    return [Finding("digits", True, says, relative)]


def of_sums(sums: list[Sum], rows: str) -> list[Finding]:
    """One finding for the values and one for the gradients, for each degree."""
    found = []
    for kind, of_values in (("values", True), ("gradients", False)):
        for degree, word in enumerate(_DEGREES):
            group = [s for s in sums if s.degree == degree and (s.column == "psi") == of_values]
            if not group:
                continue
            worst = max(group, key=lambda s: s.residual / s.bound)
            bad = [s for s in group if not s.holds]
            says = f"{kind} reproduce {word}, to {digits(max(s.residual for s in group))}"
            if bad:
                says = (
                    f"{kind} do not reproduce {listed([s.name for s in bad])}: off by {digits(worst.residual)} at {rows} "
                    f"{worst.row}, allowed {digits(worst.bound)}"
                )
            found.append(Finding(f"{kind}: {word}", not bad, says, worst.residual, worst.bound))
    return found


def of_pairs(held: Held, theirs: Entries, rows: str) -> list[Finding]:
    """Pairs that are missing, and pairs that are there in vain."""
    found = []
    for kind, pairs in zip(("missing", "extra"), unmatched(held, theirs), strict=True):
        places = listed([f"{rows} {p} with node {J}" for p, J in pairs], 3) if pairs else ""
        says = (
            f"{kind} pairs of {rows} and node, {len(pairs)}: {places}"
            if pairs
            else f"no pair of {rows} and node is {kind}"
        )
        found.append(Finding(f"{kind} pairs", not pairs, says, float(len(pairs)), 0.0))
    return found


def of_agreement(held: Held, theirs: Entries, rows: str) -> list[Finding]:
    """One finding for each column."""
    found = []
    for c, column in enumerate(theirs.columns):
        worst = float(abs(held.gap.numbers[:, c]).max(initial=0.0))
        bad = int((held.excess[:, c] > 1).sum())
        says = f"{column} agrees with ours, to {digits(worst)}"
        if bad:
            says = (
                f"{column} differs from ours by up to {digits(worst)}, at {bad} {rows}s of {len(np.unique(held.gap.rows))}, in "
                f"{int(held.wrong[:, c].sum())} numbers of {len(held.gap.rows)}"
            )
        found.append(Finding(f"agreement of {column}", not bad, says, worst, float(held.allowed[:, c].max())))
    return found


def few_wrong(held: Held, rows: str, most: int = 3) -> str:
    """The numbers that are wrong, where they are a few of many; else nothing."""
    entry, column = np.nonzero(held.wrong)
    if not 0 < len(entry) <= most or len(entry) > held.gap.numbers.size // 10:
        return ""
    places = [
        f"{held.gap.columns[c]} of node {held.gap.nodes[e]} at {rows} {held.gap.rows[e]}, by {digits(abs(float(held.gap.numbers[e, c])))}"
        for e, c in zip(entry, column, strict=True)
    ]
    one = "one number differs" if len(places) == 1 else f"{len(places)} numbers differ"
    return f"{one} from ours, and all others agree: {listed(places)}."
