"""How smooth a kernel is at its joints, at its node and at its edge: up to its class, and not one derivative further."""

import math
from collections.abc import Callable
from fractions import Fraction

import pytest

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.errors import NotDifferentiable
from rkverify.kernels import KERNELS, Kernel
from rkverify.kernels import kernel as named

Pieces = Callable[[Fraction], Fraction]
Interpolated = Callable[[Pieces, Fraction, Fraction, int], list[Fraction]]
CLASSES = {"tent": 0, "cubic": 2, "quartic": 3, "quintic": 4, "wendland-c2": 2, "wendland-c4": 4}
DEGREE = 8  # the highest of any kernel here


def one_sided(independent: Pieces, interpolated: Interpolated, joint: Fraction, other: Fraction) -> list[Fraction]:
    """The limits at the joint of f, f'/1!, f''/2!, … from the side of `other`: the Taylor coefficients of that piece."""
    return interpolated(independent, joint, other, DEGREE)


def neighbours(kernel: Kernel, joint: Fraction) -> tuple[Fraction, Fraction]:
    below = max((b for b in kernel.joints if b < joint), default=Fraction(0))
    return below, min((b for b in kernel.joints if b > joint), default=Fraction(2))


def agreement(left: list[Fraction], right: list[Fraction]) -> int:
    """The m up to which all derivatives agree; the degree where all of them do."""
    return next((m for m, (p, q) in enumerate(zip(left, right, strict=True)) if p != q), DEGREE + 1) - 1


def test_the_class_at_every_joint(kernel: Kernel, independent: Pieces, interpolated: Interpolated) -> None:
    """One-sided limits of the textbook kernel's derivatives, exact: equal up to the stated class, different one further.

    Decides where a linearisation exists with a node or a cell's edge on a joint (R = 3/2 and R = 2 put one there).
    """
    for joint in kernel.joints:
        below, above = neighbours(kernel, joint)
        left = one_sided(independent, interpolated, joint, below)
        right = one_sided(independent, interpolated, joint, above)
        assert agreement(left, right) == kernel.smoothness_at(joint)


def test_the_class_at_the_node(kernel: Kernel, independent: Pieces, interpolated: Interpolated) -> None:
    """phi(|x|) is mirrored at x = 0: the n-th derivative's left limit is (-1)^n times the right one.

    Where no odd one is left (the quartic spline has no joint at its node) it is as smooth as its degree can show.
    """
    right = one_sided(independent, interpolated, Fraction(0), kernel.joints[0])
    left = [(-1) ** n * c for n, c in enumerate(right)]
    found = agreement(left, right)
    degree = max(t.power for t in kernel.phi.terms)
    assert kernel.smoothness_at_node == (found if any(right[1::2]) else degree)


def test_the_class_over_the_whole_line(kernel: Kernel) -> None:
    """The least over node and joints is the class that the names and the literature state."""
    assert kernel.continuity == CLASSES[kernel.name]


def test_every_kernel_has_its_class_stated() -> None:
    assert set(CLASSES) == set(KERNELS)


def highest(kernel: Kernel) -> int:
    return min(t.power for t in kernel.phi.terms)


@pytest.mark.parametrize("K", [Exact(), Float(), Multiprecision(20), Ball(20)], ids=lambda K: K.name)
@pytest.mark.parametrize("z", ["1.0000000000000002", "1.5", "3", "1e6"])
def test_outside_the_support_everything_is_exactly_zero(kernel: Kernel, K: Arithmetic, z: str) -> None:
    """The first z is the double next to 1. Decides compactness: no 1e-16 couples a node to one it does not reach."""
    for order in range(highest(kernel) + 1):
        assert K.is_zero(kernel.phi.derivative(order)(K.number(z), K))


@pytest.mark.parametrize("K", [Exact(), Float(), Multiprecision(20), Ball(20)], ids=lambda K: K.name)
def test_on_the_edge_everything_continuous_is_exactly_zero(kernel: Kernel, K: Arithmetic) -> None:
    """At z = 1 every derivative of the class there is 0 exactly; the first that jumps has no value and says so."""
    smooth = kernel.smoothness_at(Fraction(1))
    for order in range(smooth + 1):
        assert K.is_zero(kernel.phi.derivative(order)(K.number(1), K))
    if smooth + 1 == highest(kernel):
        with pytest.raises(NotDifferentiable, match="joint"):
            kernel.phi.derivative(smooth + 1)(K.number(1), K)


def test_rounding_a_cells_edge_leaves_nothing_at_the_support_edge() -> None:
    """R = 3/2 and h = 0.05 put x_{I+3/2} within rounding of the edge of a support: z = 1 - k u there, with k below 8.

    (b - z)^3 is then below (8 u)^3 times 4/3, of the order 1e-45; the twin below shows what other forms leave.
    """
    h = 0.05
    for node in range(-40, 41):
        for side in (-1, 1):
            z = abs((node + side) * h + side * h / 2 - node * h) / (1.5 * h)
            # node h is off by 40 h u, so z by 80 u / 1.5 and a few u of its own.
            assert abs(z - 1) <= 60 * Float.epsilon
            assert 0 <= named("cubic").phi(z, Float()) <= 4 / 3 * (60 * Float.epsilon) ** 3


def test_the_twin_that_leaves_rounding_at_the_edge() -> None:
    """The last piece of (12) in Horner's form is not 0 just inside z = 1 and even negative: why the data are powers."""
    horner = [4 / 3 + z * (-4 + z * (4 - z * 4 / 3)) for z in (1 - k * 2.0**-53 for k in range(200))]
    assert max(map(abs, horner)) > 1e-17
    powers = [named("cubic").phi(1 - k * 2.0**-53, Float()) for k in range(200)]
    assert all(0 <= value <= 4 / 3 * (k * 2.0**-53) ** 3 * 1.0001 for k, value in enumerate(powers))


@pytest.mark.parametrize("joint", [Fraction(1, 2), Fraction(1)])
def test_in_doubles_the_cubic_is_continuous_across_its_joints(joint: Fraction) -> None:
    """Next to a joint the value changes by no more than slope times step and rounding (|phi'| <= 2, terms below 2)."""
    at = float(joint)
    beside = [math.nextafter(at, 0), at, math.nextafter(at, 2)]
    values = [named("cubic").phi(z, Float()) for z in beside]
    assert max(values) - min(values) <= 2 * (beside[2] - beside[0]) + 12 * Float.epsilon * values[0]
