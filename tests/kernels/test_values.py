"""Kernels against their textbook definitions, and the facts that make one a kernel."""

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.independent import b_spline_from_library, cubic_kernel_as_printed
from rkverify.errors import UnknownName
from rkverify.kernels import Kernel
from rkverify.kernels import kernel as named

Pieces = Callable[[Fraction], Fraction]
PLACES = st.fractions(0, 2, max_denominator=1000)
K = Exact()


@given(z=PLACES)
@example(z=Fraction(0))
@example(z=Fraction(1, 2))
@example(z=Fraction(3, 5))
@example(z=Fraction(1))
def test_a_kernel_is_its_textbook_definition(kernel: Kernel, independent: Pieces, z: Fraction) -> None:
    """Decides the data: coefficients and joints were derived, and here they meet another derivation, exactly."""
    assert kernel.phi(z, K) == independent(z)


@pytest.mark.decides("E12")
@given(z=PLACES)
@example(z=Fraction(1, 2))
@example(z=Fraction(1))
def test_the_cubic_kernel_is_the_printed_one(z: Fraction) -> None:
    """(12) piece by piece as the paper prints it, at rational z, with the joints among them."""
    assert named("cubic").phi(z, K) == cubic_kernel_as_printed(z)


@pytest.mark.decides("C16")
def test_a_kernel_is_positive_inside_falls_and_ends(kernel: Kernel) -> None:
    """Decides that M of (6) is a sum of positive weights, so that only the geometry can make it singular.

    513 exact samples: between joints a kernel is one polynomial of degree 8 at most.
    """
    values = [kernel.phi(Fraction(j, 512), K) for j in range(513)]
    assert all(v > 0 for v in values[:-1])
    assert all(p > q for p, q in pairwise(values))
    assert values[-1] == 0


ROUNDED = {"float": Float(), "mp": Multiprecision(20)}


@pytest.mark.parametrize("which", ROUNDED)
@given(z=st.floats(0, 1.25, width=32))
@example(z=0.0)
@example(z=1.0)
@example(z=0.5)
def test_rounding_stays_below_the_terms_size(kernel: Kernel, which: str, z: float) -> None:
    """c (b - z)^p is off by (p + 3) epsilon of itself, and b, not always a float, by half an epsilon, p b^(p-1) |c| of it.

    At most 3 terms are added: 3 more. Decides that no cancellation between terms costs more than their own size.
    """
    R, exact = ROUNDED[which], kernel.phi(Fraction(z), K)
    size = sum(
        (abs(t.coefficient) * max(t.end, 1) ** t.power * (2 * t.power + 6) for t in kernel.phi.terms), Fraction(0)
    )
    error = abs(float(kernel.phi(R.number(z), R) - R.number(exact)))
    target(error / (R.epsilon * float(size)), label=f"{kernel.name} in {which}")
    assert error <= R.epsilon * size


@given(z=st.floats(0, 2))
def test_balls_enclose_the_kernel(kernel: Kernel, z: float) -> None:
    B, exact = Ball(15), kernel.phi(Fraction(z), K)
    gap = kernel.phi(B.number(z), B) - B.number(exact)
    assert not B.surely_positive(gap)
    assert not B.surely_positive(-gap)


def test_a_wide_ball_holds_all_values_between(kernel: Kernel) -> None:
    """Decides the branch across a joint: the enclosure over [1/4, 5/4] contains the values of every piece in it."""
    B = Ball(15)
    wide = kernel.phi(B.between("1/4", "5/4"), B)
    for j in range(33):
        gap = wide - B.number(kernel.phi(Fraction(1, 4) + Fraction(j, 32), K))
        assert not B.surely_positive(gap)
        assert not B.surely_positive(-gap)


@pytest.mark.parametrize(("name", "order"), [("tent", 2), ("cubic", 4), ("quartic", 5), ("quintic", 6)])
def test_b_splines_are_those_of_scipy(name: str, order: int) -> None:
    """de Boor's recursion there is `order` convex combinations: 3 epsilon each; the terms here as in the test above."""
    z = np.linspace(0, 1, 201)
    phi = named(name).phi
    size = sum(float(abs(t.coefficient) * t.end**t.power) * (2 * t.power + 6) for t in phi.terms)
    mine = [phi(float(v), Float()) for v in z]
    assert np.abs(np.array(mine) - b_spline_from_library(order, z)).max() <= Float.epsilon * (size + 3 * order)


@pytest.mark.parametrize("name", ["", "Cubic", "gauss"])
def test_an_unknown_name_lists_the_known_ones(name: str) -> None:
    with pytest.raises(UnknownName, match="choose one of cubic, quartic, quintic, tent, wendland-c2, wendland-c4"):
        named(name)
