"""Functions of kh and a parameter: positive on a rectangle by a tree of boxes, or with a known number of zeros in kh."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import flint

from rkverify.arithmetic.native import Exact
from rkverify.certify.theorems.isolation import (
    DIGITS,
    Box,
    NotProved,
    Zero,
    boxes,
    rational,
    sign,
    tree,
    zeros,
)
from rkverify.certify.theorems.logs import Theorem, text, texts
from rkverify.certify.theorems.support_functions import decimal
from rkverify.certify.theorems.wave_functions import (
    SurfaceSubject,
    dni_parts,
    polynomial_in_second,
)
from rkverify.readings import Derivative

ONE = Fraction(1)


def _listed(found: list[Box]) -> list[list[Any]]:
    return [[text(a), text(b), n] for a, b, n in found]


def _clear(p: Any, low: Fraction, high: Fraction, what: str) -> list[Box]:
    """Boxes that show that p has no zero in the open interval; raises NotProved where it has."""
    found = boxes(p, low, high)
    if any(count for *_, count in found):
        raise NotProved(f"{what} has a zero between {low} and {high}")
    return found


def prove_positive(
    name: str, words: str, subject: SurfaceSubject, cuts: Sequence[Fraction], holds: bool | None = None
) -> Theorem:
    """The theorem that the subject is positive for all kh and R between the first and the last cut.

    Raises NotProved where it is not, or where its boxes do not end.
    """
    pieces, leaves = [], 0
    for a, b in pairwise(cuts):
        P, below = subject.make(a, b)
        flip = sign(below, (a + b) / 2)
        P, below = [p * flip for p in P], below * flip
        letters = tree(P, ((-ONE, ONE), (a, b)))
        leaves += letters.count("+")
        pieces.append(
            {
                "from": text(a),
                "to": text(b),
                "surface": [texts(p.coeffs()) for p in P],
                "denominator": texts(below.coeffs()),
                "denominator_boxes": _listed(_clear(below, a, b, "the denominator")),
                "tree": letters,
            }
        )
    claim = {"kind": "positive", "subject": subject.data, "from": text(cuts[0]), "to": text(cuts[-1])}
    method = "positive Bernstein coefficients on rectangles"
    return Theorem(name, words, f"all kh, {cuts[0]} < R < {cuts[-1]}", claim, {"pieces": pieces}, method, leaves, holds)


def prove_counts_over_R(
    name: str,
    words: str,
    subject: SurfaceSubject,
    span: Zero,
    expected: tuple[int, ...],
    holds: bool | None = None,
) -> Theorem:
    """The theorem that the subject has these numbers of zeros in 0 < kh < pi as R grows through one piece.

    Raises NotProved where it has others, or is not positive at kh = 0 and pi.
    """
    P, below = subject.make(*span)
    flip = sign(below, (span[0] + span[1]) / 2)
    extra = {
        "denominator": texts((below * flip).coeffs()),
        "denominator_boxes": _listed(_clear(below, *span, "the denominator")),
    }
    claim = {"kind": "zeros in c", "subject": subject.data, "variable": "R"}
    return _counts(name, words, [p * flip for p in P], claim, span, expected, extra, holds)


def prove_counts_over_tension(
    name: str,
    words: str,
    R: Fraction,
    derivative: Derivative,
    span: Zero,
    expected: tuple[int, ...],
    holds: bool | None = None,
    kernel: str = "cubic",
) -> Theorem:
    """The same of S + w G at one R, whose sign is that of omega^2, as w = s/(1 + s) with s = sigma/C grows."""
    S, G = dni_parts(kernel, derivative, R, Exact(), int(R) + 1)
    P = polynomial_in_second(list(zip(S, G, strict=True)))
    while not P[-1].degree() >= 0:
        P = P[:-1]
    subject = {"function": "S + w G", "kernel": kernel, "derivative": derivative, "R": text(R)}
    claim = {"kind": "zeros in c", "subject": subject, "variable": "w"}
    found = _counts(name, words, P, claim, span, expected, {}, holds)
    stresses = tuple(decimal((a / (1 - a), b / (1 - b))) for a, b in (map(Fraction, z) for z in found.claim["turns"]))
    return Theorem(**{**vars(found), "values": stresses})


def _counts(
    name: str,
    words: str,
    P: list[Any],
    claim: dict[str, Any],
    span: Zero,
    expected: tuple[int, ...],
    extra: dict[str, Any],
    holds: bool | None,
) -> Theorem:
    edges = {side: _at(P, c) for side, c in (("left", -ONE), ("right", ONE))}
    middle = (span[0] + span[1]) / 2
    if any(sign(edge, middle) < 0 for edge in edges.values()):
        raise NotProved(f"{name}: the function is negative at kh = 0 or pi")
    at_edges = {side: _listed(_clear(edge, *span, f"{name}, {side}")) for side, edge in edges.items()}
    discriminant, factors = _discriminant(P), []
    content, irreducible = discriminant.numer().factor()
    scale = flint.fmpq(content, discriminant.denom())
    events: list[Zero] = []
    isolated = 0
    for factor, exponent in irreducible:
        p = flint.fmpq_poly(factor)
        found = boxes(p, *span)
        inside = zeros(p, found)
        events += inside
        isolated += len(found)
        factors.append(
            {
                "polynomial": texts(p.coeffs()),
                "exponent": int(exponent),
                "boxes": _listed(found),
                "zeros": [texts(zero) for zero in inside],
            }
        )
    events.sort()
    places = [span[0], *(end for event in events for end in event), span[1]]
    samples, counts = [], []
    for a, b in zip(places[::2], places[1::2], strict=True):
        at = _simplest((2 * a + b) / 3, (a + 2 * b) / 3)
        row = flint.fmpq_poly([p(rational(at)) for p in P])
        found = boxes(row, -ONE, ONE)
        counts.append(sum(count for *_, count in found))
        samples.append({"at": text(at), "boxes": _listed(found)})
    turns = [event for event, (m, n) in zip(events, pairwise(counts), strict=True) if m != n]
    kept = (counts[0], *(n for m, n in pairwise(counts) if m != n))
    if kept != expected:
        raise NotProved(f"{name}: the numbers of zeros in kh are {kept}, not {expected}")
    full = claim | {
        "from": text(span[0]),
        "to": text(span[1]),
        "turns": [texts(turn) for turn in turns],
        "counts": list(kept),
        "digits": DIGITS,
    }
    proof = extra | {
        "surface": [texts(p.coeffs()) for p in P],
        **at_edges,
        "constant": text(scale),
        "factors": factors,
        "samples": samples,
    }
    method = "zeros of the discriminant isolated, one sample between two"
    tried = f"all kh, {span[0]} < {claim['variable']} < {span[1]}"
    steps = len(samples) + isolated
    return Theorem(name, words, tried, full, proof, method, steps, holds, tuple(map(decimal, turns)))


def _simplest(low: Fraction, high: Fraction) -> Fraction:
    """The fraction of the least denominator 2^k between two numbers: short samples make short logs."""
    size = 1
    while Fraction(int(high * size), size) <= low:
        size *= 2
    return Fraction(int(high * size), size)


def _at(P: list[Any], c: Fraction) -> Any:
    total = flint.fmpq_poly([0])
    for p in reversed(P):
        total = total * rational(c) + p
    return total


def _discriminant(P: list[Any]) -> Any:
    """The resultant of P and its derivative in c, from Sylvester's matrix at as many places as it has powers."""
    d, width = len(P) - 1, max(p.degree() for p in P)
    size = 2 * d - 1
    places = [Fraction(k, 8) - 1 for k in range(width * size + 1)]
    values = []
    for place in places:
        high = [p(rational(place)) for p in reversed(P)]
        low = [k * c for k, c in zip(range(d, 0, -1), high, strict=False)]
        zero = flint.fmpq(0)
        rows = [[zero] * k + high + [zero] * (size - k - d - 1) for k in range(d - 1)]
        rows += [[zero] * k + low + [zero] * (size - k - d) for k in range(d)]
        values.append(flint.fmpq_mat(rows).det())
    return _through(places, values)


def _through(places: list[Fraction], values: list[Any]) -> Any:
    """The polynomial through these points, by divided differences."""
    table, total, base = list(values), flint.fmpq_poly([0]), flint.fmpq_poly([1])
    for k, at in enumerate(places):
        total += base * table[k]
        base *= flint.fmpq_poly([rational(-at), 1])
        for i in range(len(table) - 1, k, -1):
            table[i] = (table[i] - table[i - 1]) / rational(places[i] - places[i - k - 1])
    return total
