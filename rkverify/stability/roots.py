"""Roots of omega^2 + B omega + C = 0 with real B and C, without complex numbers, in any real arithmetic."""

from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar


@dataclass(frozen=True)
class Root:
    """omega = re + i im (1/time); the wave e^{i(kx + omega t)} grows at the rate -im."""

    re: Scalar
    im: Scalar

    @property
    def squared(self) -> tuple[Scalar, Scalar]:
        """Real and imaginary part of omega^2; 1/time^2."""
        return self.re * self.re - self.im * self.im, 2 * self.re * self.im

    @property
    def growth(self) -> Scalar:
        """-Im(omega); 1/time."""
        return -self.im


def quadratic_roots(B: Scalar, D: Scalar, K: Arithmetic) -> tuple[Root, Root]:
    """omega = (-B ± sqrt(D))/2 with D = B^2 - 4 C: the root with the upper sign of Re first, and of growth where D < 0.

    >>> from rkverify.arithmetic.native import Float
    >>> [r.growth for r in quadratic_roots(0.0, -4.0, Float())]
    [1.0, -1.0]
    """
    if K.sign(D) >= 0:
        half = K.sqrt(D) / 2
        return Root(-B / 2 + half, K.zero()), Root(-B / 2 - half, K.zero())
    half = K.sqrt(-D) / 2
    return Root(-B / 2, -half), Root(-B / 2, half)
