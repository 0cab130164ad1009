"""omega^2 at rest of SPH, of RK with DNI and of (87) side by side: who is unstable in tension, who in compression.

Every omega^2 here is affine in s = sigma/C at a given kh, so that the least stress of either sign that makes a wave grow
follows from two stresses. Unit spacing, m/h and modulus.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.arithmetic.native import Float
from rkverify.paper.notation import lattice_values
from rkverify.readings import DERIVATIVES, Derivative, Readings
from rkverify.solid.kernel_values import Array
from rkverify.stability import jacobian_solid
from rkverify.stability.lattice_state import Base
from rkverify.stability.printed import PrintedQuadratic
from rkverify.stability.sph import FORMS, SphBase, omega_squared
from rkverify.stability.symbol import omega_squared_at_rest

Row = dict[str, Any]
Relation = Callable[[str, str, str, Array], Array]
"""(kernel, R, s, kh) -> omega^2 (len(kh),)."""

NOTHING = 1e-9
"""Below it a coefficient of the order of one is rounding: a thousand operations on numbers below 1e3."""

LONG_WAVE = 0.01


def significant(value: float, digits: int = 9) -> float:
    """The value to some digits; zero where it is rounding."""
    return 0.0 if abs(value) < NOTHING else float(f"{value:.{digits}g}")


def _rk(derivative: Derivative) -> Relation:
    def relation(kernel: str, R: str, s: str, kh: Array) -> Array:
        base = Base(R, Readings("dni", "none", derivative), s, kernel=kernel)
        whole = jacobian_solid.stencil(base)
        return np.array([omega_squared_at_rest(base, whole, float(t), Float()) for t in kh])

    return relation


def _printed(derivative: Derivative) -> Relation:
    def relation(kernel: str, R: str, s: str, kh: Array) -> Array:
        K = Float()
        quadratic = PrintedQuadratic(lattice_values(1, R, K, "edge", derivative, kernel), "dni", K, convective=False)
        state = quadratic.state(s, 0)
        return np.array([quadratic.discriminant(state, float(t)) / 4 for t in kh])

    return relation


def _sph(name: str) -> Relation:
    return lambda kernel, R, s, kh: omega_squared(SphBase(FORMS[name], R, s, 0, kernel), kh)


SPH = tuple(
    name for name in FORMS if name not in ("Galerkin, smoothed over cells", "corrected gradient, summation density")
)
RK: dict[str, Derivative] = {f"RK with DNI, {d}": d for d in ("full", "diffuse")}
PRINT: dict[str, Derivative] = {f"(87), {d}": d for d in DERIVATIVES}

RELATIONS: dict[str, Relation] = {
    **{f"SPH, {name}": _sph(name) for name in SPH},
    **{name: _rk(d) for name, d in RK.items()},
    **{name: _printed(d) for name, d in PRINT.items()},
}
"""What is compared, by name."""


@dataclass(frozen=True)
class Spectrum:
    """omega^2 = constant + s slope at every kh (len(kh),), from s = +-1/2; what is rounding is zero."""

    constant: Array
    slope: Array

    @property
    def tension_limit(self) -> float:
        """The least s > 0 with which some wave grows; inf for none."""
        falls = self.slope < 0
        return float(np.min(-self.constant[falls] / self.slope[falls], initial=np.inf)) + 0.0

    @property
    def compression_limit(self) -> float:
        """The least -s > 0 with which some wave grows; inf for none."""
        falls = self.slope > 0
        return float(np.min(self.constant[falls] / self.slope[falls], initial=np.inf)) + 0.0

    def unstable(self, largest: float) -> str:
        """Which sign of the stress makes a wave grow with |s| < largest."""
        signs = [
            word
            for word, limit in (("tension", self.tension_limit), ("compression", self.compression_limit))
            if limit < largest
        ]
        return " and ".join(signs) or "none"

    def at(self, s: float) -> Array:
        """omega^2 with the stress ratio s."""
        return self.constant + s * self.slope


def spectrum(name: str, kernel: str, R: str, kh: Array) -> Spectrum:
    """The spectrum of a relation by name."""
    tension, compression = (RELATIONS[name](kernel, R, s, kh) for s in ("1/2", "-1/2"))
    constant, slope = (tension + compression) / 2, tension - compression
    constant[abs(constant) < NOTHING], slope[abs(slope) < NOTHING] = 0.0, 0.0
    return Spectrum(constant, slope)


def wave_numbers(samples: int) -> Array:
    """pi n / samples for n = 1, …, samples."""
    return np.pi * np.arange(1, samples + 1) / samples


def spectra(kernels: Sequence[str], ratios: Sequence[str], kh: Array) -> dict[tuple[str, str, str], Spectrum]:
    """(kernel, R, relation) -> its spectrum."""
    return {
        (kernel, R, name): spectrum(name, kernel, R, kh) for kernel in kernels for R in ratios for name in RELATIONS
    }


def with_long_wave(samples: int) -> Array:
    """A long wave, then pi n / samples for n = 1, …, samples."""
    return np.append(LONG_WAVE, wave_numbers(samples))


def comparison(found: Mapping[tuple[str, str, str], Spectrum], largest: float) -> list[Row]:
    """Every spectrum, the first of its kh LONG_WAVE and the last pi: these two, limits of the stress, unstable signs."""
    rows = []
    for (kernel, R, name), whole in found.items():
        waves = Spectrum(whole.constant[1:], whole.slope[1:])
        long = {s: significant(float(whole.at(s)[0]) / ((1 + s) * LONG_WAVE**2), 6) for s in (0.5, -0.5)}
        rows.append(
            {
                "kernel": kernel,
                "support_ratio": R,
                "relation": name,
                "long_wave_tension": long[0.5],
                "long_wave_compression": long[-0.5],
                "at_pi_unstressed": significant(float(waves.constant[-1])),
                "at_pi_per_stress": significant(float(waves.slope[-1])),
                "tension_limit": significant(waves.tension_limit),
                "compression_limit": significant(waves.compression_limit),
                "unstable": waves.unstable(largest),
            }
        )
    return rows


def agreement(found: Mapping[tuple[str, str, str], Spectrum], largest: float) -> list[Row]:
    """RK with DNI and (87) against every form of SPH: the same unstable sign, and the least relative difference.

    The difference is max |omega^2 - omega^2_SPH| / max |omega^2_SPH| over kh and s = +-1/2; the least over the forms.
    """
    waves = {key: Spectrum(whole.constant[1:], whole.slope[1:]) for key, whole in found.items()}
    rows = []
    for (kernel, R, name), own in waves.items():
        if name.startswith("SPH, "):
            continue
        of_sph = {form: waves[kernel, R, f"SPH, {form}"] for form in SPH}
        sign = own.unstable(largest)
        rows.append(
            {
                "kernel": kernel,
                "support_ratio": R,
                "relation": name,
                "unstable": sign,
                "as_symmetric": sign == of_sph["symmetric, continuity density"].unstable(largest),
                "as_corrected": sign == of_sph["corrected gradient"].unstable(largest),
                "least_difference": significant(min(_apart(own, q) for q in of_sph.values()), 4),
            }
        )
    return rows


def _apart(one: Spectrum, other: Spectrum) -> float:
    return max(float(abs(one.at(s) - other.at(s)).max() / abs(other.at(s)).max()) for s in (0.5, -0.5))
