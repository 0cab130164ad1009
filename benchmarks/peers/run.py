"""Compute the peers' numbers anew and say whether they agree with the committed ones in studies/data/peers.

Run in the peers' environment. What agrees to AGREEMENT of the largest number in a column is left as it is committed;
anything else is written over it. Status 1 where something was written.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from tables import DATA, write_sets

AGREEMENT = 1e-12
"""Of the largest number: another processor's order of sums leaves some 1e-15 times the condition number, at most 1e3."""
SCRIPTS = ("pycompadre_values.py", "wlsqm_values.py", "pysph_values.py")
HERE = Path(__file__).resolve().parent


def apart(committed: Path, computed: Path) -> float:
    """The largest difference of two tables over the largest number of its column; infinite for other rows or words."""
    if not committed.exists():
        return float("inf")
    old, new = ([*csv.reader(file.open(encoding="utf-8"))] for file in (committed, computed))
    if old == new:
        return 0.0
    try:
        one, other = (np.array([[float(cell) for cell in row] for row in table[1:]]) for table in (old, new))
    except ValueError:
        return float("inf")
    if old[0] != new[0] or one.shape != other.shape:
        return float("inf")
    return float((abs(one - other).max(axis=0) / np.maximum(abs(one).max(axis=0), 1e-300)).max())


def main() -> int:
    """Inputs first, since the scripts read them; then every script."""
    DATA.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        into = Path(folder)
        write_sets(into)
        changed = _keep(into, "inputs")
        for script in SCRIPTS:
            subprocess.run([sys.executable, str(HERE / script), folder], check=True)
            changed += _keep(into, script)
        told = sorted(into.glob("provenance_*.csv"))
        rows = [line for file in told for line in file.read_text(encoding="utf-8").splitlines()[1:]]
        header = told[0].read_text(encoding="utf-8").splitlines()[0]
        (into / "provenance.csv").write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
        changed += _keep(into, "provenance")
    print(f"{changed} tables written" if changed else "everything agrees with what is committed")
    return 1 if changed else 0


def _keep(into: Path, source: str) -> int:
    changed = 0
    for file in sorted(into.glob("*.csv")):
        if file.name.startswith("provenance_"):
            continue
        gap = apart(DATA / file.name, file)
        if gap > AGREEMENT:
            print(f"{file.name}: differs by {gap:.1e} from what is committed, or is new: written ({source})")
            (DATA / file.name).write_bytes(file.read_bytes())
            changed += 1
        file.unlink()
    return changed


if __name__ == "__main__":
    sys.exit(main())
