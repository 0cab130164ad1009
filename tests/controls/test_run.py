"""A control decides something only where its check passes without the fault: a test that always fails would catch everything."""

from dataclasses import dataclass, field

from controls.faults import Fault
from controls.run import caught, failing_anyway
from controls.sandbox import FAILED, NO_SUCH_TEST, NOTHING_RUN, PASSED, Run


@dataclass
class Copy:
    """Stands for a copy of the checkout in which some checks fail, stopping at the first."""

    failing: frozenset[str]
    asked: list[str] = field(default_factory=list)

    def run(self, tests, seconds):
        self.asked += tests
        bad = [test for test in tests if test in self.failing]
        return Run(FAILED, 0.0, f"FAILED {bad[0]} - AssertionError") if bad else Run(PASSED, 0.0, "")


def fault(name, *checks):
    return Fault(name, "file.py", "x + 1", "x - 1", "a sign", "x", checks)


FAULTS = [
    fault("one", "tests/a.py::one", "tests/b.py"),
    fault("two", "tests/a.py::one"),
    fault("three", "tests/c.py::two"),
]


def test_every_check_is_run_once_without_a_fault():
    for count in (1, 2, 5):
        copies = [Copy(frozenset()) for _ in range(count)]
        assert failing_anyway(copies, FAULTS) == []
        assert sorted(check for copy in copies for check in copy.asked) == [
            "tests/a.py::one",
            "tests/b.py",
            "tests/c.py::two",
        ]


def test_a_check_that_fails_without_a_fault_is_named():
    copies = [Copy(frozenset({"tests/b.py"})) for _ in range(2)]
    assert failing_anyway(copies, FAULTS) == ["tests/b.py"]


def test_only_a_failed_check_catches():
    """Not one that could not be run, nor one that took too long, nor a name that is no test's."""
    assert [caught(Run(code, 0.0, "")) for code in (FAILED, PASSED, NO_SUCH_TEST, NOTHING_RUN, None)] == [True] + [
        False
    ] * 4
