"""The catalogue of deliberate faults is about the code as it is: a fault that cannot be applied, or a check that is not there, shows nothing.

`make controls` runs it, which takes too long for every day.
"""

import ast
from dataclasses import replace
from pathlib import Path

import pytest

from controls.faults import Catalogue, Fault, catalogue, functions_with_faults, public_functions
from controls.sandbox import FAILED, PASSED, Sandbox

ROOT = Path(__file__).resolve().parents[2]
KNOWN = catalogue()


@pytest.mark.parametrize("file", sorted({fault.file for fault in KNOWN.faults}))
def test_every_fault_applies_and_is_a_program(file: str) -> None:
    text = (ROOT / file).read_text(encoding="utf-8")
    for fault in (fault for fault in KNOWN.faults if fault.file == file):
        spoilt = fault.applied(text)
        assert spoilt != text
        assert ast.dump(ast.parse(spoilt)) != ast.dump(ast.parse(text)), f"{fault.id} changes no code"


def test_a_fault_that_is_there_twice_or_not_at_all_is_refused() -> None:
    fault = Fault("one", "file.py", "x + 1", "x - 1", "a sign", "x", ())
    assert fault.applied("y = x + 1") == "y = x - 1"
    for text in ("y = x", "y = x + 1\nz = x + 1"):
        with pytest.raises(ValueError, match=r"one: file\.py has"):
            fault.applied(text)


def names_in(file: str) -> set[str]:
    return {
        node.name
        for node in ast.parse((ROOT / file).read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef)
    }


def test_every_named_check_exists() -> None:
    checks = {check for fault in KNOWN.faults for check in fault.checks}
    files = {file: names_in(file) for file in {check.partition("::")[0] for check in checks}}
    named = {check for check in checks if "::" in check}
    assert {c for c in named if c.partition("::")[2].partition("[")[0] not in files[c.partition("::")[0]]} == set()
    assert all(fault.checks for fault in KNOWN.faults)


def missing_and_unknown(known: Catalogue) -> tuple[set[str], set[str], set[str]]:
    """Public functions with neither fault nor reason; with both; and reasons for what is not there."""
    functions, faulty = set(public_functions(ROOT)), functions_with_faults(known.faults, ROOT)
    reasons = set(known.reasons)
    return functions - faulty - reasons, faulty & reasons, reasons - functions


def test_every_public_function_has_a_fault_or_a_reason_and_not_both() -> None:
    assert missing_and_unknown(KNOWN) == (set(), set(), set())


def test_a_function_without_either_and_a_reason_for_nothing_would_be_seen() -> None:
    name, *others = KNOWN.reasons
    changed = {**{other: KNOWN.reasons[other] for other in others}, "paper.shape.gone": "it is not there"}
    assert missing_and_unknown(replace(KNOWN, reasons=changed)) == ({name}, set(), {"paper.shape.gone"})


def test_an_id_begins_with_its_module() -> None:
    for fault in KNOWN.faults:
        module = fault.file.removeprefix("rkverify/").removesuffix(".py").replace("/", ".")
        assert fault.id.startswith(f"{module}."), fault.id


def test_a_sandbox_notices_a_fault_and_forgets_it(tmp_path: Path) -> None:
    """The fault must be in what the tests import, and must be gone for the next one: before, with it, after."""
    (fault,) = (fault for fault in KNOWN.faults if fault.id == "kernels.cubic-coefficient")
    box = Sandbox(tmp_path)
    text = (box.root / fault.file).read_text(encoding="utf-8")
    before = box.run(fault.checks, 60)
    with box.patched(fault.file, fault.applied(text)):
        during = box.run(fault.checks, 60)
    after = box.run(fault.checks, 60)
    box.close()
    assert (before.code, during.code, after.code) == (PASSED, FAILED, PASSED)
    assert during.first.startswith(fault.checks[0])
    assert (ROOT / fault.file).read_text(encoding="utf-8") == text
