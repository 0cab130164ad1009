"""Bringing recomputed artefacts and committed files together."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rkverify.workflow.compare import Difference
from rkverify.workflow.files import read, write_atomically
from rkverify.workflow.identity import digest
from rkverify.workflow.produce import DESCRIPTION, Artefact


@dataclass(frozen=True)
class Departure:
    """A committed artefact that a recomputation does not confirm."""

    file: str
    differences: tuple[Difference, ...]

    def lines(self, at_most: int = 5) -> list[str]:
        """One line for each place, cut short where there are many."""
        shown = [f"{self.file}: {difference}" for difference in self.differences[:at_most]]
        rest = len(self.differences) - at_most
        return shown + ([f"{self.file}: and {rest} more places"] if rest > 0 else [])


def departures(folder: Path, files: Mapping[str, Artefact]) -> list[Departure]:
    """Where the files in a folder leave the tolerance of what was recomputed; a missing file counts."""
    found = []
    for file, artefact in files.items():
        committed = read(folder / file)
        if committed is None:
            found.append(Departure(file, (Difference("file", "missing", "present", "must be there"),)))
            continue
        try:
            differences = artefact.comparison.differences(committed, artefact.text)
        except ValueError as error:
            differences = [Difference("file", "unreadable", "readable", str(error))]
        if differences:
            found.append(Departure(file, tuple(differences)))
    return found


def made_by(folder: Path) -> str | None:
    """The identity under which the files in a folder were made, as their description says."""
    try:
        total = json.loads(read(folder / DESCRIPTION) or "")["provenance"]["total"]
    except (ValueError, KeyError, TypeError):
        return None
    return str(total)


def bring_up_to_date(folder: Path, files: Mapping[str, Artefact]) -> dict[str, str]:
    """Write what changed and leave untouched what agrees: file -> hash of what now stands there.

    The description goes last, so that a folder with a matching description is complete.
    """
    wrong = {departure.file for departure in departures(folder, files)}
    hashes = {}
    for file, artefact in files.items():
        if file in wrong:
            write_atomically(folder / file, artefact.text)
        hashes[file] = digest((read(folder / file) or "").encode())
    return hashes
