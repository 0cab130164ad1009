"""Mutation score of paper/, solid/ and stability/ on a seeded, stratified sample of mutants, without numba's compiler.

    python -m controls.mutants [--count N] [--seed S] [--minutes M] [--workers W] [--again]

The mutants are made by Cosmic Ray (`mutate.py`). Each runs, in a copy of the checkout, the tests of its own module alone:
those that the catalogue names for it, then those of tests_of.toml. Survivors that `equivalent.toml` explains stay in the
sample and count as survivors; the score without them is given beside. Results go to reports/controls/mutants.csv; a run
that is interrupted goes on where it stopped, as long as the sources are the same. With --again survivors whose tests have
changed since run once more, and the newer outcome counts.
"""

import argparse
import csv
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from scipy.stats import binomtest

from controls.faults import COVERED, HERE, catalogue
from controls.sandbox import ROOT, Sandbox

PYTHON = ROOT / ".venv-mutants" / "bin" / "python"
TABLE = ROOT / "reports" / "controls" / "mutants.csv"
KEPT = ROOT / ".rkverify" / "mutants"
SECONDS = 100
"""Of the processor, for the tests of one mutant: one that takes longer than all of them together hangs."""
LEVEL = 0.95
MUTANT = ("file", "line", "operator", "old", "new")
COLUMNS = (*MUTANT, "first", "outcome", "test", "reason")

Entry = dict[str, Any]


def sources() -> list[str]:
    """The files whose mutants are looked at."""
    found = [p for package in COVERED for p in sorted((ROOT / "rkverify" / package).rglob("*.py"))]
    return [p.relative_to(ROOT).as_posix() for p in found if p.name != "__init__.py"]


def sampled(count: int, seed: int) -> dict[str, Any]:
    """The sample, from Cosmic Ray in its own environment."""
    command = [PYTHON, HERE / "mutate.py", ROOT, str(seed), str(count), *sources()]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def tests_of(file: str) -> list[str]:
    """Tests of a module, the quickest to tell first."""
    known = tomllib.loads((HERE / "tests_of.toml").read_text(encoding="utf-8"))
    place = file.removeprefix("rkverify/").removesuffix(".py")
    named = [check for fault in catalogue().faults if fault.file == file for check in fault.checks]
    more = known[max((name for name in known if place.startswith(name)), key=len)]
    return list(dict.fromkeys([*named, *more]))


def state_of(tests: list[str]) -> str:
    """A hash of the tests and of what is written in their files."""
    paths = [ROOT / test.split("::")[0] for test in tests]
    files = sorted({file for path in paths for file in (path.rglob("*.py") if path.is_dir() else [path])})
    texts = [file.read_bytes() for file in files if file.exists()]
    return hashlib.sha256("\n".join(tests).encode() + b"\n".join(texts)).hexdigest()[:16]


def kept_in(log: Path) -> dict[tuple[Any, ...], Entry]:
    """The entry of each mutant that has run, the newest where it ran more than once; `first`: what came out at first.

    Tests that were written for a survivor say little about other mutants: the score without them is the first one's.
    """
    found: dict[tuple[Any, ...], Entry] = {}
    for entry in map(json.loads, log.read_text(encoding="utf-8").splitlines() if log.exists() else []):
        before = found.get(identity(entry), entry)
        found[identity(entry)] = entry | {"first": before.get("first", before["outcome"])}
    return found


def identity(mutant: Entry) -> tuple[Any, ...]:
    """What tells a mutant from the others."""
    return tuple(mutant[column] for column in MUTANT)


def is_due(mutant: Entry, known: dict[tuple[Any, ...], Entry], again: bool) -> bool:
    """Whether a mutant has not run yet or, where survivors run again, has survived other tests than it has now."""
    entry = known.get(identity(mutant))
    if entry is None:
        return True
    return again and entry["outcome"] == "survived" and entry.get("tests") != state_of(tests_of(mutant["file"]))


def explained() -> dict[tuple[str, str, str], str]:
    """(file, line before, line after) -> why no test can tell the mutant from the program."""
    entries = tomllib.loads((HERE / "equivalent.toml").read_text(encoding="utf-8")).get("mutant", [])
    return {(entry["file"], entry["old"].strip(), entry["new"].strip()): entry["reason"] for entry in entries}


def outcome(box: Sandbox, mutant: dict[str, Any]) -> tuple[str, str, float]:
    """killed, timeout or survived; by which test; seconds."""
    with box.patched(mutant["file"], mutant["text"]):
        run = box.run(tests_of(mutant["file"]), SECONDS)
    word = "survived" if not run.noticed else "timeout" if run.code is None else "killed"
    return word, run.first, run.seconds


def described(results: list[dict[str, Any]]) -> str:
    """The score with its interval, Clopper and Pearson, and that without the mutants that are explained."""
    lines = []
    for name in ("", *COVERED):
        part = [r for r in results if r["file"].startswith(f"rkverify/{name}")]
        at_first, now = (sum(r[when] != "survived" for r in part) for when in ("first", "outcome"))
        same = sum(bool(r["reason"]) for r in part)
        for what, dead, all_of in (
            ("all, when first run", at_first, len(part)),
            ("all", now, len(part)),
            ("without equivalent ones", now, len(part) - same),
        ):
            if all_of:
                bounds = binomtest(dead, all_of).proportion_ci(LEVEL, method="exact")
                lines.append(
                    f"{name or 'whole sample':12} {what:24} {dead} of {all_of} killed: {dead / all_of:.1%} "
                    f"({bounds.low:.1%} to {bounds.high:.1%})"
                )
    return "\n".join(lines)


def main() -> int:
    """Run the sample as far as time permits, print the score and the survivors."""
    options = argparse.ArgumentParser(description="mutation score")
    options.add_argument("--count", type=int, default=320)
    options.add_argument("--seed", type=int, default=2)
    options.add_argument("--minutes", type=float, default=600.0)
    options.add_argument("--workers", type=int, default=1, help="copies of the checkout that run at a time")
    options.add_argument("--again", action="store_true", help="run survivors again whose tests have changed")
    chosen = options.parse_args()
    os.nice(10)
    sample = sampled(chosen.count, chosen.seed)
    texts = "".join((ROOT / file).read_text(encoding="utf-8") for file in sources())
    key = hashlib.sha256(f"{chosen.seed} {chosen.count} {texts}".encode()).hexdigest()[:16]
    KEPT.mkdir(parents=True, exist_ok=True)
    log = KEPT / f"{key}.jsonl"
    known = kept_in(log)
    print(f"{len(sample['sample'])} mutants at {sample['places']} places in {sample['files']} files, {len(known)} done")
    until = time.monotonic() + 60 * chosen.minutes
    left = sample["sample"][:]
    # Files take turns, so that a part of the sample is one of all of them.
    left.sort(key=lambda m: hashlib.sha256(f"{m['file']} {m['place']} {m['operator']}".encode()).hexdigest())
    due = [mutant for mutant in left if is_due(mutant, known, chosen.again)]
    with (
        tempfile.TemporaryDirectory(prefix="rkverify-mutants-") as folder,
        log.open("a", encoding="utf-8") as kept,
        ThreadPoolExecutor(chosen.workers) as pool,
    ):
        boxes: SimpleQueue[Sandbox] = SimpleQueue()
        for worker in range(chosen.workers):
            boxes.put(Sandbox(Path(folder) / str(worker)))

        def run(mutant: Entry) -> tuple[str, str, float] | None:
            if time.monotonic() > until:
                return None
            box = boxes.get()
            try:
                return outcome(box, mutant)
            finally:
                boxes.put(box)

        for number, (mutant, found) in enumerate(zip(due, pool.map(run, due), strict=True)):
            if found is None:
                print(f"time is up after {number} of {len(due)} mutants")
                break
            word, test, seconds = found
            first = known[identity(mutant)]["first"] if identity(mutant) in known else word
            entry = {k: mutant[k] for k in MUTANT} | {"outcome": word, "test": test, "first": first}
            known[identity(mutant)] = entry | {"tests": state_of(tests_of(mutant["file"]))}
            kept.write(json.dumps(known[identity(mutant)]) + "\n")
            kept.flush()
            print(f"{number + 1:4} {word:9} {mutant['file']}:{mutant['line']} {test} {seconds:.1f} s", flush=True)
        for _ in range(chosen.workers):
            boxes.get().close()
    results = list(known.values())
    reasons = explained()
    for entry in results:
        place = (entry["file"], entry["old"].strip(), entry["new"].strip())
        entry["reason"] = reasons.get(place, "") if entry["outcome"] == "survived" else ""
    TABLE.parent.mkdir(parents=True, exist_ok=True)
    with TABLE.open("w", encoding="utf-8", newline="") as handle:
        table = csv.DictWriter(handle, COLUMNS, lineterminator="\n", extrasaction="ignore")
        table.writeheader()
        table.writerows(sorted(results, key=lambda e: (e["file"], e["line"], e["operator"])))
    for entry in results:
        if entry["outcome"] == "survived":
            print(
                f"survived: {entry['file']}:{entry['line']} {entry['operator']}\n  - {entry['old']}\n  + {entry['new']}"
            )
            print(f"  {entry['reason'] or 'UNEXPLAINED'}")
    print(described(results))
    return int(any(e["outcome"] == "survived" and not e["reason"] for e in results))


if __name__ == "__main__":
    sys.exit(main())
