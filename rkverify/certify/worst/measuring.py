"""Every quantity of a worst case with the function that measures it."""

from collections.abc import Callable

from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.measures import Measured, rate_case, shape_case
from rkverify.certify.worst.moments import eigenvalue_case, pivot_case
from rkverify.certify.worst.patch import patch_case
from rkverify.certify.worst.smoothed import smoothed_case
from rkverify.certify.worst.tiling import closure_case, measures_case

MEASURES: dict[str, Callable[[WorstCase], Measured]] = {
    "value": lambda case: shape_case(case, 0),
    "first": lambda case: shape_case(case, 1),
    "second": lambda case: shape_case(case, 2),
    "eigenvalue": eigenvalue_case,
    "pivot": pivot_case,
    "psi_star": rate_case,
    "true_rate": rate_case,
    "smoothed": smoothed_case,
    "measures": measures_case,
    "closure": closure_case,
    "patch": patch_case,
}


def measured(case: WorstCase) -> Measured:
    """The error of a case, its bound and its condition number; raises what the computation refuses."""
    return MEASURES[case.quantity](case)
