"""The metadata of the report, checked by the validator of the RO-Crate community against the profile that it claims.

Our own reading of the profile would pass our own mistakes. The one document that the validator fetches, the context of
the crate, comes from the rocrate package: nothing is asked of the network.
"""

import json
import shutil
import subprocess
import sys
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from rkverify.errors import BadInput
from rkverify.paths import checkout
from rkverify.report.crate import METADATA, metadata, write
from rkverify.workflow import records

STUDIES = ("gradients", "kernels")

VALIDATE = """
import json, sys
from pathlib import Path
import requests, rocrate
from rocrate_validator import models, services
from rocrate_validator.utils.http import HttpRequester

CONTEXT = Path(rocrate.__file__).parent / "data" / "ro-crate.jsonld"

def serve(self, url, *args, **options):
    answer = requests.Response()
    answer.status_code = 200 if url.startswith("https://w3id.org/ro/crate/") else 404
    answer.url, answer._content = url, CONTEXT.read_bytes()
    answer.headers["Content-Type"] = "application/ld+json"
    return answer

HttpRequester.get = HttpRequester.head = serve
settings = models.ValidationSettings(
    rocrate_uri=models.URI(sys.argv[1]), profile_identifier="process-run-crate-0.5", no_cache=True,
    requirement_severity=models.Severity.RECOMMENDED,
)
found = services.validate(settings).get_issues()
print(json.dumps([[issue.severity.name, issue.message, str(issue.violatingEntity)] for issue in found]))
"""

UNKNOWN = {
    "The Application SHOULD have a url",
    "The SoftwareApplication id SHOULD be an absolute URI",
    "The organization SHOULD have a URL.",
    "The Action SHOULD have an endTime in ISO 8601 format",
}
"""Recommended, and not known here: the project has no public address; studies may not have been run on this machine."""


@pytest.fixture
def place(tmp_path):
    """A folder of pages with the results of two studies, one of them run here."""
    here = checkout()
    for name in STUDIES:
        shutil.copytree(here.results / name, tmp_path / "results" / name)
    (tmp_path / "index.html").write_text("<h1>Front</h1>", encoding="utf-8")
    found = replace(here, results=tmp_path / "results", pages=tmp_path, state=tmp_path / "state")
    times = {"finished": "2026-01-02T03:04:05+00:00", "seconds": 65.4}
    records.save(found, "gradients", records.RunRecord("id", {}, circumstances={}, **times))
    return found


def validated(folder: Path) -> list[tuple[str, str, str]]:
    done = subprocess.run(
        [sys.executable, "-c", VALIDATE, str(folder)], capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return [tuple(issue) for issue in json.loads(done.stdout.splitlines()[-1])]


def test_the_profile_is_met_and_a_spoilt_crate_is_found_out(place) -> None:
    path = write(place)
    found = validated(place.pages)
    assert [issue for issue in found if issue[0] == "REQUIRED"] == []
    assert {issue[1] for issue in found} <= UNKNOWN

    data = json.loads(path.read_text(encoding="utf-8"))
    for entity in data["@graph"]:
        if entity["@id"] == "./":
            del entity["conformsTo"]
        entity.pop("instrument", None)
    path.write_text(json.dumps(data), encoding="utf-8")
    missed = {issue[1] for issue in validated(place.pages) if issue[0] == "REQUIRED"}
    assert any("instrument" in message for message in missed)
    assert any("profile" in message for message in missed)


def test_every_reference_has_an_entity_and_every_file_exists(place) -> None:
    graph = metadata(place, datetime(2026, 1, 2, tzinfo=UTC))["@graph"]
    ids = [entity["@id"] for entity in graph]
    assert len(ids) == len(set(ids))
    outside = {"https://w3id.org/ro/crate/1.1"}

    def references(value):
        if isinstance(value, dict):
            yield from [value["@id"]] if set(value) == {"@id"} else []
        elif isinstance(value, list):
            for one in value:
                yield from references(one)

    named = {id for entity in graph for value in entity.values() for id in references(value)}
    assert named - set(ids) == outside
    files = {entity["@id"] for entity in graph if entity["@type"] == "File"}
    assert files == {"index.html"} | {
        p.relative_to(place.pages).as_posix() for p in place.results.rglob("*") if p.is_file()
    }


def test_times_are_those_of_the_run_and_none_is_made_up(place) -> None:
    actions = {e["@id"]: e for e in metadata(place, datetime.now(UTC))["@graph"] if e["@type"] == "CreateAction"}
    assert actions["#run-gradients"]["startTime"] == "2026-01-02T03:02:59+00:00"
    assert actions["#run-gradients"]["endTime"] == "2026-01-02T03:04:05+00:00"
    assert "endTime" not in actions["#run-kernels"]


def test_without_results_there_is_nothing_to_describe(place, tmp_path) -> None:
    with pytest.raises(BadInput, match="no study has results"):
        write(replace(place, results=tmp_path / "none"))
    assert not (place.pages / METADATA).exists()
