"""Reference values of kernels: phi, phi' and phi'' at joints, between and at both ends, where they exist."""

from fractions import Fraction

import flint

from rkverify.arithmetic.base import Arithmetic
from rkverify.certify.reference import by_definition
from rkverify.certify.reference.by_definition import curvature, slope
from rkverify.certify.reference.case import Subject, Values, texts
from rkverify.kernels import KERNELS, Kernel

BETWEEN = tuple(Fraction(n, 16) for n in (1, 3, 6, 9, 11, 14))
NAMES = ("phi", "dphi", "d2phi")


def subjects() -> list[Subject]:
    """One case for each kernel."""
    return [_subject(kernel) for kernel in KERNELS.values()]


def _subject(kernel: Kernel) -> Subject:
    places = sorted({Fraction(0), *kernel.joints, *BETWEEN})
    wanted = [(k, order) for k, z in enumerate(places) for order in range(3) if _has(kernel, z, order)]

    def literal(K: Arithmetic) -> Values:
        derivatives = [kernel.phi.derivative(order) if order else kernel.phi for order in range(_highest(kernel) + 1)]
        return {f"{NAMES[order]}[{k}]": derivatives[order](K.number(places[k]), K) for k, order in wanted}

    def defined() -> Values:
        return {f"{NAMES[order]}[{k}]": _by_differences(kernel.name, places[k], order) for k, order in wanted}

    inputs = {"kernel": kernel.name, "z": texts(places)}
    equations = (12,) if kernel.name == "cubic" else ()
    return Subject(f"kernel {kernel.name}", equations, "", inputs, dict.fromkeys(NAMES, "1"), literal, defined, True)


def _highest(kernel: Kernel) -> int:
    return min(2, min(t.power for t in kernel.phi.terms))


def _has(kernel: Kernel, z: Fraction, order: int) -> bool:
    """Whether phi(|x|) has the derivative at z."""
    if order > _highest(kernel):
        return False
    smooth = [kernel.smoothness_at_node] if z == 0 else [kernel.smoothness_at(z)] if z in kernel.joints else []
    return all(order <= m for m in smooth)


def _by_differences(name: str, z: Fraction, order: int) -> flint.fmpq:
    at = flint.fmpq(z.numerator, z.denominator)
    if order == 0:
        return flint.fmpq(1) * by_definition.phi(name, at)
    quotient = slope if order == 1 else curvature
    return quotient(lambda t: [flint.fmpq(1) * by_definition.phi(name, at + t)])[0]
