"""Numbers of other packages in studies/data/peers, with their provenance; benchmarks/peers computes them."""

import csv
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np

from rkverify.check.claim import Claim
from rkverify.check.entries import Entries, entries
from rkverify.errors import BadInput
from rkverify.paths import checkout
from rkverify.solid.cloud import cloud
from rkverify.solid.kernel_values import Array


@dataclass(frozen=True)
class PeerTable:
    """One table of theirs with the provenance row that belongs to it."""

    name: str
    package: str
    version: str
    quantity: str
    claim: Claim
    theirs: Entries
    radius: float | None


def folder() -> Path:
    """Where the numbers are."""
    return checkout().studies / "data" / "peers"


def fingerprint() -> str:
    """SHA-256 of all files with their names, so that a study depends on them."""
    digest = sha256()
    for file in sorted(folder().glob("*.csv")):
        digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()


def _rows(name: str) -> tuple[list[str], list[list[str]]]:
    with (folder() / f"{name}.csv").open(encoding="utf-8") as stream:
        header, *rows = list(csv.reader(stream))
    return header, rows


def _points(name: str) -> tuple[Array, Array | None]:
    header, rows = _rows(name)
    table = np.array(rows, dtype=float)
    return (table[:, :-1], table[:, -1]) if header[-1] == "a" else (table, None)


def peer_tables() -> list[PeerTable]:
    """Every table, with the nominal claim: full derivatives, cubic kernel, supports owned by the nodes.

    Raises BadInput where a table was made from other nodes or points than those in the folder.
    """
    header, rows = _rows("provenance")
    found = []
    for told in (dict(zip(header, row, strict=True)) for row in rows):
        inputs = [folder() / f"{told[key]}.csv" for key in ("nodes", "points")]
        if sha256(b"".join(file.read_bytes() for file in inputs)).hexdigest() != told["input_sha256"]:
            raise BadInput(f"{told['values']}.csv was computed from other nodes or points: run `make peers`")
        (nodes, own), (points, at_points) = _points(told["nodes"]), _points(told["points"])
        radius = None if told["support"] == "own" else float(told["support"])
        supports = own if radius is None else radius
        claimed = cloud(nodes, supports, order=int(told["order"]))
        columns, values = _rows(told["values"])
        table = np.array(values, dtype=float)
        ids = table[:, :2].astype(np.int64)
        theirs = entries(ids[:, 0], ids[:, 1], table[:, 2:], columns[2:], len(points), len(nodes))
        claim = Claim(claimed, points, point_supports=at_points)
        found.append(
            PeerTable(told["values"], told["package"], told["version"], told["quantity"], claim, theirs, radius)
        )
    return found
