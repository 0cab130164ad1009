"""Reading a proof log: strict JSON, exact rationals of a bounded size, the hash, and fields of the expected kind."""

import hashlib
import json
import re
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rkverify.errors import BadInput

FORMAT = "rkverify proof log 1"
NUMBER = re.compile(r"-?[0-9]{1,400}(/[1-9][0-9]{0,399})?")


class Rejected(BadInput):
    """A log that does not prove what it claims."""


def _no_float(text: str) -> None:
    raise BadInput(f'the log holds the number {text[:30]}: write whole numbers, and fractions as text such as "3/2"')


def _whole(text: str) -> int:
    if len(text) > 400:
        raise BadInput(f"the log holds a whole number of {len(text)} digits: at most 400 are read")
    return int(text)


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise BadInput(f"the log names {pairs[0][0]!r} or another field twice in one place")
    return found


def digest(log: dict[str, Any]) -> str:
    """The SHA-256 of the log without its own hash, in canonical JSON."""
    bare = {key: content for key, content in log.items() if key != "sha256"}
    text = json.dumps(bare, sort_keys=True, ensure_ascii=False, separators=(",", ":"))
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def read_log(text: str) -> dict[str, Any]:
    """The log as data.

    Raises BadInput, in one line, for text that is no JSON, a number that is no exact one, another format, or a hash
    that is not that of the content.
    """
    try:
        log = json.loads(
            text, parse_float=_no_float, parse_constant=_no_float, parse_int=_whole, object_pairs_hook=_once
        )
    except json.JSONDecodeError as error:
        raise BadInput(f"no complete JSON: {error.msg} at line {error.lineno}, column {error.colno}") from None
    except RecursionError:
        raise BadInput("the log is nested too deeply to be a proof log") from None
    if not isinstance(log, dict) or log.get("format") != FORMAT:
        raise BadInput(f"this is no log of the format {FORMAT!r}")
    found, told = digest(log), log.get("sha256")
    if told != found:
        raise BadInput(f"wrong hash: the log says {str(told)[:16]}…, its content has {found[:16]}…")
    return log


def field(data: Any, name: str) -> Any:
    """data[name]; raises BadInput where there is none."""
    if not isinstance(data, dict) or name not in data:
        raise BadInput(f"the field {name!r} is missing")
    return data[name]


def listed(data: Any, name: str) -> list[Any]:
    """data[name], a list."""
    found = field(data, name)
    if not isinstance(found, list):
        raise BadInput(f"the field {name!r} is no list")
    return found


def rational(text: Any) -> Fraction:
    """A whole number, or text such as "-3/2"."""
    if isinstance(text, int) and not isinstance(text, bool):
        return Fraction(text)
    if not isinstance(text, str) or not NUMBER.fullmatch(text):
        raise BadInput(f'{str(text)[:40]!r} is no fraction of at most 400 digits such as "-3/2"')
    return Fraction(text)


def rationals(data: Any) -> list[Fraction]:
    """A list of them."""
    if not isinstance(data, list):
        raise BadInput(f"{str(data)[:40]!r} is no list of fractions")
    return [rational(x) for x in data]


def pair(data: Any) -> tuple[Fraction, Fraction]:
    """Two fractions, the first not above the second."""
    ends = rationals(data)
    if len(ends) != 2 or ends[0] > ends[1]:
        raise BadInput(f"{str(data)[:60]} are not the two ends of an interval")
    return ends[0], ends[1]


def require(condition: bool, words: str) -> None:
    """Raises Rejected with the words where the condition does not hold."""
    if not condition:
        raise Rejected(words)


def joined(ends: Sequence[tuple[Fraction, Fraction]], low: Fraction, high: Fraction, what: str) -> None:
    """Raises Rejected unless the intervals follow each other from low to high without a gap."""
    at = low
    for a, b in ends:
        require(a == at and b > a, f"{what}: nothing covers the place after {at}")
        at = b
    require(at == high, f"{what}: nothing covers the place after {at}, and {high} is claimed")
