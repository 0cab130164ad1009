"""Solutions to the exercises of `lagrangian_and_semi_lagrangian_kernels`."""

from fractions import Fraction

import numpy as np

from rkverify.arithmetic.native import Exact
from rkverify.errors import RkverifyError
from rkverify.paper.approximation import approximation
from rkverify.paper.kernel_rates import semi_lagrangian_kernel_rate
from rkverify.solid.cloud import cloud
from rkverify.solid.shape import shape


def works(stretch: float, support: float = 2.2, count: int = 9) -> bool:
    """Whether the drawn out lattice has shape functions at its nodes."""
    X = np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), axis=-1).reshape(-1, 2).astype(float)
    drawn = cloud(X * [stretch, 1.0], support)
    try:
        shape(drawn, drawn.positions)
    except RkverifyError:
        return False
    return True


def exercise_1(support: float = 2.2) -> float:
    """The stretch at which it breaks: where the next column leaves the support, and nodes on one line are left."""
    low, high = 1.0, 4.0
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if works(middle, support) else (low, middle)
    return (low + high) / 2


def exercise_2() -> list[Fraction]:
    """The rates (35) while the plane turns, v = (-y, x): all zero, since n . (v - v_I) is, distances being kept."""
    K = Exact()
    # 3-4-5 triangles: distances to the point (0, 0) are rational.
    places = [(K.ratio(3, 5), K.ratio(4, 5)), (K.ratio(-4, 5), K.ratio(3, 5)), (K.ratio(0), K.ratio(-1, 2))]
    A = approximation(places, 2, K)
    x = A.point(0, 0)
    turn = [(-y, x) for x, y in A.nodes]
    return [semi_lagrangian_kernel_rate(A, x, I, (K.zero(), K.zero()), turn[I]) for I in range(3)]


def exercise_3(F: tuple[tuple[float, float], tuple[float, float]] = ((1.6, 0.4), (0.0, 0.8))) -> tuple[float, float]:
    """The area of the deformed support over that of the circle, and the determinant of F: the same."""
    t = np.linspace(0, 2 * np.pi, 10001)[:-1]
    circle = np.stack([np.cos(t), np.sin(t)], axis=1)

    def area(ring: np.ndarray) -> float:
        x, y = ring.T
        return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2

    return area(circle @ np.array(F).T) / area(circle), float(np.linalg.det(F))
