"""Polynomials in named symbols: sums of rational coefficients times products of powers."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck.reading import rational

Powers = tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Sum:
    """Powers of symbols, in alphabetical order -> coefficient; no coefficient is zero."""

    terms: Mapping[Powers, Fraction]

    def __add__(self, other: "Sum | int") -> "Sum":
        total = dict(self.terms)
        for powers, c in as_sum(other).terms.items():
            total[powers] = total.get(powers, Fraction(0)) + c
        return Sum({powers: c for powers, c in total.items() if c})

    def __mul__(self, other: "Sum | int | Fraction") -> "Sum":
        total: dict[Powers, Fraction] = {}
        for p, a in self.terms.items():
            for q, b in as_sum(other).terms.items():
                exponents = dict(p)
                for name, e in q:
                    exponents[name] = exponents.get(name, 0) + e
                powers = tuple(sorted((name, e) for name, e in exponents.items() if e))
                total[powers] = total.get(powers, Fraction(0)) + a * b
        return Sum({powers: c for powers, c in total.items() if c})

    def __sub__(self, other: "Sum | int") -> "Sum":
        return self + as_sum(other) * -1

    def __pow__(self, exponent: int) -> "Sum":
        total = as_sum(1)
        for _ in range(exponent):
            total = total * self
        return total

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other: int) -> "Sum":
        return as_sum(other) - self

    def put(self, name: str, value: "Sum") -> "Sum":
        """The sum with a symbol replaced; its powers must not be negative."""
        total = as_sum(0)
        for powers, c in self.terms.items():
            rest = Sum({tuple((n, e) for n, e in powers if n != name): c})
            total = total + rest * value ** dict(powers).get(name, 0)
        return total


def as_sum(value: "Sum | int | Fraction") -> Sum:
    """A number as a sum."""
    if isinstance(value, Sum):
        return value
    return Sum({(): Fraction(value)} if value else {})


def symbol(name: str, exponent: int = 1) -> Sum:
    """A symbol, or a power of it."""
    return Sum({((name, exponent),): Fraction(1)})


def from_log(data: Any) -> Sum:
    """A list of [coefficient, {symbol: exponent}]."""
    total: dict[Powers, Fraction] = {}
    if not isinstance(data, list):
        raise BadInput(f"{str(data)[:40]!r} is no list of terms")
    for term in data:
        if not (isinstance(term, list) and len(term) == 2 and isinstance(term[1], dict)):
            raise BadInput(f"{str(term)[:40]!r} is no term: a coefficient and the exponents of its symbols")
        if not all(isinstance(e, int) and not isinstance(e, bool) and e and abs(e) <= 99 for e in term[1].values()):
            raise BadInput(f"{str(term)[:60]!r} has an exponent that is no whole number from -99 to 99")
        powers = tuple(sorted(term[1].items()))
        if powers in total:
            raise BadInput(f"the term {dict(powers)} is listed twice")
        total[powers] = rational(term[0])
    return Sum({powers: c for powers, c in total.items() if c})
