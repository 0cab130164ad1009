"""The options of `rkverify new-study` and `rkverify export`. Nothing is imported here that a help text does not need."""

from argparse import ArgumentParser


def new_study(parser: ArgumentParser) -> None:
    """Add the options of `rkverify new-study`."""
    parser.add_argument("name", metavar="NAME", help="small letters, digits and underscores")
    parser.add_argument(
        "--about", nargs="+", default=[], metavar="ID", help="entries of the ledger that it will decide, as E1 or C43"
    )
