"""Omega_L = { x in Omega : |x - x_L| <= |x - x_J| for all J }: the Voronoi cells of nodes, cut off at the boundary of the domain."""

from typing import Any

import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.cell_rings import rings
from rkverify.solid.cell_topology import Topology, assembled, moved
from rkverify.solid.cells import Cells
from rkverify.solid.cloud import checked_positions, refuse_coincident
from rkverify.solid.coincident_vertices import without_coincident
from rkverify.solid.domain import Box, Domain, checked_domain, refuse_outside
from rkverify.solid.kernel_values import Array
from rkverify.solid.voronoi_line import line_topology
from rkverify.solid.voronoi_plane import plane_topology
from rkverify.solid.voronoi_space import space_cells

__all__ = ["moved", "rings", "topology", "voronoi"]


def voronoi(positions: Any, domain: Box | Domain) -> Cells:
    """The Voronoi cells of nodes (N, d) in a domain that they tile to rounding; d = 1, 3: a Box; d = 2: a Box or a Domain.

    A cell keeps all its pieces, where the domain is not convex. Facets whose length is one of rounding are left out and
    their ends are one vertex; but not with complex positions, where the topology is that of the real part (`moved`).

    Raises BadInput for a value that is not finite, a domain of other dimension or a node outside it; CoincidentNodes.

    >>> from rkverify.solid.domain import box
    >>> voronoi([[0.25, 0.5], [0.75, 0.5]], box([0, 0], [1, 1])).measures
    array([0.5, 0.5])
    """
    x = checked_positions(positions, "node")
    if x.shape[1] == 3:
        if np.iscomplexobj(x):
            raise BadInput("the nodes are complex: in three dimensions there are cells at real positions alone")
        return space_cells(x, _checked_box(x, domain))
    found = topology(x, domain)
    if np.iscomplexobj(x) or x.shape[1] == 1:
        return moved(found, x)
    size = max(abs(bound).max() for bound in domain.bounds)
    all_vertices = found.vertices(x)
    first_corner = len(all_vertices) - len(found.fixed)
    vertices, ends, sides = without_coincident(all_vertices, found.ends, found.sides, first_corner, size)
    return assembled(x, vertices, ends, sides, found.signs)


def topology(positions: Any, domain: Box | Domain) -> Topology:
    """The topology of the Voronoi cells of nodes (N, d), d = 1, 2, for `moved`; zero-length facets are kept. Raises what voronoi does."""
    x = checked_positions(positions, "node")
    if x.shape[1] == 3:
        raise BadInput("no topology is kept of cells in three dimensions: ask for the cells of the moved nodes")
    if x.shape[1] == 1:
        return line_topology(x.real, _checked_box(x, domain))
    checked_domain(domain, 2)
    refuse_outside(x, domain)
    return plane_topology(x.real, domain)


def _checked_box(x: Array, domain: Box | Domain) -> Box:
    checked_domain(domain, x.shape[1])
    assert isinstance(domain, Box)
    refuse_outside(x, domain)
    refuse_coincident(x)
    return domain
