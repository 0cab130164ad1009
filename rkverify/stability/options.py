"""What each option of a reading does to a wave, all other readings at their defaults."""

from collections.abc import Sequence
from dataclasses import replace
from math import pi
from typing import Any

from rkverify.readings import (
    CELL_EDGES,
    CELL_MEASURES,
    DERIVATIVES,
    MASSES,
    NODE_MOTIONS,
    STRESS_LAWS,
    SUPPORT_RADII,
)
from rkverify.stability.layers import Setting, dispersion

CHOICES: dict[str, tuple[str, ...]] = {
    "derivative": DERIVATIVES,
    "stress_law": STRESS_LAWS,
    "node_motion": NODE_MOTIONS,
    "cell_edges": CELL_EDGES,
    "cell_measure": CELL_MEASURES,
    "support_radius": SUPPORT_RADII,
    "mass": MASSES,
}
"""Reading -> its options, the default first."""


def motions(setting: Setting, kh: Sequence[float]) -> list[list[complex]]:
    """At every kh the two frequencies omega of largest modulus: those of the motion, not of the state that follows it; 1/time."""
    found: dict[float, list[complex]] = {wave: [] for wave in kh}
    for b in dispersion(setting, kh):
        found[b.kh].append(complex(b.omega.re, b.omega.im))
    return [sorted(omegas, key=abs)[-2:] for omegas in found.values()]


def option_rows(settings: Sequence[Setting], samples: int) -> list[dict[str, Any]]:
    """For every setting, reading and option: the fastest growth and how far its frequencies are from the default's.

    growth in 1/time, at kh = pi n / samples; away: the largest distance of a frequency from the nearest one of the default,
    over the default's largest frequency.
    """
    kh = [pi * n / samples for n in range(1, samples + 1)]
    rows = []
    for setting in settings:
        default = motions(setting, kh)
        size = max(abs(omega) for pair in default for omega in pair)
        for choice, options in CHOICES.items():
            for option in options:
                mine = default if option == options[0] else motions(replace(setting, **_one(choice, option)), kh)
                away = max(
                    min(abs(omega - other) for other in pair)
                    for own, pair in zip(mine, default, strict=True)
                    for omega in own
                )
                growth = max(-omega.imag for pair in mine for omega in pair)
                rows.append({"choice": choice, "option": option, "growth": growth, "away": away / size})
    return rows


def _one(choice: str, option: str) -> dict[str, Any]:
    return {choice: option}
