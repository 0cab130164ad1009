"""The errors of double precision at one point of a worst case, each beside its bound."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import Float
from rkverify.certify.rounding import rounding_bounds
from rkverify.certify.worst.case import KNOWN, WorstCase
from rkverify.certify.worst.shape_rounding import rate_rounding, shape_rounding
from rkverify.errors import SingularMomentMatrix, Undecided
from rkverify.paper.approximation import Approximation, approximation
from rkverify.paper.material_rates import psi_star as literal_psi_star
from rkverify.paper.material_rates import true_rate as literal_true_rate
from rkverify.paper.shape import Values, shape_functions, shape_gradient, shape_second
from rkverify.solid.bases import axis_pairs
from rkverify.solid.kernel_values import Array
from rkverify.solid.neighbours import neighbours
from rkverify.solid.rates import psi_star, true_rate
from rkverify.solid.shape import shape


@dataclass(frozen=True)
class Measured:
    """Of the numbers of a case the largest error, bound and size, the largest share of its own bound that one takes, a condition number.

    Without a bound, where rounding may have made a matrix singular, bound is infinite and share not a number.
    """

    error: float
    bound: float
    size: float
    share: float
    condition: float

    @property
    def ratio(self) -> float:
        """The largest error over the largest bound; not a number without a bound."""
        return self.error / self.bound if np.isfinite(self.bound) and self.bound > 0 else float("nan")

    @property
    def exceeded(self) -> bool:
        """Whether some number is farther off than its bound."""
        return self.share > 1


def compared(errors: Any, bounds: Any, size: float, condition: float) -> Measured:
    """Errors (…) with their bounds (…), and the largest size of what has them."""
    errors, bounds = np.ravel(errors), np.ravel(bounds)
    if not np.isfinite(bounds).all():
        return Measured(float(errors.max()), float("inf"), size, float("nan"), condition)
    shares = np.divide(errors, bounds, out=np.where(errors > 0, np.inf, 0.0), where=bounds > 0)
    return Measured(float(errors.max()), float(bounds.max()), size, float(shares.max()), condition)


def _errors(found: Array, exact: Values, nodes: Array) -> Array:
    """|found - exact| at the nodes, taken with the digits of the exact numbers."""
    zero = 0 * next(iter(exact.values()))
    return np.array([float(abs(exact.get(int(J), zero) - float(found[J]))) for J in nodes])


def shape_case(case: WorstCase, derivatives: int) -> Measured:
    """Psi, its gradient or its second derivatives: `solid/` against the transcription with many digits, node by node."""
    made, A, x = case.cloud(), case.literal(), case.array("point")
    reading = case.reading or "full"
    there = shape(made, x[None], derivatives, reading)  # type: ignore[arg-type]
    of = shape_rounding(made, A, x, derivatives, reading)
    place = A.point(*x.tolist())
    if derivatives == 0:
        parts = [(there.matrix(), shape_functions(A, place), of.values)]
    elif derivatives == 1:
        parts = [(there.gradient_matrix(k), shape_gradient(A, place, k, reading), of.first[k]) for k in range(case.dimension)]  # type: ignore[arg-type]  # fmt: skip
    else:
        parts = [(there.second_matrix(k, l), shape_second(A, place, (k, l), reading), of.second[kl]) for kl, (k, l) in enumerate(axis_pairs(case.dimension))]  # type: ignore[arg-type]  # fmt: skip
    size = max(float(abs(value)) for _, exact, _ in parts for value in exact.values())
    errors = [_errors(found.toarray()[0], exact, of.nodes) for found, exact, _ in parts]
    bounds = np.array([part.bound for *_, part in parts])
    return compared(np.array(errors), bounds + KNOWN * bounds.max(), size, of.systems.condition)


RATES: dict[str, tuple[Callable[..., Array], Callable[..., Values]]] = {
    "psi_star": (psi_star, literal_psi_star),
    "true_rate": (true_rate, literal_true_rate),
}


def rate_case(case: WorstCase) -> Measured:
    """Psi* or the material rate: the two routes in doubles against each other. The bound is the sum of the two routes' own."""
    made, x = case.cloud(), case.array("point")
    v, v_nodes = case.array("velocity"), case.array("node_velocities")
    compiled, transcribed = RATES[case.quantity]
    of = rate_rounding(made, case.literal(), x, v, v_nodes)
    near = neighbours(made, x[None])
    one = np.zeros(len(made))
    one[near.of(0)] = compiled(made, x[None], v[None], v_nodes)

    def literal(K: Arithmetic) -> dict[str, Scalar]:
        A = in_arithmetic(case, K)
        numbers = [A.point(*row) for row in v_nodes.tolist()]
        return {str(J): rate for J, rate in transcribed(A, A.point(*x.tolist()), A.point(*v.tolist()), numbers).items()}

    other = {int(J): rate for J, rate in literal(Float()).items()}
    theirs = transcription_bounds(literal, [str(J) for J in of.nodes])
    part = of.star if case.quantity == "psi_star" else of.true
    size = max(map(abs, other.values()))
    return compared(_errors(one, other, of.nodes), part.bound + theirs, size, of.systems.condition)


def in_arithmetic(case: WorstCase, K: Arithmetic) -> Approximation:
    """The transcription of a case in another arithmetic."""
    given = case.cloud()
    return approximation(given.positions.tolist(), given.supports.tolist(), K, given.kernel, given.order, given.window)


def transcription_bounds(literal: Callable[[Arithmetic], dict[str, Scalar]], keys: Sequence[str]) -> Array:
    """What rounding may do to the transcription's own operations: balls of 53 bits; infinite where these decide nothing."""
    try:
        found = rounding_bounds(literal)
    except (SingularMomentMatrix, Undecided):
        return np.full(len(keys), np.inf)
    # Half a unit in the last place of the ball's middle, which is stored as a double, is part of its radius already.
    return np.array([found.get(key, 0.0) for key in keys])
