"""The links of the derivation as rows for a table: which equation from which, under what, and whether it comes out."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rkverify.certify.derivation import (
    Coefficients,
    Printed,
    convective_part,
    defined_convective_part,
    defined_stencil,
    lagrangian_link,
    printed_convective_part,
    printed_stencil,
    rebuilt_81,
    relation_error,
)
from rkverify.readings import DERIVATIVES, CellMeasure, Readings, StressLaw

Row = dict[str, Any]
ZERO = Fraction(0)


def distance(one: Coefficients, other: Coefficients) -> float:
    """The largest difference of two stencils over the largest coefficient of the second."""
    gaps = [abs(one.get(n, ZERO) - other.get(n, ZERO)) for n in one.keys() | other.keys()]
    return float(max(gaps, default=ZERO) / max((abs(c) for c in other.values()), default=Fraction(1)))


def _apart(one: Printed, other: Printed) -> float:
    return max(distance(one.displacement, other.displacement), distance(one.velocity, other.velocity))


def _row(link: str, R: Fraction, under: str, lost: float) -> Row:
    return {"link": link, "support_ratio": str(R), "under": under, "comes_out": lost == 0, "lost": lost}


def lagrangian_rows(ratios: Sequence[Fraction], s: Fraction, F: Fraction) -> list[Row]:
    """(56) -> (57)-(60) -> (61)."""
    rows = []
    for R in ratios:
        printed, defined, perturbed = lagrangian_link(R, s, F)
        rows.append(_row("(56) -> (61)", R, "every term", distance(printed, defined)))
        rows.append(_row("(57)-(60) -> (61)", R, "every term", distance(printed, perturbed)))
    return rows


def convective_rows(ratios: Sequence[Fraction], Q: Fraction) -> list[Row]:
    """(65), (73), (74) -> (75): the terms that come from N, with what is dropped named."""
    rows = []
    for R in ratios:
        printed = printed_convective_part(R, Q)
        defined = defined_convective_part(R, Q)
        rows += [
            _row("(65) -> (73)", R, "N in (75) against every term of N", _apart(printed, defined)),
            _row(
                "(73) -> (74)",
                R,
                "Psi_I times the change of Psi*_J dropped",
                distance(convective_part(R, Q, True, False).velocity, defined.velocity),
            ),
            _row("(74) -> (75)", R, "n_IK of (71) kept", _apart(convective_part(R, Q, True, False), printed)),
            _row("(74) -> (75)", R, "n_IK of (71) dropped", _apart(convective_part(R, Q, False, False), printed)),
        ]
    return rows


def stress_rows(ratios: Sequence[Fraction], s: Fraction) -> list[Row]:
    """The stress terms of (75) and (81) at Q = 0 against the linearised (65), in the readings that could save them."""
    rows = []
    for R in ratios:
        for half in ("edge", "literal"):
            printed = printed_stencil("scni", R, s, ZERO, half_point=half)
            defined = defined_stencil(Readings("scni", "none"), R, s, ZERO)
            error = relation_error(Readings("scni", "none"), R, s, half)
            rows.append(_row("(65) -> (86)", R, f"C(h/2) {half}", error if error > 1e-38 else 0.0))
            rows.append(
                _row(
                    "(74) -> (75)",
                    R,
                    f"stress term, C(h/2) {half}",
                    distance(printed.displacement, defined.displacement),
                )
            )
            if half == "edge":
                rows += _rebuilt_rows(R, s)
        for law in ("truesdell", "cauchy-rate", "literal"):
            for measure in ("edges", "fixed"):
                for derivative in ("full", "diffuse", "frozen-b", "frozen"):
                    reading = Readings("dni", "none", derivative, law, cell_measure=measure)
                    printed = printed_stencil("dni", R, s, ZERO, derivative=derivative)
                    lost = distance(printed.displacement, defined_stencil(reading, R, s, ZERO).displacement)
                    error = relation_error(reading, R, s, "edge")
                    rows.append(
                        _row(
                            "(65) -> (87)",
                            R,
                            f"{law}, {derivative}, measure {measure}",
                            error if error > 1e-38 else 0.0,
                        )
                    )
                    rows.append(_row("(74) -> (81)", R, f"{law}, {derivative}, measure {measure}", lost))
    return rows


def _rebuilt_rows(R: Fraction, s: Fraction) -> list[Row]:
    """(81) rebuilt: B_I(x_K) varied as a function of x_K - x_I alone, in two readings of the rest of (74)."""
    rows = []
    rest: list[tuple[StressLaw, CellMeasure]] = [
        ("cauchy-rate", "edges"),
        ("truesdell", "fixed"),
        ("truesdell", "edges"),
    ]
    for law, measure in rest:
        for derivative in DERIVATIVES:
            readings = Readings("dni", "none", derivative, law, cell_measure=measure)
            printed = printed_stencil("dni", R, s, ZERO, derivative=derivative).displacement
            under = f"B_I(x_K) a function of x_K - x_I alone; {law}, {derivative}, measure {measure}"
            rows.append(_row("(74) -> (81)", R, under, distance(rebuilt_81(readings, R, s), printed)))
    return rows
