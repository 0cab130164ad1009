"""SPH on its own: the coded equations are the published ones, their linearisation is the closed relation, runs grow as it says.

Two routes to omega^2 share nothing but the kernel's coefficients: complex steps through the nonlinear equations, and sums
over the lattice. A measured growth shares with neither of them more than the equations.
"""

from dataclasses import replace
from fractions import Fraction
from math import pi

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Float
from rkverify.certify import sph_comparison, sph_relations, sph_terms
from rkverify.certify.sph_print import printed_with_sph_shapes
from rkverify.errors import BadInput, UnknownName
from rkverify.kernels import KERNELS, kernel
from rkverify.solid.kernel_values import Array, kernel_values
from rkverify.solid.sph import Cloud, Particles, SphForm, density, rates
from rkverify.stability.simulate import measure_flow
from rkverify.stability.sph import (
    FORMS,
    SphBase,
    bar_omega_squared,
    growth,
    lagrangian_bar,
    omega_squared,
    symbol,
)
from rkverify.stability.sph_simulate import Packet, measure, measure_lagrangian, packet_gain

RATIOS = ("11/10", "3/2", "7/4", "2", "5/2", "7/2")
SMOOTH = tuple(name for name, k in KERNELS.items() if k.continuity >= 2)
KH = np.array([0.3, 1.1, 2.0, 3.0, pi])
SYMMETRIC = FORMS["symmetric, continuity density"]
COUNT, PERIOD = 14, 14.0


def uneven(form: SphForm, seed: int = 3) -> tuple[Particles, Cloud]:
    """Particles that are off their lattice by up to a fifth, with velocities, densities and masses of their own."""
    rng = np.random.default_rng(seed)
    x = np.arange(COUNT) + rng.uniform(-0.2, 0.2, COUNT)
    cloud = Cloud(x, rng.uniform(-1, 1, COUNT), rng.uniform(0.9, 1.1, COUNT), PERIOD)
    return Particles(form, 2.3, rng.uniform(0.9, 1.1, COUNT), kernel("cubic"), 1.0, 0.3, 1.0), cloud


def slopes(p: Particles, s: Cloud) -> tuple[Array, Array]:
    """x_I - x_J to the nearest image, and W' there, by the kernel alone."""
    y = s.x[:, None] - s.x[None, :]
    y = y - np.round(y / s.period) * s.period
    return y, kernel_values(p.kernel, y, p.support, 1)[1] / (2 * p.support * float(p.kernel.phi.moment(0)))


@pytest.mark.parametrize("form", [SphForm(), SYMMETRIC])
def test_the_symmetric_form_is_the_momentum_equation_of_sph_codes(form: SphForm) -> None:
    """v_I' = sum_J m_J (sigma_I/rho_I^2 + sigma_J/rho_J^2) W'(x_I - x_J), written out pair by pair; so is rho'.

    Sums of fewer than 10 terms below 10: a thousand roundings.
    """
    p, s = uneven(form)
    rho = density(p, s)
    T = p.stress_at(rho) / rho**2
    _, slope = slopes(p, s)
    _, v_rate, rho_rate = rates(p, s)
    for I in range(COUNT):
        pairs = range(COUNT)
        expected = sum(p.masses[J] * (T[I] + T[J]) * slope[I, J] for J in pairs)
        compressed = sum(p.masses[J] * (s.v[I] - s.v[J]) * slope[I, J] for J in pairs)
        assert abs(v_rate[I] - expected) <= 1e3 * 2.0**-52
        assert abs(rho_rate[I] - compressed) <= 1e3 * 2.0**-52


def test_summation_density_changes_as_continuity_says() -> None:
    """d/dt sum_J m_J W(x_I - x_J) by a complex step along the velocities is the rate that continuity density integrates."""
    p, s = uneven(SphForm())
    step = 1e-30
    moved = density(p, replace(s, x=s.x + 1j * step * s.v)).imag / step
    assert abs(moved - rates(p, s)[2]).max() <= 1e3 * 2.0**-52


@pytest.mark.parametrize("law", ["truesdell", "cauchy-rate"])
def test_the_equation_of_state_is_the_law(law: str) -> None:
    """-rho dsigma/drho = C + sigma, or C, exactly, by a complex step; C = 1."""
    p, _ = uneven(SphForm(law=law))
    rho = np.array([0.7, 1.0, 1.3])
    slope = p.stress_at(rho + 1e-30j).imag / 1e-30
    tangent = 1.0 + p.stress_at(rho) if law == "truesdell" else 1.0
    assert abs(-rho * slope - tangent).max() <= 10 * 2.0**-52
    assert p.stress_at(np.array([1.0]))[0] == pytest.approx(0.3, abs=2.0**-52)


@pytest.mark.parametrize(
    ("name", "conserves"),
    [
        ("symmetric, summation density", True),
        ("corrected gradient", True),
        ("corrected differences", False),
        ("Galerkin", False),
    ],
)
def test_work_conjugate_forces_conserve_momentum_and_the_others_do_not(name: str, conserves: bool) -> None:
    p, s = uneven(FORMS[name])
    total = abs((p.masses * rates(p, s)[1]).sum())
    assert (total <= 1e3 * 2.0**-52) if conserves else (total > 1e-3)


@pytest.mark.parametrize(("gradient", "exact"), [("corrected", True), ("direct", False), ("smoothed", False)])
def test_the_corrected_gradient_is_exact_for_linear_fields(gradient: str, exact: bool) -> None:
    """v = x/5 on uneven particles: rho' = -rho/5."""
    p, s = uneven(SphForm("continuity", weights="neighbour", gradient=gradient))
    moving = replace(s, v=s.x / 5, period_rate=PERIOD / 5)
    off = abs(rates(p, moving)[2] / s.rho + 0.2).max()
    assert (off <= 1e3 * 2.0**-52) if exact else (off > 1e-3)


@pytest.mark.parametrize(
    ("form", "free"),
    [
        (FORMS["Galerkin, smoothed over cells"], True),
        (replace(FORMS["Galerkin, smoothed over cells"], volume="density"), False),
        (replace(FORMS["Galerkin, smoothed over cells"], pairing="antisymmetric"), False),
        (FORMS["corrected differences"], True),
        (FORMS["Galerkin"], False),
    ],
)
def test_which_forms_feel_a_uniform_stress(form: SphForm, free: bool) -> None:
    """Where a uniform stress makes no force on uneven particles it has no geometric part: nothing to be unstable with."""
    p, s = uneven(form)
    force = abs(rates(p, replace(s, rho=np.ones(COUNT)))[1]).max()
    assert (force <= 1e3 * 2.0**-52) if free else (force > 1e-3)


def roughness(name: str) -> float:
    """What rounding is multiplied by: sum_t |c_t| p (p - 1) b_t^(p - 2), the terms of phi'' without cancellation."""
    return sum(
        abs(float(t.coefficient)) * t.power * (t.power - 1) * float(t.end) ** (t.power - 2)
        for t in kernel(name).phi.terms
    )


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("form", FORMS)
def test_two_routes_agree_to_rounding(form: str, name: str) -> None:
    """Every R and kernel of class C2, both stress laws. W'' <= roughness / int phi; 500 operations of this size, and omega^2
    is of the order of its square where the gradient is divided by its sum over a support that hardly reaches (R = 11/10).
    """
    K = Multiprecision(30)
    size = roughness(name) / float(2 * kernel(name).phi.moment(0))
    for R in RATIOS:
        for law in ("truesdell", "cauchy-rate"):
            chosen = replace(FORMS[form], law=law)
            for s in ("1/2", "-1/2"):
                linear = omega_squared(SphBase(chosen, R, s, 0, name), KH)
                closed = [float(sph_relations.omega_squared(chosen, name, R, s, K.number(float(t)), K)) for t in KH]
                assert abs(linear - closed).max() <= 500 * 2.0**-52 * size * max(1.0, *map(abs, closed)), (R, law, s)


def test_the_sum_of_the_kernel_is_not_the_density() -> None:
    """The twin: m/h in place of m sum W gives another relation at R = 3/2, and the same at R = 2, where the cubic sums to 1."""
    summed, carried = (FORMS[f"symmetric, {d} density"] for d in ("summation", "continuity"))
    for R, same in (("3/2", False), ("2", True)):
        gap = abs(omega_squared(SphBase(summed, R, "1/2"), KH) - omega_squared(SphBase(carried, R, "1/2"), KH)).max()
        assert (gap < 1e-12) == same


@pytest.mark.decides("C61")
@pytest.mark.parametrize("name", SMOOTH)
def test_the_criterion_comes_out(name: str) -> None:
    """At kh = pi omega^2 = -8 m sigma W''(h)/rho^2 while the third neighbour is out of reach; the twin is at R = 7/2."""
    K = Float()
    for R in ("11/10", "3/2", "7/4", "2", "5/2", "3", "7/2"):
        linear = omega_squared(SphBase(SYMMETRIC, R, "1/3", 0, name), np.array([pi]))[0]
        short = sph_relations.criterion(name, R, "1/3", 1.0, K)
        assert (abs(linear - short) <= 1e-12 * max(1.0, abs(short))) == (float(Fraction(R)) <= 3)


def test_omega_squared_is_affine_in_the_stress() -> None:
    """What limits of the stress from two stresses rest on: a third one lies on the line, for every relation compared."""
    kh = sph_comparison.wave_numbers(6)
    for name, relation in sph_comparison.RELATIONS.items():
        line = sph_comparison.spectrum(name, "cubic", "7/4", kh)
        assert abs(line.at(0.2) - relation("cubic", "7/4", "1/5", kh)).max() <= 2 * sph_comparison.NOTHING, name


@pytest.mark.decides("C55")
def test_87_with_the_shape_functions_of_sph_is_the_weak_form_of_sph() -> None:
    """To rounding with Psi_I = V_I W, sigma' = C L and R <= 2; not with another law, the symmetric form, or a wider support."""
    for row in printed_with_sph_shapes(["cubic", "wendland-c2"], ["11/10", "3/2", "2", "5/2"], 12):
        same = row["form"] == "Galerkin" and row["law"] == "cauchy-rate" and row["support_ratio"] != "5/2"
        assert row["equal"] == same, row


@pytest.mark.decides("C12", "C63")
def test_41_without_N_is_sph_but_for_one_term() -> None:
    """Exact rationals on uneven nodes; on even ones the term is zero."""
    rows = sph_terms.term_rows(sph_terms.uneven_nodes(12, Fraction(1, 20)), "7/4", Fraction(1, 3), 4)
    assert all(row["equal"] and row["mass"] == 1 for row in rows)
    assert min(abs(row["missing"]) for row in rows) > 1e-3
    even = sph_terms.term_rows([Fraction(I) for I in range(12)], "7/4", Fraction(1, 3), 4)
    assert all(row["missing"] == 0 for row in even)


@pytest.mark.decides("C5")
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("R", "s"), [("3/2", "1/2"), ("3/2", "-1/2"), ("5/2", "1/2"), ("5/2", "-1/2")])
def test_runs_grow_as_the_linearisation_says(form: str, R: str, s: str) -> None:
    """To one part in a thousand, the accuracy that a growth is quoted with; here it is far better."""
    base = SphBase(FORMS[form], R, s)
    found = measure(base, 7 * pi / 8)
    squared = omega_squared(base, np.array([found.kh]))[0]
    fastest = max(root.growth if squared < 0 else abs(root.re) for root in found.roots)
    assert abs(fastest - abs(squared) ** 0.5) <= 1e-3 * abs(squared) ** 0.5


@pytest.mark.decides("C6")
@pytest.mark.parametrize("s", ["-3/2", "-1/2", "0", "1/2", "3/2"])
@pytest.mark.parametrize("form", ["symmetric, continuity density", "corrected gradient"])
def test_with_a_lagrangian_kernel_the_tangent_alone_decides(form: str, s: str) -> None:
    base = SphBase(FORMS[form], "7/4", s)
    squared = bar_omega_squared(lagrangian_bar(base, 2 * base.reach + 2), KH[:-1])
    tangent = 1 + float(Fraction(s))
    assert ((squared > 0) == (tangent > 0)).all()
    found = measure_lagrangian(base, pi / 2)
    at = bar_omega_squared(lagrangian_bar(base, 2 * base.reach + 2), np.array([found.kh]))[0]
    assert abs(found.kh - pi / 2) < pi / 20  # of the waves on a chain of ten or more, one is as near
    fastest = max(root.growth if tangent < 0 else abs(root.re) for root in found.roots)
    assert abs(fastest - abs(at) ** 0.5) <= 1e-3 * abs(at) ** 0.5


@pytest.mark.parametrize("s", [Fraction(-1, 2), Fraction(1, 2)])
def test_long_waves_of_the_bar_travel_with_its_tangent(s: Fraction) -> None:
    """omega^2 -> (C + S) (kh)^2: exactly where the gradient is corrected, to the error of a sum as a quadrature where not."""
    for form, error in (("corrected gradient", 1e-3), ("symmetric, continuity density", 0.1)):
        base = SphBase(FORMS[form], "5/2", s)
        squared = bar_omega_squared(lagrangian_bar(base, 2 * base.reach + 2), np.array([0.02]))[0]
        assert abs(squared / (1 + s) / 0.02**2 - 1) < error


@pytest.mark.parametrize("s", ["-1/2", "1/2"])
def test_growth_is_what_the_eigenvalues_say(s: str) -> None:
    """At rest by the root of -omega^2, which eigenvalues know to the square root of rounding only; some wave grows."""
    base = SphBase(SYMMETRIC, "3/2", s)
    found = growth(base, KH)
    assert abs(found - np.linalg.eigvals(symbol(base, KH)).real.max(axis=1)).max() < 1e-6
    assert (found.max() > 0.1) == (s == "1/2")


def test_long_waves_compress_where_the_velocity_falls() -> None:
    """A(kh) of rho' = -rho v_,x is -i kh: the sign of the wave, which no omega^2 of a lattice shows; to the square of kh."""
    off = []
    for kh in (0.02, 0.01):
        A = symbol(SphBase(FORMS["corrected differences"], "5/2", "1/2"), np.array([kh]))[0]
        off.append(abs(A[2, 1] / (-1j * kh) - 1))
    assert off[0] < 0.02**2
    assert 3.9 < off[0] / off[1] < 4.1


def test_a_wave_is_measured_beside_another_that_is_there() -> None:
    """z'' = -4 z + a uniform force: it moves all particles alike, which has no amplitude in a wave that fits twice on eight."""
    push, kh = 1e-6, pi / 2

    def slope(_: float, z: Array) -> Array:
        return np.concatenate([z[8:], -4 * z[:8] + 1e-3 * push])

    found = measure_flow(slope, np.zeros(16), 8, kh, 0.1, push)
    assert max(abs(abs(root.re) - 2) for root in found.roots) < 1e-7  # steps of 1e-10 of the push, over 4 radians
    assert max(abs(root.growth) for root in found.roots) < 1e-7


@pytest.mark.decides("C64", "C73")
@pytest.mark.parametrize("convection", ["psi-star", "true"])
def test_the_convective_term_does_nothing_at_rest_and_takes_sides_in_motion(convection: str) -> None:
    """Frozen coefficients and nonlinear runs agree on the side: it damps a stretching chain and drives a shrinking one."""
    plain, with_term = SYMMETRIC, replace(SYMMETRIC, convection=convection)
    at_rest = [omega_squared(SphBase(form, "3/2", "1/2"), KH) for form in (plain, with_term)]
    assert (at_rest[0] == at_rest[1]).all()
    packet = Packet(inner=14, duration=0.6)
    for Q, side in (("1/10", -1), ("-1/10", 1)):
        frozen = [growth(SphBase(form, "3/2", "1/2", Q), KH).max() for form in (plain, with_term)]
        runs = [packet_gain(SphBase(form, "3/2", "1/2", Q), packet) for form in (plain, with_term)]
        assert np.sign(frozen[1] - frozen[0]) == side
        assert np.sign(runs[1] - runs[0]) == side


def test_an_image_is_as_good_as_its_particle() -> None:
    """A particle moved by one period, with the velocity of that image, leaves the others' accelerations as they were.

    With N as well, although N depends on the frame: each sees the image that is nearest.
    """
    p, s = uneven(replace(SYMMETRIC, convection="psi-star"))
    base = replace(s, v=s.v + s.x / 7, period_rate=PERIOD / 7)
    x, v = base.x.copy(), base.v.copy()
    x[5], v[5] = x[5] + PERIOD, v[5] + PERIOD / 7
    moved = rates(p, replace(base, x=x, v=v))[1]
    others = np.arange(COUNT) != 5
    assert abs(moved - rates(p, base)[1])[others].max() <= 1e4 * 2.0**-52


def test_no_neighbour_beyond_the_reach_counts() -> None:
    """The outermost coefficients of every stencil are zero, so that none is cut off; frozen motion and all additions."""
    for gradient in ("direct", "corrected", "smoothed"):
        for convection in ("none", "psi-star", "true"):
            form = SphForm("continuity", "galerkin", "neighbour", gradient, convection=convection)
            narrow = SphBase(form, "5/2", "1/2", "1/10")

            class Wider(SphBase):
                """The same base with more neighbours in its stencil."""

                @property
                def reach(self) -> int:
                    return 14

            wide = Wider(form, "5/2", "1/2", "1/10")
            assert abs(symbol(narrow, KH) - symbol(wide, KH)).max() <= 1e4 * 2.0**-52, (gradient, convection)


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: SphForm(strain="smoothed"), BadInput),
        (lambda: SphForm(gradient="sharp"), UnknownName),  # type: ignore[arg-type]
        (lambda: SphBase(SYMMETRIC, "3/2", kernel="tent"), BadInput),
        (lambda: SphBase(SYMMETRIC, "1"), BadInput),
        (lambda: SphBase(SYMMETRIC, "3/2", kernel="square"), UnknownName),
        (lambda: omega_squared(SphBase(SYMMETRIC, "3/2", 0, "1/10"), KH), BadInput),
        (lambda: measure(SphBase(SYMMETRIC, "3/2", 0, "1/10"), 2.0), BadInput),
        (lambda: packet_gain(SphBase(SphForm(), "3/2"), Packet()), BadInput),
        (
            lambda: sph_relations.omega_squared(
                replace(SYMMETRIC, gradient="smoothed"), "cubic", "3/2", 0, 1.0, Float()
            ),
            BadInput,
        ),
        (
            lambda: sph_relations.omega_squared(replace(SYMMETRIC, convection="true"), "cubic", "3/2", 0, 1.0, Float()),
            BadInput,
        ),
    ],
)
def test_what_has_no_answer_is_refused(make, error: type[Exception]) -> None:
    with pytest.raises(error):
        make()


def test_the_convective_force_of_the_true_rate_is_a_difference_in_time() -> None:
    """sum_J d(V_J W(x_K - x_J))/dt v_J with V' = -V rho'/rho, by central differences over the motion, tested by V_I W and masses."""
    form = FORMS["symmetric, continuity density"]
    p, s = uneven(form)
    x_rate, still, rho_rate = rates(p, s)
    moving = rates(replace(p, form=replace(form, convection="true")), s)[1]
    step = 1e-6

    def carried(h: float) -> Array:
        y = (s.x + h * x_rate)[:, None] - (s.x + h * x_rate)[None, :]
        y = y - np.round(y / PERIOD) * PERIOD
        W = kernel_values(p.kernel, y, p.support, 0)[0] / (2 * p.support * float(p.kernel.phi.moment(0)))
        return p.masses / (s.rho + h * rho_rate) * W

    slope = (carried(step) - carried(-step)) / (2 * step)
    expected = carried(0.0).T @ (p.masses * (slope @ s.v))
    # the next term: step^2 times third derivatives below 1e3; rounding 2^-52 over the step
    assert abs(p.masses * (still - moving) - expected).max() < 1e-8
    assert abs(expected).max() > 1e-2
