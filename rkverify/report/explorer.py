"""Data of the explorer: kernels as the library has them, and which settings the browser can compute."""

import json
from typing import Any

from rkverify.kernels import KERNELS
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


def data() -> str:
    """What the script reads, as JSON."""
    return json.dumps({"kernels": kernels()})


def options() -> dict[str, tuple[str, ...]]:
    """The names in the explorer's lists."""
    return {"kernel": tuple(kernels()), "derivative": DERIVATIVES, "half_point": HALF_POINTS}
