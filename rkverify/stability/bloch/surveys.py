"""Tables over stresses, support ratios and wave vectors, and the chain beside the plane."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any, cast

import numpy as np

from rkverify.arithmetic.native import Float
from rkverify.readings import Derivative, Integration, NodalIntegration
from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch.lattices import lattice
from rkverify.stability.bloch.linearised import Linearised, linearised
from rkverify.stability.bloch.loading import UNIT, Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.symbol import modes, stiffness
from rkverify.stability.bloch.zero_energy import strains
from rkverify.stability.bloch.zones import commensurate, into_zone, worst
from rkverify.stability.layers import Setting, dispersion

Row = dict[str, Any]

STATES: dict[str, tuple[int, int, int]] = {
    "no stress": (0, 0, 0),
    "tension": (1, 0, 0),
    "compression": (-1, 0, 0),
    "biaxial tension": (1, 1, 0),
    "biaxial compression": (-1, -1, 0),
    "shear": (0, 0, 1),
    "reversed shear": (0, 0, -1),
}
"""Stresses xx, yy, xy in units of their size."""

NONE = 1e-5
"""Growth below this is none: an omega^2 of rounding, some 1e-13, has the root 3e-7."""


@dataclass(frozen=True)
class Method:
    """An integration with its edge rule and its reading of the derivative."""

    integration: NodalIntegration
    derivative: Derivative = "full"
    rule: str | None = None

    @property
    def name(self) -> str:
        """What it is called in tables and drawings."""
        extra = self.derivative if self.integration == "dni" else self.rule
        return f"{self.integration.upper()} {extra}" if extra else self.integration.upper()

    def scheme(self, ratio: str, window: Any = "radial") -> Scheme:
        """With this support ratio."""
        return Scheme(self.integration, float(Fraction(ratio)), self.rule, self.derivative, window=window)


def loading(state: str, size: float) -> Loading:
    """The stress of that name and size."""
    xx, yy, xy = (size * part for part in STATES[state])
    return Loading((xx, yy, xy))


def growth_rows(
    lattices: Sequence[str], methods: Sequence[Method], ratios: Sequence[str], size: float, count: int
) -> list[Row]:
    """The largest growth over waves that fit into count by count periods, where it is, and how stiff that wave is without stress."""
    found = []
    for name, method, R in product(lattices, methods, ratios):
        nodes = lattice(name)
        of = linearised(nodes, method.scheme(R))
        k = into_zone(nodes, commensurate(nodes, count))
        for state in STATES:
            fastest = worst(of, loading(state, size), k)
            grows = fastest.growth > NONE
            at = fastest.k if grows else np.zeros(2)
            found.append(
                {
                    "lattice": name,
                    "method": method.name,
                    "support_ratio": R,
                    "state": state,
                    "growth": fastest.growth if grows else 0.0,
                    "kx": float(at[0]),
                    "ky": float(at[1]),
                    "strain": _least_strain(of, at),
                }
            )
    return found


def _least_strain(of: Linearised, k: Array) -> float:
    """The least strain that a wave of unit amplitude has in its cells, 0 for a zero-energy mode; 1/length."""
    least = float(np.linalg.svd(strains(of, k[None]), compute_uv=False).min())
    return least if least > 1e-12 else 0.0


def zone_rows(
    name: str, methods: Sequence[Method], R: str, states: Sequence[str], size: float, points: int
) -> list[Row]:
    """Growth over half of the square lattice's Brillouin zone, ky from 0 to pi: -k has the growth of k."""
    kx, ky = np.linspace(-np.pi, np.pi, 2 * points - 1), np.linspace(0, np.pi, points)
    k = np.stack(np.meshgrid(kx, ky, indexing="ij"), axis=-1).reshape(-1, 2)
    found = []
    for method in methods:
        of = linearised(lattice(name), method.scheme(R))
        for state in states:
            growth = modes(of, loading(state, size), k).growth.max(axis=1)
            for (x, y), g in zip(k.tolist(), growth.tolist(), strict=True):
                found.append(
                    {"method": method.name, "state": state, "kx": x, "ky": y, "growth": g if g > NONE else 0.0}
                )
    return found


def chain_rows(
    lattices: Sequence[str], methods: Sequence[Method], ratios: Sequence[str], size: float, count: int
) -> list[Row]:
    """Growth on the chain with the modulus lambda + 2 mu beside that in the plane, under tension and compression along x.

    along_axis: the largest difference of omega^2 from the chain's of a longitudinal wave along x with the tensor window.
    """
    kh = [float(np.pi * j / count) for j in range(1, count + 1)]
    found = []
    for method, R, state in product(methods, ratios, ("tension", "compression")):
        load = loading(state, size)
        squares, growth = on_chain(method, R, load.stress[0], kh)
        along = stiffness(
            linearised(lattice("square"), method.scheme(R, "tensor")), load, np.array([[q, 0.0] for q in kh])
        )
        row: Row = {
            "method": method.name,
            "support_ratio": R,
            "state": state,
            "chain": growth,
            "along_axis": float(abs(along[:, 0, 0, 0, 0] - squares).max()),
        }
        for name in lattices:
            nodes = lattice(name)
            k = commensurate(nodes, count)
            row[name] = worst(linearised(nodes, method.scheme(R)), load, k).growth
        for column in ("chain", *lattices):
            row[column] = row[column] if row[column] > NONE else 0.0
        found.append(row)
    return found


def on_chain(method: Method, R: str, stress: float, kh: Sequence[float]) -> tuple[Array, float]:
    """omega^2 (len(kh),) of the chain with the modulus lambda + 2 mu under the stress, and the largest growth."""
    modulus = UNIT.lame + 2 * UNIT.shear
    setting = Setting(
        "semi-lagrangian", cast(Integration, method.integration), R, stress / modulus, derivative=method.derivative, layer="as-defined", convective=False
    )  # fmt: skip
    branches = dispersion(setting, kh, Float())
    squares = modulus * np.array([branch.omega.squared[0] for branch in branches])[::2]
    return squares, modulus**0.5 * max(branch.omega.growth for branch in branches)


def bound_rows(lattices: Sequence[str], R: str, count: int, shares: Sequence[float]) -> list[Row]:
    """SCNI's largest growth under compression of these shares of mu: it starts where sigma + mu 1 is no longer positive."""
    found = []
    for name, share in product(lattices, shares):
        nodes = lattice(name)
        of = linearised(nodes, Method("scni").scheme(R))
        grows = worst(of, loading("compression", share * UNIT.shear), commensurate(nodes, count)).growth
        found.append({"lattice": name, "share": share, "growth": grows if grows > NONE else 0.0})
    return found
