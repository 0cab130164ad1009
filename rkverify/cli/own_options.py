"""The options of `rkverify new-study` and `rkverify export`. Nothing is imported here that a help text does not need."""

from argparse import ArgumentParser


def new_study(parser: ArgumentParser) -> None:
    """Add the options of `rkverify new-study`."""
    parser.add_argument("name", metavar="NAME", help="small letters, digits and underscores")
    parser.add_argument(
        "--about", nargs="+", default=[], metavar="ID", help="entries of the ledger that it will decide, as E1 or C43"
    )
    parser.add_argument(
        "--page",
        default="discretisation",
        metavar="PAGE",
        help="page of the report that shows it: certificates, discretisation, mechanics or stability (default discretisation)",
    )


def export(parser: ArgumentParser) -> None:
    """Add the options of `rkverify export`."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="studies; all if none is named")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--latex", action="store_true", help="tables and macros for a paper, with an example")
    what.add_argument("--ro-crate", action="store_true", help="metadata of the report as a Process Run Crate")
    parser.add_argument("--out", metavar="DIR", help="the folder to write to (with --ro-crate default reports)")
    parser.add_argument("--rows", type=int, default=40, metavar="N", help="leave out longer tables (default 40)")
