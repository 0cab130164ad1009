"""Reference values as rows of a table and as JSON text; `docs/reference_values.md` describes both."""

import hashlib
import json
import zlib
from collections.abc import Sequence
from typing import Any

from rkverify.certify.reference.case import canonical
from rkverify.certify.reference.catalogue import Case

FORMAT = "rkverify reference values 1"
COLUMNS = (
    "row", "case", "quantity", "value", "digits", "unit", "equations", "kernel", "reading", "routes", "inputs_sha256", "adler32",
)  # fmt: skip


def rows(cases: Sequence[Case]) -> list[dict[str, str | int]]:
    """One row for each number; `row` counts k/n, so that a reader sees where the end is missing, and `adler32` sums up the rest."""
    total, found = sum(len(case.values) for case in cases), list[dict[str, str | int]]()
    for case in cases:
        subject = case.subject
        for quantity, number in case.values.items():
            cells = (
                f"{len(found) + 1}/{total}", plain(subject.name), quantity, number.text, number.digits, subject.unit(quantity),
                " ".join(map(str, subject.equations)), subject.inputs["kernel"], plain(subject.reading),
                "; ".join(number.routes), subject.sha256(),
            )  # fmt: skip
            found.append(dict(zip(COLUMNS, (*cells, checksum(",".join(map(str, cells)))), strict=True)))
    return found


def checksum(text: str) -> str:
    """Adler-32 of a line's text before its last comma: a sum that a reader in any language has in four lines.

    >>> checksum("Wikipedia")
    '11e60398'
    """
    return f"{zlib.adler32(text.encode()):08x}"


def plain(words: str) -> str:
    """Words without commas, so that a line splits at its commas."""
    return words.replace(",", ";")


def document(family: str, cases: Sequence[Case]) -> str:
    """The JSON text of a family, a line for each case."""
    lines = ",\n".join(json.dumps(_case(case)) for case in cases)
    return f'{{"format": "{FORMAT}", "family": "{family}", "cases": [\n{lines}\n]}}\n'


def _case(case: Case) -> dict[str, Any]:
    subject = case.subject
    values = {quantity: [number.text, number.digits] for quantity, number in case.values.items()}
    return {
        "case": plain(subject.name),
        "equations": list(subject.equations),
        "kernel": subject.inputs["kernel"],
        "reading": plain(subject.reading),
        "routes": list(next(iter(case.values.values())).routes),
        "units": dict(subject.units),
        "inputs": subject.inputs,
        "inputs_sha256": subject.sha256(),
        "values": values,
        "values_sha256": hashlib.sha256(canonical(values).encode()).hexdigest(),
    }
