"""What a study says of an equation is drawn from the lines that transcribe it.

Where those lines give wrong values, a statement that the equation holds must not be made any more. Otherwise it is a
statement about something else, and a mistake in the transcription would stay confirmed.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# study -> what makes it fast, and whether values are spoilt; in the others it is only looked at what is called, since
# machine algebra takes minutes over expressions that do not cancel.
STUDIES = {
    "shape_functions": {"smaller": {"nodes": 5, "digits": 10}, "orders": [1], "spoil": True},
    "material_rates": {"smaller": {"nodes": 5}, "orders": [1], "spoil": True},
    "gradients": {"smaller": {"nodes": 5, "support_twentieths": [30, 35]}, "orders": [], "spoil": True},
    "plane_kinematics": {"smaller": {"dimensions": [1], "points": [[1, 3]]}, "orders": [], "spoil": True},
    "figure4": {"smaller": {"support_ratios": ["1.5", "3.5"], "samples": 4}, "orders": [], "spoil": True},
    "printed_consequences": {"smaller": {}, "orders": [], "spoil": False},
    "derivation": {"smaller": {"support_ratios": ["8/5"]}, "orders": [], "spoil": False},
    "equations_in_the_plane": {"smaller": {}, "orders": [], "spoil": True},
    "two_routes": {"smaller": {}, "orders": [], "spoil": True},
    "convective_term": {"smaller": {"support_ratios": ["7/4"]}, "orders": [], "spoil": False},
    "stability_layers": {"smaller": {}, "orders": [], "spoil": False},
}
# Transcribed as data: (12) by the entry "cubic" of the kernels and (26) by a class; test_patches.py turns their lines.
DATA = {"E12", "E26"}


def told(study):
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    task = json.dumps({"study": study, **STUDIES[study]})
    done = subprocess.run(
        [sys.executable, Path(__file__).with_name("spoil.py"), task],
        cwd=ROOT,
        env={**kept, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("study", STUDIES)
def test_a_statement_on_an_equation_is_drawn_from_its_transcription(study):
    found = {entry: word for entry, word in told(study).items() if entry not in DATA}
    if STUDIES[study]["spoil"]:
        assert "noticed" in found.values(), "the spoiling itself does not work"
    assert {entry: word for entry, word in found.items() if word != "noticed"} == {}
