"""Copies of the whole checkout in which one line of a transcription is wrong."""

import fcntl
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


class Copy:
    """A copy of the checkout, without results."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for folder in ("rkverify", "studies"):
            shutil.copytree(ROOT / folder, root / folder)
        for file in ("pyproject.toml", "requirements.lock"):
            shutil.copy2(ROOT / file, root / file)

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

    def states(self, study: str) -> dict[str, str]:
        """Run a study in its quick form: entry -> state and detail, for what it says something about."""
        self.call("run", "--quick", "--jobs", "1", study)
        entries = json.loads(self.call("ledger", "--quick", "--json"))["entries"]
        return {e["id"]: f"{e['state']} | {e['detail']}" for e in entries if e["evidence"]}


@pytest.fixture
def copy(tmp_path) -> Copy:
    """A copy of the test's own."""
    return Copy(tmp_path / "checkout")


@pytest.fixture(scope="session")
def unpatched(tmp_path_factory):
    """unpatched(study) -> the states that the study gives as it is, computed once for all workers."""
    base = tmp_path_factory.getbasetemp()
    base = base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base

    def states(study: str) -> dict[str, str]:
        folder = base / f"unpatched {study}"
        with (base / f"{study}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not (folder / "states.json").is_file():
                found = Copy(folder).states(study)
                (folder / "states.json").write_text(json.dumps(found), encoding="utf-8")
        found = json.loads((folder / "states.json").read_text(encoding="utf-8"))
        return found

    return states
