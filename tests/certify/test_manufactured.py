"""Manufactured solutions are only as good as their derivatives: F and the body force are held against difference quotients of u and P."""

import numpy as np
import pytest

from rkverify.certify.mechanics.manufactured import LAWS, Solution
from rkverify.certify.order import observed

X = np.random.default_rng(0).uniform(0, 1, (20, 2))


@pytest.mark.parametrize("law", LAWS)
def test_the_gradient_is_that_of_the_displacement(law):
    solution = Solution(*LAWS[law][:2])
    for j in range(2):
        step = np.zeros(2, dtype=complex)
        step[j] = 1e-100j
        slope = solution.u(X + step).imag / 1e-100
        assert abs(slope + np.eye(2)[j] - solution.F(X)[:, :, j]).max() <= 1e-14


@pytest.mark.parametrize("law", LAWS)
def test_the_body_force_is_minus_the_divergence_of_the_stress(law):
    """Central differences of P with a step of 1e-5: error of 1e-10 from the third derivative, 1e-11 from rounding."""
    solution = Solution(*LAWS[law][:2])
    e, total = 1e-5, np.zeros_like(X)
    for j in range(2):
        step = e * np.eye(2)[j]
        total += (solution.stress(X + step) - solution.stress(X - step))[:, :, j] / (2 * e)
    assert abs(total + solution.body_force(X)).max() <= 1e-8
    assert abs(solution.body_force(X)).max() > 0.1


def test_an_order_is_accepted_by_its_rule_alone():
    h = [1.0, 0.5, 0.25]
    assert observed(h, [1.0, 0.25, 0.0625]).reaches(2.0)
    assert not observed(h, [1.0, 0.25, 0.0625]).reaches(3.0)
    assert not observed(h, [1.0, 0.5, 0.03]).settled
    assert not observed(h[:2], [1.0, 0.25]).settled
