"""The entries of the ledger, as the TOML files state them."""

import importlib
import pkgutil
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from rkverify.errors import UnknownName

FILES = ("equations.toml", "figures.toml", "claims.toml")
COUNTS = {"E": 87, "F": 8, "C": 75}


@dataclass(frozen=True)
class Entry:
    """One equation (E), figure (F) or claim (C): what it says, where, and what may decide it.

    kind: 'definition', 'result' or 'figure'. layers: the stability layers in which it needs a verdict, none where it
    is no statement about stability. studies and tests: its deciders, by name.
    """

    id: str
    place: str
    statement: str
    kind: str
    decided_by: str
    layers: tuple[str, ...]
    studies: tuple[str, ...]
    tests: tuple[str, ...]


@cache
def entries() -> dict[str, Entry]:
    """Every entry by its id, in the paper's order."""
    found = {}
    for name in FILES:
        data = tomllib.loads(files("rkverify.ledger").joinpath(name).read_text(encoding="utf-8"))
        for raw in data["entry"]:
            lists = {key: tuple(raw[key]) for key in ("layers", "studies", "tests")}
            found[raw["id"]] = Entry(**{**raw, **lists})
    return found


def entry(name: str) -> Entry:
    """The entry with this id.

    Raises UnknownName.
    """
    known = entries()
    if name.upper() not in known:
        raise UnknownName("entry", name, ["E1 to E87", "F1 to F8", "C1 to C75"])
    return known[name.upper()]


@cache
def transcriptions() -> dict[int, list[str]]:
    """Equation number -> the functions of `rkverify.paper` that transcribe it."""
    import rkverify.paper
    from rkverify.paper.numbered import TRANSCRIBED

    for module in pkgutil.iter_modules(rkverify.paper.__path__):
        importlib.import_module(f"rkverify.paper.{module.name}")
    return TRANSCRIBED
