"""What a user reads first: help with an example that works, and an answer before heavy libraries are loaded."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from rkverify import __version__
from rkverify.cli import build_parser
from rkverify.cli.commands import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
HEAVY = [
    "numpy",
    "scipy",
    "pandas",
    "sympy",
    "mpmath",
    "flint",
    "matplotlib",
    "doit",
    "grimp",
    "tqdm",
    "jinja2",
    "latex2mathml",
    "rkverify.paper",
]


def test_the_program_lists_its_commands(python):
    done = python("-m", "rkverify", "--help")
    assert (done.status, done.err) == (0, "")
    for command in COMMANDS:
        assert re.search(rf"^ +{command.name}\s+{re.escape(command.purpose)}$", done.out, re.MULTILINE)


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_a_commands_help_ends_with_an_example_that_parses(command, rkverify):
    """An example that is refused is worse than none."""
    done = rkverify(command.name, "--help")
    assert (done.status, done.err) == (0, "")
    help, _, example = done.out.partition("example:\n")
    assert command.purpose
    assert "--" in help
    words = shlex.split(example.replace("\\\n", " "))
    assert words[:2] == ["rkverify", command.name]
    assert build_parser().parse_args(words[1:]).command == command.name


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_every_option_is_explained(command, rkverify):
    """argparse prints an option without help as its name alone."""
    text = rkverify(command.name, "--help").out.partition("options:")[2]
    names = re.findall(r"^  (-\S+|[A-Z]+)", text, re.MULTILINE)
    assert names
    for name in names:
        assert re.search(rf"^  {re.escape(name)}.*?\s{{2,}}\S", text, re.MULTILINE | re.DOTALL), name


def test_the_version_is_told(rkverify):
    assert rkverify("--version").out == f"rkverify {__version__}\n"


@pytest.mark.parametrize("words", [[], ["no-such-command"], ["shape"], ["ledger", "C1", "C2"], ["list", "figure5"]])
def test_a_line_that_cannot_be_parsed_is_one_line(words, rkverify):
    assert "--help" in rkverify(*words).complaint()


@pytest.mark.parametrize(
    "line",
    [
        "import rkverify",
        "import rkverify.cli; rkverify.cli.build_parser()",
        "import rkverify.cli, contextlib, io\nwith contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit): rkverify.cli.main(['run', '--help'])",
    ],
)
def test_nothing_heavy_is_imported_before_it_is_used(line, python):
    """Whoever imports the package for one function, or asks for help, does not wait for all that others need."""
    done = python("-c", f"{line}\nimport sys; print(*sys.modules)")
    assert [name for name in HEAVY if name in done.out.split()] == []


def test_a_closed_pipe_is_no_error():
    """`rkverify ledger | head` ends when head has seen enough."""
    run = subprocess.Popen(
        [sys.executable, "-m", "rkverify", "ledger"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    run.stdout.close()
    assert (run.stderr.read(), run.wait(timeout=60)) == ("", 0)
    run.stderr.close()
