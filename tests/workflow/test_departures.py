"""What happens when files and recomputation disagree: told with place and excess, put right, or refused.

The committed results are evidence only if a change in them, by hand or by another machine, cannot pass unseen.
"""

import pytest

DRIFTING = 'int(os.environ.get("DRIFT", "0")) + n'


EDITS = {
    "numbers and words": [
        ("gradients/values.csv", "0,0\n", "0,1\n", ["gradients", "line 2", "byte for byte"]),
        ("tents/values.csv", "0,0.5\n", "0,0.5001\n", ["tents", "row 1, column value", "apart by 0.0001"]),
        ("phases/statements.json", "There are 4 rows", "There are 5 rows", ["phases", "[0].says", "4", "5"]),
    ],
    "structure and verdicts": [
        ("gradients/study.json", "Made up", "Made down", ["gradients", "line", "byte for byte"]),
        ("tents/values.csv", "n,value\n", "m,value\n", ["tents", "header"]),
        ("phases/statements.json", '"holds": true', '"holds": false', ["phases", "[0].holds", "False", "True"]),
    ],
    "line ends": [("gradients/values.csv", "\n", "\r\n", ["gradients", "byte for byte"])],
}


def only_line(done):
    (line,) = done.stderr.splitlines()
    return line


@pytest.mark.parametrize("edits", EDITS.values(), ids=EDITS)
def test_edited_files_are_told_by_verify_and_restored_by_run(edits, small, tools):
    before = small.contents()
    for file, old, new, _ in edits:
        text = before[f"results/{file}"].decode()
        assert old in text
        (small.results / file).write_bytes(text.replace(old, new).encode())
    done = small.command("verify")
    assert (done.returncode, tools.summary(done)) == (1, (3 - len(edits), 0, len(edits)))
    assert len(done.stderr.splitlines()) == len(edits)
    for file, _, _, words in edits:
        assert any(all(w in line for w in [*words, file.partition("/")[2]]) for line in done.stderr.splitlines()), file
    assert tools.summary(small.command("run")) == (len(edits), 3 - len(edits), 0)
    assert small.contents() == before


def test_deleted_files_are_told_by_verify_and_restored_by_run(small, tools):
    before = small.contents()
    gone = {"gradients": "study.json", "phases": "statements.json", "tents": "values.csv"}
    for study, file in gone.items():
        (small.results / study / file).unlink()
    done = small.command("verify")
    assert done.returncode == 1
    for study, file in gone.items():
        assert f"{study}: {file}: file: committed missing" in done.stderr
    assert tools.summary(small.command("run")) == (3, 0, 0)
    assert small.contents() == before


def test_a_deleted_manifest_is_told_by_verify_and_restored_by_run(small):
    before = small.contents()
    small.manifest.unlink()
    assert small.command("verify").returncode == 1
    assert small.command("run").returncode == 0
    assert small.contents() == before


@pytest.mark.parametrize("command", ["run", "verify"])
def test_a_file_that_no_study_owns_is_an_error(command, small):
    """Results of a study that was renamed or removed would stand there for ever as if they were confirmed."""
    strays = [small.results / file for file in ("tents/older.csv", "gone/values.csv", "note.txt")]
    for stray in strays:
        stray.parent.mkdir(exist_ok=True)
        stray.write_text("x\n", encoding="utf-8")
    done = small.command(command)
    assert done.returncode == 1
    assert len(done.stderr.splitlines()) == len(strays)
    for stray in strays:
        assert stray.relative_to(small.root).as_posix() in done.stderr
        assert stray.exists(), "it is somebody's file: told, not deleted"


def test_another_result_from_the_same_sources_is_refused(small, tools):
    """Same sources, parameters and environment, another number: the computation is not what it says it is."""
    small.study("drifts", tools.made_up(value=DRIFTING))
    assert tools.summary(small.command("run")) == (1, 3, 0)
    before, records = small.contents(), small.times(small.runs)
    done = small.command("run", "--force", "drifts", DRIFT="1")
    assert done.returncode == 1
    assert "drifts: values.csv: line 2: committed 0,0, recomputed 0,1" in only_line(done)
    assert small.contents() == before
    assert small.times(small.runs)["drifts.json"] == records["drifts.json"]
    assert small.command("verify", "drifts", DRIFT="1").returncode == 1
    assert small.command("verify", "drifts").returncode == 0


def test_another_machine_with_another_result_is_refused(small, tools):
    """A clone has the committed files and no records: it must compute, compare and complain."""
    small.study("drifts", tools.made_up(value=DRIFTING))
    small.command("run")
    before = small.contents()
    tools.remove(small.root / ".rkverify")
    done = small.command("run", DRIFT="1")
    assert (done.returncode, tools.summary(done)) == (1, (3, 0, 1))
    assert "drifts: values.csv" in only_line(done)
    assert small.contents() == before
    assert not (small.runs / "drifts.json").exists()


def test_another_machine_within_the_tolerance_leaves_the_files(small, tools):
    """Float results differ in the last digits between processors: the committed ones stay as they are."""
    small.study("drifts", tools.made_up(value=f"1 + 1e-13 * ({DRIFTING})", rule="Numeric(1e-12, 0, 'made up')"))
    small.command("run")
    before = small.times(small.root / "reports")
    tools.remove(small.root / ".rkverify")
    done = small.command("run", DRIFT="5")
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (4, 0, 0))
    assert small.times(small.root / "reports") == before
