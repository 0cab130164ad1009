"""Boxes: on which intervals a polynomial has no zero or one, and on which rectangles of a bisected one it is positive."""

from fractions import Fraction
from typing import Any

from rkverify.errors import BadInput
from rkverify.recheck.polynomials import (
    Polynomial,
    Surface,
    bernstein,
    sign,
    surface_bernstein,
    value,
    variations,
)
from rkverify.recheck.reading import joined, pair, require

Zero = tuple[Fraction, Fraction]


def zeros_inside(p: Polynomial, boxes: Any, low: Fraction, high: Fraction, what: str) -> list[Zero]:
    """The zeros of p in the open interval, each enclosed by a box; boxes: [low, high, zeros inside] in order.

    Raises Rejected where the boxes leave a gap, a box has other changes of sign than it says, or more than one, and
    where p is zero at an end between two boxes.
    """
    require(bool(p), f"{what}: the polynomial is 0")
    if not isinstance(boxes, list):
        raise BadInput(f"{what}: the boxes are no list")
    ends, counts = [], []
    for box in boxes:
        if not isinstance(box, list) or len(box) != 3:
            raise BadInput(f"{what}: a box is no list of two ends and a count")
        ends.append(pair(box[:2]))
        counts.append(box[2])
    joined(ends, low, high, what)
    found = []
    for (a, b), count in zip(ends, counts, strict=True):
        changes = variations(bernstein(p, a, b))
        place = f"{what}, box from {a} to {b}"
        require(type(count) is int and changes == count, f"{place}: {changes} changes of sign, {count} claimed")
        require(count in (0, 1), f"{place}: more than one change of sign decides nothing")
        require(a == low or value(p, a) != 0, f"{what}: there is a zero at {a}, between two boxes")
        if count:
            found.append((a, b))
    return found


def no_zero(p: Polynomial, boxes: Any, low: Fraction, high: Fraction, what: str) -> int:
    """The sign of p on the open interval, on which it has no zero."""
    require(not zeros_inside(p, boxes, low, high, what), f"{what}: there is a zero between {low} and {high}")
    return sign(value(p, (low + high) / 2))


def positive_on_tree(P: Surface, tree: Any, x: tuple[Fraction, Fraction], y: tuple[Fraction, Fraction]) -> int:
    """How many rectangles show that P > 0 on the whole of x times y, its edges included.

    tree: the bisections as text, read from the left: x or y halves the rectangle at hand along that axis (first the
    lower half, then the upper), + ends it: there all Bernstein coefficients are positive. Raises Rejected.
    """
    if not isinstance(tree, str) or len(tree) > 200000:
        raise BadInput("the boxes of a rectangle are no text of x, y and + of at most 200000 letters")
    waiting, leaves = [(x, y)], 0
    for letter in tree:
        require(bool(waiting), "there are boxes beyond the rectangle")
        (a, b), (c, d) = waiting.pop()
        if letter == "x":
            middle = (a + b) / 2
            waiting += [((middle, b), (c, d)), ((a, middle), (c, d))]
        elif letter == "y":
            middle = (c + d) / 2
            waiting += [((a, b), (middle, d)), ((a, b), (c, middle))]
        elif letter == "+":
            least = min(min(row) for row in surface_bernstein(P, (a, b), (c, d)))
            require(least > 0, f"the box {a}…{b} times {c}…{d} has a Bernstein coefficient that is not positive")
            leaves += 1
        else:
            raise BadInput(f"{letter!r} among the boxes is none of x, y and +")
    require(not waiting, f"{len(waiting)} boxes of the rectangle are missing")
    return leaves


def enclosed(zero: Any, p: Polynomial, found: Zero, digits: Any, what: str) -> Zero:
    """A narrower enclosure of a zero that is alone in its box: opposite signs at its ends, and its width as claimed."""
    a, b = pair(zero)
    require(found[0] <= a and b <= found[1], f"{what}: the zero is not enclosed between {a} and {b}")
    exact = a == b and value(p, a) == 0
    require(exact or sign(value(p, a)) * sign(value(p, b)) < 0, f"{what}: no change of sign between {a} and {b}")
    if type(digits) is not int or not 1 <= digits <= 100:
        raise BadInput(f"the digits {str(digits)[:20]} of an enclosure are no whole number from 1 to 100")
    require(b - a <= Fraction(1, 10**digits), f"{what}: the enclosure is wider than 1e-{digits}")
    return a, b
