"""The printed relations along kh and over maps, as enclosures: every printed digit and every sign is certain."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from rkverify.arithmetic.ball import Ball
from rkverify.certify.enclosed import certain_digits, half_wave_numbers
from rkverify.paper.notation import lattice_values
from rkverify.paper.printed_lagrangian import b_hat, bandwidth, omega_squared
from rkverify.readings import Derivative, HalfPoint
from rkverify.stability.printed import PrintedQuadratic

Row = dict[str, Any]
PRECISION = 30


def _samples(samples: int, K: Ball) -> tuple[list[str], list[Any]]:
    kh = [K.number(0), *half_wave_numbers(samples, K)]
    return [certain_digits(theta, 10) for theta in kh], kh


def lagrangian_frequencies(support_ratios: Sequence[str], samples: int) -> list[Row]:
    """omega h / c of (63) at kh = 0, …, pi for every R."""
    K = Ball(PRECISION)
    labels, kh = _samples(samples, K)
    rows = []
    for R in support_ratios:
        b = b_hat(1, R, K)
        for label, theta in zip(labels, kh, strict=True):
            squared = omega_squared(b, K.number(1), theta, K)
            rows.append({"support_ratio": R, "kh": label, "omega": certain_digits(K.sqrt(squared))})
    return rows


def frequencies_near_pi(support_ratios: Sequence[str], samples: int) -> list[Row]:
    """Largest omega h / c over the samples, its kh, and omega at 0.9 pi, 0.95 pi and pi."""
    K = Ball(PRECISION)
    labels, kh = _samples(samples, K)
    rows = []
    for R in support_ratios:
        b = b_hat(1, R, K)

        def omega(theta: Any, b: list[Any] = b) -> Any:
            return K.sqrt(omega_squared(b, K.number(1), theta, K))

        values = [omega(theta) for theta in kh]
        peak = max(range(len(values)), key=lambda j: K.witness(values[j]))
        late = {name: omega(K.pi() * n / 20) for name, n in (("at_090_pi", 18), ("at_095_pi", 19), ("at_pi", 20))}
        rows.append(
            {
                "support_ratio": R,
                "half_width": bandwidth(R, K),
                "peak": certain_digits(values[peak], 10),
                "kh_of_peak": labels[peak],
                **{name: certain_digits(value, 10) for name, value in late.items()},
                "ratio_090": certain_digits(late["at_090_pi"] / values[peak], 10),
            }
        )
    return rows


@dataclass(frozen=True)
class Reading:
    """Integration with the readings of the derivative and of C(h/2) that its relation depends on."""

    integration: str
    half_point: HalfPoint = "edge"
    derivative: Derivative = "full"

    @property
    def label(self) -> str:
        """The reading that matters: of C(h/2) for SCNI, of the derivative for DNI."""
        return self.half_point if self.integration == "scni" else self.derivative


def relation(reading: Reading, support_ratio: str, spacing: str, K: Ball, convective: bool = True) -> PrintedQuadratic:
    """The printed quadratic on the uniform lattice."""
    values = lattice_values(spacing, support_ratio, K, reading.half_point, reading.derivative)
    return PrintedQuadratic(values, reading.integration, K, convective)


def discriminants(
    readings: Sequence[Reading],
    support_ratio: str,
    spacings: Sequence[str],
    stresses: Sequence[str],
    gradients: Sequence[str],
    samples: int,
) -> list[Row]:
    """D h^2 rho / C^sigma of (79) or (85) at kh = 0, …, pi for every combination."""
    K = Ball(PRECISION)
    labels, kh = _samples(samples, K)
    rows = []
    for reading, h in product(readings, spacings):
        quadratic = relation(reading, support_ratio, h, K)
        for stress, Q in product(stresses, gradients):
            state = quadratic.state(stress, Q)
            for label, theta in zip(labels, kh, strict=True):
                D = quadratic.discriminant(state, theta) * K.number(h) ** 2
                rows.append(
                    {
                        "reading": reading.label,
                        "spacing": h,
                        "stress_ratio": stress,
                        "Q": Q,
                        "kh": label,
                        "D": certain_digits(D, 9),
                    }
                )
    return rows


def census(
    readings: Sequence[Reading],
    support_ratios: Sequence[str],
    spacings: Sequence[str],
    stresses: Sequence[str],
    gradients: Sequence[str],
    samples: int,
) -> list[Row]:
    """For every combination the certain signs of D over kh = pi/samples, …, pi: how many of each, and the extremes.

    A sample whose enclosure contains 0 is counted as neither.
    """
    K = Ball(PRECISION)
    _, kh = _samples(samples, K)
    rows = []
    for reading, R, h in product(readings, support_ratios, spacings):
        quadratic = relation(reading, R, h, K)
        for stress, Q in product(stresses, gradients):
            state = quadratic.state(stress, Q)
            D = [quadratic.discriminant(state, theta) * K.number(h) ** 2 for theta in kh[1:]]
            below, above = sum(K.surely_positive(-value) for value in D), sum(K.surely_positive(value) for value in D)
            middle = [K.witness(value) for value in D]
            rows.append(
                {
                    "reading": reading.label,
                    "support_ratio": R,
                    "spacing": h,
                    "stress_ratio": stress,
                    "Q": Q,
                    "negative": below,
                    "positive": above,
                    "neither": len(D) - below - above,
                    "least": certain_digits(D[middle.index(min(middle))], 10),
                    "largest": certain_digits(D[middle.index(max(middle))], 10),
                }
            )
    return rows


def convective_gain(support_ratio: str, spacing: str, stress: str, Q: str, samples: int) -> float:
    """The largest D(Q) - D(0) over kh, over the largest D(0): how much the convective term adds for SCNI."""
    K = Ball(PRECISION)
    quadratic = relation(Reading("scni"), support_ratio, spacing, K)
    _, kh = _samples(samples, K)
    with_term, without = (
        [quadratic.discriminant(quadratic.state(stress, gradient), theta) for theta in kh] for gradient in (Q, "0")
    )
    gains = [K.witness(a - b) for a, b in zip(with_term, without, strict=True)]
    return float(max(gains) / max(K.witness(b) for b in without))
