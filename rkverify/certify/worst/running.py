"""Running error analysis: values with bounds on what rounding in doubles did to them, operation by operation.

J. H. Wilkinson's method (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 3.3): fl(x op y) =
(x op y)(1 + d) with |d| <= u, so each operation hands on the errors of its operands, and adds u times what it gives. An
error that goes into many numbers, such as that of a kernel's value, can be kept by itself, as a source: what it does is
then added with its sign, as in affine arithmetic (L. H. de Figueiredo and J. Stolfi, Numer. Algorithms 37, 2004, 147-158).
The products of two errors are kept. The bounds themselves are computed in doubles: `SLACK` covers their rounding.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from rkverify.solid.kernel_values import Array

UNIT = 2.0**-53
SLACK = 1.01
"""A bound of some 10^4 operations on positive numbers is off by 10^-12 of itself; the rest is for values that are not exact."""


@dataclass(frozen=True, eq=False)
class Rounded:
    """Values (…) and bounds (…), in units of u = 2^-53, on the errors of the doubles that were computed for them.

    An error is at most error + sum_s |shared_s|: shared (S, …) is what each of S sources, between -1 and 1, does to it.
    """

    value: Array
    error: Array
    shared: Array = field(default_factory=lambda: np.zeros(0))
    __array_ufunc__ = None  # arrays leave operations with these numbers to them

    @cached_property
    def sources(self) -> Array:
        """shared (S, …), empty where there are no sources."""
        return self.shared if self.shared.size else np.zeros((0, *self.value.shape))

    @cached_property
    def reach(self) -> Array:
        """The whole bound on the error (…), in units of u."""
        found: Array = self.error + abs(self.sources).sum(axis=0)
        return found

    @property
    def bound(self) -> Array:
        """The whole bound on the error (…)."""
        found: Array = SLACK * UNIT * self.reach
        return found

    def alone(self) -> "Rounded":
        """The same without sources, their parts added without sign."""
        return Rounded(self.value, self.reach)

    def __add__(self, other: Any) -> "Rounded":
        """Nothing is rounded where one of the two is 0 and known to be."""
        o = rounded(other)
        value = self.value + o.value
        shared = _sum(_like(self, value), _like(o, value))
        return _made(value, self.error + o.error, shared, self.reach + o.reach, _nothing(self) | _nothing(o))

    __radd__ = __add__

    def __neg__(self) -> "Rounded":
        return Rounded(-self.value, self.error, -self.shared)

    def __sub__(self, other: Any) -> "Rounded":
        return self + (-rounded(other))

    def __rsub__(self, other: Any) -> "Rounded":
        return rounded(other) - self

    def __mul__(self, other: Any) -> "Rounded":
        """Nothing is rounded where one of the two is a power of 2, or 0, and known to be."""
        o = rounded(other)
        value = self.value * o.value
        both = UNIT * self.reach * o.reach
        error = abs(self.value) * o.error + abs(o.value) * self.error + both
        shared = _sum(_like(self, value) * o.value, _like(o, value) * self.value)
        reach = abs(self.value) * o.reach + abs(o.value) * self.reach + both
        return _made(value, error, shared, reach, _power_of_two(self) | _power_of_two(o))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> "Rounded":
        """Of numbers whose errors have no sources; without bound where the divisor may be 0."""
        o = rounded(other)
        with np.errstate(divide="ignore", invalid="ignore"):
            value = self.value / o.value
            least = abs(o.value) - UNIT * o.reach
            error = np.where(least > 0, (self.reach + abs(value) * o.reach) / least, np.inf)
        return _made(value, error, np.zeros(0), error, _power_of_two(o))

    def __rtruediv__(self, other: Any) -> "Rounded":
        return rounded(other) / self

    def __abs__(self) -> "Rounded":
        return Rounded(abs(self.value), self.reach)

    def __getitem__(self, which: Any) -> "Rounded":
        inside = (slice(None), *which) if isinstance(which, tuple) else (slice(None), which)
        return Rounded(self.value[which], self.error[which], self.sources[inside])

    @property
    def T(self) -> "Rounded":
        """The transpose of a matrix."""
        return Rounded(self.value.T, self.error.T, self.sources.transpose(0, 2, 1))

    def sqrt(self) -> "Rounded":
        """|sqrt(x + e) - sqrt(x)| = |e| / (sqrt(x + e) + sqrt(x)), of numbers whose errors have no sources."""
        root = np.sqrt(self.value)
        with np.errstate(divide="ignore", invalid="ignore"):
            error = self.reach / (root + np.sqrt(np.maximum(self.value - UNIT * self.reach, 0)))
        error = np.where(self.reach == 0, 0.0, error)
        return _made(root, error, np.zeros(0), error, np.zeros_like(root, dtype=bool))

    def total(self) -> "Rounded":
        """The sum over the last axis, one after the other in their order."""
        partial = abs(np.cumsum(self.value, axis=-1)) + UNIT * np.cumsum(self.reach, axis=-1)
        error = self.error.sum(axis=-1) + partial[..., 1:].sum(axis=-1)
        return Rounded(self.value.sum(axis=-1), error, self.sources.sum(axis=-1))

    def total_in_any_order(self) -> "Rounded":
        """The sum over the last axis, whatever the order of its n - 1 additions."""
        sizes = (abs(self.value) + UNIT * self.reach).sum(axis=-1)
        error = self.error.sum(axis=-1) + (self.value.shape[-1] - 1) * sizes
        return Rounded(self.value.sum(axis=-1), error, self.sources.sum(axis=-1))


def _made(value: Array, error: Array, shared: Array, reach: Array, exact: Array) -> Rounded:
    """With the rounding of the result, unless it is exact."""
    rounding = np.where(exact, 0.0, abs(value) + UNIT * reach)
    return Rounded(value, error + rounding, shared)


def _like(x: Rounded, value: Array) -> Array:
    """The sources of x, to be broadcast with those of numbers of another shape."""
    return x.sources.reshape(len(x.sources), *[1] * (value.ndim - x.value.ndim), *x.value.shape)


def _sum(one: Array, other: Array) -> Array:
    """The sum of what sources do, where one of the two numbers knows the first sources alone."""
    if len(one) < len(other):
        one, other = other, one
    if not len(other):
        return one
    shape = np.broadcast_shapes(one.shape[1:], other.shape[1:])
    total: Array = np.broadcast_to(one, (len(one), *shape)).copy()
    total[: len(other)] += other
    return total


def _nothing(x: Rounded) -> Array:
    return (x.value == 0) & (x.reach == 0)


def _power_of_two(x: Rounded) -> Array:
    return ((abs(np.frexp(x.value)[0]) == 0.5) | (x.value == 0)) & (x.reach == 0)


def rounded(x: Any) -> Rounded:
    """A number that doubles hold exactly, or what is a `Rounded` already."""
    if isinstance(x, Rounded):
        return x
    value = np.asarray(x, dtype=float)
    return Rounded(value, np.zeros_like(value))


def stacked(parts: list[Rounded]) -> Rounded:
    """Arrays of the same shape along a new first axis."""
    count = max(len(p.sources) for p in parts)
    shape = parts[0].value.shape
    shared = np.zeros((count, len(parts), *shape))
    for i, part in enumerate(parts):
        shared[: len(part.sources), i] = part.sources
    return Rounded(np.stack([p.value for p in parts]), np.stack([p.error for p in parts]), shared)


def constant(x: float) -> Rounded:
    """A coefficient that was rounded once, unless it is a fraction with a small power of 2 below it.

    >>> float(constant(0.5).error), float(constant(4 / 3).error) == 4 / 3
    (0.0, True)
    """
    value = np.asarray(x, dtype=float)
    short = float(x) * 2.0**20 == round(float(x) * 2.0**20)
    return Rounded(value, np.zeros_like(value) if short else abs(value))


class Book:
    """The sources of one computation, numbered in the order in which they are met."""

    def __init__(self) -> None:
        self.count = 0

    def own(self, x: Rounded) -> Rounded:
        """The same (n,), with the error of every entry a source of its own."""
        size = x.value.size
        shared = np.zeros((self.count + size, size))
        shared[: len(x.sources)] = x.sources
        shared[self.count :] = np.diag(x.error)
        self.count += size
        return Rounded(x.value, np.zeros_like(x.error), shared)
