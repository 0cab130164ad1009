"""Reference values with certified digits, as CSV and JSON, and the vectorised code held against them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.certify.certified import ASKED
from rkverify.certify.reference import agreement, writing
from rkverify.certify.reference.catalogue import FAMILIES, family
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Statement, Study, Tables, table

COLUMNS = (
    ("row", "", "number of the row / number of rows"),
    ("case", "", "name of the case"),
    ("quantity", "", "name with indices from 0"),
    ("value", "see unit", "decimal, right to one unit of its last digit; 0: zero to that many decimal places"),
    ("digits", "1", "certified digits"),
    ("unit", "", "unit of the value; 1 for a pure number"),
    ("equations", "", "numbers of the equations"),
    ("kernel", "", "name of the kernel"),
    ("reading", "", "reading, layer or edge rule"),
    ("routes", "", "independent routes that agree to these digits"),
    ("inputs_sha256", "", "SHA-256 of the canonical JSON of the inputs"),
    ("adler32", "", "Adler-32 of the line before its last comma, eight hexadecimal digits"),
)


@dataclass(frozen=True)
class Parameters:
    """Families of reference values."""

    families: tuple[str, ...] = tuple(FAMILIES)


def compute(p: Parameters) -> Tables:
    """One table for each family, and the agreement in double precision."""
    values = {
        name: table(writing.rows(family(name)), COLUMNS, f"Reference values: {name}.", Exact()) for name in p.families
    }
    rows = [agreement.row(name, family(name)) for name in p.families]
    compared = table(
        rows,
        [
            ("family", "", "family of reference values"),
            ("cases", "1", "number of cases"),
            ("values", "1", "number of values"),
            ("least_digits", "1", "fewest certified digits of a value"),
            ("compared", "1", "values that the vectorised code has as well"),
            ("beyond", "1", "of these, farther from the reference value than the computed bound on rounding"),
            ("near", "", "whether some value comes to within a factor of 1000 of its bound"),
        ],
        "Double precision against the reference values.",
        Exact(),
    )
    return {**values, "agreement": compared}


def documents(p: Parameters, tables: Tables) -> Mapping[str, str]:
    """The same values with their inputs as JSON."""
    return {f"{name}.json": writing.document(name, family(name)) for name in p.families}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Digits and agreement."""
    frame = tables["agreement"].frame
    digits, values, compared = (
        int(frame["least_digits"].min()),
        int(frame["values"].sum()),
        int(frame["compared"].sum()),
    )
    beyond, tight = int(frame["beyond"].sum()), bool(frame["near"].all())
    tried = f"{int(frame['cases'].sum())} cases of {', '.join(p.families)}"
    return [
        Statement(
            "digits",
            (),
            f"{values} reference values carry {digits} or more certified digits: the transcription at two precisions, or in rationals, and a route by definition agree to them.",
            digits >= ASKED,
            tried,
            "sampled",
            routes=(
                "transcription at 40 and 80 digits, or in rationals",
                "absolute coordinates and difference quotients",
            ),
        ),
        Statement(
            "doubles",
            (),
            f"{compared - beyond} of {compared} values of the vectorised code lie within the computed bound on rounding, which is tight to a factor of 1000 in every family: {'yes' if tight else 'no'}.",
            beyond == 0 and tight,
            tried,
            "sampled",
            routes=("reference values", "double precision"),
        ),
    ]


STUDY = Study(
    "Reference values with certified digits",
    Parameters(),
    Parameters(families=("kernels", "rates")),
    compute,
    judge,
    documents=documents,
)
