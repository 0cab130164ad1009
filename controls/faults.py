"""The catalogue of deliberate faults, and which public functions they are in."""

import ast
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
COVERED = ("paper", "solid", "stability")
"""Packages of which every public function has a fault, or a reason why it has none."""


@dataclass(frozen=True)
class Fault:
    """`new` for `old` in `file` is wrong as `wrong` says, in what `about` names; one of `checks`, tests, must fail."""

    id: str
    file: str
    old: str
    new: str
    wrong: str
    about: str
    checks: tuple[str, ...]

    def applied(self, text: str) -> str:
        """The file's text with the fault. Raises ValueError where `old` does not occur exactly once."""
        if text.count(self.old) != 1:
            raise ValueError(f"{self.id}: {self.file} has {text.count(self.old)} times {self.old!r}")
        return text.replace(self.old, self.new)


@dataclass(frozen=True)
class Catalogue:
    """Faults in the order of their files, and reasons by the function (`paper.shape.inner`) that has no fault."""

    faults: tuple[Fault, ...]
    reasons: Mapping[str, str] = field(default_factory=dict)


def catalogue() -> Catalogue:
    """What stands under `controls/catalogue`. Raises ValueError for an id that is there twice."""
    faults: list[Fault] = []
    for path in sorted((HERE / "catalogue").glob("*.toml")):
        entries = tomllib.loads(path.read_text(encoding="utf-8"))["fault"]
        faults += [Fault(**{**entry, "checks": tuple(entry["checks"])}) for entry in entries]
    ids = [fault.id for fault in faults]
    double = sorted({id for id in ids if ids.count(id) > 1})
    if double:
        raise ValueError(f"ids that are there twice: {double}")
    groups = tomllib.loads((HERE / "without_fault.toml").read_text(encoding="utf-8"))["group"]
    return Catalogue(tuple(faults), {name: group["reason"] for group in groups for name in group["functions"]})


def public_functions(root: Path) -> dict[str, tuple[str, int, int]]:
    """name -> file, first and last line, for every public function and class at the top of a module that is covered."""
    found = {}
    for package in COVERED:
        for path in sorted((root / "rkverify" / package).rglob("*.py")):
            file = path.relative_to(root).as_posix()
            for node in ast.parse(path.read_text(encoding="utf-8")).body:
                if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                    module = file.removeprefix("rkverify/").removesuffix(".py").replace("/", ".")
                    found[f"{module}.{node.name}"] = (file, node.lineno, node.end_lineno or node.lineno)
    return found


def functions_with_faults(faults: tuple[Fault, ...], root: Path) -> set[str]:
    """The public functions and classes in which the text of a fault stands."""
    functions = public_functions(root)
    found = set()
    for fault in faults:
        text = (root / fault.file).read_text(encoding="utf-8")
        line = text[: text.index(fault.old)].count("\n") + 1
        found |= {
            name for name, (file, first, last) in functions.items() if file == fault.file and first <= line <= last
        }
    return found
