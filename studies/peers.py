"""Shape functions of other packages beside ours: pycompadre, PySPH, wlsqm, and what `rkverify check` says about their numbers."""

from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.check.peer_corrections import corrected, mixed, uncorrected, unit_dependence
from rkverify.check.peer_tables import fingerprint, peer_tables
from rkverify.check.peers import agreement_rows, verdict_rows
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Statement, Study, Tables, rounding, table

AGREED = 1e-12
"""What is asked for, of values and of derivatives times the support."""
DATA = "their numbers on jittered lattices in one, two and three dimensions, computed by `make peers`"


@dataclass(frozen=True)
class Parameters:
    """The hash of the other packages' numbers, and the tables that are taken, by the beginning of their names."""

    data: str
    tables: tuple[str, ...] = ("",)


def compute(p: Parameters) -> Tables:
    """Differences from our counterpart of each table, verdicts under one nominal claim, and the parts of mixed tables."""
    agreement = agreement_rows(p.tables)
    found = {one.name: one for one in peer_tables()}
    full, alone, rest = uncorrected(found["pysph_plane_crksph_default"])
    plane = found["pysph_plane_mixed"], found["pysph_plane_gradient"]
    of_rounding = Numeric(
        1e-6, AGREED, "rounding of the two computations; what is no rounding is rounded to six digits"
    )
    return {
        "agreement": table(
            agreement,
            [
                ("values", "", "table of theirs"),
                ("package", "", "package"),
                ("version", "", "its version"),
                ("quantity", "", "what it was asked for"),
                ("dimension", "1", "number of space dimensions"),
                ("order", "1", "order of the basis"),
                ("pairs", "1", "pairs of point and node"),
                ("ours", "", "what it is in our words"),
                ("value_difference", "1", "largest difference of Psi"),
                ("gradient_difference", "1", "largest difference of the derivatives, times the support radius"),
                ("condition", "1", "largest condition number of the moment matrix"),
                ("from_full", "1", "largest difference from the full derivative with the cubic kernel, times the support"),
            ],
            "Numbers of other packages against ours, each with what it computes.",
            of_rounding,
        ),
        "verdicts": table(
            verdict_rows(p.tables),
            [
                ("values", "", "table of theirs"),
                ("quantity", "", "package and what it was asked for"),
                ("passes", "", "whether it is what is claimed"),
                ("verdict", "", "what `rkverify check shape` says"),
            ],
            "Verdicts of `rkverify check shape` where full derivatives with the cubic kernel and supports owned by the nodes are claimed.",
            Numeric(0, 0, "words; differences in them are given in two digits"),
        ),
        "corrections": table(
            [
                {"what": "pairs with the full derivative, CRKSPH with its default tolerance", "number": full},
                {"what": "pairs with the gradient of the kernel alone", "number": alone},
                {"what": "largest difference from the nearer of the two", "number": rest},
                {"what": "GradientCorrection in another unit of length, change", "number": unit_dependence(plane[1], lambda t: corrected(t, "frozen"))},
                {"what": "MixedGradientCorrection in another unit of length, change", "number": unit_dependence(plane[0], mixed)},
            ],
            [("what", "", "what is counted or measured"), ("number", "1", "count, or relative size")],
            "PySPH's corrections in the plane: pairs that the default tolerance leaves uncorrected, and units.",
            of_rounding,
        ),
    }  # fmt: skip


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What each package computes, to rounding."""
    frame, verdicts = tables["agreement"].frame, tables["verdicts"].frame
    numbers = tables["corrections"].frame["number"]
    worst = frame[["value_difference", "gradient_difference"]].max(axis=1)

    def of(begins: str, word: str = "") -> tuple[float, float, int, str]:
        mine = frame["values"].str.startswith(begins) & frame["values"].str.contains(word)
        versions = " ".join(
            f"{package} {version}"
            for package, version in zip(*(frame[mine][c].unique() for c in ("package", "version")))
        )
        return float(worst[mine].max()), float(frame[mine]["from_full"].max()), int(mine.sum()), versions

    def statement(name: str, begins: str, word: str, says: str) -> Statement:
        size, full, count, versions = of(begins, word)
        said = says.format(versions=versions, size=rounding(size), full=f"{full:.2g}", count=count)
        return Statement(name, (), said, size <= AGREED, DATA, "sampled")

    default = str(verdicts.set_index("values")["verdict"]["pysph_plane_crksph_default"])
    named = verdicts[verdicts["verdict"].str.contains("what is claimed is")]
    return [
        statement(
            "pycompadre", "pycompadre", "",
            "{versions}: its moving least squares with the weighting CardinalCubicBSpline are our shape functions with the cubic kernel (12), or with weights "
            "(1 - z)^2, to {size}, and its gradient is the diffuse one, up to {full} from the full one ({count} tables); its window belongs to the target point.",
        ),
        statement(
            "crksph", "pysph", "crksph",
            "{versions}: CRKSPH with unit volumes, corrected for every pair, is the linear reproducing kernel with the full derivative to {size} "
            "({count} tables, three kernels); with supports of their own, a pair has the mean of both and a kernel divided by a^d.",
        ),
        statement(
            "gradient_correction", "pysph", "_gradient",
            "{versions}: GradientCorrection is the frozen derivative of order 0 times the matrix that makes its first moments the identity, to {size}; "
            "it acts on differences from the point's own value and is no derivative of a shape function (up to {full} from the full one).",
        ),
        statement(
            "mixed_correction", "pysph", "_mixed",
            "{versions}: MixedGradientCorrection is, to {size}, the kernel's gradient less a sum that lacks the kernel as a factor, times such a matrix. "
            f"The two terms have different units: told in thousandths of the unit of length, its gradients change by {numbers.iloc[4]:.3g} times the largest, "
            f"those of GradientCorrection by {rounding(float(numbers.iloc[3]))}.",
        ),
        Statement(
            "tolerance",
            (),
            f"With its default tolerance CRKSPH leaves {int(numbers.iloc[1])} of {int(numbers.iloc[0] + numbers.iloc[1])} pairs uncorrected on the jittered "
            f"plane; `rkverify check` says: {default.removeprefix('FAIL: ')}.",
            bool(numbers.iloc[1] > 0 and numbers.iloc[2] <= AGREED and "do not reproduce" in default),
            DATA,
            "sampled",
        ),
        statement(
            "wlsqm", "wlsqm", "",
            "{versions}: value and derivatives of its fits are moving least squares with diffuse derivatives to {size} ({count} tables), with weights 1, or "
            "with (1 - z)^2 and a floor where z = 1 is at the farthest neighbour of the point.",
        ),
        Statement(
            "verdicts",
            (),
            f"Of {len(verdicts)} tables under one nominal claim, `rkverify check` passes the {int(verdicts['passes'].sum())} that are it, names another choice in "
            f"{len(named)}, and tells for the other {len(verdicts) - len(named) - int(verdicts['passes'].sum())} which sums fail or that no choice it knows gives them.",
            bool(verdicts[verdicts["passes"]]["values"].str.match("pysph_(line|plane|box)_crksph$").all() and len(named)),
            DATA,
            "sampled",
        ),
    ]  # fmt: skip


STUDY = Study(
    "Other packages' shape functions",
    Parameters(fingerprint()),
    Parameters(fingerprint(), ("pycompadre_plane", "pysph_plane", "wlsqm_plane_order1")),
    compute,
    judge,
)
