"""The committed file of worst cases: TOML with doubles in hexadecimal, so that nothing of them is lost.

Every [[case]] has its name, quantity, found_by (the search), nodes and what the quantity takes, as `case.KINDS` lists it. error
is the largest one when the case was found, on the processor of the search; all else is input.
"""

import tomllib
from collections.abc import Sequence
from hashlib import sha256
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from rkverify.certify.worst.case import ARRAYS, KINDS, WorstCase
from rkverify.errors import BadInput, UnknownName
from rkverify.kernels import KERNELS
from rkverify.paths import checkout
from rkverify.readings import known_window
from rkverify.solid.kernel_values import Array

VERSION = 1
READINGS = ("full", "diffuse")
"""Of derivatives: those whose bound is derived."""
SHAPES = {"nodes": 2, "supports": 1, "point": 1, "velocity": 1, "node_velocities": 2, "cell": 2, "low": 1, "high": 1}


def committed() -> Path:
    """Where the cases are."""
    return checkout().studies / "data" / "worst_cases.toml"


def fingerprint() -> str:
    """SHA-256 of the file, so that a study depends on it."""
    return sha256(committed().read_bytes()).hexdigest()


def read_cases(path: Path | None = None) -> list[WorstCase]:
    """The cases of a file, the committed one unless another is given.

    Raises BadInput, in one line, naming file, case and entry: what is no TOML, another version, an entry that is missing
    or not taken, a number that is no finite double in hexadecimal, counts that do not fit, two cases of one name.
    """
    file = committed() if path is None else path
    try:
        data = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise BadInput(f"{file.name}: no worst cases can be read: {str(error).splitlines()[0]}") from None
    if data.get("version") != VERSION or not isinstance(data.get("case"), list):
        raise BadInput(
            f"{file.name}: version {data.get('version')!r} with [[case]] tables is asked for as version {VERSION}"
        )
    cases = [_case(told, f"{file.name}, case {number}") for number, told in enumerate(data["case"])]
    names = [case.name for case in cases]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise BadInput(f"{file.name}: two cases are named {twice!r}: rename one")
    return cases


def _case(told: Any, place: str) -> WorstCase:
    if not isinstance(told, dict):
        raise BadInput(f"{place} is no table: write [[case]]")
    place += f" ({told.get('name', 'without a name')})"
    quantity = told.get("quantity")
    if quantity not in KINDS:
        raise BadInput(f"{place}: {UnknownName('quantity', str(quantity), list(KINDS))}")
    wanted = ("name", "quantity", "found_by", "error", "nodes", *KINDS[quantity].takes)
    for key in wanted:
        if key not in told:
            raise BadInput(f"{place}: {key} is missing, which {quantity!r} takes")
    for key in told:
        if key not in wanted:
            raise BadInput(f"{place}: {key} is nothing that {quantity!r} takes: remove it")
    values: dict[str, Any] = {
        key: _array(told[key], f"{place}, {key}", SHAPES[key]) if key in ARRAYS else told[key] for key in wanted
    }
    values["error"] = _double(told["error"], f"{place}, error")
    _check(values, place)
    return WorstCase(**values)


def _check(values: dict[str, Any], place: str) -> None:
    count, d = values["nodes"].shape
    if d not in (1, 2, 3):
        raise BadInput(f"{place}: the nodes have {d} coordinates: give 1, 2 or 3")
    shapes = {"supports": (count,), "point": (d,), "velocity": (d,), "node_velocities": (count, d), "low": (d,), "high": (d,)}  # fmt: skip
    for key, shape in shapes.items():
        if key in values and values[key].shape != shape:
            raise BadInput(
                f"{place}: {key} has the shape {values[key].shape}, {count} nodes in {d} dimensions need {shape}"
            )
    if "cell" in values and (values["cell"].shape[1] != d or len(values["cell"]) < d + 1 or d > 2):
        raise BadInput(
            f"{place}: cell has the shape {values['cell'].shape}: give 2 ends on a line, 3 corners or more in the plane"
        )
    if "kernel" in values and (values["kernel"] not in KERNELS or KERNELS[values["kernel"]].continuity < 2):
        smooth = [name for name, kernel in KERNELS.items() if kernel.continuity >= 2]
        raise BadInput(f"{place}: {UnknownName('C2 kernel', str(values['kernel']), smooth)}")
    if "order" in values and values["order"] not in (0, 1, 2):
        raise BadInput(f"{place}: order {values['order']!r} is not offered: choose 0, 1 or 2")
    if "reading" in values and values["reading"] not in READINGS:
        raise BadInput(f"{place}: {UnknownName('reading', str(values['reading']), READINGS)}")
    if "window" in values:
        try:
            known_window(values["window"])
        except UnknownName as error:
            raise BadInput(f"{place}: {error}") from None


def _array(told: Any, place: str, levels: int) -> Array:
    if not isinstance(told, list) or not told:
        raise BadInput(f"{place}: give a list of numbers")
    rows = told if levels == 2 else [told]
    if not all(isinstance(row, list) and len(row) == len(rows[0]) for row in rows):
        raise BadInput(f"{place}: every row needs as many numbers as the first")
    table = np.array([[_double(text, place) for text in row] for row in rows])
    return table if levels == 2 else table[0]


def _double(text: Any, place: str) -> float:
    try:
        # Without 0x a decimal would be read as hexadecimal.
        if not isinstance(text, str) or not text.lstrip("-").startswith("0x"):
            raise ValueError
        value = float.fromhex(text)
    except (ValueError, OverflowError):
        raise BadInput(f"{place}: {text!r} is no double in hexadecimal: write float.hex(x), as 0x1.8p+0") from None
    if not isfinite(value):
        raise BadInput(f"{place}: {text!r} is not finite")
    return value


def written(cases: Sequence[WorstCase]) -> str:
    """The text of a file with these cases."""
    parts = [f"version = {VERSION}\n"]
    for case in cases:
        lines = ["[[case]]"]
        for key in ("name", "quantity", "found_by", "error", *KINDS[case.quantity].takes, "nodes"):
            value = getattr(case, key)
            lines.append(f"{key} = {_shown(value) if key in ARRAYS else _quoted(value)}")
        parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


def _quoted(value: Any) -> str:
    if isinstance(value, float):
        return f'"{value.hex()}"'
    return str(value) if isinstance(value, int) else '"' + str(value).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _shown(numbers: Array) -> str:
    if np.ndim(numbers) == 1:
        return "[" + ", ".join(f'"{float(n).hex()}"' for n in numbers) + "]"
    return "[\n" + "".join(f"  {_shown(row)},\n" for row in numbers) + "]"
