"""Claims on functions of c = cos kh and a parameter: positive on a rectangle, or with how many zeros in c."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck import subjects
from rkverify.recheck.boxes import Zero, no_zero, positive_on_tree, zeros_inside
from rkverify.recheck.polynomials import Surface, discriminant, power, sign, times, trimmed, value
from rkverify.recheck.reading import field, joined, listed, pair, rational, rationals, require
from rkverify.recheck.signs import decimal, named, narrowed

F = Fraction


def _surface(data: Any, known: Surface, below: list[Fraction], denominator: list[Fraction]) -> Surface:
    """The surface of a log, found to be the known one over the same denominators."""
    if not isinstance(data, list) or not data:
        raise BadInput("a surface is no list of rows")
    P = [trimmed(rationals(row)) for row in data]
    size = max(len(P), len(known))
    for i in range(size):
        mine = known[i] if i < len(known) else []
        told = P[i] if i < len(P) else []
        require(times(told, below) == times(mine, denominator), f"the coefficients of c^{i} are not those of the claim")
    return P


def positive(claim: Any, proof: Any) -> str:
    """P(c, R)/Q(R) > 0 for -1 <= c <= 1 and from < R < to: Q > 0 by its boxes, P > 0 by a tree of rectangles."""
    subject, low, high = field(claim, "subject"), rational(field(claim, "from")), rational(field(claim, "to"))
    pieces = listed(proof, "pieces")
    ends = [pair([field(p, "from"), field(p, "to")]) for p in pieces]
    joined(ends, low, high, "the pieces of R")
    leaves = 0
    for piece, (a, b) in zip(pieces, ends, strict=True):
        q = trimmed(rationals(field(piece, "denominator")))
        known, below = subjects.surface(subject, (a, b))
        P = _surface(field(piece, "surface"), known, below, q)
        positive_below = no_zero(q, field(piece, "denominator_boxes"), a, b, f"denominator, R from {a} to {b}") > 0
        require(positive_below and (a == low or value(q, a) > 0), f"the denominator is not positive from {a} to {b}")
        leaves += positive_on_tree(P, field(piece, "tree"), (F(-1), F(1)), (a, b))
    return f"{named(subject)} > 0 for all kh and {low} < R < {high} ({leaves} boxes)"


def stretches(claim: Any, proof: Any) -> str:
    """How many zeros P(c, v) has in -1 < c < 1, and at which v their number changes.

    It can change only where a zero passes an end, which the boxes of P(-1, v) and P(1, v) exclude, or where two meet,
    which the zeros of the discriminant enclose: between two of these one sample gives the number.
    """
    subject, variable = field(claim, "subject"), field(claim, "variable")
    low, high = rational(field(claim, "from")), rational(field(claim, "to"))
    if variable == "R":
        q = trimmed(rationals(field(proof, "denominator")))
        no_zero(q, field(proof, "denominator_boxes"), low, high, "denominator")
        known, below = subjects.surface(subject, (low, high))
    elif variable == "w":
        require(low >= 0 and high <= 1, "w = s/(1 + s) runs from 0 to 1")
        q, below, known = [F(1)], [F(1)], subjects.tension_at(subject)
    else:
        raise BadInput(f"the variable {str(variable)[:20]!r} is neither R nor w")
    P = _surface(field(proof, "surface"), known, below, q)
    signs = []
    for c, name in ((F(-1), "left"), (F(1), "right")):
        edge = trimmed([value(column, c) for column in _columns(P)])
        signs.append(no_zero(edge, field(proof, name), low, high, f"c = {c}") * sign(value(q, (low + high) / 2)))
    require(signs == [1, 1], "P is not positive at both ends of c")
    events = _events(P, proof, low, high, claim.get("digits"))
    samples = listed(proof, "samples")
    places = [low, *(end for event in events for end in event), high]
    gaps = list(zip(places[::2], places[1::2], strict=True))
    if len(samples) != len(gaps):
        raise BadInput(f"there are {len(gaps)} stretches and {len(samples)} samples")
    counts = []
    for sample, (a, b) in zip(samples, gaps, strict=True):
        at = rational(field(sample, "at"))
        require(a < at < b, f"the sample {at} is not between {a} and {b}")
        p = trimmed([value(row, at) for row in P])
        counts.append(len(zeros_inside(p, field(sample, "boxes"), F(-1), F(1), f"c at {variable} = {at}")))
    turns = [event for event, (m, n) in zip(events, pairwise(counts), strict=True) if m != n]
    kept = [counts[0], *(n for m, n in pairwise(counts) if m != n)]
    told = [pair(turn) for turn in listed(claim, "turns")]
    require(told == turns, "the places where the number of zeros changes are not those that are claimed")
    require(listed(claim, "counts") == kept, f"the numbers of zeros are {kept}, and others are claimed")
    where = ", ".join(decimal(turn) for turn in turns)
    text = f"{named(subject)} has {' then '.join(map(str, kept))} zeros in 0 < kh < pi on {low} < {variable} < {high}"
    if variable == "w" and turns:
        where += f", sigma/C = {', '.join(decimal((a / (1 - a), b / (1 - b))) for a, b in turns)}"
    return text + (f", changing at {variable} = {where} alone" if turns else "") + "; it is positive at both ends of kh"


def _columns(P: Surface) -> list[list[Fraction]]:
    """Per power of the second variable, the coefficients of c."""
    width = max(len(row) for row in P)
    return [[row[j] if j < len(row) else F(0) for row in P] for j in range(width)]


def _events(P: Surface, proof: Any, low: Fraction, high: Fraction, digits: Any) -> list[Zero]:
    """The zeros of the discriminant in order; its factors are held against Sylvester's determinant at enough places."""
    product = [rational(field(proof, "constant"))]
    found: list[Zero] = []
    for number, factor in enumerate(listed(proof, "factors")):
        p = trimmed(rationals(field(factor, "polynomial")))
        exponent = field(factor, "exponent")
        if type(exponent) is not int or not 1 <= exponent <= 99:
            raise BadInput(f"the exponent {str(exponent)[:20]} of a factor is no whole number from 1 to 99")
        product = times(product, power(p, exponent))
        what = f"factor {number} of the discriminant"
        found += narrowed(p, field(factor, "boxes"), field(factor, "zeros"), (low, high), digits, what)
    width, size = max(len(row) for row in P) - 1, 2 * len(P) - 3
    for k in range(max(width * size, len(product)) + 1):  # one place more than either side has powers
        at = F(k, 8)
        sylvester = discriminant([value(row, at) for row in P])
        require(value(product, at) == sylvester, f"the factors are not those of the discriminant: see the place {at}")
    found.sort()
    require(all(a[1] < b[0] for a, b in pairwise(found)), "two zeros of the discriminant overlap")
    return found
