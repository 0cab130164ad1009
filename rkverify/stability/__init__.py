"""Dispersion relations and stability, layer by layer: printed, as-defined, consistent, simulated.

>>> from rkverify.stability import Setting, dispersion
>>> branches = dispersion(Setting("semi-lagrangian", "dni", "7/4", stress_ratio="-1/2", layer="as-defined"), [3.0])
>>> branches[0].omega.growth > 0.5
True
"""

from importlib import import_module
from typing import Any

PUBLIC = ("Branch", "Setting", "dispersion")


def __getattr__(name: str) -> Any:
    """The one function and what it takes and gives, imported when they are asked for."""
    if name in PUBLIC:
        return getattr(import_module("rkverify.stability.layers"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
