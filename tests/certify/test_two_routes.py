"""The checks behind the study of two routes, each with a twin that shows that it can fail."""

from dataclasses import replace
from fractions import Fraction

import pytest

from rkverify.certify import two_routes
from rkverify.certify.two_routes import (
    AGREEMENT,
    bar_residual,
    bar_rows,
    exact_chain,
    force_is_energy_slope,
    load_totals,
    reading_changes,
    stencil_rows,
)
from rkverify.readings import DERIVATIVES


def test_every_option_of_every_reading_is_there_with_and_without_n() -> None:
    changes = reading_changes()
    for choice, options in two_routes.CHOICES.items():
        for option in options[1:]:
            assert changes[f"{choice} = {option}"] == {choice: option}
            if choice != "convection":
                assert changes[f"{choice} = {option}, no N"]["convection"] == "none"


@pytest.mark.decides("E66", "E67", "E69")
def test_the_stencils_agree_and_a_changed_one_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    assert all(row["agree"] for row in stencil_rows(["3/2"], "1/3", "1/5", "1/7") + bar_rows(["3/2"], "1/3", "6/5"))
    true = two_routes.jacobian_solid.stencil

    def off(base):
        found = true(base)
        found["v", "x"][0] += 100 * AGREEMENT
        return found

    monkeypatch.setattr(two_routes.jacobian_solid, "stencil", off)
    assert not any(row["agree"] for row in stencil_rows(["3/2"], "1/3", "1/5", "1/7"))


@pytest.mark.decides("E49", "E51")
@pytest.mark.parametrize("integration", ["scni", "dni"])
def test_forces_are_slopes_of_the_energy(integration: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert force_is_energy_slope(integration)
    monkeypatch.setattr(two_routes.LagrangianChain, "stress", lambda self, F: F * (self.modulus + self.prestress))
    assert not force_is_energy_slope(integration)


@pytest.mark.decides("E50")
def test_loads_have_their_total_and_do_their_work() -> None:
    assert load_totals() == {"total": True, "virtual work": True}


def test_a_load_on_the_wrong_end_does_other_work() -> None:
    """The total alone would not see it."""
    chain, _ = exact_chain("scni")
    forces = [
        chain.external_force(I, Fraction(0), Fraction(1), {0: Fraction(1)}) for I in range(len(two_routes.UNEVEN))
    ]
    assert sum(forces) == 1
    assert sum(f * X for f, X in zip(forces, two_routes.UNEVEN, strict=True)) != two_routes.UNEVEN[-1]


@pytest.mark.decides("E48", "E56")
def test_the_bar_satisfies_the_transcription_with_its_mass_and_not_with_the_other() -> None:
    assert bar_residual("consistent") <= AGREEMENT
    assert bar_residual("lumped") <= AGREEMENT
    chain, u = exact_chain("scni")
    heavier = replace(chain, rho_0=2 * chain.rho_0)
    assert heavier.acceleration(3, u) == chain.acceleration(3, u) / 2


@pytest.mark.parametrize("derivative", DERIVATIVES)
@pytest.mark.parametrize("stretch", [1.0, 1.2, 0.7])
def test_the_nonlinear_bars_agree_in_every_reading(
    derivative: str, stretch: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Large displacements from an uneven state: F = 1 + sum_I b_I u_I by both routes. The twin: with F = sum_I b_I x_I they part
    where gradients do not reproduce linear fields, and nowhere else.
    """
    # R = 5/2: the frozen gradients of linear fields are off by much; rounding is some 1e-15 of the largest acceleration
    assert bar_residual("lumped", 2.5, 14, "dni", derivative, stretch) <= AGREEMENT

    def of_places(chain, L, u):
        return sum(b * (u[I] + I - 14) for I, b in chain.gradients[L].items())

    monkeypatch.setattr(two_routes.LagrangianChain, "deformation_gradient", of_places)
    apart = bar_residual("lumped", 2.5, 14, "dni", derivative, stretch)
    assert (apart <= AGREEMENT) == (derivative in ("full", "diffuse"))
    assert apart <= AGREEMENT or apart > 1e-2
