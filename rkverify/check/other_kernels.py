"""Weights of least squares that are no kernels of the command line, as data."""

from fractions import Fraction
from math import comb

from rkverify.kernels import Kernel, Term, TruncatedPowers


def _power(p: int, q: int) -> Kernel:
    """(1 - z^q)^p for q = 1, 2: with z = 1 - s it is s^p, or (2 s - s^2)^p."""
    terms = [
        Term(Fraction(comb(p, k) * (-1) ** k * 2 ** (p - k)) if q == 2 else Fraction(k == 0), Fraction(1), p + k)
        for k in range(p + 1 if q == 2 else 1)
    ]
    return Kernel(f"(1 - z{'^2' * (q == 2)})^{p}", TruncatedPowers(tuple(terms)), "weights of least squares")


OTHER_KERNELS: tuple[Kernel, ...] = (
    Kernel("constant", TruncatedPowers((Term(Fraction(1), Fraction(1), 0),)), "unweighted least squares"),
    *(_power(p, 1) for p in (2, 3, 4)),
    *(_power(p, 2) for p in (1, 2, 3, 4)),
)
"""Weights that least squares are fitted with; the command line does not offer them as kernels."""
