"""Run the catalogue: every fault in a copy of the checkout, with the tests that should catch it.

    python -m controls.run [--faults-alone] [WORD …]     faults whose id contains one of the words; all without

Every check is run without any fault first: one that fails then would catch anything, and nothing is tried. --faults-alone
leaves this out, where it has been done for the same sources and the same catalogue.
Prints fault -> check -> caught? -> seconds, writes reports/controls/controls.csv (without times, so that it does not change
from run to run) and ends with status 1 where a fault is not caught.
"""

import csv
import sys
import tempfile
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from controls.faults import Fault, catalogue
from controls.sandbox import FAILED, PASSED, ROOT, Run, Sandbox

WORKERS = 2
SECONDS = 300
"""For the checks of one fault; the slowest takes a tenth of it."""
SECONDS_WITHOUT = 3600
"""For all checks without a fault."""
TABLE = ROOT / "reports" / "controls" / "controls.csv"


def tried(box: Sandbox, fault: Fault) -> Run:
    """What the checks of a fault say with it."""
    text = (box.root / fault.file).read_text(encoding="utf-8")
    with box.patched(fault.file, fault.applied(text)):
        return box.run(fault.checks, SECONDS)


def failing_anyway(boxes: Sequence[Sandbox], faults: Iterable[Fault]) -> list[str]:
    """What fails without any fault, of the faults' checks: the first in each copy."""
    checks = sorted({check for fault in faults for check in fault.checks})
    shares = [checks[n :: len(boxes)] for n in range(len(boxes))]

    def one(box: Sandbox, share: Sequence[str]) -> str:
        run = box.run(share, SECONDS_WITHOUT) if share else Run(PASSED, 0.0, "")
        return "" if run.code == PASSED else run.first or f"pytest said {run.code}: {run.said[-300:]}"

    with ThreadPoolExecutor(len(boxes)) as pool:
        return [found for found in pool.map(one, boxes, shares) if found]


def all_tried(faults: Sequence[Fault], workers: int = WORKERS, alone: bool = False) -> list[tuple[Fault, Run]]:
    """The faults one after the other in as many copies as there are workers, a line printed for each.

    Before them, unless they are to be tried alone, all their checks without a fault.
    """
    with tempfile.TemporaryDirectory(prefix="rkverify-controls-") as folder:
        boxes = [Sandbox(Path(folder) / str(number)) for number in range(workers)]
        free: SimpleQueue[Sandbox] = SimpleQueue()
        for box in boxes:
            if not box.imports_itself():
                raise SystemExit("a copy of the checkout imports the checkout: nothing would be tested")
            free.put(box)
        failing = [] if alone else failing_anyway(boxes, faults)
        if failing:
            raise SystemExit("fails without any fault, and would catch anything: " + ", ".join(failing))

        def one(fault: Fault) -> tuple[Fault, Run]:
            box = free.get()
            try:
                run = tried(box, fault)
            finally:
                free.put(box)
            print(line(fault, run), flush=True)
            return fault, run

        with ThreadPoolExecutor(workers) as pool:
            done = list(pool.map(one, faults))
        for box in boxes:
            box.close()
        return done


def caught(run: Run) -> bool:
    """A check failed; one that could not be run catches nothing."""
    return run.code == FAILED


def line(fault: Fault, run: Run) -> str:
    """Fault -> check -> caught? -> seconds."""
    check = run.first.split("[")[0] if caught(run) and run.first else " ".join(fault.checks)
    word = "caught" if caught(run) else f"NOT CAUGHT (pytest said {run.code})"
    return f"{fault.id:45} -> {check.removeprefix('tests/'):95} -> {word} -> {run.seconds:5.1f} s"


def written(found: list[tuple[Fault, Run]]) -> None:
    """The table of all faults, without times."""
    TABLE.parent.mkdir(parents=True, exist_ok=True)
    with TABLE.open("w", encoding="utf-8", newline="") as handle:
        table = csv.writer(handle, lineterminator="\n")
        table.writerow(["fault", "file", "about", "what is wrong", "checks", "caught"])
        for fault, run in found:
            checks = " ".join(fault.checks)
            table.writerow([fault.id, fault.file, fault.about, fault.wrong, checks, "yes" if caught(run) else "no"])


def main(words: list[str]) -> int:
    """Run, print and write; the number of faults that are not caught, up to 1."""
    alone, words = "--faults-alone" in words, [word for word in words if word != "--faults-alone"]
    faults = [f for f in catalogue().faults if not words or any(word in f.id for word in words)]
    found = all_tried(faults, alone=alone)
    missed = [fault.id for fault, run in found if not caught(run)]
    print(
        f"{len(found) - len(missed)} of {len(found)} faults caught, {sum(r.seconds for _, r in found):.0f} s of tests"
    )
    if not words:
        written(found)
    if missed:
        print("not caught: " + ", ".join(missed))
    return int(bool(missed))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
