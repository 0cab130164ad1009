"""A case of the reference values: what goes in, two routes to what comes out, and the certified numbers."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.certify.certified import ASKED, Certified, certified
from rkverify.certify.reference.by_definition import HOME
from rkverify.errors import Undecided

DIGITS = 40
"""Decimal digits of the first of the two precisions; the second has twice as many."""
Values = Mapping[str, Scalar]
Inputs = dict[str, Any]


@dataclass(frozen=True)
class Subject:
    """Inputs as JSON data with exact rationals, the transcription in any arithmetic, and the route by definition.

    units: the quantity's name before its first bracket -> unit. exact: whether everything is rational.
    """

    name: str
    equations: tuple[int, ...]
    reading: str
    inputs: Inputs
    units: Mapping[str, str]
    literal: Callable[[Arithmetic], Values]
    defined: Callable[[], Values]
    exact: bool = False

    def sha256(self) -> str:
        """The hash of the inputs: SHA-256 of `canonical(inputs)`."""
        return hashlib.sha256(canonical(self.inputs).encode()).hexdigest()

    def unit(self, quantity: str) -> str:
        """The unit of a quantity."""
        return self.units[quantity.partition("[")[0]]

    def certify(self) -> dict[str, Certified]:
        """quantity -> its certified number.

        Raises Undecided where the routes do not agree to the digits asked for, or one has a value that the other lacks.
        """
        precisions = [Exact()] if self.exact else [Multiprecision(DIGITS), Multiprecision(2 * DIGITS)]
        names = ["exact" if self.exact else K.name for K in precisions]
        literal = {name: self.literal(K) for name, K in zip(names, precisions, strict=True)}
        with HOME.settings():
            defined = dict(self.defined())
        first = literal[names[-1]]
        missed = [name for name, value in defined.items() if name not in first and certified({"": value}).text != "0"]
        if missed:
            raise Undecided(f"case {self.name}: only the definition has {missed[0]}: look for a node that was missed")
        return {name: self._settled(name, {**{route: values[name] for route, values in reversed(literal.items())}, "definition": defined[name]}) for name in first}  # fmt: skip

    def _settled(self, name: str, routes: Values) -> Certified:
        found = certified(routes)
        if found.digits < ASKED:
            raise Undecided(
                f"case {self.name}, {name}: the routes agree to {found.digits} digits, {ASKED} are asked for: raise DIGITS"
            )
        return found


def canonical(data: Any) -> str:
    """JSON without spaces, keys sorted, ASCII only: what is hashed.

    >>> canonical({"b": ["1/2"], "a": 1})
    '{"a":1,"b":["1/2"]}'
    """
    return json.dumps(data, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)


def texts(numbers: Any) -> Any:
    """Rationals, or nested sequences of them, as text p or p/q."""
    return str(Fraction(numbers)) if isinstance(numbers, int | Fraction | str) else [texts(n) for n in numbers]


def indexed(name: str, values: Mapping[int, Scalar] | Sequence[Scalar], keep: Sequence[int], *outer: int) -> dict[str, Scalar]:  # fmt: skip
    """name[outer][I] -> value for the indices kept; what a mapping lacks is left out."""
    prefix = name + "".join(f"[{k}]" for k in outer)
    there = values if isinstance(values, Mapping) else dict(enumerate(values))
    return {f"{prefix}[{I}]": there[I] for I in keep if I in there}
