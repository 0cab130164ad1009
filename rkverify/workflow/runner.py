"""Running studies: doit schedules them over processes; what counts as current is decided by identity and hashes."""

import os
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from multiprocessing import connection, parent_process
from pathlib import Path
from typing import Any

from doit.cmd_base import TaskLoader2
from doit.doit_cmd import DoitMain
from doit.exceptions import TaskFailed
from doit.task import dict_to_task
from tqdm import tqdm

from rkverify.errors import BadInput, OutOfTolerance, RkverifyError
from rkverify.paths import Checkout
from rkverify.workflow import manifest, records
from rkverify.workflow.discovery import choose, load, study_names
from rkverify.workflow.files import sweep, write_atomically
from rkverify.workflow.identity import Identity, Sources
from rkverify.workflow.produce import Artefact, produce
from rkverify.workflow.reconcile import bring_up_to_date, departures, made_by


@dataclass
class Outcome:
    """What became of each study that was asked for."""

    computed: list[str] = field(default_factory=list)
    current: list[str] = field(default_factory=list)
    failed: dict[str, str] = field(default_factory=dict)
    complaints: list[str] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """Whether everything went as it should."""
        return not self.failed and not self.complaints

    @property
    def status(self) -> int:
        """The exit status: 0, or 1 where something left its tolerance or failed."""
        return 0 if self.ok else 1


@dataclass(frozen=True)
class Job:
    """One study to run or verify: the place, its name and the identity of its results."""

    place: Checkout
    name: str
    quick: bool
    identity: Identity

    def files(self) -> dict[str, Artefact]:
        """Compute the study's artefacts."""
        study = load(self.place, self.name)
        return produce(self.name, study, study.quick if self.quick else study.parameters, self.identity)

    @property
    def folder(self) -> Path:
        """Where the study's files are."""
        return self.place.results / self.name

    def is_current(self) -> bool:
        """Whether there is nothing to do."""
        return records.is_current(self.place, self.name, self.identity.total)

    def run(self) -> None:
        """Compute and write.

        Raises OutOfTolerance where files of the same identity were there and are not confirmed: then nothing is
        written, since the same sources and parameters should have given the same result.
        """
        start = time.perf_counter()
        files = self.files()
        if made_by(self.folder) == self.identity.total:
            listed = manifest_hashes(self.place, self.name)
            wrong = [d for d in departures(self.folder, files) if listed.get(d.file) == _hash(self.folder / d.file)]
            if wrong:
                raise OutOfTolerance("\n".join(line for d in wrong for line in d.lines()))
        hashes = bring_up_to_date(self.folder, files)
        done = datetime.now(UTC).isoformat(timespec="seconds")
        seconds = round(time.perf_counter() - start, 3)
        records.save(
            self.place,
            self.name,
            records.RunRecord(self.identity.total, hashes, done, seconds, records.circumstances(self.place.root)),
        )

    def verify(self) -> None:
        """Recompute and compare, writing nothing; raises OutOfTolerance with the list of departures."""
        found = departures(self.folder, self.files())
        if found:
            raise OutOfTolerance("\n".join(line for d in found for line in d.lines()))


def _hash(path: Path) -> str:
    from rkverify.workflow.files import read
    from rkverify.workflow.identity import digest

    return digest((read(path) or "").encode())


def manifest_hashes(place: Checkout, name: str) -> dict[str, str]:
    """file -> hash for one study, as the manifest lists them; empty where it lists none."""
    import json

    from rkverify.workflow.files import read

    try:
        files: dict[str, str] = json.loads(read(place.manifest) or "")["studies"][name]["files"]
    except (ValueError, KeyError, TypeError):
        return {}
    return files


def _leave_with_parent() -> None:
    """End this worker when its parent is gone, so that a killed run leaves no process that goes on writing."""
    parent = parent_process()
    if parent is not None and not any(t.name == "leave-with-parent" for t in threading.enumerate()):

        def watch() -> None:
            connection.wait([parent.sentinel])
            os._exit(1)

        threading.Thread(target=watch, name="leave-with-parent", daemon=True).start()


def _act(action: Callable[[], None]) -> TaskFailed | None:
    """Do a job's work in a worker; our own errors become one line."""
    _leave_with_parent()
    try:
        action()
    except RkverifyError as error:
        return TaskFailed(str(error))
    return None


class _Reporter:
    """Passes what doit reports on to an `Outcome` and to a progress bar, which shows on terminals only."""

    desc = "rkverify"

    def __init__(self, outstream: Any, options: dict[str, Any]) -> None:
        self.outcome: Outcome = options["outcome"]
        self.bar: tqdm[Any] | None = None

    def initialize(self, tasks: Any, selected: list[str]) -> None:
        self.bar = tqdm(total=len(selected), unit="study", disable=None, file=sys.stderr, leave=False)

    def _step(self, name: str) -> None:
        if self.bar is not None:
            self.bar.set_description(name)
            self.bar.update()

    def add_success(self, task: Any) -> None:
        self.outcome.computed.append(task.name)
        self._step(task.name)

    def skip_uptodate(self, task: Any) -> None:
        self.outcome.current.append(task.name)
        self._step(task.name)

    def add_failure(self, task: Any, fail: Any) -> None:
        expected = isinstance(fail, TaskFailed)
        self.outcome.failed[task.name] = fail.message if expected else fail.get_msg().strip()
        self._step(task.name)

    def runtime_error(self, message: str) -> None:
        self.outcome.failed["runner"] = message

    def cleanup_error(self, exception: Any) -> None:
        self.outcome.failed["runner"] = exception.get_msg()

    def complete_run(self) -> None:
        if self.bar is not None:
            self.bar.close()

    def get_status(self, task: Any) -> None: ...

    def execute_task(self, task: Any) -> None: ...

    def skip_ignore(self, task: Any) -> None: ...

    def teardown_task(self, task: Any) -> None: ...


class _Loader(TaskLoader2):  # type: ignore[misc]
    def __init__(self, tasks: list[dict[str, Any]], database: str, outcome: Outcome) -> None:
        super().__init__()
        self.tasks = tasks
        self.database = database
        self.outcome = outcome

    def load_doit_config(self) -> dict[str, Any]:
        return {"dep_file": self.database, "reporter": _reporter_for(self.outcome), "verbosity": 0}

    def load_tasks(self, cmd: Any, pos_args: Any) -> list[Any]:
        return [dict_to_task(task) for task in self.tasks]


def _reporter_for(outcome: Outcome) -> type:
    class Bound(_Reporter):
        def __init__(self, outstream: Any, options: dict[str, Any]) -> None:
            super().__init__(outstream, {"outcome": outcome})

    return Bound


def _schedule(tasks: list[dict[str, Any]], processes: int) -> Outcome:
    outcome = Outcome()
    with tempfile.TemporaryDirectory() as folder:
        # doit's own database is thrown away: what is current is decided by identities, which survive a kill.
        loader = _Loader(tasks, str(Path(folder) / "doit.db"), outcome)
        arguments = ["run", "--continue", *(["-n", str(processes)] if processes > 1 else [])]
        code = DoitMain(loader).run(arguments)
    if code and outcome.ok:
        outcome.failed["runner"] = f"doit ended with status {code}"
    return outcome


@contextmanager
def _prepared(place: Checkout) -> Iterator[None]:
    for folder in (place.results, place.state):
        if folder.exists() and not os.access(folder, os.W_OK):
            raise BadInput(f"cannot write {place.shown(folder)}: make the folder writable")
        sweep(folder)
    yield


def _jobs(place: Checkout, names: list[str], quick: bool) -> list[Job]:
    sources = Sources(place)
    jobs = []
    for name in choose(place, names):
        study = load(place, name)
        jobs.append(Job(place, name, quick, sources.identity(name, study.quick if quick else study.parameters)))
    return jobs


def run(place: Checkout, names: list[str], quick: bool = False, processes: int = 1, force: bool = False) -> Outcome:
    """Run the named studies (all for none) that are not current, and bring the manifest up to date.

    Raises UnknownName for a study, BadInput for a folder that cannot be written.
    """
    place = place.quick() if quick else place
    jobs = _jobs(place, names, quick)
    with _prepared(place):
        write_atomically(place.state / "writable", "")
        tasks = [
            {"name": job.name, "actions": [(_act, [job.run])], "uptodate": [] if force else [job.is_current]}
            for job in jobs
        ]
        outcome = _schedule(tasks, processes)
        everything = study_names(place)
        if not outcome.failed and all((place.results / name / "study.json").is_file() for name in everything):
            manifest.write(place, everything)
            outcome.complaints += manifest.unowned(place, everything)
    return outcome


def verify(place: Checkout, names: list[str], processes: int = 1) -> Outcome:
    """Recompute the named studies (all for none) and hold them against the committed files, writing nothing."""
    jobs = _jobs(place, names, quick=False)
    outcome = _schedule([{"name": job.name, "actions": [(_act, [job.verify])]} for job in jobs], processes)
    if not names:
        try:
            outcome.complaints += manifest.unowned(place, study_names(place))
        except BadInput as error:
            outcome.complaints.append(str(error))
    return outcome
