"""Growth on the simple cubic lattice: along three directions and over the zone, beside the chain's."""

from collections.abc import Sequence
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np

from rkverify.readings import WINDOWS, Window
from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.lattices import cubic
from rkverify.stability.bloch.linearised import Linearised, linearised
from rkverify.stability.bloch.loading import UNIT, Loading
from rkverify.stability.bloch.surveys import NONE, Method, on_chain
from rkverify.stability.bloch.symbol import modes, stiffness
from rkverify.stability.bloch.zones import commensurate, into_zone, worst

Row = dict[str, Any]

STATES: dict[str, tuple[int, ...]] = {
    "no stress": (0, 0, 0, 0, 0, 0),
    "tension": (1, 0, 0, 0, 0, 0),
    "compression": (-1, 0, 0, 0, 0, 0),
    "triaxial tension": (1, 1, 1, 0, 0, 0),
    "triaxial compression": (-1, -1, -1, 0, 0, 0),
    "shear": (0, 0, 0, 1, 0, 0),
}
"""Stresses xx, yy, zz, xy, xz, yz in units of their size."""

DIRECTIONS: dict[str, tuple[int, int, int]] = {"[100]": (1, 0, 0), "[110]": (1, 1, 0), "[111]": (1, 1, 1)}
"""Edge, face diagonal and space diagonal of the cube; the zone's boundary is at pi times each."""


def loading(state: str, size: float) -> Loading:
    """The stress of that name and size."""
    return Loading(tuple(size * part for part in STATES[state]))


def growth_rows(methods: Sequence[Method], ratios: Sequence[str], size: float, count: int) -> list[Row]:
    """The largest growth of waves along each direction and over count^3 waves, and where it is."""
    found = []
    k = into_zone(cubic(), commensurate(cubic(), count))
    for method, R in product(methods, ratios):
        of = _linearised(method, R, "radial")
        for state in STATES:
            load = loading(state, size)
            fastest = worst(of, load, k)
            grows = fastest.growth > NONE
            at = fastest.k if grows else np.zeros(3)
            row: Row = {"method": method.name, "support_ratio": R, "state": state}
            for name, direction in DIRECTIONS.items():
                row[name] = _growth(of, load, along(direction, count))
            row |= {
                "zone": fastest.growth if grows else 0.0,
                "kx": float(at[0]),
                "ky": float(at[1]),
                "kz": float(at[2]),
            }
            found.append(row)
    return found


@lru_cache(maxsize=256)
def _linearised(method: Method, R: str, window: Window) -> Linearised:
    return linearised(cubic(), method.scheme(R, window))


def along(direction: tuple[int, int, int], count: int) -> Array:
    """Wave vectors (count, 3) along a direction to the zone's boundary, k = 0 left out."""
    return np.outer(np.pi * np.arange(1, count + 1) / count, direction)


def _growth(of: Linearised, load: Loading, k: Array) -> float:
    growth = float(modes(of, load, k).growth.max())
    return growth if growth > NONE else 0.0


def chain_rows(methods: Sequence[Method], ratios: Sequence[str], size: float, count: int) -> list[Row]:
    """Growth on the chain with the modulus lambda + 2 mu under tension and compression, and what a wave along x is in space.

    tensor, radial: the largest difference of omega^2 from the chain's of a longitudinal wave along x with that window.
    """
    found = []
    k = along(DIRECTIONS["[100]"], count)
    modulus = UNIT.lame + 2 * UNIT.shear
    for method, R, state in product(methods, ratios, ("tension", "compression")):
        load = loading(state, size)
        squares, growth = on_chain(method, R, load.stress[0], k[:, 0].tolist())
        row: Row = {
            "method": method.name,
            "support_ratio": R,
            "state": state,
            "chain": growth if growth > NONE else 0.0,
        }
        for window in WINDOWS:
            of = _linearised(method, R, window)
            row[window] = float(abs(stiffness(of, load, k)[:, 0, 0, 0, 0] - squares).max()) / modulus
        found.append(row)
    return found


def bound_rows(R: str, count: int, shares: Sequence[float]) -> list[Row]:
    """SCNI's largest growth under compression of these shares of mu."""
    of = _linearised(Method("scni"), R, "radial")
    k = commensurate(cubic(), count)
    return [{"share": share, "growth": _growth(of, loading("compression", share * UNIT.shear), k)} for share in shares]
