"""H(y): which monomials, in which order, and their derivatives against duals and series."""

from fractions import Fraction
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rkverify.arithmetic.dual import Duals
from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.series import Series
from rkverify.paper.basis import basis, basis_rate, basis_second_rate, exponents
from rkverify.paper.numbered import TRANSCRIBED

K = Exact()
COORDINATE = st.fractions(-3, 3, max_denominator=20)
VECTORS = st.integers(1, 3).flatmap(lambda d: st.tuples(*[st.tuples(*[COORDINATE] * d)] * 3))
ORDERS = st.integers(0, 3)


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_every_monomial_up_to_the_order_once(dimension: int, order: int) -> None:
    """binom(n + d, d) of them, by degree: decides that the basis is complete, which reproduction needs."""
    found = exponents(dimension, order)
    assert len(found) == len(set(found)) == comb(order + dimension, dimension)
    assert [sum(alpha) for alpha in found] == sorted(sum(alpha) for alpha in found)
    assert max(map(sum, found)) == order


def test_the_order_of_the_monomials_is_the_papers() -> None:
    """(5): 1, y_1, y_2, y_1^2, …, y_2^n."""
    assert basis((Fraction(2), Fraction(3)), 2, K) == [1, 2, 3, 4, 6, 9]


@given(vectors=VECTORS, order=ORDERS)
def test_rates_are_the_slopes_of_duals(vectors: tuple[tuple[Fraction, ...], ...], order: int) -> None:
    """dH/dt where y moves at w: the product rule of duals differentiates the monomials another way."""
    y, w, _ = vectors
    D = Duals(K, 1)
    moving = basis(tuple(D.along(c, [r]) for c, r in zip(y, w, strict=True)), order, D)
    assert basis_rate(y, w, order, K) == [h.partials[0] for h in moving]


@given(vectors=VECTORS, order=ORDERS)
def test_second_rates_are_the_slopes_of_the_rates(vectors: tuple[tuple[Fraction, ...], ...], order: int) -> None:
    """d2H along u and w against duals of the first rate, and against the t^2 coefficient where u = w."""
    y, u, w = vectors
    D, S = Duals(K, 1), Series(3)
    constant = tuple(D.number(c) for c in u)
    moving = basis_rate(tuple(D.along(c, [r]) for c, r in zip(y, w, strict=True)), constant, order, D)
    assert basis_second_rate(y, u, w, order, K) == [h.partials[0] for h in moving]
    straight = basis(tuple(S.variable(c, r) for c, r in zip(y, u, strict=True)), order, S)
    assert basis_second_rate(y, u, u, order, K) == [2 * S.coefficients(h)[2] for h in straight]


def test_each_equation_number_names_what_transcribes_it() -> None:
    for number in (5, 10, 33):
        assert "rkverify.paper.basis.basis" in TRANSCRIBED[number]
