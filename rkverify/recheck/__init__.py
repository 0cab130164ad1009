"""An independent checker of proof logs: the standard library, exact rationals, and nothing of the provers.

A log is a JSON file with a hash: theorems, each a claim that a machine reads and the steps of its proof. What a claim is
about (a kernel, a lattice of nodes and its forces, a printed relation) is built anew here from its definition, and
every step is repeated. The sentence that comes back is written from the claim: words in the log count for nothing.
"""

from collections.abc import Callable
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck import rules, signs, surfaces
from rkverify.recheck.reading import Rejected, field, listed, read_log

RULES: dict[str, Callable[[Any, Any], str]] = {
    "signs over R": signs.of_R,
    "signs over c": signs.of_c,
    "positive": surfaces.positive,
    "zeros in c": surfaces.stretches,
    "kernel": rules.kernel,
    "identity": rules.identity,
    "sum of squares": rules.squares,
    "at rest": rules.at_rest,
}


def recheck(text: str) -> list[tuple[str, str]]:
    """The name of every theorem of a log, and in words what was verified.

    Raises BadInput for a log that cannot be read, Rejected (a BadInput) for one that does not prove its claims; one line.
    """
    found = []
    for number, theorem in enumerate(listed(read_log(text), "theorems")):
        name = field(theorem, "name")
        claim = field(theorem, "claim")
        kind = field(claim, "kind")
        if not isinstance(kind, str) or kind not in RULES:
            raise BadInput(f"theorem {number}: there is no rule for claims of the kind {str(kind)[:40]!r}")
        try:
            found.append((str(name), RULES[kind](claim, field(theorem, "proof"))))
        except Rejected as error:
            raise Rejected(f"theorem {number}, {str(name)[:60]}: {error}") from None
        except BadInput as error:
            raise BadInput(f"theorem {number}, {str(name)[:60]}: {error}") from None
        except (TypeError, KeyError, IndexError, AttributeError, ValueError, ZeroDivisionError) as error:
            raise BadInput(f"theorem {number}, {str(name)[:60]}: a field holds what it cannot hold ({error})") from None
    if not found:
        raise BadInput("the log holds no theorem")
    return found
