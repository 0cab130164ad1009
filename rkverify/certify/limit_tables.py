"""Long waves, kh = pi and conditioning as rows for tables; everything rational is exact and rounded once."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.native import Exact, rational
from rkverify.certify.derivation import nonzero
from rkverify.certify.enclosed import certain_digits
from rkverify.paper.printed_lagrangian import b_hat, tangent
from rkverify.readings import Derivative, Integration, Readings
from rkverify.stability import limits
from rkverify.stability.conditioning import irregular_spectrum, periodic_spectrum
from rkverify.stability.lagrangian import StretchedBar, stencil
from rkverify.stability.lattice_state import Base
from rkverify.stability.symbol import transform

Row = dict[str, Any]
K = Exact()
PRINTED: dict[str, Callable[[Fraction, str], limits.Ends]] = {
    "(63)": lambda R, kernel: limits.printed_lagrangian_ends(R, K, kernel),
    "(86) edge": lambda R, kernel: limits.printed_scni_ends(R, K, "edge", kernel),
    "(86) literal": lambda R, kernel: limits.printed_scni_ends(R, K, "literal", kernel),
    "(87) full": lambda R, kernel: limits.printed_dni_ends(R, K, "full", kernel),
    "(87) diffuse": lambda R, kernel: limits.printed_dni_ends(R, K, "diffuse", kernel),
    "(87) frozen-b": lambda R, kernel: limits.printed_dni_ends(R, K, "frozen-b", kernel),
    "(87) frozen": lambda R, kernel: limits.printed_dni_ends(R, K, "frozen", kernel),
}
COMPUTED: dict[str, Callable[[Fraction, str], limits.Ends]] = {
    "Lagrangian SCNI": lambda R, kernel: limits.lagrangian_ends(R, K, "scni", "full", kernel),
    "Lagrangian DNI": lambda R, kernel: limits.lagrangian_ends(R, K, "dni", "full", kernel),
    "SCNI": lambda R, kernel: limits.method_ends(R, K, "scni", "full", kernel),
    "DNI full": lambda R, kernel: limits.method_ends(R, K, "dni", "full", kernel),
    "DNI diffuse": lambda R, kernel: limits.method_ends(R, K, "dni", "diffuse", kernel),
}


def end_rows(relations: Sequence[str], ratios: Sequence[str], kernels: Sequence[str]) -> list[Row]:
    """Factors of C + sigma and sigma at both ends of every relation."""
    rows = []
    for kernel in kernels:
        for R in ratios:
            for name in relations:
                ends = (PRINTED | COMPUTED)[name](Fraction(R), kernel)
                rows.append(
                    {
                        "relation": name,
                        "kernel": kernel,
                        "support_ratio": R,
                        "material": float(ends.material),
                        "geometric": float(ends.geometric),
                        "material_at_pi": float(ends.material_at_pi),
                        "geometric_at_pi": float(ends.geometric_at_pi),
                        "continuum": ends.material == 1 and ends.geometric == 0,
                    }
                )
    return rows


def agreement_rows(ratios: Sequence[str], kernels: Sequence[str], s: Fraction) -> list[Row]:
    """The ends from one cell against the whole equations summed cell by cell, exactly."""
    rows = []
    settings: list[tuple[Integration, Derivative]] = [("scni", "full"), ("dni", "full"), ("dni", "diffuse")]
    for kernel in kernels:
        for R in map(Fraction, ratios):
            for integration, derivative in settings:
                ends = limits.method_ends(R, K, integration, derivative, kernel)
                base = Base(R, Readings(integration, "none", derivative), s, kernel=kernel)
                long_wave = limits.response(base, lambda J: rational(J * J) / 2, K)
                at_pi = -limits.response(base, limits.alternating, K)
                rows.append(
                    {
                        "kernel": kernel,
                        "support_ratio": str(R),
                        "integration": integration,
                        "derivative": derivative if integration == "dni" else "",
                        "long_wave": long_wave == (1 + s) * ends.material + s * ends.geometric,
                        "at_pi": at_pi == (1 + s) * ends.material_at_pi + s * ends.geometric_at_pi,
                    }
                )
    return rows


def lagrangian_rows(ratios: Sequence[str], kernels: Sequence[str], s: Fraction, F: Fraction) -> list[Row]:
    """Coefficients of cos(n kh) in (63) against those of the linearised (56), exactly."""
    rows = []
    for kernel in kernels:
        for R in map(Fraction, ratios):
            b, c_squared = b_hat(1, R, K, kernel), tangent(Fraction(1), F, s)
            printed: dict[int, Fraction] = {}
            for i, p in enumerate(b):
                for j, q in enumerate(b):
                    printed[i - j] = printed.get(i - j, Fraction(0)) + c_squared * p * q
            found = stencil(StretchedBar(R, "scni", s, F, kernel=kernel), K)
            linearised = nonzero({n: -c for n, c in found.items()})
            rows.append({"kernel": kernel, "support_ratio": str(R), "equal": nonzero(printed) == linearised})
    return rows


def near_pi_rows(ratios: Sequence[str], samples: int) -> list[Row]:
    """omega of the linearised Lagrangian bar with SCNI at kh = 0.9 pi and pi over its largest sample, as enclosures."""
    A = Ball(30)
    rows = []
    for R in ratios:
        found = stencil(StretchedBar(R, "scni"), A)

        def omega(theta: Any, found: dict[int, Any] = found) -> Any:
            return A.sqrt(-transform(found, theta, A).re)

        peak = max((omega(A.pi() * j / samples) for j in range(1, samples)), key=A.witness)
        late, last = omega(A.pi() * 9 / 10), omega(A.pi())
        rows.append(
            {
                "support_ratio": R,
                "peak": certain_digits(peak, 10),
                "ratio_090": certain_digits(late / peak, 10),
                "at_pi": certain_digits(last, 10),
            }
        )
    return rows


def condition_rows(ratios: Sequence[str], count: int, shift: float, seed: int) -> list[Row]:
    """Condition of the stiffness of the Lagrangian bar with SCNI, on a periodic lattice and on a free irregular bar."""
    rows = []
    for R in ratios:
        sets = [("periodic lattice", periodic_spectrum(R, count))]
        sets += [("free irregular bar", irregular_spectrum(float(Fraction(R)), count, shift, seed))]
        for name, spectrum in sets:
            rows.append(
                {
                    "nodes": name,
                    "support_ratio": R,
                    "zeros": spectrum.zeros,
                    "smallest": float(spectrum.eigenvalues[0]),
                    "largest": float(spectrum.eigenvalues[-1]),
                    "condition": spectrum.condition,
                }
            )
    return rows
