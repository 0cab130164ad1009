"""The search that finds worst cases: a seeded climb, one small change after the other, that goes back where the ratio falls.

>>> case, found = climb(Search("closure", 2, seed=1, steps=5))
>>> 0 < found.ratio <= 1
True
"""

from dataclasses import replace

import numpy as np

from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.measures import Measured
from rkverify.certify.worst.measuring import measured
from rkverify.certify.worst.moments import answers, pivots
from rkverify.certify.worst.starts import Search
from rkverify.errors import BadInput, RkverifyError, UnknownName
from rkverify.solid.kernel_values import Array

__all__ = ["Search", "climb"]
MOVED = ("nodes", "supports", "point", "velocity", "node_velocities", "cell")
SMALLEST = 16
"""Changes are from 1 down to 10^-16 of a unit of length: what decides is often in the last bits."""


CLEAR = 2.0
"""How far a case just before the refusal stays from it, in units of the rule: other processors must answer it as well."""
AIMS = ("ratio", "condition", "margin")


def climb(search: Search) -> tuple[WorstCase, Measured]:
    """The case with the largest of what the search aims at that it meets, and what was measured.

    A third of the steps are fresh starts, of which the best goes on. Raises UnknownName for the aim, BadInput where no
    start can be measured.
    """
    if search.aim not in AIMS:
        raise UnknownName("aim", search.aim, AIMS)
    rng = np.random.default_rng(search.seed)
    best, most = None, 0.0
    for step in range(search.steps):
        fresh = best is None or step < search.steps / 3
        tried = search.start(rng) if fresh or best is None else changed(best, rng, 10.0**-search.flat)
        score = one_score(tried, search.aim)
        if score is not None and score >= most:
            best, most = tried, score
    if best is None:
        raise BadInput(f"no case that {search.words} starts from can be measured: take another seed or more steps")
    return best, measured(best)


def one_score(case: WorstCase, aim: str) -> float | None:
    """What is aimed at, above all a bound that is exceeded; None where nothing can be measured, or no bound is there."""
    try:
        if aim == "margin":
            score = pivots(case).margin
        else:
            found = measured(case)
            score = found.share if found.exceeded else found.ratio
            score = found.condition if aim == "condition" else score
            if aim == "condition" and not (answers(case) and pivots(case).margin >= CLEAR):
                return None
    except (RkverifyError, ZeroDivisionError, np.linalg.LinAlgError):
        return None
    return score if np.isfinite(score) else None


def changed(case: WorstCase, rng: np.random.Generator, height: float) -> WorstCase:
    """The case with one number changed, or all of one kind, or the point put on a node or on the edge of a support.

    height: how flat the nodes are; half of all changes of places are as much smaller. Nodes in one plane stay where they are.
    """
    names = [name for name in MOVED if getattr(case, name) is not None]
    if case.quantity == "pivot":
        names.remove("nodes")
    name = names[rng.integers(len(names))]
    if name == "point" and rng.random() < 0.2:
        return replace(case, point=_corner(case, rng))
    old = case.array(name)
    step = 10.0 ** -rng.uniform(0, SMALLEST) * rng.normal(size=old.shape)
    if name in ("nodes", "point", "cell"):
        step *= height if rng.random() < 0.5 else 1.0
    if rng.random() < 0.7:
        only = np.zeros(old.size)
        only[rng.integers(old.size)] = 1.0
        step = step * only.reshape(old.shape)
    return replace(case, **{name: old + step})


def _corner(case: WorstCase, rng: np.random.Generator) -> Array:
    J = rng.integers(len(case.nodes))
    place = case.nodes[J].copy()
    if rng.random() < 0.5:
        place[rng.integers(case.dimension)] += (
            rng.choice([-1.0, 1.0]) * case.array("supports")[J] * rng.choice([0.5, 1.0])
        )
    return place
