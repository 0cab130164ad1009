"""Solutions to the exercises of `certificates`."""

from dataclasses import replace

from rkverify.arithmetic.ball import Ball
from rkverify.arithmetic.guarded import Guarded
from rkverify.certify.enclosed import bounds, certain_digits
from rkverify.certify.theorems import catalogue
from rkverify.certify.theorems.logs import log
from rkverify.errors import BadInput
from rkverify.paper.printed_lagrangian import b_hat, omega_squared
from rkverify.recheck import recheck


def squared(R: str, digits: int, tenths: int) -> Guarded:
    """omega^2 of (63) at kh = tenths pi/10."""
    K = Ball(digits)
    return omega_squared(b_hat(1, R, K), K.number(1), K.pi() * tenths / 10, K)


def frequency(digits: int) -> str:
    """The notebook's frequency with as many digits as are certain."""
    return certain_digits(Ball(digits).sqrt(squared("7/2", digits, 9)), 40)


def exercise_1() -> int:
    """The fewest digits to carry for twenty certain ones."""
    return next(n for n in range(5, 60) if len(frequency(n).replace("0.00", "", 1)) >= 20)


def exercise_2() -> list[tuple[float, float]]:
    """Bounds of omega^2 at kh = pi with 20, 40, 80 digits: always about zero, and never without it."""
    return [bounds(squared("3/2", digits, 10)) for digits in (20, 40, 80)]


def exercise_3() -> str:
    """What the checker answers to a tent that claims two derivatives."""
    tent = next(t for t in catalogue.prove("kernels").proved if t.name == "kernel-tent")
    try:
        recheck(log([replace(tent, claim={**tent.claim, "continuity": 2})]))
    except BadInput as told:
        return str(told)
    return "verified"
