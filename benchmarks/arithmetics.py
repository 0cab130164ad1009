"""How much the arithmetics cost beside float, in one run: shape functions and gradients by the literal transcription.

Writes reports/benchmarks/arithmetics.csv: median seconds for each point and the ratio to float, rounds interleaved.
"""

import sys
from pathlib import Path
from statistics import median
from time import perf_counter

import pandas as pd

from rkverify.arithmetic.base import Arithmetic
from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.named import arithmetic
from rkverify.paper.approximation import approximation
from rkverify.paper.shape import shape_functions, shape_gradient

ROUNDS, NODES = 15, 24
OUT = Path(__file__).resolve().parents[1] / "reports" / "benchmarks" / "arithmetics.csv"


def seconds(K: Arithmetic, order: int) -> float:
    """Time for shape functions and gradients at one point of NODES nodes."""
    A = approximation([[f"{j}/{NODES}"] for j in range(NODES)], f"5/{2 * NODES}", K, order=order)
    x = A.point("10/21")
    start = perf_counter()
    shape_functions(A, x)
    shape_gradient(A, x)
    return perf_counter() - start


def main() -> int:
    """Measure and write."""
    fields = [arithmetic(name) for name in ("float", "exact", "mp:30", "mp:100", "ball:30")]
    fields.append(Duals(fields[0], 1))
    samples: dict[tuple[str, int], list[float]] = {}
    for _ in range(ROUNDS):
        for order in (0, 1, 2):
            for K in fields:
                samples.setdefault((K.name, order), []).append(seconds(K, order))
    rows = [
        {
            "arithmetic": name,
            "order": order,
            "seconds": median(t),
            "ratio_to_float": median(t) / median(samples["float", order]),
        }
        for (name, order), t in samples.items()
    ]
    OUT.parent.mkdir(parents=True, exist_ok=True)
    table = pd.DataFrame(rows)
    table.to_csv(OUT, index=False, float_format="%.4g")
    print(table.to_string(index=False, float_format="%.4g"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
