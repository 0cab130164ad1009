"""Data of the explorer: kernels as the library has them, which settings the browser can compute, and which waves were measured."""

import csv
import json
from fractions import Fraction
from typing import Any

from rkverify.kernels import KERNELS
from rkverify.paths import Checkout
from rkverify.readings import DERIVATIVES, HALF_POINTS

RELATIONS = {
    "lagrangian-scni": 63,
    "semi-scni": 76,
    "semi-dni": 82,
    "semi-scni-without": 86,
    "semi-dni-without": 87,
}
"""Setting -> the printed relation that it is held against."""


def kernels() -> dict[str, Any]:
    """Name -> [coefficient, end, power] of every truncated power, of the kernels that have a linearisation."""
    return {
        name: [[float(t.coefficient), float(t.end), t.power] for t in kernel.phi.terms]
        for name, kernel in KERNELS.items()
        if kernel.continuity >= 2
    }


MEASURED = ("stability_layers", "measured.csv")
"""The study and the table of waves that were measured in nonlinear computations: the layer simulated."""


def measured(place: Checkout) -> list[dict[str, Any]]:
    """The waves of that table on bases that are not stretched, in the explorer's terms; none without results."""
    path = place.results.joinpath(*MEASURED)
    if not path.is_file():
        return []
    with path.open(encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if Fraction(row["stretch"]) == 1]
    names = ("formulation", "integration", "derivative", "kernel", "quantity")
    return [
        {name: row[name] for name in names}
        | {"R": float(Fraction(row["support_ratio"])), "s": float(Fraction(row["stress_ratio"]))}
        | {"kh": float(row["kh"]), "value": float(row["measured"]), "words": _words(row)}
        for row in rows
    ]


def _words(row: dict[str, str]) -> str:
    derivative = f" {row['derivative']}" if row["integration"] == "dni" else ""
    kind = "Lagrangian " if row["formulation"] == "lagrangian" else ""
    return f"{kind}{row['integration'].upper()}{derivative}, {row['kernel']}, R = {row['support_ratio']}, sigma/C = {row['stress_ratio']}: {row['quantity']}"


def data(place: Checkout) -> str:
    """What the script reads, as JSON."""
    return json.dumps({"kernels": kernels(), "measured": measured(place)})


def options() -> dict[str, tuple[str, ...]]:
    """The names in the explorer's lists."""
    return {"kernel": tuple(kernels()), "derivative": DERIVATIVES, "half_point": HALF_POINTS}
