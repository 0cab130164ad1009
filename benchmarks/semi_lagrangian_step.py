"""One explicit step of the semi-Lagrangian equations in the plane: SCNI with cells rebuilt, and SNNI without cells, by stage.

A jittered block in motion, order 1, R = 2, N with the true rate, Truesdell's law, one thread, each size in a process of its own, best of some
repeats. Stages: cells, gradient operator, forces with masses and N, update of stress, velocities and positions. Writes
reports/benchmarks/semi_lagrangian_step.csv and .svg.
"""

import json
import os
import subprocess
import sys
from itertools import pairwise, product
from math import log
from pathlib import Path
from time import perf_counter

import numpy as np
import pandas as pd

from rkverify.solid.cloud import cloud
from rkverify.solid.domain import polygon_domain
from rkverify.solid.gradients import scni, snni
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.moving import Matter, Motion, advanced, forces
from rkverify.solid.voronoi import voronoi
from rkverify.workflow.style import LINES, new_figure

OUT = Path(__file__).resolve().parents[1] / "reports" / "benchmarks"
SIZES = (1_000, 10_000, 100_000)
REPEATS = {1_000: 7, 10_000: 5, 100_000: 3}
STAGES = ("cells", "gradients", "forces", "update")
SUPPORT = 2.0


def body(count: int, integration: str) -> tuple[Matter, Motion]:
    """A square block of about `count` nodes, boundary nodes on the boundary, turning."""
    side = round(count**0.5)
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side), indexing="ij"), axis=-1).reshape(-1, 2).astype(float)
    inner = ((grid > 0) & (grid < side - 1)).all(axis=1)
    grid[inner] += np.random.default_rng(count).uniform(-0.2, 0.2, (inner.sum(), 2))
    number = np.arange(side * side).reshape(side, side)
    ring = np.concatenate([number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1]])
    cells = voronoi(grid, polygon_domain([grid[ring]]))
    law = Truesdell(Moduli(1.0, 1.0))
    # Supports leave room for the corners of SNNI's boxes at the boundary.
    nodes = cloud(grid, SUPPORT * 1.1)
    outline = (ring,) if integration == "scni" else None
    matter = Matter(nodes, law, cells.measures.copy(), integration, "true", outline=outline)
    spin = 0.01 / side * np.stack([-grid[:, 1], grid[:, 0]], axis=1)
    return matter, Motion(grid, spin, law.start(len(grid), 2), cells.measures)


def stages(matter: Matter, motion: Motion) -> dict[str, float]:
    """Seconds of each stage, once."""
    nodes, times = matter.cloud.at(motion.x), [perf_counter()]
    cells = None
    if matter.outline is not None:
        cells = voronoi(motion.x, polygon_domain([motion.x[ring] for ring in matter.outline]))
    times.append(perf_counter())
    operator = snni(nodes, motion.measures) if cells is None else scni(nodes, cells)
    times.append(perf_counter())
    now = forces(matter, motion, operator)
    times.append(perf_counter())
    advanced(matter, motion, now, 1e-3)
    times.append(perf_counter())
    taken = {stage: after - before for stage, (before, after) in zip(STAGES, pairwise(times))}
    return {**taken, "whole": times[-1] - times[0]}


def alone(count: int, integration: str) -> None:
    """One size, in this process: best times as JSON."""
    stages(*body(400, integration))  # compile
    made = body(count, integration)
    taken = [stages(*made) for _ in range(REPEATS[count])]
    names = (*STAGES, "whole")
    print(json.dumps({"nodes": len(made[1].x), **{name: min(one[name] for one in taken) for name in names}}))


def in_process(*words: str) -> dict[str, float]:
    """What this file prints in a process of its own, with one thread."""
    quiet = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, __file__, *words], env=quiet, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def main() -> int:
    """Measure, print and write."""
    OUT.mkdir(parents=True, exist_ok=True)
    rows = [{"integration": i, **in_process("--alone", str(n), i)} for i, n in product(("scni", "snni"), SIZES)]
    table = pd.DataFrame(rows)
    table.to_csv(OUT / "semi_lagrangian_step.csv", index=False, float_format="%.4g")
    per_node = table.copy()
    per_node[[*STAGES, "whole"]] = table[[*STAGES, "whole"]].div(table["nodes"], axis=0) * 1e6
    print("microseconds for each node:")
    print(per_node.to_string(index=False, float_format="%.3g"))
    figure = new_figure(7.0, 3.2)
    for axes, integration in zip(figure.subplots(1, 2, sharey=True), ("scni", "snni")):
        part = per_node[per_node["integration"] == integration]
        for stage, style in zip(STAGES, LINES):
            if part[stage].max() > 0:
                axes.loglog(part["nodes"], part[stage], marker="o", markersize=3, label=stage, **style)
        axes.set(xlabel="nodes  (1)", title=integration.upper())
        axes.legend(fontsize=8)
    figure.axes[0].set_ylabel("time of a step for each node, one thread  (µs)")
    figure.savefig(OUT / "semi_lagrangian_step.svg", metadata={"Date": None})
    for integration in ("scni", "snni"):
        few, many = (table[(table["integration"] == integration) & (table["nodes"] > n)].iloc[0] for n in (5e3, 5e4))
        exponents = {
            stage: log(many[stage] / few[stage]) / log(many["nodes"] / few["nodes"])
            for stage in (*STAGES, "whole")
            if few[stage] > 1e-5
        }
        print(
            f"{integration}, growth exponent from 1e4 to 1e5 nodes:",
            ", ".join(f"{k} {v:.2f}" for k, v in exponents.items()),
        )
    return 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--alone"]:
        alone(int(sys.argv[2]), sys.argv[3])
    else:
        sys.exit(main())
