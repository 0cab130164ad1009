"""Solutions to the exercises of `start_here`."""

from fractions import Fraction
from itertools import pairwise

import numpy as np

from rkverify.arithmetic.native import Exact
from rkverify.errors import RkverifyError
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.shape import Values, reproducing_residual, shape_functions, shape_gradient
from rkverify.solid.cloud import cloud
from rkverify.solid.shape import shape

NODES = ("0", "1/5", "9/20", "3/5", "4/5", "1")


def of_nodes(support: str, order: int = 1, scale: int = 1) -> Approximation:
    """The notebook's nodes, all lengths times a scale."""
    K = Exact()
    return approximation([[K.number(x) * scale] for x in NODES], K.number(support) * scale, K, "cubic", order)


def exercise_1() -> list[Fraction]:
    """The residuals of the degrees 0 to 3 at x = 1/2 with order 2: zero up to the order, and not one further."""
    A = of_nodes("3/5", order=2)
    return [reproducing_residual(A, A.point("1/2"), (degree,)) for degree in range(4)]


def works(support: Fraction) -> bool:
    """Whether every place between the first and the last node has shape functions of order 1.

    Between two places where a support begins or ends the neighbours are the same: one point of each stretch is enough, and the ends.
    """
    A = of_nodes(str(support))
    x = [node[0] for node in A.nodes]
    ends = sorted({0, 1, *x, *(p + s * support for p in x for s in (-1, 1) if 0 < p + s * support < 1)})
    try:
        for place in [*ends, *((p + q) / 2 for p, q in pairwise(ends))]:
            shape_functions(A, (place,))
    except RkverifyError:
        return False
    return True


def exercise_2() -> Fraction:
    """The smallest support in twentieths: everywhere two nodes must be nearer than it."""
    return next(a for a in (Fraction(n, 20) for n in range(1, 21)) if works(a))


def exercise_3() -> tuple[Values, Values, Values, Values]:
    """Shape functions and derivatives before and after all lengths have doubled: the same, and halved."""
    A, B = of_nodes("2/5"), of_nodes("2/5", scale=2)
    x, y = A.point("1/2"), B.point("1")
    return shape_functions(A, x), shape_functions(B, y), shape_gradient(A, x), shape_gradient(B, y)


def dense_check(support: float) -> bool:
    """The same question as `works`, asked at many points in double precision."""
    nodes = np.array([[float(Fraction(x))] for x in NODES])
    try:
        shape(cloud(nodes, support), np.linspace(0, 1, 2001)[:, None])
    except RkverifyError:
        return False
    return True
