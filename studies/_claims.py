"""One rule for a claim: which settings it speaks of, and how many of them must be unstable for it to hold."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from rkverify.workflow.study import Statement

if TYPE_CHECKING:
    import pandas as pd

NONE, ALL, SOME = "no setting", "every setting", "at least one setting"


@dataclass(frozen=True)
class Claim:
    """Entries, what is claimed, the settings (a choice of rows), how many are to be unstable, layers, and the reading.

    decides: False where the rule being met leaves nothing that the claim could be about.
    """

    name: str
    about: tuple[str, ...]
    says: str
    rows: Callable[["pd.DataFrame"], "pd.DataFrame"]
    wants: str
    layers: Sequence[str]
    reading: str = ""
    column: str = "unstable"
    decides: bool = True


def number(frame: "pd.DataFrame", column: str) -> "pd.Series[float]":
    """A column of exact numbers as floats."""
    return frame[column].map(lambda v: float(Fraction(v)))


def rows(
    integration: str,
    stress: Callable[[float], bool],
    formulation: str = "semi-lagrangian",
    still: bool | None = None,
    derivative: str = "",
    ratios: Sequence[str] = (),
    with_n: bool = False,
    frame: bool = False,
) -> Callable[["pd.DataFrame"], "pd.DataFrame"]:
    """A choice of rows by the tangent modulus' stress.

    still: only without a velocity gradient, or only with one; with_n: only with N; frame: only at nodes in motion, which
    are left out otherwise.
    """

    def chosen(table: "pd.DataFrame") -> "pd.DataFrame":
        keep = (table["formulation"] == formulation) & (table["integration"] == integration)
        keep &= (number(table, "stress_ratio") + number(table, "stretch") ** 2 - 1).map(stress)
        keep &= (table["V"] != "0") == frame
        if with_n:
            keep &= table["convective"].astype(bool)
        if derivative:
            keep &= table["derivative"] == derivative
        if ratios:
            keep &= table["support_ratio"].isin(list(ratios))
        if still is not None:
            keep &= (number(table, "Q") == 0) == still
        return table[keep]

    return chosen


def statements(claims: Sequence[Claim], growth: "pd.DataFrame") -> list[Statement]:
    """A statement for each claim and layer that has such settings."""
    found = []
    for claim in claims:
        for layer in claim.layers:
            part = claim.rows(growth[growth["layer"] == layer])
            if len(part):
                found.append(_statement(claim, layer, part))
    return found


def _statement(claim: Claim, layer: str, part: "pd.DataFrame") -> Statement:
    word = "unstable" if claim.column == "unstable" else "with a frequency that is not real"
    hit = part[part[claim.column].astype(bool)]
    size = "growth" if claim.column == "unstable" else claim.column
    told = f"{len(hit)} of {len(part)} settings {word}"
    moving = part[number(part, "Q") != 0]
    if claim.wants == NONE and size == "growth" and hit.empty and not moving.empty:
        share = moving[size] / (number(moving, "Q") * number(moving, "spacing")).abs()
        told += f", the largest growth {share.max():.3g}|Q|"
    if not hit.empty:
        top = hit.loc[hit[size].idxmax()]
        means, where = ("growth", f", kh = {top['kh']:.3g}") if size == "growth" else ("|Im omega|", "")
        told += (
            f", the most with {means} h/c = {top[size]:.3g} (R = {top['support_ratio']}, stress ratio {top['stress_ratio']}, "
            f"Q h/c = {float(Fraction(top['Q']) * Fraction(top['spacing'])):g}{where})"
        )
    holds = {NONE: hit.empty, ALL: len(hit) == len(part), SOME: not hit.empty}[claim.wants]
    margin = (
        -float(part[size].max())
        if claim.wants == NONE
        else float(part[size].agg({ALL: "min", SOME: "max"}[claim.wants]))
    )
    key = "".join(c if c.isalnum() else "_" for c in f"{claim.name}_{layer}_{claim.reading}").strip("_")
    return Statement(
        key,
        claim.about,
        f"“{claim.says}” asks for {claim.wants} {word}; found: {told}.",
        bool(holds) if claim.decides or not holds else None,
        _tried(part),
        "sampled",
        margin,
        {NONE: "minus the largest", ALL: "the least", SOME: "the largest"}[claim.wants] + f" {size} h/c",
        layer=layer,
        reading=claim.reading,
    )


def _tried(part: "pd.DataFrame") -> str:
    def values(column: str) -> str:
        return ", ".join(sorted(set(part[column]), key=lambda v: float(Fraction(v))))

    lagrangian = part["formulation"].iloc[0] == "lagrangian"
    state = (
        f"S/C = {values('stress_ratio')}, F = {values('stretch')}"
        if lagrangian
        else f"sigma/C = {values('stress_ratio')}"
    )
    motion = "" if lagrangian else f"; Q = {values('Q')}, h = {values('spacing')}"
    return f"R = {values('support_ratio')}; {state}{motion}; cubic kernel, linear basis, Truesdell rate"
