"""What nodal integrations keep in two and three dimensions: linear sums and the integration constraint, rule by rule."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rkverify.certify.space_nodes import KINDS, SpaceNodes, space_nodes
from rkverify.solid.gradients import (
    GradientOperator,
    boundary_integrals,
    constraint_residual,
    dni,
    scni,
    snni,
    sums,
)

RULES = ("trapezoid", "midpoint", "gauss:2", "gauss:4")


def rows(
    dimension: int, spacing: float, support_ratio: float, seed: int, reference: str, kinds: Sequence[str] = KINDS
) -> list[dict[str, Any]]:
    """For each kind of nodes and each integration its residuals, all of them numbers.

    constant: max_L A_L^(1/d) |sum_I b_iI^L|; linear: max |sum_I b_iI^L x_jI - delta_ij|; constraint: max |sum_L A_L b_iI^L -
    integral of Psi_I n_i| over the largest of these integrals; from_mean: distance of the operator from the mean of grad
    Psi_I over the cells, as the rule `reference` gives it, in the norm (sum_L A_L |b^L|^2)^(1/2), over its norm.
    """
    found = []
    for kind in kinds:
        nodes = space_nodes(dimension, kind, spacing, support_ratio, seed)
        mean = scni(nodes.cloud(), nodes.cells, reference)
        for name, rule, order, operator in _operators(nodes, reference):
            constant, linear = sums(operator, nodes.positions)
            scale = operator.measures ** (1 / dimension)
            residual = abs(constraint_residual(operator)).max() / abs(operator.boundary).max()
            found.append(
                {
                    "domain": nodes.domain_name,
                    "nodes": kind,
                    "count": len(nodes.positions),
                    "integration": name,
                    "rule": rule,
                    "order": order,
                    "constant": float((scale[:, None] * abs(constant)).max()),
                    "linear": float(abs(linear).max()),
                    "constraint": float(residual),
                    "from_mean": distance(operator, mean),
                }
            )
    return found


def _operators(nodes: SpaceNodes, reference: str) -> Iterator[tuple[str, str, int, GradientOperator]]:
    cloud, cells = nodes.cloud(), nodes.cells
    for rule in RULES:
        yield "scni", rule, 1, scni(cloud, cells, rule)
    without = nodes.cloud(order=0)
    yield "scni", "trapezoid", 0, scni(without, cells)
    boundary = boundary_integrals(cloud, cells, reference)
    yield "snni", "midpoint", 1, snni(cloud, cells.measures, boundary=boundary)
    yield "dni", "", 1, dni(cloud, cells.measures, boundary=boundary)


def distance(one: GradientOperator, other: GradientOperator) -> float:
    """(sum_L A_L |b^L - c^L|^2 / sum_L A_L |c^L|^2)^(1/2) of two operators b and c on the same cells."""

    def squared(parts: Sequence[Any]) -> float:
        return sum(float(other.measures @ part.power(2).sum(axis=1)) for part in parts)

    apart = squared([p - q for p, q in zip(one.parts, other.parts, strict=True)])
    return float(np.sqrt(apart / squared(other.parts)))
