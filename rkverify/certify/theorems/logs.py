"""Theorems and their proof logs: what is claimed in a form that a machine reads, the steps, a hash over all of it."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

FORMAT = "rkverify proof log 1"


@dataclass(frozen=True)
class Theorem:
    """A proved statement: words with the ranges of its parameters, the claim as data, and the steps of its proof.

    method and steps describe the proof in a table; holds: whether it is the claim of the paper that is proved (True), or
    its opposite or a counterexample to it (False), None where the paper claims nothing; values: what was found, as text.
    """

    name: str
    words: str
    tried: str
    claim: dict[str, Any]
    proof: dict[str, Any]
    method: str
    steps: int
    holds: bool | None = None
    values: tuple[str, ...] = ()

    def data(self) -> dict[str, Any]:
        """As it stands in a log."""
        return {"name": self.name, "words": self.words, "claim": self.claim, "proof": self.proof}


def text(x: Any) -> str | int:
    """An exact rational as a log has it: a whole number, or text such as "-3/2"."""
    exact = x if isinstance(x, Fraction) else Fraction(int(x.p), int(x.q)) if hasattr(x, "q") else Fraction(int(x))
    return int(exact) if exact.denominator == 1 and abs(exact) < 10**15 else str(exact)


def texts(values: Sequence[Any]) -> list[str | int]:
    """A list of them."""
    return [text(x) for x in values]


def log(theorems: Sequence[Theorem]) -> str:
    """The log of these theorems, the same bytes for the same theorems."""
    content: dict[str, Any] = {"format": FORMAT, "theorems": [theorem.data() for theorem in theorems]}
    bare = json.dumps(content, sort_keys=True, ensure_ascii=False, separators=(",", ":"))
    content["sha256"] = hashlib.sha256(bare.encode()).hexdigest()
    lines = ",\n".join(
        json.dumps(theorem, sort_keys=True, ensure_ascii=False, separators=(",", ":"))
        for theorem in content["theorems"]
    )
    return f'{{"format":"{FORMAT}",\n"sha256":"{content["sha256"]}",\n"theorems":[\n{lines}\n]}}\n'
