"""Two machines that have only the sources in common write the same files, to the last byte.

Hash seeds, time zones, thread counts and the number of processes are what differs between them without anybody's
asking; `git status` after `make reproduce` stays clean only if none of it reaches a file.
"""

import pytest

REAL = ("kernels", "printed_consequences")  # floats and a library's splines, drawn; machine algebra
HERE = {"PYTHONHASHSEED": "1", "TZ": "Pacific/Auckland", "OMP_NUM_THREADS": "1", "LC_ALL": "C"}
THERE = {"PYTHONHASHSEED": "77", "TZ": "America/Caracas", "OMP_NUM_THREADS": "4", "LC_ALL": "C.UTF-8"}


@pytest.fixture
def two(untouched, tmp_path, tools):
    """Two checkouts in different folders, with real studies beside the made-up ones."""
    places = []
    for name in ("here", "over there"):
        place = tools.copy(untouched, tmp_path / name)
        for study in REAL:
            text = (tools.root / "studies" / f"{study}.py").read_text(encoding="utf-8")
            place.study(study, text)
        places.append(place)
    return places


def test_two_machines_write_the_same_files(two, tools):
    for place, more, jobs in zip(two, (HERE, THERE), ("1", "2"), strict=True):
        done = place.command("run", "--jobs", jobs, **more)
        assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (5, 0, 0))
    here, there = (place.contents() for place in two)
    assert here.keys() == there.keys()
    assert [name for name in here if here[name] != there[name]] == []


def test_results_carry_no_trace_of_time_and_place(finished):
    """Else no second machine could write the same."""
    for name, content in finished.contents().items():
        assert str(finished.root).encode() not in content, name


def test_deleting_all_results_and_running_again_gives_the_same(small, tools):
    before = small.contents()
    tools.remove(small.root / "reports")
    done = small.command("run", "--jobs", "2", **THERE)
    assert (done.returncode, done.stderr, tools.summary(done)) == (0, "", (3, 0, 0))
    assert small.contents() == before
