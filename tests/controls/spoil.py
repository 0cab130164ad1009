"""Run a study's statements with one equation's transcription spoilt after the other; for `test_transcriptions.py`.

Called as: python spoil.py '{"study": …, "smaller": {parameter: value}, "orders": […], "spoil": true}'. Prints as JSON
equation -> "unused" where no transcription of it is called, else, where spoiling was asked for, "unnoticed" where its
statements are made as before with wrong values, and "noticed" where they are not.
"""

import functools
import importlib
import json
import sys
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rkverify.paper import numbered

spoilt: frozenset[str] = frozenset()
"""The functions whose values are wrong for now."""
called: set[str] = set()
"""The functions that have been called."""


def wrong(value: Any) -> Any:
    """Another value of the same shape: three times itself, 1 for 0, and for a list (a basis, a matrix) no multiple."""
    if isinstance(value, dict):
        return {key: wrong(part) for key, part in value.items()}
    if isinstance(value, tuple):
        return tuple(map(wrong, value))
    if isinstance(value, list):
        return [wrong(part) if isinstance(part, list) else part**3 + 1 for part in value]
    return 3 * value + int(value == 0)


def watching(equation: Callable[..., Any]) -> Callable[..., Any]:
    """`equation`, whose functions note that they are called, and give wrong values while they are in `spoilt`."""

    def numbers_of(*numbers: int) -> Callable[..., Any]:
        def mark(transcription: Any) -> Any:
            equation(*numbers)(transcription)
            name = f"{transcription.__module__}.{transcription.__qualname__}"
            if isinstance(transcription, type):
                called.add(name)
                return transcription

            @functools.wraps(transcription)
            def call(*words: Any, **options: Any) -> Any:
                called.add(name)
                value = transcription(*words, **options)
                return wrong(value) if name in spoilt else value

            return call

        return mark

    return numbers_of


def statements(study: Any, parameters: Any) -> dict[str, list[Any]]:
    """Entry -> what the study's statements say of it, verdicts alone."""
    found: dict[str, list[Any]] = {}
    for s in study.judge(parameters, study.compute(parameters)):
        for name in s.about:
            found.setdefault(name, []).append((s.name, s.holds, s.reading))
    return found


def without(functions: frozenset[str], study: Any, parameters: Any) -> dict[str, list[Any]]:
    """The statements with these functions spoilt; none where a wrong value leads to an error."""
    global spoilt
    spoilt = functions
    try:
        return statements(study, parameters)
    except Exception:
        return {}
    finally:
        spoilt = frozenset()


def main(study: str, smaller: dict[str, Any], orders: list[int], spoil: bool) -> dict[str, str]:
    """What becomes of the study's statements on equations of which one holds."""
    numbered.equation = watching(numbered.equation)  # before any transcription is imported
    if orders:
        importlib.import_module("rkverify.certify.kinematics").ORDERS = orders
    found = importlib.import_module(f"studies.{study}").STUDY
    parameters = replace(found.quick, **smaller)
    called.clear()
    right = statements(found, parameters)
    used = frozenset(called)
    told = {}
    wrongly: dict[frozenset[str], dict[str, list[Any]]] = {}
    for entry, said in right.items():
        functions = frozenset(numbered.TRANSCRIBED.get(int(entry[1:]), ())) if entry[0] == "E" else frozenset()
        refuted = any(not holds and not reading for _, holds, reading in said)
        if not functions or refuted or not any(holds for _, holds, _ in said):
            continue
        if not functions & used:
            told[entry] = "unused"
        elif spoil:
            if functions not in wrongly:
                wrongly[functions] = without(functions, found, parameters)
            told[entry] = "unnoticed" if wrongly[functions].get(entry) == said else "noticed"
    return told


if __name__ == "__main__":
    print(json.dumps(main(**json.loads(sys.argv[1]))))
