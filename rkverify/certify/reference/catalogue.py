"""All families of reference values by name."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

from rkverify.certify.certified import Certified
from rkverify.certify.reference import (
    bar_values,
    bloch_values,
    dispersion_values,
    equation_values,
    gradient_values,
    kernel_values,
    rate_values,
    shape_values,
)
from rkverify.certify.reference.case import Subject
from rkverify.errors import UnknownName

FAMILIES: dict[str, Callable[[], Sequence[Subject]]] = {
    "kernels": kernel_values.subjects,
    "shape": shape_values.subjects,
    "rates": rate_values.subjects,
    "gradients": gradient_values.subjects,
    "equations": lambda: [*bar_values.subjects(), *equation_values.subjects()],
    "dispersion": dispersion_values.subjects,
    "bloch": bloch_values.subjects,
}


@dataclass(frozen=True)
class Case:
    """A subject with its certified numbers."""

    subject: Subject
    values: dict[str, Certified]


@cache
def family(name: str) -> tuple[Case, ...]:
    """The cases of a family, certified; raises UnknownName."""
    if name not in FAMILIES:
        raise UnknownName("family of reference values", name, list(FAMILIES))
    return tuple(Case(subject, subject.certify()) for subject in FAMILIES[name]())
