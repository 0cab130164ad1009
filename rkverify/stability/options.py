"""What each option of a reading does to a wave, all other readings at their defaults."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import pi
from typing import Any

from rkverify.readings import (
    CELL_EDGES,
    CELL_MEASURES,
    CONVECTIONS,
    DERIVATIVES,
    HALF_POINTS,
    MASSES,
    NODE_MOTIONS,
    STRESS_LAWS,
    SUPPORT_RADII,
    Convection,
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
"""Reading that is a field of a setting as defined -> its options, the default first."""

Variants = Mapping[str, Callable[[Setting], Setting]]
"""Option -> the setting with it, the default first."""


def _taking(choice: str, option: str) -> Callable[[Setting], Setting]:
    fields: dict[str, Any] = {choice: option}
    return lambda setting: replace(setting, **fields)


def _printed(option: str) -> Callable[[Setting], Setting]:
    fields: dict[str, Any] = {"half_point": option, "layer": "printed"}
    return lambda setting: replace(setting, **fields)


def _with_rate(option: Convection) -> Callable[[Setting], Setting]:
    return lambda setting: replace(
        setting, layer="consistent" if option == "true" else "as-defined", convective=option != "none"
    )


VARIANTS: dict[str, Variants] = {
    **{choice: {option: _taking(choice, option) for option in options} for choice, options in CHOICES.items()},
    "half_point": {option: _printed(option) for option in sorted(HALF_POINTS, key="edge".__ne__)},
    "convection": {option: _with_rate(option) for option in CONVECTIONS},
}
"""Every reading that a wave on a line has -> its options: C(h/2) is one of the printed relations, the rate in N one of two layers."""


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
        known: dict[Setting, list[list[complex]]] = {}
        for choice, variants in VARIANTS.items():
            first = next(iter(variants.values()))(setting)
            for option, taking in variants.items():
                chosen = taking(setting)
                for each in (first, chosen):
                    if each not in known:
                        known[each] = motions(each, kh)
                rows.append({"choice": choice, "option": option, **compared(known[first], known[chosen])})
    return rows


def compared(default: Sequence[Sequence[complex]], mine: Sequence[Sequence[complex]]) -> dict[str, float]:
    """The fastest growth (1/time) among frequencies, wave by wave, and how far they are from the default's at most.

    >>> compared([[1, -1]], [[1.5, -1.5 - 0.25j]])
    {'growth': 0.25, 'away': 0.5590169943749475}
    """
    size = max(abs(omega) for pair in default for omega in pair)
    away = max(
        min(abs(omega - other) for other in pair) for own, pair in zip(mine, default, strict=True) for omega in own
    )
    return {"growth": max(-omega.imag for pair in mine for omega in pair), "away": away / size}
