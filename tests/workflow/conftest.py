"""A small checkout in a folder whose name holds a space: a copy of the library with studies that take milliseconds."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# What root may do to folders without write permission is taken away first, so that such a folder stops anybody.
AS_ANYBODY = """
import ctypes, os, sys
if os.geteuid() == 0:
    for capability in (1, 2):  # CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH
        ctypes.CDLL(None).prctl(24, capability)  # PR_CAPBSET_DROP
os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
"""

STUDY = '''"""Made up for a test."""

import hashlib
import os
from dataclasses import dataclass

{imports}
from rkverify.workflow.compare import Certified, Exact, Numeric
from rkverify.workflow.study import Statement, Study, table


@dataclass(frozen=True)
class Parameters:
    """Rows of the table."""

    rows: int = 4


def compute(p):
    """One table."""
    rows = [{{"n": n, "value": {value}}} for n in range(p.rows)]
    columns = [("n", "1", "number of the row"), ("value", "1", "its value")]
    return {{"values": table(rows, columns, "Values.", {rule})}}


def judge(p, tables):
    """One statement about no entry."""
    frame = tables["values"].frame
    return [Statement("rows", (), f"There are {{len(frame)}} rows.", len(frame) == p.rows, "all", "exact")]


STUDY = Study("Made up", Parameters(), Parameters(rows=2), compute, judge)
'''


def made_up(imports: str = "", value: str = "n", rule: str = "Exact()") -> str:
    """The text of a study with one table: a column of row numbers and a column of values."""
    return STUDY.format(imports=imports, value=value, rule=rule)


STUDIES = {
    "gradients": made_up(
        "from rkverify.arithmetic.native import Exact as Rational\nfrom rkverify.paper.approximation import lattice\n"
        "from rkverify.paper.cells import lattice_cell\nfrom rkverify.paper.gradients import smoothed_gradient",
        'str(smoothed_gradient(lattice(1, "3/2", 2, Rational()), lattice_cell(Rational().ratio(0), 1)).get(n, 0))',
    ),
    "phases": made_up("from rkverify.paper.plane_wave import phase_sign", 'phase_sign("minus" if n % 2 else "plus")'),
    "tents": made_up(
        "from rkverify.kernels import kernel", 'float(kernel("tent").phi.moment(n))', "Numeric(1e-9, 0, 'r')"
    ),
}


def summary(done: subprocess.CompletedProcess[str]) -> tuple[int, int, int]:
    """computed (or confirmed), up to date, failed: as the last line of `run` and `verify` tells."""
    found = re.fullmatch(r"(\d+) (?:computed|confirmed), (\d+) up to date, (\d+) failed\n", done.stdout)
    assert found, (done.returncode, done.stdout, done.stderr)
    return int(found[1]), int(found[2]), int(found[3])


def environment(**more: str) -> dict[str, str]:
    """Ours, without what would make Python look for modules anywhere but in the working directory."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PYTEST", "RKVERIFY"))}
    return {**kept, "PYTHONDONTWRITEBYTECODE": "1", "OMP_NUM_THREADS": "1", **more}


@dataclass(frozen=True)
class SmallCheckout:
    """A checkout to run commands in, and to look at before and after."""

    root: Path

    @property
    def results(self) -> Path:
        return self.root / "reports" / "results"

    @property
    def manifest(self) -> Path:
        return self.root / "reports" / "manifest.json"

    @property
    def runs(self) -> Path:
        return self.root / ".rkverify" / "runs"

    def study(self, name: str, text: str) -> None:
        (self.root / "studies" / f"{name}.py").write_text(text, encoding="utf-8")

    def start(self, *words: str, **options) -> subprocess.Popen:
        """Python in the copy, running; options are those of Popen."""
        return subprocess.Popen([sys.executable, *words], cwd=self.root, **{"env": environment(), **options})

    def command(self, *words: str, **options) -> subprocess.CompletedProcess[str]:
        """`rkverify WORDS`."""
        return self.python("-m", "rkverify", *words, **options)

    def python(
        self, *words: str, anybody: bool = False, seconds: float = 120, **more: str
    ) -> subprocess.CompletedProcess[str]:
        """Python in the copy, with more environment variables; as somebody whom permissions bind, if asked."""
        command = [sys.executable, *(("-c", AS_ANYBODY) if anybody else ()), *words]
        options = {"cwd": self.root, "env": environment(**more), "timeout": seconds}
        return subprocess.run(command, capture_output=True, text=True, check=False, **options)

    def contents(self) -> dict[str, bytes]:
        """Everything under reports/: path -> bytes."""
        folder = self.root / "reports"
        return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}

    def times(self, folder: Path) -> dict[str, tuple[int, int]]:
        """path -> inode and time of the last change: what was replaced or rewritten has others."""
        return {p.relative_to(folder).as_posix(): (p.stat().st_ino, p.stat().st_mtime_ns) for p in files_in(folder)}

    def add_line(self, path: str) -> None:
        """Change a source file without changing what it does."""
        with (self.root / path).open("a", encoding="utf-8") as stream:
            stream.write("# changed by a test\n")


def files_in(folder: Path) -> list[Path]:
    """All files under a folder."""
    return sorted(p for p in folder.rglob("*") if p.is_file())


def new_checkout(root: Path, studies: dict[str, str]) -> SmallCheckout:
    """A copy of the library with these studies, nothing run."""
    shutil.copytree(ROOT / "rkverify", root / "rkverify")
    for name in ("pyproject.toml", "requirements.lock"):
        shutil.copy2(ROOT / name, root / name)
    (root / "studies").mkdir()
    small = SmallCheckout(root)
    for name, text in {"__init__": '"""Made up."""\n', **studies}.items():
        small.study(name, text)
    return small


def copy(small: SmallCheckout, root: Path) -> SmallCheckout:
    """The same checkout in another folder, with the same dates."""
    return SmallCheckout(Path(shutil.copytree(small.root, root)))


@pytest.fixture(scope="session")
def untouched(tmp_path_factory) -> SmallCheckout:
    """The small checkout before any run; not to be changed."""
    return new_checkout(tmp_path_factory.mktemp("never run") / "small checkout", STUDIES)


@pytest.fixture(scope="session")
def finished(tmp_path_factory, untouched) -> SmallCheckout:
    """The small checkout after one run; not to be changed."""
    small = copy(untouched, tmp_path_factory.mktemp("run once") / "small checkout")
    done = small.command("run", "--jobs", "1")
    assert (done.returncode, done.stderr, summary(done)) == (0, "", (3, 0, 0))
    return small


@pytest.fixture
def fresh(tmp_path, untouched) -> SmallCheckout:
    """A small checkout of the test's own, nothing run."""
    return copy(untouched, tmp_path / "small checkout")


@pytest.fixture
def small(tmp_path, finished) -> SmallCheckout:
    """A small checkout of the test's own, all studies run and up to date."""
    return copy(finished, tmp_path / "small checkout")


@pytest.fixture(scope="session")
def tools() -> "type[Tools]":
    """Functions that tests share; a folder of tests is no package, so that they come as a fixture."""
    return Tools


class Tools:
    made_up: Callable[..., str] = staticmethod(made_up)
    summary = staticmethod(summary)
    environment = staticmethod(environment)
    new_checkout = staticmethod(new_checkout)
    copy = staticmethod(copy)
    files_in = staticmethod(files_in)
    root = ROOT
    remove = staticmethod(shutil.rmtree)

    @staticmethod
    def sha256(path: Path) -> str:
        return hashlib.sha256(path.read_bytes()).hexdigest()
