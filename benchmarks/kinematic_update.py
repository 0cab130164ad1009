"""Stages of a semi-Lagrangian kinematic update in the plane, from 1e3 to 1e6 nodes: time, growth, memory.

Neighbours, cells, shape functions with full gradients at the nodes, and the smoothed gradients of SCNI, on a jittered
lattice after a shear: order 1, R = 2, one thread, each size in a process of its own, best of some repeats. Then cells beside a
bare Delaunay triangulation by Qhull on the same nodes, alternating; and shape functions with the nodes numbered along the lattice's
lines, at random, and at random but sorted again. Writes reports/benchmarks/kinematic_update.csv, cells.csv, numbering.csv, .svg.

Numbered at random the shape functions of many nodes grow faster than their number. The sums are the same: what grows is the
way to neighbours that lie anywhere in memory, once the nodes no longer fit into the cache. Sorted by strips a support wide, the
same shuffled nodes take the time and the exponent of the lattice's own order: sort large sets before they are used.
"""

import json
import os
import resource
import subprocess
import sys
from itertools import pairwise
from math import log
from pathlib import Path
from statistics import median
from time import perf_counter, process_time

import numpy as np
import pandas as pd
from scipy.spatial import Delaunay

from rkverify.solid.cloud import cloud
from rkverify.solid.domain import polygon_domain
from rkverify.solid.gradients import scni
from rkverify.solid.neighbours import neighbours
from rkverify.solid.shape import shape
from rkverify.solid.voronoi import voronoi
from rkverify.workflow.style import LINES, new_figure

OUT = Path(__file__).resolve().parents[1] / "reports" / "benchmarks"
SIZES = (1_000, 10_000, 100_000, 1_000_000)
REPEATS = {1_000: 9, 10_000: 5, 100_000: 3, 1_000_000: 3}
STAGES = ("neighbours", "cells", "shape functions", "gradients")
SUPPORT, SHEAR, QHULL_NODES = 2.0, 0.2, 100_000
NUMBERINGS = ("along lines", "shuffled", "shuffled, then sorted")


def moved_lattice(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 2) near a square lattice, sheared, and the sheared outline of their domain."""
    side = round(count**0.5)
    x, y = (axis.ravel() + 0.5 for axis in np.meshgrid(np.arange(side, dtype=float), np.arange(side, dtype=float)))
    rng = np.random.default_rng(count)
    nodes = np.column_stack([x, y]) + rng.uniform(-0.2, 0.2, (side * side, 2))
    corners = np.array([(0, 0), (side, 0), (side, side), (0, side)], dtype=float)
    return tuple(places + SHEAR * places[:, 1:] * [1, 0] for places in (nodes, corners))


def stages(count: int) -> dict[str, float]:
    """Seconds of each stage, once."""
    places, corners = moved_lattice(count)
    nodes, domain = cloud(places, SUPPORT), polygon_domain([corners])
    times = [perf_counter()]
    known = neighbours(nodes, places)
    times.append(perf_counter())
    cells = voronoi(places, domain)
    times.append(perf_counter())
    there = shape(nodes, places, 1, "full", known)
    times.append(perf_counter())
    operator = scni(nodes, cells)
    times.append(perf_counter())
    del there, operator
    return {stage: after - before for stage, (before, after) in zip(STAGES, pairwise(times))}


def alone(count: int) -> None:
    """One size, in this process: best times and peak memory as JSON."""
    stages(400)  # compile
    taken = [stages(count) for _ in range(REPEATS[count])]
    best = {stage: min(one[stage] for one in taken) for stage in STAGES}
    print(json.dumps({**best, "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9}))


def beside_qhull(count: int, rounds: int = 5) -> dict[str, float]:
    """Medians of our cells and of scipy's Delaunay on the same nodes."""
    places, corners = moved_lattice(count)
    domain = polygon_domain([corners])
    voronoi(places[:400], domain)
    ours, theirs = [], []
    for _ in range(rounds):
        start = perf_counter()
        voronoi(places, domain)
        middle = perf_counter()
        Delaunay(places)
        ours.append(middle - start)
        theirs.append(perf_counter() - middle)
    return {"nodes": len(places), "cells": median(ours), "delaunay": median(theirs), "ratio": median(ours) / median(theirs)}  # fmt: skip


def numbered(places: np.ndarray, how: str) -> np.ndarray:
    """The same nodes in another order: as they lie, shuffled, or shuffled and then sorted by strips a support wide."""
    if how == "along lines":
        return places
    mixed = np.random.default_rng(1).permutation(places)
    if how == "shuffled":
        return mixed
    return mixed[np.lexsort([mixed[:, 0], np.floor(mixed[:, 1] / SUPPORT)])]


def by_numbering(count: int) -> dict[str, float]:
    """Least processor seconds of the shape functions for each numbering: the same sums, from other places in memory."""
    stages(400)  # compile
    found: dict[str, float] = {"nodes": count}
    for how in NUMBERINGS:
        places = numbered(moved_lattice(count)[0], how)
        nodes = cloud(places, SUPPORT)
        known = neighbours(nodes, places)
        taken = []
        for _ in range(REPEATS[count]):
            start = process_time()
            shape(nodes, places, 1, "full", known)
            taken.append(process_time() - start)
        found[how] = min(taken)
    return found


def in_process(*words: str) -> str:
    """What this file prints in a process of its own, with one thread."""
    quiet = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, __file__, *words], env=quiet, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def draw(table: pd.DataFrame) -> None:
    """Time and memory over the number of nodes."""
    figure = new_figure(6.8, 3.2)
    left, right = figure.subplots(1, 2)
    for stage, style in zip(STAGES, LINES):
        left.loglog(table["nodes"], table[stage], marker="o", markersize=3, label=stage, **style)
    left.set(xlabel="nodes  (1)", ylabel="time, one thread  (s)")
    left.legend(fontsize=8)
    right.semilogx(table["nodes"], table["memory"], marker="o", markersize=3, label="measured", **LINES[0])
    right.axhline(4, label="asked for at 1e6 nodes", **{**LINES[2], "linewidth": 1})
    right.set(xlabel="nodes  (1)", ylabel="peak memory of the process  (GB)", ylim=(0, 4.9))
    right.legend(fontsize=8)
    figure.savefig(OUT / "kinematic_update.svg", metadata={"Date": None})


def main() -> int:
    """Measure, print and write."""
    OUT.mkdir(parents=True, exist_ok=True)
    table = pd.DataFrame([{"nodes": count, **json.loads(in_process("--alone", str(count)))} for count in SIZES])
    table.to_csv(OUT / "kinematic_update.csv", index=False, float_format="%.4g")
    draw(table)
    print(table.to_string(index=False, float_format="%.4g"))
    few, many = (table[table["nodes"] == count].iloc[0] for count in (10_000, 1_000_000))
    for stage in STAGES:
        print(f"growth exponent from 1e4 to 1e6 nodes, {stage}: {log(many[stage] / few[stage]) / log(100):.2f}")
    qhull = pd.DataFrame([json.loads(in_process("--qhull", str(QHULL_NODES)))])
    qhull.to_csv(OUT / "cells.csv", index=False, float_format="%.4g")
    print(
        f"cells of {int(qhull['nodes'][0])} nodes: {qhull['ratio'][0]:.2f} times a bare Delaunay triangulation by Qhull"
    )
    order = pd.DataFrame([json.loads(in_process("--numbering", str(count))) for count in SIZES[1:]])
    order.to_csv(OUT / "numbering.csv", index=False, float_format="%.4g")
    print(order.to_string(index=False, float_format="%.4g"))
    for how in NUMBERINGS:
        exponent = log(order[how].iloc[-1] / order[how].iloc[0]) / log(SIZES[-1] / SIZES[1])
        print(f"growth exponent from 1e4 to 1e6 nodes, shape functions, nodes numbered {how}: {exponent:.2f}")
    return 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--alone"]:
        alone(int(sys.argv[2]))
    elif sys.argv[1:2] == ["--numbering"]:
        print(json.dumps(by_numbering(int(sys.argv[2]))))
    elif sys.argv[1:2] == ["--qhull"]:
        print(json.dumps(beside_qhull(int(sys.argv[2]))))
    else:
        sys.exit(main())
