"""Derivatives are derived from the data; here they meet exact differences, series, complex steps and duals."""

from collections.abc import Callable
from fractions import Fraction
from math import factorial

import pytest
from hypothesis import assume, given, target
from hypothesis import strategies as st

from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.series import Series
from rkverify.errors import NotDifferentiable
from rkverify.kernels import Kernel
from rkverify.kernels import kernel as named

Pieces = Callable[[Fraction], Fraction]
Interpolated = Callable[[Pieces, Fraction, Fraction, int], list[Fraction]]
ORDERS = st.integers(1, 3)
INSIDE = st.fractions(Fraction(1, 1000), Fraction(999, 1000), max_denominator=1000)
K = Exact()


def available(kernel: Kernel, order: int) -> int:
    """The order, or the highest that is a function."""
    return min(order, *(t.power for t in kernel.phi.terms))


def gap_between_joints(kernel: Kernel, z: Fraction) -> tuple[Fraction, Fraction]:
    """The joints next to z, which must not be one itself."""
    assume(z not in kernel.joints)
    low = max((b for b in (Fraction(0), *kernel.joints) if b < z), default=Fraction(0))
    return low, min(b for b in (*kernel.joints, Fraction(2)) if b > z)


@given(order=ORDERS, z=INSIDE)
def test_derivatives_are_those_of_the_interpolating_polynomial(
    kernel: Kernel, independent: Pieces, interpolated: Interpolated, order: int, z: Fraction
) -> None:
    """An exact difference: degree + 1 values of the textbook kernel beside z determine its piece, and so its derivative."""
    order = available(kernel, order)
    _, high = gap_between_joints(kernel, z)
    degree = max(t.power for t in kernel.phi.terms)
    coefficients = interpolated(independent, z, high, degree)
    coefficients += [Fraction(0)] * (order + 1)
    assert kernel.phi.derivative(order)(z, K) == factorial(order) * coefficients[order]


@given(order=ORDERS, z=INSIDE)
def test_derivatives_are_the_coefficients_of_series(kernel: Kernel, order: int, z: Fraction) -> None:
    order = available(kernel, order)
    f, S = kernel.phi.derivative(order), Series(order + 1)
    coefficients = S.coefficients(kernel.phi(S.variable(z), S))
    assert len(coefficients) == order + 1 or z in kernel.joints
    if len(coefficients) > order:
        assert f(z, K) == factorial(order) * coefficients[order]


@given(order=ORDERS, z=st.floats(0.001, 0.999))
def test_derivatives_are_complex_steps_and_dual_slopes(kernel: Kernel, order: int, z: float) -> None:
    """The derivative of the derivative below, in two arithmetics of doubles, against the exact value at the same double.

    Each of at most 3 terms c (b - z)^p is off by 2 p + 6 epsilon of c max(b, 1)^p, in value and in slope p c (b - z)^(p-1).
    """
    order = available(kernel, order)
    f, lower = kernel.phi.derivative(order), kernel.phi.derivative(order - 1)
    assume(Fraction(z) not in kernel.joints)
    allowed = Float.epsilon * float(sum(abs(t.coefficient) * (2 * (t.power + 1) + 6) for t in f.terms))
    exact, step, D = float(f(Fraction(z), K)), 2.0**-120, Duals(Float(), 1)
    stepped = lower(complex(z, step), Complex()).imag / step
    slope = lower(D.variable(z, 0), D).partials[0]
    target(max(abs(stepped - exact), abs(slope - exact)) / allowed, label=f"{kernel.name}, order {order}")
    assert abs(stepped - exact) <= allowed
    assert abs(slope - exact) <= allowed


def test_the_derivative_that_would_be_a_point_mass_is_refused(kernel: Kernel) -> None:
    """The twin: the last derivative that is a function is one of steps; one more has masses at the joints."""
    last = min(t.power for t in kernel.phi.terms)
    kernel.phi.derivative(last)
    with pytest.raises(NotDifferentiable, match="point masses"):
        kernel.phi.derivative(last + 1)


@given(z=INSIDE, b=st.fractions(0, 2, max_denominator=50))
def test_over_z_is_the_quotient(kernel: Kernel, z: Fraction, b: Fraction) -> None:
    """g(z) = phi'(z)/z is what gradients are built on: another form inside the first joint, the quotient itself beyond."""
    slope = kernel.phi.derivative()
    for place in (z, b):
        if place and not (kernel.name == "tent" and place == 1):
            assert slope.over_z(place, K) == slope(place, K) / place


def test_over_z_at_zero_is_the_second_derivative(kernel: Kernel) -> None:
    """Decides that nothing is divided by zero at a node: the limit of phi'(z)/z is phi''(0), where phi'(0) = 0."""
    slope = kernel.phi.derivative()
    if kernel.continuity >= 1:
        assert slope.over_z(Fraction(0), K) == kernel.phi.derivative(2).at_zero()
        assert slope.over_z(0.0, Float()) == pytest.approx(
            float(kernel.phi.derivative(2).at_zero()), rel=64 * Float.epsilon
        )
    else:
        with pytest.raises(NotDifferentiable, match="peak"):
            slope.over_z(Fraction(0), K)


@pytest.mark.parametrize("K", [Duals(Exact(), 1), Duals(Float(), 1), Series(3)], ids=lambda K: K.name)
def test_the_peak_is_refused_in_every_arithmetic_that_differentiates(K: Duals | Series) -> None:
    """Decides that a slope at the tent's peak is answered in our words also where z is 0 and moves."""
    z = K.variable(0, 0) if isinstance(K, Duals) else K.variable(0)
    with pytest.raises(NotDifferentiable, match="peak"):
        named("tent").phi.derivative().over_z(z, K)


def test_over_z_keeps_its_digits_next_to_the_node(kernel: Kernel) -> None:
    """The twin of the division: phi'(z)/z by quotient loses digits as z falls, the other form loses none.

    Its terms are products, off by (2 p + 6) epsilon each of sum |c| p b^(p-2).
    """
    if kernel.continuity == 0:
        return
    slope = kernel.phi.derivative()
    allowed = Float.epsilon * float(
        sum(abs(t.coefficient) * t.power * max(t.end, 1) * (2 * t.power + 6) for t in slope.terms)
    )
    for exponent in (10, 40, 200, 1000):
        z = 2.0**-exponent
        assert abs(slope.over_z(z, Float()) - float(slope.over_z(Fraction(z), K))) <= allowed
