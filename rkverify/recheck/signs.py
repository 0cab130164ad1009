"""Claims on the signs of a function of one variable: where its zeros are, and its sign between them."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck import subjects
from rkverify.recheck.boxes import Zero, enclosed, no_zero, zeros_inside
from rkverify.recheck.polynomials import Polynomial, sign, times, trimmed, value
from rkverify.recheck.reading import field, joined, listed, pair, rational, rationals, require


def same(p: Polynomial, q: Polynomial, other: tuple[Polynomial, Polynomial], what: str) -> None:
    """Raises Rejected unless p/q is the quotient of the other two, as polynomials."""
    require(bool(q), f"{what}: the denominator is 0")
    require(times(p, other[1]) == times(q, other[0]), f"{what}: not the function that the claim is about")


def narrowed(p: Polynomial, boxes: Any, zeros: Any, ends: Zero, digits: Any, what: str) -> list[Zero]:
    """The zeros of p between the ends as the boxes isolate them, each narrowed to the enclosure that is listed."""
    found = zeros_inside(p, boxes, *ends, what)
    if not isinstance(zeros, list) or len(zeros) != len(found):
        raise BadInput(f"{what}: {len(found)} zeros are isolated, and another count of enclosures is listed")
    return [enclosed(zero, p, box, digits, what) for zero, box in zip(zeros, found, strict=True)]


def of_R(claim: Any, proof: Any) -> str:
    """A rational function of R on ]from, to[: piece by piece from the boxes, at the joints by its value there."""
    subject, low, high = field(claim, "subject"), rational(field(claim, "from")), rational(field(claim, "to"))
    pieces = listed(proof, "pieces")
    ends = [pair([field(p, "from"), field(p, "to")]) for p in pieces]
    joined(ends, low, high, "the pieces of R")
    zeros: list[Zero] = []
    signs: list[int] = []
    for piece, (a, b) in zip(pieces, ends, strict=True):
        what = f"R from {a} to {b}"
        p, q = (trimmed(rationals(field(piece, name))) for name in ("numerator", "denominator"))
        same(p, q, subjects.function_of_R(subject, (a, b)), what)
        no_zero(q, field(piece, "denominator_boxes"), a, b, f"denominator, {what}")
        inside = narrowed(p, field(piece, "boxes"), field(piece, "zeros"), (a, b), claim.get("digits"), what)
        cuts = [a, *(end for zero in inside for end in zero), b]
        each = [_sign_between(p, q, x, y) for x, y in zip(cuts[::2], cuts[1::2], strict=True)]
        if not signs:
            signs.append(each[0])
        elif not value(p, a):
            require(value(q, a) != 0, f"there is a pole at {a}")
            zeros.append((a, a))
            signs.append(each[0])
        else:
            require(value(q, a) != 0 and each[0] == signs[-1], f"the function jumps or has a pole at {a}")
        signs += each[1:]
        zeros += inside
    told = [pair(zero) for zero in listed(claim, "zeros")]
    require(told == zeros, f"the zeros that are claimed are not the {len(zeros)} that the boxes enclose")
    require(listed(claim, "signs") == signs, f"the signs are {signs}, and others are claimed")
    turns = [z for z, (s, t) in zip(zeros, pairwise(signs), strict=True) if s != t]
    words = ", ".join(decimal(z) for z in turns)
    return (
        f"{named(subject)} has the signs {' '.join('-0+'[s + 1] for s in signs)} on {low} < R < {high}"
        + (f", turning at R = {words} alone" if turns else "")
        + (f"; {len(zeros) - len(turns)} zero without a turn" if len(zeros) > len(turns) else "")
    )


def _sign_between(p: Polynomial, q: Polynomial, x: Fraction, y: Fraction) -> int:
    middle = (x + y) / 2
    return sign(value(p, middle)) * sign(value(q, middle))


def of_c(claim: Any, proof: Any) -> str:
    """D of the print at rational parameters, over 16 (1 - c): one sign for all c = cos kh from -1 to 1, or its zeros."""
    subject = field(claim, "subject")
    known = subjects.printed_discriminant(subject)
    p = trimmed(rationals(field(proof, "polynomial")))
    require(p == trimmed(known), "not the polynomial that the claim is about")
    found = zeros_inside(p, field(proof, "boxes"), Fraction(-1), Fraction(1), "c from -1 to 1")
    cuts = [Fraction(-1), *(end for zero in found for end in zero), Fraction(1)]
    signs = [sign(value(p, (x + y) / 2)) for x, y in zip(cuts[::2], cuts[1::2], strict=True)]
    signs = [sign(value(p, Fraction(-1))), *signs, sign(value(p, Fraction(1)))]
    require(listed(claim, "signs") == signs, f"the signs are {signs}, and others are claimed")
    words = " ".join("-0+"[s + 1] for s in signs)
    return f"{named(subject)} has the signs {words} at kh = pi, between the waves at which it turns, and for the longest waves"


def decimal(zero: Zero, digits: int = 30) -> str:
    """The digits that both ends of an enclosure share, at most as many as given.

    >>> decimal((Fraction(157632, 100000), Fraction(157633, 100000)))
    '1.5763'
    """
    scaled = [str((end.numerator * 10**digits) // end.denominator).zfill(digits + 1) for end in zero]
    size = next((k for k, (x, y) in enumerate(zip(*scaled, strict=False)) if x != y), len(scaled[0]))
    whole = len(scaled[0]) - digits
    return f"{scaled[0][:whole]}.{scaled[0][whole:size]}" if size > whole else f"{float(zero[0]):.3g}"


def named(subject: Any) -> str:
    """A subject in words."""
    rest = ", ".join(f"{key} = {content}" for key, content in sorted(subject.items()) if key != "function")
    return f"{subject['function']} ({rest})"
