"""Kernels as data: phi(z) = sum_t c_t (b_t - z)_+^p_t with rational c_t and b_t, for z >= 0 (equation 12 is one).

The form makes the kernel and its derivatives end exactly at zero in every arithmetic, and derivatives,
moments and continuity follow from the data. z = distance / support radius, dimensionless; the support is z < 1.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import factorial

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.errors import NotDifferentiable, UnknownName


@dataclass(frozen=True)
class Term:
    """coefficient * (end - z)_+^power."""

    coefficient: Fraction
    end: Fraction
    power: int


@dataclass(frozen=True)
class TruncatedPowers:
    """f(z) = sum_t c_t (b_t - z)_+^p_t for z >= 0."""

    terms: tuple[Term, ...]

    def __call__(self, z: Scalar, K: Arithmetic) -> Scalar:
        """f(z) in the arithmetic K.

        Raises NotDifferentiable where f jumps exactly at z.
        """
        total = K.zero()
        for t in self.terms:
            total = total + K.ratio(t.coefficient.numerator, t.coefficient.denominator) * K.pos(
                K.ratio(t.end.numerator, t.end.denominator) - z, t.power
            )
        return total

    def derivative(self, order: int = 1) -> "TruncatedPowers":
        """The derivative of the given order, from (b - z)^p -> -p (b - z)^(p-1).

        Raises NotDifferentiable where a term would lose its last power, so that the derivative is no function.
        """
        terms = self.terms
        for _ in range(order):
            if any(t.power == 0 for t in terms):
                raise NotDifferentiable(
                    "this derivative of the kernel has point masses at its joints: take a smoother kernel"
                )
            terms = tuple(Term(-t.power * t.coefficient, t.end, t.power - 1) for t in terms)
        return TruncatedPowers(terms)

    def at_zero(self) -> Fraction:
        """f(0), exactly."""
        return sum((t.coefficient * t.end**t.power for t in self.terms), Fraction(0))

    def over_z(self, z: Scalar, K: Arithmetic) -> Scalar:
        """f(z)/z, without dividing 0 by 0 where f(0) = 0.

        Inside the first joint f is a polynomial and
        (b^p - (b - z)^p)/z = sum_{k<p} b^(p-1-k) (b - z)^k is one too; beyond it z is not small.

        Raises NotDifferentiable at z = 0 where f(0) is not 0.
        """
        first = min(t.end for t in self.terms)
        if self.at_zero() != 0:
            if K.sign(z) == 0:
                raise NotDifferentiable(
                    "the kernel has a peak at its node: move the point or take a kernel of class C1"
                )
            return self(z, K) / z
        if not K.surely_positive(K.ratio(first.numerator, first.denominator) - z):
            return self(z, K) / z
        total = K.zero()
        for t in self.terms:
            c, b = (K.ratio(q.numerator, q.denominator) for q in (t.coefficient, t.end))
            for k in range(t.power):
                total = total - c * b ** (t.power - 1 - k) * (b - z) ** k
        return total

    def moment(self, degree: int) -> Fraction:
        """The integral of z^degree f(z) over z from 0 to 1, exactly: a sum of beta functions."""
        return sum(
            (
                t.coefficient
                * t.end ** (degree + t.power + 1)
                * Fraction(factorial(degree) * factorial(t.power), factorial(degree + t.power + 1))
                for t in self.terms
            ),
            Fraction(0),
        )


@dataclass(frozen=True)
class Kernel:
    """phi_a as a function of z = |x - x_I| / a, with where it comes from."""

    name: str
    phi: TruncatedPowers
    source: str

    @property
    def joints(self) -> tuple[Fraction, ...]:
        """Where the pieces meet, the edge of the support last."""
        return tuple(sorted({t.end for t in self.phi.terms}))

    def smoothness_at(self, joint: Fraction) -> int:
        """The m for which phi is C^m, and not C^(m+1), at the given joint: the least power there less one."""
        return min(t.power for t in self.phi.terms if t.end == joint) - 1

    @property
    def smoothness_at_node(self) -> int:
        """The m for which phi(|x|) is C^m at x = 0: the first odd derivative that is not zero there, less one."""
        degree = max(t.power for t in self.phi.terms)
        odd = (order for order in range(1, degree + 1, 2) if self.phi.derivative(order).at_zero() != 0)
        return next(odd, degree + 1) - 1

    @property
    def continuity(self) -> int:
        """The class C^m of phi(|x|) over the whole line."""
        return min(self.smoothness_at_node, *(self.smoothness_at(joint) for joint in self.joints))


def _kernel(name: str, source: str, terms: list[tuple[Fraction | int, Fraction | int, int]]) -> Kernel:
    return Kernel(name, TruncatedPowers(tuple(Term(Fraction(c), Fraction(b), p) for c, b, p in terms)), source)


def _b_spline(name: str, order: int, source: str) -> Kernel:
    """The cardinal B-spline M_order centred at 0, its knots scaled so that the support is |z| < 1.

    M_n(q) = sum_j (-1)^j binom(n, j) (n/2 - j - q)_+^(n-1) / (n-1)! with q = (n/2) z; M_4 is equation (12).
    """
    half = Fraction(order, 2)
    terms: list[tuple[Fraction | int, Fraction | int, int]] = [
        (
            (-1) ** j
            * Fraction(factorial(order), factorial(j) * factorial(order - j) * factorial(order - 1))
            * half ** (order - 1),
            1 - j / half,
            order - 1,
        )
        for j in range((order + 1) // 2)
    ]
    return _kernel(name, source, terms)


_SCHOENBERG = "I. J. Schoenberg, Quart. Appl. Math. 4 (1946) 45-99"
_WENDLAND = "H. Wendland, Adv. Comput. Math. 4 (1995) 389-396"

KERNELS: dict[str, Kernel] = {
    kernel.name: kernel
    for kernel in (
        _b_spline("tent", 2, "the B-spline of order 2"),
        _kernel(
            "cubic",
            "equation (12) of the paper",
            [(Fraction(4, 3), 1, 3), (Fraction(-16, 3), Fraction(1, 2), 3)],
        ),
        _b_spline("quartic", 5, f"the B-spline of order 5: {_SCHOENBERG}"),
        _b_spline("quintic", 6, f"the B-spline of order 6: {_SCHOENBERG}"),
        _kernel("wendland-c2", f"(1 - z)^4 (1 + 4 z): {_WENDLAND}", [(5, 1, 4), (-4, 1, 5)]),
        _kernel(
            "wendland-c4",
            f"(1 - z)^6 (1 + 6 z + 35 z^2 / 3): {_WENDLAND}",
            [(Fraction(56, 3), 1, 6), (Fraction(-88, 3), 1, 7), (Fraction(35, 3), 1, 8)],
        ),
    )
}


def kernel(name: str) -> Kernel:
    """The kernel of the given name.

    Raises UnknownName.

    >>> kernel("cubic").phi.at_zero(), kernel("cubic").continuity
    (Fraction(2, 3), 2)
    """
    if name not in KERNELS:
        raise UnknownName("kernel", name, list(KERNELS))
    return KERNELS[name]
