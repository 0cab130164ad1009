"""The vectorised code in double precision against the reference values, each difference beside its computed bound."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from rkverify.certify.reference.catalogue import Case
from rkverify.certify.reference.in_doubles import doubles
from rkverify.certify.rounding import rounding_bounds


@dataclass(frozen=True)
class Distance:
    """A number in double precision: its distance from the reference value, and what rounding may do to it."""

    case: str
    quantity: str
    error: float
    bound: float

    @property
    def within(self) -> bool:
        """Whether the distance is at most the bound, and the last rounding of a number that doubles do not hold."""
        return self.error <= self.bound


def distances(cases: Sequence[Case]) -> list[Distance]:
    """Every number that `solid/` has; half a unit in the last place, to store the result, is part of the bound."""
    found = []
    for case in cases:
        computed = doubles(case.subject.inputs, case.values)
        bounds = rounding_bounds(case.subject.literal) if computed else {}
        for quantity, value in computed.items():
            exact = case.values[quantity].value
            error = float(abs(Fraction(value) - exact))
            found.append(Distance(case.subject.name, quantity, error, bounds[quantity] + 2.0**-53 * abs(float(exact))))
    return found


def row(family: str, cases: Sequence[Case]) -> dict[str, str | int | bool]:
    """A line of the table of agreement."""
    found = distances(cases)
    return {
        "family": family,
        "cases": len(cases),
        "values": sum(len(case.values) for case in cases),
        "least_digits": min(number.digits for case in cases for number in case.values.values()),
        "compared": len(found),
        "beyond": sum(not distance.within for distance in found),
        "near": any(distance.error * 1000 >= distance.bound > 0 for distance in found),
    }
