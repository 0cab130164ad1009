"""The pages Reproduce and Certificates: environment, times, manifest, tolerances with their reasons, controls."""

import os
import re
from dataclasses import dataclass
from typing import Any

from rkverify.paths import Checkout
from rkverify.report.content import Site
from rkverify.report.links import Link, relative, slug, test_link
from rkverify.workflow import manifest, records
from rkverify.workflow.files import read

CONTROL = re.compile(r"^def (test_\w+)", re.MULTILINE)
TARGET = re.compile(r"^([a-z]+):[^#\n]*## (.*)$", re.MULTILINE)


@dataclass(frozen=True)
class StudyRow:
    """A study: its command, where it is shown, its seconds here, how many files, whether they are as the manifest lists."""

    name: str
    title: str
    seconds: str
    files: int
    as_listed: str
    identity: str


def study_rows(place: Checkout, site: Site) -> list[StudyRow]:
    """A row for every study that has results."""
    listed = manifest.committed(place)
    rows = []
    for name, study in site.studies.items():
        files = listed.get(name, {}).get("files", {})
        off = [file for file in files if not manifest.is_as_listed(place, name, file)]
        state = f"no: {', '.join(off)}" if off else ("yes" if files else "not listed")
        seconds = "" if study.seconds is None else f"{study.seconds:.1f}"
        rows.append(
            StudyRow(name, study.title, seconds, len(files), state, listed.get(name, {}).get("identity", "")[:12])
        )
    return rows


def tolerances(site: Site) -> list[dict[str, Any]]:
    """Every table with the rule by which a rerun is compared, and the reason of its tolerance."""
    return [table for study in site.studies.values() for table in study.tables]


def environment(place: Checkout) -> list[tuple[str, str]]:
    """The environment of the build: versions, processor, commit; and where the lock is."""
    now = records.circumstances(place.root)
    packages = ", ".join(f"{name} {number}" for name, number in now["packages"].items())
    return [
        ("commit", now["commit"]),
        ("Python", now["python"]),
        ("packages", packages),
        ("processor", f"{now['processor']}, {now['cores']} cores"),
    ]


def targets(place: Checkout) -> list[tuple[str, str]]:
    """The targets of the Makefile with what they do and how long they take."""
    return TARGET.findall(read(place.root / "Makefile") or "")


def controls(place: Checkout) -> list[tuple[str, Link]]:
    """The tests that spoil something and ask that it is noticed: what each says in words, and where it stands."""
    found = []
    for path in sorted((place.root / "tests" / "controls").glob("test_*.py")):
        file = path.relative_to(place.root).as_posix()
        for name in CONTROL.findall(path.read_text(encoding="utf-8")):
            found.append((name.removeprefix("test_").replace("_", " "), test_link(place, f"{file}::{name}")))
    return found


def sources(place: Checkout) -> dict[str, str]:
    """Links to files of the checkout that the pages name."""
    names = ("requirements.lock", "Makefile", "README.md", "CITATION.cff", "LICENSE", "CONTRIBUTING.md", "CHANGELOG.md")
    found = {slug(name): relative(place, name) for name in names}
    listed = {"manifest": os.path.relpath(place.manifest, place.pages).replace(os.sep, "/")}
    return {**found, **(listed if place.manifest.is_file() else {})}
