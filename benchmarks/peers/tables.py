"""Node sets in, values out, for the scripts that run in the peers' environment (NumPy and the peers, nothing of rkverify).

The sets are jittered lattices of unit spacing, rounded to six decimals so that their text is exact; points lie away from
the ends, so that every polynomial fit is unisolvent.
"""

import csv
import hashlib
import sys
from collections.abc import Iterable, Sequence
from itertools import product
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "studies" / "data" / "peers"
"""What is committed."""
AXES = "xyz"
SETS = {"line": (1, 40, 30), "plane": (2, 15, 40), "box": (3, 6, 12)}
"""Dimension, nodes along an axis, points, of each set."""
JITTER, SEED = 0.2, 20061


def write_sets(into: Path) -> None:
    """nodes and points of every set; of the plane also nodes with supports a of their own, and points on some of them."""
    for number, (name, (d, n, points)) in enumerate(SETS.items()):
        rng = np.random.default_rng(SEED + number)
        nodes = np.array(list(product(range(n), repeat=d)), dtype=float)
        nodes = np.round(nodes + rng.uniform(-JITTER, JITTER, nodes.shape), 6)
        margin = 1.5
        places = np.round(rng.uniform(margin, n - 1 - margin, (points, d)), 6)
        _write(into / f"nodes_{name}.csv", AXES[:d], nodes)
        _write(into / f"points_{name}.csv", AXES[:d], places)
        if name == "plane":
            own = np.round(rng.uniform(1.9, 2.5, len(nodes)), 6)
            _write(into / "nodes_own.csv", [*AXES[:d], "a"], np.column_stack([nodes, own]))
            inside = np.flatnonzero(((nodes > margin) & (nodes < n - 1 - margin)).all(axis=1))
            chosen = np.sort(rng.choice(inside, points, replace=False))
            _write(into / "points_at_nodes.csv", [*AXES[:d], "a"], np.column_stack([nodes, own])[chosen])


def _write(file: Path, header: Sequence[str], rows: Iterable[Sequence[float]]) -> None:
    with file.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(list(header))
        writer.writerows([repr(float(cell)) for cell in row] for row in rows)


def read(name: str) -> tuple[np.ndarray, np.ndarray | None]:
    """Coordinates (N, d) of DATA/name.csv, and its column a where it has one."""
    with (DATA / f"{name}.csv").open(encoding="utf-8") as stream:
        header, *rows = list(csv.reader(stream))
    table = np.array(rows, dtype=float)
    return (table[:, :-1], table[:, -1]) if header[-1] == "a" else (table, None)


def write_values(into: Path, name: str, columns: Sequence[str], rows: Iterable[Sequence[float]]) -> None:
    """point, node and the given columns, sorted, without rows that are zero throughout; floats in full."""
    kept = sorted((int(r[0]), int(r[1]), *(float(v) for v in r[2:])) for r in rows if any(v != 0 for v in r[2:]))
    with (into / f"{name}.csv").open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["point", "node", *columns])
        writer.writerows([point, node, *(repr(v) for v in values)] for point, node, *values in kept)


def columns(d: int, values: bool = True) -> list[str]:
    """psi and its derivatives, as `rkverify shape` names them."""
    return ["psi"] * values + [f"dpsi_d{axis}" for axis in AXES[:d]]


def within(nodes: np.ndarray, place: np.ndarray, radius: float) -> np.ndarray:
    """The nodes nearer to the place than the radius, ascending."""
    return np.flatnonzero(((nodes - place) ** 2).sum(axis=1) < radius**2)


def digest(*names: str) -> str:
    """SHA-256 of the input tables."""
    return hashlib.sha256(b"".join((DATA / f"{name}.csv").read_bytes() for name in names)).hexdigest()


class Provenance:
    """One row for each table of values: which package made it, from what, and what was asked for."""

    HEADER = (
        "values",
        "package",
        "version",
        "quantity",
        "command",
        "nodes",
        "points",
        "support",
        "order",
        "input_sha256",
    )

    def __init__(self, into: Path, package: str, version: str) -> None:
        self.into, self.package, self.version = into, package, version
        self.rows: list[list[str]] = []

    def add(self, values: str, quantity: str, nodes: str, points: str, support: float | str, order: int) -> None:
        """Tell where a table comes from."""
        command = f"python benchmarks/peers/{Path(sys.argv[0]).name} FOLDER"
        told = [values, self.package, self.version, quantity, command, nodes, points, str(support), str(order)]
        self.rows.append([*told, digest(nodes, points)])

    def write(self) -> None:
        """Write what was told, for `run.py` to join."""
        with (self.into / f"provenance_{self.package}.csv").open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream, lineterminator="\n").writerows([self.HEADER, *self.rows])
