"""The closed forms in numbers, as rows for tables: their errors, what N is worth along kh, and both ends per reading."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from math import cos, pi

from rkverify.arithmetic.native import Exact, Float
from rkverify.certify import closed_forms as forms
from rkverify.certify import closed_relations as relations
from rkverify.certify.form_tables import Forms, Formulation, Row
from rkverify.certify.stress_range import ends_in_stress
from rkverify.errors import BadInput
from rkverify.paper.notation import lattice_values
from rkverify.readings import Convection, Readings
from rkverify.stability.printed import PrintedQuadratic


def error_rows(found: Forms, count: int, seed: int, s: Fraction, Q: Fraction, digits: int) -> list[Row]:
    """The forms against the linearisation at many digits at random R: `count` for each form, all over its range.

    A form that holds on both sides of R = 3/2 has half of them on each. What N adds is checked with SCNI and with DNI.
    """
    rows = []
    convections: list[Convection] = ["none", *found.convective]
    for j, (f, convection) in enumerate(product(found.stress, convections)):
        readings = Readings(f[0], convection, f[1])
        sides = ["low", "high"] if f[0] == "dni" else [f[2]]
        ratios = [R for side in sides for R in forms.random_ratios(side, -(-count // len(sides)), seed + j)]
        error = forms.largest_error(readings, f[2], ratios, s, Q, digits, found.of(f, convection))
        rows.append(
            {
                "integration": f[0],
                "derivative": f[1] if f[0] == "dni" else "",
                "convection": convection,
                "range": found.domain(f),
                "ratios": len(ratios),
                "holds": error < 10.0**-digits,
                "largest_error": f"< 1e-{digits}" if error < 10.0**-digits else f"{error:.3g}",
            }
        )
    return rows


def beyond_rows(found: Forms, s: Fraction, Q: Fraction, digits: int, beyond: Fraction) -> list[Row]:
    """How wrong each form is at a support ratio beyond its range: the twin of the errors inside."""
    rows = []
    for f, (stencil, _) in found.stress.items():
        error = forms.largest_error(Readings(f[0], "none", f[1]), f[2], [beyond], s, Q, digits, stencil)
        rows.append(
            {
                "integration": f[0],
                "derivative": f[1] if f[0] == "dni" else "",
                "range": found.domain(f),
                "support_ratio": str(beyond),
                "error": error,
            }
        )
    return rows


def damping_rows(found: Forms, ratios: Sequence[Fraction], s: Fraction, Q: Fraction, samples: int) -> list[Row]:
    """b and W of the forms along kh beside B and C of (78) and (84): omega^2 + i b omega - W against omega^2 + B omega + C."""
    rows = []
    one_each = {(f[0], f[1]): f for f in found.stress if f[1] == "full"}
    for (integration, _), R in product(one_each, ratios):
        f = _covering(found, integration, R)
        relation = PrintedQuadratic(lattice_values(1, float(R), Float()), integration, Float())
        state = relation.state(float(s), float(Q))
        at = {c: forms.values_over_R(found.of(f, c), s, Q)(R) for c in found.convective}
        for j in range(samples + 1):
            kh = pi * j / samples
            B = relation.linear(state, kh)
            row = {
                "integration": integration,
                "support_ratio": str(R),
                "kh": round(kh, 12),
                "printed_B": B,
                "printed_C": (B * B - relation.discriminant(state, kh)) / 4,
            }
            for convection, stencil in at.items():
                row[f"b {convection}"] = _transform(stencil["v", "v"], kh)
                row[f"W {convection}"] = -_transform(relations.following(stencil, Exact()), kh)
            rows.append(row)
    return rows


def _covering(found: Forms, integration: str, R: Fraction) -> Formulation:
    for f, (_, K) in found.stress.items():
        low, high = relations.domain(K)
        if f[0] == integration and f[1] == "full" and low < R < high:
            return f
    raise BadInput(f"no form for {integration} with the full derivative holds at R = {R}")


def _transform(coefficients: dict[int, Fraction], kh: float) -> float:
    return sum(float(c) * cos(n * kh) for n, c in coefficients.items())


def reading_rows(settings: Sequence[tuple[str, Readings]]) -> list[Row]:
    """Both ends of omega^2 at rest per reading as functions of s, and the stress at which either verdict turns."""
    rows = []
    for R, r in settings:
        long_wave, at_pi = ends_in_stress(r, Fraction(R))
        rows.append(
            {
                "support_ratio": R,
                "integration": r.integration,
                "derivative": r.derivative if r.integration == "dni" else "",
                "stress_law": r.stress_law,
                "cell_edges": r.cell_edges,
                "cell_measure": r.cell_measure,
                "long_wave": str(long_wave),
                "at_pi": str(at_pi),
                "turn_long_wave": _text(long_wave.turn),
                "turn_at_pi": _text(at_pi.turn),
            }
        )
    return rows


def _text(turn: Fraction | None) -> str:
    return "none" if turn is None else str(turn)


def pi_rows(found: Forms, ratios: Sequence[Fraction]) -> list[Row]:
    """omega^2(pi)/sigma of the forms for DNI beside -4 Psi,xx(h), what (87) has in its place; rho = h = 1."""
    rows = []
    one = Fraction(1)
    for f, (stencil, _) in found.stress.items():
        if f[0] == "dni":
            at = forms.values_over_R(stencil, one, Fraction(0))
            for R in ratios:
                computed = relations.at_rest(at(R), Exact()).at_pi
                printed = -4 * lattice_values(1, R, Exact(), derivative=f[1]).Psi_xx_h
                rows.append(
                    {
                        "derivative": f[1],
                        "support_ratio": str(R),
                        "computed": float(computed),
                        "printed": float(printed),
                        "equal": computed == printed,
                        "same_sign": (computed > 0) == (printed > 0),
                    }
                )
    return rows
