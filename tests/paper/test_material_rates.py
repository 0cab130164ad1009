"""What becomes of kernels and shape functions as nodes and points move: against series in time, exactly."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.series import Series
from rkverify.certify.independent import cubic_kernel_as_printed
from rkverify.certify.samples import NodeSet
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.kernel_rates import lagrangian_kernel_rate, phi, semi_lagrangian_kernel_rate
from rkverify.paper.material_rates import acceleration, psi_star, true_rate, velocity
from rkverify.paper.shape import correction, field, shape_functions

Build = Callable[..., Approximation]
Points = Callable[[NodeSet], list[Fraction]]
S = Series(2)
SPEEDS = [Fraction(-3, 7), Fraction(0), Fraction(5, 7)]


def moving(nodes: NodeSet, order: int) -> Approximation:
    """The nodes on their way, x_I + v_I t as series in time."""
    places = [[S.variable(x, v)] for x, v in zip(nodes.nodes, nodes.velocities, strict=True)]
    return approximation(places, list(nodes.supports), S, "cubic", order)


def in_time(values: dict[int, object]) -> dict[int, Fraction]:
    return {I: S.coefficients(value)[1] for I, value in values.items()}


def same(one: dict[int, Fraction], other: dict[int, Fraction]) -> bool:
    return all(one.get(I, 0) == other.get(I, 0) for I in one.keys() | other.keys())


def velocities(nodes: NodeSet) -> list[tuple[Fraction]]:
    return [(v,) for v in nodes.velocities]


@pytest.mark.decides("E35", "E70", "E36", "E71")
def test_the_kernels_rate_is_its_series_in_time(build: Build, nodes: NodeSet) -> None:
    """(35), (70) against phi of the moving distance, at nodes, joints and edges too; the rate is not zero (C10)."""
    A, later, rates = build(nodes, 1), moving(nodes, 1), []
    for x in nodes.points:
        for v in SPEEDS:
            for I in A.neighbours((x,)):
                rate = semi_lagrangian_kernel_rate(A, (x,), I, (v,), (nodes.velocities[I],))
                assert rate == S.coefficients(phi(later, (S.variable(x, v),), I))[1]
                rates.append(rate)
    assert any(rates)


@pytest.mark.decides("E35")
def test_the_kernels_rate_by_differences(build: Build, generic: Points, nodes: NodeSet) -> None:
    """The printed pieces at x + v t and x_I + v_I t, differenced exactly in t: seven points for a polynomial of degree 3."""
    A, step = build(nodes, 1), Fraction(1, 10**8)
    weights = {1: Fraction(3, 4), 2: Fraction(-3, 20), 3: Fraction(1, 60)}
    for x in generic(nodes):
        for I, v_node in enumerate(nodes.velocities):

            def in_flight(t: Fraction, x: Fraction = x, I: int = I, v_node: Fraction = v_node) -> Fraction:
                y = x + t * SPEEDS[0] - nodes.nodes[I] - t * v_node
                return cubic_kernel_as_printed(abs(y) / nodes.supports[I])

            difference = sum(w * (in_flight(n * step) - in_flight(-n * step)) for n, w in weights.items()) / step
            assert semi_lagrangian_kernel_rate(A, (x,), I, (SPEEDS[0],), (v_node,)) == difference


@pytest.mark.decides("E34", "C9")
def test_the_lagrangian_kernel_does_not_change(build: Build, nodes: NodeSet) -> None:
    A = build(nodes, 1)
    assert all(lagrangian_kernel_rate(A, (x,), I) == 0 for x in nodes.points for I in A.neighbours((x,)))


@pytest.mark.decides("C24")
def test_the_sign_of_the_rate_tells_approach_from_departure(build: Build, generic: Points, nodes: NodeSet) -> None:
    """n.(v - v_I) < 0 is approach: the kernel grows there and falls on departure, inside its support."""
    A = build(nodes, 1)
    for x in generic(nodes):
        for I in A.neighbours((x,)):
            towards = -A.K.sign(x - nodes.nodes[I])
            approach = semi_lagrangian_kernel_rate(A, (x,), I, (Fraction(towards),), (Fraction(0),))
            departure = semi_lagrangian_kernel_rate(A, (x,), I, (Fraction(-towards),), (Fraction(0),))
            assert approach > 0 > departure


@pytest.mark.decides("E40", "E68")
def test_psi_star_is_the_correction_times_the_kernels_rate(build: Build, nodes: NodeSet, order: int) -> None:
    """(40) transcribed a second time: C from Psi, the rate from the series."""
    A, later = build(nodes, order), moving(nodes, order)
    for x in nodes.points:
        star = psi_star(A, (x,), (SPEEDS[2],), velocities(nodes))
        for I, value in star.items():
            rate = S.coefficients(phi(later, (S.variable(x, SPEEDS[2]),), I))[1]
            assert value == correction(A, (x,), A.offset((x,), I)) * rate


def test_the_true_rate_is_the_series_of_the_shape_function(build: Build, nodes: NodeSet, order: int) -> None:
    """The material derivative of Psi_I with M(x, t), b(x, t) and H all moving, exact; its sum over the nodes is 0.

    Decides the layer `consistent`: with this rate the partition of unity stays one as the nodes move.
    """
    A, later = build(nodes, order), moving(nodes, order)
    for x in nodes.points:
        for v in SPEEDS:
            true = true_rate(A, (x,), (v,), velocities(nodes))
            assert same(true, in_time(shape_functions(later, (S.variable(x, v),))))
            assert sum(true.values()) == 0


@pytest.mark.decides("C25")
def test_psi_star_is_not_the_true_rate(build: Build, generic: Points, nodes: NodeSet, order: int) -> None:
    """The twin: Psi* leaves out the rate of C; it differs from the true rate, and its sum is not 0."""
    A = build(nodes, order)
    sums, gaps = [], []
    for x in generic(nodes):
        star = psi_star(A, (x,), (SPEEDS[0],), velocities(nodes))
        true = true_rate(A, (x,), (SPEEDS[0],), velocities(nodes))
        sums.append(sum(star.values()))
        gaps.append(not same(star, true))
    assert any(sums)
    assert all(gaps)


def test_rigid_motion_changes_nothing(build: Build, nodes: NodeSet, order: int) -> None:
    """All nodes and the point at one velocity: both rates are 0, as a Galilean observer demands."""
    A, v = build(nodes, order), (Fraction(9, 4),)
    for x in nodes.points:
        together = [v] * len(nodes.nodes)
        assert not any(psi_star(A, (x,), v, together).values())
        assert not any(true_rate(A, (x,), v, together).values())


def test_the_point_at_rest_among_resting_nodes(build: Build, nodes: NodeSet) -> None:
    """With the nodes at rest the true rate is v Psi,x: the material derivative is convection alone."""
    A, rest = build(nodes, 1), [(Fraction(0),)] * len(nodes.nodes)
    for x in nodes.points:
        series = shape_functions(build(nodes, 1, S), (S.variable(x),))
        assert same(true_rate(A, (x,), (Fraction(1),), rest), in_time(series))
        assert not any(true_rate(A, (x,), (Fraction(0),), rest).values())


@pytest.mark.decides("E39", "C25")
def test_the_acceleration_misses_what_psi_star_misses(
    build: Build, generic: Points, nodes: NodeSet, order: int
) -> None:
    """(39) against d/dt of (38): they differ by sum_I (Psi*_I - dPsi_I/dt) v_I, exactly, and that is not 0.

    Decides what (39) is: the acceleration of the semi-Lagrangian velocity with the rate of C left out.
    """
    A, later, v_nodes = build(nodes, order), moving(nodes, order), velocities(nodes)
    a_nodes = [(Fraction(3 * I % 5 - 2, 4),) for I in range(len(nodes.nodes))]
    gaps = []
    for x in generic(nodes):
        at = S.variable(x, SPEEDS[2])
        speeds = [S.variable(v, a) for (v,), (a,) in zip(v_nodes, a_nodes, strict=True)]
        true = S.coefficients(field(later, (at,), speeds))[1]
        star = psi_star(A, (x,), (SPEEDS[2],), v_nodes)
        rates = true_rate(A, (x,), (SPEEDS[2],), v_nodes)
        missing = sum((star[I] - rates[I]) * v_nodes[I][0] for I in star)
        assert acceleration(A, (x,), (SPEEDS[2],), v_nodes, a_nodes) - true == missing
        gaps.append(missing)
    assert any(gaps)


def test_in_the_plane_the_acceleration_that_is_not_named_is_the_first() -> None:
    """Nodes that fall along x and rise along y: Psi*_I has the same factor for both components, which are told apart."""
    places = [[Fraction(i), Fraction(j)] for i in range(4) for j in range(4)]
    A = approximation(places, Fraction(2), Exact(), "cubic", 1, "tensor")
    v_nodes = [(x * y, x - y) for x, y in places]
    a_nodes = [(-x * x - 1, y * y + 1) for x, y in places]
    at, v = (Fraction(3, 2), Fraction(4, 3)), (Fraction(1, 2), Fraction(-1, 3))
    first, second = (acceleration(A, at, v, v_nodes, a_nodes, axis) for axis in (0, 1))
    assert acceleration(A, at, v, v_nodes, a_nodes) == first != second
    Psi, star = shape_functions(A, at), psi_star(A, at, v, v_nodes)
    assert second == sum(Psi[I] * a_nodes[I][1] + star[I] * v_nodes[I][1] for I in Psi)


def test_velocity_is_the_field_of_the_nodes_velocities(build: Build, nodes: NodeSet) -> None:
    """(38); a linear velocity v = Q x is reproduced for order 1 and 2."""
    for order in (1, 2):
        A, Q = build(nodes, order), Fraction(4, 3)
        for x in nodes.points:
            assert velocity(A, (x,), [(Q * n,) for n in nodes.nodes]) == (Q * x,)


def test_velocity_in_the_plane_has_its_own_components() -> None:
    """Four corners of a rectangle and its middle, order 1: v = (3 x - y, 2 y + 1) comes back component by component, exactly."""
    places = [[0, 0], [3, 0], [0, 4], [3, 4], ["3/2", 2]]
    A = approximation(places, 6, Exact(), order=1, window="tensor")
    nodes_v = [(3 * x - y, 2 * y + 1) for x, y in A.nodes]
    x, y = Fraction(1), Fraction(5, 4)
    assert velocity(A, (x, y), nodes_v) == (3 * x - y, 2 * y + 1)


def test_rates_in_the_plane_are_limits_of_differences() -> None:
    """(35) in two dimensions at 40 digits: central differences in time, whose error falls by four for half the step.

    The next term of the expansion is step^2 = 1e-20 times a ratio of derivatives, taken as below 1e8.
    """
    K = Multiprecision(40)
    A = approximation([["0.3", "-0.1"], ["1", "0.7"]], "5/2", K, order=0)
    x, v, v_nodes = A.point("0.6", "0.8"), A.point("0.5", "-0.25"), [A.point(1, "0.3"), A.point("-0.2", 2)]
    for I in (0, 1):
        rate, errors = semi_lagrangian_kernel_rate(A, x, I, v, v_nodes[I]), []
        for step in (K.number("1e-10"), K.number("5e-11")):
            ends = []
            for t in (step, -step):
                places = [
                    tuple(c + t * w for c, w in zip(p, q, strict=True)) for p, q in zip(A.nodes, v_nodes, strict=True)
                ]
                ends.append(phi(A.at(places), tuple(c + t * w for c, w in zip(x, v, strict=True)), I))
            errors.append((ends[0] - ends[1]) / (2 * step) - rate)
        assert abs(errors[0]) < 1e-17
        assert abs(errors[0] / errors[1] - 4) < 1e-8
