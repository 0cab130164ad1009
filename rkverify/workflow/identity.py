"""What a study's results depend on: the sources it imports, directly or not, its parameters and the lock."""

import hashlib
import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import grimp
import grimp.exceptions

from rkverify.errors import BadInput
from rkverify.paths import Checkout

PACKAGES = ("rkverify", "studies")
WRITER = "rkverify.workflow.produce"
"""Writes every artefact: its sources belong to the identity of all studies."""


def digest(data: bytes) -> str:
    """The SHA-256 of data, in hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def canonical(data: Any) -> str:
    """Data as JSON text that is the same for the same data."""
    return json.dumps(data, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


@dataclass(frozen=True)
class Identity:
    """The hash of everything that a study's results depend on, and the hashes of its parts."""

    total: str
    modules: dict[str, str]
    parameters: dict[str, Any]
    lock: str


class Sources:
    """The import graph of a checkout and the hashes of its files."""

    def __init__(self, place: Checkout) -> None:
        if str(place.root) not in sys.path:
            sys.path.insert(0, str(place.root))
        self.place = place
        try:
            self.graph = grimp.build_graph(*PACKAGES, cache_dir=None, exclude_type_checking_imports=True)
        except grimp.exceptions.SourceSyntaxError as error:
            raise BadInput(f"a module cannot be read: {error}") from None
        self._hashes: dict[str, str] = {}

    def closure(self, module: str) -> set[str]:
        """The module and all that it imports: directly, through others, and as parents, whose code runs first."""
        found: set[str] = set()
        waiting = [module]
        while waiting:
            name = waiting.pop()
            if name in found:
                continue
            found.add(name)
            waiting += self.graph.find_modules_directly_imported_by(name)
            if "." in name:
                waiting.append(name.rpartition(".")[0])
        return found

    def file(self, module: str) -> Path:
        """The file of a module."""
        path = self.place.root.joinpath(*module.split("."))
        return path.with_suffix(".py") if path.with_suffix(".py").is_file() else path / "__init__.py"

    def hash(self, module: str) -> str:
        """The hash of a module's source."""
        if module not in self._hashes:
            self._hashes[module] = digest(self.file(module).read_bytes())
        return self._hashes[module]

    def identity(self, name: str, parameters: Any) -> Identity:
        """The identity of a study with these parameters."""
        closure = self.closure(f"studies.{name}") | self.closure(WRITER)
        modules = {module: self.hash(module) for module in sorted(closure)}
        try:
            values = json.loads(json.dumps(asdict(parameters)))
        except TypeError as error:
            raise BadInput(f"studies/{name}.py: its parameters are no dataclass of plain values: {error}") from None
        lock = digest(self.place.lock.read_bytes())
        return Identity(digest(canonical([modules, values, lock]).encode()), modules, values, lock)
