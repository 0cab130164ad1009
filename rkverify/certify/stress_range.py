"""The stresses at which DNI at rest has omega^2 >= 0 at every kh, the wave number that ends their range, and both ends of kh per reading.

omega^2 = (1 + s) S(c) + s G(c) with s = sigma/C^sigma, c = cos kh and S >= 0: each kh allows an interval of s around 0.
Both polynomials are exact; they are looked at on a grid of c with both ends, c = -1 being kh = pi.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import acos

from rkverify.arithmetic.native import Exact
from rkverify.certify.closed_relations import over_one_minus_cosine
from rkverify.errors import BadInput
from rkverify.readings import Derivative, Readings
from rkverify.stability.lattice_state import Base
from rkverify.stability.limits import alternating, geometric_stencil, nodal_forces, response, unit


@dataclass(frozen=True)
class StressRange:
    """Stable for lowest <= s <= highest (None: without end); kh where either end is set, 0 for the longest waves."""

    lowest: Fraction | None
    kh_lowest: float | None
    highest: Fraction | None
    kh_highest: float | None


def polynomials(
    support_ratio: Fraction, derivative: Derivative = "full", kernel: str = "cubic"
) -> tuple[list[Fraction], list[Fraction]]:
    """S/(1 - c) and G/(1 - c), coefficients of the powers of c."""
    K, reach = Exact(), int(support_ratio) + 1
    patterns = [unit(m) for m in range(-reach, reach + 1)]
    forces = nodal_forces(support_ratio, K, patterns, "dni", derivative, kernel)
    material: dict[int, Fraction] = {}
    for I, b in forces.values.items():
        for m, d in forces.values.items():
            material[m - I] = material.get(m - I, Fraction(0)) - b * d
    return over_one_minus_cosine(material, K), over_one_minus_cosine(geometric_stencil(forces, reach, K), K)


def stress_range(
    support_ratio: Fraction, derivative: Derivative = "full", kernel: str = "cubic", samples: int = 200
) -> StressRange:
    """The range of s in which omega^2 >= 0 at every c = -1 + 2 j / samples."""
    S, G = polynomials(support_ratio, derivative, kernel)
    lowest: list[tuple[Fraction, float]] = []
    highest: list[tuple[Fraction, float]] = []
    for j in range(samples + 1):
        c = Fraction(2 * j, samples) - 1
        material, both = _value(S, c), _value(S, c) + _value(G, c)
        if both > 0:
            lowest.append((-material / both, acos(c)))
        elif both < 0:
            highest.append((-material / both, acos(c)))
    low, high = max(lowest, default=(None, None)), min(highest, default=(None, None))
    return StressRange(low[0], low[1], high[0], high[1])


def _value(coefficients: list[Fraction], c: Fraction) -> Fraction:
    total = Fraction(0)
    for p in reversed(coefficients):
        total = total * c + p
    return total


@dataclass(frozen=True)
class Affine:
    """constant + slope s."""

    constant: Fraction
    slope: Fraction

    @property
    def turn(self) -> Fraction | None:
        """The s at which it changes its sign, if there is one."""
        return -self.constant / self.slope if self.slope else None

    def __str__(self) -> str:
        """Such as 1 - 2 s."""
        if not self.slope:
            return str(self.constant)
        size = "s" if abs(self.slope) == 1 else f"{abs(self.slope)} s"
        if not self.constant:
            return size if self.slope > 0 else f"-{size}"
        return f"{self.constant} {'+' if self.slope > 0 else '-'} {size}"


def ends_in_stress(readings: Readings, support_ratio: Fraction, kernel: str = "cubic") -> tuple[Affine, Affine]:
    """lim omega^2/(kh)^2 and omega^2(pi) of the linearised equations at rest in any reading, as functions of s.

    Forces are sums of products of one stress and one gradient, so that both are affine in s: two stresses give them and
    a third confirms. Raises BadInput where it does not.
    """
    K = Exact()
    values = [
        (response(base, lambda J: Fraction(J * J, 2), K), -response(base, alternating, K))
        for base in (Base(support_ratio, readings, Fraction(s), kernel=kernel) for s in (0, 1, 3))
    ]
    found = []
    for at_0, at_1, at_3 in zip(*values, strict=True):
        if at_3 != at_0 + 3 * (at_1 - at_0):
            raise BadInput("omega^2 is not affine in the stress: there is no single turn to give")
        found.append(Affine(at_0, at_1 - at_0))
    return found[0], found[1]
