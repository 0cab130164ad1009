"""Section 4.1 in numbers: the stress law, the stencil (61) on a plane wave, (63), and the gradients (64)."""

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.certify.independent import linear_shape_functions_in_closed_form
from rkverify.paper.printed_lagrangian import (
    b_hat,
    bandwidth,
    first_piola_kirchhoff,
    green_strain,
    omega_squared,
    second_piola_kirchhoff,
    stencil_acceleration,
    tangent,
)

K = Multiprecision(30)
FRACTIONS = st.fractions(-5, 5, max_denominator=50)
GRADIENTS = st.integers(1, 3).flatmap(lambda m: st.lists(FRACTIONS, min_size=2 * m + 1, max_size=2 * m + 1))
ANGLES = st.fractions(-4, 4, max_denominator=100)


@pytest.mark.decides("E53", "E54", "E55", "E59", "C27")
@given(F=st.fractions(Fraction(1, 10), 5, max_denominator=50), modulus=FRACTIONS)
def test_the_tangent_is_the_slope_of_the_stress(F: Fraction, modulus: Fraction) -> None:
    """dP/dF of P = S F with S = C^SE (F^2 - 1)/2 by duals and by an exact difference, P being a cubic in F."""
    D = Duals(Exact(), 1)

    def stress(F: object) -> object:
        return first_piola_kirchhoff(second_piola_kirchhoff(modulus, green_strain(F)), F)

    expected = tangent(modulus, F, second_piola_kirchhoff(modulus, green_strain(F)))
    assert stress(D.variable(F, 0)).partials[0] == expected
    h = Fraction(1, 7)
    assert (8 * (stress(F + h) - stress(F - h)) - (stress(F + 2 * h) - stress(F - 2 * h))) / (12 * h) == expected
    assert green_strain(Fraction(1)) == stress(Fraction(1)) == 0


def wave(theta: object) -> Callable[[int], object]:
    return lambda n: K.context.mpc(K.cos(n * theta), K.sin(n * theta))


@pytest.mark.decides("E61", "E63", "C31")
@given(b=GRADIENTS, c_squared=FRACTIONS, kh=ANGLES)
@example(b=[Fraction(1), Fraction(2), Fraction(4)], c_squared=Fraction(-1), kh=Fraction(1))
def test_the_stencil_on_a_plane_wave_is_the_relation(b: list[Fraction], c_squared: Fraction, kh: Fraction) -> None:
    """(61) on e^{ikIh} is -omega^2 of (63) times the wave, for gradients of any value, odd or not.

    At most 49 products of sizes below 25 * 5: off by 49 * 5 * 125 epsilon, less than 1e5 epsilon = 1e-35.
    """
    numbers, c2, theta = [K.number(v) for v in b], K.number(c_squared), K.number(kh)
    acceleration = stencil_acceleration(numbers, c2, wave(theta))
    assert abs(acceleration + omega_squared(numbers, c2, theta, K)) < 1e5 * K.epsilon


@given(b=GRADIENTS, kh=ANGLES)
def test_the_relation_is_a_squared_modulus(b: list[Fraction], kh: Fraction) -> None:
    """omega^2 = c^2 |sum_K b_K e^{iK kh}|^2: another sum, and never negative beyond rounding where c^2 is not."""
    numbers, u = [K.number(v) for v in b], wave(K.number(kh))
    total = sum(v * u(n) for n, v in enumerate(numbers))
    squared = omega_squared(numbers, K.number(2), K.number(kh), K)
    assert abs(squared - 2 * abs(total) ** 2) < 1e5 * K.epsilon
    assert squared > -1e5 * K.epsilon


def test_the_twin_with_the_other_index() -> None:
    """b_I^{I+J} for b_I^{I-J} in (61) changes nothing for odd gradients but a sign, and for others it is not (63)."""
    theta, one = K.number(1), K.number(1)
    for b, sign in (([K.number(v) for v in (-1, 0, 1)], -1), ([K.number(v) for v in (1, 2, 4)], None)):
        turned = sum(
            b[k + 1] * b[1 + j] * wave(theta)(j + k) for k in (-1, 0, 1) for j in (-1, 0, 1)
        )  # what (61) says with I + J: the square, not the squared modulus
        expected = omega_squared(b, one, theta, K)
        assert (abs(turned - (sign or 1) * expected) < 100 * K.epsilon) == (sign is not None)


@pytest.mark.parametrize(
    ("R", "m"), [("1.1", 1), ("3/2", 2), ("1.4999", 1), (2, 2), ("2.5", 3), ("3.5", 4), ("0.4", 0), (3, 3)]
)
def test_the_half_width_is_the_printed_one(R: object, m: int) -> None:
    """m = int(R + 0.5), in exact numbers and in doubles, where R + 0.5 must not fall below an integer."""
    assert bandwidth(R, Exact()) == m
    assert bandwidth(float(Fraction(R)), Float()) == m


def own_gradients(h: Fraction, R: Fraction, reach: int) -> list[Fraction]:
    """(52) on the lattice from order 1's closed form: Psi_0 at the edges of the cells -reach, …, reach."""
    nodes = [n * h for n in range(-reach - 5, reach + 6)]
    middle, supports = reach + 5, [R * h] * (2 * reach + 11)

    def Psi(x: Fraction) -> Fraction:
        return linear_shape_functions_in_closed_form(nodes, supports, x).get(middle, Fraction(0))

    return [(Psi(n * h + h / 2) - Psi(n * h - h / 2)) / h for n in range(-reach, reach + 1)]


@pytest.mark.decides("E64", "C29")
@pytest.mark.parametrize("R", ["11/10", "3/2", "7/4", 2, "5/2", "7/2"])
@pytest.mark.parametrize("h", ["1/20", 1])
def test_the_gradients_are_those_of_the_closed_form(R: object, h: object) -> None:
    """b^ of (64) against another formula, and beyond m nothing is left out: two cells more on each side are zero.

    Where R + 1/2 is an integer even the outermost of the 2 m + 1 is zero: m is one more than needed.
    """
    ratio, spacing = Fraction(R), Fraction(h)
    m = bandwidth(ratio, Exact())
    b, own = b_hat(spacing, ratio, Exact()), own_gradients(spacing, ratio, m + 2)
    assert b == own[2:-2]
    assert own[:2] == own[-2:] == [0, 0]
    assert (b[0] == 0) == ((ratio + Fraction(1, 2)).denominator == 1)


def test_for_three_halves_the_gradients_are_plus_and_minus_one_half() -> None:
    """Only two nodes reach a cell's edge, and by symmetry share the partition of unity: Psi = 1/2 there, whatever the kernel."""
    for kernel in ("cubic", "quartic", "quintic", "tent", "wendland-c2"):
        assert b_hat("1/20", "3/2", Exact(), kernel) == [0, 10, 0, -10, 0]


@pytest.mark.parametrize("R", ["3/2", 2, "7/2"])
def test_long_waves_travel_with_the_continuums_speed(R: object) -> None:
    """omega/(c k) = 1 - O((kh)^2): the error falls by four for half the wave number, so (63) is consistent of order 2.

    The next term is (kh)^2 = 1e-8 times a ratio of coefficients below 1e2.
    """
    b, errors = b_hat(1, R, K), []
    for kh in (K.number("1e-4"), K.number("5e-5")):
        errors.append(K.sqrt(omega_squared(b, K.number(1), kh, K)) / kh - 1)
    assert errors[0] < 0
    assert abs(errors[0] / errors[1] - 4) < 1e-5


@pytest.mark.parametrize("R", ["11/10", "3/2", 2, "7/2"])
def test_at_the_ends_of_the_band_the_frequency_is_zero(R: object) -> None:
    """sum b = 0 at kh = 0; at kh = pi the gradients are odd, so the alternating sum vanishes too: exactly."""
    b = b_hat(1, R, Exact())
    m = len(b) // 2
    assert sum(b) == 0
    assert sum((-1) ** n * value for n, value in enumerate(b)) == 0
    assert sum((n - m) * value for n, value in enumerate(b)) == -1  # sum_L b_I^L x_L: Psi is a partition of unity
