"""The searches whose findings are committed, by the names of their cases; `python -m rkverify.certify.worst.catalogue` searches on.

With a seed it runs all searches from there, and prints what comes nearer to its bound than the committed case: a table
[[case]] to put in its place in studies/data/worst_cases.toml. With `--write` it writes the file from its own seeds (10 min).
"""

import sys
from dataclasses import replace

from rkverify.certify.worst.case import WorstCase
from rkverify.certify.worst.file import committed, read_cases, written
from rkverify.certify.worst.measuring import measured
from rkverify.certify.worst.search import climb
from rkverify.certify.worst.starts import Search
from rkverify.errors import BadInput, RkverifyError

SEARCHES: dict[str, Search] = {
    "values on a line": Search("value", 1, steps=600),
    "values in the plane, nodes near a line": Search("value", 2, flat=3, steps=400),
    "values in the plane, order 2, tensor window": Search("value", 2, 2, window="tensor", steps=300),
    "values in space, nodes near a plane": Search("value", 3, flat=4, steps=400),
    "values in space, order 2": Search("value", 3, 2, kernel="quintic", steps=90),
    "values just before the refusal": Search("value", 2, flat=6, steps=400, aim="condition"),
    "slopes on a line, order 2": Search("first", 1, 2, kernel="wendland-c2", steps=400),
    "slopes in the plane, nodes near a line": Search("first", 2, flat=4, steps=300),
    "slopes in space": Search("first", 3, kernel="quintic", steps=200),
    "diffuse slopes in the plane, order 2": Search("first", 2, 2, reading="diffuse", flat=1, steps=200),
    "curvatures on a line, order 0": Search("second", 1, 0, steps=300),
    "curvatures on a line, order 2": Search("second", 1, 2, kernel="quartic", steps=300),
    "curvatures in the plane, nodes near a line": Search("second", 2, flat=2, steps=120),
    "curvatures in space, tensor window": Search("second", 3, window="tensor", kernel="wendland-c4", steps=45),
    "eigenvalue in the plane, nodes near a line": Search("eigenvalue", 2, flat=3, steps=400),
    "eigenvalue in space, nodes near a plane": Search("eigenvalue", 3, flat=4, steps=300),
    "eigenvalue just before the refusal": Search("eigenvalue", 2, flat=6, steps=400, aim="condition", seed=1),
    "eigenvalue, order 2, just before the refusal": Search("eigenvalue", 2, 2, flat=2, steps=400, aim="condition"),
    "nodes on a line": Search("pivot", 2, steps=2000, aim="margin"),
    "nodes in two rows, order 2": Search("pivot", 2, 2, steps=2000, aim="margin"),
    "nodes in a plane": Search("pivot", 3, steps=2000, aim="margin"),
    "Psi* on a line": Search("psi_star", 1, steps=300),
    "Psi* in the plane": Search("psi_star", 2, kernel="wendland-c2", flat=1, steps=200),
    "material rates on a line, order 2": Search("true_rate", 1, 2, steps=300),
    "material rates in the plane": Search("true_rate", 2, flat=1, steps=200),
    "smoothed gradients on a line": Search("smoothed", 1, steps=150),
    "smoothed gradients in the plane": Search("smoothed", 2, steps=80),
    "measures in the plane": Search("measures", 2, steps=800),
    "measures in space": Search("measures", 3, steps=400),
    "closure in the plane": Search("closure", 2, steps=800),
    "closure in space": Search("closure", 3, steps=400),
    "patch test of a bar": Search("patch", 1, steps=200),
    "patch test of a plate": Search("patch", 2, steps=60),
}
"""name -> the search that found the case of that name."""


def found(name: str) -> WorstCase:
    """The case that its search finds, again."""
    case, share = climb(SEARCHES[name])
    return replace(case, name=name, error=share.error)


def better(seed: int) -> list[WorstCase]:
    """What the searches find from another seed that comes nearer to its bound, or is worse conditioned, than the committed case."""
    kept = []
    for old in read_cases():
        search = replace(SEARCHES[old.name], seed=seed)
        new, share = climb(search)
        before = measured(old)
        gain = share.condition > before.condition if search.aim == "condition" else share.ratio > before.ratio
        if gain:
            kept.append(replace(new, name=old.name, error=share.error))
    return kept


def main(arguments: list[str]) -> int:
    """Search on from a seed, or write the committed file anew."""
    try:
        if arguments == ["--write"]:
            committed().write_text(written([found(name) for name in SEARCHES]), encoding="utf-8")
            return 0
        if len(arguments) != 1 or not arguments[0].isdigit():
            raise BadInput("give a seed, such as 1, or --write")
        cases = better(int(arguments[0]))
    except RkverifyError as error:
        print(error, file=sys.stderr)
        return 2
    print(written(cases))
    print(
        f"# {len(cases)} of {len(SEARCHES)} searches from seed {arguments[0]} come nearer to a bound than the committed case;"
    )
    print(
        "# to keep one, put its [[case]] in place of the other in studies/data/worst_cases.toml: `make test` replays it from then on."
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
