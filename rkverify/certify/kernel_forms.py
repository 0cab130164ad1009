"""Names for a kernel's values on the uniform lattice: phi(0), phi(h/a), phi(h/2a), phi(3h/2a), with phi' and phi''.

With z = h/a, the forms are written in p0 = phi(0), p1 = phi(z), d1 = phi'(z), c1 = phi''(z), e1 = phi(z/2), e3 = phi(3z/2).
"""

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import sympy

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.kernel_symbols import NamedFunction, NamedKernel
from rkverify.kernels import kernel

LABELS = {"0": Fraction(0), "half": Fraction(1, 2), "1": Fraction(1), "threehalf": Fraction(3, 2)}
"""Label -> |x - x_I| in spacings."""


@dataclass(frozen=True)
class NamedSlope(NamedFunction):
    """phi' at the named places: called it is phi'(z) = z g(z) with the slope phi''(z), `over_z` is g(z) = phi'(z)/z."""

    slopes: dict[Fraction, tuple[Scalar, Scalar]] = field(default_factory=dict)

    def __call__(self, z: Scalar, K: Arithmetic) -> Scalar:
        """phi'(z); through duals, with phi''(z)."""
        return NamedFunction(self.slopes)(z, K)

    def over_z(self, z: Scalar, K: Arithmetic) -> Scalar:
        """phi'(z)/z."""
        return NamedFunction(self.places)(z, K)


def sample_of_kernel(labels: list[str], curvature: bool = True) -> dict[str, Any]:
    """Generators p, g and, with curvature, c for each place, with a sample value: positive, falling, curved."""
    signs = {"g": -1, "c": 1} if curvature else {"g": -1}
    return {
        f"{name}_{label}": value for label in labels for name, value in {"p": 1 - LABELS[label] / 2, **signs}.items()
    }


def kernel_by_values(K: RationalFunctions, labels: list[str]) -> NamedKernel:
    """A kernel known by p = phi, g = phi'/z and c = phi'' at the labelled multiples of z_1; beyond z = 1 it is zero.

    The slope of phi is z g, that of phi' is c, and that of g is (c - g)/z; at z = 0, where g = c, odd ones vanish.
    Without the generators c the kernel has no derivative, which `NamedFunction` then refuses.
    """
    curved = f"c_{labels[0]}" in K.generators
    phi, over, slopes = {}, {}, {}
    for label in labels:
        place = LABELS[label] * K.witness(K.generator("z_1"))
        z = K.generator("z_1") * K.number(LABELS[label])
        p, g = K.generator(f"p_{label}"), K.generator(f"g_{label}")
        phi[place] = (p, z * g)
        if curved:
            c = K.generator(f"c_{label}")
            over[place] = (g, (c - g) / z if place else K.zero())
            slopes[place] = (z * g, c if place else g)
    return NamedKernel("named", NamedFunction(phi, NamedSlope(over, None, slopes) if curved else None))


def in_kernel_values(form: sympy.Expr) -> sympy.Expr:
    """The form, factored, in z, p0, p1, d1 = phi'(z), c1, e1, e3 instead of the generators."""
    z = sympy.Symbol("z")
    names = {"z_1": z, "p_0": "p0", "p_1": "p1", "c_1": "c1", "p_half": "e1", "p_threehalf": "e3"}
    put_in = {sympy.Symbol(old): sympy.Symbol(new) if isinstance(new, str) else new for old, new in names.items()}
    put_in[sympy.Symbol("g_1")] = sympy.Symbol("d1") / z
    return sympy.factor(form.subs(put_in))


def names_of_kernel(name: str, z: Fraction) -> dict[str, sympy.Rational]:
    """The named values of one of the kernels at z = h/a, exactly, to be put into a form."""
    K, phi = Exact(), kernel(name).phi
    values = {
        "z": z,
        "p0": phi(Fraction(0), K),
        "p1": phi(z, K),
        "d1": phi.derivative()(z, K),
        "c1": phi.derivative(2)(z, K),
        "e1": phi(z / 2, K),
        "e3": phi(3 * z / 2, K),
    }
    return {key: sympy.Rational(value.numerator, value.denominator) for key, value in values.items()}
