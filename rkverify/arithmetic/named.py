"""Arithmetics by name, as the command line spells them; each is imported when it is asked for."""

import importlib

from rkverify.arithmetic.base import Arithmetic
from rkverify.errors import BadInput, UnknownName

# name -> (module, class, whether a count of digits follows the name)
NAMED = {
    "float": ("native", "Float", False),
    "exact": ("native", "Exact", False),
    "mp": ("multiprecision", "Multiprecision", True),
    "ball": ("ball", "Ball", True),
}


def arithmetic(name: str) -> Arithmetic:
    """The arithmetic called float, exact, mp:DIGITS or ball:DIGITS.

    Raises UnknownName, or BadInput where the count of digits is missing or unusable.

    >>> arithmetic("mp:50").name
    'mp:50'
    """
    stem, colon, digits = name.partition(":")
    if stem not in NAMED:
        raise UnknownName("arithmetic", name, ["float", "exact", "mp:DIGITS", "ball:DIGITS"])
    module, cls, wants_digits = NAMED[stem]
    usable = digits.isascii() and digits.isdigit() and int(digits) > 0
    if wants_digits != usable or bool(colon) != wants_digits:
        raise BadInput(
            f"arithmetic {name!r}: write " + (f"{stem}:DIGITS, for instance {stem}:50" if wants_digits else stem)
        )
    made = getattr(importlib.import_module(f"rkverify.arithmetic.{module}"), cls)
    result: Arithmetic = made(int(digits)) if wants_digits else made()
    return result
