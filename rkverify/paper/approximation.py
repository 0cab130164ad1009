"""What a reproducing kernel approximation is built from: nodes, supports, kernel, order and arithmetic.

The nodes are X_I for the Lagrangian approximation (8)-(11) and x(X_I, t) for the semi-Lagrangian one
(26)-(33); nothing else tells the two apart.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import BadInput, CoincidentNodes
from rkverify.kernels import Kernel, kernel
from rkverify.paper.numbered import equation
from rkverify.readings import Window, known_window

Vector = tuple[Scalar, ...]
T = TypeVar("T")


@equation(26)
@dataclass(frozen=True)
class Approximation:
    """Nodes x_I (NP, d) and support radii a_I (NP,) in units of length, kernel phi_a, order n, arithmetic K.

    The distance measure (26) is z = |x - x_I| / a_I, with the support owned by the node I. With the tensor window every
    axis has one of its own, z_j = |x_j - x_jI| / a_I, and phi_a is the product of the kernels of these.
    """

    nodes: tuple[Vector, ...]
    supports: tuple[Scalar, ...]
    kernel: Kernel
    order: int
    K: Arithmetic
    window: Window = "radial"
    memo: dict[tuple[str, int], tuple[Any, Any]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def once(self, what: str, x: Vector, make: Callable[[], T]) -> T:
        """make(), computed once for this point; the point is kept, so that no other object takes its identity."""
        key = (what, id(x))
        if key not in self.memo:
            self.memo[key] = (x, make())
        value: T = self.memo[key][1]
        return value

    @property
    def dimension(self) -> int:
        """The number of space dimensions d."""
        return len(self.nodes[0])

    def offset(self, x: Vector, node: int) -> Vector:
        """x - x_I; raises BadInput for a point of another dimension."""
        if len(x) != self.dimension:
            raise BadInput(f"the point has {len(x)} coordinates and the nodes have {self.dimension}: give it as many")
        return tuple(c - n for c, n in zip(x, self.nodes[node], strict=True))

    def distance(self, x: Vector, node: int) -> Scalar:
        """z = |x - x_I| / a_I (26)."""
        return self.K.norm(self.offset(x, node)) / self.supports[node]

    @cached_property
    def axes(self) -> tuple["Approximation", ...]:
        """The approximations in one dimension whose kernels are the factors of the tensor window, one for each axis."""
        return tuple(
            Approximation(tuple((node[j],) for node in self.nodes), self.supports, self.kernel, self.order, self.K)
            for j in range(self.dimension)
        )

    def distances(self, x: Vector, node: int) -> tuple[Scalar, ...]:
        """The one z (26) of the radial window, or z_j = |x_j - x_jI| / a_I of every axis for the tensor window."""
        if self.window == "radial":
            return (self.distance(x, node),)
        return tuple(self.K.absolute(y) / self.supports[node] for y in self.offset(x, node))

    def covers(self, x: Vector, node: int) -> bool:
        """Whether x lies surely inside the support of the node."""
        return all(self.K.surely_positive(1 - z) for z in self.distances(x, node))

    def neighbours(self, x: Vector) -> list[int]:
        """The nodes whose support may reach x; at all others the kernel is zero with all its derivatives."""
        everyone = range(len(self.nodes))

        def outside(J: int) -> bool:
            return any(self.K.surely_positive(z - 1) for z in self.distances(x, J))

        return self.once("neighbours", x, lambda: [J for J in everyone if not outside(J)])

    def point(self, *coordinates: Scalar) -> Vector:
        """The point with these coordinates, as numbers of this approximation's arithmetic."""
        return tuple(self.K.number(c) for c in coordinates)

    def at(self, positions: Sequence[Vector], supports: Sequence[Scalar] | None = None) -> "Approximation":
        """The same approximation with its nodes at other positions, and with other supports where these change too."""
        radii = self.supports if supports is None else tuple(supports)
        return Approximation(tuple(positions), radii, self.kernel, self.order, self.K, self.window)


def approximation(
    nodes: Sequence[Sequence[Scalar]],
    support: Scalar | Sequence[Scalar],
    K: Arithmetic,
    kernel_name: str | Kernel = "cubic",
    order: int = 1,
    window: Window = "radial",
) -> Approximation:
    """An approximation on checked nodes (NP, d) with one support radius for all, or one for each node.

    kernel_name: the name of a kernel, or a kernel. window: radial, or tensor, where all distances are rational.

    Raises BadInput for no nodes, mixed dimensions, a support that is not positive or an order other than
    0, 1, 2; CoincidentNodes; UnknownName for the kernel or the window.
    """
    if not nodes:
        raise BadInput("there are no nodes: give at least one")
    if order not in (0, 1, 2):
        raise BadInput(f"order {order} is not offered: choose 0, 1 or 2")
    if not all(len(node) for node in nodes):
        raise BadInput("a node has no coordinate: give every node at least one")
    if len({len(node) for node in nodes}) > 1:
        raise BadInput("the nodes have different numbers of coordinates: give every node the same")
    points = tuple(tuple(K.number(c) for c in node) for node in nodes)
    many = isinstance(support, Sequence) and not isinstance(support, str)
    supports = tuple(K.number(a) for a in (support if many else [support] * len(points)))
    if len(supports) != len(points):
        raise BadInput(f"{len(supports)} support radii for {len(points)} nodes: give one for each node")
    for node, a in enumerate(supports):
        if not K.surely_positive(a):
            raise BadInput(f"node {node} has support radius {K.text(a)}: it must be positive")
    _refuse_coincident(points, K)
    chosen = kernel(kernel_name) if isinstance(kernel_name, str) else kernel_name
    return Approximation(points, supports, chosen, order, K, known_window(window))


def _refuse_coincident(points: tuple[Vector, ...], K: Arithmetic) -> None:
    seen: dict[tuple[object, ...], int] = {}
    for node, point in enumerate(points):
        place = tuple(K.witness(c) for c in point)
        if place in seen:
            where = ", ".join(map(K.text, point))
            raise CoincidentNodes(f"nodes {seen[place]} and {node} are both at ({where}): remove or move one of them")
        seen[place] = node


def lattice(
    spacing: Scalar,
    support_ratio: Scalar,
    reach: int,
    K: Arithmetic,
    kernel_name: str = "cubic",
    order: int = 1,
) -> Approximation:
    """Nodes I h for I = -n, …, n with support R h: a part of the infinite uniform lattice of Section 4.

    reach: how many spacings from the middle node shape functions are still those of the infinite lattice.
    The middle node has index n.
    """
    h, R = K.number(spacing), K.number(support_ratio)
    if not K.surely_positive(h):
        raise BadInput(f"spacing {K.text(h)}: it must be positive")
    if not K.surely_positive(R):
        raise BadInput(f"support ratio {K.text(R)}: it must be positive")
    n = reach + int(K.witness(R)) + 2
    return approximation([[I * h] for I in range(-n, n + 1)], R * h, K, kernel_name, order)


def middle(lattice: Approximation) -> int:
    """The index of the lattice's middle node."""
    return len(lattice.nodes) // 2
