"""Where the formulations are stable, over stress, support and velocity gradient, layer beside layer; critical steps."""

from collections.abc import Mapping, Sequence

from rkverify.stability.side_by_side import ANALYTIC, SEVERAL
from rkverify.workflow.study import Drawing, Statement, Study, Tables
from studies import _map_drawings as drawings
from studies._map_tables import QUICK, Parameters, compute, number


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Four figures: (R, s) at rest, (R, kh) at rest, (Q h, s), and critical steps."""
    common = "Cubic B-spline, linear basis, Truesdell rate, cell measure from the edges, nodes move with their own coefficients; h = rho = C^sigma = 1."
    return {
        "rest": Drawing(
            drawings.rest(tables),
            "Stability at rest over support ratio and stress: the relations as printed (above; the stencils (75), (81) are for 1 < R < 2) and the linearised equations "
            "(below; as-defined and consistent are the same at rest), with the printed boundary drawn over them as dashed lines. "
            f"Unstable: omega^2 < 0 at some kh. R = {p.support_ratios[0]} to {p.support_ratios[-1]} in steps of 1/40 (ours), C(h/2) at the cell's edge. {common}",
            drawings.rest_alternative(tables),
        ),
        "rest_waves": Drawing(
            drawings.waves(tables, p.map_stresses),
            "Sign of omega^2 at rest over support ratio and wave number for direct nodal integration: as printed for 1 < R < 2 (above) and linearised (below), "
            f"sigma/C = {' and '.join(p.map_stresses)} (ours). The dashed line is the printed border. SCNI has no unstable wave at these stresses, in print or linearised. {common}",
            drawings.waves_alternative(tables, p.map_stresses),
        ),
        "moving": Drawing(
            drawings.moving(tables),
            "Largest growth over kh, over velocity gradient and stress, with coefficients frozen: as printed (unstable where some omega is not real), as-defined and consistent. "
            f"Frozen equations have a growth of the order of |Q| at every stress: up to |Q| it decides nothing, up to {SEVERAL}|Q| it is left open, because the base changes as fast "
            f"as the wave grows; above {SEVERAL}|Q| it is called unstable. Dashed: the printed boundary; dotted: C + sigma = 0. "
            f"Q h/c from {tables['moving'].frame['Q'].min():.3g} to {tables['moving'].frame['Q'].max():.3g} without 0, sigma/C in steps of {2 / p.stress_steps:g}, kh = pi n/{p.samples} (ours); borders are interpolated. {common}",
            drawings.moving_alternative(tables),
        ),
        "critical_step": Drawing(
            drawings.steps(tables, p.step_stresses),
            "Critical time step of central differences at rest, dt c/h = 2/(omega_max h/c) with c^2 = C/rho (C^SE at F = 1 for the Lagrangian bar), over the support ratio; "
            f"sigma/C = {' and '.join(p.step_stresses)} (ours). Thin with crosses: some omega^2 < 0, so that every step grows. "
            f"Printed relations for 1 < R < 2, C(h/2) at the edge, full derivative. {common}",
            drawings.steps_alternative(tables, p.step_stresses),
        ),
    }


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """C46 and C70, in every layer."""
    return [*_at_rest(p, tables), *_in_motion(p, tables), *_two_forms(p, tables), *_measured(p, tables)]


EDGE = 1e-5
"""A bound of s that is this near to -1 is -1: ratios of two sums of products carry a rounding of 1e-8."""


def _at_rest(p: Parameters, tables: Tables) -> list[Statement]:
    """The set of unstable stresses at Q = 0 is C + sigma < 0 where the stable interval is [-1, inf) for every R."""
    frame = tables["rest"].frame
    found = []
    for layer, name in (("printed", "printed SCNI"), ("as-defined", "SCNI"), ("consistent", "SCNI")):
        part = frame[frame["formulation"] == name]
        gap = float((part["stable_from"] + 1).abs().max())
        same = gap < EDGE and bool((part["stable_to"] == float("inf")).all())
        ratios = list(part["support_ratio"])
        found.append(
            Statement(
                f"scni_at_rest_{layer}",
                ("C46",),
                f"Without a velocity gradient SCNI has omega^2 < 0 at some kh exactly where C^sigma + sigma < 0: at {len(part)} support ratios the stable stresses are "
                f"sigma/C >= {part['stable_from'].max():.6g} without an upper end. The rule asks for -1 to {EDGE:g}. With the stress laws cauchy-rate and literal (69) the continuum's tangent is another one, "
                "C^sigma and C^sigma - sigma.",
                same,
                f"R = {ratios[0]} to {ratios[-1]} in {len(part)} values, all s, kh over [0, pi]; cubic kernel, linear basis",
                "sampled",
                EDGE - gap,
                "rounding allowed for the boundary less its distance from -1",
                layer=layer,
                reading="Q = 0",
            )
        )
    return found


def _in_motion(p: Parameters, tables: Tables) -> list[Statement]:
    """In print the boundary may move by `apart`; frozen growths may move by SEVERAL |Q|, which is what |Q| leaves open."""
    frame = tables["motion"].frame
    size = frame["Q"].abs()
    limit = number(p.small_gradients[-1]) * 1.001
    ranges = (
        ("small", f"|Q h|/c from {p.small_gradients[0]} to {p.small_gradients[-1]}", size <= limit),
        ("large", f"|Q h|/c from {p.large_gradients[0]} to {p.large_gradients[-1]}", size > limit),
    )
    found = []
    for key, words, chosen in ranges:
        part = frame[(frame["layer"] == "printed") & chosen]
        away = float((part["turn"] + 1).abs().max())
        found.append(
            Statement(
                f"scni_in_motion_{key}_printed",
                ("C46",),
                f"With {words} the printed D is negative somewhere only below sigma/C = {part['turn'].max():.5g} to {part['turn'].min():.5g}, depending on R and Q: the print calls stable what lies between this and -1, "
                f"where the continuum is not. The rule allows a boundary {p.apart:g} away.",
                away <= p.apart,
                f"{', '.join(part['case'].unique())}; s by bisection, kh = pi n/{p.samples}",
                "sampled",
                p.apart - away,
                "distance that the rule allows less the boundary's from -1",
                layer="printed",
                reading=words,
            )
        )
    for layer in ("as-defined", "consistent"):
        part = frame[(frame["layer"] == layer) & ranges[0][2]]
        worst, stable = float(part["change"].max()), float(part["stable_growth"].max())
        found.append(
            Statement(
                f"scni_in_motion_small_{layer}",
                ("C46",),
                f"With {ranges[0][1]} and coefficients frozen, the largest growth is within {worst:.3g}|Q| of that at rest at every stress, and at most {stable:.3g}|Q| where C^sigma + sigma >= 0. "
                f"The rule leaves growths up to {SEVERAL}|Q| open: larger ones occur only where C^sigma + sigma < 0, and do so wherever the growth at rest exceeds {SEVERAL + worst:.3g}|Q|.",
                worst <= SEVERAL,
                f"{', '.join(part['case'].unique())}; sigma/C in {{{', '.join(p.tried_stresses)}}}, both signs of Q, kh = pi n/{p.samples}",
                "sampled",
                SEVERAL - worst,
                "multiples of |Q| that the rule leaves open less those found",
                layer=layer,
                reading=ranges[0][1],
            )
        )
    return found


SAME, CONSTANT = "C^sigma = F^3 C^SE", "both moduli constant from the unstressed state"


def _two_forms(p: Parameters, tables: Tables) -> list[Statement]:
    """The two conditions are similar where the signs of the least omega^2 agree at every state tried, at Q = 0."""
    same, constant, motion = (tables[name].frame for name in ("two_forms", "constant_moduli", "motion"))
    found = []
    for layer in ANALYTIC:
        part = same[same["layer"] == layer]
        agree = (part["lagrangian_least"] < 0) == (part["semi_lagrangian_least"] < 0)
        largest = float(part["difference"].max())
        frequencies = (
            "the frequencies are the same as well"
            if largest < EDGE
            else f"omega^2 differs by up to {largest:.3g} of its largest value"
        )
        moved = motion[(motion["layer"] == layer) & (motion["Q"].abs() <= number(p.small_gradients[-1]) * 1.001)]
        if layer == "printed":
            with_Q = (
                f"the boundary of the semi-Lagrangian form moves by {(moved['turn'] + 1).abs().max():.2g} in sigma/C"
            )
            near = bool((moved["turn"] + 1).abs().max() <= p.apart)
        else:
            with_Q = f"its growth changes by {moved['change'].max():.3g}|Q|"
            near = bool(moved["change"].max() <= SEVERAL)
        found.append(
            Statement(
                f"same_material_{layer}",
                ("C70",),
                "P = S F = sigma in one dimension, so that F (C^SE F^2 + S) = C^sigma + sigma exactly when C^sigma = F^3 C^SE: then both conditions are the same set. "
                f"With SCNI the signs of the least omega^2 agree in {int(agree.sum())} of {len(part)} states at rest, and {frequencies}. With the convective term and |Q h|/c up to {p.small_gradients[-1]} {with_Q}.",
                bool(agree.all()) and near,
                f"R in {{{', '.join(part['support_ratio'].unique())}}}, F in {{{', '.join(p.stretches)}}}, sigma/C in {{{', '.join(p.tried_stresses)}}}",
                "sampled",
                layer=layer,
                reading=SAME,
            )
        )
        path = constant[constant["layer"] == layer]
        differ = path[(path["lagrangian_least"] < 0) != (path["semi_lagrangian_least"] < 0)]
        found.append(
            Statement(
                f"constant_moduli_{layer}",
                ("C70",),
                "From the unstressed state with a constant modulus each, C^SE F^2 + S = C^SE (3 F^2 - 1)/2 turns negative below F = 1/sqrt(3), while C^sigma + sigma = C^sigma F never does: "
                f"of F = {', '.join(p.path)} the forms disagree at {', '.join(differ['stretch']) or 'none'}, where the Lagrangian one is unstable.",
                differ.empty,
                f"R = 3/2, F in {{{', '.join(p.path)}}}, Q = 0",
                "sampled",
                float(path["lagrangian_least"].min()),
                "least omega^2 of the Lagrangian form on the path",
                layer=layer,
                reading=CONSTANT,
            )
        )
    return found


def _measured(p: Parameters, tables: Tables) -> list[Statement]:
    """A computation is unstable where its measured growth is above its uncertainty."""
    frame = tables["measured"].frame
    same, constant = (frame[frame["moduli"] == name] for name in ("same material", "constant moduli"))
    grows, should = same["semi_lagrangian_growth"] > 0, same["stress_ratio"] < -1
    apart = float((same["lagrangian_growth"] - same["semi_lagrangian_growth"]).abs().max())
    agree = (constant["lagrangian_growth"] > 0) == (constant["semi_lagrangian_growth"] > 0)
    tried = f"(R, sigma/C) in {{{', '.join(f'({R}, {s})' for R, s in p.measured)}}}, kh near pi/2, Q = 0"
    return [
        Statement(
            "scni_at_rest_simulated",
            ("C46",),
            f"Nonlinear computations with SCNI at rest grow in {int((grows & should).sum())} of {int(should.sum())} settings with C^sigma + sigma < 0 and in {int((grows & ~should).sum())} of {int((~should).sum())} with C^sigma + sigma > 0.",
            bool((grows == should).all()),
            tried,
            "sampled",
            layer="simulated",
            reading="Q = 0",
        ),
        Statement(
            "same_material_simulated",
            ("C70",),
            f"On the same material, C^sigma = F^3 C^SE, both forms grow or do not grow together in {int(((same['lagrangian_growth'] > 0) == grows).sum())} of {len(same)} settings; "
            f"their measured growths h/c {'agree to 1e-5' if apart <= 1e-5 else f'differ by {apart:.3g}'}.",
            bool(((same["lagrangian_growth"] > 0) == grows).all()),
            f"{tried}, F = {p.measured_stretch}",
            "sampled",
            layer="simulated",
            reading=SAME,
        ),
        Statement(
            "constant_moduli_simulated",
            ("C70",),
            f"At F = {p.path[1]} from the unstressed state, each form with its own modulus constant, the Lagrangian computation grows at {constant['lagrangian_growth'].iloc[0]:.3g} c/h and the semi-Lagrangian one "
            f"{'does not' if not constant['semi_lagrangian_growth'].iloc[0] > 0 else 'does as well'}.",
            bool(agree.all()),
            f"R = 3/2, F = {p.path[1]}, kh near pi/2, Q = 0",
            "sampled",
            layer="simulated",
            reading=CONSTANT,
        ),
    ]


STUDY = Study("Stability maps and critical time steps", Parameters(), QUICK, compute, judge, draw)
