"""`rkverify run`, again and again: what changed is computed, all else is left alone, down to the dates of the files.

A checkout in which every run touches committed files, or keeps results of older sources, reproduces nothing.
"""

import json

import pytest


def computed(small, earlier):
    """The studies whose record was written anew."""
    return {name.removesuffix(".json") for name, when in small.times(small.runs).items() if earlier.get(name) != when}


def test_the_first_run_computes_all_and_lists_them(finished):
    manifest = json.loads(finished.manifest.read_text(encoding="utf-8"))
    assert manifest["studies"].keys() == {"gradients", "phases", "tents"}
    for name, listed in manifest["studies"].items():
        record = json.loads((finished.runs / f"{name}.json").read_text(encoding="utf-8"))
        assert listed["files"].keys() == {"values.csv", "statements.json", "study.json"}
        assert (record["identity"], record["files"]) == (listed["identity"], listed["files"])


def test_the_manifest_holds_the_hash_of_every_file(finished, tools):
    """As `sha256sum` gives it, so that anybody can check the files without our code."""
    listed = json.loads(finished.manifest.read_text(encoding="utf-8"))["studies"]
    for path in tools.files_in(finished.results):
        assert listed[path.parent.name]["files"][path.name] == tools.sha256(path)


def test_a_second_run_does_nothing(small, tools):
    earlier = small.times(small.root)
    done = small.command("run")
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (0, 3, 0))
    assert small.times(small.root) == earlier


@pytest.mark.parametrize(
    ("path", "concerned"),
    [
        ("rkverify/paper/cells.py", {"gradients"}),
        ("rkverify/paper/numbered.py", {"gradients", "phases"}),
    ],
)
def test_a_changed_line_runs_the_studies_that_import_it(path, concerned, small, tools):
    """Their results are the same, so that only the description with the sources' hashes is a new file."""
    records, results = small.times(small.runs), small.times(small.results)
    small.add_line(path)
    done = small.command("run")
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (len(concerned), 3 - len(concerned), 0))
    assert computed(small, records) == concerned
    touched = {name for name, when in small.times(small.results).items() if results[name] != when}
    assert touched == {f"{name}/study.json" for name in concerned}
    assert tools.summary(small.command("verify")) == (3, 0, 0)


def test_a_changed_result_is_written_where_the_sources_changed(small, tools):
    text = (small.root / "studies" / "phases.py").read_text(encoding="utf-8")
    small.study("phases", text.replace("rows: int = 4", "rows: int = 6"))
    assert tools.summary(small.command("run")) == (1, 2, 0)
    assert len((small.results / "phases" / "values.csv").read_text(encoding="utf-8").splitlines()) == 7
    assert small.command("verify").returncode == 0


def test_force_runs_what_is_current_and_touches_no_file(small, tools):
    results, records = small.times(small.results), small.times(small.runs)
    manifest = small.manifest.stat().st_mtime_ns
    assert tools.summary(small.command("run", "--force", "tents")) == (1, 0, 0)
    assert computed(small, records) == {"tents"}
    assert (small.times(small.results), small.manifest.stat().st_mtime_ns) == (results, manifest)


def test_named_studies_run_and_no_other(fresh, tools):
    done = fresh.command("run", "tents", "phases", "tents")
    assert (done.returncode, tools.summary(done)) == (0, (2, 0, 0))
    assert computed(fresh, {}) == {"tents", "phases"}
    assert not fresh.manifest.exists(), "a manifest of some of the studies would pass for one of all"


def test_a_quick_run_writes_under_its_own_folder_only(small, tools):
    """The committed results are those of full parameters: a quick run must never get among them."""
    earlier = small.times(small.root)
    done = small.command("run", "--quick")
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (3, 0, 0))
    after = small.times(small.root)
    assert {n: when for n, when in after.items() if not n.startswith(".rkverify/quick/")} == earlier
    rows = (small.root / ".rkverify" / "quick" / "results" / "tents" / "values.csv").read_text(encoding="utf-8")
    assert len(rows.splitlines()) == 3
    assert tools.summary(small.command("run", "--quick")) == (0, 3, 0)
    assert tools.summary(small.command("run")) == (0, 3, 0)


def test_verify_writes_nothing(small, tools):
    earlier = small.times(small.root)
    done = small.command("verify")
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (3, 0, 0))
    assert small.times(small.root) == earlier


def test_verify_tells_results_of_older_sources(small):
    """All numbers agree, but they are filed under sources that are no longer there."""
    small.add_line("rkverify/paper/plane_wave.py")
    done = small.command("verify")
    assert done.returncode == 1
    assert "phases" in done.stderr
    assert "gradients" not in done.stderr
