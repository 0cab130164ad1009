"""phi_a at a point and its rates: the gradient, the second derivative, the material rates (34)-(36), (70), (71).

All of them are built on g(z) = phi'(z)/z, so that nothing is divided by |x - x_I| at a node. With the tensor window
phi_a is the product of its values on the axes, and its rates follow by the product rule.
"""

from itertools import product

from rkverify.arithmetic.base import Scalar
from rkverify.errors import NotDifferentiable
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.numbered import equation


def dot(u: Vector, w: Vector) -> Scalar:
    """u . w"""
    total = u[0] * w[0]
    for p, q in zip(u[1:], w[1:], strict=True):
        total = total + p * q
    return total


def minus(u: Vector, w: Vector) -> Vector:
    """u - w"""
    return tuple(p - q for p, q in zip(u, w, strict=True))


def _others(A: Approximation, x: Vector, node: int, *without: int) -> Scalar:
    """The product of phi on all axes but these."""
    value = A.K.number(1)
    for j, axis in enumerate(A.axes):
        if j not in without:
            value = value * phi(axis, (x[j],), node)
    return value


@equation(12)
def phi(A: Approximation, x: Vector, node: int) -> Scalar:
    """phi_a(x - x_I) = phi(z) with z = |x - x_I| / a_I; the kernel (12) unless another is chosen.

    With the tensor window: the product of phi(z_j) with z_j = |x_j - x_jI| / a_I over the axes.
    """
    if A.window == "tensor":
        return _others(A, x, node)
    z = A.distance(x, node)
    return _at_its_node(A, x, node, A.kernel.phi(z, A.K), 1)


def _at_its_node(A: Approximation, x: Vector, node: int, value: Scalar, order: int) -> Scalar:
    """A value that goes with phi's derivative of order 1 - `order`: at the node it is only as smooth as the kernel is there."""
    if A.K.surely_positive(A.distance(x, node)):
        return value
    smooth = A.kernel.smoothness_at_node + order
    for component in A.offset(x, node):
        A.K.known_below(component, smooth)  # in the plane |y| itself carries no change at its origin
    return A.K.known_below(value, smooth)


def phi_rate(A: Approximation, x: Vector, node: int, w: Vector) -> Scalar:
    """The rate of phi_a(x - x_I) where x - x_I changes at the rate w: g(z) (x - x_I).w / a^2 with g = phi'/z."""
    if all(A.K.is_zero(c) for c in w):
        return A.K.zero()
    if A.window == "tensor":
        rates = (phi_rate(axis, (x[j],), node, (w[j],)) * _others(A, x, node, j) for j, axis in enumerate(A.axes))
        return sum(rates, A.K.zero())
    z = A.distance(x, node)
    g = A.kernel.phi.derivative().over_z(z, A.K)
    return _at_its_node(A, x, node, g * dot(A.offset(x, node), w) / A.supports[node] ** 2, 0)


def seen_by_the_kernel(A: Approximation, x: Vector, node: int, w: Vector, support_rate: Scalar) -> Vector:
    """w - (x - x_I) a_I'/a_I: phi is a function of (x - x_I)/a_I, and sees a growing support as an approach."""
    share = support_rate / A.supports[node]
    return tuple(c - y * share for c, y in zip(w, A.offset(x, node), strict=True))


def phi_second_rate(A: Approximation, x: Vector, node: int, u: Vector, w: Vector) -> Scalar:
    """The second derivative of phi_a(x - x_I) along u and w.

    (u.w g(z) + (n.u)(n.w) (phi''(z) - g(z))) / a^2, where the second part vanishes at the node.
    Raises NotDifferentiable where the kernel is not C2 at its node.
    """
    if A.window == "tensor":
        return _tensor_second_rate(A, x, node, u, w)
    K, a, y, z = A.K, A.supports[node], A.offset(x, node), A.distance(x, node)
    second = A.kernel.phi.derivative(2)(z, K)
    if A.dimension == 1:
        if A.kernel.smoothness_at_node < 2 and not K.surely_positive(z):
            raise NotDifferentiable(
                f"kernel {A.kernel.name!r} has no second derivative at its node {node}: take a C2 kernel"
            )
        return _at_its_node(A, x, node, second * u[0] * w[0] / a**2, -1)
    g = A.kernel.phi.derivative().over_z(z, K)
    value = g * dot(u, w) / a**2
    if not K.surely_positive(z):
        return _at_its_node(A, x, node, value, -1)
    return value + (second - g) * dot(y, u) * dot(y, w) / (z**2 * a**4)


def _tensor_second_rate(A: Approximation, x: Vector, node: int, u: Vector, w: Vector) -> Scalar:
    total = A.K.zero()
    for j, k in product(range(A.dimension), repeat=2):
        if j == k:
            own = phi_second_rate(A.axes[j], (x[j],), node, (u[j],), (w[j],))
        else:
            own = phi_rate(A.axes[j], (x[j],), node, (u[j],)) * phi_rate(A.axes[k], (x[k],), node, (w[k],))
        total = total + own * _others(A, x, node, j, k)
    return total


@equation(36, 71)
def direction(A: Approximation, x: Vector, node: int) -> Vector:
    """n = (x - x_I) / |x - x_I|   (36), (71).

    Raises NotDifferentiable at the node itself, where n has no value; (35) does not need one there.
    """
    y = A.offset(x, node)
    length = A.K.norm(y)
    if A.K.is_zero(length):
        raise NotDifferentiable(f"the direction n of (36) has no value at its own node {node}: ask for another point")
    return tuple(c / length for c in y)


@equation(34)
def lagrangian_kernel_rate(A: Approximation, X: Vector, node: int) -> Scalar:
    """The material rate of phi_a(|X - X_I| / a) is 0: neither X nor X_I changes for a given material point   (34)."""
    return phi_rate(A, X, node, tuple(A.K.zero() for _ in X))


@equation(35, 70)
def semi_lagrangian_kernel_rate(A: Approximation, x: Vector, node: int, v: Vector, v_node: Vector) -> Scalar:
    """The material rate of phi_a(|x - x_I| / a) is phi'(z) n.(v - v_I) / a   (35), (70).

    v and v_node are velocities (length per time) of the material at x and of the node. With the tensor window: the sum
    over the axes of (35) on the one, times phi on the others.
    """
    if A.window == "tensor":
        rates = (
            semi_lagrangian_kernel_rate(axis, (x[j],), node, (v[j],), (v_node[j],)) * _others(A, x, node, j)
            for j, axis in enumerate(A.axes)
        )
        return sum(rates, A.K.zero())
    y = A.offset(x, node)
    length = A.K.norm(y)
    if not A.K.surely_positive(length):
        return phi_rate(A, x, node, minus(v, v_node))
    slope = A.kernel.phi.derivative()(length / A.supports[node], A.K)
    return slope * dot(direction(A, x, node), minus(v, v_node)) / A.supports[node]
