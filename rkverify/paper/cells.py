"""Nodal representative cells in one dimension: Omega_L = ]X_L^-, X_L^+[ with A_L = X_L^+ - X_L^-."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput


@dataclass(frozen=True)
class Cell:
    """The ends and the length of one nodal cell, in units of length."""

    left: Scalar
    right: Scalar

    @property
    def measure(self) -> Scalar:
        """A_L, a_L: the cell's length."""
        return self.right - self.left


def nodal_cells(nodes: Sequence[Scalar], left: Scalar, right: Scalar, K: Arithmetic) -> list[Cell]:
    """The Voronoi cells of the nodes (NP,) in [left, right]: they end half-way to the neighbouring nodes.

    Raises BadInput for no nodes, two nodes at one place, a node outside the domain, or a cell without length.
    """
    if not nodes:
        raise BadInput("there are no nodes: give at least one")
    for node, x in enumerate(nodes):
        if K.sign(x - left) < 0 or K.sign(right - x) < 0:
            raise BadInput(
                f"node {node} at {K.text(x)} lies outside the domain [{K.text(left)}, {K.text(right)}]: move it or widen the domain"
            )
    ranked = sorted(range(len(nodes)), key=lambda I: K.witness(nodes[I]))
    for I, J in pairwise(ranked):
        if K.sign(nodes[J] - nodes[I]) <= 0:
            raise BadInput(f"nodes {I} and {J} are both at {K.text(nodes[I])}: separate the nodes")
    edges = [left, *((nodes[I] + nodes[J]) / 2 for I, J in pairwise(ranked)), right]
    cells = dict(zip(ranked, map(Cell, edges, edges[1:]), strict=True))
    for node, cell in cells.items():
        if K.sign(cell.measure) <= 0:
            raise BadInput(
                f"the cell of node {node} at {K.text(nodes[node])} has length {K.text(cell.measure)}: separate the nodes"
            )
    return [cells[I] for I in range(len(nodes))]


def lattice_cell(node: Scalar, spacing: Scalar) -> Cell:
    """The cell of a node in the infinite uniform lattice: half a spacing to each side."""
    return Cell(node - spacing / 2, node + spacing / 2)
