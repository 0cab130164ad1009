"""The rules of the other claims: kernels, identities, sums of squares, and the relation of DNI at rest."""

from fractions import Fraction
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck import forces, kernels
from rkverify.recheck.boxes import Zero, no_zero
from rkverify.recheck.identities import IDENTITIES, NECESSARY, SHORT, SQUARES
from rkverify.recheck.polynomials import Polynomial, derivative, plus, sign, times, trimmed, value
from rkverify.recheck.reading import field, joined, listed, pair, rational, rationals, require
from rkverify.recheck.signs import decimal, narrowed
from rkverify.recheck.symbols import Sum, as_sum, from_log, symbol

F = Fraction


def kernel(claim: Any, proof: Any) -> str:
    """Joints, class C^m, phi > 0 and phi' < 0 on 0 < z < 1, and where phi'' changes its sign."""
    name = field(claim, "kernel")
    ends = kernels.joints(name)
    require(rationals(field(claim, "joints")) == list(ends), "other joints are claimed")
    pieces = listed(proof, "pieces")
    joined([pair([field(p, "from"), field(p, "to")]) for p in pieces], F(0), F(1), "the pieces of z")
    require(len(pieces) == len(ends) - 1, "the pieces of z are not those between the joints")
    zeros: list[Zero] = []
    signs: list[int] = []
    for piece, a, b in zip(pieces, ends[:-1], ends[1:], strict=True):
        what = f"z from {a} to {b}"
        p = trimmed(rationals(field(piece, "polynomial")))
        require(p == trimmed(kernels.piece(name, a, b)), f"not the {name} kernel on {what}")
        require(no_zero(p, field(piece, "boxes"), a, b, f"phi, {what}") > 0, f"phi is not positive, {what}")
        slope = derivative(p)
        require(no_zero(slope, field(piece, "slope_boxes"), a, b, f"phi', {what}") < 0, f"phi does not fall, {what}")
        if b < 1:
            require(value(p, b) > 0, f"phi is not positive at {b}")
            require(value(slope, b) < 0, f"phi does not fall at {b}")
        bend = derivative(slope)
        if bend:
            boxes = field(piece, "curvature_boxes")
            inside = narrowed(bend, boxes, field(piece, "curvature_zeros"), (a, b), claim.get("digits"), what)
            cuts = [a, *(end for zero in inside for end in zero), b]
            each = [sign(value(bend, (x + y) / 2)) for x, y in zip(cuts[::2], cuts[1::2], strict=True)]
            # At a joint between two pieces the sign may turn as well.
            if signs and signs[-1] != each[0]:
                zeros.append((a, a))
                signs.append(each[0])
            signs += each if not signs else each[1:]
            zeros += inside
    smooth = [_smoothness(name, joint) for joint in ends]
    require(field(claim, "continuity") == min(smooth), f"phi(|x|) is of class C^{min(smooth)}")
    told = [pair(zero) for zero in listed(claim, "curvature_zeros")]
    require(told == zeros and listed(claim, "curvature_signs") == signs, "the signs of phi'' are not those claimed")
    turns = ", ".join(decimal(zero) for zero in zeros) or "none"
    return f"the {name} kernel is of class C^{min(smooth)} exactly, positive and falling on 0 < z < 1; phi'' turns at z = {turns}"


def _smoothness(name: str, joint: Fraction) -> int:
    order = 0
    while not kernels.jump(name, joint, order) and order < 12:
        order += 1
    return order - 1


def identity(claim: Any, proof: Any) -> str:
    """An identity of polynomials: expanded here, and the sum that the log lists is the same."""
    name = field(claim, "identity")
    if name not in IDENTITIES:
        raise BadInput(f"there is no identity {str(name)[:40]!r}: it is one of {', '.join(IDENTITIES)}")
    make, words = IDENTITIES[name]
    known = make(claim)
    require(known == from_log(listed(proof, "sum")), f"the sum that is listed is not that of {name}")
    expected = field(claim, "equals")
    if expected == "0":
        require(not known.terms, f"{name} is not 0")
    elif expected == "last - first":
        n = claim["cells"]
        require(known == symbol(f"e{n}") - symbol("e0"), f"{name} is not the last less the first")
    elif expected == "sum at an edge":
        total = as_sum(0)
        for k in range(claim["reach"]):
            total = total + 2 * symbol(f"e{2 * k + 1}")
        require(known == total, f"{name} is not the sum of the shape functions at an edge")
    elif expected != "the sum listed":
        raise BadInput(f"{str(expected)[:40]!r} is nothing that an identity equals")
    return words.format(**claim)


def squares(claim: Any, proof: Any) -> str:
    """D/4 as a sum of weights that are not negative times squares."""
    name = field(claim, "relation")
    if name not in SQUARES:
        raise BadInput(f"there is no relation {str(name)[:40]!r}: it is one of {', '.join(SQUARES)}")
    make, positive, words = SQUARES[name]
    known, total = make(), as_sum(0)
    for part in listed(proof, "parts"):
        weight, square = from_log([field(part, "weight")]), from_log(listed(part, "square"))
        ((powers, c),) = weight.terms.items() or (((), F(0)),)
        wrong = [s for s, e in powers if e < 0 or (s not in (*positive, "u", "w") and e % 2)]
        require(c > 0 and not wrong, f"the weight {c} {dict(powers)} may be negative")
        total = total + weight * square * square
    for short, long in SHORT.items():
        total = total.put(short, long)
    require(known == total, f"the parts do not add up to the relation {name}")
    if name in NECESSARY:
        u, d = NECESSARY[name]
        over = Sum({tuple((n, e - (n == "u")) for n, e in p if (n, e) != ("u", 1)): c for p, c in known.terms.items()})
        at = over.put("u", as_sum(u)).terms
        require(
            list(at) == [(("d", 1),)] and min(at.values()) > 0 and d == symbol("d"),
            f"D/(4u) at u = {u} is no multiple of d",
        )
    return words


def at_rest(claim: Any, proof: Any) -> str:
    """DNI at rest: omega^2 = (1 - c)[(1 + s) S + s G], S = 1 + c and G a multiple of 1 - c, or S(1) = 2 and G(1) = 0."""
    name, reading, form = (field(claim, key) for key in ("kernel", "derivative", "form"))
    low, high = rational(field(claim, "from")), rational(field(claim, "to"))
    ends = [pair(end) for end in listed(proof, "pieces")]
    joined(ends, low, high, "the pieces of R")
    for a, b in ends:
        S, G, below = forces.at_rest(name, reading, (1 / b, 1 / a))
        if form == "affine":
            require([below, below] == S, f"S is not 1 + c for {a} < R < {b}")
            require(len(G) == 2 and not plus(G[0], G[1]), f"G is no multiple of 1 - c for {a} < R < {b}")
        elif form == "long waves":
            require(_sum(S) == times([F(2)], below) and not _sum(G), f"long waves are not 1 + s for {a} < R < {b}")
        else:
            raise BadInput(f"the form {str(form)[:30]!r} is neither affine nor long waves")
    if form == "affine":
        return f"DNI at rest, {name}, {reading}: omega^2 = (1 + s) sin^2 kh + (omega^2(pi)/4) (1 - cos kh)^2 on {low} < R < {high}: >= 0 at every kh exactly where 1 + s >= 0 and omega^2(pi) >= 0"
    return f"DNI at rest, {name}, {reading}: omega^2/(kh)^2 -> 1 + s for the longest waves on {low} < R < {high}"


def _sum(parts: list[Polynomial]) -> Polynomial:
    total: Polynomial = []
    for p in parts:
        total = plus(total, p)
    return total
