"""Signs of rational functions of R = a/h: every zero isolated, the sign between zeros, continuity at the joints."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import flint

from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.closed_forms import convective_part
from rkverify.certify.closed_relations import in_cosine
from rkverify.certify.theorems.isolation import DIGITS, NotProved, boxes, sign, zeros
from rkverify.certify.theorems.logs import Theorem, text, texts
from rkverify.certify.turns import method_at_pi, pieces
from rkverify.paper.notation import lattice_values
from rkverify.readings import Convection, Derivative

Function = Callable[[RationalFunctions], Any]
"""Arithmetic with the generator R, sampled on a piece -> element of the field."""


@dataclass(frozen=True)
class Subject:
    """A function of R by the name that logs have for it, and how the project computes it."""

    data: dict[str, str]
    function: Function


def at_pi(kernel: str, derivative: Derivative) -> Subject:
    """omega^2(pi)/sigma of the linearised equations at rest with DNI."""
    return Subject(
        {"function": "omega^2(pi)/sigma", "kernel": kernel, "derivative": derivative},
        lambda K: method_at_pi(K.generator("R"), K, kernel, derivative),
    )


def printed(function: str, kernel: str, derivative: Derivative) -> Subject:
    """Psi(h), 1 - 4 Psi(h), Psi,xx(h) or Psi,xx(h) - 4 Psi,x(h)^2 of the paper's notation, h = 1."""

    def value(K: RationalFunctions) -> Any:
        v = lattice_values(1, K.generator("R"), K, "edge", derivative, kernel)
        return {
            "Psi(h)": v.Psi_h,
            "1 - 4 Psi(h)": 1 - 4 * v.Psi_h,
            "Psi,xx(h)": v.Psi_xx_h,
            "Psi,xx(h) - 4 Psi,x(h)^2": v.Psi_xx_h - 4 * v.Psi_x_h**2,
        }[function]

    return Subject({"function": function, "kernel": kernel, "derivative": derivative}, value)


RATES: dict[Convection, str] = {"psi-star": "psi-star", "true": "true"}


def damping(convection: Convection) -> Subject:
    """The factor beta of Q in b = Q beta at kh = pi/2, cubic kernel, 1 < R < 2."""

    def value(K: RationalFunctions) -> Any:
        part, field = convective_part(convection, "low")
        return in_cosine({n: c / field.generator("Q") for n, c in part["v", "v"].items()}, field)[0]

    return Subject({"function": "beta at kh = pi/2", "kernel": "cubic", "rate": RATES[convection]}, value)


def quotient(value: Any) -> tuple[Any, Any]:
    """Numerator and denominator of an element of Q(R) as primitive fmpz polynomials, scaled alike."""
    R = value.numer.ring.gens[0]
    index = value.numer.ring.gens.index(R)

    def poly(part: Any) -> Any:
        powers = {exponents[index]: c for exponents, c in part.terms()}
        degree = max(powers, default=0)
        return flint.fmpq_poly([flint.fmpq(int(c.numerator), int(c.denominator)) if (c := powers.get(k)) else flint.fmpq(0) for k in range(degree + 1)])  # fmt: skip

    above, below = poly(value.numer), poly(value.denom)
    common = flint.fmpq(above.denom()) * flint.fmpq(below.denom())
    return above * common, below * common


def prove_signs(
    name: str,
    words: str,
    subject: Subject,
    span: tuple[Fraction, Fraction],
    expected: tuple[int, ...],
    holds: bool | None = None,
) -> Theorem:
    """The theorem that the subject has these signs over the span, with its zeros enclosed to DIGITS digits.

    Raises NotProved where it has others, a pole, or a jump.
    """
    kernel = subject.data["kernel"]
    cuts = [R for piece in pieces(kernel, span[1]) for R in piece]
    ends = sorted({*span, *(R for R in cuts if span[0] < R < span[1])})
    steps = 0
    found: list[tuple[Fraction, Fraction]] = []
    signs: list[int] = []
    log: list[dict[str, Any]] = []
    for a, b in pairwise(ends):
        above, below = quotient(subject.function(RationalFunctions({"R": (a + b) / 2})))
        one, other = boxes(below, a, b), boxes(above, a, b)
        if any(count for *_, count in one):
            raise NotProved(f"{name}: the function has a pole between {a} and {b}")
        inside = zeros(above, other)
        places = [a, *(end for zero in inside for end in zero), b]
        each = [sign(above, (x + y) / 2) * sign(below, (x + y) / 2) for x, y in zip(places[::2], places[1::2], strict=True)]  # fmt: skip
        if not signs:
            signs.append(each[0])
        elif sign(above, a) == 0:
            found.append((a, a))
            signs.append(each[0])
        elif each[0] != signs[-1]:
            raise NotProved(f"{name}: the function jumps at {a}")
        signs += each[1:]
        found += inside
        steps += len(one) + len(other)
        log.append(
            {
                "from": text(a),
                "to": text(b),
                "numerator": texts(above.coeffs()),
                "denominator": texts(below.coeffs()),
                "boxes": [[text(x), text(y), n] for x, y, n in other],
                "denominator_boxes": [[text(x), text(y), n] for x, y, n in one],
                "zeros": [texts(zero) for zero in inside],
            }
        )
    if tuple(signs) != expected:
        raise NotProved(f"{name}: the signs are {signs} on {span[0]} < R < {span[1]}, not {list(expected)}")
    claim = {
        "kind": "signs over R",
        "subject": subject.data,
        "from": text(span[0]),
        "to": text(span[1]),
        "zeros": [texts(zero) for zero in found],
        "signs": signs,
        "digits": DIGITS,
    }
    turns = tuple(decimal(zero) for zero, (s, t) in zip(found, pairwise(signs), strict=True) if s != t)
    method = "all zeros isolated by Descartes' rule in boxes"
    return Theorem(name, words, f"{span[0]} < R < {span[1]}", claim, {"pieces": log}, method, steps, holds, turns)


def decimal(zero: tuple[Fraction, Fraction]) -> str:
    """The zero to DIGITS decimals, of which an enclosure of WIDTH makes certain all but a unit of the last."""
    middle = (zero[0] + zero[1]) / 2
    whole, rest = divmod(int(middle * 10**DIGITS), 10**DIGITS)
    return f"{whole}.{rest:0{DIGITS}d}"
