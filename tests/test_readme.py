"""The README says what the code does: its states are the computed ones, its examples give what it shows.

A README is read before anything is run; nothing else keeps it from growing stale.
"""

import math
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from rkverify.ledger.states import states
from rkverify.paths import checkout
from rkverify.report.readme import summary
from rkverify.workflow.discovery import study_names

ROOT = checkout().root
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_states_are_the_computed_ones() -> None:
    assert summary(states(checkout().results)) in TEXT


@pytest.mark.parametrize("name", study_names(checkout()))
def test_every_study_is_in_the_table(name: str) -> None:
    assert f"`rkverify run {name}`" in TEXT
    assert f"`{name}/`" in TEXT


def test_every_make_target_it_names_exists() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in set(re.findall(r"`make ([a-z]+)`", TEXT)):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target


NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w)")


def _same(printed: str, shown: str) -> None:
    """Word for word, and numbers to 1e-9: the last digits of double precision are another machine's others.

    What is below 1e-14 may be anything below it: such numbers are sums that cancel to rounding.
    """
    printed, shown = (" ".join(text.split()) for text in (printed, shown))
    assert NUMBER.sub("#", printed) == NUMBER.sub("#", shown)
    for one, other in zip(NUMBER.findall(printed), NUMBER.findall(shown), strict=True):
        assert math.isclose(float(one), float(other), rel_tol=1e-9, abs_tol=1e-14), (one, other)


def test_the_examples_print_what_is_shown(tmp_path: Path) -> None:
    blocks = re.findall(r"^    .*\n(?:^    .*\n|^\n(?=    ))*", TEXT, re.MULTILINE)
    shown = [block for block in blocks if block.startswith("    $ ")]
    assert len(shown) == 6
    for block in shown:
        lines = [line[4:] for line in block.replace("\\\n", " ").splitlines()]
        commands = [line[2:] for line in lines if line.startswith("$ ")]
        expected = "\n".join(line for line in lines if not line.startswith("$ "))
        python = f"{shlex.quote(sys.executable)} -m rkverify"
        script = "\n".join(re.sub(r"^rkverify ", f"{python} ", command) for command in commands)
        done = subprocess.run(["bash", "-ec", script], cwd=tmp_path, capture_output=True, text=True, check=True)
        _same(done.stdout, expected)


def test_the_python_example_runs() -> None:
    block = TEXT[TEXT.index("    from rkverify.arithmetic.native") :].split("\n\n## ")[0]
    names: dict[str, object] = {}
    exec("\n".join(line[4:] for line in block.splitlines()), names)  # the README's own lines
    assert "A" in names
