"""Theorems over continuous ranges with proof logs: reproduction, kernels, SCNI, the printed and the computed conditions."""

from collections.abc import Mapping
from dataclasses import dataclass

from rkverify.certify.theorems import catalogue
from rkverify.certify.theorems.families import FAMILIES
from rkverify.certify.theorems.open_ends import OPEN_ENDS
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Drawing, Study, Tables, table
from rkverify.workflow.style import new_figure
from studies._theorem_statements import statements


@dataclass(frozen=True)
class Parameters:
    """The families of theorems that are proved."""

    families: tuple[str, ...] = tuple(FAMILIES)


def compute(p: Parameters) -> Tables:
    """Every theorem, the stable windows, and what is neither proved nor refuted."""
    theorems = catalogue.rows(p.families)
    return {
        "theorems": table(
            theorems,
            [
                ("family", "", "its proof is in the log FAMILY.json"),
                ("theorem", "", "name in the log"),
                ("says", "", "the statement; why not, where it is not proved"),
                ("range", "", "of its parameters"),
                ("method", "", "of the proof"),
                ("steps", "1", "boxes, terms or squares"),
                ("status", "", "proved or not"),
                ("claim", "", "whether a claim of the paper holds or fails by it"),
                ("values", "1", "zeros that it encloses, to 30 decimals"),
                ("counterexample", "", "rational parameters at which a claim fails"),
            ],
            "Theorems; `rkverify recheck` repeats every step of their proofs with other code.",
            Exact(),
        ),
        "windows": table(
            catalogue.windows() if set(p.families) >= {"at_pi", "tension"} else [],
            [
                ("kernel", "", ""),
                ("from", "1", "R from which omega^2(pi)/sigma is positive"),
                ("to", "1", "R from which some wave grows at a high enough tension"),
                ("ended_by", "", "the wave that ends the window"),
            ],
            "DNI at rest with the full derivative: the R at which every tension is stable.",
            Exact(),
        ),
        "open_ends": table(
            [vars(end) for end in OPEN_ENDS],
            [
                ("entry", "", "of the ledger"),
                ("layer", "", "none where the entry knows no layers"),
                ("what", "", "what is only sampled"),
                ("why", "", "why it is neither proved nor refuted by exact means"),
                ("part", "", "the half of the verdict that is only sampled; empty for all of it"),
            ],
            "What is only sampled, and why.",
            Exact(),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The proved windows of R per kernel."""
    rows = tables["windows"].frame.to_dict("records")
    figure = new_figure(6.8, 3.0)
    axes = figure.subplots()
    for height, row in enumerate(rows):
        start, end = float(row["from"]), float(row["to"])
        parts = ((1, start, "#404040", ""), (start, end, "#d9d9d9", ""), (end, 4, "#8c8c8c", "////"))
        for low, high, colour, hatch in parts:
            axes.barh(height, high - low, left=low, color=colour, hatch=hatch, edgecolor="white", height=0.7)
    axes.set_yticks(range(len(rows)), [row["kernel"] for row in rows])
    axes.set(xlabel="support ratio  R = a/h  (1)", xlim=(1, 4))
    axes.text(1.05, -0.95, "dark: kh = π grows in every tension; light: no tension grows; hatched: a high tension grows", fontsize=8)  # fmt: skip
    axes.set_ylim(-1.3, len(rows) - 0.4)
    caption = (
        "DNI at rest with the full derivative and a linear basis: proved stretches of the support ratio, for the other kernels than the cubic to within 1e-4 "
        "of the ends. Where kh = pi ends the window, it grows in every tension beyond."
    )
    spans = ", ".join(f"{str(row['from'])[:6]} to {str(row['to'])[:6]} ({row['kernel']})" for row in rows)
    windows = f"DNI at rest is stable in every tension for R from {spans}" if spans else "No window of stable tension was computed"  # fmt: skip
    found = tables["theorems"].frame
    ends = found[found["family"].isin(("at_pi", "tension"))]
    alternative = (
        f"{windows}. Of the theorems on where waves grow before and beyond, "
        f"{int((ends['status'] == 'proved').sum())} of {len(ends)} are proved."
    )
    return {"windows": Drawing(figure, caption, alternative)}


def documents(p: Parameters, tables: Tables) -> Mapping[str, str]:
    """The proof logs, one per family."""
    return {f"{family}.json": catalogue.prove(family).log() for family in p.families}


STUDY = Study(
    "Theorems over continuous ranges, with proof logs",
    Parameters(),
    Parameters(families=("reproduction", "kernels")),
    compute,
    lambda p, tables: statements(tables["theorems"].frame),
    draw,
    documents=documents,
)
