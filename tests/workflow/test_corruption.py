"""Damaged files of our own: a run recovers from them, verify and list tell of them, nothing ends in a traceback.

Disks fill up, merges leave their marks, people edit: none of that may cost more than computing once more.
"""

import json

import pytest

from rkverify.errors import BadInput
from rkverify.paths import Checkout
from rkverify.workflow import manifest, records
from rkverify.workflow.identity import digest
from rkverify.workflow.reconcile import made_by

BROKEN = {
    "empty": b"",
    "truncated": b'{"studies": {"tents": {"iden',
    "binary": b"\xff\xfe\x00\x80",
    "merge": b'<<<<<<< HEAD\n{}\n=======\n{"studies": {}}\n>>>>>>> theirs\n',
    "null": b"null",
    "number": b"3",
    "list": b"[]",
    "another object": b"{}",
}
MANIFESTS = {
    **BROKEN,
    "studies is a list": b'{"studies": []}',
    "a study is null": b'{"studies": {"tents": null}}',
    "files is a list": b'{"studies": {"tents": {"identity": 3, "files": []}}}',
}
DESCRIPTIONS = {
    **BROKEN,
    "provenance is a list": b'{"comparison": {}, "provenance": []}',
    "comparison is a number": b'{"comparison": 3, "provenance": {"total": ""}}',
}
GOOD_RECORD = {"identity": "x", "finished": "now", "seconds": 1.0, "circumstances": {}}
RECORDS = {
    **BROKEN,
    "files is a list": {"files": []},
    "files is empty": {"files": {}},
    "a hash is a number": {"files": {"values.csv": 3}},
    "identity is a list": {"identity": ["x"]},
    "a key more": {"surplus": 1},
    "a key less": {"files": None},
}


@pytest.fixture
def place(tmp_path):
    """A checkout as the workflow sees it, with one study that has one file and a right record."""
    found = Checkout(tmp_path, tmp_path / "reports" / "results", tmp_path / "reports", tmp_path / ".rkverify")
    (found.results / "tents").mkdir(parents=True)
    (found.results / "tents" / "values.csv").write_text("x\n", encoding="utf-8")
    found.runs.mkdir(parents=True)
    keep(found, {})
    return found


def keep(place, damage):
    path = records.record_path(place, "tents")
    right = {**GOOD_RECORD, "files": {"values.csv": digest(b"x\n")}}
    path.write_bytes(damage if isinstance(damage, bytes) else json.dumps({**right, **damage}).encode())


@pytest.mark.parametrize("damage", RECORDS)
def test_a_damaged_record_is_as_good_as_none(damage, place):
    assert records.is_current(place, "tents", "x")
    keep(place, RECORDS[damage])
    assert not records.is_current(place, "tents", "x")


@pytest.mark.parametrize("damage", MANIFESTS)
def test_a_damaged_manifest_lists_nothing(damage, place):
    place.manifest.write_bytes(MANIFESTS[damage])
    assert not manifest.is_as_listed(place, "tents", "values.csv")
    assert len(manifest.stale(place, {"tents": "x"})) == 1


@pytest.mark.parametrize("damage", DESCRIPTIONS)
def test_a_damaged_description_is_named(damage, place):
    """By everything that reads descriptions, so that run and verify can tell it in a line."""
    path = place.results / "tents" / "study.json"
    path.write_bytes(DESCRIPTIONS[damage])
    if damage != "comparison is a number":
        assert made_by(path.parent) is None
    for read in (manifest.build, manifest.unowned):
        with pytest.raises(BadInput, match=r"tents/study\.json"):
            read(place, ["tents"])


def is_calm(done):
    """Nothing but lines of our own."""
    assert "Traceback" not in done.stderr + done.stdout, done.stderr
    return all(line.startswith("rkverify: ") for line in done.stderr.splitlines())


@pytest.mark.parametrize("damage", ["truncated", "another object"])
def test_damage_is_told_by_verify_and_repaired_by_run(damage, small):
    before = small.contents()
    files = ["tents/study.json", "phases/statements.json", "../manifest.json"]
    for file in files:
        (small.results / file).write_bytes(BROKEN[damage])
    done = small.command("verify")
    assert is_calm(done)
    assert done.returncode == 1
    assert all(word in done.stderr for word in ("tents: study.json", "phases: statements.json"))
    done = small.command("run")
    assert (done.returncode, done.stderr) == (0, "")
    assert small.contents() == before


def test_running_another_study_tells_the_damaged_description(small):
    """The manifest is made of all descriptions: one that is none must not get into it, nor stop us without a word."""
    before = small.manifest.read_bytes()
    (small.results / "tents" / "study.json").write_bytes(b"{}")
    done = small.command("run", "--force", "phases")
    assert is_calm(done)
    assert "tents/study.json" in done.stderr
    assert done.returncode in (1, 2)
    assert small.manifest.read_bytes() == before


@pytest.mark.parametrize("damage", [b"[]", b'{"identity": "x", "files": {}, "finished": 3, "seconds": "long", "circumstances": 0}'])  # fmt: skip
def test_list_and_run_work_beside_a_damaged_record(damage, small, tools):
    (small.runs / "tents.json").write_bytes(damage)
    done = small.command("list")
    assert is_calm(done)
    assert (done.returncode, len(done.stdout.splitlines())) == (0, 3)
    done = small.command("run")
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (1, 2, 0))


def test_a_folder_in_a_files_place_is_told(small):
    path = small.results / "tents" / "values.csv"
    path.unlink()
    path.mkdir()
    done = small.command("run")
    assert is_calm(done)
    assert (done.returncode, len(done.stderr.splitlines())) == (1, 1)
    assert "tents/values.csv" in done.stderr
