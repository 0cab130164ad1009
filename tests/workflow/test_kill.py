"""A run that is killed or interrupted at any moment leaves whole files, no processes, and a next run that finishes.

Power fails, schedulers kill, people press Ctrl-C: if a part of a result could stay behind and pass for a result,
every file under reports/ would be in doubt.
"""

import os
import signal
import subprocess
import time

import pytest

SLOW = '''"""Slow enough to be killed, with many files, each large enough to be caught half-written."""

import time
from dataclasses import dataclass

from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Study, table


@dataclass(frozen=True)
class Parameters:
    """Seconds to sleep and tables to write."""

    seconds: float = {seconds}
    tables: int = 25


def compute(p):
    """Large tables of one column."""
    time.sleep(p.seconds)
    return {{
        f"table_{{n:02}}": table([{{"x": n + j}} for j in range(5000)], [("x", "1", "a number")], "Numbers.", Exact())
        for n in range(p.tables)
    }}


STUDY = Study("Slow", Parameters(), Parameters(), compute, lambda p, tables: [])
'''
STUDIES = {"first": SLOW.format(seconds=0.05), "second": SLOW.format(seconds=0.4), "third": SLOW.format(seconds=0.3)}

MOMENTS = {
    "workers start": lambda running: len(workers(running)) >= 1,
    "files appear": lambda running: running.results.exists() and len(list(running.results.rglob("table_*"))) >= 10,
    "a study is done": lambda running: running.runs.exists() and any(running.runs.glob("*.json")),
}


@pytest.fixture(scope="module")
def slow(tmp_path_factory, tools):
    """A checkout with slow studies, nothing run; not to be changed."""
    return tools.new_checkout(tmp_path_factory.mktemp("slow") / "small checkout", STUDIES)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory, tools, slow):
    """What a run that nobody disturbs writes under reports/."""
    other = tools.copy(slow, tmp_path_factory.mktemp("undisturbed") / "small checkout")
    assert tools.summary(other.command("run", "--jobs", "2")) == (3, 0, 0)
    return other.contents()


def group(leader):
    """The living processes of a process group, its leader not counted."""
    listing = subprocess.run(["ps", "-A", "-o", "pid=,pgid=,stat="], capture_output=True, text=True, check=True).stdout
    rows = [line.split() for line in listing.splitlines()]
    return [int(pid) for pid, pgid, state in rows if int(pgid) == leader and int(pid) != leader and state[0] != "Z"]


def workers(running):
    return group(running.run.pid)


class Running:
    """A checkout in which a run is going on, in a process group of its own."""

    def __init__(self, small, program=("-m", "rkverify")):
        self.results, self.runs = small.results, small.runs
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        self.run = small.start(*program, "run", "--jobs", "2", start_new_session=True, **pipes)

    def wait_for(self, moment):
        end = time.monotonic() + 60
        while not MOMENTS[moment](self):
            assert self.run.poll() is None, self.run.communicate()
            assert time.monotonic() < end
            time.sleep(0.002)

    def nobody_left(self):
        """The processes that are still there two seconds after the leader's end."""
        self.run.wait(timeout=20)
        end = time.monotonic() + 2
        while (left := group(self.run.pid)) and time.monotonic() < end:
            time.sleep(0.05)
        return left


def end(running, how):
    {
        "kill all": lambda pid: os.killpg(pid, signal.SIGKILL),
        "kill main": lambda pid: os.kill(pid, signal.SIGKILL),
        "terminate main": lambda pid: os.kill(pid, signal.SIGTERM),
        "interrupt all": lambda pid: os.killpg(pid, signal.SIGINT),
    }[how](running.run.pid)


def stop(running):
    """End whatever is left of a run, whose own processes these are; what it wrote to standard error."""
    for pid in group(running.run.pid):
        os.kill(pid, signal.SIGKILL)
    return running.run.communicate(timeout=20)[1]


@pytest.mark.parametrize(
    ("how", "moment"),
    [
        *(("kill all", moment) for moment in MOMENTS),
        *(("kill main", moment) for moment in MOMENTS),
        ("terminate main", "files appear"),
        ("interrupt all", "files appear"),
    ],
)
def test_after_the_end_all_is_whole_and_the_next_run_finishes(how, moment, slow, undisturbed, tmp_path, tools):
    small = tools.copy(slow, tmp_path / "small checkout")
    running = Running(small)
    running.wait_for(moment)
    end(running, how)
    try:
        assert running.nobody_left() == []
    finally:
        complaints = stop(running)
    found = {name: content for name, content in small.contents().items() if "/.part-" not in name}
    assert [name for name, content in found.items() if undisturbed.get(name) != content] == []
    if how == "interrupt all" and running.run.returncode != 0:  # 0: on a busy machine it came after the last file
        assert running.run.returncode == 130
        assert complaints == "rkverify: interrupted; the next run goes on where this one stopped\n"
    done = small.command("run", "--jobs", "2")
    assert (done.returncode, done.stderr) == (0, "")
    assert small.contents() == undisturbed
    assert not list(small.root.rglob(".part-*"))


# The run with tasks that reach the workers only after some seconds: between start and first task, for a long while.
LATE = """
import multiprocessing.queues as queues, runpy, sys, time

feed = queues.Queue._feed
queues.Queue._feed = staticmethod(lambda *words: (time.sleep(9), feed(*words)))
sys.argv[0] = "rkverify"
runpy.run_module("rkverify", run_name="__main__")
"""


# The same with workers that do nothing in their first moments, in which their parent can end unseen.
SLEEPY = "import os, time\nos.register_at_fork(after_in_child=lambda: time.sleep(1))\n" + LATE


@pytest.mark.parametrize("program", [LATE, SLEEPY], ids=["waits for its first task", "has just been forked"])
def test_a_worker_leaves_too_when_it(program, slow, tmp_path, tools):
    running = Running(tools.copy(slow, tmp_path / "small checkout"), ("-c", program))
    running.wait_for("workers start")
    end(running, "kill main")
    try:
        assert running.nobody_left() == []
    finally:
        stop(running)


def test_a_killed_run_is_gone_on_with(slow, tmp_path, tools):
    """What was finished before the end is not computed again."""
    small = tools.copy(slow, tmp_path / "small checkout")
    running = Running(small)
    running.wait_for("a study is done")
    end(running, "kill all")
    stop(running)
    finished = len(list(small.runs.glob("*.json")))
    done = small.command("run", "--jobs", "2")
    assert tools.summary(done) == (3 - finished, finished, 0)
