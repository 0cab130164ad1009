"""(87) and its criterion against SPH: with Psi_I = V_I W in place of the RK function, and with the RK function itself."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Float
from rkverify.certify import sph_relations
from rkverify.certify.sph_comparison import NOTHING, significant, wave_numbers
from rkverify.certify.sph_relations import criterion, kernel_derivative
from rkverify.paper.notation import lattice_values
from rkverify.paper.printed_semi_lagrangian import State, dni_omega_squared
from rkverify.readings import DERIVATIVES
from rkverify.stability.sph import FORMS, SphBase, omega_squared

Row = dict[str, Any]


def routes(kernels: Sequence[str], ratios: Sequence[str], stresses: Sequence[str], digits: int) -> list[Row]:
    """The closed relations at many digits and the linearisation by complex steps, for both stress laws, at kh = 2 and pi."""
    K = Multiprecision(digits)
    kh = [K.number(2), K.pi()]
    rows = []
    for kernel in kernels:
        for R in ratios:
            q = [sph_relations.sums(kernel, R, t, K) for t in kh]
            for name, form in FORMS.items():
                lost = 0.0
                shown = {}
                for law in ("truesdell", "cauchy-rate"):
                    chosen = replace(form, law=law)
                    for s in stresses:
                        closed = [float(sph_relations.relation(chosen, at, s, K)) for at in q]
                        linear = omega_squared(SphBase(chosen, R, s, 0, kernel), np.array([float(t) for t in kh]))
                        lost = max(lost, float(abs(linear - closed).max()) / max(1.0, *map(abs, closed)))
                        if (law, s) == ("truesdell", stresses[0]):
                            shown = dict(zip(("at_2", "at_pi"), map(significant, closed), strict=True))
                rows.append({"kernel": kernel, "support_ratio": R, "form": name, **shown, "agree": lost < NOTHING})
    return rows


def printed_with_sph_shapes(kernels: Sequence[str], ratios: Sequence[str], samples: int) -> list[Row]:
    """(87) with Psi_I = V_I W, that is Psi,x(h) = V W'(h) and Psi,xx(h) = V W''(h), against SPH with either stress law."""
    K, kh = Float(), wave_numbers(samples)
    rows = []
    for kernel in kernels:
        for R in ratios:
            slope, curvature = (kernel_derivative(kernel, R, K.number(1), order, K) for order in (1, 2))
            values = replace(lattice_values(1, R, K, kernel_name=kernel), Psi_x_h=slope, Psi_xx_h=curvature)
            for name in ("Galerkin", "symmetric, continuity density"):
                for law in ("truesdell", "cauchy-rate"):
                    form = replace(FORMS[name], law=law)
                    lost = 0.0
                    for s in ("1/2", "-1/2"):
                        state = State(1.0, float(Fraction(s)), 1.0, 0.0)
                        printed = np.array([dni_omega_squared(values, state, float(t), K) for t in kh])
                        sph = omega_squared(SphBase(form, R, s, 0, kernel), kh)
                        lost = max(lost, float(abs(printed - sph).max() / abs(sph).max()))
                    rows.append(
                        {
                            "kernel": kernel,
                            "support_ratio": R,
                            "form": name,
                            "law": law,
                            "equal": lost < NOTHING,
                            "difference": significant(lost, 4),
                        }
                    )
    return rows


def criteria(kernels: Sequence[str], ratios: Sequence[str]) -> list[Row]:
    """W''(h), on whose sign the criterion of SPH rests at kh = pi, beside Psi,xx(h) of (87) in every reading."""
    K = Float()
    rows = []
    for kernel in kernels:
        for R in ratios:
            closed = criterion(kernel, R, 1, K.number(1), K)
            base = SphBase(FORMS["symmetric, continuity density"], R, "1/2", 0, kernel)
            linearised = 2 * float(omega_squared(base, np.array([np.pi]))[0])
            W_xx = kernel_derivative(kernel, R, K.number(1), 2, K)
            Psi = {d: float(lattice_values(1, R, K, "edge", d, kernel).Psi_xx_h) for d in DERIVATIVES}
            rows.append(
                {
                    "kernel": kernel,
                    "support_ratio": R,
                    "W_xx": significant(W_xx),
                    "comes_out": abs(closed - linearised) <= NOTHING * abs(closed),
                    **{f"Psi_xx_{d}": significant(value) for d, value in Psi.items()},
                    **{f"same_{d}": bool(np.sign(value) == np.sign(W_xx)) for d, value in Psi.items()},
                }
            )
    return rows
