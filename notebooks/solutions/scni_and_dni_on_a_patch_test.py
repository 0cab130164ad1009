"""Solutions to the exercises of `scni_and_dni_on_a_patch_test`."""

from rkverify.certify.mechanics import patch
from rkverify.certify.mechanics.specimens import l_with_hole

SEED = 20074


def error(
    kind: str, integration: str, field: str, order: int = 1, ratio: float = 2.3, condition: str = "nitsche"
) -> float:
    """The largest error of a field over its largest value."""
    body = l_with_hole(kind, 8, SEED)
    return patch.errors(patch.small(body, integration, order, ratio, "trapezoid", condition), field=field)[0]  # type: ignore[arg-type]


def exercise_1() -> float:
    """SCNI with the boundary nodes' values held: it fails, since between the nodes the boundary is not where it is said to be.

    Inner nodes' functions are not zero on the boundary, so that coefficients there do not decide the field on it.
    """
    return error("jittered", "scni", "linear", condition="nodes")


def exercise_2() -> tuple[float, float]:
    """DNI on uniform and on jittered nodes: uniform nodes do not save it, since near the boundary nothing is symmetric."""
    return error("uniform", "dni", "linear"), error("jittered", "dni", "linear")


def exercise_3() -> tuple[float, float]:
    """SCNI with a quadratic basis, linear and quadratic fields: the gradient is constant in a cell, so that the second fails."""
    return error("jittered", "scni", "linear", 2, 3.2), error("jittered", "scni", "quadratic", 2, 3.2)
