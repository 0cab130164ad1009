"""Section 4.2: the semi-discrete semi-Lagrangian equations in one dimension, (65)-(72), (80), in every reading.

A state holds what changes in time: positions, velocities, Cauchy stresses and, where the readings need them,
cell edges and cell measures. `Equations` gives the rates of all of these at one node.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.arithmetic.base import Scalar
from rkverify.paper.approximation import Approximation, Vector
from rkverify.paper.cells import Cell
from rkverify.paper.gradients import direct_gradient, smoothed_gradient
from rkverify.paper.material_rates import (
    psi_star,
    psi_star_of_changing_supports,
    true_rate,
    true_rate_of_changing_supports,
)
from rkverify.paper.numbered import equation
from rkverify.paper.shape import Values, field, shape_functions
from rkverify.readings import Readings


@dataclass(frozen=True)
class ChainState:
    """Positions x_I, velocities v_I, stresses sigma_K, edges x_K^+ (the right end of each cell), measures a_K; all (NP,).

    Nodes are ordered from left to right. edges and measures count only in the readings that integrate them.
    """

    positions: Sequence[Scalar]
    velocities: Sequence[Scalar]
    stresses: Sequence[Scalar]
    edges: Sequence[Scalar]
    measures: Sequence[Scalar]


@dataclass(frozen=True)
class SemiLagrangianChain:
    """A bar: approximation data (kernel, supports, order), modulus C^sigma, cell masses m_K, readings.

    origin: the X_J from which the displacements u_J = x_J - X_J of the literal stress (69) count. support_ratio: the R
    of supports that follow the spacing.
    """

    A: Approximation
    modulus: Scalar
    masses: Sequence[Scalar]
    readings: Readings
    origin: Sequence[Scalar] = ()
    support_ratio: Scalar = 0
    memo: dict[int, tuple[ChainState, Approximation]] = dataclasses.field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def on(self, state: ChainState) -> Approximation:
        """The approximation on the current positions (26), the same one for the same state."""
        if id(state) not in self.memo:
            supports = None if self.readings.support_radius == "fixed" else self.following_spacing(state.positions)
            self.memo[id(state)] = (state, self.A.at([(x,) for x in state.positions], supports))
        return self.memo[id(state)][1]

    def following_spacing(self, values: Sequence[Scalar]) -> list[Scalar]:
        """R (x_(I+1) - x_(I-1)) / 2 for positions, and its rate for velocities; one-sided at the ends."""
        last = len(values) - 1
        reach = [(max(I - 1, 0), min(I + 1, last)) for I in range(last + 1)]
        return [self.support_ratio * (values[j] - values[i]) / (j - i) for i, j in reach]

    def edge(self, K: int, state: ChainState) -> Scalar:
        """x_K^+, the right end of cell K."""
        if self.readings.cell_edges == "voronoi":
            return (state.positions[K] + state.positions[K + 1]) / 2
        return state.edges[K]

    def cell(self, K: int, state: ChainState) -> Cell:
        """]x_K^-, x_K^+[."""
        return Cell(self.edge(K - 1, state), self.edge(K, state))

    def measure(self, K: int, state: ChainState) -> Scalar:
        """a_K, the length of the cell in the reading's sense."""
        return self.cell(K, state).measure if self.readings.cell_measure == "edges" else state.measures[K]

    def gradient(self, K: int, state: ChainState) -> Values:
        """B_I(x_K): smoothed over the cell (72), with a_K in the reading's sense, or direct (80)."""
        A = self.on(state)
        if self.readings.integration == "dni":
            return direct_gradient(A, A.nodes[K], self.readings.derivative)
        cell = self.cell(K, state)
        factor = cell.measure / self.measure(K, state)
        return {I: b * factor for I, b in smoothed_gradient(A, cell).items()}

    def velocity_gradient(self, K: int, state: ChainState) -> Scalar:
        """L_K = sum_J B_J(x_K) v_J."""
        return sum((b * state.velocities[J] for J, b in self.gradient(K, state).items()), self.A.K.zero())

    @equation(69)
    def literal_stress(self, K: int, state: ChainState) -> Scalar:
        """sigma(x_K) = C^sigma sum_J B_J(x_K) u_J   (69)."""
        b = self.gradient(K, state)
        strain = sum((b[J] * (state.positions[J] - self.origin[J]) for J in b), self.A.K.zero())
        return self.modulus * strain

    def stress(self, K: int, state: ChainState) -> Scalar:
        """sigma(x_K): what the rates have led to, or the literal one."""
        return self.literal_stress(K, state) if self.readings.stress_law == "literal" else state.stresses[K]

    def stress_rate(self, K: int, state: ChainState) -> Scalar:
        """sigma' = (C + sigma) L, or C L."""
        L = self.velocity_gradient(K, state)
        tangent = self.modulus + state.stresses[K] if self.readings.stress_law == "truesdell" else self.modulus
        return tangent * L

    @equation(67)
    def internal_force(self, node: int, state: ChainState, cells: Sequence[int]) -> Scalar:
        """f_I = sum_K B_I(x_K) sigma(x_K) a_K over the cells that the node reaches   (67)."""
        total = self.A.K.zero()
        for K in cells:
            b = self.gradient(K, state)
            if node in b:
                total = total + b[node] * self.stress(K, state) * self.measure(K, state)
        return total

    def field_velocity(self, x: Scalar, state: ChainState) -> Scalar:
        """v^h(x) of (38)."""
        return field(self.on(state), (x,), list(state.velocities))

    def material_velocity(self, K: int, state: ChainState) -> Scalar:
        """The velocity of the material at x_K, with which the node moves: its own coefficient, or that of the field."""
        if self.readings.node_motion == "coefficient":
            return state.velocities[K]
        return self.field_velocity(state.positions[K], state)

    def edge_rate(self, K: int, state: ChainState) -> Scalar:
        """The velocity of the right end of cell K where the material carries it."""
        return self.field_velocity(state.edges[K], state)

    def measure_rate(self, K: int, state: ChainState) -> Scalar:
        """a_K' = a_K L_K where the measure follows the material."""
        return state.measures[K] * self.velocity_gradient(K, state)

    def rates(self, K: int, state: ChainState) -> Values:
        """Psi*_J(x_K) of (68), or the true rate, for all J."""
        A = self.on(state)
        v: Vector = (self.material_velocity(K, state),)
        each = [(w,) for w in state.velocities]
        if self.readings.support_radius == "spacing":
            growth = self.following_spacing(state.velocities)
            changing = (
                true_rate_of_changing_supports if self.readings.convection == "true" else psi_star_of_changing_supports
            )
            return changing(A, A.nodes[K], v, each, growth)
        if self.readings.convection == "true":
            return true_rate(A, A.nodes[K], v, each)
        return psi_star(A, A.nodes[K], v, each)

    @equation(66)
    def convective_matrix(self, node: int, state: ChainState, cells: Sequence[int]) -> Values:
        """N_IJ = sum_K rho(x_K) Psi_I(x_K) Psi*_J(x_K) a_K for all J   (66)."""
        row: Values = {}
        if self.readings.convection == "none":
            return row
        A = self.on(state)
        for K in cells:
            Psi = shape_functions(A, A.nodes[K])
            for J, rate in self.rates(K, state).items() if node in Psi else ():
                row[J] = row.get(J, A.K.zero()) + self.masses[K] * Psi[node] * rate
        return row

    def convective_force(self, node: int, state: ChainState, cells: Sequence[int]) -> Scalar:
        """sum_J N_IJ v_J, the second term of (65)."""
        row = self.convective_matrix(node, state, cells)
        return sum((N * state.velocities[J] for J, N in row.items()), self.A.K.zero())

    @equation(42)
    def consistent_mass(self, node: int, state: ChainState, cells: Sequence[int]) -> Values:
        """M_IJ = sum_K rho(x_K) Psi_I(x_K) Psi_J(x_K) a_K for all J, (42) integrated at the nodes."""
        A = self.on(state)
        row: Values = {}
        for K in cells:
            Psi = shape_functions(A, A.nodes[K])
            for J, value in Psi.items() if node in Psi else ():
                row[J] = row.get(J, A.K.zero()) + self.masses[K] * Psi[node] * value
        return row

    def lumped_mass(self, node: int, state: ChainState, cells: Sequence[int]) -> Scalar:
        """m_I = sum_K rho(x_K) Psi_I(x_K) a_K, the row sum of (42)."""
        A = self.on(state)
        total = self.A.K.zero()
        for K in cells:
            Psi = shape_functions(A, A.nodes[K])
            if node in Psi:
                total = total + self.masses[K] * Psi[node]
        return total

    @equation(65)
    def acceleration(self, node: int, state: ChainState, cells: Sequence[int]) -> Scalar:
        """v_I' = -(f_I + sum_J N_IJ v_J) / m_I without external force   (65)."""
        force = self.internal_force(node, state, cells) + self.convective_force(node, state, cells)
        return -force / self.lumped_mass(node, state, cells)

    @equation(41)
    def residual(self, node: int, state: ChainState, cells: Sequence[int], accelerations: Sequence[Scalar]) -> Scalar:
        """sum_J M_IJ v_J' + sum_J N_IJ v_J + f_I, zero where (41) without external force holds."""
        force = self.internal_force(node, state, cells) + self.convective_force(node, state, cells)
        inertia = self.consistent_mass(node, state, cells)
        return force + sum((M * accelerations[J] for J, M in inertia.items()), self.A.K.zero())
