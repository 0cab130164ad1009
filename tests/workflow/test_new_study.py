"""rkverify new-study: what it writes runs at once, what it cannot write it does not begin.

A first study that fails on its first run teaches nothing; one that half exists has to be cleaned up by hand.
"""

import json
import tomllib

import pytest

NAME = "my_question"
PAGE = "rkverify/report/pages/discretisation.toml"
STUDY, TEST = f"studies/{NAME}.py", f"tests/studies/test_{NAME}.py"


@pytest.fixture
def there(fresh):
    """A small checkout with the README's table as well."""
    (fresh.root / "README.md").write_text("| result |\n| the pages | `make report` | … |\n", encoding="utf-8")
    return fresh


def snapshot(small) -> dict[str, str]:
    return {
        path.relative_to(small.root).as_posix(): path.read_text(encoding="utf-8")
        for folder in ("studies", "tests", "rkverify/ledger", "rkverify/report/pages", ".")
        for path in (small.root / folder).glob("**/*" if folder != "." else "*.md")
        if path.is_file() and path.suffix in (".py", ".toml", ".md")
    }


def listed(small) -> dict[str, list[str]]:
    found = {}
    for path in sorted((small.root / "rkverify" / "ledger").glob("*.toml")):
        found |= {e["id"]: e["studies"] for e in tomllib.loads(path.read_text(encoding="utf-8"))["entry"]}
    return found


def test_it_runs_at_once_and_its_test_passes_and_can_fail(there) -> None:
    before, entries = snapshot(there), listed(there)
    done = there.command("new-study", NAME)
    assert (done.returncode, done.stderr) == (0, "")
    assert f"wrote {STUDY}\nwrote {TEST}\nchanged {PAGE}\nchanged README.md\n" in done.stdout
    after = snapshot(there)
    assert after.keys() - before.keys() == {STUDY, TEST}
    assert listed(there) == entries
    assert f"`rkverify run {NAME}`" in after["README.md"]
    shown = [tomllib.loads(text[PAGE])["studies"] for text in (before, after)]
    assert shown[1] == [*shown[0], NAME]

    run = there.command("run", NAME, "--jobs", "1")
    assert (run.returncode, run.stderr) == (0, "")
    assert (there.results / NAME / "sums.svg").is_file()
    (statement,) = json.loads((there.results / NAME / "statements.json").read_text(encoding="utf-8"))
    assert statement["holds"] is True
    tested = there.python("-m", "pytest", "-q", TEST)
    assert tested.returncode == 0, tested.stdout
    assert "2 passed" in tested.stdout

    spoilt = after[STUDY].replace("str(shapes)", "str(kernels)")
    assert spoilt != after[STUDY]
    there.study(NAME, spoilt)
    assert "2 failed" in there.python("-m", "pytest", "-q", TEST).stdout


def test_it_is_written_in_the_house_style(there) -> None:
    assert there.command("new-study", NAME, "--about", "E1", "E2", "C43").returncode == 0
    for words in (("format", "--check"), ("check",)):
        done = there.python("-m", "ruff", *words, STUDY, TEST)
        assert done.returncode == 0, done.stdout


def test_entries_list_it_and_are_not_decided_by_it(there) -> None:
    """A stub must not turn a verdict: it says that it decides nothing yet."""
    before, entries = snapshot(there), listed(there)
    done = there.command("new-study", NAME, "--about", "e1", "E2", "C43", "E1")
    assert (done.returncode, done.stderr) == (0, "")
    assert "E1, E2, C43: not decidable until" in done.stdout
    expected = {
        id: sorted({*studies, NAME}) if id in ("E1", "E2", "C43") else studies for id, studies in entries.items()
    }
    assert listed(there) == expected
    after = snapshot(there)
    changed = {path for path in before if after[path] != before[path]}
    assert changed == {"README.md", "rkverify/ledger/equations.toml", "rkverify/ledger/claims.toml", PAGE}
    for path in changed - {"README.md", PAGE}:
        old, new = before[path].splitlines(), after[path].splitlines()
        assert sum(a != b for a, b in zip(old, new, strict=True)) == sum(f'"{NAME}"' in line for line in new)

    assert there.command("run", NAME, "--jobs", "1").returncode == 0
    state = json.loads(there.command("ledger", "E1", "--json").stdout)
    assert state["state"] == "not decidable"
    links = there.python(
        "-c", "from rkverify.ledger.states import both_ways; from rkverify.paths import checkout\n"
        f"print([line for line in both_ways(checkout().results) if {NAME!r} in line])",
    )  # fmt: skip
    assert links.stdout == "[]\n"


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["gradients"], "studies/gradients.py exists: choose another name"),
        (["My_study"], "'My_study' cannot name a study: use small letters"),
        (["2nd"], "cannot name a study"),
        (["_hidden"], "cannot name a study"),
        (["lambda"], "cannot name a study"),
        (["../escape"], "cannot name a study"),
        (["claims"], "'claims' is the name of a page of the report"),
        ([NAME, "--about", "C76"], "unknown entry 'C76'"),
        ([NAME, "--page", "claims"], "unknown page 'claims': choose one of certificates"),
    ],
)
def test_what_is_refused_leaves_everything_as_it_was(words, told, there) -> None:
    before = snapshot(there)
    done = there.command("new-study", *words)
    assert done.returncode == 2
    assert told in done.stderr
    assert done.stderr.count("\n") == 1
    assert snapshot(there) == before


def test_a_test_or_results_of_that_name_are_not_replaced(there) -> None:
    for path in (there.root / TEST, there.results / NAME / "study.json"):
        path.parent.mkdir(parents=True)
        path.write_text("mine", encoding="utf-8")
        done = there.command("new-study", NAME)
        assert (done.returncode, path.read_text(encoding="utf-8")) == (2, "mine")
        assert "exists: choose another name" in done.stderr
        path.unlink()
        path.parent.rmdir()


def test_where_one_file_cannot_be_written_none_is(there) -> None:
    folder = there.root / "rkverify" / "ledger"
    before = snapshot(there)
    folder.chmod(0o555)
    try:
        done = there.python("-m", "rkverify", "new-study", NAME, "--about", "E1", anybody=True)
    finally:
        folder.chmod(0o755)
    assert done.returncode == 2
    assert "cannot write" in done.stderr
    assert snapshot(there) == before
    assert not (there.root / "tests").exists() or not any((there.root / "tests").rglob("*"))
