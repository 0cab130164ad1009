"""Commands are called in this process where nothing but their text matters, and as a user would where more does."""

import csv
import io
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from rkverify.cli import main

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Done:
    """What a command left behind."""

    status: int
    out: str
    err: str

    @property
    def rows(self) -> list[dict[str, str]]:
        """Standard output as CSV."""
        return list(csv.DictReader(io.StringIO(self.out)))

    @property
    def header(self) -> str:
        return self.out.partition("\n")[0]

    def complaint(self) -> str:
        """The one line by which bad input is answered: status 2 and nothing on standard output."""
        assert (self.status, self.out) == (2, ""), self
        assert self.err.endswith("\n"), self
        assert self.err.count("\n") == 1, self
        assert self.err.startswith("rkverify"), self
        assert len(self.err) < 500, "a line is to be read"
        return self.err


@pytest.fixture
def rkverify(capsys):
    """rkverify("shape", …) -> Done, in this process."""

    def call(*words: str) -> Done:
        try:
            status = main([str(word) for word in words])
        except SystemExit as exit:
            status = exit.code or 0
        out, err = capsys.readouterr()
        return Done(status, out, err)

    return call


@pytest.fixture
def table(tmp_path):
    """table("nodes", TEXT) -> the path of a CSV file with this text."""

    def write(name: str, text: str) -> Path:
        path = tmp_path / f"{name}.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def environment(**more: str) -> dict[str, str]:
    """Ours, without what would make Python look for modules elsewhere."""
    return {**{k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}, **more}


@pytest.fixture
def python():
    """python("-c", …) -> Done, in a process of its own in the checkout or elsewhere."""

    def call(*words: str, cwd: Path = ROOT, **more: str) -> Done:
        done = subprocess.run(
            [sys.executable, *words], cwd=cwd, env=environment(**more), capture_output=True, text=True, check=False
        )
        return Done(done.returncode, done.stdout, done.stderr)

    return call


@pytest.fixture(scope="session")
def wheel(tmp_path_factory) -> Path:
    """A folder with the package and nothing else, as an installed wheel has it."""
    folder = tmp_path_factory.mktemp("installed") / "site packages"
    shutil.copytree(ROOT / "rkverify", folder / "rkverify", ignore=shutil.ignore_patterns("__pycache__"))
    return folder
