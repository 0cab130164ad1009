"""One study to run or verify."""

import time
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from rkverify.errors import OutOfTolerance
from rkverify.paths import Checkout
from rkverify.workflow import records
from rkverify.workflow.discovery import load
from rkverify.workflow.identity import Identity
from rkverify.workflow.manifest import is_as_listed
from rkverify.workflow.produce import Artefact, produce
from rkverify.workflow.reconcile import Departure, bring_up_to_date, departures, made_by


def _listing(found: list[Departure]) -> str:
    return "\n".join(line for departure in found for line in departure.lines())


@dataclass(frozen=True)
class Job:
    """A study in a place, with full or quick parameters, and the identity that its results will have."""

    place: Checkout
    name: str
    quick: bool
    identity: Identity

    @property
    def folder(self) -> Path:
        """Where the study's files are."""
        return self.place.results / self.name

    def files(self) -> dict[str, Artefact]:
        """Compute the study's artefacts."""
        study = load(self.place, self.name)
        return produce(self.name, study, study.quick if self.quick else study.parameters, self.identity)

    def is_current(self) -> bool:
        """Whether there is nothing to do."""
        return records.is_current(self.place, self.name, self.identity.total)

    def run(self) -> None:
        """Compute, and write what changed.

        Raises OutOfTolerance, and writes nothing, where the files that are there were made by the same sources,
        parameters and environment, stand as the manifest lists them, and are not confirmed.
        """
        start = time.perf_counter()
        files = self.files()
        if made_by(self.folder) == self.identity.total:
            found = [d for d in departures(self.folder, files) if is_as_listed(self.place, self.name, d.file)]
            if found:
                raise OutOfTolerance(_listing(found))
        hashes = bring_up_to_date(self.folder, files)
        done = datetime.now(UTC).isoformat(timespec="seconds")
        seconds = round(time.perf_counter() - start, 3)
        where = records.circumstances(self.place.root)
        records.save(self.place, self.name, records.RunRecord(self.identity.total, hashes, done, seconds, where))

    def verify(self) -> None:
        """Recompute and compare, writing nothing; raises OutOfTolerance with the list of departures."""
        found = departures(self.folder, self.files())
        if found:
            raise OutOfTolerance(_listing(found))
