"""A derivative that a kernel does not have is refused, by every road that could lead to one."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Complex, Exact, Float
from rkverify.arithmetic.series import Series
from rkverify.errors import NotDifferentiable
from rkverify.kernels import Kernel, Term, TruncatedPowers
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.kernel_rates import direction, phi, phi_rate, phi_second_rate, semi_lagrangian_kernel_rate
from rkverify.paper.material_rates import psi_star
from rkverify.paper.shape import shape_functions, shape_gradient, shape_second

D, S = Duals(Exact(), 1), Series(4)
NODES = [[0], [1], [2], [3]]
NODE, JOINT, EDGE = "1", "7/4", "5/2"  # of the node at 1 with the support 3/2: z = 0, 1/2, 1


def made(kernel: str, K: Arithmetic, support: str = "3/2") -> Approximation:
    return approximation(NODES, support, K, kernel)


def duals(x: str) -> tuple[Arithmetic, Scalar]:
    return D, D.variable(x, 0)


def complex_step(x: str) -> tuple[Arithmetic, Scalar]:
    return Complex(), complex(float(Fraction(x)), 2.0**-100)


def series(x: str) -> tuple[Arithmetic, Scalar]:
    return S, S.variable(x)


ROADS = {"duals": duals, "complex step": complex_step, "series": series}


@pytest.mark.parametrize("x", [NODE, EDGE], ids=["at the node", "at the edge"])
@pytest.mark.parametrize("K", [Exact(), Float()], ids=lambda K: K.name)
def test_the_tents_gradient_is_refused_at_its_kinks(K: Arithmetic, x: str) -> None:
    with pytest.raises(NotDifferentiable):
        shape_gradient(made("tent", K), (K.number(x),))


@pytest.mark.parametrize("road", ROADS)
@pytest.mark.parametrize("x", [NODE, EDGE], ids=["at the node", "at the edge"])
def test_no_road_gives_the_tent_a_slope_at_its_kinks(road: str, x: str) -> None:
    """Left and right of a kink the slopes differ: -1/a and 1/a at the node. A one-sided one must not pass for the slope.

    Decides that a linearisation with a kernel that is not C1 is refused where a node sits on a kink. Series may also
    stop before the coefficient of t, as they do at joints.
    """
    K, at = ROADS[road](x)
    try:
        values = shape_functions(made("tent", K), (at,))
    except NotDifferentiable:
        return
    assert road == "series"
    assert all(len(S.coefficients(Psi)) <= 1 for Psi in values.values())


@pytest.mark.parametrize("road", ROADS)
def test_beside_a_kink_every_road_gives_the_same_slope(road: str) -> None:
    """The twin: anywhere else the tent has a slope, and the roads agree with the gradient (doubles to 1e-13)."""
    x = "6/5"
    K, at = ROADS[road](x)
    exact = shape_gradient(made("tent", Exact()), (Fraction(x),))
    for I, Psi in shape_functions(made("tent", K), (at,)).items():
        slope = {
            "duals": lambda v: v.partials[0],
            "complex step": lambda v: v.imag * 2.0**100,
            "series": lambda v: S.coefficients(v)[1],
        }[road](Psi)
        assert abs(slope - exact[I]) <= (1e-13 if road == "complex step" else 0)


@pytest.mark.parametrize(("kernel", "known"), [("cubic", 3), ("wendland-c2", 3), ("quintic", 5), ("tent", 1)])
def test_a_series_at_a_node_ends_with_the_kernels_class(kernel: str, known: int) -> None:
    """phi(|t|) is C^m at the node and not C^(m+1): of its series the coefficients up to t^m exist, and no more.

    Decides that a coefficient that is given is a derivative from both sides, as it is at joints.
    """
    long = Series(6)
    assert len(long.coefficients(phi(made(kernel, long), (long.variable(NODE),), 1))) == known


@pytest.mark.parametrize("x", [NODE, JOINT, EDGE], ids=["at the node", "at the joint", "at the edge"])
def test_the_third_derivative_of_a_c2_kernel_is_refused_where_it_jumps(x: str) -> None:
    """The slope of Psi,xx: at node, joint and edge alike phi''' jumps, and one side's value is not a derivative."""
    with pytest.raises(NotDifferentiable):
        shape_second(made("cubic", D), (D.variable(x, 0),))


def test_away_from_all_of_them_the_third_derivative_is_there() -> None:
    """The twin, against the t^3 coefficient of the series."""
    slopes = shape_second(made("cubic", D), (D.variable("6/5", 0),))
    expected = shape_functions(made("cubic", S), (S.variable("6/5"),))
    assert {I: v.partials[0] for I, v in slopes.items()} == {I: 6 * S.coefficients(v)[3] for I, v in expected.items()}


def test_at_a_node_the_c2_kernel_has_all_that_a_linearisation_needs() -> None:
    """Duals of Psi and of Psi,x at a node, a joint and an edge, against exact first and second derivatives."""
    for x in (NODE, JOINT, EDGE):
        A, at = made("cubic", Exact()), (Fraction(x),)
        moving = (D.variable(x, 0),)
        values, gradients = shape_functions(made("cubic", D), moving), shape_gradient(made("cubic", D), moving)
        assert {I: v.partials[0] for I, v in values.items()} == shape_gradient(A, at)
        assert {I: v.partials[0] for I, v in gradients.items()} == shape_second(A, at)


MAKE_STAR: dict[str, Callable[[Arithmetic, Scalar], dict[int, Scalar]]] = {
    "psi_star": lambda K, x: psi_star(made("cubic", K), (x,), (K.number(1),), [(K.number(I),) for I in range(4)]),
    "kernel rate": lambda K, x: {
        I: semi_lagrangian_kernel_rate(made("cubic", K), (x,), I, (K.number(1),), (K.number(I * I),)) for I in range(3)
    },
}


@pytest.mark.parametrize("what", MAKE_STAR)
def test_the_slope_of_a_material_rate_at_a_node_is_there(what: str) -> None:
    """Psi* is linearised with points at nodes, where |x - x_I| = 0 moves: there (35) is phi''(0) (x - x_I)(v - v_I)/a^2.

    Duals against the t coefficient of the series: the direction n has no value there, the product with phi' has.
    """
    found = MAKE_STAR[what](D, D.variable(NODE, 0))
    expected = MAKE_STAR[what](S, S.variable(NODE))
    assert {I: v.partials[0] for I, v in found.items()} == {I: S.coefficients(v)[1] for I, v in expected.items()}


def test_the_direction_has_no_value_at_its_own_node() -> None:
    """(36): n is a unit vector everywhere else, and at the node the rate does without it."""
    A = made("cubic", Exact())
    with pytest.raises(NotDifferentiable, match="ask for another point"):
        direction(A, (Fraction(1),), 1)
    assert direction(A, (Fraction(1),), 2) == (-1,)
    assert semi_lagrangian_kernel_rate(A, (Fraction(1),), 1, (Fraction(3),), (Fraction(5),)) == 0


@pytest.mark.parametrize("K", [Duals(Float(), 2), Complex()], ids=lambda K: K.name)
def test_in_the_plane_the_tents_peak_has_no_slope_either(K: Arithmetic) -> None:
    """The distance is taken as 0 there with no slope: right for kernels smooth in y, and silently wrong for a cone."""
    A = approximation([[0, 0], [1, 0], [0, 1]], 2, K, "tent", 0)
    x = (K.variable(0, 0), K.variable(0, 1)) if isinstance(K, Duals) else (2.0**-100 * 1j, K.zero())
    with pytest.raises(NotDifferentiable):
        shape_functions(A, x)


def test_second_derivatives_need_a_c2_kernel() -> None:
    for kernel in ("cubic", "wendland-c2"):
        shape_second(made(kernel, Exact()), (Fraction(NODE),))
    for x in (NODE, "6/5"):
        with pytest.raises(NotDifferentiable):
            shape_second(made("tent", Exact()), (Fraction(x),))


def test_a_tent_that_does_not_move_has_the_rate_zero() -> None:
    """The twin of the refusal at the peak: without relative motion nothing is differentiated."""
    assert phi_rate(made("tent", Exact()), (Fraction(NODE),), 1, (Fraction(0),)) == 0


def test_a_peak_at_the_node_has_no_second_derivative_there_and_one_beside_it() -> None:
    """(1 - z)^3 is smooth but for its peak: 6 (1 - z)/a^2 at any other place, on either side, and a refusal at the node."""
    K, a = Exact(), Fraction(3, 2)
    peak = Kernel("peak", TruncatedPowers((Term(Fraction(1), Fraction(1), 3),)), "for this test")
    A = approximation(NODES, a, K, peak)
    one = (Fraction(1),)
    for y in (Fraction(-1, 2), Fraction(1, 100), Fraction(5, 4)):
        assert phi_second_rate(A, (1 + y,), 1, one, one) == 6 * (1 - abs(y) / a) / a**2
    with pytest.raises(
        NotDifferentiable, match="kernel 'peak' has no second derivative at its node 1: take a C2 kernel"
    ):
        phi_second_rate(A, one, 1, one, one)
