"""What a study's identity depends on: its import closure, parameters and lock, and nothing else.

Too little in it and a run keeps results that the sources no longer give; too much and every edit recomputes all.
"""

import json

import pytest

ALL = {"gradients", "phases", "tents"}
IDENTITIES = """
import json
from rkverify.paths import checkout
from rkverify.workflow.runner import jobs
print(json.dumps({job.name: job.identity.total for job in jobs(checkout(), [])}))
"""


def identities(small):
    done = small.python("-c", IDENTITIES)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def before(untouched):
    return identities(untouched)


def changed(small, before):
    after = identities(small)
    assert after.keys() == before.keys()
    return {name for name in after if after[name] != before[name]}


def test_the_copy_is_what_runs(untouched):
    """Without this the tests of this folder would look at the checkout they come from."""
    done = untouched.python("-c", "import rkverify, studies; print(rkverify.__file__, studies.__file__, sep='\\n')")
    assert done.stdout.split("\n")[:2] == [str(untouched.root / p / "__init__.py") for p in ("rkverify", "studies")]


def test_the_same_sources_have_the_same_identity(fresh, before):
    """In another folder, with other dates of the files."""
    for path in fresh.root.rglob("*.py"):
        path.touch()
    assert changed(fresh, before) == set()


@pytest.mark.parametrize(
    ("path", "concerned"),
    [
        ("studies/tents.py", {"tents"}),
        ("rkverify/paper/cells.py", {"gradients"}),  # imported by the study itself
        ("rkverify/paper/moment.py", {"gradients"}),  # through gradients and shape
        ("rkverify/paper/numbered.py", {"gradients", "phases"}),
        ("rkverify/paper/plane_wave.py", {"phases"}),
        ("rkverify/kernels.py", {"gradients", "tents"}),
        ("rkverify/paper/__init__.py", {"gradients", "phases"}),  # a package's own lines run first
        ("rkverify/__init__.py", ALL),
        ("studies/__init__.py", ALL),
        ("rkverify/workflow/compare.py", ALL),
        ("requirements.lock", ALL),
        ("rkverify/stability/roots.py", set()),
        ("rkverify/report/site.py", set()),
        ("pyproject.toml", set()),
    ],
)
def test_a_changed_line_counts_where_it_is_imported(path, concerned, fresh, before):
    fresh.add_line(path)
    assert changed(fresh, before) == concerned


def test_what_writes_the_files_counts(fresh, before):
    """statements.json, study.json and the rules of comparison in it are made there: other lines, other files."""
    fresh.add_line("rkverify/workflow/produce.py")
    assert changed(fresh, before) == ALL


def test_parameters_count(fresh, before):
    text = (fresh.root / "studies" / "phases.py").read_text(encoding="utf-8")
    assert "rows: int = 4" in text
    fresh.study("phases", text.replace("rows: int = 4", "rows: int = 5"))
    assert changed(fresh, before) == {"phases"}


def test_a_module_beside_the_studies_counts(fresh, tools):
    for name in ("one", "two"):
        fresh.study(name, tools.made_up("from studies._shared import VALUE", "VALUE"))
    fresh.study("_shared", '"""Shared."""\n\nVALUE = 1\n')
    earlier = identities(fresh)
    assert earlier.keys() == {*ALL, "one", "two"}, "a name with an underscore is no study"
    fresh.add_line("studies/_shared.py")
    assert changed(fresh, earlier) == {"one", "two"}


def test_a_module_imported_late_counts(fresh, tools):
    """An import inside a function runs as much as one at the top."""
    later = "\n\ndef later(n):\n    from rkverify.stability.roots import Root\n\n    return Root(n, 0).re\n"
    fresh.study("late", tools.made_up(value="later(n)") + later)
    earlier = identities(fresh)
    fresh.add_line("rkverify/stability/roots.py")
    assert changed(fresh, earlier) == {"late"}


def test_an_empty_folder_named_like_a_module_changes_nothing(fresh, before):
    """git leaves such folders behind, with their __pycache__, where a package has become a module."""
    (fresh.root / "rkverify" / "kernels" / "__pycache__").mkdir(parents=True)
    assert changed(fresh, before) == set()


def test_another_copy_of_the_library_is_not_taken_for_the_checkouts(fresh, tmp_path, tools):
    """With an installed rkverify of other lines, a run in a checkout must not file its results under the checkout's.

    PYTHONSAFEPATH is what the script `rkverify` does: the working directory is not looked at.
    """
    installed = tools.new_checkout(tmp_path / "installed", {})
    kernels = installed.root / "rkverify" / "kernels.py"
    text = kernels.read_text(encoding="utf-8")
    assert text.count('_b_spline("tent", 2,') == 1
    kernels.write_text(text.replace('_b_spline("tent", 2,', '_b_spline("tent", 4,'), encoding="utf-8")
    (installed.root / "studies" / "__init__.py").unlink()  # no checkout
    assert tools.summary(fresh.command("run", "tents")) == (1, 0, 0)
    before = fresh.contents()
    done = fresh.command("run", "tents", "--force", PYTHONSAFEPATH="1", PYTHONPATH=str(installed.root))
    assert fresh.contents() == before
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
