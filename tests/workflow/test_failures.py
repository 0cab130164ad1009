"""Studies that cannot run, and places that cannot be written: named in a line, with the right status, no damage done.

Status 1: something is wrong with results; 2: with what was asked for. Whoever runs ten studies wants the other nine.
"""

import pytest

from rkverify.errors import UnknownName
from rkverify.paths import checkout
from rkverify.workflow.discovery import MENTIONED, choose, study_names

COMPUTE = "def compute(p):"
RAISING = {
    "in_compute": (COMPUTE, f"{COMPUTE}\n    raise RuntimeError('made up')"),
    "in_judge": ("def judge(p, tables):", "def judge(p, tables):\n    raise RuntimeError('made up')"),
    "same_name_twice": ("    return [Statement(", "    return 2 * [Statement("),
    "our_own_error": (COMPUTE, f"{COMPUTE}\n    from rkverify.errors import Undecided\n    raise Undecided('made up')"),
}
ENDING = {
    "exits": (COMPUTE, f"{COMPUTE}\n    raise SystemExit(3)"),
    "dies": (COMPUTE, f"{COMPUTE}\n    os._exit(9)"),
}


def add(small, tools, cases):
    for name, (old, new) in cases.items():
        text = tools.made_up()
        assert text.count(old) == 1
        small.study(name, text.replace(old, new))


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_studies_that_raise_are_named_and_the_others_run(jobs, fresh, tools):
    add(fresh, tools, RAISING)
    done = fresh.command("run", "--jobs", jobs)
    assert (done.returncode, tools.summary(done)) == (1, (3, 0, len(RAISING)))
    assert {line.split(": ")[1] for line in done.stderr.splitlines()} == set(RAISING)
    assert {p.parent.name for p in tools.files_in(fresh.results)} == {"gradients", "phases", "tents"}
    assert not fresh.manifest.exists()
    assert not list(fresh.root.rglob(".part-*"))
    assert tools.summary(fresh.command("run", "--jobs", jobs)) == (0, 3, len(RAISING))


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_studies_that_end_their_process_are_named_and_the_others_run(jobs, fresh, tools):
    """As a crash in a compiled library would, or the system short of memory: no wait for ever, and nothing lost."""
    add(fresh, tools, ENDING)
    done = fresh.command("run", "--jobs", jobs, seconds=30)
    assert (done.returncode, tools.summary(done)) == (1, (3, 0, len(ENDING)))
    assert {line.split(": ")[1] for line in done.stderr.splitlines()} == set(ENDING)
    assert "Traceback" not in done.stderr
    assert not fresh.manifest.exists()


NO_STUDIES = (
    "raise RuntimeError('made up')\n",
    "import no_such_module\n",
    "from rkverify.kernels import no_such_name\n",
    "def compute(p:\n",
    "STUDY = 3\n",
    '"""Nothing."""\n',
)


@pytest.mark.parametrize(
    ("command", "text"), [*(("run", text) for text in NO_STUDIES), ("verify", NO_STUDIES[0]), ("list", NO_STUDIES[0])]
)
def test_a_file_that_is_no_study_is_named_in_a_line(command, text, fresh):
    fresh.study("broken", text)
    done = fresh.command(command)
    (line,) = done.stderr.splitlines()
    assert line.startswith("rkverify: ")
    assert "broken" in line
    assert done.returncode in (1, 2)


def test_parameters_that_are_no_data_are_named_in_a_line(fresh, tools):
    text = tools.made_up().replace("rows: int = 4", "rows: int = 4\n    odd: object = 1j")
    fresh.study("broken", text)
    (line,) = fresh.command("run").stderr.splitlines()
    assert "broken" in line


@pytest.mark.parametrize("command", ["run", "verify"])
def test_an_unknown_study_is_one_line(command, fresh):
    done = fresh.command(command, "tents", "figure99")
    (line,) = done.stderr.splitlines()
    assert line == "rkverify: unknown study 'figure99': choose one of gradients, phases, tents"
    assert (done.returncode, done.stdout) == (2, "")
    assert not fresh.results.exists()


@pytest.mark.parametrize(
    ("typed", "meant"), [("figre4", "figure4"), ("theorem", "theorems"), ("stability_layer", "stability_layers")]
)
def test_a_slip_in_the_name_of_a_study_is_answered_by_the_name_that_was_meant(typed: str, meant: str) -> None:
    """Among many studies a few like it are named, the nearest first: decides that a slip is mended from one short line."""
    place = checkout()
    with pytest.raises(UnknownName) as error:
        choose(place, [typed])
    said = str(error.value)
    assert said.startswith(
        f"unknown study {typed!r}: choose one of those that `rkverify list` shows, such as {meant}, "
    )
    assert len(said.split("such as ")[1].split(", ")) == MENTIONED < len(study_names(place))
    assert len(said) < 200
    assert "\n" not in said


@pytest.mark.parametrize("count", ["0", "-1", "two"])
def test_a_senseless_count_of_processes_is_one_line(count, fresh):
    done = fresh.command("run", "--jobs", count)
    assert (done.returncode, done.stdout, len(done.stderr.splitlines())) == (2, "", 1)
    assert count in done.stderr


@pytest.mark.parametrize("place", ["reports", "reports/results", ".rkverify", ".rkverify/runs"])
@pytest.mark.parametrize("obstacle", ["plain file", "no permission"])
def test_a_place_that_cannot_be_written_is_one_line(place, obstacle, fresh):
    """Found out before anything is computed, and named."""
    path = fresh.root / place
    if obstacle == "plain file":
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("", encoding="utf-8")
    else:
        path.mkdir(parents=True)
        path.chmod(0o555)
    before = sorted(fresh.root.rglob("*"))
    done = fresh.command("run", anybody=True)
    (line,) = done.stderr.splitlines()
    assert line.startswith("rkverify: cannot write ")
    assert place in line
    assert (done.returncode, done.stdout) == (2, "")
    made = [p for p in sorted(fresh.root.rglob("*")) if p not in before and p.is_file()]
    assert made == []


def test_read_only_results_are_left_whole(small):
    """A study's own folder without permission: the study is named, its files are as they were."""
    before = small.contents()
    (small.results / "tents" / "values.csv").write_text("x\n", encoding="utf-8")
    spoilt = small.contents()
    (small.results / "tents").chmod(0o555)
    done = small.command("run", anybody=True)
    (small.results / "tents").chmod(0o755)
    (line,) = done.stderr.splitlines()
    assert line.startswith("rkverify: tents: cannot write ")
    assert done.returncode == 1
    assert small.contents() == spoilt
    assert small.command("run").returncode == 0
    assert small.contents() == before
