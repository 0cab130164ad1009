"""The closed forms as rows for tables: coefficients, relations at rest, relations in motion."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import sympy

from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify import closed_forms as forms
from rkverify.certify import closed_relations as relations
from rkverify.certify.kernel_forms import in_kernel_values
from rkverify.paper.notation import lattice_values
from rkverify.readings import Convection, Derivative, Integration, Readings
from rkverify.stability.jacobian_paper import Stencil

Row = dict[str, Any]
Formulation = tuple[Integration, Derivative, str]
"""Integration, derivative, and the side of R = 3/2 on which the sample lies."""


@dataclass(frozen=True)
class Forms:
    """The stress part per formulation and the part of N per convection: over R, and in the kernel's values."""

    stress: dict[Formulation, tuple[Stencil, RationalFunctions]]
    named: dict[Formulation, tuple[Stencil, RationalFunctions]]
    convective: dict[Convection, tuple[Stencil, RationalFunctions]]
    named_convective: dict[Convection, tuple[Stencil, RationalFunctions]]

    def of(self, formulation: Formulation, convection: Convection) -> Stencil:
        """The whole stencil over R."""
        stress, K = self.stress[formulation]
        return stress if convection == "none" else forms.together(stress, self.convective[convection][0], K)

    def domain(self, formulation: Formulation) -> str:
        """The R for which the form holds, in words."""
        return _range(self.stress[formulation][1])


def _range(K: RationalFunctions) -> str:
    low, high = relations.domain(K)
    return f"{low} < R < {high}"


def all_forms(formulations: Sequence[Formulation], convections: Sequence[Convection]) -> Forms:
    """Every form; that of N comes from the side R < 3/2, and its decisions hold for 1 < R < 2."""
    each = [(f, Readings(f[0], "none", f[1])) for f in formulations]
    return Forms(
        {f: forms.stencil_over_R(r, f[2]) for f, r in each},
        {f: forms.stencil_over_kernel_values(r, f[2]) for f, r in each},
        {c: forms.convective_part(c, "low") for c in convections},
        {c: forms.convective_part(c, "low", forms.stencil_over_kernel_values) for c in convections},
    )


def coefficient_rows(found: Forms) -> list[Row]:
    """Every coefficient as text: of the stress part per formulation, and of N."""
    rows = []
    for f, (stencil, _) in found.stress.items():
        label = f"stress, {f[0]}" + (f" {f[1]}" if f[0] == "dni" else "")
        rows += _coefficients(label, found.domain(f), stencil, found.named[f][0])
    for convection, (stencil, K) in found.convective.items():
        rows += _coefficients(f"N, {convection}", _range(K), stencil, found.named_convective[convection][0])
    return rows


def _coefficients(label: str, domain: str, stencil: Stencil, named: Stencil) -> list[Row]:
    return [
        {
            "part": label,
            "range": domain,
            "rate": f"{rate}'",
            "variable": variable,
            "shift": n,
            "parity": _parity(values),
            "over_R": str(sympy.factor(c.as_expr())),
            "in_values": str(in_kernel_values(named[rate, variable][n].as_expr())),
        }
        for (rate, variable), values in stencil.items()
        if rate != "x"
        for n, c in sorted(values.items())
        if n >= 0
    ]


def _parity(values: dict[int, Any]) -> str:
    if all(values.get(-n) == c for n, c in values.items()):
        return "even"
    return "odd" if all(n and values.get(-n) == -c for n, c in values.items()) else "neither"


def rest_rows(found: Forms) -> list[Row]:
    """omega^2 = (1 - c) q(c) at rest: its ends, and which identity it satisfies."""
    rows = []
    for f, (stencil, K) in found.stress.items():
        at, (named, N) = relations.at_rest(stencil, K), found.named[f]
        in_values = relations.at_rest(named, N)
        s = K.generator("s")
        rows.append(
            {
                "integration": f[0],
                "derivative": f[1] if f[0] == "dni" else "",
                "range": found.domain(f),
                "long_wave": str(sympy.factor(at.long_wave.as_expr())),
                "at_pi": str(sympy.factor(at.at_pi.as_expr())),
                "at_pi_in_values": str(in_kernel_values(in_values.at_pi.as_expr())),
                "affine": at.is_affine and in_values.is_affine,
                "sine_and_G": relations.is_sine_and_geometric_factor(at, s)
                and relations.is_sine_and_geometric_factor(in_values, N.generator("s")),
                "square": relations.is_square_of_gradient(at, stencil, s)
                and relations.is_square_of_gradient(in_values, named, N.generator("s")),
                "is_86": K.is_zero(printed_scni_factor(f[2], K) - 1) and at.is_affine if f[0] == "scni" else "",
            }
        )
    return rows


def printed_scni_factor(side: str, K: RationalFunctions) -> Any:
    """4 [C(h/2) phi(h/2)]^2 of (86) with C(h/2) at the cell's edge, so that omega^2 = it times (1 + s) sin^2 kh."""
    R = K.generator("R")
    v = lattice_values(1, R, K, "edge", "frozen")
    return 4 * (v.C_half * v.phi_half) ** 2


def motion_rows(found: Forms) -> list[Row]:
    """The characteristic polynomial with N for every formulation, and the symbols of N's terms in c = cos kh."""
    rows = []
    for (f, (stencil, K)), (convection, (N, _)) in product(found.stress.items(), found.convective.items()):
        kind = relations.in_motion(forms.together(stencil, N, K), N, K)
        named, L = found.named_convective[convection]
        rows.append(
            {
                "integration": f[0],
                "derivative": f[1] if f[0] == "dni" else "",
                "range": found.domain(f),
                "convection": convection,
                "factors": kind.factors,
                "even": kind.even,
                "galilean": kind.galilean,
                "b": str(in_kernel_values(relations.text_in_cosine(named["v", "v"], L))),
                "a_N": str(in_kernel_values(relations.text_in_cosine(named["v", "x"], L))),
            }
        )
    return rows
