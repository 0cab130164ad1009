"""The manifest: every artefact under reports/results with its hash, and the identity it was made under."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rkverify.errors import BadInput
from rkverify.paths import Checkout
from rkverify.workflow.files import read, write_atomically
from rkverify.workflow.identity import canonical, digest
from rkverify.workflow.produce import DESCRIPTION


def description(place: Checkout, name: str) -> dict[str, Any]:
    """A study's committed description.

    Raises BadInput where the study has not been run or its description cannot be read.
    """
    try:
        data: dict[str, Any] = json.loads(read(place.results / name / DESCRIPTION) or "")
        if not (isinstance(data["comparison"], dict) and isinstance(data["provenance"]["total"], str)):
            raise TypeError
    except (ValueError, TypeError, KeyError):
        where = place.shown(place.results / name / DESCRIPTION)
        raise BadInput(f"{where} is missing or unreadable: run `make reproduce`") from None
    return data


def build(place: Checkout, names: list[str]) -> dict[str, Any]:
    """The manifest of these studies as data."""
    studies = {}
    for name in names:
        data = description(place, name)
        folder = place.results / name
        files = {file: digest((read(folder / file) or "").encode()) for file in [*data["comparison"], DESCRIPTION]}
        studies[name] = {"identity": data["provenance"]["total"], "files": files}
    return {"studies": studies}


def write(place: Checkout, names: list[str]) -> None:
    """Write the manifest where it changed."""
    text = canonical(build(place, names))
    if read(place.manifest) != text:
        write_atomically(place.manifest, text)


def committed(place: Checkout) -> dict[str, Any]:
    """study -> identity and files, as the manifest lists them; empty where there is no readable one."""
    try:
        studies = json.loads(read(place.manifest) or "")["studies"]
        return {name: data for name, data in studies.items() if isinstance(data["files"], dict)}
    except (ValueError, KeyError, TypeError, AttributeError):
        return {}


def is_as_listed(place: Checkout, name: str, file: str) -> bool:
    """Whether a study's file stands as the manifest lists it."""
    text = read(place.results / name / file)
    listed = committed(place).get(name, {}).get("files", {}).get(file)
    return text is not None and digest(text.encode()) == listed


def stale(place: Checkout, identities: Mapping[str, str]) -> list[str]:
    """Complaints: studies whose sources, parameters or environment are not those of the committed results."""
    listed = {name: data.get("identity") for name, data in committed(place).items()}
    return [
        f"the committed results of {name} were made by other sources: run `make reproduce` and commit"
        for name, identity in identities.items()
        if listed.get(name) != identity
    ]


def unowned(place: Checkout, names: list[str]) -> list[str]:
    """Complaints: files that no study owns, and files that a study owns and that are not there."""
    complaints = []
    owned: set[Path] = set()
    for name in names:
        data = description(place, name)
        owned |= {place.results / name / file for file in [*data["comparison"], DESCRIPTION]}
    present = {path for path in place.results.rglob("*") if path.is_file() and not path.name.startswith(".part-")}
    complaints += [
        f"{place.shown(p)} belongs to no study: delete it, or restore its study" for p in sorted(present - owned)
    ]
    complaints += [
        f"{place.shown(p)} is listed by its study and missing: run `make reproduce`" for p in sorted(owned - present)
    ]
    return complaints
