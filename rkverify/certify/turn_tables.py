"""Turns and ranges of stress as rows for tables: the state at kh = pi over R, of the method and of (87)."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from rkverify.arithmetic.native import Exact
from rkverify.certify.stress_range import stress_range
from rkverify.certify.turns import Function, method_at_pi, printed_at_pi, signs
from rkverify.readings import Derivative

Row = dict[str, Any]
FUNCTIONS: dict[str, Function] = {"method": method_at_pi, "(87)": printed_at_pi}


def profile_rows(
    name: str, derivatives: Sequence[Derivative], kernels: Sequence[str], ratios: Sequence[str]
) -> list[Row]:
    """omega^2(pi) rho h^2/sigma over R, exact and rounded once."""
    return [
        {
            "function": name,
            "kernel": kernel,
            "derivative": derivative,
            "support_ratio": R,
            "value": float(FUNCTIONS[name](Fraction(R), Exact(), kernel, derivative)),
        }
        for kernel in kernels
        for derivative in derivatives
        for R in ratios
    ]


def turn_rows(name: str, derivatives: Sequence[Derivative], kernels: Sequence[str], upper: Fraction) -> list[Row]:
    """Every zero of omega^2(pi)/sigma in ]1, upper], with the signs on both sides; a row without a zero where there is none."""
    rows = []
    for kernel in kernels:
        for derivative in derivatives:
            found = signs(FUNCTIONS[name], kernel, derivative, upper)
            common = {"function": name, "kernel": kernel, "derivative": derivative, "degree": found.degree}
            for zero, (before, behind) in zip(found.zeros, pairwise(found.signs), strict=True):
                kind = "turn" if before * behind < 0 else "touch"
                rows.append({**common, "zero": zero.digits, "before": before, "behind": behind, "kind": kind})
            if not found.zeros:
                sign = found.signs[0]
                rows.append({**common, "zero": "none", "before": sign, "behind": sign, "kind": "none"})
    return rows


def agreement_rows(kernel: str, derivatives: Sequence[Derivative], upper: Fraction) -> list[Row]:
    """Whether omega^2(pi)/sigma of the method and -4 Psi,xx(h) have one sign for all R in ]1, upper[, and all their zeros."""
    rows = []
    for derivative in derivatives:
        method, printed = (signs(f, kernel, derivative, upper) for f in (method_at_pi, printed_at_pi))
        zeros = sorted((z for found in (method, printed) for z in found.zeros if z.low < upper), key=lambda z: z.low)
        ends = [Fraction(1), *(end for z in zeros for end in (z.low, z.high)), upper]
        middles = [(p + q) / 2 for p, q in zip(ends[::2], ends[1::2], strict=True)]
        rows.append(
            {
                "kernel": kernel,
                "derivative": derivative,
                "method": " ".join(str(method.at(R)) for R in middles),
                "printed": " ".join(str(printed.at(R)) for R in middles),
                "zeros": " ".join(z.digits for z in zeros) or "none",
                "same": all(method.at(R) == printed.at(R) for R in middles),
            }
        )
    return rows


def range_rows(
    ratios: Sequence[str], kernels: Sequence[str], derivatives: Sequence[Derivative], samples: int
) -> list[Row]:
    """The stresses s at which DNI at rest is stable at every kh, and the kh that ends their range."""
    rows = []
    for kernel in kernels:
        for derivative in derivatives:
            for R in ratios:
                found = stress_range(Fraction(R), derivative, kernel, samples)
                rows.append(
                    {
                        "kernel": kernel,
                        "derivative": derivative,
                        "support_ratio": R,
                        "lowest": _decimal(found.lowest),
                        "kh_lowest": _decimal(found.kh_lowest),
                        "highest": _decimal(found.highest),
                        "kh_highest": _decimal(found.kh_highest),
                    }
                )
    return rows


def _decimal(value: Fraction | float | None) -> str:
    return "none" if value is None else f"{float(value):.6g}"
