"""rkverify reference"""

from argparse import Namespace

from rkverify.certify.reference.catalogue import FAMILIES, family
from rkverify.certify.reference.writing import COLUMNS, document, rows
from rkverify.cli.tables import write_table, write_text


def reference(options: Namespace) -> int:
    """Compute and print the reference values of a family, or the families with their counts."""
    if options.family is None:
        counted = [
            [name, len(make()), sum(len(case.values) for case in family(name))] for name, make in FAMILIES.items()
        ]
        write_table(["family", "cases", "values"], counted, options.json, options.out)
        return 0
    cases = family(options.family)
    if options.json:
        write_text(document(options.family, cases), options.out)
    else:
        write_table(COLUMNS, [list(row.values()) for row in rows(cases)], False, options.out)
    return 0
