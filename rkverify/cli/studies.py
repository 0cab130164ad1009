"""rkverify list, run, verify"""

import os
import sys
from argparse import Namespace

from rkverify.errors import BadInput
from rkverify.paths import checkout
from rkverify.workflow import records, runner
from rkverify.workflow.discovery import load
from rkverify.workflow.schedule import Outcome


def _processes(options: Namespace) -> int:
    if options.jobs is not None and options.jobs < 1:
        raise BadInput(f"--jobs {options.jobs}: ask for at least one process")
    return options.jobs or os.cpu_count() or 1


def show(options: Namespace) -> int:
    """List the studies."""
    place = checkout()
    for job in runner.jobs(place, []):
        record = records.last_run(place, job.name)
        state = "current" if job.is_current() else "changed" if record else "not run here"
        seconds = f"{record.seconds:6.1f} s" if record else "       -"
        print(f"{job.name:22} {state:13} {seconds}  {load(place, job.name).title}")
    return 0


def _tell(outcome: Outcome, done: str) -> int:
    for name, message in sorted(outcome.failed.items()):
        for line in message.splitlines():
            print(f"rkverify: {name}: {line}", file=sys.stderr)
    for complaint in outcome.complaints:
        print(f"rkverify: {complaint}", file=sys.stderr)
    print(f"{len(outcome.computed)} {done}, {len(outcome.current)} up to date, {len(outcome.failed)} failed")
    return outcome.status


def run(options: Namespace) -> int:
    """Run what is not current."""
    outcome = runner.run(checkout(), options.names, options.quick, _processes(options), options.force)
    return _tell(outcome, "computed")


def verify(options: Namespace) -> int:
    """Recompute and compare."""
    return _tell(runner.verify(checkout(), options.names, _processes(options)), "confirmed")
