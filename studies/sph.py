"""SPH itself: its relation by two routes and in nonlinear runs, beside RK with DNI and (87); what would improve it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import pi
from typing import Any

from rkverify.certify import sph_comparison, sph_growth, sph_print, sph_terms
from rkverify.stability.sph_simulate import Packet
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Study, Tables, table
from rkverify.workflow.style import LINES, kh_axis, new_figure
from studies import _sph
from studies._sph import listed, ratio

ROUNDED = Numeric(
    1e-5,
    1e-8,
    "at least six digits are printed; shape functions of kernels that hardly reach a neighbour amplify rounding to 1e-9",
)
MEASURED = Numeric(
    1e-4,
    1e-6,
    "fitted to a time integration with steps to 1e-7 of the wave's amplitude, whose sequence may differ between machines",
)
EXACT = Numeric(1e-11, 0, "exact rationals, rounded once when they are printed")
DRAWN = (
    "SPH, symmetric, continuity density",
    "SPH, corrected gradient",
    "SPH, Galerkin",
    "RK with DNI, full",
    "RK with DNI, diffuse",
    "(87), full",
)


@dataclass(frozen=True)
class Parameters:
    """Support ratios and kernels of the comparison, and what the single tables are tried on; strings are exact.

    largest: the |sigma/C| within which a sign counts as unstable. meaningful: a frozen growth counts from this many |Q|.
    """

    kernels: tuple[str, ...] = ("cubic", "quartic", "quintic", "wendland-c2", "wendland-c4")
    support_ratios: tuple[str, ...] = ("11/10", "13/10", "3/2", "8/5", "17/10", "7/4", "19/10", "2", "5/2", "3", "7/2")
    route_ratios: tuple[str, ...] = ("11/10", "3/2", "7/4", "2", "5/2", "7/2")
    improved_ratios: tuple[str, ...] = ("3/2", "7/4", "5/2", "7/2")
    printed_ratios: tuple[str, ...] = ("11/10", "13/10", "3/2", "7/4", "19/10")
    measured_ratios: tuple[str, ...] = ("3/2", "7/4")
    stresses: tuple[str, ...] = ("1/2", "-1/2")
    material_stresses: tuple[str, ...] = ("-3/2", "-1/2", "0", "1/2", "3/2")
    gradients: tuple[str, ...] = ("-1/10", "-1/40", "0", "1/40", "1/10")
    packet_gradients: tuple[str, ...] = ("-1/10", "0", "1/10")
    drawn_ratios: tuple[str, ...] = tuple(f"{n}/16" for n in range(17, 64))
    samples: int = 96
    drawn_samples: int = 48
    measured_kh: float = 7 * pi / 8
    largest: float = 0.5
    meaningful: float = 4.0
    nodes: int = 15
    term_ratio: str = "7/4"
    term_stress: str = "1/3"
    packet: Packet = field(default_factory=Packet)


R = ("support_ratio", "1", "R = a/h")
S = ("stress_ratio", "1", "sigma / C, tension positive")
Q = ("Q", "(C/rho)^(1/2)/h", "velocity gradient")
KERNEL = ("kernel", "", "its name")
OMEGA = "C/(rho h^2)"


def compute(p: Parameters) -> Tables:
    """Every table."""
    growth = ("growth", "(C/rho)^(1/2)/h", "largest growth over kh")
    addition = [
        ("pairing", "", "antisymmetric: the symmetric SPH force; galerkin: the weak form with Psi_I = V_I W"),
        ("smoothing", "", "what is smoothed over the cells"),
        ("convection", "", "N with Psi*, with the true rate, or none"),
    ]
    spectra = sph_comparison.spectra(p.kernels, p.support_ratios, sph_comparison.with_long_wave(p.samples))
    uneven = sph_terms.uneven_nodes(p.nodes, Fraction(1, 20))
    return {
        "relations": table(
            sph_print.routes(p.kernels, p.route_ratios, p.stresses, 30),
            [
                KERNEL,
                R,
                ("form", "", "of the SPH equations"),
                ("at_2", OMEGA, f"omega^2 at kh = 2 from the closed relation, sigma/C = {p.stresses[0]}, truesdell"),
                ("at_pi", OMEGA, "omega^2 at kh = pi"),
                (
                    "agree",
                    "",
                    "whether the complex-step linearisation gives the same, both stress laws and all stresses",
                ),
            ],
            "SPH at rest: closed relation at 30 digits beside the linearised equations.",
            ROUNDED,
        ),
        "comparison": table(
            sph_comparison.comparison(spectra, p.largest),
            [
                KERNEL,
                R,
                ("relation", "", "equations, or (87) with a reading of the derivative"),
                (
                    "long_wave_tension",
                    "1",
                    f"omega^2/((C + sigma)(kh)^2) at kh = {sph_comparison.LONG_WAVE}, sigma/C = 1/2",
                ),
                ("long_wave_compression", "1", "the same with sigma/C = -1/2; the continuum has 1"),
                ("at_pi_unstressed", OMEGA, "omega^2 at kh = pi without stress: 0 is the rank deficiency"),
                ("at_pi_per_stress", "1/(rho h^2)", "omega^2 at kh = pi over sigma: negative is unstable in tension"),
                ("tension_limit", "1", "least sigma/C > 0 with which a wave grows, inf for none"),
                (
                    "compression_limit",
                    "1",
                    "least -sigma/C > 0 with which a wave grows, inf for none; the continuum has 1",
                ),
                ("unstable", "", f"signs of the stress that make a wave grow with |sigma/C| < {p.largest}"),
            ],
            "Who is unstable in tension and who in compression, at rest.",
            ROUNDED,
        ),
        "agreement": table(
            sph_comparison.agreement(spectra, p.largest),
            [
                KERNEL,
                R,
                ("relation", "", "RK with DNI without N, or (87)"),
                ("unstable", "", "as in `comparison`"),
                ("as_symmetric", "", "whether symmetric SPH is unstable under the same signs"),
                ("as_corrected", "", "whether SPH with the corrected gradient is"),
                ("least_difference", "1", "of omega^2 from the nearest form of SPH, over its largest; sigma/C = +-1/2"),
            ],
            "Where RK with DNI and (87) agree with SPH.",
            ROUNDED,
        ),
        "printed_with_sph_shapes": table(
            sph_print.printed_with_sph_shapes(p.kernels, p.route_ratios, p.samples),
            [
                KERNEL,
                R,
                ("form", "", "of the SPH equations"),
                ("law", "", "stress law of the SPH equations"),
                ("equal", "", "whether omega^2 is the same to rounding"),
                ("difference", "1", "of omega^2 over its largest"),
            ],
            "(87) with Psi_I = V_I W against SPH.",
            ROUNDED,
        ),
        "criterion": table(
            sph_print.criteria(p.kernels, [r for r in p.support_ratios if ratio(r) < 2]),
            [
                KERNEL,
                R,
                ("W_xx", "1/h^3", "W''(h)"),
                ("comes_out", "", "whether the linearised omega^2 at kh = pi is -8 m sigma W''(h)/rho^2"),
                *((f"Psi_xx_{d}", "1/h^2", f"Psi,xx(h), {d}") for d in ("full", "diffuse", "frozen-b", "frozen")),
                *(
                    (f"same_{d}", "", f"whether it has the sign of W''(h), {d}")
                    for d in ("full", "diffuse", "frozen-b", "frozen")
                ),
            ],
            "The criterion of SPH and the one of (87).",
            ROUNDED,
        ),
        "improvements": table(
            sph_growth.improvements(p.improved_ratios, p.stresses, p.gradients, p.samples),
            [*addition, R, S, Q, growth],
            "SPH with strain smoothing and the convective term; where Q is not 0 the coefficients are frozen, and a growth of its order says little.",
            ROUNDED,
        ),
        "printed_growths": table(
            sph_growth.printed_growths(p.printed_ratios, p.stresses, p.gradients, p.samples),
            [("relation", "", "number of the printed relation"), R, S, Q, growth],
            "The same question asked of the printed relations.",
            ROUNDED,
        ),
        "measured": table(
            sph_growth.measured(p.measured_ratios, p.stresses, p.measured_kh),
            [
                ("equations", "", "that were integrated"),
                R,
                S,
                ("kh", "rad", "wave that fits on the chain"),
                ("quantity", "", "growth where the linearised omega^2 is negative, frequency elsewhere"),
                ("linearised", "(C/rho)^(1/2)/h", "its value"),
                ("measured", "(C/rho)^(1/2)/h", "in the nonlinear run"),
                ("agrees", "", "to 1 in 1e3"),
            ],
            "Nonlinear runs at rest.",
            MEASURED,
        ),
        "packets": table(
            sph_growth.packets(p.measured_ratios, p.stresses[0], p.packet_gradients, p.packet),
            [
                *addition,
                R,
                S,
                Q,
                ("gain", "1", f"log of the growth of a packet of kh = pi in the time {p.packet.duration}"),
            ],
            "Nonlinear runs on a base that moves.",
            MEASURED,
        ),
        "lagrangian_kernel": table(
            sph_growth.lagrangian_kernel(p.improved_ratios, p.material_stresses, p.samples),
            [
                ("equations", "", "SPH or RK with DNI"),
                R,
                S,
                ("tangent", "C", "C F^2 + S at F = 1"),
                ("least_material", OMEGA, "least omega^2 over kh with the kernel in material coordinates"),
                ("least_spatial", OMEGA, "with the kernel in space"),
            ],
            "The kernel in material and in spatial coordinates.",
            ROUNDED,
        ),
        "terms": table(
            sph_terms.term_rows(uneven, p.term_ratio, Fraction(p.term_stress), p.nodes // 3),
            [
                ("node", "", "its number"),
                ("mass", "m", "sum_K m_K Psi_I(x_K), Psi_I = V_I W"),
                ("force_41", "C", "f_int of (41) with Psi_I = V_I W"),
                ("force_sph", "C", "-m_I sum_J m_J (sigma_I + sigma_J)/(rho_I rho_J) W'"),
                ("missing", "C", "their difference -V_I sigma_I sum_J V_J W'"),
                ("equal", "", "whether the difference is this term to the last rational"),
                ("symmetric", "C", "-m_I sum_J m_J (sigma_I/rho_I^2 + sigma_J/rho_J^2) W'"),
                ("corrected", "C", "the force with the corrected gradient"),
                ("rk", "C", "f_int of (41) with the RK functions of order 1"),
                ("convective", "C", "N v with v_I = (I mod 3) - 1"),
            ],
            "The terms of (41) and of SPH on uneven nodes.",
            EXACT,
        ),
        "curves": table(
            _curves(p),
            [
                ("relation", "", "as in `comparison`"),
                R,
                S,
                ("kh", "rad", "wave number times spacing"),
                ("omega2", OMEGA, "omega^2"),
            ],
            "omega^2 along kh, cubic kernel.",
            ROUNDED,
            across="kh",
        ),
        "at_pi": table(
            _at_pi(p),
            [("relation", "", "as in `comparison`"), R, ("per_stress", "1/(rho h^2)", "omega^2 at kh = pi over sigma")],
            "omega^2 at kh = pi per unit stress, cubic kernel.",
            ROUNDED,
        ),
    }


def _curves(p: Parameters) -> list[dict[str, Any]]:
    kh = sph_comparison.wave_numbers(p.drawn_samples)
    rows = []
    for name in DRAWN:
        for r in p.measured_ratios:
            found = sph_comparison.spectrum(name, "cubic", r, kh)
            for s in p.stresses:
                values = found.at(float(Fraction(s)))
                rows += [
                    {
                        "relation": name,
                        "support_ratio": r,
                        "stress_ratio": s,
                        "kh": float(t),
                        "omega2": sph_comparison.significant(float(w)),
                    }
                    for t, w in zip(kh, values, strict=True)
                ]
    return rows


def _at_pi(p: Parameters) -> list[dict[str, Any]]:
    last = sph_comparison.wave_numbers(1)
    return [
        {
            "relation": name,
            "support_ratio": r,
            "per_stress": sph_comparison.significant(float(sph_comparison.spectrum(name, "cubic", r, last).slope[0])),
        }
        for name in DRAWN
        for r in p.drawn_ratios
    ]


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """omega^2 along kh in tension and compression, and at kh = pi over R."""
    return {"relations_over_kh": _over_kh(p, tables), "at_pi_over_R": _over_R(p, tables)}


def _over_kh(p: Parameters, tables: Tables) -> Drawing:
    frame = tables["curves"].frame
    figure = new_figure(9.6, 7.2)
    panels = figure.subplots(len(p.stresses), len(p.measured_ratios), squeeze=False)
    least = []
    for row, s in zip(panels, p.stresses, strict=True):
        for axes, r in zip(row, p.measured_ratios, strict=True):
            for style, name in zip(LINES, DRAWN, strict=True):
                part = frame[(frame["relation"] == name) & (frame["support_ratio"] == r) & (frame["stress_ratio"] == s)]
                axes.plot(part["kh"], part["omega2"], label=name, **style)
                if part["omega2"].min() < 0:
                    least.append(f"{name} {part['omega2'].min():.2g} (R = {r}, σ/C = {s})")
            axes.axhline(0, color="#606060", linewidth=0.8)
            kh_axis(axes, "kh  (rad)")
            axes.set(ylabel="ω²ρh²/C  (1)", title=f"R = {r}, σ/C = {s}")
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    caption = (
        f"omega^2 at rest of SPH, of RK with DNI without N and of (87); R = {listed(p.measured_ratios)}, sigma/C = {listed(p.stresses)} (all ours), cubic B-spline (12), "
        f"RK of order 1, {_sph.LAW}, SPH with continuity density. Below zero a wave grows."
    )
    drawn = len(p.stresses) * len(p.measured_ratios) * len(DRAWN)
    return Drawing(
        figure,
        caption,
        f"omega^2 over kh is below zero somewhere, so that a wave grows, with {'; '.join(least) or 'none'}. The other {drawn - len(least)} of {drawn} curves stay at or above zero.",
    )


def _over_R(p: Parameters, tables: Tables) -> Drawing:
    frame, unstressed = tables["at_pi"].frame, tables["comparison"].frame["at_pi_unstressed"]
    figure = new_figure(7.2, 4.6)
    axes = figure.subplots()
    signs = []
    for style, name in zip(LINES, DRAWN, strict=True):
        part = frame[frame["relation"] == name]
        axes.plot(part["support_ratio"].map(ratio), part["per_stress"], label=name, **style)
        above = part[part["per_stress"] > 0]["support_ratio"].map(ratio)
        where = f", from {above.min():.3g} to {above.max():.3g}" if len(above) else ""
        signs.append(f"{name}: above zero at {len(above)} of {len(part)} R{where}")
    axes.axhline(0, color="#606060", linewidth=0.8)
    axes.set_yscale("symlog", linthresh=0.1)
    axes.set(xlabel="support ratio  R = a/h  (1)", ylabel="ω²ρh²/σ at kh = π  (1)", xlim=(1, 4))
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    caption = (
        "omega^2 at kh = pi over sigma, at rest: below zero tension makes the shortest wave grow, above zero compression. "
        f"Without stress omega is zero there in {int((unstressed == 0).sum())} of {len(unstressed)} cases of the table `comparison`, the rank deficiency. "
        f"Vertical scale linear within ±0.1 and logarithmic beyond; cubic B-spline (12), RK of order 1; R = {p.drawn_ratios[0]} to {p.drawn_ratios[-1]} (ours)."
    )
    return Drawing(
        figure,
        caption,
        f"omega^2 at kh = pi over sigma: {'; '.join(signs)}.",
    )


PARAMETERS = Parameters()

STUDY = Study(
    "SPH beside RK with DNI",
    PARAMETERS,
    replace(
        PARAMETERS,
        kernels=("cubic", "wendland-c2"),
        support_ratios=("3/2", "7/4"),
        route_ratios=("3/2", "5/2"),
        improved_ratios=("3/2",),
        printed_ratios=("3/2",),
        measured_ratios=("3/2",),
        gradients=("-1/10", "0", "1/10"),
        drawn_ratios=("5/4", "7/4", "5/2"),
        samples=16,
        drawn_samples=12,
        nodes=12,
        packet=Packet(duration=0.25),
    ),
    compute,
    _sph.statements,
    draw,
)
