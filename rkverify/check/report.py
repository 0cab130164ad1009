"""What a check has found, as data and as text for a person."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from textwrap import wrap
from typing import Any


@dataclass(frozen=True)
class Finding:
    """One thing that was checked: what, whether it holds, the size found, the bound it is held to, and the words for it."""

    name: str
    holds: bool
    says: str
    size: float | None = None
    bound: float | None = None


@dataclass(frozen=True)
class Place:
    """The largest difference from ours: where, both numbers, and the bound there."""

    row: int
    node: int
    column: str
    theirs: float
    ours: float
    bound: float


@dataclass(frozen=True)
class Report:
    """Findings in the order in which they were made, what the numbers are, what to do, and the largest difference from ours.

    rows: what a row is, a point or a cell. cause: what explains the numbers where they are not as claimed.
    """

    subject: str
    rows: str
    findings: tuple[Finding, ...]
    cause: str
    advice: tuple[str, ...]
    largest: Place | None

    @property
    def passed(self) -> bool:
        """Whether everything holds."""
        return all(finding.holds for finding in self.findings)

    @property
    def verdict(self) -> str:
        """One plain sentence."""
        if self.passed:
            return f"PASS: {self.subject} as claimed."
        return f"FAIL: {self.cause}"

    def data(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return {
            "passed": self.passed,
            "verdict": self.verdict,
            "findings": [asdict(finding) for finding in self.findings],
            "largest_difference": None if self.largest is None else asdict(self.largest),
            "advice": list(self.advice),
        }

    def text(self, width: int = 110) -> str:
        """Everything, for reading."""
        lines = []
        for finding in self.findings:
            lines += _wrapped(f"{'ok    ' if finding.holds else 'FAILS '} {finding.says}", width)
        if self.largest is not None:
            p = self.largest
            lines += _wrapped(
                f"largest difference from ours, for its bound: {self.rows} {p.row}, node {p.node}, {p.column}: yours {p.theirs:.12g}, ours "
                f"{p.ours:.12g}, apart {abs(p.theirs - p.ours):.1e}, allowed {p.bound:.1e}",
                width,
            )
        lines += ["", *_wrapped(self.verdict, width)]
        for step in self.advice:
            lines += _wrapped(f"-> {step}", width)
        return "\n".join(lines)


def _wrapped(text: str, width: int) -> list[str]:
    return wrap(text, width, subsequent_indent="       ", break_long_words=False, break_on_hyphens=False)


def digits(size: float) -> str:
    """The size of a difference in two figures.

    >>> digits(0.0), digits(0.0123)
    ('0', '1.2e-02')
    """
    return f"{size:.1e}" if size else "0"


def listed(words: Sequence[str], most: int = 5) -> str:
    """Words with commas, the first few of many.

    >>> listed(["a", "b"]), listed(list("abcdefgh"), 3)
    ('a and b', 'a, b, c and 5 more')
    """
    shown = [*words[:most], f"{len(words) - most} more"] if len(words) > most else list(words)
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"
