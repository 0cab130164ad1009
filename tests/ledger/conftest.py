"""The ledger's tests look at the whole checkout: its results, its entries, and the markers in its tests."""

import ast
from pathlib import Path

import pytest

from rkverify.ledger.entries import Entry
from rkverify.ledger.states import Evidence

ROOT = Path(__file__).resolve().parents[2]


def _ids(node: ast.AST) -> list[str]:
    """The ids in every `pytest.mark.decides("E1", …)` under a node of the syntax tree."""
    found = []
    for call in ast.walk(node):
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr == "decides":
            for argument in call.args:
                if not (isinstance(argument, ast.Constant) and isinstance(argument.value, str)):
                    raise ValueError(f"line {call.lineno}: write the ids of `decides` as plain strings")
                found.append(argument.value)
    return found


def _marked(body: list[ast.stmt], prefix: str, inherited: list[str]) -> list[tuple[str, str]]:
    """(id, node id) for every test in a module's or a class's body."""
    for statement in body:
        if isinstance(statement, ast.Assign) and any(getattr(t, "id", "") == "pytestmark" for t in statement.targets):
            inherited = inherited + _ids(statement.value)
    found = []
    for statement in body:
        own = [id for mark in getattr(statement, "decorator_list", []) for id in _ids(mark)]
        if isinstance(statement, ast.FunctionDef) and statement.name.startswith("test_"):
            found += [(id, f"{prefix}::{statement.name}") for id in inherited + own]
        elif isinstance(statement, ast.ClassDef):
            found += _marked(statement.body, f"{prefix}::{statement.name}", inherited + own)
    return found


def collected_markers(root: Path = ROOT) -> dict[str, list[str]]:
    """id -> the tests that say they decide it, as node ids without parameters, sorted."""
    found: dict[str, set[str]] = {}
    for path in sorted((root / "tests").rglob("*.py")):
        name = path.relative_to(root).as_posix()
        for id, test in _marked(ast.parse(path.read_text(encoding="utf-8"), name).body, name, []):
            found.setdefault(id, set()).add(test)
    return {id: sorted(tests) for id, tests in found.items()}


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def markers():
    """`collected_markers`, to be called."""
    return collected_markers


@pytest.fixture(scope="session")
def evidence():
    """A made-up statement: evidence(holds, reading="", layer="", routes=())."""

    def make(holds, reading="", layer="", routes=(), about=("C1",), study="made_up"):
        return Evidence(study, "name", about, f"says {holds}", holds, "all", "exact", None, "", layer, reading, routes)

    return make


@pytest.fixture(scope="session")
def entry():
    """A made-up entry: entry(kind, layers)."""

    def make(kind="result", layers=()):
        return Entry("C1", "nowhere", "made up", kind, "a test", layers, (), ())

    return make


if __name__ == "__main__":
    for name, tests in sorted(collected_markers().items(), key=lambda item: (item[0][0], int(item[0][1:]))):
        print(name, *tests)
