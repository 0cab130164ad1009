"""A process that has imported other people's packages once and forks for every run of tests, so that a run begins at once.

Started by `sandbox.py` in the copy of the checkout, of whose modules it imports none. Reads a line of JSON for every run,
{"tests": […], "seconds": s, "output": file}, and answers with a line: pytest's exit code, or null where it took more seconds
of the processor's time, which does not depend on what else runs.
"""

import contextlib
import importlib
import json
import os
import resource
import signal
import sys
import time
from pathlib import Path

PACKAGES = (
    "numpy", "scipy.sparse.linalg", "scipy.integrate", "scipy.interpolate", "scipy.spatial", "scipy.special",
    "scipy.sparse.csgraph", "numba.extending", "sympy", "mpmath", "flint", "shapely", "meshio", "pytest", "_pytest.doctest",
)  # fmt: skip


WAIT = 20
"""A run that sleeps is ended after as many times its seconds."""


def run(tests: list[str], seconds: int, output: str) -> None:
    """Run tests in this process, which ends with pytest's exit code; what pytest says goes to a file."""
    import pytest

    os.setpgid(0, 0)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    handle = os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    os.dup2(handle, 1)
    os.dup2(handle, 2)
    code = pytest.main(["-x", "-q", "-p", "no:xdist", "--tb=line", *tests])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(int(code))


def waited(child: int, seconds: int) -> int | None:
    """The exit code of a child process; None, and its end, where it takes longer."""
    until = time.monotonic() + WAIT * seconds
    while time.monotonic() < until:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            code = os.waitstatus_to_exitcode(status)
            return None if code in (-signal.SIGXCPU, -signal.SIGKILL) else code
        time.sleep(0.02)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None


def main() -> None:
    """Serve until the input ends."""
    for name in PACKAGES:
        importlib.import_module(name)
    sys.path.insert(0, str(Path.cwd()))
    for line in sys.stdin:
        task = json.loads(line)
        child = os.fork()
        if child == 0:
            run(task["tests"], task["seconds"], task["output"])
        print(json.dumps(waited(child, task["seconds"])), flush=True)


if __name__ == "__main__":
    main()
