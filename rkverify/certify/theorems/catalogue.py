"""All theorems, proved: their logs, their rows in a table; a proof that fails is kept with its reason."""

from dataclasses import dataclass
from functools import cache
from typing import Any

from rkverify.certify.theorems.families import FAMILIES, SMOOTH
from rkverify.certify.theorems.isolation import NotProved
from rkverify.certify.theorems.logs import Theorem, log


@dataclass(frozen=True)
class Failed:
    """A theorem that could not be proved, and why."""

    name: str
    why: str


@dataclass(frozen=True)
class Proofs:
    """What came of a family's theorems."""

    proved: tuple[Theorem, ...]
    failed: tuple[Failed, ...]

    def log(self) -> str:
        """The proof log of the family."""
        return log(self.proved)


@cache
def prove(family: str) -> Proofs:
    """Every theorem of a family, proved or with the reason why not."""
    proved, failed = [], []
    for name, theorem in FAMILIES[family]().items():
        try:
            proved.append(theorem())
        except NotProved as error:
            failed.append(Failed(name, str(error)))
    return Proofs(tuple(proved), tuple(failed))


def rows(families: tuple[str, ...]) -> list[dict[str, Any]]:
    """Every theorem as a row of a table."""
    verdict = {True: "holds", False: "fails", None: ""}
    found: list[dict[str, Any]] = []
    for family in families:
        proofs = prove(family)
        found += [
            {
                "family": family,
                "theorem": t.name,
                "says": t.words,
                "range": t.tried,
                "method": t.method,
                "steps": t.steps,
                "status": "proved",
                "claim": verdict[t.holds],
                "values": "; ".join(t.values),
                "counterexample": t.tried if t.name.startswith("counterexample") else "",
            }
            for t in proofs.proved
        ]
        found += [
            dict.fromkeys(("range", "method", "claim", "values", "counterexample"), "")
            | {"family": family, "theorem": f.name, "says": f.why, "steps": 0, "status": "not proved"}
            for f in proofs.failed
        ]
    return found


def windows() -> list[dict[str, Any]]:
    """Per kernel the R between which DNI at rest is stable at every tension: from omega^2(pi) < 0 to the wave that ends it."""
    found = []
    theorems = {t.name: t for family in ("at_pi", "tension") for t in prove(family).proved}
    for kernel in SMOOTH:
        at_pi, inside = (theorems.get(f"dni-{what}") for what in (f"at-pi-{kernel}-full", f"window-{kernel}"))
        if at_pi and inside:
            inner = inside.values[0] if inside.values else ""
            found.append(
                {
                    "kernel": kernel,
                    "from": at_pi.values[0],
                    "to": inner or at_pi.values[1],
                    "ended_by": "a wave between kh = 0 and pi" if inner else "kh = pi",
                }
            )
    return found
