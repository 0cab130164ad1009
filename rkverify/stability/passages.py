"""Waves on moving bases, many settings in a row: nonlinear beside linear, with N and without, for either sign of Q."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.base import Scalar
from rkverify.readings import CONVECTIONS, Convection, Integration, Readings
from rkverify.stability.lattice_state import Base
from rkverify.stability.moving_base import Passage, starting_amplitudes, wave_on_chain, wave_on_lattice

Row = dict[str, Any]


@dataclass(frozen=True)
class Wave:
    """Integration, R = a/h, sigma/C^sigma, kh (rad), and what the wave starts as: growing or oscillating."""

    integration: Integration
    support_ratio: str
    stress_ratio: str
    kh: float
    start: str

    def base(self, convection: Convection, Q: Scalar) -> Base:
        """The base state with this N and velocity gradient."""
        return Base(self.support_ratio, Readings(self.integration, convection), self.stress_ratio, Q)


def _row(wave: Wave, domain: str, convection: str, Q: Scalar, passage: Passage) -> Row:
    return {
        "domain": domain,
        "integration": wave.integration,
        "convection": convection,
        "Q": str(Q),
        "support_ratio": wave.support_ratio,
        "stress_ratio": wave.stress_ratio,
        "kh": passage.kh,
        "start": wave.start,
        "duration": passage.duration,
        "frequency": abs(passage.rate.imag),
        "nonlinear": passage.nonlinear_growth,
        "moving": passage.moving_growth,
        "frozen": passage.frozen_growth,
        "error": passage.error,
    }


def lattice_rows(waves: Sequence[Wave], gradients: Sequence[str], duration: float) -> list[Row]:
    """On the periodic lattice, without N and with the true rate, under which the base stays uniform."""
    return [
        _row(w, "lattice", c, Q, wave_on_lattice(w.base(c, Q), w.kh, w.start, duration))
        for w in waves
        for Q in gradients
        for c in CONVECTIONS
        if c != "psi-star"
    ]


def chain_rows(waves: Sequence[Wave], gradients: Sequence[str], duration: float, count: int) -> list[Row]:
    """On a finite chain, with every N: with Psi* the base depends on the position."""
    return [
        _row(w, "chain", c, Q, wave_on_chain(w.base(c, Q), count, w.kh, duration, w.start))
        for w in waves
        for Q in gradients
        for c in CONVECTIONS
    ]


def validity_rows(waves: Sequence[Wave], shares: Sequence[str], convections: Sequence[Convection]) -> list[Row]:
    """Growing waves over one e-folding time of the frozen base, with Q a share of the growth at rest."""
    rows = []
    for wave in waves:
        _, at_rest = starting_amplitudes(wave.base("none", 0), wave.kh, "growing")
        for convection in convections:
            for share in shares:
                Q = Fraction(share) * Fraction(at_rest.real).limit_denominator(10**6)
                passage = wave_on_lattice(wave.base(convection, Q), wave.kh, "growing")
                rows.append(
                    {
                        "integration": wave.integration,
                        "support_ratio": wave.support_ratio,
                        "stress_ratio": wave.stress_ratio,
                        "kh": passage.kh,
                        "convection": convection,
                        "Q_over_growth": share,
                        "growth_at_rest": at_rest.real,
                        "frozen": passage.frozen_growth,
                        "moving": passage.moving_growth / passage.frozen_growth,
                        "nonlinear": passage.nonlinear_growth / passage.frozen_growth,
                        "error": passage.error,
                    }
                )
    return rows


def first_beyond(shares: Sequence[float], values: Sequence[float], allowed: float) -> float:
    """The least share at which |value - 1| reaches `allowed`, between the samples by a straight line; inf if none does.

    shares grow and start above 0, where the value is 1.

    >>> first_beyond([0.25, 0.5], [1.0, 1.5], 0.25)
    0.375
    """
    previous_share, previous_gap = 0.0, 0.0
    for share, value in zip(shares, values, strict=True):
        gap = abs(value - 1)
        if gap >= allowed:
            return previous_share + (share - previous_share) * (allowed - previous_gap) / (gap - previous_gap)
        previous_share, previous_gap = share, gap
    return float("inf")
