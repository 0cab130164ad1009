"""Numbers of python-flint, each operation done at the precision of its own arithmetic.

python-flint keeps precision and series length in one global context. A guarded number sets them for its
own operation and puts them back, so that two arithmetics of different precision live side by side.
"""

import operator
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import reduce
from typing import Any

import flint

from rkverify.arithmetic.base import Arithmetic


class FlintArithmetic(Arithmetic):
    """An arithmetic over python-flint numbers at a precision of its own."""

    bits: int = 53
    length: int = 10

    @contextmanager
    def settings(self) -> Iterator[None]:
        """Work at this arithmetic's precision and series length for the time of the block."""
        kept = flint.ctx.prec, flint.ctx.cap
        flint.ctx.prec, flint.ctx.cap = self.bits, self.length
        try:
            yield
        finally:
            flint.ctx.prec, flint.ctx.cap = kept

    def guard(self, make: Callable[[], Any]) -> "Guarded":
        """The result of make(), computed at this arithmetic's settings."""
        with self.settings():
            return Guarded(make(), self)


class Guarded:
    """A python-flint number together with the arithmetic that it belongs to."""

    __slots__ = ("home", "value")

    def __init__(self, value: Any, home: FlintArithmetic) -> None:
        self.value = value
        self.home = home

    def _binary(self, other: Any, operation: Callable[[Any, Any], Any], swap: bool = False) -> "Guarded":
        if isinstance(other, Guarded):
            other = other.value
        elif not isinstance(other, int):
            return NotImplemented
        left, right = (other, self.value) if swap else (self.value, other)
        return self.home.guard(lambda: operation(left, right))

    def __neg__(self) -> "Guarded":
        return self.home.guard(lambda: -self.value)

    def __pos__(self) -> "Guarded":
        return self

    def __add__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.add)

    def __radd__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.add, swap=True)

    def __sub__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.sub)

    def __rsub__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.sub, swap=True)

    def __mul__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.mul)

    def __rmul__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.mul, swap=True)

    def __truediv__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.truediv)

    def __rtruediv__(self, other: Any) -> "Guarded":
        return self._binary(other, operator.truediv, swap=True)

    def __pow__(self, power: int) -> "Guarded":
        if power < 0:
            return 1 / self**-power
        # By multiplication: python-flint's own power of an enclosure that contains 0 has no bounds.
        return self.home.guard(lambda: reduce(operator.mul, [self.value] * power)) if power else self.home.number(1)

    def __repr__(self) -> str:
        return str(self.value)
