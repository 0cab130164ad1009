"""How a recomputed artefact is held against the committed one: exact, certified, numeric, visual.

Each comparison gives the list of places that left their tolerance, and by how much.
"""

import csv
import json
import math
import re
from abc import ABC, abstractmethod
from dataclasses import asdict, dataclass
from decimal import Decimal, InvalidOperation
from io import StringIO
from itertools import zip_longest
from typing import Any, ClassVar

CURVE = re.compile(r' d="([^"]*)"')
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclass(frozen=True)
class Difference:
    """One place where two versions of an artefact disagree by more than allowed."""

    place: str
    committed: str
    recomputed: str
    excess: str

    def __str__(self) -> str:
        return f"{self.place}: committed {self.committed}, recomputed {self.recomputed} ({self.excess})"


class Comparison(ABC):
    """A rule by which two versions of an artefact agree."""

    kind: ClassVar[str]

    @abstractmethod
    def differences(self, committed: str, recomputed: str) -> list[Difference]:
        """Where the two texts disagree by more than the rule allows."""

    def record(self) -> dict[str, Any]:
        """The rule as data, for the manifest."""
        return {"kind": self.kind, **asdict(self)}  # type: ignore[call-overload]


@dataclass(frozen=True)
class Exact(Comparison):
    """Byte for byte."""

    kind: ClassVar[str] = "exact"

    def differences(self, committed: str, recomputed: str) -> list[Difference]:
        """The first line that is not the same."""
        if committed == recomputed:
            return []
        pairs = zip_longest(committed.splitlines(), recomputed.splitlines(), fillvalue="(no line)")
        for number, (old, new) in enumerate(pairs, start=1):
            if old != new:
                return [Difference(f"line {number}", old[:80], new[:80], "must be the same byte for byte")]
        return [Difference("line ends", "", "", "must be the same byte for byte")]


def _cells(text: str) -> list[list[str]]:
    try:
        return list(csv.reader(StringIO(text)))
    except csv.Error as error:
        raise ValueError(f"no CSV: {error}") from None


def _shape(cells: list[list[str]]) -> str:
    widths = sorted({len(row) for row in cells})
    return f"{len(cells)} rows of {', '.join(map(str, widths))} cells, header {','.join(cells[0] if cells else [])}"


def _decimal(cell: str) -> Decimal | None:
    try:
        return Decimal(cell)
    except InvalidOperation:
        return None


class _ByCell(Comparison):
    def differences(self, committed: str, recomputed: str) -> list[Difference]:
        """The cells that disagree."""
        old, new = _cells(committed), _cells(recomputed)
        if [len(row) for row in old] != [len(row) for row in new] or old[:1] != new[:1]:
            return [Difference("shape or header", _shape(old), _shape(new), "must have the same cells")]
        found = []
        for number, (before, after) in enumerate(zip(old, new, strict=True)):
            for column, (a, b) in enumerate(zip(before, after, strict=True)):
                if a == b:
                    continue
                x, y = _decimal(a), _decimal(b)
                if x is None or y is None or not (x.is_finite() and y.is_finite()):
                    excess = "must be the same text"
                else:
                    excess = self.excess(x, y)
                if excess:
                    found.append(Difference(f"row {number}, column {old[0][column]}", a, b, excess))
        return found

    @abstractmethod
    def excess(self, committed: Decimal, recomputed: Decimal) -> str:
        """By how much two numbers disagree beyond the rule; empty where they agree."""


@dataclass(frozen=True)
class Certified(_ByCell):
    """Every printed digit is right to one unit of the last place: two prints agree to the shorter one's last place."""

    kind: ClassVar[str] = "certified"

    def excess(self, committed: Decimal, recomputed: Decimal) -> str:
        """More than one unit in the last common place."""
        places = max(int(committed.as_tuple().exponent), int(recomputed.as_tuple().exponent))
        unit = Decimal(1).scaleb(places)
        gap = abs(committed - recomputed)
        return "" if gap <= unit else f"apart by {gap / unit:.3g} units of the last certified place"


@dataclass(frozen=True)
class Numeric(_ByCell):
    """|a - b| <= atol + rtol |a| cell by cell, with the reason for the tolerance."""

    rtol: float
    atol: float
    why: str
    kind: ClassVar[str] = "numeric"

    def excess(self, committed: Decimal, recomputed: Decimal) -> str:
        """The factor by which the tolerance is passed."""
        allowed = Decimal(self.atol) + Decimal(self.rtol) * abs(committed)
        gap = abs(committed - recomputed)
        if gap <= allowed:
            return ""
        return f"apart by {float(gap):.3g}, allowed {float(allowed):.3g}"


def _rectangle(curve: str) -> str:
    """The least and the largest x and y of a curve's points."""
    numbers = [float(n) for n in NUMBER.findall(curve)]
    x, y = numbers[::2], numbers[1::2]
    return f"{min(x)} {max(x)} {min(y)} {max(y)}" if x and y else ""


@dataclass(frozen=True)
class Visual(Comparison):
    """The same drawing: text and elements alike, and every number in it within a tolerance.

    A curve of another number of points, as where rounding moves the border of a map, must fill the same rectangle.
    """

    tolerance: float
    why: str
    kind: ClassVar[str] = "visual"

    def differences(self, committed: str, recomputed: str) -> list[Difference]:
        """The first place where the drawings differ."""
        old, new = self._comparable(committed, recomputed)
        if NUMBER.sub("#", old) != NUMBER.sub("#", new):
            return [Difference("structure", "", "", "the drawings have different elements or words")]
        for place, (a, b) in enumerate(zip(NUMBER.findall(old), NUMBER.findall(new), strict=True)):
            gap = abs(float(a) - float(b))
            if gap > self.tolerance:
                return [Difference(f"number {place}", a, b, f"apart by {gap:.3g}, allowed {self.tolerance:.3g}")]
        return []

    @staticmethod
    def _comparable(committed: str, recomputed: str) -> tuple[str, str]:
        """The drawings with the rectangle in place of each curve that has another number of points in the other."""
        curves = [CURVE.findall(text) for text in (committed, recomputed)]
        if len(curves[0]) != len(curves[1]):
            return committed, recomputed
        redrawn = [NUMBER.sub("#", a) != NUMBER.sub("#", b) for a, b in zip(*curves, strict=True)]

        def rectangles(text: str) -> str:
            each = iter(redrawn)
            return CURVE.sub(lambda m: f' d="{_rectangle(m[1])}"' if next(each) else m[0], text)

        return rectangles(committed), rectangles(recomputed)


@dataclass(frozen=True)
class Record(Comparison):
    """A record of values and sentences: the same words, and numbers within a relative tolerance."""

    rtol: float
    why: str
    kind: ClassVar[str] = "record"

    def differences(self, committed: str, recomputed: str) -> list[Difference]:
        """The entries that disagree."""
        return list(self._walk("", json.loads(committed), json.loads(recomputed)))

    def _walk(self, place: str, a: Any, b: Any) -> list[Difference]:
        if isinstance(a, dict) and isinstance(b, dict) and a.keys() == b.keys():
            return [d for key in a for d in self._walk(f"{place}.{key}".lstrip("."), a[key], b[key])]
        if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
            return [d for n, (p, q) in enumerate(zip(a, b, strict=True)) for d in self._walk(f"{place}[{n}]", p, q)]
        if self._same(a, b):
            return []
        return [Difference(place or "record", str(a)[:120], str(b)[:120], self._excess(a, b))]

    def _excess(self, a: Any, b: Any) -> str:
        pairs = zip(NUMBER.findall(str(a)), NUMBER.findall(str(b)), strict=False)
        gaps = [abs(float(x) - float(y)) / max(abs(float(x)), abs(float(y))) for x, y in pairs if not self._close(x, y)]
        if not gaps or NUMBER.sub("#", str(a)) != NUMBER.sub("#", str(b)):
            return "must be the same but for numbers"
        return f"apart by {max(gaps):.3g} of the larger, allowed {self.rtol:.3g}"

    def _same(self, a: Any, b: Any) -> bool:
        if isinstance(a, str) and isinstance(b, str):
            words = NUMBER.sub("#", a) == NUMBER.sub("#", b)
            return words and all(map(self._close, NUMBER.findall(a), NUMBER.findall(b)))
        if isinstance(a, float) and isinstance(b, float):
            return self._close(a, b)
        return type(a) is type(b) and bool(a == b)

    def _close(self, a: str | float, b: str | float) -> bool:
        x, y = float(a), float(b)
        if not (math.isfinite(x) and math.isfinite(y)):
            return str(x) == str(y)
        return abs(x - y) <= self.rtol * max(abs(x), abs(y))
