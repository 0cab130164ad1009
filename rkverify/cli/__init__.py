"""The command line: `rkverify COMMAND`. Each command's module is imported when it is used."""

import argparse
import os
import re
import sys
from collections.abc import Sequence

from rkverify import __version__
from rkverify.cli.commands import COMMANDS
from rkverify.errors import RkverifyError


class Parser(argparse.ArgumentParser):
    """argparse, with -1e-3 and -1/2 read as numbers and not as options, and complaints in one line."""

    def __init__(self, *args: object, **options: object) -> None:
        super().__init__(*args, **options)  # type: ignore[arg-type]
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> None:  # type: ignore[override]
        """Say what is wrong in one line and leave with status 2."""
        self.exit(2, f"{self.prog}: {message}; see {self.prog} --help\n")


def build_parser() -> argparse.ArgumentParser:
    """The parser with every command, its options and an example."""
    parser = Parser(
        prog="rkverify",
        description="Verification of reproducing kernel discretisations with nodal integration.",
        epilog="rkverify COMMAND --help explains a command and gives an example.",
    )
    parser.add_argument("--version", action="version", version=f"rkverify {__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", dest="command", required=True)
    for command in COMMANDS:
        sub = commands.add_parser(
            command.name,
            help=command.purpose,
            description=command.description,
            epilog=f"example:\n{command.example}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        command.add_options(sub)
        sub.set_defaults(action=command.action)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; 0 if all is well, 1 if a result leaves its tolerance, 2 for bad input, in one line."""
    options = build_parser().parse_args(arguments)
    try:
        status: int = options.action(options)
        sys.stdout.flush()
        return status
    except RkverifyError as error:
        print(f"rkverify: {error}", file=sys.stderr)
        return 2
    except ArithmeticError as error:
        print(
            f"rkverify: the numbers leave the range of double precision ({error}): choose other units", file=sys.stderr
        )
        return 2
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        print("rkverify: interrupted; the next run goes on where this one stopped", file=sys.stderr)
        return 130
