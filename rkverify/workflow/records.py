"""What this machine has run: per study the identity, the hashes of the files and the circumstances of the run."""

import json
import os
import platform
import subprocess
import sys
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from rkverify.paths import Checkout
from rkverify.workflow.files import read, write_atomically
from rkverify.workflow.identity import canonical, digest

PACKAGES = ("numpy", "scipy", "mpmath", "sympy", "python-flint", "pandas", "matplotlib")


def processor() -> str:
    """The processor's name, as far as the system tells it."""
    text = read(Path("/proc/cpuinfo")) or ""
    names = [line.partition(":")[2].strip() for line in text.splitlines() if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def commit(root: Path) -> str:
    """The checkout's commit, with a plus sign where the tree has changes; 'unknown' without git."""

    def git(*words: str) -> str:
        done = subprocess.run(["git", *words], cwd=root, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    try:
        return git("rev-parse", "HEAD")[:12] + ("+" if git("status", "--porcelain", "-uno") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def circumstances(root: Path) -> dict[str, Any]:
    """Commit, versions, processor and command of this process."""
    return {
        "commit": commit(root),
        "python": platform.python_version(),
        "packages": {name: version(name) for name in PACKAGES},
        "processor": processor(),
        "cores": os.cpu_count(),
        "command": "rkverify " + " ".join(sys.argv[1:]),
    }


@dataclass(frozen=True)
class RunRecord:
    """That a study with this identity was run here, what it wrote, when, how long and where."""

    identity: str
    files: dict[str, str]
    finished: str
    seconds: float
    circumstances: dict[str, Any]


def record_path(place: Checkout, name: str) -> Path:
    """Where the record of a study's last run is kept."""
    return place.runs / f"{name}.json"


def save(place: Checkout, name: str, record: RunRecord) -> None:
    """Keep the record of a run."""
    write_atomically(record_path(place, name), canonical(vars(record)))


def last_run(place: Checkout, name: str) -> RunRecord | None:
    """The record of a study's last run; None where there is none, or none that can be read."""
    try:
        record = RunRecord(**json.loads(read(record_path(place, name)) or ""))
    except (ValueError, TypeError):
        return None
    kinds = ((record.identity, str), (record.files, dict), (record.finished, str), (record.circumstances, dict))
    usable = all(isinstance(value, kind) for value, kind in kinds) and isinstance(record.seconds, int | float)
    return record if usable else None


def is_current(place: Checkout, name: str, identity: str) -> bool:
    """Whether the study was run here with this identity and its files are as that run left them."""
    record = last_run(place, name)
    if record is None or record.identity != identity or not record.files:
        return False
    folder = place.results / name
    return all(
        (text := read(folder / file)) is not None and digest(text.encode()) == sha for file, sha in record.files.items()
    )
