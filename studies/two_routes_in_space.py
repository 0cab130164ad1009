"""The transcription and the compiled code on the same random nodes in one to three dimensions: largest disagreements."""

from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.certify.two_routes_in_space import SMOOTH, TOLERANCES, survey
from rkverify.readings import WINDOWS
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Statement, Study, Tables, table


@dataclass(frozen=True)
class Parameters:
    """Orders, and how many seeds there are in one, two and three dimensions; each seed makes four cases."""

    orders: tuple[int, ...] = (0, 1, 2)
    seeds: tuple[int, ...] = (8, 4, 1)


SHAPES = ("value", "first", "second")


def compute(p: Parameters) -> Tables:
    """The largest disagreement of each quantity for each dimension and order, and the case in which it was."""
    found = survey(p.orders, {d: range(count) for d, count in enumerate(p.seeds, start=1)})
    which = [
        ("dimension", "", "space dimensions"),
        ("order", "", "order of the basis; cells do not depend on it"),
        ("quantity", "", "shape function, first and second derivative, smoothed gradient, measure and facet of cells"),
    ]
    keys = [{"dimension": w.dimension, "order": w.order, "quantity": w.found.quantity} for w in found]
    largest = [
        {
            "tolerance": TOLERANCES[w.found.quantity],
            "difference": w.found.difference,
            "bound": w.found.bound,
            "ratio": w.found.ratio,
        }
        for w in found
    ]
    worst = [
        {
            "seed": w.seed,
            "tensor": int(w.case.window == "tensor"),
            "own": int(len(set(w.case.supports)) > 1),
            "kernel": SMOOTH.index(w.case.kernel),
        }
        for w in found
    ]
    return {
        "largest": table(
            [{**key, **row} for key, row in zip(keys, largest, strict=True)],
            [
                *which,
                ("tolerance", "1", "of the size of the quantity times the condition number; of the box for cells"),
                ("difference", "its own", "largest difference, a spacing being the unit of length"),
                ("bound", "its own", "what it may be there"),
                ("ratio", "1", "difference over bound"),
            ],
            "Largest disagreement of the two routes over their random cases, by the share of the bound that it takes.",
            Numeric(
                0, 1e4, "rounding differences of two programs, another machine's others; statements keep ratio <= 1"
            ),
        ),
        "worst": table(
            [{**key, **row} for key, row in zip(keys, worst, strict=True)],
            [
                *which,
                ("seed", "", "seed of the case"),
                ("tensor", "", "1 for the tensor window, 0 for the radial one"),
                ("own", "", "1 for supports of the nodes' own, 0 for a common one"),
                ("kernel", "", f"number of the kernel in {', '.join(SMOOTH)}, from 0"),
            ],
            "Where it was: arguments of `drawn`, which makes the case again.",
            Numeric(0, 1e4, "which case is the worst one is a matter of rounding"),
        ),
    }


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Within the bounds or not, for shape functions, smoothed gradients and cells."""
    rows = tables["largest"].frame
    cases = sum(p.seeds) * len(p.orders) * 4
    tried = f"{cases} random cases in {len(p.seeds)} dimensions, orders {', '.join(map(str, p.orders))}, {' and '.join(WINDOWS)} window, common and own supports, {len(SMOOTH)} kernels"
    agree = {
        name: bool((rows[rows["quantity"].isin(quantities)]["ratio"] <= 1).all())
        for name, quantities in (("shapes", SHAPES), ("smoothed", ("smoothed",)), ("cells", ("measure", "facet")))
    }
    values, first, second, smoothed, measure, facet = (f"{TOLERANCES[q]:.0e}" for q in TOLERANCES)
    return [
        Statement(
            "shape functions",
            ("E4", "E9", "E30"),
            f"The compiled shape functions and the transcription {_agree(agree['shapes'])} {values}, their first derivatives to {first}, second to {second}, of their size times the condition number of the moment matrix.",
            agree["shapes"],
            tried,
            "sampled",
        ),
        Statement(
            "smoothed gradients",
            ("E17", "E47"),
            f"The compiled smoothed gradients and the transcription {_agree(agree['smoothed'])} {smoothed} of their size times the condition number, with trapezoid, midpoint and Gauss rules.",
            agree["smoothed"],
            tried,
            "sampled",
            routes=("compiled code on its own cells",),
        ),
        Statement(
            "cells",
            ("E23",),
            f"Measures of cells by Delaunay triangulation and by cutting half-spaces in rationals {_agree(agree['cells'])} {measure} of the box, area vectors of all facets to {facet}.",
            agree["cells"],
            tried,
            "sampled",
            routes=("Delaunay triangulation",),
        ),
    ]


def _agree(whether: bool) -> str:
    return "agree to" if whether else "do not agree to"


STUDY = Study(
    "Two routes in one to three dimensions",
    Parameters(),
    Parameters(orders=(1,), seeds=(2, 1)),
    compute,
    judge,
)
