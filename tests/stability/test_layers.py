"""The layers of a stability statement: what they share, and where each stops being another.

A measured growth decides on the linearisation: nothing of it enters the measurement.
"""

from dataclasses import replace
from math import cos, pi, sin

import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact, Float
from rkverify.errors import BadInput, UnknownName
from rkverify.readings import Readings
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.lattice_state import Base
from rkverify.stability.layers import Setting, dispersion
from rkverify.stability.simulate import fitting_wave

SETTINGS = [
    (integration, R, s, kh)
    for integration, R in (("scni", "3/2"), ("dni", "3/2"), ("dni", "7/4"), ("dni", "5/2"))
    for s in ("-1/2", "1/2")
    for kh in (pi / 2, 7 * pi / 8)
]


def _largest(setting: Setting, kh: float) -> tuple[float, float]:
    roots = dispersion(setting, [kh])
    return max(b.omega.growth for b in roots), max(abs(b.omega.re) for b in roots)


@pytest.mark.parametrize(("integration", "R", "s", "kh"), SETTINGS)
def test_measured_roots_are_the_eigenvalues(integration: str, R: str, s: str, kh: float) -> None:
    """To one part in a thousand of the root, the accuracy that a growth is quoted with; here both are far better."""
    of_layer = {
        layer: _largest(Setting("semi-lagrangian", integration, R, stress_ratio=s, layer=layer), kh)
        for layer in ("as-defined", "consistent", "simulated")
    }
    size = max(of_layer["as-defined"])
    for layer in ("consistent", "simulated"):
        for one, other in zip(of_layer[layer], of_layer["as-defined"], strict=True):
            assert abs(one - other) <= 1e-3 * size, layer


@pytest.mark.decides("C2", "C42")
def test_seen_from_a_moving_node_psi_star_splits_the_frequencies() -> None:
    """At rest roots come in pairs, and a wrong sign of omega would not show; here it would."""
    setting = Setting("semi-lagrangian", "scni", "3/2", stress_ratio="1/2", frame_velocity="1")
    found = {}
    for layer in ("as-defined", "simulated"):
        branches = dispersion(replace(setting, layer=layer), [pi / 6])
        found[layer] = sorted((b.omega.re, b.omega.growth) for b in branches)
    assert abs(found["as-defined"][0][0] + found["as-defined"][1][0]) > 0.1
    for one, other in zip(found["simulated"], found["as-defined"], strict=True):
        assert abs(complex(*one) - complex(*other)) <= 1e-3 * abs(complex(*other))


def test_a_frame_tells_the_layers_apart() -> None:
    """Psi* sees a frame in motion; the true rate does not, and without N nothing does. At rest all of them are one."""

    def omegas(layer: str, convective: bool, V: str) -> list[complex]:
        setting = Setting("semi-lagrangian", "scni", "3/2", "1/2", frame_velocity=V, convective=convective, layer=layer)
        return sorted((complex(b.omega.re, b.omega.im) for b in dispersion(setting, [pi / 6])), key=lambda w: w.real)

    def apart(layer: str, convective: bool) -> float:
        still, moving = (omegas(layer, convective, V) for V in ("0", "1"))
        return max(abs(p - q) for p, q in zip(still, moving, strict=True))

    rounding = 1e-7  # at a double root eigenvalues are known to the square root of rounding
    assert apart("as-defined", True) > 0.1
    assert apart("as-defined", False) < rounding
    assert apart("consistent", True) < rounding


@pytest.mark.parametrize("change", [{"cell_edges": "material"}, {"cell_measure": "material"}], ids=str)
def test_what_the_material_carries_is_part_of_the_state(change: dict[str, str]) -> None:
    """Left out of the state it would be held fixed, in the linearisation and not in the measurement."""
    setting = Setting("semi-lagrangian", "dni", "7/4", "1/2", layer="as-defined", **change)
    one, other = (_largest(replace(setting, layer=layer), pi / 2) for layer in ("as-defined", "simulated"))
    held = _largest(replace(setting, **dict.fromkeys(change, "fixed")), pi / 2)
    assert max(abs(p - q) for p, q in zip(one, other, strict=True)) <= 1e-3 * max(one)
    assert max(abs(p - q) for p, q in zip(one, held, strict=True)) > 1e-2 * max(one)


def test_the_lagrangian_bar_is_measured_as_well() -> None:
    """An unstable bar, so that growth and not frequency is compared: C F^2 + S = -1/2."""
    settings = [
        Setting("lagrangian", "scni", "3/2", stress_ratio="-3/2", layer=layer) for layer in ("as-defined", "simulated")
    ]
    linear, measured = (_largest(setting, pi / 2)[0] for setting in settings)
    assert abs(linear - 0.5**0.5) <= 1e-12  # |sin kh| sqrt(1/2) at R = 3/2
    assert abs(measured - linear) <= 1e-3 * linear


def test_scni_at_rest_is_what_the_print_says_up_to_three_halves_and_no_further() -> None:
    for R, same in (("3/2", True), ("8/5", False)):
        printed, defined = (
            dispersion(
                Setting("semi-lagrangian", "scni", R, stress_ratio="1/3", convective=False, layer=layer),
                ["2"],
                _digits(),
            )
            for layer in ("printed", "as-defined")
        )
        gap = abs(printed[0].omega.re - defined[0].omega.re)
        assert (gap < 1e-25) == same


def _digits() -> Multiprecision:
    return Multiprecision(30)


def test_dni_at_rest_is_the_closed_form() -> None:
    """omega^2 = (1 + s) sin^2 kh + s G (1 - cos kh)^2 with G from the cubic kernel's values at R = 3/2, by hand.

    With z = 2/3: phi_0 = 2/3, phi_1 = 4/81, z phi' = -8/27, z^2 phi'' = 32/27.
    """
    p0, p1, d, c = 2 / 3, 4 / 81, -8 / 27, 32 / 27
    G = -p0 * (2 * c * p1 - 4 * d * d - p0 * d - 6 * p1 * d - p0 * p1 - 2 * p1 * p1) / (p1 * (p0 + 2 * p1) ** 2)
    for kh in (0.5, 1.7, 3.0):
        setting = Setting("semi-lagrangian", "dni", "3/2", stress_ratio="1/2", layer="as-defined", convective=False)
        squared = dispersion(setting, [kh])[0].omega.squared[0]
        assert abs(squared - (1.5 * sin(kh) ** 2 + 0.5 * G * (1 - cos(kh)) ** 2)) <= 1e-13


def test_the_sign_of_Q_matters_to_the_method_and_not_to_the_print() -> None:
    """N acts on the velocities with coefficients even in the shift: it damps for one sign of Q and drives for the other."""

    def growth(layer: str, Q: str) -> float:
        setting = Setting("semi-lagrangian", "scni", "3/2", velocity_gradient=Q, layer=layer)
        moving = [b for b in dispersion(setting, [2.0]) if abs(b.omega.re) > 0.1]
        return max(b.omega.growth for b in moving)

    assert growth("printed", "1/10") == growth("printed", "-1/10") == 0
    assert abs(growth("as-defined", "1/10") - growth("as-defined", "-1/10")) > 1e-3


def test_a_frame_in_motion_changes_psi_star_and_not_the_true_rate() -> None:
    """The true rates sum to zero over the nodes, so that a common velocity does nothing; Psi* do not."""
    K = Exact()
    for convection, same in (("true", True), ("psi-star", False)):
        still, moving = (
            linearise(Base("3/2", Readings("scni", convection), "1/3", "1/5", frame_velocity=V), K).stencil
            for V in (0, 1)
        )
        assert (still == moving) == same


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ({"layer": "simulated", "velocity_gradient": "1/2"}, BadInput),
        ({"layer": "as-defined", "kernel": "tent"}, BadInput),
        ({"layer": "printed", "frame_velocity": 1}, BadInput),
        ({"layer": "measured"}, UnknownName),
        ({"stress_law": "jaumann"}, UnknownName),
        ({"support_radius": "growing"}, UnknownName),
        ({"mass": "heavy"}, UnknownName),
        ({"layer": "printed", "mass": "consistent"}, BadInput),
        ({"layer": "printed", "stress_law": "literal"}, BadInput),
        ({"layer": "as-defined", "half_point": "literal"}, BadInput),
    ],
)
def test_what_has_no_answer_is_refused(changes: dict[str, str], error: type[Exception]) -> None:
    with pytest.raises(error):
        dispersion(Setting("semi-lagrangian", "dni", "3/2", **changes), [1.0], Float())


def test_a_wave_that_fits_is_kept() -> None:
    assert fitting_wave(2 * pi * 3 / 32, 10) == (32, 3)
    count, waves = fitting_wave(1.0, 10)
    assert abs(2 * pi * waves / count - 1.0) < pi / 96
