"""Kernels: class at every joint, positive and falling inside the support, where the curvature turns."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

import flint

from rkverify.certify.theorems.isolation import DIGITS, NotProved, boxes, rational, sign, zeros
from rkverify.certify.theorems.logs import Theorem, text, texts
from rkverify.certify.theorems.support_functions import decimal
from rkverify.kernels import Kernel


def piece(k: Kernel, low: Fraction, high: Fraction) -> Any:
    """phi between two joints as a polynomial: the terms whose end lies beyond."""
    total = flint.fmpq_poly([0])
    for t in k.phi.terms:
        if t.end >= high:
            total += rational(t.coefficient) * flint.fmpq_poly([rational(t.end), -1]) ** t.power
    return total


def prove_kernel(k: Kernel, falls_to: Fraction = Fraction(1), holds: bool | None = None) -> Theorem:
    """The theorem that phi > 0 and phi' < 0 on 0 < z < falls_to, with its joints, class and turns of phi''.

    Raises NotProved where it is not so; the support ends at 1.
    """
    if falls_to != 1:
        raise NotProved(f"the support of the {k.name} kernel ends at z = 1: it does not fall up to {falls_to}")
    joints = [Fraction(0), *(z for z in k.joints if z < 1), Fraction(1)]
    pieces: list[dict[str, Any]] = []
    turns: list[tuple[Fraction, Fraction]] = []
    signs: list[int] = []
    steps = 0
    for a, b in pairwise(joints):
        p = piece(k, a, b)
        slope, bend = p.derivative(), p.derivative().derivative()
        each = {"boxes": boxes(p, a, b), "slope_boxes": boxes(slope, a, b)}
        if any(n for found in each.values() for *_, n in found) or sign(p, (a + b) / 2) < 0 < sign(slope, (a + b) / 2):
            raise NotProved(f"the {k.name} kernel is not positive and falling between {a} and {b}")
        logged: dict[str, Any] = {"from": text(a), "to": text(b), "polynomial": texts(p.coeffs())}
        if bend.degree() >= 0:
            each["curvature_boxes"] = boxes(bend, a, b)
            inside = zeros(bend, each["curvature_boxes"])
            places = [a, *(end for zero in inside for end in zero), b]
            own = [sign(bend, (x + y) / 2) for x, y in zip(places[::2], places[1::2], strict=True)]
            if signs and signs[-1] != own[0]:
                turns.append((a, a))
                signs.append(own[0])
            signs += own if not signs else own[1:]
            turns += inside
            logged["curvature_zeros"] = [texts(zero) for zero in inside]
        logged |= {key: [[text(x), text(y), n] for x, y, n in found] for key, found in each.items()}
        steps += sum(map(len, each.values()))
        pieces.append(logged)
    claim = {
        "kind": "kernel",
        "kernel": k.name,
        "joints": texts(joints),
        "continuity": k.continuity,
        "curvature_zeros": [texts(zero) for zero in turns],
        "curvature_signs": signs,
        "digits": DIGITS,
    }
    at = ", ".join(decimal(zero) if zero[0] != zero[1] else str(zero[0]) for zero in turns) or "nowhere"
    words = f"The {k.name} kernel is of class C^{k.continuity} exactly, positive and falling on its support; its curvature turns at z = {at}"
    return Theorem(
        f"kernel-{k.name}",
        words,
        "all 0 <= z",
        claim,
        {"pieces": pieces},
        "Descartes' rule in boxes on every piece",
        steps,
        holds,
        tuple(decimal(zero) for zero in turns),
    )
