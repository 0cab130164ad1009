"""How far double precision lets two right computations of the same shape functions be apart."""

import numpy as np

from rkverify.solid.bases import basis_tables
from rkverify.solid.cloud import Cloud
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import Neighbours
from rkverify.solid.shape import condition_numbers

EPSILON = 2.0**-52


def relative_rounding(cloud: Cloud, points: Array, known: Neighbours) -> Array:
    """m (n + m) 2^-52 cond M (P,): n nodes are summed into each entry of M, m eliminations add as much again,

    and the solution of a linear system carries the relative error of its matrix times the condition number. Doubled, since
    two computations are compared; and again for derivatives, whose right-hand sides hold a solution already.
    """
    m = basis_tables(cloud.dimension, cloud.order).size
    count = np.diff(known.starts)
    rounding: Array = 4 * m * (count + m) * EPSILON * condition_numbers(cloud, points, known)
    return rounding


def lengths_at(cloud: Cloud, known: Neighbours) -> Array:
    """The largest support over each point (P,), the unit of length in which the moment matrix is scaled."""
    longest: Array = np.maximum.reduceat(cloud.supports[known.nodes], known.starts[:-1])
    return longest
