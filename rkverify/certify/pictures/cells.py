"""Figure 1: Voronoi cells of nodes in a domain that is not convex, with boundary, outward normals, areas and the sums over a cell."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from scipy.spatial import cKDTree

from rkverify.certify.integration_in_space import RULES
from rkverify.certify.space_nodes import SpaceNodes, space_nodes
from rkverify.solid.cell_rings import all_rings
from rkverify.solid.cells import OUTSIDE
from rkverify.solid.edge_rules import facet_rule
from rkverify.solid.gradients import facets_alone, scni, sums
from rkverify.solid.kernel_values import Array

Row = dict[str, Any]


@dataclass(frozen=True)
class Picture:
    """The nodes, and the two that are drawn large: `interior`, and `clipped`, whose cell is not convex."""

    nodes: SpaceNodes

    @cached_property
    def rings(self) -> list[list[Array]]:
        """The closed loops of every cell."""
        return all_rings(self.nodes.cells)

    @cached_property
    def polygons(self) -> list[shapely.Polygon]:
        """The cells as polygons, the first ring the outline."""
        return [shapely.Polygon(rings[0], rings[1:]) for rings in self.rings]

    @cached_property
    def at_boundary(self) -> Array:
        """Whether the cell of a node has a facet on the boundary of the domain, (N,)."""
        cells = self.nodes.cells
        there = np.zeros(len(cells), bool)
        there[cells.sides[cells.boundary, 0]] = True
        return there

    @cached_property
    def clipped(self) -> int:
        """The node whose cell differs most from its convex hull, by area."""
        return int(np.argmax([hollow(polygon) for polygon in self.polygons]))

    @cached_property
    def interior(self) -> int:
        """The node nearest to the clipped one whose cell does not reach the boundary."""
        x = self.nodes.positions
        distance = np.linalg.norm(x - x[self.clipped], axis=1)
        return int(np.argmin(np.where(self.at_boundary, np.inf, distance)))

    @property
    def chosen(self) -> dict[str, int]:
        """The two cells by name."""
        return {"interior": self.interior, "clipped": self.clipped}


def picture(kind: str, spacing: float, support_ratio: float, seed: int) -> Picture:
    """Nodes of the kind in the L with a hole, see `space_nodes`."""
    return Picture(space_nodes(2, kind, spacing, support_ratio, seed))


def hollow(polygon: shapely.Polygon) -> float:
    """The share of the convex hull's area that is not the polygon's."""
    return float(1 - polygon.area / polygon.convex_hull.area)


def outlines(p: Picture) -> list[Row]:
    """Every vertex of every cell, ring by ring."""
    return [
        {"node": L, "ring": r, "vertex": v, "x1": float(x), "x2": float(y)}
        for L, rings in enumerate(p.rings)
        for r, ring in enumerate(rings)
        for v, (x, y) in enumerate(ring)
    ]


def places(p: Picture) -> list[Row]:
    """The nodes, the area of each cell by its facets, and by its vertices."""
    cells = p.nodes.cells
    return [
        {
            "node": L,
            "x1": float(x),
            "x2": float(y),
            "boundary": bool(p.at_boundary[L]),
            "area": float(cells.measures[L]),
            "by_vertices": float(p.polygons[L].area),
        }
        for L, (x, y) in enumerate(p.nodes.positions)
    ]


def edges(p: Picture) -> list[Row]:
    """The edges of the two cells: ends in order, the outward normal N, and the node beyond it, -1 outside the domain."""
    cells, rows = p.nodes.cells, []
    for name, L in p.chosen.items():
        for f, sign in _around(p, L):
            start, end = cells.vertices[cells.corners[cells.starts[f] : cells.starts[f + 1]]][:: int(sign)]
            vector = sign * cells.areas[f]
            length = float(np.linalg.norm(vector))
            ends = {"start_1": start[0], "start_2": start[1], "end_1": end[0], "end_2": end[1]}
            normal = {"n1": vector[0] / length, "n2": vector[1] / length, "length": length}
            beyond = int(cells.sides[f, 1] if sign > 0 else cells.sides[f, 0])
            rows.append({"cell": name, "node": L, **_floats(ends), **_floats(normal), "beyond": beyond})
    return rows


def _floats(values: dict[str, Any]) -> dict[str, float]:
    """The values as Python's own numbers."""
    return {name: float(value) for name, value in values.items()}


def _around(p: Picture, L: int) -> list[tuple[int, float]]:
    """The facets of a cell, with +1 where their area vector points out of it."""
    sides = p.nodes.cells.sides
    return [(int(f), 1.0 if sides[f, 0] == L else -1.0) for f in np.flatnonzero((sides == L).any(axis=1))]


def rule_points(p: Picture, rules: tuple[str, ...]) -> list[Row]:
    """The points of edge rules on the two cells, each with the share of the cell's perimeter that it stands for."""
    cells, rows = p.nodes.cells, []
    for name, L in p.chosen.items():
        own = facets_alone(cells, np.array([f for f, _ in _around(p, L)]))
        lengths = np.linalg.norm(own.areas, axis=1)
        for rule in rules:
            means = facet_rule(own, rule)
            share = (lengths @ means.matrix()) / lengths.sum()
            rows += [
                {"cell": name, "rule": rule, "x1": float(x), "x2": float(y), "share": float(w)}
                for (x, y), w in zip(means.points, share, strict=True)
                if w > 0
            ]
    return rows


def residuals(p: Picture) -> list[Row]:
    """For each rule, over each of the two cells and over all: area vectors and smoothed gradients (17) against their sums.

    closing: |sum of the outward area vectors| over the perimeter; unclipped: the same without what lies on the boundary of the
    domain, which is what a code leaves out that does not clip; constant: A^(1/2) |sum_I b_iI|; linear: max |sum_I b_iI x_jI -
    delta_ij|; nodes: how many have b_iI other than 0.
    """
    cells, rows = p.nodes.cells, []
    between = cells.sides[:, 1] != OUTSIDE
    outer, inner = np.zeros((len(cells), 2)), np.zeros((len(cells), 2))
    np.add.at(outer, cells.sides[~between, 0], cells.areas[~between])
    np.add.at(inner, cells.sides[between, 0], cells.areas[between])
    np.subtract.at(inner, cells.sides[between, 1], cells.areas[between])
    perimeter = np.array([polygon.length for polygon in p.polygons])
    closing, unclipped = (np.linalg.norm(vectors, axis=1) / perimeter for vectors in (inner + outer, inner))
    for rule in RULES:
        operator = scni(p.nodes.cloud(), cells, rule)
        constant, linear = sums(operator, p.nodes.positions)
        constant = np.sqrt(cells.measures) * abs(constant).max(axis=1)
        linear = abs(linear).max(axis=(1, 2))
        reach = (abs(operator.parts[0]) + abs(operator.parts[1])).tocsr()
        for name, chosen in (*p.chosen.items(), ("all", slice(None))):
            columns = {
                "closing": closing,
                "unclipped": unclipped,
                "constant": constant,
                "linear": linear,
                "nodes": np.diff(reach.indptr),
            }
            largest = {key: np.max(values[chosen]).item() for key, values in columns.items()}
            rows.append({"cell": name, "rule": rule, **largest})
    return rows


def whole(p: Picture, step: float) -> dict[str, float]:
    """The area of the domain, the sum of the cells' areas, and whether normals point out, by the definition of a cell:

    a step along N from the middle of every edge leads to where the node beyond it is the nearest, or the domain ends, and a
    step back to where L is the nearest. Steps are shares of the edge's length.
    """
    cells, x = p.nodes.cells, p.nodes.positions
    middle = cells.vertices[cells.corners].reshape(-1, 2, 2).mean(axis=1)
    tree, wrong = cKDTree(x), 0
    for sign in (1, -1):
        there = middle + sign * step * cells.areas
        nearest, inside = tree.query(there)[1], p.nodes.domain.contains(there)
        expected = cells.sides[:, 0 if sign < 0 else 1]
        wrong += int((np.where(inside, nearest, OUTSIDE) != expected).sum())
    areas = {"domain": float(p.nodes.domain.measure), "sum": float(cells.measures.sum())}
    return {"cells": len(cells), "edges": len(middle), "wrong": wrong, **areas}
