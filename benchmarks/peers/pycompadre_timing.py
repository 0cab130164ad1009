"""Time pycompadre's stencils for the values and the gradients at given nodes, neighbours given: one line of seconds for each line of input, for some repeats.

Run by benchmarks/shape_functions.py as `python pycompadre_timing.py CASE.npz`, in the peers' environment, with one thread.
"""

import sys
from time import perf_counter

import numpy as np
import pycompadre


def main(file: str) -> None:
    """Prepare everything but the solution, then solve once for every line."""
    case = np.load(file)
    nodes, starts, found = case["nodes"], case["starts"], case["neighbours"]
    gmls = pycompadre.GMLS(int(case["order"]), nodes.shape[1], str(case["solver"]), "STANDARD")
    helper = pycompadre.ParticleHelper(gmls)
    helper.generateKDTree(nodes)
    counts = np.diff(starts)
    table = np.zeros((len(nodes), 1 + counts.max()), dtype=np.int32)
    table[:, 0] = counts
    rows = np.repeat(np.arange(len(nodes)), counts)
    table[rows, 1 + np.arange(len(found)) - np.repeat(starts[:-1], counts)] = found
    helper.setTargetSites(nodes)
    helper.setNeighbors(table)
    radii = np.full(len(nodes), float(case["support"]))
    helper.setWindowSizes(radii)
    value = pycompadre.TargetOperation.ScalarPointEvaluation
    gradient = pycompadre.TargetOperation.GradientOfScalarPointEvaluation
    gmls.addTargets([value, gradient])
    gmls.setWeightingType("CardinalCubicBSpline")
    print("ready", flush=True)
    for _ in sys.stdin:
        start = perf_counter()
        for _ in range(int(case["repeats"])):
            gmls.generateAlphas(1, False)
        print(perf_counter() - start, flush=True)
    solution = gmls.getSolutionSet()
    last = len(nodes) // 2
    print(*(solution.getAlpha(value, last, 0, 0, k, 0, 0) for k in range(counts[last])), flush=True)


if __name__ == "__main__":
    kokkos = pycompadre.KokkosParser(False)
    main(sys.argv[1])
    del kokkos
