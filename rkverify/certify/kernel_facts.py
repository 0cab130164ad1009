"""Facts of the kernels, exact where they are rational, and their distance from independent transcriptions."""

import sys
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.independent import b_spline_from_library, cubic_kernel_as_printed
from rkverify.kernels import KERNELS, kernel

B_SPLINE_ORDERS = {"tent": 2, "cubic": 4, "quartic": 5, "quintic": 6}


def facts() -> list[dict[str, Any]]:
    """Value at 0, class of continuity, joints, least sampled value and moments of every kernel."""
    K = Exact()
    return [
        {
            "kernel": name,
            "at_zero": str(k.phi.at_zero()),
            "continuity": k.continuity,
            "joints": " ".join(map(str, k.joints)),
            "least": str(min(k.phi(Fraction(j, 64), K) for j in range(65))),
            "moment_0": str(k.phi.moment(0)),
            "moment_2": str(k.phi.moment(2)),
            "source": k.source,
        }
        for name, k in sorted(KERNELS.items())
    ]


def profile(samples: int) -> list[dict[str, Any]]:
    """phi, phi' and phi'' at evenly spaced z in [0, 1[; the tent, which has no second derivative, without it."""
    K = Float()
    rows = []
    for name, k in sorted(KERNELS.items()):
        derivatives = [k.phi, k.phi.derivative(), k.phi.derivative(2) if k.continuity >= 1 else None]
        for j in range(samples):
            z = j / samples
            phi, slope, curvature = (None if f is None else f(z, K) for f in derivatives)
            rows.append({"kernel": name, "z": z, "phi": phi, "slope": slope, "curvature": curvature})
    return rows


def gaps_to_library(samples: int) -> list[dict[str, Any]]:
    """The largest difference from scipy's B-splines; for the cubic kernel from (12)'s printed pieces as well."""
    K = Float()
    places = [j / samples for j in range(samples + 1)]
    rows = []
    for name, order in B_SPLINE_ORDERS.items():
        phi = kernel(name).phi
        gap = max(abs(phi(z, K) - value) for z, value in zip(places, b_spline_from_library(order, places), strict=True))
        if name == "cubic":
            gap += float(
                max(abs(phi(Fraction(j, 64), Exact()) - cubic_kernel_as_printed(Fraction(j, 64))) for j in range(97))
            )
        largest = max(float(abs(t.coefficient) * t.end**t.power) for t in phi.terms)
        rows.append({"kernel": name, "difference": float(gap), "allowed": 64 * sys.float_info.epsilon * largest})
    return rows
