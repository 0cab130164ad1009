"""Copies of the whole checkout in which one line of a transcription is wrong."""

import fcntl
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


class Copy:
    """A copy of the checkout."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def patch(self, file: str, old: str, new: str) -> None:
        """Put `new` for `old`, which must occur exactly once."""
        path = self.root / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{file} has {text.count(old)} times {old!r}: bring the control up to date"
        path.write_text(text.replace(old, new), encoding="utf-8")

    def call(self, *words: str) -> str:
        """The standard output of `rkverify WORDS`, which must succeed."""
        kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        done = subprocess.run(
            [sys.executable, "-m", "rkverify", *words],
            cwd=self.root,
            env={**kept, "OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            check=False,
        )
        assert (done.returncode, done.stderr) == (0, ""), (words, done.stdout, done.stderr)
        return done.stdout

    def states(self, studies: Iterable[str]) -> dict[str, str]:
        """Run these studies in their quick form: entry -> state with its detail, for what has evidence."""
        self.call("run", "--quick", "--force", *studies)
        entries = json.loads(self.call("ledger", "--quick", "--json"))["entries"]
        return {e["id"]: f"{e['state']} | {e['detail']}" for e in entries if e["evidence"]}


def as_it_is(root: Path, studies: Iterable[str]) -> None:
    """Write a copy of the checkout in which these studies are run, and their states beside it."""
    for folder in ("rkverify", "studies"):
        shutil.copytree(ROOT / folder, root / folder)
    for file in ("pyproject.toml", "requirements.lock"):
        shutil.copy2(ROOT / file, root / file)
    made = Copy(root)
    made.patch(
        "rkverify/workflow/produce.py", "study.draw(parameters, tables)", "{}"
    )  # figures take time and decide nothing
    states = made.states(studies)
    root.with_suffix(".json").write_text(json.dumps(states), encoding="utf-8")


@pytest.fixture(scope="session")
def unpatched(tmp_path_factory):
    """unpatched(studies) -> a copy as it is with these studies run, and its states; made once for all workers."""
    base = tmp_path_factory.getbasetemp()
    base = base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base
    root = base / "unpatched"

    def made(studies: Iterable[str]) -> tuple[Path, dict[str, str]]:
        with (base / "unpatched.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not root.with_suffix(".json").is_file():
                shutil.rmtree(root, ignore_errors=True)
                as_it_is(root, studies)
        return root, json.loads(root.with_suffix(".json").read_text(encoding="utf-8"))

    return made


@pytest.fixture
def copy(tmp_path):
    """copy(root) -> a copy of the test's own, with what was run in it."""
    return lambda root: Copy(Path(shutil.copytree(root, tmp_path / "checkout")))
