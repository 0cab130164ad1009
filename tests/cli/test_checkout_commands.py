"""ledger, list, run, verify, report: what they print, and what they say where there is no checkout to work on."""

import json
import re

import pytest

from rkverify.ledger.entries import entries
from rkverify.ledger.grades import GRADES
from rkverify.ledger.states import STATES


def test_the_ledger_lists_all_entries_and_counts_them(rkverify):
    done = rkverify("ledger")
    assert (done.status, done.err) == (0, "")
    listing, table, graded = done.out.split("\n\n")
    assert [line.split()[0] for line in listing.splitlines()] == list(entries())
    counted = {word: int(count) for count, word in re.findall(r"^ *(\d+) (.+)$", table, re.MULTILINE)}
    assert counted.pop("entries") == 170
    assert list(counted) == list(STATES)
    assert sum(counted.values()) == 170
    for word, count in counted.items():
        assert sum(line[5:].startswith(f"{word} ") for line in listing.splitlines()) >= count
    for count, grade in re.findall(r"^ *(\d+) (.+)$", graded, re.MULTILINE):
        assert grade in GRADES
        assert sum(line[28:].startswith(f"{grade} ") for line in listing.splitlines()) == int(count)


def test_the_ledger_as_data(rkverify):
    data = json.loads(rkverify("ledger", "--json").out)
    assert [e["id"] for e in data["entries"]] == list(entries())
    for word, count in data["counts"].items():
        assert sum(e["state"] == word for e in data["entries"]) == count
    assert {e["grade"] for e in data["entries"]} <= {*GRADES, ""}


@pytest.mark.parametrize("name", ["C43", "c43"])
def test_an_entry_with_its_evidence(name, rkverify):
    done = rkverify("ledger", name)
    assert done.status == 0
    assert done.out.startswith("C43  ")
    assert "Decided by:" in done.out
    assert re.search(r"^(holds|fails|not decidable): study \w+, ", done.out, re.MULTILINE)
    data = json.loads(rkverify("ledger", name, "--json").out)
    assert (data["id"], data["statement"]) == ("C43", entries()["C43"].statement)
    assert data["state"] in done.out.splitlines()[0]


def test_an_equation_tells_where_it_is_transcribed(rkverify):
    assert "Transcribed in: rkverify.paper.shape.shape_functions" in rkverify("ledger", "E4").out


@pytest.mark.parametrize("name", ["E88", "C0", "X1", "43", "E"])
def test_an_unknown_entry_is_refused_in_one_line(name, rkverify):
    complaint = rkverify("ledger", name).complaint()
    assert repr(name) in complaint
    assert "E1 to E87" in complaint


def test_list_shows_every_study(rkverify, python):
    from rkverify.paths import checkout
    from rkverify.workflow.discovery import study_names

    done = rkverify("list")
    assert (done.status, done.err) == (0, "")
    assert [line.split()[0] for line in done.out.splitlines()] == study_names(checkout())
    assert all(re.search(r" (current|changed|not run here) ", line) for line in done.out.splitlines())


@pytest.mark.parametrize("words", ["list", "run", "run --quick", "verify", "ledger", "ledger C43", "report"])
def test_without_a_checkout_one_line_says_so(words, python, wheel, tmp_path):
    """From an installed wheel there are no studies; the folder one happens to be in must stay as it is."""
    done = python("-m", "rkverify", *words.split(), cwd=tmp_path, PYTHONPATH=str(wheel))
    assert "checkout" in done.complaint()
    assert list(tmp_path.iterdir()) == []


def test_the_wheel_is_what_runs_there(python, wheel, tmp_path):
    done = python("-c", "import rkverify; print(rkverify.__file__)", cwd=tmp_path, PYTHONPATH=str(wheel))
    assert done.out.strip() == str(wheel / "rkverify" / "__init__.py")


def test_the_commands_on_your_own_nodes_work_without_a_checkout(python, wheel, tmp_path):
    (tmp_path / "nodes.csv").write_text("x\n0\n1\n2\n", encoding="utf-8")
    (tmp_path / "points.csv").write_text("x\n1\n", encoding="utf-8")
    words = ["shape", "--nodes", "nodes.csv", "--points", "points.csv", "--support", "3/2", "--arithmetic", "exact"]
    done = python("-m", "rkverify", *words, cwd=tmp_path, PYTHONPATH=str(wheel))
    assert (done.status, done.err) == (0, "")
    words = [
        "dispersion",
        "--formulation",
        "lagrangian",
        "--integration",
        "scni",
        "--support-ratio",
        "3/2",
        "--kh",
        "1",
    ]
    done = python("-m", "rkverify", *words, cwd=tmp_path, PYTHONPATH=str(wheel))
    assert (done.status, done.err) == (0, "")
