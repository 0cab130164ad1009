"""The choices that the paper leaves open, by name; both routes, `paper/` and `solid/`, take them."""

from dataclasses import dataclass
from typing import Literal, get_args

from rkverify.errors import UnknownName

Derivative = Literal["full", "diffuse", "frozen-b", "frozen"]
HalfPoint = Literal["literal", "edge"]
Convection = Literal["psi-star", "true", "none"]
StressLaw = Literal["truesdell", "cauchy-rate", "literal"]
NodeMotion = Literal["coefficient", "field"]
CellEdges = Literal["voronoi", "material", "fixed"]
CellMeasure = Literal["edges", "material", "fixed"]
SupportRadius = Literal["fixed", "spacing"]
Mass = Literal["lumped", "consistent"]
Integration = Literal["scni", "dni"]
NodalIntegration = Literal["scni", "dni", "snni"]
Window = Literal["radial", "tensor"]

DERIVATIVES: tuple[Derivative, ...] = get_args(Derivative)
"""Readings of the derivative of a shape function.

full: of everything that depends on x; diffuse: the row of M^-1 H phi that belongs to the derivative;
frozen-b: of polynomial times kernel with b(x) held; frozen: of the kernel alone, times C.
"""
HALF_POINTS: tuple[HalfPoint, ...] = get_args(HalfPoint)
CONVECTIONS: tuple[Convection, ...] = get_args(Convection)
STRESS_LAWS: tuple[StressLaw, ...] = get_args(StressLaw)
NODE_MOTIONS: tuple[NodeMotion, ...] = get_args(NodeMotion)
CELL_EDGES: tuple[CellEdges, ...] = get_args(CellEdges)
CELL_MEASURES: tuple[CellMeasure, ...] = get_args(CellMeasure)
SUPPORT_RADII: tuple[SupportRadius, ...] = get_args(SupportRadius)
MASSES: tuple[Mass, ...] = get_args(Mass)
INTEGRATIONS: tuple[Integration, ...] = get_args(Integration)
NODAL_INTEGRATIONS: tuple[NodalIntegration, ...] = get_args(NodalIntegration)
"""scni: over the conforming cells; dni: direct, at the node; snni: over boxes about the nodes that do not conform."""
WINDOWS: tuple[Window, ...] = get_args(Window)
"""radial: phi(|x - x_I| / a_I); tensor: the product over the axes of phi(|x_j - x_jI| / a_I)."""


def known_window(name: str) -> Window:
    """The window of that name; raises UnknownName."""
    for window in WINDOWS:
        if window == name:
            return window
    raise UnknownName("window", name, WINDOWS)


@dataclass(frozen=True)
class Readings:
    """One choice of everything that the semi-Lagrangian equations leave open, with the integration.

    convection: N with Psi* (40), with the true material rate, or none. stress_law: sigma' = (C + sigma) L (truesdell),
    sigma' = C L (cauchy-rate), or (69) taken literally. node_motion: a node moves with its own coefficient v_I, or with
    the field v(x_I). cell_edges: half-way between nodes, carried by the field, or fixed in space. cell_measure a_K: from
    the edges, growing as a_K' = a_K L_K, or fixed; the mass m_K = rho_K a_K of a cell never changes. support_radius in
    time: fixed, or R times half the distance between the neighbours. mass: row sums (lumped), or the whole of (42).
    """

    integration: Integration
    convection: Convection = "psi-star"
    derivative: Derivative = "full"
    stress_law: StressLaw = "truesdell"
    node_motion: NodeMotion = "coefficient"
    cell_edges: CellEdges = "voronoi"
    cell_measure: CellMeasure = "edges"
    support_radius: SupportRadius = "fixed"
    mass: Mass = "lumped"

    def __post_init__(self) -> None:
        """Raises UnknownName for an option that does not exist."""
        options: tuple[tuple[str, str, tuple[str, ...]], ...] = (
            ("integration", self.integration, INTEGRATIONS),
            ("convection", self.convection, CONVECTIONS),
            ("derivative", self.derivative, DERIVATIVES),
            ("stress law", self.stress_law, STRESS_LAWS),
            ("node motion", self.node_motion, NODE_MOTIONS),
            ("cell edges", self.cell_edges, CELL_EDGES),
            ("cell measure", self.cell_measure, CELL_MEASURES),
            ("support radius", self.support_radius, SUPPORT_RADII),
            ("mass", self.mass, MASSES),
        )
        for kind, value, known in options:
            if value not in known:
                raise UnknownName(kind, value, known)
