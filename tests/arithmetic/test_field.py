"""The four operations and powers, against exact rationals: within the rounding that is allowed, enclosed, or exact."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import pytest
from hypothesis import assume, example, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Exact, Float
from rkverify.arithmetic.series import Series

Interval = tuple[Fraction, Fraction]
FRACTIONS = st.fractions(-1000, 1000, max_denominator=100)
INTEGERS = st.integers(-9, 9)
# One step of a computation: what is done with the running value x, and with which number.
STEPS = st.lists(
    st.one_of(
        st.tuples(st.sampled_from(["x + q", "q + x", "x - q", "q - x", "x * q", "q * x"]), FRACTIONS | INTEGERS),
        st.tuples(st.just("x / q"), (FRACTIONS | INTEGERS).filter(bool)),
        st.tuples(st.just("q / x"), FRACTIONS | INTEGERS),
        st.tuples(st.sampled_from(["-x", "+x", "x**0", "x**1", "x**2"]), st.just(0)),
    ),
    max_size=6,
)


@dataclass(frozen=True)
class Known:
    """An exact value, and how far from it a computation may be whose operations are off by half a unit each."""

    value: Fraction
    error: Fraction

    def rounded(self, half_unit: Fraction) -> "Known":
        return Known(self.value, self.error + half_unit * (abs(self.value) + self.error))


def follow(step: str, x: Known, q: Known, u: Fraction) -> Known:
    """The step in exact arithmetic, with the bound on what rounding does to it (first the operands' errors, then its own)."""
    if step == "-x":
        return Known(-x.value, x.error)
    if step == "+x" or step == "x**1":
        return x
    if step == "x**0":
        return Known(Fraction(1), Fraction(0))
    if step == "x**2":  # the library's pow is within a whole unit, not half of one
        return Known(x.value**2, 2 * abs(x.value) * x.error + x.error**2).rounded(2 * u)
    if "*" in step:
        spread = abs(x.value) * q.error + abs(q.value) * x.error + x.error * q.error
        return Known(x.value * q.value, spread).rounded(u)
    if "/" in step:
        top, bottom = (x, q) if step == "x / q" else (q, x)
        assume(abs(bottom.value) > 2 * bottom.error)
        smallest = abs(bottom.value) - bottom.error
        spread = (abs(bottom.value) * top.error + abs(top.value) * bottom.error) / (abs(bottom.value) * smallest)
        return Known(top.value / bottom.value, spread).rounded(u)
    sign = {"x + q": (1, 1), "q + x": (1, 1), "x - q": (1, -1), "q - x": (-1, 1)}[step]
    return Known(sign[0] * x.value + sign[1] * q.value, x.error + q.error).rounded(u)


def evaluate(step: str, x: Scalar, q: Scalar) -> Scalar:
    return eval(step, {"x": x, "q": q})  # the steps are those listed above


@given(first=FRACTIONS, steps=STEPS)
@example(first=Fraction(1, 10), steps=[("x + q", Fraction(1, 5)), ("x - q", Fraction(3, 10))])  # cancels to 2^-54
@example(first=Fraction(1, 3), steps=[("x * q", 3), ("q - x", 1)])
@example(first=Fraction(7, 5), steps=[("q / x", 2), ("x**2", 0), ("x / q", 3)])
def test_operations_are_right_to_rounding(
    K: Arithmetic, interval: Callable[..., Interval], first: Fraction, steps: list[tuple[str, Fraction | int]]
) -> None:
    """A running error bound is carried along in exact rationals: half an epsilon for each operation, no constant tuned.

    Decides the field of each arithmetic at once: rounding ones stay within the bound, balls enclose the exact value,
    exact ones equal it. Operands are numbers of the arithmetic and plain integers, on either side.
    """
    u = Fraction(K.epsilon) / 2
    x, known = K.number(first), Known(first, Fraction(0)).rounded(u)
    for step, q in steps:
        operand = q if isinstance(q, int) else K.number(q)
        of_operand = Known(Fraction(q), Fraction(0)) if isinstance(q, int) else Known(q, Fraction(0)).rounded(u)
        known = follow(step, known, of_operand, u)
        x = evaluate(step, x, operand)
    low, high = interval(x)
    if known.error:
        target(float(abs(low - known.value) / known.error), label=f"error over bound, {K.name}")
    assert low - known.error <= known.value <= high + known.error


SERIES = Series(4)
EXACT_ONES = {
    "exact": (Exact(), lambda value, slope: value),
    "series": (SERIES, SERIES.variable),
    "dual": (Duals(Exact(), 1), lambda value, slope: Duals(Exact(), 1).along(value, [slope])),
}


@pytest.mark.parametrize("which", EXACT_ONES)
@given(values=st.tuples(FRACTIONS, FRACTIONS, FRACTIONS), slopes=st.tuples(FRACTIONS, FRACTIONS, FRACTIONS))
def test_field_laws_hold_exactly(which: str, values: tuple[Fraction, ...], slopes: tuple[Fraction, ...]) -> None:
    """Decides that an identity proved in these arithmetics is one: no grouping of operations changes a result."""
    K, make = EXACT_ONES[which]
    a, b, c = (make(v, s) for v, s in zip(values, slopes, strict=True))
    laws = [(a + b) + c - (a + (b + c)), (a * b) * c - a * (b * c), a * (b + c) - (a * b + a * c), a * b - b * a]
    if values[0]:
        laws += [a * (1 / a) - 1, b / a * a - b, (a**3) / a - a**2]
    assert all(K.is_zero(law) for law in laws)


def test_the_laws_stop_where_rounding_starts() -> None:
    """The twin: in doubles the sum depends on its grouping, so that is_zero there proves nothing."""
    K = Float()
    a, b, c = (K.number(f"0.{digit}") for digit in (1, 2, 3))
    assert not K.is_zero((a + b) + c - (a + (b + c)))


def truncated_product(p: list[Fraction], q: list[Fraction]) -> list[Fraction]:
    return [sum((p[i] * q[n - i] for i in range(n + 1)), Fraction(0)) for n in range(len(p))]


@given(
    p=st.lists(FRACTIONS, min_size=4, max_size=4),
    q=st.lists(FRACTIONS, min_size=4, max_size=4).filter(lambda q: q[0] != 0),
)
def test_series_multiply_and_divide_as_truncated_polynomials(p: list[Fraction], q: list[Fraction]) -> None:
    """Against the textbook sums for products, and (p/q) q = p for quotients: decides every coefficient, not the first."""

    def series(coefficients: list[Fraction]) -> Scalar:
        t = SERIES.variable(0)
        return sum((SERIES.number(c) * t**n for n, c in enumerate(coefficients)), SERIES.zero())

    assert list(SERIES.coefficients(series(p) * series(q))) == truncated_product(p, q)
    quotient = list(SERIES.coefficients(series(p) / series(q)))
    assert truncated_product(quotient, q) == p
