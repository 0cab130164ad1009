"""Clouds of nodes: what a reproducing kernel approximation in one, two or three dimensions is built from, in double precision."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rkverify.errors import BadInput, CoincidentNodes
from rkverify.kernels import Kernel
from rkverify.kernels import kernel as kernel_named
from rkverify.readings import Window, known_window
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class Cloud:
    """Nodes x_I (N, d) and support radii a_I (N,) in units of length, kernel, order of the basis and window.

    The support is owned by the node I: z = |x - x_I| / a_I (radial), or the product of kernels of |x_j - x_jI| / a_I
    (tensor). Positions may be complex, for a complex step: decisions look at their real part.
    """

    positions: Array
    supports: Array
    kernel: Kernel
    order: int = 1
    window: Window = "radial"

    @property
    def dimension(self) -> int:
        """The number d of space dimensions."""
        return int(self.positions.shape[1])

    def __len__(self) -> int:
        """The number N of nodes."""
        return len(self.positions)

    def at(self, positions: Array, supports: Array | None = None) -> "Cloud":
        """The same approximation with its nodes at other positions (N, d), and perhaps with other supports; nothing is checked."""
        return replace(self, positions=positions, supports=self.supports if supports is None else supports)


def cloud(
    positions: Any,
    support: Any,
    kernel: str | Kernel = "cubic",
    order: int = 1,
    window: Window = "radial",
) -> Cloud:
    """A cloud of checked nodes (N, d), d = 1, 2, 3, with one support radius for all or one for each node (N,).

    Raises BadInput for no nodes, another shape, a value that is not finite, a support that is not positive or an order
    other than 0, 1, 2; CoincidentNodes; UnknownName for the kernel or the window.

    >>> cloud([[0, 0], [1, 0], [0, 1]], 2).dimension
    2
    """
    x = checked_positions(positions, "node")
    if order not in (0, 1, 2):
        raise BadInput(f"order {order} is not offered: choose 0, 1 or 2")
    a = np.array(
        np.broadcast_to(np.asarray(support, dtype=float), len(x)) if np.ndim(support) == 0 else support, dtype=float
    )
    if a.shape != (len(x),):
        raise BadInput(f"{a.size} support radii for {len(x)} nodes: give one for each node")
    bad = np.flatnonzero(~(np.isfinite(a) & (a > 0)))
    if len(bad):
        raise BadInput(f"node {bad[0]} has support radius {a[bad[0]]}: it must be positive and finite")
    refuse_coincident(x)
    return Cloud(x, a, kernel_named(kernel) if isinstance(kernel, str) else kernel, int(order), known_window(window))


def checked_positions(positions: Any, what: str) -> Array:
    """Positions as an array (N, d) of doubles or complex doubles; raises BadInput naming the first that is not finite."""
    try:
        x = np.array(positions)
        x = np.ascontiguousarray(x, dtype=complex if np.iscomplexobj(x) else float)
    except (ValueError, TypeError):
        raise BadInput(f"the {what}s are no table of numbers: give each the same number of coordinates") from None
    if x.ndim != 2 or len(x) == 0 or x.shape[1] not in (1, 2, 3):
        raise BadInput(f"the {what}s have shape {x.shape}: give (N, d) with N of at least 1 and d of 1, 2 or 3")
    if not np.isfinite(x).all():
        bad = np.flatnonzero(~np.isfinite(x).all(axis=1))
        raise BadInput(f"{what} {bad[0]} is at ({shown(x[bad[0]])}): every coordinate must be finite")
    return x


def refuse_coincident(x: Array) -> None:
    """Raise CoincidentNodes, naming both, where two nodes are at one place in double precision."""
    order = np.lexsort(x.real.T)
    same = np.flatnonzero((np.diff(x.real[order], axis=0) == 0).all(axis=1))
    if len(same):
        first, second = sorted(order[same[0] : same[0] + 2])
        raise CoincidentNodes(f"nodes {first} and {second} are both at ({shown(x[first])}): remove or move one of them")


def shown(place: Sequence[Any] | Array) -> str:
    """Coordinates as a person would write them, the real part of complex ones."""
    return ", ".join(f"{np.real(c):.12g}" for c in place)
