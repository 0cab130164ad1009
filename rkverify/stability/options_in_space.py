"""What an option does to plane waves in a stressed plane, for the readings that a line does not have."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from rkverify.readings import NODAL_INTEGRATIONS, WINDOWS, NodalIntegration, Window
from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.lattices import lattice
from rkverify.stability.bloch.linearised import Linearised, linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.symbol import modes
from rkverify.stability.bloch.zones import commensurate, into_zone
from rkverify.stability.options import compared

Variants = Mapping[str, Callable[[Scheme], Scheme]]
"""Option -> the scheme with it, the default first."""
RULES = ("trapezoid", "midpoint", "gauss:2", "gauss:4")
"""Edge rules, SCNI's default first, and two of the kind gauss:N."""


def _integration(option: NodalIntegration) -> Callable[[Scheme], Scheme]:
    return lambda scheme: replace(scheme, integration=option)


def _rule(option: str) -> Callable[[Scheme], Scheme]:
    return lambda scheme: replace(scheme, edge_rule=option)


def _window(option: Window) -> Callable[[Scheme], Scheme]:
    return lambda scheme: replace(scheme, window=option)


def variants(integration: NodalIntegration) -> dict[str, Variants]:
    """Reading -> its options for schemes of this integration; SCNI stands for the integrations and has the edge rules."""
    found: dict[str, Variants] = {"window": {option: _window(option) for option in WINDOWS}}
    if integration == "scni":
        found["edge_rule"] = {rule: _rule(rule) for rule in RULES}
        found["integration"] = {each: _integration(each) for each in NODAL_INTEGRATIONS}
    return found


def frequencies(of: Linearised, loading: Loading, k: Array) -> list[list[complex]]:
    """At every k (M, 2) both frequencies omega of every mode, 1/time."""
    squares = modes(of, loading, k).omega_squared
    roots = np.sqrt(squares.astype(complex))
    return [[complex(root) for each in (own, -own) for root in each] for own in roots]


def option_rows_in_space(
    ratios: Sequence[str], stresses: Mapping[str, tuple[float, float, float]], count: int
) -> list[dict[str, Any]]:
    """For every integration, support ratio, stress, reading and option: fastest growth (1/time) and distance from the default.

    On the square lattice, over the waves that fit into count by count nodes; lambda = mu = 1, Truesdell's rate.
    """
    nodes = lattice("square")
    k = into_zone(nodes, commensurate(nodes, count))
    rows = []
    for integration, R in product(NODAL_INTEGRATIONS, ratios):
        base = Scheme(integration, float(R))
        for choice, options in variants(integration).items():
            equations = {option: linearised(nodes, taking(base)) for option, taking in options.items()}
            for state, stress in stresses.items():
                found = {option: frequencies(of, Loading(stress), k) for option, of in equations.items()}
                default = next(iter(found.values()))
                rows += [
                    {
                        "choice": choice,
                        "option": option,
                        "integration": integration,
                        "support_ratio": R,
                        "state": state,
                        **compared(default, mine),
                    }
                    for option, mine in found.items()
                ]
    return rows
