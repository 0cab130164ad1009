"""Tasks over processes, by doit; a progress bar on a terminal, nothing in a pipe.

doit's own database is thrown away after a run: what is current is decided by identities and hashes, which a
killed run leaves intact.
"""

import ctypes
import os
import signal
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing import Pipe, Process, connection, parent_process
from pathlib import Path
from typing import Any

from doit.cmd_base import TaskLoader2
from doit.doit_cmd import DoitMain
from doit.exceptions import TaskFailed
from doit.reporter import ConsoleReporter
from doit.task import dict_to_task
from tqdm import tqdm

from rkverify.errors import RkverifyError


@dataclass
class Outcome:
    """What became of each task, by name; complaints are about the whole."""

    computed: list[str] = field(default_factory=list)
    current: list[str] = field(default_factory=list)
    failed: dict[str, str] = field(default_factory=dict)
    complaints: list[str] = field(default_factory=list)

    @property
    def status(self) -> int:
        """The exit status: 0, or 1 where something left its tolerance or failed."""
        return 1 if self.failed or self.complaints else 0


@dataclass(frozen=True)
class Task:
    """A name, what to do, and whether it is done already."""

    name: str
    action: Callable[[], None]
    is_current: Callable[[], bool] = lambda: False


def schedule(tasks: list[Task], processes: int) -> Outcome:
    """Do what is not current; a task that fails does not keep the others from running."""
    outcome = Outcome()
    if processes > 1 and hasattr(os, "register_at_fork"):
        os.register_at_fork(before=_remember_parent, after_in_child=_end_with_parent)
    with tempfile.TemporaryDirectory() as folder:
        loader = _Loader(tasks, str(Path(folder) / "doit.db"), outcome)
        parallel = ["-n", str(processes)] if processes > 1 else []
        code = DoitMain(loader).run(["run", "--continue", *parallel])
    if code and not outcome.failed:
        outcome.failed["runner"] = f"doit ended with status {code}"
    return outcome


class _Loader(TaskLoader2):  # type: ignore[misc]
    def __init__(self, tasks: list[Task], database: str, outcome: Outcome) -> None:
        super().__init__()
        self.tasks, self.database, self.outcome = tasks, database, outcome

    def load_doit_config(self) -> dict[str, Any]:
        reporter = type("Reporter", (_Reporter,), {"outcome": self.outcome})
        return {"dep_file": self.database, "reporter": reporter, "verbosity": 0}

    def load_tasks(self, cmd: Any, pos_args: Any) -> list[Any]:
        return [
            dict_to_task({"name": task.name, "actions": [(_act, [task.action])], "uptodate": [task.is_current]})
            for task in self.tasks
        ]


def _act(action: Callable[[], None]) -> TaskFailed | None:
    """Do a task's work in a process of its own, so that a task that ends its process ends nothing else.

    Our own errors become one line each, others keep their traceback.
    """
    _leave_with_parent()
    receiver, sender = Pipe(duplex=False)
    child = Process(target=_in_child, args=(action, sender))
    child.start()
    sender.close()
    try:
        message: str = receiver.recv()
    except EOFError:
        message = "its process ended before it was done"
    child.join()
    return TaskFailed(message) if message else None


def _in_child(action: Callable[[], None], sender: connection.Connection) -> None:
    _leave_with_parent()
    try:
        action()
    except RkverifyError as error:
        sender.send(str(error))
    except Exception:
        sender.send(traceback.format_exc())
    else:
        sender.send("")


_forking = os.getpid()  # the process that forks, as its child must find it


def _remember_parent() -> None:
    global _forking
    _forking = os.getpid()


def _end_with_parent() -> None:
    """Have Linux end this process with its parent, from its very start on."""
    if sys.platform == "linux":
        set_death_signal = 1  # PR_SET_PDEATHSIG of prctl(2)
        ctypes.CDLL(None).prctl(set_death_signal, signal.SIGKILL)
        if os.getppid() != _forking:  # the parent ended before the signal was asked for, and none will come
            os._exit(1)


def _leave_with_parent() -> None:
    """End this worker when its parent is gone, so that a killed run leaves no process that goes on writing."""
    parent = parent_process()
    name = "leave-with-parent"
    if parent is None or any(thread.name == name for thread in threading.enumerate()):
        return

    def watch() -> None:
        connection.wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, name=name, daemon=True).start()


class _Reporter(ConsoleReporter):  # type: ignore[misc]
    """Passes on to an `Outcome` and to a progress bar what doit reports."""

    desc = "rkverify"
    outcome: Outcome
    bar: Any = None

    def initialize(self, tasks: Any, selected_tasks: list[str]) -> None:
        self.bar = tqdm(total=len(selected_tasks), unit="study", disable=None, file=sys.stderr, leave=False)

    def _step(self, name: str) -> None:
        if self.bar is not None:
            self.bar.set_description(name)
            self.bar.update()

    def execute_task(self, task: Any) -> None:
        if self.bar is not None:
            self.bar.set_description(task.name)

    def add_success(self, task: Any) -> None:
        self.outcome.computed.append(task.name)
        self._step(task.name)

    def skip_uptodate(self, task: Any) -> None:
        self.outcome.current.append(task.name)
        self._step(task.name)

    def add_failure(self, task: Any, fail: Any) -> None:
        self.outcome.failed[task.name] = fail.message if type(fail) is TaskFailed else fail.get_msg().strip()
        self._step(task.name)

    def runtime_error(self, msg: str) -> None:
        self.outcome.failed["runner"] = msg

    def complete_run(self) -> None:
        if self.bar is not None:
            self.bar.close()
