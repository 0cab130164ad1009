"""A copy of the checkout in a temporary folder, in which one text of one file is wrong for as long as some tests run."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("rkverify", "studies", "tests", "controls", "readers", "reports/results/theorems")
"""Of the results the proof logs alone, which tests of their checker spoil."""
FILES = ("pyproject.toml", "requirements.lock", "Makefile", "README.md", "CONTRIBUTING.md")
PASSED, FAILED, NO_SUCH_TEST, NOTHING_RUN = 0, 1, 4, 5
"""pytest's exit codes."""


@dataclass(frozen=True)
class Run:
    """What pytest said of some tests: exit code (None where the time was not enough), seconds, its last lines."""

    code: int | None
    seconds: float
    said: str

    @property
    def noticed(self) -> bool:
        """A test failed or did not come to an end, the process died, or the module could not be imported."""
        return self.code not in (PASSED, NO_SUCH_TEST, NOTHING_RUN)

    @property
    def first(self) -> str:
        """The first test that failed."""
        lines = [line for line in self.said.splitlines() if line.startswith(("FAILED ", "ERROR "))]
        return lines[0].split(" - ")[0].split(" ", 1)[1] if lines else ""


class Sandbox:
    """A copy of the checkout below `folder`, and a process in it that runs tests; compiled files of the copy are its own."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.root, self.output = folder / "copy of the checkout", folder / "output.txt"
        ignored = shutil.ignore_patterns("*.nbi", "*.nbc", ".part-*")
        for name in FOLDERS:
            shutil.copytree(ROOT / name, self.root / name, ignore=ignored)
        for name in FILES:
            shutil.copy2(ROOT / name, self.root / name)
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "NUMBA", "RKVERIFY"))}
        self.environment = {
            **kept,
            "PYTHONPATH": str(self.root),
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
            "RKVERIFY_HYPOTHESIS": "faults",  # the same cases every time, a failing one not made smaller
            "NUMBA_DISABLE_JIT": "1",  # compiled files of other modules would outlive a patch
        }
        self.server = self._started()

    def _started(self) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, str(Path(__file__).with_name("server.py"))],
            cwd=self.root,
            env=self.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def close(self) -> None:
        """End the process."""
        assert self.server.stdin
        assert self.server.stdout
        self.server.stdin.close()
        self.server.wait()
        self.server.stdout.close()

    @contextmanager
    def patched(self, file: str, text: str) -> Iterator[None]:
        """The file with another text; then as before."""
        path = self.root / file
        before = path.read_text(encoding="utf-8")
        try:
            self._write(path, text)
            yield
        finally:
            self._write(path, before)

    @staticmethod
    def _write(path: Path, text: str) -> None:
        """Write, and forget what was compiled from it: a time stamp of one second may be that of the text before."""
        path.write_text(text, encoding="utf-8")
        for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*"):
            compiled.unlink()

    def run(self, tests: Sequence[str], seconds: int) -> Run:
        """The tests in the order given, up to the first that fails, without numba's compiler; seconds: of the processor."""
        began = perf_counter()
        task = {"tests": list(tests), "seconds": seconds, "output": str(self.output)}
        answer = self._asked(task)
        if not answer:  # somebody ended the process
            self.server.wait()
            self.server = self._started()
            answer = self._asked(task)
        code = json.loads(answer)
        said = self.output.read_text(encoding="utf-8", errors="replace")
        return Run(code, perf_counter() - began, said[-6000:])

    def _asked(self, task: dict[str, object]) -> str:
        """The answer to a task; nothing where the process is gone."""
        assert self.server.stdin
        assert self.server.stdout
        try:
            self.server.stdin.write(json.dumps(task) + "\n")
            self.server.stdin.flush()
        except BrokenPipeError:
            return ""
        return self.server.stdout.readline()

    def imports_itself(self) -> bool:
        """Whether the copy imports its own modules and not those of the checkout."""
        done = subprocess.run(
            [sys.executable, "-c", "import rkverify; print(rkverify.__file__)"],
            cwd=self.root,
            env=self.environment,
            capture_output=True,
            text=True,
            check=True,
        )
        return Path(done.stdout.strip()).is_relative_to(self.root)
