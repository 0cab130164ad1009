"""Running and verifying studies."""

import os

from rkverify.errors import BadInput
from rkverify.paths import Checkout
from rkverify.workflow import manifest
from rkverify.workflow.discovery import choose, load, study_names
from rkverify.workflow.files import sweep, write_atomically
from rkverify.workflow.identity import Sources
from rkverify.workflow.jobs import Job
from rkverify.workflow.produce import DESCRIPTION
from rkverify.workflow.schedule import Outcome, Task, schedule


def jobs(place: Checkout, names: list[str], quick: bool = False) -> list[Job]:
    """The jobs for the named studies, all for none; raises UnknownName."""
    studies = {name: load(place, name) for name in choose(place, names)}
    sources = Sources(place)
    found = []
    for name, study in studies.items():
        found.append(Job(place, name, quick, sources.identity(name, study.quick if quick else study.parameters)))
    return found


def _make_ready(place: Checkout) -> None:
    """Find out before computing whether results can be written; remove what a killed run left half-written."""
    for folder in (place.results, place.state, place.runs):
        write_atomically(folder / ".part-test", "")
        if not os.access(folder, os.W_OK):
            raise BadInput(f"cannot write {place.shown(folder)}: make the folder writable")
        sweep(folder)


def run(place: Checkout, names: list[str], quick: bool = False, processes: int = 1, force: bool = False) -> Outcome:
    """Run the named studies (all for none) that are not current, and bring the manifest up to date.

    Raises UnknownName for a study, BadInput for a folder that cannot be written.
    """
    place = place.quick() if quick else place
    asked = jobs(place, names, quick)
    _make_ready(place)
    tasks = [Task(job.name, job.run, (lambda: False) if force else job.is_current) for job in asked]
    outcome = schedule(tasks, processes)
    everything = study_names(place)
    if not outcome.failed and all((place.results / name / DESCRIPTION).is_file() for name in everything):
        manifest.write(place, everything)
        outcome.complaints += manifest.unowned(place, everything)
    return outcome


def verify(place: Checkout, names: list[str], processes: int = 1) -> Outcome:
    """Recompute the named studies (all for none) and hold them against the committed files, writing nothing."""
    outcome = schedule([Task(job.name, job.verify) for job in jobs(place, names)], processes)
    if not names:
        try:
            outcome.complaints += manifest.unowned(place, study_names(place))
            outcome.complaints += manifest.stale(place, {job.name: job.identity.total for job in jobs(place, [])})
        except BadInput as error:
            outcome.complaints.append(str(error))
    return outcome
