"""The perturbed equations (57), (58), (60), (73), (74): coefficients of the perturbations of nodes around node I."""

from collections.abc import Sequence

from rkverify.arithmetic.base import Scalar
from rkverify.arithmetic.dual import Dual
from rkverify.paper.approximation import Approximation, middle
from rkverify.paper.kernel_rates import direction, phi_rate
from rkverify.paper.numbered import equation
from rkverify.paper.shape import correction, shape_functions

Coefficients = dict[int, Scalar]
"""n -> coefficient of the perturbation of node I + n."""


@equation(57, 58, 60)
def lagrangian_acceleration(b: Coefficients, tangent: Scalar, density: Scalar) -> Coefficients:
    """u~_I'' = -(1/(rho_0 h)) sum_L b_I^L P~_L h with P~_L = tangent f~_L (59), f~_L = sum_J b_J^L u~_J   (57), (58), (60).

    b: n -> b_I^{I+n} on the uniform lattice, where b_J^L depends on L - J alone.
    """
    total: Coefficients = {}
    for L, value in b.items():
        for n, other in b.items():
            total[L - n] = total.get(L - n, 0) - tangent * value * other / density
    return total


def _star(A: Approximation, J: int, at: int, Q: Scalar, with_direction: bool) -> Scalar:
    """Psi*_J(x_K) on the base v = Q x; without n_JK of (71) it is odd in x_K - x_J."""
    if at == J:
        return A.K.zero()
    x = A.nodes[at]
    y = A.offset(x, J)
    star = correction(A, x, y) * phi_rate(A, x, J, (Q * y[0],))
    return star if with_direction else star * direction(A, x, J)[0]


@equation(73)
def perturbed_force(N: dict[int, Dual], v: Sequence[Dual], force: Dual) -> Dual:
    """sum_J N~_IJ v_J + sum_J N_IJ v~_J + f~_I: what balances -m_I v~_I' where the perturbation of m_I is neglected   (73).

    N, v, force: values of the base, with the derivatives along every perturbation as slopes.
    """
    total = Dual(force.value * 0, force.slopes, force.size)
    for J, entry in N.items():
        total = total + Dual(force.value * 0, entry.slopes, force.size) * v[J].value
        total = total + Dual(force.value * 0, v[J].slopes, force.size) * entry.value
    return total


@equation(74)
def convective_terms(
    A: Approximation, Q: Scalar, with_direction: bool = True, with_varied_rate: bool = False
) -> tuple[Coefficients, Coefficients]:
    """sum_J N~_IJ v_J + sum_J N_IJ v~_J over the nodal mass: coefficients of the displacements and of the velocities.

    The base is v = Q x on the lattice A, and Psi_I is varied through its kernel with C held. (74) has no
    Psi_I Psi~*_J: with_varied_rate adds what velocities do there. with_direction: n of (71) kept.
    """
    I = middle(A)
    displacement: Coefficients = {}
    velocity: Coefficients = {}

    def add(to: Coefficients, n: int, value: Scalar) -> None:
        to[n] = to[n] + value if n in to else value

    for at in range(I - 2, I + 3):
        x = A.nodes[at]
        Psi = shape_functions(A, x)
        if I not in Psi:
            continue
        stars = {J: _star(A, J, at, Q, with_direction) for J in A.neighbours(x)}
        carried = sum((stars[J] * Q * A.nodes[J][0] for J in stars), A.K.zero())
        if at != I:
            slope = correction(A, x, A.offset(x, I)) * phi_rate(A, x, I, (A.K.number(1),))
            slope = slope if with_direction else slope * direction(A, x, I)[0]
            add(displacement, at - I, slope * carried)
            add(displacement, 0, -slope * carried)
        for J, star in stars.items():
            add(velocity, J - I, Psi[I] * star)
            if with_varied_rate and at != J:
                per_velocity = correction(A, x, A.offset(x, J)) * phi_rate(A, x, J, (A.K.number(1),))
                weight = Psi[I] * per_velocity * Q * A.nodes[J][0]
                add(velocity, at - I, weight)
                add(velocity, J - I, -weight)
    return displacement, velocity
