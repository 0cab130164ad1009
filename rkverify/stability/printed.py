"""The printed relations, ready to be evaluated at many kh, stresses and velocity gradients."""

from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper import printed_semi_lagrangian as semi
from rkverify.paper.approximation import lattice, middle
from rkverify.paper.cells import lattice_cell
from rkverify.paper.gradients import smoothed_gradient
from rkverify.paper.notation import LatticeValues
from rkverify.paper.printed_lagrangian import b_hat, bandwidth
from rkverify.paper.printed_semi_lagrangian import State


@dataclass(frozen=True)
class PrintedQuadratic:
    """omega^2 + B omega + C = 0: (76) for SCNI, (82) for DNI; (86), (87) without the convective term."""

    values: LatticeValues
    integration: str
    K: Arithmetic
    convective: bool = True

    def state(self, stress_ratio: Scalar, velocity_gradient: Scalar) -> State:
        """sigma/C^sigma and Q with modulus 1 and density 1."""
        one = self.K.number(1)
        return State(one, self.K.number(stress_ratio), one, self.K.number(velocity_gradient))

    def linear(self, state: State, kh: Scalar) -> Scalar:
        """B of (78), zero without the convective term."""
        if not self.convective:
            return self.K.zero()
        return semi.linear_coefficient(self.values, state, kh, self.K)

    def discriminant(self, state: State, kh: Scalar) -> Scalar:
        """D of (79) or (85); without the convective term 4 omega^2 of (86) or (87)."""
        scni = self.integration == "scni"
        if not self.convective:
            squared = semi.scni_omega_squared if scni else semi.dni_omega_squared
            return 4 * squared(self.values, state, kh, self.K)
        constant = semi.scni_constant if scni else semi.dni_constant
        return semi.discriminant(self.linear(state, kh), constant(self.values, state, kh, self.K))


def stencil_half_width(support_ratio: Scalar, K: Arithmetic) -> tuple[int, int]:
    """The m of (61), and the half-width that the smoothed gradients really have: beyond it all of them are zero."""
    m = bandwidth(support_ratio, K)
    wider = K.number(support_ratio) + 2
    spread = _gradients(support_ratio, bandwidth(wider, K), K)
    half = len(spread) // 2
    return m, max(abs(J - half) for J, b in enumerate(spread) if not K.is_zero(b))


def _gradients(support_ratio: Scalar, reach: int, K: Arithmetic) -> list[Scalar]:
    A = lattice(1, support_ratio, reach + 1, K)
    cells = (lattice_cell(K.number(J), K.number(1)) for J in range(-reach, reach + 1))
    return [smoothed_gradient(A, cell).get(middle(A), K.zero()) for cell in cells]


def gradients_are_odd(support_ratio: Scalar, K: Arithmetic) -> bool:
    """Whether b_I^{I+n} = -b_I^{I-n} on the uniform lattice, without any difference left."""
    b = b_hat(1, support_ratio, K)
    return all(K.is_zero(p + q) for p, q in zip(b, reversed(b), strict=True))
