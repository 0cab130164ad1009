"""What becomes of a semi-Lagrangian shape function as the nodes move: Psi* of (40) and the true material rate."""

from collections.abc import Sequence

from rkverify.arithmetic.base import Scalar
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.kernel_rates import minus, phi_rate, seen_by_the_kernel, semi_lagrangian_kernel_rate
from rkverify.paper.moment import Rates
from rkverify.paper.numbered import equation
from rkverify.paper.shape import Values, correction, field, shape_functions, shape_rates


@equation(40, 68)
def psi_star(A: Approximation, x: Vector, v: Vector, node_velocities: Sequence[Vector]) -> Values:
    """Psi*_I(x) = C(x; x - x_I) times the material rate of phi_a(x - x_I)   (40), (68).

    v: velocity of the material at x (d,); node_velocities (NP, d); result in 1/time.
    """
    return {
        I: correction(A, x, A.offset(x, I)) * semi_lagrangian_kernel_rate(A, x, I, v, node_velocities[I])
        for I in A.neighbours(x)
    }


def true_rate(A: Approximation, x: Vector, v: Vector, node_velocities: Sequence[Vector]) -> Values:
    """The material derivative of Psi_I(x), with the rate of C that (40) leaves out; 1/time."""
    return shape_rates(A, x, lambda I: minus(v, node_velocities[I]))


def psi_star_of_changing_supports(
    A: Approximation, x: Vector, v: Vector, node_velocities: Sequence[Vector], support_rates: Sequence[Scalar]
) -> Values:
    """C(x; x - x_I) times the material rate of phi_a where a_I changes too, which (70) leaves open; 1/time."""
    seen = _seen(A, x, v, node_velocities, support_rates)
    return {I: correction(A, x, A.offset(x, I)) * phi_rate(A, x, I, seen(I)) for I in A.neighbours(x)}


def true_rate_of_changing_supports(
    A: Approximation, x: Vector, v: Vector, node_velocities: Sequence[Vector], support_rates: Sequence[Scalar]
) -> Values:
    """The material derivative of Psi_I(x) where the supports change too; 1/time."""
    seen = _seen(A, x, v, node_velocities, support_rates)
    return shape_rates(A, x, lambda I: minus(v, node_velocities[I]), w_kernel=seen)


def _seen(
    A: Approximation, x: Vector, v: Vector, node_velocities: Sequence[Vector], support_rates: Sequence[Scalar]
) -> Rates:
    return lambda I: seen_by_the_kernel(A, x, I, minus(v, node_velocities[I]), support_rates[I])


@equation(39)
def acceleration(
    A: Approximation,
    x: Vector,
    v: Vector,
    node_velocities: Sequence[Vector],
    node_accelerations: Sequence[Vector],
    axis: int = 0,
) -> Scalar:
    """sum_I Psi_I dv_I/dt + Psi*_I v_I, a component of the acceleration   (39)."""
    star = psi_star(A, x, v, node_velocities)
    Psi = shape_functions(A, x)
    return sum((Psi[I] * node_accelerations[I][axis] + star[I] * node_velocities[I][axis] for I in Psi), A.K.zero())


def velocity(A: Approximation, x: Vector, node_velocities: Sequence[Vector]) -> Vector:
    """v^h(x) = sum_I Psi_I(x) v_I   (38)."""
    return tuple(field(A, x, [v[axis] for v in node_velocities]) for axis in range(A.dimension))
