"""What in our terms the numbers of other packages are: a claim or a formula whose numbers ought to be theirs."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from rkverify.check.claim import Claim, predicted
from rkverify.check.entries import Entries, apart
from rkverify.check.other_kernels import OTHER_KERNELS
from rkverify.check.peer_corrections import CENTRE, UNIFORM, corrected, least_squares, mixed
from rkverify.check.peer_tables import PeerTable, peer_tables
from rkverify.check.rounding import lengths_at
from rkverify.check.shape import check_shape
from rkverify.kernels import Kernel, kernel
from rkverify.readings import Derivative
from rkverify.solid.neighbours import neighbours
from rkverify.solid.shape import condition_numbers


def _power(name: str) -> Kernel:
    return next(kernel for kernel in OTHER_KERNELS if kernel.name == name)


def _with_kernel(claim: Claim, of: Kernel, **change: Any) -> Claim:
    return replace(claim, cloud=replace(claim.cloud, kernel=of), **change)


@dataclass(frozen=True)
class Counterpart:
    """What a package computes, in our words, and the numbers that ought to be its own; for tables whose name begins so and ends so."""

    begins: str
    ends: str
    says: str
    ours: Callable[[PeerTable], Entries]


def _claimed(**change: Any) -> Callable[[PeerTable], Entries]:
    return lambda table: predicted(replace(table.claim, **change), table.theirs.columns)


def _of_kernel(name: str, reading: Derivative) -> Callable[[PeerTable], Entries]:
    of = _power(name) if name.startswith("(") else kernel(name)
    return lambda table: predicted(_with_kernel(table.claim, of, derivative=reading), table.theirs.columns)


COUNTERPARTS: tuple[Counterpart, ...] = (
    Counterpart("pycompadre", "own", "diffuse, supports owned by the point", _claimed(derivative="diffuse", owner="target")),
    Counterpart("pycompadre", "power", "diffuse, weights (1 - z)^2", _of_kernel("(1 - z)^2", "diffuse")),
    Counterpart("pycompadre", "", "diffuse, cubic kernel (12)", _claimed(derivative="diffuse")),
    Counterpart("pysph_own", "crksph", "full, supports the mean of both, kernels divided by a^d", _claimed(owner="mean", normalised=True)),
    Counterpart("pysph", "quintic", "full, quintic kernel", _of_kernel("quintic", "full")),
    Counterpart("pysph", "wendland", "full, wendland-c2 kernel", _of_kernel("wendland-c2", "full")),
    Counterpart("pysph", "crksph", "full, cubic kernel (12)", _claimed()),
    Counterpart("pysph", "gradient", "frozen of order 0, times L", lambda table: corrected(table, "frozen")),
    Counterpart("pysph", "mixed", "kernel gradient less a sum without its kernel, times L", mixed),
    Counterpart("wlsqm", "uniform", "diffuse, weights 1", lambda table: least_squares(table, UNIFORM)),
    Counterpart("wlsqm", "centre", "diffuse, weights (1 - z)^2 with a floor, z = 1 at the farthest neighbour", lambda table: least_squares(table, CENTRE)),
)  # fmt: skip


def counterpart(table: PeerTable) -> Counterpart | None:
    """The first that fits the table's name; None for a table that mixes two things (see `uncorrected`)."""
    fitting = (c for c in COUNTERPARTS if table.name.startswith(c.begins) and table.name.endswith(c.ends))
    return next(fitting, None)


def agreement_rows(begins: tuple[str, ...] = ("",)) -> list[dict[str, Any]]:
    """Largest differences of the tables whose name begins so from their counterparts, and from the full derivative."""
    rows = []
    for table in peer_tables():
        found = counterpart(table)
        if found is None or not table.name.startswith(begins):
            continue
        gap = abs(apart(found.ours(table), table.theirs).numbers)
        values = table.theirs.columns[0] == "psi"
        claim = table.claim
        known = neighbours(claim.cloud, claim.points)
        rows.append(
            {
                "values": table.name,
                "package": table.package,
                "version": table.version,
                "quantity": table.quantity,
                "dimension": claim.cloud.dimension,
                "order": claim.cloud.order,
                "pairs": len(table.theirs.rows),
                "ours": found.says,
                "value_difference": float(gap[:, 0].max()) if values else None,
                "gradient_difference": float(gap[:, int(values) :].max() * lengths_at(claim.cloud, known).max()),
                "condition": float(condition_numbers(claim.cloud, claim.points, known).max()),
                "from_full": _from_full(table),
            }
        )
    return rows


def _from_full(table: PeerTable) -> float:
    """The largest difference of the derivatives from the full ones of the nominal claim, times the largest support."""
    slopes = [c for c, name in enumerate(table.theirs.columns) if name != "psi"]
    theirs = table.theirs.part(slopes)
    length = lengths_at(table.claim.cloud, neighbours(table.claim.cloud, table.claim.points)).max()
    return float(abs(apart(predicted(table.claim, theirs.columns), theirs).numbers).max() * length)


def verdict_rows(begins: tuple[str, ...] = ("",)) -> list[dict[str, Any]]:
    """What `rkverify check` says about the tables whose name begins so under the nominal claim, up to the numbers that rounding decides."""
    rows = []
    for table in peer_tables():
        if not table.name.startswith(begins):
            continue
        report = check_shape(table.claim, table.theirs)
        said = report.verdict.partition(";")[0].partition(": off by")[0]
        rows.append(
            {
                "values": table.name,
                "quantity": f"{table.package}: {table.quantity}",
                "passes": report.passed,
                "verdict": said,
            }
        )
    return rows
