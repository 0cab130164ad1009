"""Gradient operators as they are claimed, and the integrations, edge rules and derivatives that they might have instead."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from rkverify.check.claim import Claim, predicted
from rkverify.check.entries import Entries
from rkverify.check.hypotheses import HYPOTHESES, variants
from rkverify.check.rounding import relative_rounding
from rkverify.errors import BadInput, RkverifyError
from rkverify.readings import DERIVATIVES, Derivative, NodalIntegration
from rkverify.solid.boxes import boxes
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import Cloud
from rkverify.solid.gradients import boundary_integrals, facets_alone, scni
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours


@dataclass(frozen=True)
class Scheme:
    """An integration with its edge rule (scni, snni) or its reading of the derivative (dni)."""

    integration: NodalIntegration
    rule: str = "trapezoid"
    derivative: Derivative = "full"

    @property
    def name(self) -> str:
        """What it is called in a verdict."""
        choice = f"{self.derivative} derivatives" if self.integration == "dni" else f"the edge rule {self.rule}"
        return f"{self.integration} with {choice}"

    @property
    def options(self) -> str:
        """What the command line takes for it."""
        choice = f"--derivative {self.derivative}" if self.integration == "dni" else f"--edge-rule {self.rule}"
        return f"--integration {self.integration} {choice}"


_RULES = ("trapezoid", "midpoint", "gauss:1", "gauss:2", "gauss:3", "gauss:4")
SCHEMES: tuple[Scheme, ...] = (
    *(Scheme("scni", rule) for rule in _RULES),
    *(Scheme("dni", derivative=reading) for reading in DERIVATIVES),
    *(Scheme("snni", rule) for rule in ("trapezoid", "midpoint", "gauss:2")),
)


@dataclass(frozen=True)
class GradientClaim:
    """A scheme on a cloud, with cells that belong to the given nodes; without cells for dni where none are known."""

    cloud: Cloud
    scheme: Scheme
    cells: Cells | None = None
    numbers: Array = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    @property
    def measures(self) -> Array:
        """A_L by node (N,), 1 where there is no cell."""
        everyone = np.ones(len(self.cloud))
        if self.cells is not None:
            everyone[self.numbers] = self.cells.measures
        return everyone

    @property
    def owners(self) -> Array:
        """The nodes that have a cell, or all of them without cells."""
        return np.arange(len(self.cloud)) if self.cells is None else self.numbers


def predicted_gradients(claim: GradientClaim, columns: tuple[str, ...], chosen: Array | None = None) -> Entries:
    """b_iI^L of the claim, by node L of the cell and node I, for all cells or those of the chosen nodes.

    Raises BadInput for a smoothed gradient without cells, and what the operator raises.
    """
    scheme, cloud = claim.scheme, claim.cloud
    owners = claim.owners if chosen is None else chosen
    if scheme.integration == "dni":
        there = predicted(Claim(cloud, cloud.positions[owners], scheme.derivative), ("dpsi_dx", *columns[1:]))
        return replace(there, rows=owners[there.rows], columns=columns, count=len(cloud))
    if claim.cells is None:
        raise BadInput(f"{scheme.integration} needs cells: give --domain FILE, --box or --cells FILE")
    if scheme.integration == "snni":
        parts = scni(cloud, boxes(cloud.positions[owners], claim.measures[owners]), scheme.rule).parts
    else:
        cells = claim.cells
        place = np.full(len(cloud), OUTSIDE)
        place[claim.numbers] = np.arange(len(claim.numbers))
        if chosen is not None:
            touching = np.isin(cells.sides, place[chosen]).any(axis=1)
            cells = facets_alone(cells, np.flatnonzero(touching))
        parts = tuple(part[place[owners]] for part in scni(cloud, cells, scheme.rule).parts)
    rows, nodes = sum(abs(part) for part in parts).tocoo().coords
    order = np.lexsort((nodes, owners[rows]))
    rows, nodes = rows[order], nodes[order]
    numbers = np.column_stack([part.tocsr()[rows, nodes] for part in parts])
    return Entries(owners[rows], nodes, numbers, columns, len(cloud), len(cloud), np.zeros(len(columns)))


def sizes_and_rounding(claim: GradientClaim) -> tuple[Array, float]:
    """The size of b_iI^L, perimeter over measure (N,), in 1/length, and the relative error that rounding leaves in Psi_I.

    Of a node without cell the size is 1/support. Psi_I is rounded most where its moment matrix is worst: at a vertex of a
    cell, or at a node.
    """
    cloud, cells = claim.cloud, claim.cells
    sizes, places = 1 / cloud.supports, cloud.positions
    if cells is not None:
        lengths = np.sqrt((cells.areas**2).sum(axis=1))
        around = np.bincount(cells.sides[:, 0], lengths, len(cells))
        inner = cells.sides[:, 1] >= 0
        around += np.bincount(cells.sides[inner, 1], lengths[inner], len(cells))
        sizes[claim.numbers] = around / cells.measures
        places = np.concatenate([places, cells.vertices[np.unique(cells.corners)]])
    worst = 0.0
    for part in np.array_split(places, max(1, len(places) // 10_000)):
        try:
            worst = max(worst, float(relative_rounding(cloud, part, neighbours(cloud, part)).max()))
        except RkverifyError:
            continue  # a point that the rule in use does not visit
    return sizes, worst


def boundary_of(claim: GradientClaim) -> Array | None:
    """The integrals of Psi_I n_i over the boundary of the domain (d, N) by the claimed rule; None where no cells are known."""
    if claim.cells is None or claim.scheme.integration != "scni":
        return None
    return boundary_integrals(claim.cloud, claim.cells, claim.scheme.rule)


Alternative = tuple[str, str, GradientClaim]
"""Words, advice, and the claim that they stand for."""


def other_schemes(claim: GradientClaim) -> Iterator[Alternative]:
    """Every other scheme for the same shape functions."""
    for scheme in SCHEMES:
        if scheme != claim.scheme and (claim.cells is not None or scheme.integration == "dni"):
            yield scheme.name, f"give {scheme.options} if it is meant", replace(claim, scheme=scheme)


def other_shapes(claim: GradientClaim) -> Iterator[Alternative]:
    """Every change of the shape functions for the same scheme; supports have no owner but the node, since cells have none."""
    for changes, changed in variants(Claim(claim.cloud, claim.cloud.positions), HYPOTHESES, 1):
        if changes and changed.owner == "source" and not changed.normalised:
            yield changes[0].says, changes[0].advice, replace(claim, cloud=changed.cloud)


def both_changed(claim: GradientClaim) -> Iterator[Alternative]:
    """Every change of the shape functions with every other scheme."""
    for says, advice, changed in other_shapes(claim):
        for scheme, how, final in other_schemes(changed):
            yield f"{says} and {scheme}", f"{how}; {advice}", final
