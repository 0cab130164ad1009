"""The equations in the plane, (7), (18)-(22), (24), (37), (41)-(46): exact, on random rational plates.

Decides that what is transcribed is the mechanics that it claims to be: forces are slopes of energies, residuals do the work
of weak forms, totals are those of the loads. All in rationals, so that a wrong index, sign or factor cannot hide in rounding.
"""

from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from rkverify.arithmetic.native import Exact, Float
from rkverify.arithmetic.symbolic import Symbolic
from rkverify.certify import index_convention, mass_exchange, semi_balances, solid_balances, weak_form_checks
from rkverify.certify.index_convention import LAWS, energy_slopes, forces, moment, solid
from rkverify.certify.plates import MODULI, RHO_0, Plate, homogeneous
from rkverify.certify.weak_form_checks import random_deformation
from rkverify.errors import BadInput, UnknownName
from rkverify.paper.approximation import approximation
from rkverify.paper.chain_rule import determinant, inverse
from rkverify.paper.constitutive import (
    Moduli,
    cauchy_work,
    linear,
    linear_energy,
    neo_hookean,
    neo_hookean_energy,
    nominal_stress,
    nominal_work,
    product,
    saint_venant_kirchhoff,
    saint_venant_kirchhoff_energy,
    transpose,
)
from rkverify.paper.lagrangian_solid import LagrangianSolid, carried
from rkverify.paper.semi_lagrangian_solid import SemiLagrangianSolid, shapes_at_nodes

K = Exact()
SEEDS = st.integers(0, 10**6)
SHEAR = [[Fraction(1), Fraction(1, 2)], [Fraction(0), Fraction(1)]]
few = settings(max_examples=max(5, settings().max_examples // 5))  # a plate in rationals takes a tenth of a second


@pytest.fixture(scope="module")
def plate() -> Plate:
    return Plate(3, 11)


@pytest.fixture(scope="module")
def lagrangian(plate: Plate) -> list[dict]:
    return solid_balances.lagrangian_rows(plate)


@pytest.fixture(scope="module")
def semi(plate: Plate) -> list[dict]:
    return semi_balances.semi_lagrangian_rows(plate)


def exact(rows: list[dict], equation: str, without: str = "nothing at all") -> list[bool]:
    found = [row["exact"] for row in rows if row["equation"] == equation and without not in row["check"]]
    assert found
    return found


@pytest.mark.parametrize("law", ["St. Venant-Kirchhoff", "neo-Hookean", "linear"])
@pytest.mark.parametrize("d", [1, 2])
def test_nominal_stress_is_the_slope_of_energy_for_all_deformations(law: str, d: int) -> None:
    """P_ki = dW/dF_ik as an identity in the entries of F and the moduli: proved, not sampled."""
    F = [[sympy.Symbol(f"F{i}{k}", positive=i == k) for k in range(d)] for i in range(d)]
    S = Symbolic({F[i][k]: Fraction(int(i == k)) for i in range(d) for k in range(d)})
    C = Moduli(*sympy.symbols("lambda mu", positive=True))
    energy, P = {
        "St. Venant-Kirchhoff": lambda: (saint_venant_kirchhoff_energy(F, C, S), saint_venant_kirchhoff(F, C, S)),
        "neo-Hookean": lambda: (neo_hookean_energy(F, C, sympy.log), neo_hookean(F, C, S)),
        "linear": lambda: (linear_energy(F, C, S), linear(F, C, S)),
    }[law]()
    for i in range(d):
        for k in range(d):
            assert sympy.simplify(sympy.diff(energy, F[i][k]) - P[k][i]) == 0


@pytest.mark.decides("E7")
def test_the_virtual_work_of_7_is_the_energys_slope(plate: Plate) -> None:
    """(7) at rest and without loads, for delta u of one node and axis, is dW/dd_iI; and with the strong form it is 0."""
    body, d = solid(plate, "St. Venant-Kirchhoff", "scni"), plate.vectors(1, Fraction(1, 5))
    slopes, zero = energy_slopes(body, "St. Venant-Kirchhoff", d), [(Fraction(0),) * 2] * len(d)
    for I in range(len(d)):
        for i in range(2):
            delta = list(zero)
            delta[I] = tuple(Fraction(int(j == i)) for j in range(2))
            assert solid_balances.weak_form_work(body, d, delta, zero, [], zero) == slopes[I][i]
    left = {(row["equation"], row["stress"]): row["left"] for row in weak_form_checks.strong_form_rows()}
    assert left["(7)", "as printed"] == left["(37)", "as printed"] == "0"
    assert left["(7)", "transposed"] != "0"


@pytest.mark.decides("E21", "E22")
@pytest.mark.parametrize("integration", ["scni", "dni"])
@pytest.mark.parametrize("law", LAWS)
@few
@given(SEEDS)
def test_force_is_the_energys_slope_with_the_axis_of_space_first(law: str, integration: str, seed: int) -> None:
    body, d = solid(Plate(2, seed), law, integration), Plate(2, seed).vectors(1, Fraction(1, 5))
    assert forces(body, d, "first") == [tuple(slope) for slope in energy_slopes(body, law, d)]


@pytest.mark.decides("E22")
@few
@given(SEEDS)
def test_22_with_the_nominal_stress_is_wrong_in_shear(seed: int) -> None:
    """The twin: with P of (7) and (24) in the printed order, simple shear has forces with a moment; stretch has not.

    The moment is sum_L (F P)_12 - (F P)_21 of the transposed stress: for F = [1 g; 0 1] that of St. Venant-Kirchhoff is not 0.
    """
    plate = Plate(2, seed)
    body, nodes = solid(plate, "St. Venant-Kirchhoff", "scni"), plate.A.nodes
    sheared = homogeneous(nodes, SHEAR)
    slopes = energy_slopes(body, "St. Venant-Kirchhoff", sheared)
    assert forces(body, sheared, "nominal") != [tuple(slope) for slope in slopes]
    P = saint_venant_kirchhoff(SHEAR, MODULI, K)
    turned = product(SHEAR, transpose(P))
    area = sum(plate.measures)
    assert moment(nodes, sheared, forces(body, sheared, "nominal")) == area * (turned[0][1] - turned[1][0]) != 0
    assert moment(nodes, sheared, forces(body, sheared, "first")) == 0
    stretched = homogeneous(nodes, [[Fraction(3, 2), Fraction(0)], [Fraction(0), Fraction(1)]])
    assert forces(body, stretched, "nominal") == forces(body, stretched, "first")


@pytest.mark.decides("E18")
def test_18_does_the_work_of_7(lagrangian: list[dict]) -> None:
    """For random test coefficients; in the printed order with the nominal stress it does not."""
    assert exact(lagrangian, "(18)", without="nominal") == [True]
    assert exact(lagrangian, "(18)", without="first") == [False]


@pytest.mark.decides("E19", "E42")
def test_mass_matrices_by_energy_and_total(plate: Plate, lagrangian: list[dict], semi: list[dict]) -> None:
    """Symmetric, of the total mass, the second derivative of the kinetic energy; and positive: its pivots are."""
    assert all(exact(lagrangian, "(19)"))
    assert all(exact(semi, "(42)"))
    for M in (solid(plate, "linear elastic", "scni").mass, semi_balances.current(plate, False).mass):
        rows = [M(I) for I in range(9)]
        full = np.array([[float(row.get(J, 0)) for J in range(9)] for row in rows])
        assert np.linalg.eigvalsh(full).min() > 0


@pytest.mark.decides("E20", "E44")
def test_loads_by_their_work(lagrangian: list[dict], semi: list[dict]) -> None:
    assert all(exact(lagrangian, "(20)"))
    assert all(exact(semi, "(44)"))


@pytest.mark.decides("E24", "C21")
@given(SEEDS, st.integers(1, 3))
def test_24_by_energy_and_by_stress_measures(seed: int, d: int) -> None:
    """Both sides with P = S F^T, sigma = F S F^T/J for random S; with sigma not symmetric the indices still pair as printed."""
    rng = np.random.default_rng(seed)
    F = random_deformation(rng, d)
    S, slope = ([[Fraction(int(q), 9) for q in row] for row in rng.integers(-9, 10, (d, d))] for _ in range(2))
    J = determinant(F)
    symmetric = [[S[i][j] + S[j][i] for j in range(d)] for i in range(d)]
    sigma = [[s / J for s in row] for row in product(product(F, symmetric), transpose(F))]
    assert nominal_work(slope, product(symmetric, transpose(F))) == cauchy_work(slope, F, sigma, K)
    assert nominal_work(slope, nominal_stress(F, S, K)) == cauchy_work(slope, F, S, K)
    back = inverse(F, K)
    by_indices = sum(slope[i][k] * back[k][j] * S[i][j] * J for i in range(d) for k in range(d) for j in range(d))
    assert cauchy_work(slope, F, S, K) == by_indices


def test_the_work_of_24_is_an_energys_slope() -> None:
    assert all(
        row["energy"] == row["push_back"] == row["push_forward"] == "0" for row in weak_form_checks.work_rows(3, 4)
    )


@pytest.mark.decides("E37")
@given(SEEDS)
def test_37_is_7_pushed_forward(seed: int) -> None:
    assert all(row["apart"] == "0" and row["work"] != 0 for row in weak_form_checks.push_forward_rows(seed, 3))


@pytest.mark.decides("E41")
@few
@given(SEEDS)
def test_41_does_the_work_of_37(seed: int) -> None:
    """With (38) and (39) for velocity and acceleration, for random coefficients."""
    assert exact(semi_balances.semi_lagrangian_rows(Plate(2, seed)), "(41)") == [True]


@pytest.mark.decides("E41")
@few
@given(SEEDS)
def test_a_uniform_velocity_is_seen_by_psi_star_alone(seed: int) -> None:
    """Galilean invariance, mass and momentum: exact with the true rate; with Psi*, whose sum is not 0, none of them is."""
    star, true = semi_balances.frame_rows(Plate(2, seed))
    assert (true["frame"], true["mass"], true["momentum"]) == (0, 0, 0)
    assert star["frame"] > 0
    assert star["mass"] > 0
    assert not star["balances"]


@pytest.mark.decides("E43")
@few
@given(SEEDS)
def test_n_does_the_power_of_psi_star(seed: int) -> None:
    """Against Psi_J/phi_J times the derivative of phi_J by duals in time, summed without a matrix."""
    assert exact(semi_balances.semi_lagrangian_rows(Plate(2, seed)), "(43)") == [True]


@pytest.mark.decides("E45")
def test_45_by_power_total_and_moment(semi: list[dict]) -> None:
    """Exact but for a uniform stress with DNI, which the boundary does not balance: the twin."""
    assert all(exact(semi, "(45)", without="DNI"))
    assert [row["exact"] for row in semi if "DNI" in row["check"]] == [False]


@pytest.mark.decides("E46")
def test_46_is_the_full_contraction(semi: list[dict]) -> None:
    """b_jI sigma_ij for symmetric stress; one that is not loses its sigma_21, which (46) has no place for."""
    assert exact(semi, "(46)") == [True]
    sigma = [[Fraction(1), Fraction(2)], [Fraction(3), Fraction(5)]]
    assert SemiLagrangianSolid.stress_vector(sigma) == [1, 5, 2]


@pytest.mark.decides("C11")
def test_nodal_masses_change_and_their_total_does_not() -> None:
    """Rates by duals in time against differences of masses at two times, and against N's column sums with the true rate."""
    plate = Plate(3, 11)
    flow, step = mass_exchange.Flow(plate, "random"), 1e-5
    _, rates = flow.rates(Float())
    before, after = flow.followed([-step, step])
    differences = (np.array(after) - np.array(before)) / (2 * step)
    # Central differences err by m''' step^2/6, some hundred times 1e-10, and by rounding 2^-52 m/step.
    np.testing.assert_allclose(rates, differences, rtol=0, atol=1e-7)
    np.testing.assert_allclose(flow.column_sums(Float(), True), rates, rtol=0, atol=1e-12)
    assert max(map(abs, rates)) > 0.1
    assert abs(sum(rates)) < 1e-12
    assert max(abs(np.array(flow.column_sums(Float(), False)) - rates)) > 0.1


@pytest.mark.parametrize("name", ["translation", "rotation"])
def test_rigid_flows_keep_every_nodal_mass(name: str) -> None:
    _, rates = mass_exchange.Flow(Plate(3, 11), name).rates(Float())
    assert max(map(abs, rates)) < 1e-12


def test_lagrangian_masses_do_not_change(plate: Plate) -> None:
    """The twin: (19) has no argument that moves; the row of a node is the same whatever the displacements are."""
    body = solid(plate, "St. Venant-Kirchhoff", "scni")
    row = body.mass(4)
    body.internal_force(4, plate.vectors(1, Fraction(1, 5)), "first")
    assert body.mass(4) == row
    assert sum(sum(body.mass(I).values()) for I in range(9)) == RHO_0 * 9


def test_only_the_plane_has_the_printed_matrices() -> None:
    body = LagrangianSolid([({0: 1},)], [1], [{0: 1}], 1, lambda F: F, K)
    with pytest.raises(BadInput, match=r"^the matrices \(22\), \(46\) are printed for 2 dimensions, not for 1"):
        body.b_bar(0, 0)
    with pytest.raises(UnknownName, match="first, nominal"):
        body.internal_force(0, [(0, 0)], "second")


def test_shapes_at_nodes_are_those_of_each_node() -> None:
    """sum_I Psi_I(x_L) x_I = x_L tells which cell a row belongs to; totals over all cells do not."""
    A = approximation([[0], [1], ["5/2"], [4]], "5/2", K)
    rows = shapes_at_nodes(A)
    assert [sum(Psi * A.nodes[I][0] for I, Psi in row.items()) for row in rows] == [x for (x,) in A.nodes]


def test_carried_is_a_row_times_vectors() -> None:
    assert carried({0: 2, 2: 3}, [(1, 0), (5, 5), (0, 1)], K) == (2, 3)


def test_index_rows_tell_shear_from_stretch(plate: Plate) -> None:
    rows = index_convention.convention_rows(Plate(2, 3))
    wrong = {(row["law"], row["state"], row["order"]) for row in rows if not row["agrees"]}
    assert wrong == {("St. Venant-Kirchhoff", state, "nominal") for state in ("simple shear", "random")}
