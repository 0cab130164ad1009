"""The report as a Process Run Crate: every study a run of rkverify, with its parameters, its files and its circumstances.

RO-Crate 1.1 with the profile https://w3id.org/ro/wfrun/process/0.5. Only what is known is written: a study that has not
been run on this machine has no time.
"""

import json
import os
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from rkverify import __version__
from rkverify.errors import BadInput
from rkverify.paths import Checkout
from rkverify.workflow import manifest, records
from rkverify.workflow.discovery import study_names
from rkverify.workflow.files import write_atomically

METADATA = "ro-crate-metadata.json"
CRATE = "https://w3id.org/ro/crate/1.1"
PROFILE = "https://w3id.org/ro/wfrun/process/0.5"
LICENSE = "https://spdx.org/licenses/BSD-3-Clause"
PAPER = "#chen-wu-2007"
PROGRAM, MAKERS = f"#rkverify-{__version__}", "#makers"
FORMATS = {
    ".csv": "text/csv",
    ".json": "application/json",
    ".svg": "image/svg+xml",
    ".html": "text/html",
    ".ipynb": "application/x-ipynb+json",
}
Entity = dict[str, Any]


def write(place: Checkout, folder: Path | None = None) -> Path:
    """Write the metadata beside the pages, or into a folder for reading; returns the file.

    Raises BadInput where no study has results.
    """
    path = (folder or place.pages) / METADATA
    write_atomically(path, json.dumps(metadata(place, datetime.now(UTC)), indent=1, ensure_ascii=False) + "\n")
    return path


def metadata(place: Checkout, now: datetime) -> Entity:
    """The metadata document; paths are relative to the folder of the pages."""
    names = [name for name in study_names(place) if (place.results / name).is_dir()]
    if not names:
        raise BadInput(f"no study has results under {place.shown(place.results)}: run `make reproduce`")
    runs = [entity for name in names for entity in _run(place, name)]
    pages = [_file(place, path, "page of the report") for path in sorted(place.pages.glob("*.html"))]
    files = [entity for entity in runs if entity["@type"] == "File"] + pages
    root: Entity = {
        "@id": "./",
        "@type": "Dataset",
        "name": "rkverify: results and report",
        "description": "Tables, figures, statements and pages on every equation, figure and claim of the paper that is verified.",
        "datePublished": now.strftime("%Y-%m-%d"),
        "license": {"@id": LICENSE},
        "author": {"@id": MAKERS},
        "publisher": {"@id": MAKERS},
        "about": {"@id": PAPER},
        "conformsTo": {"@id": PROFILE},
        "hasPart": [{"@id": entity["@id"]} for entity in files],
        "mentions": [{"@id": entity["@id"]} for entity in runs if entity["@type"] == "CreateAction"],
    }
    descriptor = {
        "@id": METADATA,
        "@type": "CreativeWork",
        "conformsTo": {"@id": CRATE},
        "about": {"@id": "./"},
    }
    return {"@context": f"{CRATE}/context", "@graph": [descriptor, root, *_contextual(place), *runs, *pages]}


def _contextual(place: Checkout) -> list[Entity]:
    commit = records.commit(place.root)
    return [
        {"@id": PROFILE, "@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"},
        {"@id": LICENSE, "@type": "CreativeWork", "name": "BSD-3-Clause", "description": "BSD 3-Clause License"},
        {"@id": MAKERS, "@type": "Organization", "name": "The rkverify developers"},
        {
            "@id": PAPER,
            "@type": "ScholarlyArticle",
            "name": "Stability in Lagrangian and Semi-Lagrangian Reproducing Kernel Discretizations Using Nodal Integration in "
            "Nonlinear Solid Mechanics",
            "author": "J. S. Chen and Y. Wu",
            "isPartOf": "Advances in Meshfree Techniques, Springer, 2007, pp. 55-76",
        },
        {
            "@id": PROGRAM,
            "@type": "SoftwareApplication",
            "name": "rkverify",
            "softwareVersion": f"{__version__}, commit {commit}",
            "license": {"@id": LICENSE},
            "author": {"@id": MAKERS},
        },
    ]


def _run(place: Checkout, name: str) -> list[Entity]:
    """The run of a study: action, parameters, files."""
    data = manifest.description(place, name)
    described = {**data["tables"], **data["figures"]}
    files = [
        _file(place, path, described.get(path.name, {}).get("caption", f"{path.name} of the study {name}"))
        for path in sorted((place.results / name).iterdir())
        if path.suffix in FORMATS
    ]
    parameters = [
        {
            "@id": f"#parameter-{name}-{key}",
            "@type": "PropertyValue",
            "name": key,
            "value": json.dumps(value, ensure_ascii=False),
        }
        for key, value in data["provenance"]["parameters"].items()
    ]
    action: Entity = {
        "@id": f"#run-{name}",
        "@type": "CreateAction",
        "name": data["title"],
        "description": f"rkverify run {name}; identity of sources, parameters and lock: {data['provenance']['total']}.",
        "instrument": {"@id": PROGRAM},
        "agent": {"@id": MAKERS},
        "object": _references(parameters),
        "result": _references(files),
        **_times(place, name),
    }
    return [{key: value for key, value in action.items() if value}, *parameters, *files]


def _references(found: list[Entity]) -> Any:
    """One entity by itself, several as a list."""
    each = [{"@id": entity["@id"]} for entity in found]
    return each[0] if len(each) == 1 else each


def _times(place: Checkout, name: str) -> Entity:
    """When the study ran and how, where it ran on this machine."""
    run = records.last_run(place, name)
    if run is None:
        return {}
    end = datetime.fromisoformat(run.finished)
    start = end - timedelta(seconds=run.seconds)
    return {
        "startTime": start.isoformat(timespec="seconds"),
        "endTime": end.isoformat(timespec="seconds"),
    }


def _file(place: Checkout, path: Path, words: str) -> Entity:
    return {
        "@id": os.path.relpath(path, place.pages).replace(os.sep, "/"),
        "@type": "File",
        "name": path.name,
        "description": words,
        "encodingFormat": FORMATS[path.suffix],
        "contentSize": str(path.stat().st_size),
    }
